"""Which method is the cheapest within a tolerance: the errors, the Pareto front, the cheapest setting of each method.

An error is relative to what is exact, or to the finest grids of the same roughness. It is an estimate with the half
width of its 95 % interval: settings are chosen by the estimate, and the interval gives the verdict. So a method is not
dearer because its errors were sampled less.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import Table, Verdict, table_of, verdict_of
from validation.analysis.quantity import Quantity
from validation.analysis.statistics import Interval, jackknife_error, student
from validation.benchmarks.timing import ALONE, FINISHED, OUT_OF_RANGE, Configuration, configurations_of
from validation.benchmarks.work_precision.problem import (
    BEM_METHOD,
    ELEMENTS,
    EXTRAPOLATED,
    ChartProblem,
    ChartQuantity,
    values_of,
)
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import NotConvergedError
from validation.simulation.method import Values

TOLERANCES = {"%": (0.1, 0.03, 0.01), "dB": (3.0, 1.0)}
"""Those of the reader, by the unit of the error: relative, or in dB."""
SHOWN = {"%": 100.0, "dB": 1.0}
"""From errors to numbers in their unit."""
NAN = math.nan


@dataclass(frozen=True, kw_only=True)
class Point:
    """One configuration and one quantity.

    unit: "%" for relative errors, or "dB"; band: uncertainty of the reference, in the unit of the error; method,
    parameter, value: of the configuration; is_reference: whether it is the reference itself; is_model: whether it has
    no surfaces of the reference, so that no parameter brings its error to zero; status: "finished", or why not; error,
    half_width: of the 95 % interval of the sample; finer: the largest error that finer settings leave, see
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
        """Its error; never below the uncertainty of the reference, nor below what finer settings leave."""
        return max(self.error, self.band, self.finer)

    @property
    def seconds_interval(self) -> tuple[float, float]:
        """Ends of the 95 % interval of the median time [s]."""
        return self.seconds[1] * (1 - _uncertainty(self)), self.seconds[1] * (1 + _uncertainty(self))

    def verdict(self, tolerance: float) -> Verdict:
        """Of its whole interval, to which the sample and the reference contribute; tolerance: in the unit of errors."""
        return verdict_of(self.error, self.half_width + self.band, tolerance)

    @property
    def setting(self) -> str:
        return self.parameter.replace("#", f"{self.value:g}")


def monotone_envelope(points: Sequence[Point]) -> list[Point]:
    """Each point with the largest error that its method has at finer settings, which come later."""
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

    Ranked by errors; what lies below the band of the reference is as good as its edge. The reference itself, and what
    has not finished, takes no part.
    """
    candidates = [p for p in points if p.finished and not p.is_reference]
    best: list[Point] = []
    for point in sorted(candidates, key=lambda p: (seconds(p), p.rank)):
        if not best or point.rank < best[-1].rank:
            best.append(point)
    return best


def cheapest(points: Sequence[Point], tolerance: float) -> Point | None:
    """The cheapest point whose error is within a tolerance, in the unit of errors; None where there is none.

    Nothing is within a tolerance that the uncertainty of the reference exceeds.
    """
    within = [p for p in points if p.finished and not p.is_reference and p.rank <= tolerance]
    return min(within, key=seconds, default=None)


CHEAPEST_SETTING = Quantity("cheapest_setting_of_each_method_within_a_tolerance")
FACTOR = "times faster than BEM"
NOTCH = 1.57
"""Half of the 95 % interval of a median, over the interquartile range over sqrt(runs).

Source: McGill, Tukey, Larsen, Am. Stat. 32 (1978) 12.
"""


def cheapest_settings(charts: Sequence[Sequence[Point]]) -> Table:
    """A row a chart, tolerance and method: its cheapest setting whose error is within the tolerance.

    error: with the half-widths that the sample and the reference leave, in the unit; verdict: by all of its interval;
    time: median of one realisation, with its 95 % interval; FACTOR: T_BEM / T with its interval, of the cheapest
    boundary elements within the same tolerance: both are measured, nothing lies between settings. A method without
    such a setting has its closest one, and no factor.
    """
    return table_of(CHEAPEST_SETTING, [row for chart in charts for row in _rows_of_chart(chart)])


def _rows_of_chart(chart: Sequence[Point]) -> Iterator[dict[str, object]]:
    """Yield a row for each tolerance and method; boundary elements are one method, however they are coarsened."""
    candidates = [point for point in chart if point.finished and not point.is_reference]
    groups: dict[str, list[Point]] = {}
    for point in candidates:
        groups.setdefault(BEM_METHOD if point.method in ELEMENTS else point.method, []).append(point)
    for tolerance in TOLERANCES[chart[0].unit]:
        elements = cheapest(groups.get(BEM_METHOD, []), tolerance)
        for method, points in groups.items():
            chosen = cheapest(points, tolerance)
            factor = time_over(elements, chosen) if elements and chosen and method != BEM_METHOD else None
            closest = min(reversed(points), key=lambda point: point.rank)
            yield _row_of_setting(method, chosen or closest, tolerance, bool(chosen), factor)


def _row_of_setting(
    method: str, point: Point, tolerance: float, meets: bool, factor: Interval | None
) -> dict[str, object]:
    """Return the row of a setting; factor: T_BEM / T, None without one."""
    scale, (low, high) = SHOWN[point.unit], point.seconds_interval
    ratio, half = (factor.value, factor.half_width) if factor else (NAN, NAN)
    of_error = {"error": point.error, "± sample": point.half_width, "± reference": point.band}
    return {
        **{"scene": point.scene, "quantity": point.quantity, "unit": point.unit, "tolerance": scale * tolerance},
        **{"method": method, "setting": point.setting if method != BEM_METHOD else f"{point.method}: {point.setting}"},
        **{name: scale * value for name, value in of_error.items()},
        **{"verdict": point.verdict(tolerance).value, "a setting within": meets},
        **{"time [s]": seconds(point), "time from [s]": low, "time to [s]": high},
        **{FACTOR: ratio, "factor from": ratio - half, "factor to": ratio + half},
    }


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


IntArray = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class MethodValues:
    """What one method says, and on two grids what it tends to.

    fine: answers; coarse: of the grid with cells `ratio` times as long, None where nothing is extrapolated; paired:
    whether its realisations are the first of the reference.
    """

    fine: Values
    coarse: Values | None = None
    ratio: float = 2.0
    paired: bool = True

    @property
    def size(self) -> int:
        return len(next(iter(self.fine.values())))

    def log(self, quantity: ChartQuantity, rows: IntArray) -> FloatArray:
        """ln q of these realisations; extrapolated, ln q_f + (ln q_f - ln q_c) / (ratio^order - 1)."""
        fine = quantity.log(_values_of_rows(self.fine, rows))
        if self.coarse is None:
            return fine
        change = fine - quantity.log(_values_of_rows(self.coarse, rows))
        return np.asarray(fine + change / (self.ratio**quantity.order - 1))


def _values_of_rows(values: Values, rows: IntArray) -> Values:
    """Return the values of some realisations, which lie along the first axis."""
    return {name: value[rows] for name, value in values.items()}


@dataclass(frozen=True)
class Error:
    """value: relative or in dB; half_width: of the interval of 95 % that the sample leaves; over: the reference, NaN
    for more than one number."""

    value: float
    half_width: float
    over: float


def error(quantity: ChartQuantity, answer: MethodValues, reference: MethodValues) -> Error:
    """How far an answer is from the reference; its interval by leaving out one realisation after the other.

    Paired, of both at once: what the realisation has of its own drops out. Otherwise of either by itself.
    """
    rows = np.arange(answer.size)
    reference_rows = rows if answer.paired and reference.size > 1 else np.arange(reference.size)

    def ratio(rows: IntArray, reference_rows: IntArray) -> FloatArray:
        return answer.log(quantity, rows) - reference.log(quantity, reference_rows)

    def off(rows: IntArray, reference_rows: IntArray) -> float:
        """With the sign of a single number: one that happens to lie on the reference scatters as much as any other."""
        log_ratio = ratio(rows, reference_rows)
        return quantity.distance(log_ratio) * (math.copysign(1.0, log_ratio[0]) if log_ratio.size == 1 else 1.0)

    jackknife_rows = [np.delete(rows, i) for i in rows] if answer.size > 1 else []
    if answer.paired:
        half_width = _half_width([off(left, np.delete(reference_rows, i)) for i, left in enumerate(jackknife_rows)])
    else:
        jackknife_references = [np.delete(reference_rows, i) for i in reference_rows] if reference.size > 1 else []
        half_width = math.hypot(
            _half_width([off(left, reference_rows) for left in jackknife_rows]),
            _half_width([off(rows, left) for left in jackknife_references]),
        )
    log_ratio = ratio(rows, reference_rows)
    over = float(np.exp(log_ratio[0])) if log_ratio.size == 1 else math.nan
    return Error(quantity.distance(log_ratio), half_width, over)


def _half_width(without: list[float]) -> float:
    """Student's quantile times the jackknife's error; zero of a single value, which has no sample; infinite where two
    are too few for what is asked, as one is for a deviation."""
    if not without:
        return 0.0
    return float(student(len(without) - 1) * jackknife_error(without)) if np.isfinite(without).all() else math.inf


def reference_of(
    problem: ChartProblem, values: Mapping[Configuration, Values]
) -> tuple[MethodValues, Callable[[ChartQuantity], float]]:
    """The reference, and its uncertainty for each quantity.

    Exact ones have what the quantity says. Others are extrapolated from the two finest grids, and the whole step from
    the finer of them is left open: enough for every order of convergence above 0.6.
    Raises NotConvergedError where one of these grids has not finished.
    """
    reference = problem.reference()
    if not isinstance(reference, tuple):
        return MethodValues(reference), lambda quantity: quantity.band
    coarse, fine = reference
    if not (coarse in values and fine in values):
        raise NotConvergedError(f"{problem.name}: the grids of the reference have not finished")
    extrapolated = MethodValues(values[fine], values[coarse], fine.value / coarse.value)

    def band(quantity: ChartQuantity) -> float:
        rows = np.arange(extrapolated.size)
        return quantity.distance(
            replace(extrapolated, coarse=None).log(quantity, rows) - extrapolated.log(quantity, rows)
        )

    return extrapolated, band


def points(problem: ChartProblem, outcome: Outcome) -> list[Point]:
    """Every configuration and every quantity, and every pair of grids extrapolated, its costs added."""
    configurations = configurations_of(problem)
    timed = {each: _point_fields(each, outcome, i) for i, each in enumerate(configurations)}
    values = {
        each: values_of(problem, each, outcome, i)
        for i, each in enumerate(configurations)
        if timed[each]["status"] == FINISHED
    }
    reference, band = reference_of(problem, values)
    rows: list[Point] = []
    for quantity in problem.quantities:
        unit = "dB" if quantity.decibel else "%"
        chart: dict[str, Any] = {"scene": problem.name, "quantity": quantity.name, "unit": unit, "band": band(quantity)}

        def with_error(point: Point, answer: MethodValues, quantity: ChartQuantity = quantity) -> Point:
            off = error(quantity, answer, reference)
            return replace(point, error=off.value, half_width=off.half_width, over=off.over)

        blank = {each: Point(**chart, **facts) for each, facts in timed.items()}
        for each, point in blank.items():
            if each not in values:
                rows.append(point)
            elif not set(quantity.needs) <= values[each].keys():
                rows.append(replace(point, status=f"{OUT_OF_RANGE}: it does not have this quantity"))
            else:
                rows.append(with_error(point, MethodValues(values[each], paired=each.paired)))
        for coarse, fine in problem.pairs():
            if coarse in values and fine in values:
                pair = MethodValues(values[fine], values[coarse], fine.value / coarse.value)
                rows.append(with_error(_extrapolated_point(blank[coarse], blank[fine]), pair))
    return rows


def _point_fields(configuration: Configuration, outcome: Outcome, i: int) -> dict[str, Any]:
    """Return the fields of a point that do not depend on the quantity: method, setting, status and times."""
    seconds, same = outcome[f"seconds {i}"], ("parameter", "value", "is_reference")
    return {
        "method": configuration.label,
        **{name: getattr(configuration, name) for name in same},
        "is_model": not configuration.paired,
        "status": str(outcome["status"][i]),
        "seconds": tuple(np.quantile(seconds, (0.25, 0.5, 0.75)).tolist()),
        "runs": seconds.size,
        "setup": float(outcome["setup"][i]),
    }


def _extrapolated_point(coarse: Point, fine: Point) -> Point:
    """Return the point of a pair of grids: both solves are paid for, the fewest runs of the two count."""
    low, median, high = (x + y for x, y in zip(coarse.seconds, fine.seconds, strict=True))
    runs, setup = min(coarse.runs, fine.runs), coarse.setup + fine.setup
    return replace(fine, method=EXTRAPOLATED, seconds=(low, median, high), runs=runs, setup=setup)
