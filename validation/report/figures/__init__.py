"""The figures of the cases: charts that they declare, or functions in a file of this folder named like the case.

Such a function takes the tables that it draws, by their names.
"""

import inspect
from collections.abc import Callable
from functools import partial
from importlib import import_module
from importlib.util import find_spec

from matplotlib.figure import Figure

from validation.analysis.chart import Chart
from validation.analysis.evidence import Evidence
from validation.report.contents import CASES, TIMED
from validation.report.drawing import draw


def drawing(name: str) -> Callable[[Evidence], Figure]:
    """What draws a figure. Raises ValueError where there is none."""
    if chart := _declared(name):
        return partial(draw, chart)
    own = _own(name)
    return lambda evidence: own(*map(evidence.table, tables_of(name)))


def tables_of(name: str) -> tuple[str, ...]:
    """Names of the tables that a figure draws. Raises ValueError for no figure."""
    chart = _declared(name)
    return chart.tables if chart else tuple(inspect.signature(_own(name)).parameters)


def _declared(name: str) -> Chart | None:
    """The chart of that name, if its case declares one with panels."""
    case = (CASES | TIMED).get(name.partition("-")[0])
    charts = case.study.charts if case and case.study else ()
    return next((chart for chart in charts if chart.name == name and chart.panels), None)


def _own(name: str) -> Callable[..., Figure]:
    """Of "wheel" the function `draw` of the file of that name, of "wheel-cause" its `draw_cause`."""
    case, _, part = name.partition("-")
    module, function = f"{__name__}.{case}", f"draw_{part}" if part else "draw"
    own: Callable[..., Figure] | None = None
    if find_spec(module) is not None:
        own = getattr(import_module(module), function, None)
    if own is None:
        raise ValueError(f"figure {name!r} must be a chart of its case or {function} in report/figures/{case}.py")
    return own
