"""A model on a scene: realisations are solved until the error is small enough, and other grids tell the grid error."""

import itertools
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from bem3d.results import kept
from validation.analysis.escapes import one_line
from validation.engine.engine import FloatArray
from validation.simulation.method import STUDENT, Prepared, Resolution, Result, mean_error, realisations, too_few
from validation.simulation.model import Cost, ErrorEstimate, GridModel, Model, Sampling, Target

SAMPLE_SHARE = 0.9
"""Of the tolerance, that a sample may leave where a grid of 0.44 of it is added at a right angle."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """A value that a model computes, and its error.

    value: positive, one number, or one a band; model, grid, sample: relative half-widths of 95 % that are left open,
    of all numbers together, see `distance`; cost: of what was done, not of what was expected; reason: what the error
    rests on; failed: why it is none, empty where it is one; band_errors: half-widths of model, grid and sample in each
    band [dB], empty where they are known of all bands together alone; counted: the bands in which the tolerance counts,
    in words, and counts: whether it does, one a band, empty where it counts in all together; seconds: that its solves
    took by the clock, also those that another model shares; NaN where no clock ran; realisations: of surfaces, strips
    or tracks of which it is the mean.
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
    counts: tuple[bool, ...] = ()
    seconds: float = math.nan
    realisations: int = 1

    def __post_init__(self) -> None:
        """Arrays become copies of its own that cannot be written."""
        self.__setstate__(vars(self))

    def __setstate__(self, state: dict[str, Any]) -> None:
        bands = {name: kept(half) for name, half in state["band_errors"].items()}
        self.__dict__.update({**state, "value": kept(state["value"]), "band_errors": bands})

    @property
    def error(self) -> float:
        """Of the model, and of a grid and a sample, which are independent; infinite for what has failed."""
        return math.inf if self.failed else self.model + math.hypot(self.grid, self.sample)

    @property
    def error_in_bands(self) -> FloatArray:
        """The error in each band [dB]."""
        return np.asarray(self.band_errors["model"] + np.hypot(self.band_errors["grid"], self.band_errors["sample"]))


@dataclass(eq=False)
class Realisations:
    """Realisations of a model at one resolution, each solved once, whichever candidate needs it first.

    seconds: of each by the clock, of the first with what was prepared for all.
    """

    prepare: Callable[[], Prepared]
    solved: list[Result] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)

    @cached_property
    def solve(self) -> Prepared:
        return self.prepare()

    def first(self, count: int) -> list[Result]:
        while len(self.solved) < count:
            begin = time.perf_counter()
            self.solved.append(self.solve(len(self.solved))())
            self.seconds.append(time.perf_counter() - begin)
        return self.solved[:count]


FALLS = 0.85
"""Of what a grid leaves, that twice as many surfaces must leave of it at the most where it is noise; noise falls by
0.71."""

Shared = dict[tuple[Model, Resolution], Realisations]


@dataclass(frozen=True)
class SceneModel:
    """A model at one of its resolutions, with what is asked of it.

    shared: realisations of all resolutions, which a grid and the references of another have in common; realisations:
    so many are solved where surfaces are drawn for a grid, None for as many as the tolerance takes.
    """

    model: Model
    target: Target
    resolution: Resolution
    shared: Shared = field(default_factory=dict, repr=False, compare=False)
    realisations: int | None = None

    def __repr__(self) -> str:
        return one_line(f"SceneModel({self.name!r}, {self.target.quantity})")

    def __getstate__(self) -> dict[str, Any]:
        """Without solves, whose numbers are in answers, and without what is computed from the fields."""
        return {each.name: getattr(self, each.name) for each in fields(self)} | {"shared": {}}

    @property
    def kind(self) -> str:
        """The name of the model, its resolution apart."""
        return self.model.name

    @property
    def name(self) -> str:
        return self.model.label(self.resolution) if isinstance(self.model, GridModel) else self.kind

    @property
    def is_mdr(self) -> bool:
        return self.model.is_mdr

    @cached_property
    def sampling(self) -> Sampling:
        """A single solve, but for boundary elements."""
        if not isinstance(self.model, GridModel):
            return Sampling()
        plan, count = self.model.sampling(self.target), self.realisations
        if count is None or plan.most == 1:
            return plan
        return replace(plan, fewest=count, most=count, compared=min(plan.compared, count))

    @property
    def is_sampled(self) -> bool:
        """Whether surfaces are drawn for it, as many as are asked."""
        return self.sampling.scatter > 0

    @property
    def solves(self) -> int:
        """Number of realisations that are expected to leave most of the tolerance."""
        plan = self.sampling
        if plan.fewest == plan.most or self._beyond_reach(self.estimate()):
            return plan.fewest
        return realisations(plan.scatter, SAMPLE_SHARE * self.target.tolerance, least=plan.fewest, most=plan.most)

    @cached_property
    def references(self) -> tuple[Resolution, ...]:
        return self.model.references(self.target, self.resolution) if isinstance(self.model, GridModel) else ()

    def estimate(self) -> ErrorEstimate:
        expected = self.model.estimate(self.target, self.resolution)
        if self.realisations is None or not self.is_sampled or not expected.in_range:
            return expected
        return replace(expected, sample=STUDENT * self.sampling.scatter / math.sqrt(self.realisations))

    def cost(self) -> Cost:
        """Cost of so many realisations, and of the first of them on other grids, if none is solved yet."""
        compared = min(self.solves, self.sampling.compared)
        return self._cost({self.resolution: self.solves, **dict.fromkeys(self.references, compared)})

    def solve(self) -> Answer:
        """Model error as expected; sample and grid error from what was computed.

        Realisations are added until the error is within the tolerance: on this grid where the sample leaves more, on
        those that it is compared with where the grid does, as long as its error falls by that. Where as many as there
        may be are expected to leave more than the tolerance, the fewest are solved.
        """
        if self.model.answer is not None:
            answer: Answer = self.model.answer(self)
            return answer
        expected, plan, before = self.estimate(), self.sampling, self._solved_counts()
        most = plan.fewest if self._beyond_reach(expected) else plan.most
        count, compared, earlier = plan.fewest, plan.compared, math.inf
        while True:
            answer = self._answer(expected, count, compared, before)
            tolerance = self.target.tolerance
            if answer.failed or answer.error <= tolerance or answer.model >= tolerance:
                return answer
            of_noise = plan.compared > 1 and compared < most and answer.grid <= FALLS * earlier
            if of_noise and (answer.grid > answer.sample or count == most):
                earlier, compared = answer.grid, min(2 * compared, most)
                count = max(count, compared)
            elif count < most and answer.model + answer.grid <= tolerance:
                count += 1
            else:
                return answer

    def _beyond_reach(self, expected: ErrorEstimate) -> bool:
        """Whether the sample alone is expected to leave more than the tolerance, where nobody says how many."""
        return self.realisations is None and expected.sample > self.target.tolerance

    def _answer(self, expected: ErrorEstimate, count: int, compared: int, before: dict[Resolution, int]) -> Answer:
        """The answer of ``count`` realisations, of which ``compared`` are solved on other grids, too.

        before: realisations that other candidates have solved, which this answer does not cost.
        """
        results = self.first(self.resolution, count)
        reference_results = [self.first(resolution, compared) for resolution in self.references]
        if failed := next(
            (result.failed for result in itertools.chain(results, *reference_results) if result.failed), ""
        ):
            return Answer(value=np.array([np.nan]), cost=self._spent(before), failed=failed)
        values = self._rows(results)
        value, sample = self._mean(values)
        grid, reason = 0.0, expected.reason
        if isinstance(self.model, GridModel):
            other = np.array([self._rows(result) for result in reference_results])
            grid, reason = self.model.grid_error(self.target, self.resolution, values, other)
        unknown = "" if np.isfinite(grid) else f"{reason}; no less than the step before did: no error estimate"
        return Answer(
            value=value,
            cost=self._spent(before),
            model=expected.model + self.model.left_out(self.target, value),
            grid=grid,
            sample=sample,
            reason=reason,
            failed=self._too_few(results) or unknown,
            seconds=self.seconds_of(count, compared),
            realisations=len(values),
        )

    def first(self, resolution: Resolution, count: int) -> list[Result]:
        """The first so many realisations, each solved once."""
        prepare = partial(self.model.prepare, self.target, resolution)
        return self.shared.setdefault((self.model, resolution), Realisations(prepare)).first(count)

    def _solved_counts(self) -> dict[Resolution, int]:
        """Realisations so far, of this resolution and of its references."""
        shared = [
            (resolution, self.shared.get((self.model, resolution)))
            for resolution in (self.resolution, *self.references)
        ]
        return {resolution: len(sample.solved) if sample else 0 for resolution, sample in shared}

    def seconds_of(self, count: int, compared: int = 0) -> float:
        """Seconds of so many realisations, and of those on the grids that they are compared with."""
        counts = {self.resolution: count, **dict.fromkeys(self.references, compared)}
        return sum(sum(self.shared[self.model, resolution].seconds[:solves]) for resolution, solves in counts.items())

    def _rows(self, results: list[Result]) -> FloatArray:
        """The numbers of the quantity as an array (realisations, numbers)."""
        return np.concatenate([result.values[self.target.quantity].reshape(result.count, -1) for result in results])

    def _mean(self, rows: FloatArray) -> tuple[FloatArray, float]:
        """Mean of values or of their logarithms, as the quantity is averaged, and the error that the sample leaves."""
        if len(rows) == 1:
            return rows[0], 0.0
        quantity = next(entry for entry in self.target.scene.quantities if str(entry) == self.target.quantity)
        if quantity.averaged_itself:
            mean = rows.mean(axis=0)
            return mean, mean_error(rows / mean)
        return np.exp(np.log(rows).mean(axis=0)), mean_error(np.log(rows))

    def _too_few(self, results: list[Result]) -> str:
        """Why the median of the elements in contact are too few for an answer; empty where they are enough."""
        counts = [result.values["in contact"] for result in results if "in contact" in result.values]
        return too_few(float(np.median(counts)), self.model.element) if counts else ""

    def _spent(self, before: dict[Resolution, int]) -> Cost:
        """Cost of the realisations that were solved since ``before``."""
        return self._cost(
            {resolution: count - before[resolution] for resolution, count in self._solved_counts().items()}
        )

    def _cost(self, solves: Mapping[Resolution, int]) -> Cost:
        """Cost of so many solves at each resolution."""
        costs = [(count, self.model.cost(self.target, resolution)) for resolution, count in solves.items()]
        return Cost(
            work=sum(count * cost.work for count, cost in costs),
            seconds=sum(count * cost.seconds for count, cost in costs),
        )
