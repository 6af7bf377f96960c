"""The cheapest model that a scene needs, from closed forms to fine boundary elements."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from validation.engine.convergence import NotConvergedError, as_not_converged
from validation.simulation.model import Cost, ErrorEstimate

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a model has found.

    value: positive, one number, or one a band; model, grid, sample: relative half-widths of 95 % that are left open,
    of all numbers together, see `distance`; cost: of what was done, not of what was expected; reason: what the error
    rests on; failed: why it is none, empty where it is one; band_errors: half-widths of model, grid and sample in each
    band [dB], empty where they are known of all bands together alone; counted: the bands in which the tolerance counts;
    seconds: that its solves took by the clock, also those that another model shares; NaN where no clock ran.
    """

    value: FloatArray
    cost: Cost
    model: float = 0.0
    grid: float = 0.0
    sample: float = 0.0
    reason: str = ""
    failed: str = ""
    band_errors: Mapping[str, FloatArray] = field(default_factory=dict)
    counted: str = ""
    seconds: float = math.nan

    @property
    def error(self) -> float:
        """Of the model, and of a grid and a sample, which are independent; infinite for what has failed."""
        return math.inf if self.failed else self.model + math.hypot(self.grid, self.sample)

    @property
    def error_in_bands(self) -> FloatArray:
        """The same in each band [dB]."""
        return np.asarray(self.band_errors["model"] + np.hypot(self.band_errors["grid"], self.band_errors["sample"]))


class ContactModel(Protocol):
    """A model of a scene, with what it costs, when it claims to hold, and how to ask it."""

    @property
    def kind(self) -> str:
        """What kind of model it is, its resolution apart."""

    @property
    def is_mdr(self) -> bool:
        """Whether its springs are the method of dimensionality reduction."""

    @property
    def name(self) -> str: ...

    def cost(self) -> Cost:
        """Expected, before anything is computed."""

    def estimate(self) -> ErrorEstimate:
        """Expected, before anything is computed."""

    def solve(self) -> Answer:
        """Compute, and estimate the error from what was computed."""


Status = Literal["accepted", "not accurate enough", "skipped", "not needed", "failed", "out of range", "not asked"]
REFUSALS = (ValueError, ArithmeticError, MemoryError, NotConvergedError)
"""What a solve raises where it has no answer to a scene; it is a row of the table, and the other models go on."""


@dataclass(frozen=True)
class Candidate:
    """A model of the hierarchy, its status, and the reason for it."""

    model: ContactModel
    status: Status
    reason: str
    estimate: ErrorEstimate
    answer: Answer | None = None

    @property
    def name(self) -> str:
        return self.model.name

    @property
    def claimed(self) -> float:
        """Relative half-width of 95 % that was estimated before any solve; infinite where none is known."""
        return self.estimate.error

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
        """The accepted model, or else the one with the smallest error; None where no answer has a known error."""
        accepted = [candidate for candidate in self.solved if candidate.status == "accepted"]
        known = [candidate for candidate in self.solved if math.isfinite(candidate.error)]
        return accepted[0] if accepted else min(known, key=_error, default=None)

    @property
    def solved(self) -> tuple[Candidate, ...]:
        """The models that have an answer."""
        return tuple(one for one in self.candidates if one.answer is not None and not one.answer.failed)

    @property
    def spent(self) -> float:
        """Seconds of all that the models did that were asked."""
        return sum(candidate.answer.cost.seconds for candidate in self.candidates if candidate.answer is not None)


def select_model(
    models: Sequence[ContactModel],
    tolerance: float,
    *,
    callback: Callable[[ContactModel], None] = lambda _: None,
    solve_all: bool = False,
    only: Sequence[ContactModel] | None = None,
    beyond: Callable[[ContactModel], bool] = lambda _: False,
) -> Selection:
    """Solve with models from the cheapest on, until the error of one is within the tolerance.

    models: in the order of their cost; tolerance: relative, positive; callback: called with each model
    before its solve; solve_all: whether those that were not needed or skipped are solved, too, which selects no other
    model; only: of these, None for all; beyond: which of those out of range are solved, too, where all are: the errors
    of their answers stay unknown. A model without an estimate is out of range and not solved; one that expects to
    miss the tolerance is skipped. Where all miss it, the skipped one with the smallest estimate is solved, too, as
    long as that is below the errors of the others; where the scene alone leaves more, the cheapest, and no other. A
    solve that raises one of `REFUSALS` has failed.
    Raises ValueError for a tolerance that is not finite and positive.
    """
    if not (math.isfinite(tolerance) and tolerance > 0):
        raise ValueError(f"tolerance must be finite and positive, got {tolerance}")
    candidates: list[Candidate] = []
    for model in models:
        expected = model.estimate()
        if only is not None and not any(model is one for one in only):
            candidates.append(Candidate(model, "not asked", expected.reason, expected))
        elif not expected.in_range:
            candidates.append(Candidate(model, "out of range", expected.reason, expected))
        elif any(candidate.status == "accepted" for candidate in candidates):
            candidates.append(Candidate(model, "not needed", expected.reason, expected))
        elif expected.error > tolerance:
            candidates.append(Candidate(model, "skipped", expected.reason, expected))
        else:
            callback(model)
            candidates.append(_solved(model, expected, tolerance))
    selection = Selection(tolerance, tuple(candidates))
    selection = selection if selection.met else _with_least_estimate(selection, callback)
    return _with_all_solved(selection, callback, beyond) if solve_all else selection


def needed(models: Sequence[ContactModel], tolerance: float) -> ContactModel | None:
    """The first model that expects to be enough, without asking it; None where none does."""
    return next((model for model in models if model.estimate().error <= tolerance), None)


def try_to_solve(model: ContactModel) -> Answer:
    try:
        with as_not_converged():
            return model.solve()
    except REFUSALS as problem:
        return Answer(value=np.array([np.nan]), cost=model.cost(), failed=str(problem) or type(problem).__name__)


def _solved(model: ContactModel, expected: ErrorEstimate, tolerance: float) -> Candidate:
    answer = try_to_solve(model)
    if answer.failed:
        return Candidate(model, "failed", answer.failed, expected, answer)
    status: Status = "accepted" if answer.error <= tolerance else "not accurate enough"
    return Candidate(model, status, answer.reason, expected, answer)


def _with_least_estimate(selection: Selection, callback: Callable[[ContactModel], None]) -> Selection:
    candidates = selection.candidates
    # of equal estimates the dearest, which has the finest grid
    skipped = [i for i in reversed(range(len(candidates))) if candidates[i].status == "skipped"]
    if all(candidates[i].estimate.of_scene > selection.tolerance for i in skipped):
        skipped = skipped[-1:] if selection.best is None else []
    least = min(skipped, key=lambda i: candidates[i].estimate.error, default=None)
    if least is None or not candidates[least].estimate.error < (_error(selection.best) if selection.best else math.inf):
        return selection
    callback(candidates[least].model)
    solved = _solved(candidates[least].model, candidates[least].estimate, selection.tolerance)
    # what it found may be more than another claims
    more = Selection(selection.tolerance, (*candidates[:least], solved, *candidates[least + 1 :]))
    return _with_least_estimate(more, callback)


def _with_all_solved(
    selection: Selection, callback: Callable[[ContactModel], None], beyond: Callable[[ContactModel], bool]
) -> Selection:
    candidates = []
    for one in selection.candidates:
        if one.status in ("skipped", "not needed") or (one.status == "out of range" and beyond(one.model)):
            callback(one.model)
            answer = try_to_solve(one.model)
            status: Status = "failed" if answer.failed else one.status
            one = replace(one, answer=answer, status=status, reason=answer.failed or answer.reason or one.reason)
        candidates.append(one)
    return Selection(selection.tolerance, tuple(candidates))


def _error(candidate: Candidate) -> float:
    return candidate.answer.error if candidate.answer else math.inf
