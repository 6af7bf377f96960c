"""Reduced models of a rolling wheel, over linear theory on the same tracks or strips, times what linear theory has."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

import mdr
from validation.engine.engine import FloatArray
from validation.scenes.rolling import RollingScene
from validation.simulation import rolling_levels as grids
from validation.simulation.method import Resolution, Result
from validation.simulation.model import Cost, Model, Target
from validation.simulation.model_names import PRESSED_LAYER, SPRINGS, SPRINGS_THAT_READ
from validation.simulation.pressed_layer import roll_on_layer
from validation.simulation.rolling_claims import FORCE_RMS, NODE, RollingClaim, of_a_wheel
from validation.simulation.rolling_levels import RollingGrid, by_linear_theory, levels_of, on_springs, strip_of
from validation.simulation.wheel_on_half_space import crop_to_reach

TRACKS = 60
MOST_ON_TRACKS, MOST_ON_A_STRIP = 2**27, 2**24
"""Springs that are drawn at once at the most, which take up to four gigabytes, and cells."""
SPRING = 6.0e-7
"""Seconds that a position on springs takes, about."""


def positions(target: Target, resolution: Resolution) -> Cost:
    """Of all tracks, and what linear theory expects."""
    work = TRACKS * RollingGrid.of(target.rolling, 1).along * resolution.size
    nodes = 0 if target.quantity == FORCE_RMS else target.rolling.nodes
    return Cost(work=work, seconds=SPRING * work + NODE * nodes)


ON_TRACKS = RollingClaim(
    bands=(0.0, 0.6, 0.45),
    rms=(1.0, 0.1, 0.002),
    moving=(0.5, 0.0, 0.06, 0.02),
    on_bands="springs have the right level only in the mean over bands",
    sample=10,
    size=lambda target, resolution: positions(target, resolution).work,
    most=MOST_ON_TRACKS,
    too_large=f"{TRACKS} tracks need {{:.2g}} springs",
)


@ON_TRACKS.model(
    name=SPRINGS,
    setting=f"{TRACKS} tracks",
    resolutions=lambda target: (Resolution(size=grids.springs_to_a_radius(target.rolling)),),
    cost=positions,
    charted=False,
    is_mdr=True,
)
def springs(target: Target, resolution: Resolution) -> Result:
    """One-sided springs: the mean of logarithms over tracks."""
    expected = target.rolling.expected(one_dimensional=target.quantity == FORCE_RMS)
    change = on_springs(target.rolling, TRACKS, target.seed)
    return times(expected, change, target, "a wheel lifted off farther than the sums are exact for")


def times(expected: FloatArray, change: FloatArray, target: Target, why: str) -> Result:
    """What linear theory expects times what realisations change, (realisations, bands); why: some have none."""
    failed = "" if np.isfinite(change).all() else why
    return Result({target.quantity: expected * np.exp(change)}, count=len(change), failed=failed)


def drawn_force(scene: Any, quantity: str) -> bool:
    """Not of measured heights, of which there is one strip."""
    return of_a_wheel(scene, quantity) and quantity.startswith("force") and not scene.ground.is_single


def cells_to_a_radius(target: Target) -> tuple[Resolution, ...]:
    shortest = target.rolling.q_max * target.scene.contact_radius / (2 * math.pi)
    return (Resolution(size=max(grids.LEAST, math.ceil(grids.FINE * shortest))),)


def cells_of_a_strip(target: Target, resolution: Resolution) -> float:
    grid = RollingGrid.of(target.rolling, round(resolution.size))
    return float(grid.along * grid.across)


def on_strips(
    name: str, claim: RollingClaim, *, strips: int, per_cell: float, is_mdr: bool = False
) -> Callable[[Callable[[RollingScene, FloatArray, float], FloatArray]], Model]:
    """A model of the force along the middle of a strip [N], by its heights and the side of its cells.

    strips: in one solve, whose logarithms have a mean; per_cell: seconds that a cell of a strip takes, about.
    """
    too_large = "a strip needs {:.2g} cells"
    claim = replace(claim, sample=10, size=cells_of_a_strip, most=MOST_ON_A_STRIP, too_large=too_large)

    def cost(target: Target, resolution: Resolution) -> Cost:
        work = strips * cells_of_a_strip(target, resolution)
        return Cost(work=work, seconds=per_cell * work)

    def declare(force: Callable[[RollingScene, FloatArray, float], FloatArray]) -> Model:
        def levels(target: Target, resolution: Resolution) -> Result:
            quantity, cells = target.rolling, round(resolution.size)
            spacing, change = target.scene.contact_radius / cells, []
            for strip in range(strips):
                surface = strip_of(quantity, cells, strip, target.seed)
                found = levels_of(quantity, force(target.scene, surface, spacing), spacing)
                change.append(np.log(found) - np.log(by_linear_theory(quantity, surface, spacing)))
            expected = quantity.expected(one_dimensional=False)
            return times(expected, np.array(change), target, "a strip has no force in some band")

        declared = {"serves": drawn_force, "resolutions": cells_to_a_radius, "charted": False, "is_mdr": is_mdr}
        return claim.model(name=name, setting=f"{strips} strips", cost=cost, **declared)(levels)

    return declare


@on_strips(
    PRESSED_LAYER,
    RollingClaim(
        bands=(0.0, 0.1, 0.12),
        rms=(0.02, 0.03, 0.005),
        on_bands="waves longer than the contact are pressed flat in the layer, where the wheel follows them",
    ),
    strips=10,
    per_cell=4.0e-6,
)
def pressed_layer(scene: RollingScene, surface: FloatArray, spacing: float) -> FloatArray:
    """The wheel on a rough layer, pressed flat beforehand: which asperities touch is known from the strip itself.

    Boundary elements once for a strip and a mean pressure, not once for a position.
    """
    return roll_on_layer(surface / scene.approach, spacing / scene.contact_radius).force * scene.load


@on_strips(
    SPRINGS_THAT_READ,
    RollingClaim(
        bands=(1.8, 0.4, 0.02),
        rms=(0.8, 0.05, 0.004),
        on_bands="contact is lost along the track, not inside of the contact",
    ),
    strips=24,
    per_cell=1.5e-7,
    is_mdr=True,
)
def springs_that_read(scene: RollingScene, surface: FloatArray, spacing: float) -> FloatArray:
    """One-sided springs, each of which reads the mean of the heights across the contact.

    Linear theory of the half-space while all springs touch; a spring lets go over its whole width at once.
    """
    strip = crop_to_reach(surface, spacing, scene.body)
    return mdr.roll_surface(strip, spacing=spacing, **scene.body.smooth).force
