"""Which method is the cheapest for an error: the Pareto front, and the cheapest within a tolerance."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from validation.analysis.evidence import Table
from validation.analysis.quantity import Quantity
from validation.analysis.statistics import Interval
from validation.benchmarks.timing import ALONE, FINISHED
from validation.benchmarks.work_precision.problem import ELEMENTS, FILTER_3D, SPRINGS

TOLERANCES = (0.3, 0.1, 0.03, 0.01, 0.001)
"""That are asked for, relative; as levels 20 lg (1 + tolerance) dB."""
NAN = math.nan


@dataclass(frozen=True, kw_only=True)
class Point:
    """One configuration and one quantity.

    unit: "%" for relative errors, or "dB"; band: uncertainty of the reference, in the unit of the error; method,
    parameter, value: of the configuration; is_reference: whether it is the reference itself; is_model: whether it has
    no surfaces of the reference, so that no parameter brings its error to zero; status: "finished", or why not; error,
    half_width: with the interval of the sample; finer: the largest upper end of an error that finer settings leave, see
    `monotone_envelope`; over: the answer over the reference; seconds: quartiles and median, low, middle, high; runs:
    behind them; setup: seconds.
    """

    scene: str
    quantity: str
    unit: str
    band: float
    method: str = ""
    parameter: str = ""
    value: float = NAN
    is_reference: bool = False
    is_model: bool = False
    status: str = ""
    error: float = NAN
    half_width: float = 0.0
    finer: float = 0.0
    over: float = NAN
    seconds: tuple[float, float, float] = (NAN, NAN, NAN)
    runs: int = 0
    setup: float = NAN

    @property
    def finished(self) -> bool:
        return self.status == FINISHED and math.isfinite(self.error)

    @property
    def rank(self) -> float:
        """The upper end of its error; never below the uncertainty of the reference, nor what finer settings leave."""
        return max(self.error + self.half_width, self.band, self.finer)

    @property
    def setting(self) -> str:
        return self.parameter.replace("#", f"{self.value:g}")


def monotone_envelope(points: Sequence[Point]) -> list[Point]:
    """Each point with the largest upper bound of the error that its method has at finer settings, which come later."""
    worst: dict[str, float] = {}
    envelope = []
    for point in reversed(points):
        envelope.append(replace(point, finer=worst.get(point.method, 0.0)))
        if point.finished:
            worst[point.method] = max(worst.get(point.method, 0.0), point.rank)
    return envelope[::-1]


def seconds(point: Point) -> float:
    return point.seconds[1]


def front(points: Sequence[Point]) -> list[Point]:
    """Those that nothing beats in both error and cost, from cheap to dear; of equals the first.

    Ranked by the upper ends of errors; what lies below the band of the reference is as good as its edge. The reference
    itself, and who has not finished, takes no part.
    """
    candidates = [p for p in points if p.finished and not p.is_reference]
    best: list[Point] = []
    for point in sorted(candidates, key=lambda p: (seconds(p), p.rank)):
        if not best or point.rank < best[-1].rank:
            best.append(point)
    return best


def in_unit_of_error(tolerance: float, unit: str) -> float:
    """20 lg (1 + tolerance) of levels."""
    return 20 * math.log10(1 + tolerance) if unit == "dB" else tolerance


def cheapest(points: Sequence[Point], tolerance: float) -> Point | None:
    """The cheapest point within a relative tolerance; None where there is none, or the reference is too uncertain."""
    within = [point for point in front(points) if point.rank <= in_unit_of_error(tolerance, point.unit)]
    return within[0] if within else None


def reason_if_none(points: Sequence[Point], tolerance: float) -> str:
    """Return "none", or that the reference is less certain than the tolerance."""
    limit = in_unit_of_error(tolerance, points[0].unit)
    return "the reference cannot tell" if points[0].band > limit else "none"


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
    rows = [row for chart in charts for row in _speed_up_rows(chart)]
    return Table(FASTER, {name: [row[name] for row in rows] for name in (rows[0] if rows else ("scene",))})


def _speed_up_rows(chart: Sequence[Point]) -> Iterator[dict[str, object]]:
    """Yield a row for each reduced model whose least error boundary elements reach too."""
    candidates = [point for point in chart if point.finished and not point.is_reference]
    elements = [point for point in candidates if point.method in ELEMENTS]
    for method in REDUCED:
        model_front = front([point for point in candidates if point.method == method])
        other = cheapest_as_close(model_front[-1], elements) if model_front else None
        if other is None:
            continue
        ratio, scale = time_over(other, model_front[-1]), 1.0 if other.unit == "dB" else 100.0
        yield {
            **{"scene": other.scene, "quantity": other.quantity, "model": method, "unit": other.unit},
            **{"error": scale * model_front[-1].rank, "error of boundary elements": scale * other.rank},
            **{"seconds": seconds(model_front[-1]), "seconds of boundary elements": seconds(other)},
            **{
                "times faster": ratio.value,
                "from": ratio.value - ratio.half_width,
                "to": ratio.value + ratio.half_width,
            },
        }


def cheapest_as_close(point: Point, candidates: Sequence[Point]) -> Point | None:
    """Return the cheapest candidate whose upper end of the error is at most that of the point, None without one."""
    close = [candidate for candidate in candidates if candidate.rank <= point.rank]
    return min(close, key=seconds, default=None)


def time_over(numerator: Point, denominator: Point) -> Interval:
    """Ratio of the median times; the uncertainties of both are independent."""
    ratio = seconds(numerator) / seconds(denominator)
    return Interval(
        ratio,
        0.0 if denominator is numerator else ratio * math.hypot(_uncertainty(numerator), _uncertainty(denominator)),
    )


def _uncertainty(point: Point) -> float:
    """Relative, of the median time."""
    low, median, high = point.seconds
    return NOTCH * (high - low) / median / math.sqrt(point.runs) if point.runs > 1 else ALONE
