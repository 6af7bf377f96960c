"""Which method is the cheapest for an error: the Pareto front, the cheapest within a tolerance, break-even in words."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from validation.benchmarks.timing import FINISHED
from validation.benchmarks.work_precision.problem import CLOSED

TOLERANCES = (0.3, 0.1, 0.03, 0.01, 0.001)
"""That are asked for, relative; as levels 20 lg (1 + tolerance) dB."""
TELLING = 1.1
NAN = math.nan


@dataclass(frozen=True, kw_only=True)
class Point:
    """One configuration and one quantity.

    unit: "%" for relative errors, or "dB"; band: uncertainty of the reference, in the unit of the error; method,
    parameter, value: of the configuration; is_reference: whether it is the reference itself; is_model: whether it has
    no surfaces of the reference, so that no parameter brings its error to zero; status: "finished", or why not; error,
    half_width: with the interval of the sample; finer: the largest upper end of an error that more of the same leaves,
    see `monotone_envelope`; over: the answer over the reference; seconds: quartiles and median, low, middle, high;
    runs: behind them; setup: seconds; work: the cost that no machine changes.
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
    work: float = NAN

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
    """Each point with the largest upper bound of the error that its method has at more work, where that is larger."""
    return [replace(point, finer=max((p.rank for p in points if _finer(p, point)), default=0.0)) for point in points]


def _finer(other: Point, point: Point) -> bool:
    return other.method == point.method and other.finished and other.work > point.work


Cost = Callable[[Point], float]


def seconds(point: Point) -> float:
    return point.seconds[1]


def work(point: Point) -> float:
    return point.work


def front(points: Sequence[Point], cost: Cost = seconds, *, gain: float = 1.0) -> list[Point]:
    """Those that nothing beats in both error and cost, from cheap to dear; of equals the first.

    Ranked by the upper ends of errors; what lies below the band of the reference is as good as its edge. Who has not
    finished, or has no such cost, takes no part. gain: by this factor, above one, the next must be closer.
    """
    known = [point for point in points if point.finished and math.isfinite(cost(point))]
    found: list[Point] = []
    for point in sorted(known, key=lambda p: (cost(p), p.rank)):
        if not found or gain * point.rank < found[-1].rank:
            found.append(point)
    return found


def in_unit_of_error(tolerance: float, unit: str) -> float:
    """20 lg (1 + tolerance) of levels."""
    return 20 * math.log10(1 + tolerance) if unit == "dB" else tolerance


def cheapest(points: Sequence[Point], tolerance: float, cost: Cost = seconds) -> Point | None:
    """The cheapest point within a relative tolerance; None where there is none, or the reference is too uncertain."""
    within = [point for point in front(points, cost) if point.rank <= in_unit_of_error(tolerance, point.unit)]
    return within[0] if within else None


def reason_if_none(points: Sequence[Point], tolerance: float) -> str:
    wanted = in_unit_of_error(tolerance, points[0].unit)
    return "the reference cannot tell" if points[0].band > wanted else "none"


def break_even(points: Sequence[Point]) -> str:
    """Down to which error which method is the cheapest, in one sentence, without the reference itself.

    A step along the front that gains less than a tenth is left out.
    """
    first = points[0]
    others = [point for point in points if not point.is_reference]
    steps = front(others, gain=TELLING)
    head = f"{first.scene}, {first.quantity}: "
    if not steps:
        return head + "no method has finished."
    parts: list[str] = []
    for method, group in groupby(steps, key=lambda p: p.method):
        mine = list(group)
        begin, end = mine[0], mine[-1]
        settings = begin.setting if begin is end else end.parameter.replace("#", f"{begin.value:g} to {end.value:g}")
        times = (
            format_seconds(seconds(begin))
            if begin is end
            else f"{format_seconds(seconds(begin))} to {format_seconds(seconds(end))}"
        )
        sample = ", most of it the sample's," if end.half_width > max(end.error, end.finer / 2) else ""
        parts.append(f"down to {format_error(end.rank, end.unit)}{sample} {method} ({settings}, {times})")
    last = front(others)[-1]
    below = (
        f"; below {format_error(first.band, first.unit)} the reference cannot tell"
        if last.rank <= first.band
        else f"; no method gets below {format_error(last.rank, last.unit)}"
    )
    referee = next((point for point in points if point.is_reference and point.finished), None)
    exact = f" The {CLOSED} itself takes {format_seconds(seconds(referee))}." if referee else ""
    return f"{head}{parts[0]} is the cheapest{''.join(f'; beyond, {part}' for part in parts[1:])}{below}.{exact}"


def format_seconds(value: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if value >= size or unit == "µs":
            return f"{value / size:.2g} {unit}" if value < 100 * size else f"{value / size:.0f} {unit}"
    raise AssertionError


def format_error(value: float, unit: str) -> str:
    size = value if unit == "dB" else 100 * value
    return f"{size:.0f} {unit}" if size >= 100 else f"{size:.2g} {unit}"
