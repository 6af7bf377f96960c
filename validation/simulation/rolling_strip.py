"""A wheel rolled over isotropic roughness by either method: one solve of every case about it.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1; so R = 1, and the force of Hertz is 4/3.
"""

import math
import warnings
from dataclasses import dataclass
from functools import cache, partial
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bem3d
import mdr
from validation.analysis.spectra import Bands, cross_levels, levels, waves
from validation.engine.engine import Outcome, generator
from validation.theory.rolling import linear_force, section

FloatArray = NDArray[np.float64]
Feed = Literal["geike", "line", "rolling"]

FEEDS: tuple[Feed, ...] = ("geike", "line", "rolling")
HERTZ = 4 / 3
TRACKS, STRIPS, BOOTSTRAP = 1, 2, 3
"""The spawn keys under which each kind of roughness draws, and what is drawn again to tell the error of a sample."""


@dataclass(frozen=True, kw_only=True)
class PowerLaws:
    """An isotropic spectrum of unit height: C_2D ~ q^-n on each piece between edges, continuous, zero outside.

    edges: wavenumbers times a, ascending; exponents: n of each piece.
    """

    edges: tuple[float, ...]
    exponents: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.edges) != len(self.exponents) + 1:
            raise ValueError(f"edges must be one more than exponents, got {len(self.edges)} and {len(self.exponents)}")

    def c2d(self, q: ArrayLike) -> FloatArray:
        """C_2D(|q|) over a^2 and the mean square height; the edges belong to the band within a relative 1e-9."""
        k = np.abs(np.asarray(q, dtype=np.float64))
        inside = (k >= self.edges[0] * (1 - 1e-9)) & (k <= self.edges[-1] * (1 + 1e-9))
        k = np.clip(k, self.edges[0], self.edges[-1])
        piece = np.clip(np.searchsorted(self.edges, k, side="right") - 1, 0, len(self.exponents) - 1)
        first, level, exponent = np.array(self.edges)[piece], self._levels[piece], np.array(self.exponents)[piece]
        return np.asarray(np.where(inside, level * (k / first) ** -exponent, 0.0))

    @property
    def _levels(self) -> FloatArray:
        """C_2D at the first edge of each piece, of mean square one."""
        level, moments, found = 1.0, 0.0, []
        for low, high, n in zip(self.edges, self.edges[1:], self.exponents, strict=False):
            found.append(level)
            log = math.log(high / low)
            whole = log if n == 2 else math.expm1((2 - n) * log) / (2 - n)
            moments += 2 * math.pi * level * low**2 * whole
            level *= (high / low) ** -n
        return np.array(found) / moments


def self_affine(hurst: float, first: float = 1.0, last: float = 20.0) -> PowerLaws:
    """C_2D ~ q^(-2H-2) between two wavenumbers times a."""
    return PowerLaws(edges=(first, last), exponents=(2 * hurst + 2,))


@dataclass(frozen=True, kw_only=True)
class Strip:
    """One realisation of a rough strip, rolled over at d = 1.

    spectrum; height: rms, over d; length, width: of the periodic surface that is drawn, over a, of which the wheel
    rolls along the middle; cells: to a contact radius; tolerance: residual of the solver; seed: zero or positive.
    """

    spectrum: PowerLaws
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
        with warnings.catch_warnings():
            # grids are compared, and what they leave open is measured
            warnings.simplefilter("ignore", bem3d.ResolutionWarning)
            unit = bem3d.rough_surface(
                self.spectrum.c2d,
                shape=(round(self.length * self.cells), round(self.width * self.cells)),
                spacing=1 / self.cells,
                rng=generator(self.seed, STRIPS, self.realisation),
                rms=1.0,
            )
        return np.asarray(self.height * unit)


def roll_strip(strip: Strip) -> Outcome:
    """Force over that of Hertz at each cell: boundary elements, and linear theory on the same surface.

    area: in contact, over pi a^2; applications: of the operator; failed: positions that did not converge, whose force
    is NaN; height: rms of the surface, over d.
    """
    surface, spacing = strip.surface(), 1 / strip.cells
    linear = linear_force(surface, spacing=spacing, radius=1.0, modulus=1.0, approach=1.0)
    found = bem3d.roll(
        narrowed(surface, spacing),
        spacing=spacing,
        radius=1.0,
        modulus=1.0,
        approach=1.0,
        tolerance=strip.tolerance,
        raise_on_failure=False,
    )
    return {
        "force": np.where(found.converged, found.force, np.nan) / HERTZ,
        "linear": linear / HERTZ,
        "area": found.area / np.pi,
        "applications": found.operator_applications.astype(np.float64),
        "failed": np.array(float(np.count_nonzero(~found.converged))),
        "height": np.array(surface.std()),
    }


def narrowed(surface: FloatArray, spacing: float) -> FloatArray:
    """The middle of a surface: no wider than the cells that can overlap with the wheel, wherever it stands."""
    reach = math.sqrt(2 * (1 + max(float(surface.max()), 0.0)))
    side = min(math.ceil(reach / spacing) + 1, surface.shape[1] // 2)
    middle = surface.shape[1] // 2
    return surface[:, middle - side : surface.shape[1] - middle + side]


@dataclass(frozen=True, kw_only=True)
class Tracks:
    """The first so many rough tracks on springs, rolled over at d = 1.

    spectrum: of the surface; feed: the rule by which a track gets its spectrum from that; height: rms of the surface,
    over d; length: over a; springs: to a contact radius; bands: in which levels are wanted; seed: zero or positive.
    """

    spectrum: PowerLaws
    feed: Feed
    height: float
    realisations: int
    length: float
    springs: int
    bands: Bands
    seed: int

    def track(self, realisation: int) -> FloatArray:
        """Heights of the springs."""
        points = round(self.length * self.springs)
        unit = mdr.rough_profile(
            fed(self.spectrum, self.feed),
            length=self.length,
            points=points,
            rng=generator(self.seed, TRACKS, realisation),
            rms=1.0 if self.feed == "geike" else None,
        )
        return np.asarray(self.height * unit)


class fed:  # noqa: N801
    """c1d of a spectrum by a rule, C_1D(q); values are kept, since each is a quadrature.

    contact_radius: which the rule for rolling wants.
    """

    def __init__(self, spectrum: PowerLaws, feed: Feed, contact_radius: float = 1.0):
        self._settings = spectrum, feed, contact_radius

    def __call__(self, q: NDArray[np.floating]) -> FloatArray:
        """C_1D(q)."""
        return np.array(_fed(*self._settings, tuple(q.ravel().tolist()))).reshape(q.shape)


@cache
def _fed(spectrum: PowerLaws, feed: Feed, contact_radius: float, q: tuple[float, ...]) -> tuple[float, ...]:
    wavenumber = np.array(q)
    if feed == "geike":
        values = mdr.geike(wavenumber, spectrum.c2d)
    elif feed == "line":
        values = section(wavenumber, spectrum.c2d, edges=spectrum.edges)
    else:
        values = mdr.rolling_spectrum(wavenumber, spectrum.c2d, edges=spectrum.edges, contact_radius=contact_radius)
    return tuple(values.tolist())


def roll_tracks(tracks: Tracks) -> Outcome:
    """One-sided springs, and the linear filter on the same tracks: what `compared` has of them.

    examined: springs of a position that were looked at one by one, of each track; wavenumber, spectrum: C_F itself of
    one-sided springs, the mean of all tracks.
    """
    points, spacing = round(tracks.length * tracks.springs), 1 / tracks.springs
    force, linear = np.empty((2, tracks.realisations, points))
    examined = np.empty(tracks.realisations)
    for i in range(tracks.realisations):
        roll = partial(mdr.roll, tracks.track(i), spacing=spacing, radius=1.0, modulus=1.0, approach=1.0)
        found = roll()
        with warnings.catch_warnings():
            # how far the filter holds is what is asked
            warnings.simplefilter("ignore", mdr.LinearityWarning)
            force[i], linear[i] = found.force / HERTZ, roll(contact="linear").force / HERTZ
        examined[i] = found.examined.mean()
    narrow = waves(force, spacing=spacing)
    known = narrow.q < tracks.bands.edges[-1]
    return {
        **compared(force, linear, spacing, tracks.bands),
        "examined": examined,
        "wavenumber": narrow.q[known],
        "spectrum": narrow.spectrum.mean(axis=0)[known],
    }


def strip_levels(outcomes: list[Outcome], spacing: float, bands: Bands) -> Outcome:
    """What `compared` has of strips; NaN in rows of strips with a position that did not converge."""
    force, linear = (np.array([outcome[name] for outcome in outcomes]) for name in ("force", "linear"))
    return compared(force, linear, spacing, bands)


def compared(force: FloatArray, linear: FloatArray, spacing: float, bands: Bands) -> Outcome:
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
