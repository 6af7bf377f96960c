"""Linear filters of a rolling wheel, in one dimension and in three: a contact that keeps its radius."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from validation.scenes.measured import OBLONG
from validation.simulation.method import Resolution, Result
from validation.simulation.model import Cost, ErrorEstimate, Model, Target
from validation.simulation.model_names import FILTER_1D, FILTER_3D
from validation.simulation.rolling_claims import FORCE_RMS, NODE, RollingClaim, filled, of_a_wheel
from validation.simulation.rolling_levels import FINE, LEAST, by_linear_theory, strip_of
from validation.simulation.rolling_quantity import RollingQuantity
from validation.simulation.sampling import distance

FORMULA = 1.0e-4
"""Seconds that a formula at a node takes, about."""
WIDE = 4000.0
"""q a beyond which a quadrature across takes longer: its panels go with q a."""
SECOND_ORDER = 0.1
"""Of h/d times the level of all bands: what the loss of contact puts into each band that linear theory finds quiet."""
ON_A_LINE = RollingClaim(
    bands=(2.0, 0.5, 0.55),
    on_bands="Geike's rule does not keep levels along a track",
    on_rms="Geike's rule keeps the variance of the force",
)
ON_HALF_SPACE = RollingClaim(bands=(2.0, 0.5, 0.015), moving=(1.2, 3.0, 0.0, 0.008), own=0.0, of_spectrum=False)


def formulas(target: Target, resolution: Resolution) -> Cost:
    nodes = target.rolling.nodes
    return Cost(work=nodes, seconds=FORMULA * nodes)


@ON_A_LINE.model(name=FILTER_1D, setting="Geike's spectrum", cost=formulas)
def linear_filter_1d(target: Target, resolution: Resolution) -> NDArray[np.float64]:
    """(14.12). Exact over ridges; over isotropic ground in the variance of the force alone."""
    return target.rolling.expected(one_dimensional=True)


def quadratures(target: Target, resolution: Resolution) -> Cost:
    nodes, wide = target.rolling.nodes, target.rolling.q_max * target.scene.contact_radius
    return Cost(work=nodes, seconds=NODE * nodes * max(1.0, wide / WIDE))


def claim(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """Ridges lose contact where waves in all directions do not: as much again as the gradient g a/d is left."""
    expected, ground = ON_HALF_SPACE.estimate(model, target, resolution), target.scene.ground
    if not ground.is_single or ground.texture <= OBLONG:
        return expected
    gradient = ground.gradient * target.scene.contact_radius / target.scene.approach
    reason = f"{expected.reason}; heights are anisotropic, rms gradient g a/d = {gradient:.2g}"
    return replace(expected, model=expected.model + gradient, reason=reason)


def left_out(target: Target, value: NDArray[np.float64]) -> float:
    """Of measured heights also what cells twice as long change; of drawn ones what fills their quiet bands."""
    if not target.scene.ground.is_single:
        return filled(target, value, SECOND_ORDER)
    return ON_HALF_SPACE.left_out(target, value) + distance(value, _of_heights(target.rolling, 1))


@ON_HALF_SPACE.model(
    name=FILTER_3D,
    setting="a contact that keeps its radius",
    # the rms of the force over drawn ground is that of one dimension
    serves=lambda scene, quantity: of_a_wheel(scene, quantity) and (quantity != FORCE_RMS or scene.ground.is_single),
    cost=quadratures,
    claim=claim,
    left_out=left_out,
)
def linear_filter_3d(target: Target, resolution: Resolution) -> Result:
    """On the half-space; of measured heights, on themselves."""
    quantity, heights = target.rolling, target.scene.ground.is_single
    value = _of_heights(quantity) if heights else quantity.expected(one_dimensional=False)
    failed = "" if (value > 0).all() else "the heights have no waves in some band"
    return Result({quantity.name: value}, failed=failed)


def _of_heights(quantity: RollingQuantity, finer: int = 2) -> NDArray[np.float64]:
    """On cells so many times finer than boundary elements need at the least."""
    a = quantity.scene.contact_radius
    cells = finer * max(LEAST, math.ceil(FINE * quantity.q_max * a / (2 * math.pi)))
    return by_linear_theory(quantity, strip_of(quantity, cells, 0, 0), a / cells)
