"""The figures of the cases: charts that they declare, or functions of the modules beside this one.

Such a function takes the tables that it draws, by their names.
"""

import inspect
from collections.abc import Callable, Mapping
from functools import partial

from matplotlib.figure import Figure

from validation.analysis.chart import Chart
from validation.analysis.evidence import Evidence
from validation.report.contents import CASES, TIMED
from validation.report.drawing import draw
from validation.report.figures import precision, race

OWN: Mapping[str, Callable[..., Figure]] = {
    "precision": precision.draw,
    "precision-interface": precision.draw_interface,
    "precision-others": precision.draw_others,
    "race": race.draw,
}


def drawing(name: str) -> Callable[[Evidence], Figure]:
    """What draws a figure. Raises ValueError where there is none."""
    draws = _chart_or_function(name)
    if isinstance(draws, Chart):
        return partial(draw, draws)
    return lambda evidence: draws(*map(evidence.table, tables_of(name)))


def tables_of(name: str) -> tuple[str, ...]:
    """Names of the tables that a figure draws. Raises ValueError for no figure."""
    draws = _chart_or_function(name)
    return draws.tables if isinstance(draws, Chart) else tuple(inspect.signature(draws).parameters)


def _chart_or_function(name: str) -> Chart | Callable[..., Figure]:
    case = (CASES | TIMED).get(name.partition("-")[0])
    for chart in case.study.charts if case else ():
        if chart.name == name and chart.panels:
            return chart
    if name not in OWN:
        raise ValueError(f"figure {name!r} must be a chart of its case, or in OWN of report/figures/__init__.py")
    return OWN[name]
