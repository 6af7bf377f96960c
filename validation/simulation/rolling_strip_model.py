"""Reduced models of a wheel that rolls over a rough strip itself: over linear theory on the same strips."""

import math
from abc import abstractmethod
from dataclasses import replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.scenes.rolling import RollingScene
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Target
from validation.simulation.rolling_claims import CheapRollingModel
from validation.simulation.rolling_levels import FINE, LEAST, RollingGrid, by_linear_theory, levels_of, strip_of
from validation.simulation.rolling_quantity import RollingQuantity

FloatArray = NDArray[np.float64]

MOST_ON_A_STRIP = 2**24
"""Cells that are drawn at once at the most."""


class RollingStripModel(CheapRollingModel):
    """The mean of logarithms over strips; not for measured heights, of which there is one strip.

    strips: in one solve; per_cell: seconds that a cell of a strip takes, about.
    """

    strips: ClassVar[int]
    per_cell: ClassVar[float]
    charted: ClassVar = False

    @abstractmethod
    def force(self, scene: RollingScene, surface: FloatArray, spacing: float) -> FloatArray:
        """Along the middle of a strip [N]."""

    def serves(self, scene: object, quantity: str) -> bool:
        known = quantity in ("force-rms", "force-spectrum")
        return known and isinstance(scene, RollingScene) and not scene.ground.is_single

    def resolutions(self, target: Target) -> tuple[Resolution, ...]:
        """Cells to a contact radius."""
        shortest = target.rolling.q_max * target.scene.contact_radius / (2 * math.pi)
        return (Resolution(size=max(LEAST, math.ceil(FINE * shortest))),)

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        grid = RollingGrid.of(target.rolling, round(resolution.size))
        work = float(self.strips * grid.along * grid.across)
        return Cost(work=work, unit="cells", seconds=self.per_cell * work)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        expected, cells = super().estimate(target, resolution), self.cost(target, resolution).work / self.strips
        if expected.in_range and cells > MOST_ON_A_STRIP:
            return ErrorEstimate.out_of_range(f"a strip needs {cells:.2g} cells, more than {MOST_ON_A_STRIP:.2g}")
        return replace(expected, sample=target.tolerance / 10)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        quantity, cells = target.rolling, round(resolution.size)

        def run() -> FloatArray:
            return np.array([self._change(quantity, cells, strip, target.seed) for strip in range(self.strips)])

        def read(change: FloatArray) -> Result:
            failed = "" if np.isfinite(change).all() else "a strip has no force in some band"
            value = quantity.expected(one_dimensional=False) * np.exp(change)
            return Result({quantity.name: value}, self.cost(target, resolution).work, self.strips, failed)

        return lambda _: Solve(run, read)

    def _change(self, quantity: RollingQuantity, cells: int, strip: int, seed: int) -> FloatArray:
        """ln of levels over those of linear theory on the same strip."""
        surface, spacing = strip_of(quantity, cells, strip, seed), quantity.scene.contact_radius / cells
        found = levels_of(quantity, self.force(quantity.scene, surface, spacing), spacing)
        return np.asarray(np.log(found) - np.log(by_linear_theory(quantity, surface, spacing)))
