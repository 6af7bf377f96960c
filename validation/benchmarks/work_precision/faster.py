"""How much faster springs and linear theory are than boundary elements at an error that both reach."""

import math
from collections.abc import Iterator, Sequence

from validation.analysis.evidence import Table
from validation.analysis.quantity import Quantity
from validation.analysis.statistics import Interval
from validation.benchmarks.timing import ALONE
from validation.benchmarks.work_precision.pareto import Point, front, seconds
from validation.benchmarks.work_precision.problem import ELEMENTS, FILTER_3D, SPRINGS

FASTER = Quantity("times_faster_than_boundary_elements_at_equal_error")
REDUCED = (*SPRINGS, FILTER_3D)
NOTCH = 1.57
"""Half of the 95 % interval of a median, over the interquartile range over sqrt(runs).

Source: McGill, Tukey, Larsen, Am. Stat. 32 (1978) 12.
"""


def faster(charts: Sequence[Sequence[Point]]) -> Table:
    """A row a chart and reduced model: T_BEM / T with its 95 % interval, at the least error that the model reaches.

    T is the time of the cheapest setting with that error e, T_BEM of the cheapest boundary elements whose upper end of
    the error is at most e: both are measured, nothing lies between grids. "error" and "error of boundary elements" are
    these upper ends, in the unit.
    """
    rows = [row for chart in charts for row in _rows(chart)]
    return Table(FASTER, {name: [row[name] for row in rows] for name in (rows[0] if rows else ("scene",))})


def _rows(chart: Sequence[Point]) -> Iterator[dict[str, object]]:
    known = [point for point in chart if point.finished and not point.is_reference]
    elements = [point for point in known if point.method in ELEMENTS]
    for method in REDUCED:
        mine = front([point for point in known if point.method == method])
        other = cheapest_as_close(mine[-1], elements) if mine else None
        if other is None:
            continue
        ratio, scale = time_over(other, mine[-1]), 1.0 if other.unit == "dB" else 100.0
        yield {
            **{"scene": other.scene, "quantity": other.quantity, "model": method, "unit": other.unit},
            **{"error": scale * mine[-1].rank, "error of boundary elements": scale * other.rank},
            **{"seconds": seconds(mine[-1]), "seconds of boundary elements": seconds(other)},
            **{
                "times faster": ratio.value,
                "from": ratio.value - ratio.half_width,
                "to": ratio.value + ratio.half_width,
            },
        }


def cheapest_as_close(point: Point, others: Sequence[Point]) -> Point | None:
    close = [other for other in others if other.rank <= point.rank]
    return min(close, key=seconds, default=None)


def time_over(mine: Point, other: Point) -> Interval:
    """Ratio of the median times; the uncertainties of both are independent."""
    ratio = seconds(mine) / seconds(other)
    return Interval(ratio, 0.0 if other is mine else ratio * math.hypot(_uncertainty(mine), _uncertainty(other)))


def _uncertainty(point: Point) -> float:
    """Relative, of the median time."""
    low, median, high = point.seconds
    return NOTCH * (high - low) / median / math.sqrt(point.runs) if point.runs > 1 else ALONE
