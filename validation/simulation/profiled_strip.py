"""Boundary elements under a wheel on a strip of rail whose shape across was measured."""

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.engine.engine import Outcome
from validation.scenes.transverse_profile import TransverseProfile
from validation.simulation.equivalent_displacement import BEM, LINEAR, LINEAR_MODELS, RolledRail, lifted
from validation.simulation.rail_strip import RailStrip

FloatArray = NDArray[np.float64]


def roll_on_profile(strip: RailStrip, profile: TransverseProfile, *, positions: int | None = None) -> Outcome:
    """Equivalent displacement along a strip with the profile across, and of its linear twin, by their names, (nx,) [m].

    The linear twin is that of the ellipse of the strip's two radii. positions: of boundary elements, from the first
    cell of the strip, None for all; failed: positions at which they have not converged: the displacement counts from
    its mean, which then is not known.
    Raises ValueError where the contact reaches the end of the profile.
    """
    columns, z = heights_across(strip, profile)
    rolled = bem3d.roll(
        strip.surface[:, columns],
        spacing=strip.spacing,
        radius=strip.radii[0],
        transverse_profile=z,
        modulus=strip.modulus,
        force=strip.force,
        positions=positions,
        tolerance=RolledRail.tolerance,
        raise_on_failure=False,
    )
    found = lifted(rolled.approach)
    linear = strip.along_middle(LINEAR_MODELS[LINEAR](strip.contact))
    return {LINEAR: linear, BEM: found, "failed": np.array(float(np.count_nonzero(~rolled.converged)))}


def heights_across(strip: RailStrip, profile: TransverseProfile) -> tuple[slice, FloatArray]:
    """The columns of a strip that have the profile, and the heights there, zero at the highest [m].

    There are as many to both sides of the middle. The highest point of the profile, y = 0, is the middle of axis 1,
    over which the wheel rolls.
    """
    ny = strip.shape[1]
    y = (np.arange(ny) - (ny - 1) / 2) * strip.spacing
    inside = np.flatnonzero(np.abs(y) <= profile.reach)
    columns = slice(int(inside[0]), int(inside[-1]) + 1)
    z = profile(y[columns])
    # columns miss a top; what they miss is a constant approach
    return columns, z - z.max()
