"""Ground that crosses a rail at any angle: drawn wide, rolled over along its middle, with heights of both signs.

A Gaussian surface is as likely upside down. What a contact adds to linear theory is even in the heights at first, so
that its product with linear theory cancels between both: the mean power of the two scatters by a fifth of that of one.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

import bem3d
from validation.analysis.spectra import Bands, levels, waves
from validation.engine.engine import FloatArray, Outcome
from validation.railway.problems.equivalent_displacement import lifted, linear_displacement
from validation.railway.problems.rail_strip import OneAcross, RailGround, RailStrip, strip_bands, strip_of
from validation.railway.scenes.rail import RailScene
from validation.simulation.model_names import BEM, LINEAR

LINES = 4
"""Waves across to each side of the longest wave along, at the least."""
APPLICATIONS = "operator applications"


@dataclass(frozen=True, kw_only=True)
class RoundGround(RailGround):
    """Without waves shorter than the last, whichever way they go: oblique ones too have cells enough."""

    @property
    def highest(self) -> float:
        return self.last

    def variance(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        short = np.hypot(along, across) > self.last * (1 + 1e-12)
        return np.where(short, 0.0, super().variance(along, across, steps))


@dataclass(frozen=True, kw_only=True)
class WideRail:
    """strip: as wide as its waves need; width: of its middle, which boundary elements see [m]; tolerance: residual."""

    strip: RailStrip
    width: float
    bands: Bands
    tolerance: float = 3e-5


def wide_rail(scene: RailScene, across: OneAcross, cells: int, realisation: int, seed: int) -> WideRail:
    """One realisation with so many cells to the smaller semi-axis; the same surface on every grid."""
    strip = strip_of(scene, across, cells, realisation, seed)
    longest = 2 * math.pi / strip.ground.first
    slope = {"ridges": math.inf, "isotropic": 1.0}[across] if isinstance(across, str) else min(across, 1.0)
    # an odd number of times as wide, so that the middle is one of cells
    times = 2 * math.ceil(LINES * longest / slope / strip.width / 2) + 1
    wide = replace(strip, ground=RoundGround(**vars(strip.ground)), width=times * strip.width)
    return WideRail(strip=wide, width=strip.width, bands=Bands(tuple(strip_bands(scene).edges.tolist())))


def roll_both_ways(problem: WideRail) -> Outcome:
    """Band powers of linear theory and of boundary elements, these in the mean over the heights and the opposite ones.

    By the names of the models [m^2]; failed: positions that have not converged, whose strips have no powers.
    """
    strip = problem.strip
    rolled = [_roll(problem, sign) for sign in (1, -1)]
    return {
        LINEAR: _mean_powers(problem, [linear_displacement(strip, LINEAR)]),
        BEM: _mean_powers(problem, [lifted(rolling.approach) for rolling in rolled]),
        APPLICATIONS: np.array(float(sum(np.sum(rolling.operator_applications) for rolling in rolled))),
        "failed": np.array(float(sum(np.count_nonzero(~rolling.converged) for rolling in rolled))),
    }


def _roll(problem: WideRail, sign: int) -> bem3d.Rolling:
    strip = problem.strip
    drawn, seen = strip.shape[1], round(problem.width / strip.spacing)
    middle = slice((drawn - seen) // 2, (drawn + seen) // 2)
    return bem3d.roll(
        sign * strip.surface[:, middle],
        spacing=strip.spacing,
        radius=strip.radii,
        modulus=strip.modulus,
        force=strip.force,
        tolerance=problem.tolerance,
        raise_on_failure=False,
    )


def _mean_powers(problem: WideRail, tracks: Sequence[FloatArray]) -> FloatArray:
    powers = [levels(waves(track, spacing=problem.strip.spacing), problem.bands) for track in tracks]
    return np.asarray(np.mean(powers, axis=0))
