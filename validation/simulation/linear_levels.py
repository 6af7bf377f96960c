"""Levels of linear theory in one-third octaves, by quadrature, and how alike a force is to that of linear theory.

Units: a = d = E* = 1 of the smooth wheel; levels over the square of Hertz's force, for h_rms = 1.
"""

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands
from validation.engine.engine import Outcome
from validation.simulation.rolling_strip import HERTZ
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, TrackSpectrum
from validation.theory.rolling import Spectrum, force_spectrum_1d, force_spectrum_3d

FloatArray = NDArray[np.float64]

POINTS = 48
"""Of the midpoint rule in each band."""
ROUNDING = 1e-300
"""Where (14.12) is zero, its level is rounding's, which is no reference."""


@cache
def level_1d(spectrum: PiecewisePowerLaw, rule: InputSpectrum, bands: Bands) -> FloatArray:
    """int C_F dq over each band of springs with that input spectrum, (14.12)."""
    c1d = TrackSpectrum(spectrum, rule)
    return over_bands(lambda q: force_spectrum_1d(q, c1d, contact_radius=1.0, modulus=1.0), bands) / HERTZ**2


@cache
def level_3d(spectrum: PiecewisePowerLaw, bands: Bands) -> FloatArray:
    """The same of the half-space."""
    return over_bands(lambda q: force_3d(q, spectrum), bands) / HERTZ**2


def force_3d(q: FloatArray, spectrum: PiecewisePowerLaw) -> FloatArray:
    """C_F itself of the half-space."""
    return force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)


def over_bands(spectrum: Spectrum, bands: Bands) -> FloatArray:
    """int C dq over each band, by the midpoint rule."""
    edges = np.array(bands.edges)
    q = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * ((np.arange(POINTS) + 0.5) / POINTS)
    return np.asarray(spectrum(q).mean(axis=1) * np.diff(edges))


def coherence(outcome: Outcome) -> FloatArray:
    """|<F F_lin*>|^2 / (<|F|^2> <|F_lin|^2>) in each band, over all waves and realisations."""
    cross = np.nansum(outcome["cross"][0] + 1j * outcome["cross"][1], axis=0)
    linear = np.where(np.isfinite(outcome["level"]), outcome["linear level"], 0.0).sum(axis=0)
    return np.asarray(np.abs(cross) ** 2 / np.nansum(outcome["level"], axis=0) / np.maximum(linear, ROUNDING))


def correlation(outcome: Outcome) -> tuple[float, float]:
    """Correlation and slope of the force over linear theory, position by position, in all bands together."""
    cross, known = float(np.nansum(outcome["cross"][0])), np.isfinite(outcome["level"])
    linear, level = (float(outcome[name][known].sum()) for name in ("linear level", "level"))
    return cross / math.sqrt(linear * level), cross / linear
