"""A linear filter in three dimensions: the spectrum of the force for a contact that keeps its radius."""

import math
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.scenes.measured import OBLONG
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Target
from validation.simulation.rolling_claims import (
    FORCE_RMS,
    LINEAR_BANDS,
    LINEAR_MOVING,
    NODE,
    SECOND_ORDER,
    CheapRollingModel,
    filled,
)
from validation.simulation.rolling_levels import FINE, LEAST, by_linear_theory, strip_of
from validation.simulation.rolling_quantity import RollingQuantity
from validation.simulation.sampling import distance

WIDE = 4000.0
"""q a beyond which a quadrature across takes longer: its panels go with q a."""


class LinearFilter3D(CheapRollingModel):
    """On the half-space; of measured heights, on themselves. In one dimension the rms of the force is the same."""

    name: ClassVar = "linear filter, 3D"
    setting: ClassVar = "a contact that keeps its radius"

    bands: ClassVar = LINEAR_BANDS
    moving: ClassVar = LINEAR_MOVING
    own: ClassVar = 0.0

    def serves(self, scene: Any, quantity: str) -> bool:
        return super().serves(scene, quantity) and (quantity != FORCE_RMS or scene.ground.is_single)

    def beyond(self, target: Target) -> str:
        return str(target.scene.ground.not_gaussian())

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        """Ridges lose contact where waves in all directions do not: as much again as the gradient g a/d is left."""
        expected, ground = super().estimate(target, resolution), target.scene.ground
        if not ground.is_single or ground.texture <= OBLONG:
            return expected
        gradient = ground.gradient * target.scene.contact_radius / target.scene.approach
        reason = f"{expected.reason}; heights are anisotropic, rms gradient g a/d = {gradient:.2g}"
        return replace(expected, model=expected.model + gradient, reason=reason)

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        nodes, wide = target.rolling.nodes, target.rolling.q_max * target.scene.contact_radius
        return Cost(work=nodes, unit="quadratures", seconds=NODE * nodes * max(1.0, wide / WIDE))

    def left_out(self, target: Target, value: NDArray[np.float64]) -> float:
        """Of measured heights also what cells twice as long change; of drawn ones what fills their quiet bands."""
        if not target.scene.ground.is_single:
            return filled(target, value, SECOND_ORDER)
        return super().left_out(target, value) + distance(value, _of_heights(target.rolling, 1))

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        quantity = target.rolling
        levels = _of_heights if quantity.scene.ground.is_single else _of_spectrum

        def read(value: NDArray[np.float64]) -> Result:
            failed = "" if (value > 0).all() else "the heights have no waves in some band"
            return Result({quantity.name: value}, float(quantity.nodes), failed=failed)

        return lambda _: Solve(lambda: levels(quantity), read)


def _of_spectrum(quantity: RollingQuantity) -> NDArray[np.float64]:
    return quantity.expected(one_dimensional=False)


def _of_heights(quantity: RollingQuantity, finer: int = 2) -> NDArray[np.float64]:
    """On cells so many times finer than boundary elements need at the least."""
    a = quantity.scene.contact_radius
    cells = finer * max(LEAST, math.ceil(FINE * quantity.q_max * a / (2 * math.pi)))
    return by_linear_theory(quantity, strip_of(quantity, cells, 0, 0), a / cells)


MODEL = LinearFilter3D()
