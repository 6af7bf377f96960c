"""Boundary elements under a rolling wheel, over linear theory on the same strips, times what that expects."""

import math

import numpy as np
from numpy.typing import NDArray

from validation.scenes.rolling import RollingScene
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, GridModel, Sampling, Target
from validation.simulation.rolling_claims import CELL, POSITION
from validation.simulation.rolling_levels import FINE, LEAST, RollingGrid, on_boundary_elements
from validation.simulation.sampling import distance

FloatArray = NDArray[np.float64]

STRIP_RMS, STRIP_BANDS = 0.35, 0.7
"""Scatter of one strip over linear theory on itself, over h/d: how many strips are expected."""
MOST_CELLS = 64
"""To a contact radius, on the finest grid that is offered."""
OF_COARSE, OF_FINE = 1.8, 0.8
"""Error over the change between two grids in the ratio 1.5, of second order: of the coarse one, of the fine one."""
FEWEST_STRIPS, MOST_STRIPS = 4, 10
MOST_ON_A_STRIP = 2**26
"""Cells that are drawn at once at the most; they take up to four gigabytes."""
COARSE = 2.5
"""Cells to the shortest wave on the coarse grid."""


class BoundaryElementsRolling(GridModel):
    """A contact a cell, on two grids, each of which tells what the other leaves open; heights are rolled themselves."""

    def serves(self, scene: object, quantity: str) -> bool:
        return isinstance(scene, RollingScene) and quantity != "stiffness"

    def label(self, resolution: Resolution) -> str:
        return f"{self.name}, a = {resolution.size:g} cells"

    def resolutions(self, target: Target) -> tuple[Resolution, ...]:
        radii = target.rolling.q_max * target.scene.contact_radius / (2 * math.pi)
        coarse = min(max(LEAST, math.ceil(COARSE * radii)), MOST_CELLS * 2 // 3)
        fine = min(max(math.ceil(1.5 * coarse), math.ceil(FINE * radii)), MOST_CELLS)
        return Resolution(size=coarse), Resolution(size=fine)

    def references(self, target: Target, resolution: Resolution) -> tuple[Resolution, ...]:
        return tuple(other for other in self.resolutions(target) if other != resolution)

    def sampling(self, target: Target) -> Sampling:
        """Measured heights, or strips until they leave half of the tolerance."""
        if target.scene.ground.is_single:
            return Sampling(compared=1)
        return Sampling(scatter=_scatter(target), fewest=FEWEST_STRIPS, most=MOST_STRIPS, compared=1)

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        """Cells of the window times applications times positions of a strip."""
        grid = RollingGrid.of(target.rolling, round(resolution.size))
        return Cost(work=grid.work, unit="cell applications", seconds=CELL * grid.work + POSITION * grid.along)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        """Of the sample what as many strips as there may be leave at the least; only a solve tells of the grid."""
        if reason := target.rolling.unsteady or self._too_large(target):
            return ErrorEstimate.out_of_range(reason)
        return ErrorEstimate(
            sample=0.0 if target.scene.ground.is_single else _scatter(target) / math.sqrt(MOST_STRIPS),
            reason=f"sampling error of {MOST_STRIPS} strips, without the grid error",
        )

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        quantity, cells = target.rolling, round(resolution.size)
        expected = 1.0 if quantity.scene.ground.is_single else quantity.expected(one_dimensional=False)
        work = RollingGrid.of(quantity, cells).work

        def read(change: FloatArray) -> Result:
            failed = "" if np.isfinite(change).all() else "a contact along a strip did not converge"
            return Result({quantity.name: expected * np.exp(change)}, work, failed=failed)

        return lambda strip: Solve(lambda: on_boundary_elements(quantity, cells, strip, target.seed), read)

    def grid_error(
        self, target: Target, resolution: Resolution, values: FloatArray, others: FloatArray
    ) -> tuple[float, str]:
        """By the first strip."""
        (other,) = self.references(target, resolution)
        apart = distance(values[0], others[0, 0])
        return apart * (OF_COARSE if other.size > resolution.size else OF_FINE), (
            f"{_cells_to_a_wave(target, resolution):.2g} cells to the shortest wave; a = {other.size:g} cells change "
            f"the result by {apart:.1%}; strips: {len(values)}"
        )

    def _too_large(self, target: Target) -> str:
        """Why no grid that fits into memory holds the waves; empty where one does."""
        coarse, fine = self.resolutions(target)
        if (waves := _cells_to_a_wave(target, coarse)) < 2:
            return f"the shortest wave has {waves:.2g} cells on the finest grids that are offered, fewer than 2"
        grid = RollingGrid.of(target.rolling, round(fine.size))
        if grid.along * grid.across > MOST_ON_A_STRIP:
            return f"a strip needs {grid.along} x {grid.across} cells, more than {MOST_ON_A_STRIP:.2g}"
        return ""


def _scatter(target: Target) -> float:
    """Of one strip over linear theory on itself, about."""
    return float((STRIP_RMS if target.rolling.whole else STRIP_BANDS) * target.scene.roughness_ratio)


def _cells_to_a_wave(target: Target, resolution: Resolution) -> float:
    return float(2 * math.pi * resolution.size / (target.rolling.q_max * target.scene.contact_radius))


MODEL = BoundaryElementsRolling()
