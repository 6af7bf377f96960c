"""A model on a scene: realisations are solved until the sample is small enough, and other grids tell the grid error."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.scenes.load import Scene
from validation.selection.hierarchy import Answer
from validation.simulation.method import Resolution, Result
from validation.simulation.model import Cost, ErrorEstimate, GridModel, Model, Sampling, Target, models_serving
from validation.simulation.resolution import too_few
from validation.simulation.sampling import mean_error, realisations

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class SceneModel:
    """A model at one of its resolutions, with what is asked of it."""

    model: Model
    target: Target
    resolution: Resolution

    @property
    def kind(self) -> str:
        """The name of the model, its resolution apart."""
        return self.model.name

    @property
    def name(self) -> str:
        return self.model.label(self.resolution) if isinstance(self.model, GridModel) else self.kind

    @cached_property
    def sampling(self) -> Sampling:
        """A single solve, but for boundary elements."""
        return self.model.sampling(self.target) if isinstance(self.model, GridModel) else Sampling()

    @property
    def solves(self) -> int:
        """So many are expected to leave half of the tolerance."""
        plan = self.sampling
        return realisations(plan.scatter, self.target.tolerance / 2, least=plan.fewest, most=plan.most)

    @cached_property
    def references(self) -> tuple[Resolution, ...]:
        return self.model.references(self.target, self.resolution) if isinstance(self.model, GridModel) else ()

    def estimate(self) -> ErrorEstimate:
        return self.model.estimate(self.target, self.resolution)

    def cost(self) -> Cost:
        return self._cost(self.solves)

    def solve(self) -> Answer:
        """Model error as expected; sample and grid error from what was computed."""
        expected, found = self.estimate(), self._drawn()
        results = [*found]
        others = []
        for resolution in self.references:
            solve = self.model.prepare(self.target, resolution)
            others.append([solve(i)() for i in range(min(len(found), self.sampling.compared))])
            results += others[-1]
        cost = self._cost(len(found))
        if failed := next((result.failed for result in results if result.failed), ""):
            return Answer(value=np.array([np.nan]), cost=cost, failed=failed)
        values = self._rows(found)
        value, sample = self._mean(values)
        grid, reason = 0.0, expected.reason
        if isinstance(self.model, GridModel):
            on_others = np.array([self._rows(other) for other in others])
            grid, reason = self.model.grid_error(self.target, self.resolution, values, on_others)
        return Answer(
            value=value,
            cost=cost,
            model=expected.model + self.model.left_out(self.target, value),
            grid=grid,
            sample=sample,
            reason=reason,
            failed=self._too_few(found)
            or ("" if np.isfinite(grid) else f"{reason}; no less than the step before did: no error estimate"),
        )

    def _drawn(self) -> list[Result]:
        """Solve by solve, until the sample leaves half of the tolerance, or one has failed."""
        solve, found = self.model.prepare(self.target, self.resolution), list[Result]()
        while len(found) < self.sampling.most:
            found.append(solve(len(found))())
            if found[-1].failed:
                break
            if len(found) >= self.sampling.fewest and self._mean(self._rows(found))[1] <= self.target.tolerance / 2:
                break
        return found

    def _rows(self, results: list[Result]) -> FloatArray:
        """(realisations, numbers)."""
        return np.concatenate([result.values[self.target.quantity].reshape(result.count, -1) for result in results])

    def _mean(self, rows: FloatArray) -> tuple[FloatArray, float]:
        """Of a stiffness itself, of levels of their logarithms; and what the sample leaves of it."""
        if len(rows) == 1:
            return rows[0], 0.0
        if self.target.quantity == "stiffness":
            mean = rows.mean(axis=0)
            return mean, mean_error(rows / mean)
        return np.exp(np.log(rows).mean(axis=0)), mean_error(np.log(rows))

    def _too_few(self, found: list[Result]) -> str:
        counts = [result.values["in contact"] for result in found if "in contact" in result.values]
        return too_few(float(np.median(counts)), self.model.element) if counts else ""

    def _cost(self, solves: int) -> Cost:
        """Of so many, and of the first of them on other grids."""
        one, compared = self.model.cost(self.target, self.resolution), min(solves, self.sampling.compared)
        others = [self.model.cost(self.target, resolution) for resolution in self.references]
        return Cost(
            work=solves * one.work + compared * sum(other.work for other in others),
            unit=one.unit,
            seconds=solves * one.seconds + compared * sum(other.seconds for other in others),
        )


def models_on(scene: Scene, quantity: str, tolerance: float, seed: int) -> list[SceneModel]:
    """All models of a quantity at all of their resolutions, the cheapest first."""
    target = Target(scene, quantity, tolerance, seed)
    found = [
        SceneModel(model, target, resolution)
        for model in models_serving(scene, quantity)
        for resolution in model.resolutions(target)
    ]
    return sorted(found, key=lambda one: one.cost().seconds)
