"""Roughness from force: filters read backwards on the force of boundary elements, over surfaces that are known."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from validation.analysis.spectra import Bands
from validation.analysis.statistics import Estimate, jackknife_error
from validation.cases.rolling.force_spectrum import RollingSettings
from validation.cases.rolling.force_spectrum_levels import level_3d, over_bands
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rolling_strip import HERTZ, roll_strips, strip_levels
from validation.simulation.track_spectrum import PiecewisePowerLaw, TrackSpectrum, self_affine
from validation.theory.rolling import force_spectrum_1d, mean_force_spectrum_1d

FloatArray = NDArray[np.float64]

MEAN_FILTER, FILTER_1D, FILTER_3D = "(14.14)", "(14.12)", "filter in 3D"
FILTERS = (MEAN_FILTER, FILTER_1D, FILTER_3D)
LEAST = 1e-3
"""Of the true level, -30 dB: less is nothing that was found."""
ASSUMED = 3.0
"""Exponent of C_2D within a one-third octave, which a measured force does not tell; the true one is 2 H + 2."""


@dataclass(frozen=True, kw_only=True)
class RoughnessFromForce(RollingSettings):
    """Self-affine surfaces, q a from first to last, whose roughness is found from the force of boundary elements."""

    heights: tuple[float, ...] = (0.03, 0.3)
    strips: int = 8
    tracks: int = 0
    hurst: float = 0.7
    first: float = 1.0
    seed: int = 152

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, self.first, self.last)

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Which one-third octaves lie in the band of the roughness; the others lie below or on its first wave."""
        return np.array(self.bands.edges[:-1]) > self.first * (1 - 1e-9)

    @property
    def zeros(self) -> NDArray[np.bool_]:
        """In which one-third octaves sin(q a) has a zero."""
        turns = np.floor(np.array(self.bands.edges) / np.pi)
        return np.diff(turns) > 0


@dataclass(frozen=True)
class RoughnessFromForceResult:
    """Levels of the force, by h/d."""

    case: RoughnessFromForce
    levels: dict[float, Outcome]
    unconverged: tuple[str, ...]


def run(case: RoughnessFromForce, engine: Engine = SERIAL) -> RoughnessFromForceResult:
    """Roll over all strips. Raises NotConvergedError where fewer than three at a height converge."""
    groups = {
        height: case.rough_strip(case.spectrum, height).strips(case.cells, 1e-4 * height, case.strips)
        for height in case.heights
    }
    strips, unconverged = roll_strips(groups, engine)
    levels = {height: strip_levels(found, 1 / case.cells, case.bands) for height, found in strips.items()}
    return RoughnessFromForceResult(case, levels, unconverged)


def force_levels(case: RoughnessFromForce, outcome: Outcome) -> tuple[FloatArray, FloatArray]:
    """int C_F dq in each band over (F_Hertz h/d)^2, h/d = 1: of all strips, and without each of them in turn.

    The level over linear theory on the same surfaces, times that of the spectrum: little scatter is left.
    """
    known = np.isfinite(outcome["level"]).all(axis=1)
    level, linear = outcome["level"][known], outcome["linear level"][known]
    exact = level_3d(case.spectrum, case.bands)
    without = (level.sum(axis=0) - level) / (linear.sum(axis=0) - linear)
    return exact * level.mean(axis=0) / linear.mean(axis=0), exact * without


def true_roughness(case: RoughnessFromForce) -> FloatArray:
    """int C_1D dq over each band, Geike's: half of the mean square height of its waves, h_rms = 1."""
    return over_bands(TrackSpectrum(case.spectrum, "geike"), case.bands)


def roughness(bands: Bands, levels: FloatArray, by: str) -> FloatArray:
    """The same from levels of the force in the bands, by a filter that is read backwards.

    "(14.14)": C_1D = q^2 C_F / (2 E*^2); "(14.12)": C_1D = q^2 C_F / (4 E*^2 sin^2(q a)); both by the mean of the
    filter over a band. "filter in 3D": the heights of all bands, none negative, that have these levels, since a wave s
    of the surface has a part of its force in each band below s.
    """
    if by == FILTER_3D:
        # each level is met as well as all others, however small
        return np.asarray(nnls(filter_3d(bands) / levels[:, np.newaxis], np.ones(levels.size))[0])
    if by == FILTER_1D:
        return levels * over_bands(flat, bands) / mean_filter(bands, force_spectrum_1d, contact_radius=1.0)
    return levels * over_bands(flat, bands) / mean_filter(bands, mean_force_spectrum_1d)


def flat(q: FloatArray) -> FloatArray:
    """C_1D = pi q C_2D within a band, times any constant."""
    return np.asarray(q ** (1 - ASSUMED))


def mean_filter(bands: Bands, spectrum: Callable[..., FloatArray], **settings: float) -> FloatArray:
    """Levels of the force of C_1D = `flat`."""
    return over_bands(lambda q: spectrum(q, flat, modulus=1.0, **settings), bands) / HERTZ**2


@cache
def filter_3d(bands: Bands) -> FloatArray:
    """Level of the force in each band (rows) of int C_1D dq = 1 in each band (columns): zero above the waves' own."""
    edges = zip(bands.edges, bands.edges[1:], strict=False)
    # a piece of unit height has int C_1D dq = 1/2 over positive q
    pieces = [PiecewisePowerLaw(edges=pair, exponents=(ASSUMED,)) for pair in edges]
    return np.stack([2 * level_3d(piece, bands) for piece in pieces], axis=1)


def recovered(case: RoughnessFromForce, outcome: Outcome, by: str) -> list[Estimate]:
    """ln of the roughness found over the true one in each band inside, with the jackknife error over strips."""
    level, without = force_levels(case, outcome)
    true = true_roughness(case)[case.inside]
    whole, *rest = (
        np.log(np.maximum(roughness(case.bands, one, by)[case.inside] / true, LEAST)) for one in (level, *without)
    )
    errors = jackknife_error(np.array(rest))
    return [Estimate(float(value), float(error), len(rest)) for value, error in zip(whole, errors, strict=True)]


def below_the_band(case: RoughnessFromForce, outcome: Outcome, by: str) -> Estimate:
    """Roughness found below the band, where there is none, over that of all bands inside."""
    below = np.array(case.bands.edges[1:]) < case.first * (1 + 1e-9)
    level, without = force_levels(case, outcome)
    whole, *rest = (
        roughness(case.bands, one, by)[below].sum() / true_roughness(case)[case.inside].sum()
        for one in (level, *without)
    )
    return Estimate(float(whole), float(jackknife_error(rest)), len(without))
