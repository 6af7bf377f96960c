"""How wrong an answer is, with its interval: beside what is exact, or beside the finest grids of the same roughness."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import jackknife_error, student
from validation.benchmarks.timing import FINISHED, OUT_OF_RANGE, Configuration
from validation.benchmarks.work_precision.pareto import Point
from validation.benchmarks.work_precision.problem import (
    EXTRAPOLATED,
    ChartProblem,
    Quantity,
    configurations_of,
    values_by_configuration,
)
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Outcome
from validation.simulation.method import FloatArray, Values

IntArray = NDArray[np.int64]
Found = Mapping[Configuration, Values]


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
        """Realisations."""
        return len(next(iter(self.fine.values())))

    def log(self, quantity: Quantity, rows: IntArray) -> FloatArray:
        """ln q of these realisations; extrapolated, ln q_f + (ln q_f - ln q_c) / (ratio^order - 1)."""
        fine = quantity.log(_rows(self.fine, rows))
        if self.coarse is None:
            return fine
        change = fine - quantity.log(_rows(self.coarse, rows))
        return np.asarray(fine + change / (self.ratio**quantity.order - 1))


def _rows(values: Values, rows: IntArray) -> Values:
    return {name: value[rows] for name, value in values.items()}


@dataclass(frozen=True)
class Error:
    """value: relative or in dB; half_width: of the interval of 95 % that the sample leaves; over: the reference, NaN
    for more than one number."""

    value: float
    half_width: float
    over: float


def error(quantity: Quantity, mine: MethodValues, reference: MethodValues) -> Error:
    """How far an answer is from the reference; its interval by leaving out one realisation after the other.

    Paired, of both at once: what the realisation has of its own drops out. Otherwise of either by itself.
    """
    rows = np.arange(mine.size)
    theirs = rows if mine.paired and reference.size > 1 else np.arange(reference.size)

    def ratio(rows: IntArray, theirs: IntArray) -> FloatArray:
        return mine.log(quantity, rows) - reference.log(quantity, theirs)

    def off(rows: IntArray, theirs: IntArray) -> float:
        """With the sign of a single number: one that happens to lie on the reference scatters as much as any other."""
        log_ratio = ratio(rows, theirs)
        return quantity.distance(log_ratio) * (math.copysign(1.0, log_ratio[0]) if log_ratio.size == 1 else 1.0)

    if mine.paired:
        both = [off(np.delete(rows, i), np.delete(theirs, i)) for i in rows] if mine.size > 1 else []
        half_width = _half_width(both)
    else:
        half_width = math.hypot(
            _half_width([off(np.delete(rows, i), theirs) for i in rows] if mine.size > 1 else []),
            _half_width([off(rows, np.delete(theirs, i)) for i in theirs] if reference.size > 1 else []),
        )
    log_ratio = ratio(rows, theirs)
    over = float(np.exp(log_ratio[0])) if log_ratio.size == 1 else math.nan
    return Error(quantity.distance(log_ratio), half_width, over)


def _half_width(without: list[float]) -> float:
    """Student's quantile times the jackknife's error; zero of a single value, which has no sample; infinite where two
    are too few for what is asked, as one is for a deviation."""
    if not without:
        return 0.0
    if not np.isfinite(without).all():
        return math.inf
    return float(student(len(without) - 1) * jackknife_error(without))


def reference_of(problem: ChartProblem, found: Found) -> tuple[MethodValues, Callable[[Quantity], float]]:
    """The reference, and its uncertainty for each quantity.

    Exact ones have what the quantity says. Others are extrapolated from the two finest grids, and the whole step from
    the finer of them is left open: enough for every order of convergence above 0.6.
    Raises NotConvergedError where one of these grids has not finished.
    """
    given = problem.reference()
    if not isinstance(given, tuple):
        return MethodValues(given), lambda quantity: quantity.band
    coarse, fine = given
    if not (coarse in found and fine in found):
        raise NotConvergedError(f"{problem.name}: the grids of the reference have not finished")
    answer = MethodValues(found[fine], found[coarse], fine.value / coarse.value)

    def band(quantity: Quantity) -> float:
        rows = np.arange(answer.size)
        return quantity.distance(replace(answer, coarse=None).log(quantity, rows) - answer.log(quantity, rows))

    return answer, band


def points(problem: ChartProblem, outcome: Outcome) -> list[Point]:
    """Every configuration and every quantity, and every pair of grids extrapolated, its costs added."""
    configurations = configurations_of(problem)
    status = [str(s) for s in outcome["status"]]
    found = values_by_configuration(problem, outcome)
    reference, band = reference_of(problem, found)
    costs = {a: _cost(outcome, i) for i, a in enumerate(configurations)}
    rows: list[Point] = []
    for quantity in problem.quantities:
        blank = Point(
            scene=problem.name,
            quantity=quantity.name,
            unit="dB" if quantity.decibel else "%",
            band=band(quantity),
        )
        rows += [
            _point(replace(blank, **costs[a]), a, s, quantity, found.get(a), reference)
            for a, s in zip(configurations, status, strict=True)
        ]
        for coarse, fine in problem.pairs():
            if coarse in found and fine in found:
                both = MethodValues(found[fine], found[coarse], fine.value / coarse.value)
                rows.append(_extrapolated(blank, costs, coarse, fine, error(quantity, both, reference)))
    return rows


def _cost(outcome: Outcome, i: int) -> dict[str, Any]:
    low, median, high = np.quantile(outcome[f"seconds {i}"], (0.25, 0.5, 0.75)).tolist()
    return {
        "seconds": (low, median, high),
        "runs": outcome[f"seconds {i}"].size,
        "setup": float(outcome["setup"][i]),
        "work": float(outcome["work"][i]),
    }


def _point(
    blank: Point,
    configuration: Configuration,
    status: str,
    quantity: Quantity,
    values: Values | None,
    reference: MethodValues,
) -> Point:
    named = replace(
        blank,
        method=configuration.label,
        parameter=configuration.parameter,
        value=configuration.value,
        is_reference=configuration.is_reference,
        status=status,
    )
    if values is None:
        return named
    if not set(quantity.needs) <= values.keys():
        return replace(named, status=f"{OUT_OF_RANGE}: it does not have this quantity")
    found = error(quantity, MethodValues(values, paired=configuration.paired), reference)
    return replace(named, error=found.value, half_width=found.half_width, over=found.over)


def _extrapolated(
    blank: Point,
    costs: Mapping[Configuration, Mapping[str, Any]],
    coarse: Configuration,
    fine: Configuration,
    found: Error,
) -> Point:
    one, other = (replace(blank, **costs[a]) for a in (coarse, fine))
    low, median, high = (x + y for x, y in zip(one.seconds, other.seconds, strict=True))
    return replace(
        blank,
        method=EXTRAPOLATED,
        parameter=fine.parameter,
        value=fine.value,
        status=FINISHED,
        seconds=(low, median, high),
        runs=min(one.runs, other.runs),
        setup=one.setup + other.setup,
        work=one.work + other.work,
        error=found.value,
        half_width=found.half_width,
        over=found.over,
    )
