"""The cheapest model that a scene needs: rungs from closed forms to fine boundary elements, climbed one by one."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy import stats

FloatArray = NDArray[np.float64]

STUDENT = 2.0
"""Standard errors of a 95 % interval; samples here have eight realisations or more, or say so by a wider one."""
SLOWEST = 0.8
"""Largest ratio of two changes that a sample may feign: four times the last change is then left."""
BOUNDARY_ELEMENTS = "boundary elements"
"""The model that judges all others, on whichever grid."""


@dataclass(frozen=True, kw_only=True)
class Claim:
    """What a rung says of itself before it has computed anything.

    error: relative half-width of 95 % that it expects to leave, infinite where it claims nothing; because: the
    condition that this rests on, with its numbers.
    """

    error: float
    because: str

    @classmethod
    def out_of_range(cls, because: str) -> "Claim":
        """None: the scene is not of those on which the error was measured, or the model cannot serve it at all."""
        return cls(error=math.inf, because=because)

    @property
    def in_range(self) -> bool:
        """Whether there is one."""
        return math.isfinite(self.error)


@dataclass(frozen=True, kw_only=True)
class Cost:
    """work: operations, expected or counted; unit: of them; seconds: what those take on one core, about."""

    work: float
    unit: str
    seconds: float


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a rung has found.

    value: positive, one number, or one a band; model, grid, sample: relative half-widths of 95 % that are left open,
    of all numbers together, see `distance`; cost: of what was done, not of what was expected; because: what the error
    rests on; failed: why it is none, empty where it is one.
    """

    value: FloatArray
    cost: Cost
    model: float = 0.0
    grid: float = 0.0
    sample: float = 0.0
    because: str = ""
    failed: str = ""

    @property
    def error(self) -> float:
        """All three, added as if they went the same way; infinite for what has failed."""
        return math.inf if self.failed else self.model + self.grid + self.sample


class ContactModel(Protocol):
    """A model of a scene, with what it costs, when it claims to hold, and how to ask it."""

    @property
    def model(self) -> str:
        """What kind of model it is, its resolution apart."""

    @property
    def name(self) -> str:
        """The model with its resolution, for tables."""

    def cost(self) -> Cost:
        """Expected, before anything is computed."""

    def claim(self) -> Claim:
        """Expected, before anything is computed."""

    def solve(self) -> Answer:
        """Compute, and estimate the error from what was computed."""


Fate = Literal["enough", "not enough", "skipped", "not needed", "failed", "out of range"]
REFUSALS = (ValueError, ArithmeticError, MemoryError)
"""What a solve raises where it cannot serve a scene; it is a row of the table, and the other rungs go on."""


@dataclass(frozen=True)
class Candidate:
    """A rung and what became of it."""

    rung: ContactModel
    fate: Fate
    because: str
    claim: Claim
    answer: Answer | None = None


@dataclass(frozen=True)
class Selection:
    """All rungs, in order, up to where the tolerance was met; those above were not needed."""

    tolerance: float
    steps: tuple[Candidate, ...]

    @property
    def met(self) -> bool:
        """Whether some rung was enough."""
        return any(step.fate == "enough" for step in self.steps)

    @property
    def best(self) -> Candidate | None:
        """The rung that was enough, or else the one that leaves the least error; None where none has an answer."""
        solved = [step for step in self.steps if step.answer is not None and not step.answer.failed]
        enough = [step for step in solved if step.fate == "enough"]
        return enough[0] if enough else min(solved, key=_left, default=None)

    @property
    def spent(self) -> float:
        """Seconds of all that the rungs did that were asked."""
        return sum(step.answer.cost.seconds for step in self.steps if step.answer is not None)


def select_model(
    rungs: Sequence[ContactModel], tolerance: float, *, tell: Callable[[ContactModel], None] = lambda _: None
) -> Selection:
    """Ask rungs from the cheapest on, until one leaves no more than the tolerance.

    rungs: in the order of their cost; tolerance: relative, positive; tell: is called with a rung before it is asked. A
    rung without a claim is out of range and never asked; one that expects to miss the tolerance is skipped, one that
    misses it is kept beside the next. Where all miss it, the skipped one that expects to leave the least is asked, too,
    if that is less than what others left; see `Climb.met`. A solve that raises one of `REFUSALS` has failed.
    Raises ValueError for a tolerance that is not finite and positive.
    """
    if not (math.isfinite(tolerance) and tolerance > 0):
        raise ValueError(f"tolerance must be finite and positive, got {tolerance}")
    steps: list[Candidate] = []
    for rung in rungs:
        claim = rung.claim()
        if any(step.fate == "enough" for step in steps):
            steps.append(Candidate(rung, "not needed", "a cheaper rung was enough", claim))
        elif not claim.in_range:
            steps.append(Candidate(rung, "out of range", claim.because, claim))
        elif claim.error > tolerance:
            steps.append(Candidate(rung, "skipped", claim.because, claim))
        else:
            tell(rung)
            steps.append(_asked(rung, claim, tolerance))
    climbed = Selection(tolerance, tuple(steps))
    return climbed if climbed.met else _with_the_least_claim(climbed, tell)


def needed(rungs: Sequence[ContactModel], tolerance: float) -> ContactModel | None:
    """The first rung that expects to be enough, without asking it; None where none does."""
    return next((rung for rung in rungs if rung.claim().error <= tolerance), None)


def distance(value: FloatArray, other: FloatArray) -> float:
    """sqrt(mean(ln(x / y)^2)): how far two answers are apart, over all their numbers [-]."""
    return float(np.sqrt(np.mean(np.log(value / other) ** 2)))


def mean_error(ratios: FloatArray) -> float:
    """Half-width of 95 % that a sample leaves of the mean of logarithms, of all columns together.

    ratios: logarithms, shape (realisations, numbers), two realisations at least.
    """
    of_means = ratios.std(axis=0, ddof=1) / math.sqrt(len(ratios))
    return float(_student(len(ratios)) * np.sqrt(np.mean(of_means**2)))


def grid_error(earlier: FloatArray, last: FloatArray) -> float:
    """Half-width of 95 % that a grid leaves, of the changes of the logarithm by the last two refinements.

    earlier, last: one a realisation, the same ones on all grids. The mean of the last changes, and what the sample
    leaves of it, times r / (1 - r), the rest of a geometric series, where their ratio r is above a half; infinite where
    they do not shrink and that is not for want of a larger sample: such a sequence of grids has no limit to see.
    """
    before, after = (abs(float(change.mean())) for change in (earlier, last))
    noise_before, noise = (mean_error(change[:, np.newaxis]) for change in (earlier, last))
    if after <= noise:
        return after + noise
    if after >= before + noise_before:
        return math.inf
    ratio = after / before
    if after - noise <= SLOWEST * (before + noise_before):
        ratio = min(ratio, SLOWEST)
    return (after + noise) * max(1.0, ratio / (1 - ratio)) if ratio < 1 else math.inf


def realisations(deviation: float, error: float, *, least: int = 8, most: int = 2000) -> int:
    """How many leave a mean within a relative error, 95 %: (2 s / e)^2, between two bounds.

    deviation: s, relative, of one realisation; error: e.
    """
    return int(np.clip(math.ceil((STUDENT * deviation / error) ** 2), least, most))


def counted(conditions: Mapping[str, float]) -> str:
    """Names with their numbers, for a reason."""
    return ", ".join(f"{name} = {value:.3g}" for name, value in conditions.items())


def answered(rung: ContactModel) -> Answer:
    """Its answer, or why there is none."""
    try:
        return rung.solve()
    except REFUSALS as problem:
        return Answer(value=np.array([np.nan]), cost=rung.cost(), failed=str(problem) or type(problem).__name__)


def _asked(rung: ContactModel, claim: Claim, tolerance: float) -> Candidate:
    answer = answered(rung)
    if answer.failed:
        return Candidate(rung, "failed", answer.failed, claim, answer)
    fate: Fate = "enough" if answer.error <= tolerance else "not enough"
    return Candidate(rung, fate, answer.because, claim, answer)


def _with_the_least_claim(climbed: Selection, tell: Callable[[ContactModel], None]) -> Selection:
    # of equal claims the dearest, which has the finest grid
    skipped = [i for i, step in reversed(list(enumerate(climbed.steps))) if step.fate == "skipped"]
    least = min(skipped, key=lambda i: climbed.steps[i].claim.error, default=None)
    if least is None:
        return climbed
    step, left = climbed.steps[least], climbed.best.answer.error if climbed.best and climbed.best.answer else math.inf
    if not step.claim.error < left:
        return climbed
    tell(step.rung)
    asked = _asked(step.rung, step.claim, climbed.tolerance)
    return Selection(climbed.tolerance, (*climbed.steps[:least], asked, *climbed.steps[least + 1 :]))


def _left(step: Candidate) -> float:
    return step.answer.error if step.answer else math.inf


def _student(size: int) -> float:
    return float(stats.t.ppf(0.975, size - 1))
