"""A wheel rolled over isotropic roughness, by boundary elements and by springs.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1; so R = 1, and the force of Hertz is 4/3.
"""

import math
import warnings
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.analysis.spectra import Bands, cross_levels, levels, waves
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Engine, Outcome, random_generator
from validation.simulation.surface import draw_surface
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, TrackSpectrum
from validation.theory.rolling import linear_force

FloatArray = NDArray[np.float64]
K = TypeVar("K", bound=Hashable)

HERTZ = 4 / 3
SMOOTH: dict[str, Any] = {"radius": 1.0, "modulus": 1.0, "approach": 1.0}
TRACKS, STRIPS = 1, 2
"""Keys of random numbers: the roughness of both methods."""


@dataclass(frozen=True, kw_only=True)
class Strip:
    """One realisation of a rough strip, rolled over at d = 1.

    spectrum; height: rms, over d; length, width: of the periodic surface that is drawn, over a, of which the wheel
    rolls along the middle; cells: to a contact radius; tolerance: residual of the solver; seed: zero or positive.
    """

    spectrum: PiecewisePowerLaw
    height: float
    realisation: int
    length: float
    width: float
    cells: int
    tolerance: float
    seed: int

    def __post_init__(self) -> None:
        for name in ("length", "width"):
            side = getattr(self, name) * self.cells
            if abs(side - round(side)) > 1e-9 * side:
                raise ValueError(f"{name} must be a whole number of cells, got {side:g}")

    def surface(self) -> FloatArray:
        """Heights at the centres of the cells, all of them; the same surface on every grid."""
        unit = draw_surface(
            self.spectrum.c2d,
            shape=(round(self.length * self.cells), round(self.width * self.cells)),
            spacing=1 / self.cells,
            rng=random_generator(self.seed, STRIPS, self.realisation),
            rms=1.0,
        )
        return np.asarray(self.height * unit)


def roll_strip(strip: Strip) -> Outcome:
    """Force over that of Hertz at each cell: boundary elements, and linear theory on the same surface.

    area: of contact, over that of the smooth wheel; applications: of the operator; failed: positions that did not
    converge, whose force is NaN.
    """
    surface, spacing = strip.surface(), 1 / strip.cells
    linear = linear_force(surface, spacing=spacing, **SMOOTH)
    found = bem3d.roll(
        crop_to_reach(surface, spacing), spacing=spacing, tolerance=strip.tolerance, raise_on_failure=False, **SMOOTH
    )
    return {
        "force": np.where(found.converged, found.force, np.nan) / HERTZ,
        "linear": linear / HERTZ,
        "area": np.where(found.converged, found.area, np.nan) / math.pi,
        "applications": found.operator_applications.astype(np.float64),
        "failed": np.array(float(np.count_nonzero(~found.converged))),
    }


def roll_strips(groups: Mapping[K, Sequence[Strip]], engine: Engine) -> tuple[dict[K, list[Outcome]], tuple[str, ...]]:
    """Outcomes of each group, and a line for each strip with positions that did not converge.

    Raises NotConvergedError where fewer than three strips of a group have converged everywhere.
    """
    outcomes = engine.map_groups(roll_strip, groups)
    unconverged = tuple(
        f"strip {s.realisation}, h/d = {s.height:g}, {s.cells} cells to a radius: {int(o['failed'])} positions, "
        f"{s.spectrum}"
        for key, strips in groups.items()
        for s, o in zip(strips, outcomes[key], strict=True)
        if o["failed"]
    )
    for key, found in outcomes.items():
        converged = sum(not outcome["failed"] for outcome in found)
        if converged < 3:
            raise NotConvergedError(f"{converged} strips of {key} converged, 3 are needed", unconverged)
    return outcomes, unconverged


def crop_to_reach(surface: FloatArray, spacing: float) -> FloatArray:
    """The middle of a surface: no wider than the cells that can overlap with the wheel, wherever it stands."""
    reach = math.sqrt(2 * (1 + max(float(surface.max()), 0.0)))
    side = min(math.ceil(reach / spacing) + 1, surface.shape[1] // 2)
    middle = surface.shape[1] // 2
    return surface[:, middle - side : surface.shape[1] - middle + side]


@dataclass(frozen=True, kw_only=True)
class Tracks:
    """The first so many rough tracks on springs, rolled over at d = 1.

    spectrum: of the surface; input_spectrum: that of the tracks made for it; height: rms of the surface,
    over d; length: over a; springs: to a contact radius; bands: of the levels; seed: zero or positive.
    """

    spectrum: PiecewisePowerLaw
    input_spectrum: InputSpectrum
    height: float
    realisations: int
    length: float
    springs: int
    bands: Bands
    seed: int

    def track(self, realisation: int) -> FloatArray:
        points = round(self.length * self.springs)
        unit = mdr.rough_profile(
            TrackSpectrum(self.spectrum, self.input_spectrum),
            length=self.length,
            points=points,
            rng=random_generator(self.seed, TRACKS, realisation),
            rms=1.0 if self.input_spectrum == "geike" else None,
        )
        return np.asarray(self.height * unit)


def roll_tracks(tracks: Tracks) -> Outcome:
    """One-sided springs and the linear filter on the same tracks: their `levels_beside_linear`.

    examined: springs examined one by one at a position, mean of each track; wavenumber, spectrum: C_F itself of
    one-sided springs, the mean of all tracks.
    """
    points, spacing = round(tracks.length * tracks.springs), 1 / tracks.springs
    force, linear = np.empty((2, tracks.realisations, points))
    examined = np.empty(tracks.realisations)
    for i in range(tracks.realisations):
        roll = partial(mdr.roll, tracks.track(i), spacing=spacing, **SMOOTH)
        found = roll()
        with warnings.catch_warnings():
            # the range of the filter is under test
            warnings.simplefilter("ignore", mdr.LinearityWarning)
            force[i], linear[i] = found.force / HERTZ, roll(contact="linear").force / HERTZ
        examined[i] = found.examined.mean()
    narrow = waves(force, spacing=spacing)
    known = narrow.q < tracks.bands.edges[-1]
    return {
        **levels_beside_linear(force, linear, spacing, tracks.bands),
        "examined": examined,
        "wavenumber": narrow.q[known],
        "spectrum": narrow.spectrum.mean(axis=0)[known],
    }


def strip_levels(outcomes: list[Outcome], spacing: float, bands: Bands) -> Outcome:
    """`levels_beside_linear` of strips; NaN in rows of strips with a position that did not converge."""
    force, linear = (np.array([outcome[name] for outcome in outcomes]) for name in ("force", "linear"))
    return levels_beside_linear(force, linear, spacing, bands)


def levels_beside_linear(force: FloatArray, linear: FloatArray, spacing: float, bands: Bands) -> Outcome:
    """Forces beside those of linear theory on the same roughness, one row a realisation, over the force of Hertz.

    level, linear level: int C_F dq over each band, (realisations, bands); cross: real and imaginary part of their cross
    levels, (2, realisations, bands); mean, variance of the force, linear variance: (realisations,).
    """
    mine, other = waves(force, spacing=spacing), waves(linear, spacing=spacing)
    cross = cross_levels(mine, other, bands)
    return {
        "level": levels(mine, bands),
        "linear level": levels(other, bands),
        "cross": np.stack([cross.real, cross.imag]),
        "mean": force.mean(axis=1),
        "variance": force.var(axis=1),
        "linear variance": linear.var(axis=1),
    }
