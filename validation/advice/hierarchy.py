"""The cheapest model that a scene needs, from closed forms to fine boundary elements."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from validation.advice.scene_model import Answer, SceneModel
from validation.engine.convergence import NotConvergedError, as_not_converged
from validation.simulation.model import ErrorEstimate

ALIKE = 2.0
"""Ratio of two errors that a sample may feign: the scatter of eight surfaces, the fewest, is known within this factor
(7 / chi², the 2.5 % quantile of seven degrees of freedom being 1.69: sqrt(7 / 1.69) = 2.04)."""


def bias(answer: Answer) -> tuple[float, float]:
    """By which models whose errors are alike are ordered: what the model leaves, and of equal ones all that is left."""
    return answer.model, answer.error


def contradict(one: Answer, other: Answer, tolerance: float) -> bool:
    """Whether the 95 % intervals of two answers lie apart, and their values by more than the tolerance (relative).

    Of numbers with errors in each band in any band in which the tolerance counts, else by the root mean square of the
    logarithms. An unknown error contradicts nothing.
    """
    apart = np.abs(np.log(one.value / other.value))
    if one.band_errors and other.band_errors:
        both = (one.error_in_bands + other.error_in_bands) * math.log(10) / 20
        counts = np.array(one.counts or [True] * apart.size) & np.array(other.counts or [True] * apart.size)
    else:
        apart = np.sqrt(np.mean(apart**2, keepdims=True))
        both, counts = np.array([math.log1p(one.error) + math.log1p(other.error)]), np.array([True])
    return bool((counts & (apart > both) & (apart > math.log1p(tolerance))).any())


def distance_of(one: Answer, other: Answer) -> float:
    """Relative, the largest of the bands in which the tolerance counts, else the root mean square."""
    apart = np.abs(np.log(one.value / other.value))
    if one.band_errors and other.band_errors and one.counts:
        return math.expm1(float(apart[np.array(one.counts)].max(initial=0.0)))
    return math.expm1(float(np.sqrt(np.mean(apart**2))))


Status = Literal["accepted", "not accurate enough", "skipped", "not needed", "failed", "out of range", "not asked"]
REFUSALS = (ValueError, ArithmeticError, MemoryError, NotConvergedError)
"""What a solve raises where it has no answer to a scene; it is a row of the table, and the other models go on."""


@dataclass(frozen=True)
class Candidate:
    """A model of the hierarchy, its status, and the reason for it."""

    model: SceneModel
    status: Status
    reason: str
    estimate: ErrorEstimate
    answer: Answer | None = None

    @property
    def name(self) -> str:
        return self.model.name

    @property
    def kind(self) -> str:
        """The name of the model, its resolution apart."""
        return self.model.kind

    @property
    def is_mdr(self) -> bool:
        return self.model.is_mdr

    @property
    def claimed(self) -> float:
        """Relative half-width of 95 % that was estimated before any solve; infinite where none is known."""
        return self.estimate.error

    @property
    def found(self) -> Answer:
        """Of a model that was solved. Raises ValueError for another."""
        if self.answer is None:
            raise ValueError(f"{self.name} was not solved")
        return self.answer

    @property
    def error(self) -> float:
        """Relative half-width of 95 %: found by a solve, or estimated before it."""
        return (self.answer or self.estimate).error

    @property
    def cost(self) -> float:
        """Seconds of the solve on one core, by a count of its operations before it."""
        return self.model.cost().seconds


@dataclass(frozen=True)
class Selection:
    """All models, in order; those above the first that met the tolerance were not needed."""

    tolerance: float
    candidates: tuple[Candidate, ...]

    @property
    def met(self) -> bool:
        return any(candidate.status == "accepted" for candidate in self.candidates)

    @property
    def best(self) -> Candidate | None:
        """The accepted model, or else the least biased of those whose errors are alike the smallest.

        None where no answer has a known error.
        """
        accepted = [candidate for candidate in self.solved if candidate.status == "accepted"]
        alike = [candidate for candidate in self.known if candidate.error <= ALIKE * self.least_error]
        return accepted[0] if accepted else min(alike, key=lambda one: bias(one.found), default=None)

    @property
    def known(self) -> tuple[Candidate, ...]:
        """The models that have an answer with an error."""
        return tuple(one for one in self.solved if math.isfinite(one.error))

    @property
    def least_error(self) -> float:
        """Of `known`; infinite of none."""
        return min((one.error for one in self.known), default=math.inf)

    @property
    def solved(self) -> tuple[Candidate, ...]:
        """The models that have an answer."""
        return tuple(one for one in self.candidates if one.answer is not None and not one.answer.failed)

    @property
    def spent(self) -> float:
        """Seconds of all that the models did that were asked."""
        return sum(candidate.answer.cost.seconds for candidate in self.candidates if candidate.answer is not None)


def select_model(
    models: Sequence[SceneModel],
    tolerance: float,
    *,
    callback: Callable[[SceneModel], None] = lambda _: None,
    solve_all: bool = False,
    only: Sequence[SceneModel] | None = None,
    also: Callable[[SceneModel], bool] = lambda _: False,
    beyond: Callable[[SceneModel], bool] = lambda _: False,
) -> Selection:
    """Solve with models from the cheapest on, until the error of one is within the tolerance.

    models: in the order of their cost; tolerance: relative, positive; callback: called with each model before its
    solve; solve_all: whether those that were not needed or skipped are solved, too, which selects another model only
    where one of them contradicts the selected; only:
    of these, None for all; also: which are solved like this in any case; beyond: which of those out of range are
    solved, too, where all are: the errors of their answers stay unknown. A model without an estimate is out of range
    and not solved; one that expects to miss the tolerance is skipped. Where all miss it, the skipped one with the
    smallest estimate is solved, too, as long as that is below the errors of the others; where the scene alone leaves
    more, the cheapest, and no other. A solve that raises one of `REFUSALS` has failed.
    """
    found = Selection(tolerance, ())
    for model in models:
        one = _expected(model, found.met, only is None or any(model is asked for asked in only))
        if one.status == "skipped" and one.claimed <= tolerance:
            one = _solved(one, callback, tolerance)
        found = Selection(tolerance, (*found.candidates, one))
    # what one finds may be more than another claims
    while not found.met and (least := _least_estimate(found)) is not None:
        candidates = [_solved(one, callback, tolerance) if one is least else one for one in found.candidates]
        found = Selection(tolerance, tuple(candidates))

    def is_left(one: Candidate) -> bool:
        return one.status in ("skipped", "not needed") or (one.status == "out of range" and beyond(one.model))

    def beside(one: Candidate) -> bool:
        return is_left(one) and (solve_all or also(one.model))

    every = tuple(_solved(one, callback) if beside(one) else one for one in found.candidates)
    return without_contradiction(Selection(tolerance, every))


def rejected(found: Selection, reason: str) -> Selection:
    """The same without a model that is accepted, for a reason that the scene has."""
    rows = [
        replace(one, status="not accurate enough", reason=f"{reason}; {one.reason}")
        if one.status == "accepted"
        else one
        for one in found.candidates
    ]
    return replace(found, candidates=tuple(rows))


def contradicting(found: Selection, one: Candidate) -> Candidate | None:
    """The least biased of the solved models that are less biased than this one and contradict it; None where none."""
    if not any(one is other for other in found.known):
        return None
    others = [other for other in found.known if other is not one and bias(other.found) < bias(one.found)]
    against = [other for other in others if contradict(one.found, other.found, found.tolerance)]
    return min(against, key=lambda other: bias(other.found), default=None)


def without_contradiction(found: Selection) -> Selection:
    """No model is selected that another one contradicts which is less biased: that one is, where its error allows."""
    while (best := found.best) is not None and best.status == "accepted":
        if (better := contradicting(found, best)) is None:
            return found
        apart = distance_of(best.found, better.found)
        reason = f"{better.name}, with less bias, is {100 * apart:.2g} % away, beyond the errors of both; {best.reason}"
        accepted: Status = "accepted" if better.error <= found.tolerance else "not accurate enough"
        changed = {id(best): ("not accurate enough", reason), id(better): (accepted, better.reason)}
        rows = [(one, changed.get(id(one), (one.status, one.reason))) for one in found.candidates]
        found = replace(found, candidates=tuple(replace(one, status=row[0], reason=row[1]) for one, row in rows))
    return found


def needed(models: Sequence[SceneModel], tolerance: float) -> SceneModel | None:
    """The first model that expects to be enough, without asking it; None where none does."""
    return next((model for model in models if model.estimate().error <= tolerance), None)


def try_to_solve(model: SceneModel) -> Answer:
    try:
        with as_not_converged():
            return model.solve()
    except REFUSALS as problem:
        return unsolved(model, problem)


def unsolved(model: SceneModel, problem: Exception) -> Answer:
    return Answer(value=np.array([np.nan]), cost=model.cost(), failed=str(problem) or type(problem).__name__)


def _expected(model: SceneModel, met: bool, asked: bool) -> Candidate:
    """Before a solve; met: whether a cheaper model is enough."""
    expected = model.estimate()
    passed: dict[Status, bool] = {"not asked": not asked, "out of range": not expected.in_range, "not needed": met}
    status: Status = next((name for name, holds in passed.items() if holds), "skipped")
    return Candidate(model, status, expected.reason, expected)


def _solved(one: Candidate, callback: Callable[[SceneModel], None], tolerance: float | None = None) -> Candidate:
    """tolerance: None for one that is seen beside the others, and not selected."""
    callback(one.model)
    answer = try_to_solve(one.model)
    if answer.failed:
        return replace(one, status="failed", reason=answer.failed, answer=answer)
    if tolerance is None:
        return replace(one, reason=answer.reason or one.reason, answer=answer)
    status: Status = "accepted" if answer.error <= tolerance else "not accurate enough"
    return replace(one, status=status, reason=answer.reason, answer=answer)


def _least_estimate(found: Selection) -> Candidate | None:
    """The one that may leave less than all that were solved; of equal estimates the dearest, with the finest grid."""
    skipped = [one for one in reversed(found.candidates) if one.status == "skipped"]
    if all(one.estimate.of_scene > found.tolerance for one in skipped):
        skipped = skipped[-1:] if found.best is None else []
    least = min(skipped, key=lambda one: one.claimed, default=None)
    return least if least and least.claimed < found.least_error else None
