"""One file a case, found by its name: its figures, drawn from the tables of its evidence and nothing else."""

from collections.abc import Callable
from importlib import import_module

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence


def drawing(name: str) -> Callable[[Evidence], Figure]:
    """What draws a figure: "wheel" is `draw` of the file of that name, "wheel-cause" is `draw_cause` there."""
    case, _, part = name.partition("-")
    draw: Callable[[Evidence], Figure] = getattr(
        import_module(f"{__name__}.{case}"), f"draw_{part}" if part else "draw"
    )
    return draw
