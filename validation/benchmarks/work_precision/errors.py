"""How wrong an answer is, with its interval: beside what is exact, or beside the finest grids of the same roughness."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import jackknife_error, student
from validation.benchmarks.timing import FINISHED, OUT_OF_RANGE, Configuration, configurations_of
from validation.benchmarks.work_precision.pareto import Point
from validation.benchmarks.work_precision.problem import EXTRAPOLATED, ChartProblem, ChartQuantity, values_of
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import NotConvergedError
from validation.simulation.method import Values

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
