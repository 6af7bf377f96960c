"""One file a case, found by its name: its figures, drawn from the tables of its evidence and nothing else."""

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence


def drawing(name: str) -> Callable[[Evidence], Figure]:
    """What draws a figure: "wheel" is `draw` of the file of that name, "wheel-cause" is `draw_cause` there.

    Raises ValueError where there is none.
    """
    case, _, part = name.partition("-")
    module, function = f"{__name__}.{case}", f"draw_{part}" if part else "draw"
    draw: Callable[[Evidence], Figure] | None = None
    if find_spec(module) is not None:
        draw = getattr(import_module(module), function, None)
    if draw is None:
        raise ValueError(f"figure {name!r} must have a function {function} in validation/report/figures/{case}.py")
    return draw
