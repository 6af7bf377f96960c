"""The cheapest model that a scene needs, from closed forms to fine boundary elements."""

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from validation.advice.scene_model import Answer, SceneModel
from validation.analysis.escapes import one_line, shortened_text
from validation.analysis.number_text import short
from validation.engine.realisations import NotConvergedError, as_not_converged
from validation.simulation.model import ErrorEstimate

ALIKE = 2.0
"""Ratio of two errors that a sample may feign: the scatter of eight surfaces, the fewest, is known within this factor
(7 / chi², the 2.5 % quantile of seven degrees of freedom being 1.69: sqrt(7 / 1.69) = 2.04)."""


def bias(answer: Answer) -> tuple[float, float]:
    """By which models whose errors are alike are ordered: what the model leaves, and of equal ones all that is left."""
    return answer.model, answer.error


def contradict(first: Answer, second: Answer, tolerance: float) -> bool:
    """Whether the 95 % intervals of two answers lie apart, and their values by more than the tolerance (relative).

    Of numbers with errors in each band in any band in which the tolerance counts, else by the root mean square of the
    logarithms. An unknown error contradicts nothing.
    """
    difference = np.abs(np.log(first.value / second.value))
    if first.band_errors and second.band_errors:
        half_widths = (first.error_in_bands + second.error_in_bands) * math.log(10) / 20
        counts = np.array(first.counts or [True] * difference.size) & np.array(
            second.counts or [True] * difference.size
        )
    else:
        difference = np.sqrt(np.mean(difference**2, keepdims=True))
        half_widths, counts = np.array([math.log1p(first.error) + math.log1p(second.error)]), np.array([True])
    return bool((counts & (difference > half_widths) & (difference > math.log1p(tolerance))).any())


def distance_of(first: Answer, second: Answer) -> float:
    """Relative difference, the largest of the bands in which the tolerance counts, else the root mean square."""
    difference = np.abs(np.log(first.value / second.value))
    if first.band_errors and second.band_errors and first.counts:
        return math.expm1(float(difference[np.array(first.counts)].max(initial=0.0)))
    return math.expm1(float(np.sqrt(np.mean(difference**2))))


Status = Literal["accepted", "not accurate enough", "skipped", "not needed", "failed", "out of range", "not asked"]


def percent(error: float) -> str:
    """A relative error in per cent, two digits."""
    return f"{short(100 * error)} %"


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

    def __repr__(self) -> str:
        error = f"error {percent(self.error)}" if math.isfinite(self.error) else "error unknown"
        return one_line(f"Candidate({shortened_text(self.name)!r}, {self.status}, {error})")

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
    def predicted_error(self) -> float:
        """Relative half-width of 95 % that was estimated before any solve; infinite where none is known."""
        return self.estimate.error

    @property
    def claimed(self) -> float:
        """`predicted_error` by its name of version 0.3."""
        warnings.warn("claimed of a model is predicted_error now", FutureWarning, stacklevel=2)
        return self.predicted_error

    @property
    def solved_answer(self) -> Answer:
        """The answer of a model that was solved. Raises ValueError for another."""
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

    def __repr__(self) -> str:
        best = f"{shortened_text(self.best.name)!r}" if self.best else "no model"
        within = "within" if self.met else "not within"
        return f"Selection({best} {within} {percent(self.tolerance)}, {len(self.candidates)} models)"

    @property
    def met(self) -> bool:
        return any(candidate.status == "accepted" for candidate in self.candidates)

    @property
    def best(self) -> Candidate | None:
        """The accepted model, or else the least biased of those whose errors are alike the smallest.

        None where no answer has a known error.
        """
        accepted = [candidate for candidate in self.solved if candidate.status == "accepted"]
        alike = [candidate for candidate in self.with_error if candidate.error <= ALIKE * self.least_error]
        return (
            accepted[0] if accepted else min(alike, key=lambda candidate: bias(candidate.solved_answer), default=None)
        )

    @property
    def with_error(self) -> tuple[Candidate, ...]:
        """The models that have an answer with an error."""
        return tuple(candidate for candidate in self.solved if math.isfinite(candidate.error))

    @property
    def least_error(self) -> float:
        """The smallest error of `with_error`; infinite where that is empty."""
        return min((candidate.error for candidate in self.with_error), default=math.inf)

    @property
    def solved(self) -> tuple[Candidate, ...]:
        """The models that have an answer."""
        return tuple(
            candidate for candidate in self.candidates if candidate.answer is not None and not candidate.answer.failed
        )

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
    where one of them contradicts the selected; only: the models that may be solved, None for all; also: which are
    solved like this in any case; beyond: which of those out of range are solved, too, where all are: the errors of
    their answers stay unknown. A model without an estimate is out of range and not solved; one that expects to miss
    the tolerance is skipped. Where all miss it, the skipped one with the smallest estimate is solved, too, as long as
    that is below the errors of the others; where the scene alone leaves more, the cheapest, and no other. A solve that
    raises one of `REFUSALS` has failed.
    """
    selection = Selection(tolerance, ())
    for model in models:
        candidate = _unsolved_candidate(model, selection.met, only is None or any(model is chosen for chosen in only))
        if candidate.status == "skipped" and candidate.predicted_error <= tolerance:
            candidate = _solve_candidate(candidate, callback, tolerance)
        selection = Selection(tolerance, (*selection.candidates, candidate))
    # the error of an answer may be more than another model claims
    while not selection.met and (least := _most_promising_skipped(selection)) is not None:
        candidates = [
            _solve_candidate(candidate, callback, tolerance) if candidate is least else candidate
            for candidate in selection.candidates
        ]
        selection = Selection(tolerance, tuple(candidates))

    def is_left(candidate: Candidate) -> bool:
        return candidate.status in ("skipped", "not needed") or (
            candidate.status == "out of range" and beyond(candidate.model)
        )

    def is_shown(candidate: Candidate) -> bool:
        return is_left(candidate) and (solve_all or also(candidate.model))

    candidates = [
        _solve_candidate(candidate, callback) if is_shown(candidate) else candidate
        for candidate in selection.candidates
    ]
    return without_contradiction(Selection(tolerance, tuple(candidates)))


def rejected(selection: Selection, reason: str) -> Selection:
    """The selection without an accepted model, for a reason that the scene has."""
    rows = [
        replace(candidate, status="not accurate enough", reason=f"{reason}; {candidate.reason}")
        if candidate.status == "accepted"
        else candidate
        for candidate in selection.candidates
    ]
    return replace(selection, candidates=tuple(rows))


def contradicting(selection: Selection, candidate: Candidate) -> Candidate | None:
    """The least biased of the solved models that are less biased than this candidate and contradict it, or None."""
    if not any(candidate is other for other in selection.with_error):
        return None
    less_biased = [
        other
        for other in selection.with_error
        if other is not candidate and bias(other.solved_answer) < bias(candidate.solved_answer)
    ]
    against = [
        other for other in less_biased if contradict(candidate.solved_answer, other.solved_answer, selection.tolerance)
    ]
    return min(against, key=lambda other: bias(other.solved_answer), default=None)


def without_contradiction(selection: Selection) -> Selection:
    """No model is selected that another one contradicts which is less biased: that one is, where its error allows."""
    while (best := selection.best) is not None and best.status == "accepted":
        if (better := contradicting(selection, best)) is None:
            return selection
        distance = distance_of(best.solved_answer, better.solved_answer)
        reason = (
            f"{better.name}, with less bias, is {100 * distance:.2g} % away, beyond the errors of both; {best.reason}"
        )
        accepted: Status = "accepted" if better.error <= selection.tolerance else "not accurate enough"
        changed = {id(best): ("not accurate enough", reason), id(better): (accepted, better.reason)}
        rows = [
            (candidate, changed.get(id(candidate), (candidate.status, candidate.reason)))
            for candidate in selection.candidates
        ]
        selection = replace(
            selection, candidates=tuple(replace(candidate, status=row[0], reason=row[1]) for candidate, row in rows)
        )
    return selection


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


def _unsolved_candidate(model: SceneModel, met: bool, selectable: bool) -> Candidate:
    """A candidate before its solve. met: whether a cheaper model is enough; selectable: whether it may be solved."""
    expected = model.estimate()
    passed: dict[Status, bool] = {"not asked": not selectable, "out of range": not expected.in_range, "not needed": met}
    status: Status = next((name for name, holds in passed.items() if holds), "skipped")
    return Candidate(model, status, expected.reason, expected)


def _solve_candidate(
    candidate: Candidate, callback: Callable[[SceneModel], None], tolerance: float | None = None
) -> Candidate:
    """A candidate with its answer. tolerance: None for a model that is shown with the others, and not selected."""
    callback(candidate.model)
    answer = try_to_solve(candidate.model)
    if answer.failed:
        return replace(candidate, status="failed", reason=answer.failed, answer=answer)
    if tolerance is None:
        return replace(candidate, reason=answer.reason or candidate.reason, answer=answer)
    status: Status = "accepted" if answer.error <= tolerance else "not accurate enough"
    return replace(candidate, status=status, reason=answer.reason, answer=answer)


def _most_promising_skipped(selection: Selection) -> Candidate | None:
    """The skipped model of the smallest predicted error, if that is below the errors of all solved ones; else None.

    Of equal ones the dearest (finest grid). Where no predicted error is within the tolerance: the dearest alone, and
    none once a model has been selected.
    """
    skipped = [candidate for candidate in reversed(selection.candidates) if candidate.status == "skipped"]
    if all(candidate.estimate.of_scene > selection.tolerance for candidate in skipped):
        skipped = skipped[-1:] if selection.best is None else []
    least = min(skipped, key=lambda candidate: candidate.predicted_error, default=None)
    return least if least and least.predicted_error < selection.least_error else None
