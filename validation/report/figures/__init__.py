"""The figures of the cases: charts that they declare, or functions in a file of this folder named like the case."""

from collections.abc import Callable
from functools import partial
from importlib import import_module
from importlib.util import find_spec

from matplotlib.figure import Figure

from validation.analysis.chart import Chart
from validation.analysis.evidence import Evidence
from validation.report.contents import CASES, TIMED
from validation.report.drawing import draw


def declared(name: str) -> Chart | None:
    """The chart of that name, if its case declares one with panels."""
    case = (CASES | TIMED).get(name.partition("-")[0])
    charts = case.study.charts if case and case.study else ()
    return next((chart for chart in charts if chart.name == name and chart.panels), None)


def drawing(name: str) -> Callable[[Evidence], Figure]:
    """What draws a figure: its chart, or of "wheel" the function `draw` of the file of that name, and `draw_cause`
    of "wheel-cause".

    Raises ValueError where there is none.
    """
    if chart := declared(name):
        return partial(draw, chart)
    case, _, part = name.partition("-")
    module, function = f"{__name__}.{case}", f"draw_{part}" if part else "draw"
    own: Callable[[Evidence], Figure] | None = None
    if find_spec(module) is not None:
        own = getattr(import_module(module), function, None)
    if own is None:
        raise ValueError(f"figure {name!r} must be a chart of its case or {function} in report/figures/{case}.py")
    return own
