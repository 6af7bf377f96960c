"""Linear theory of the rolling force in one-third octaves, and levels over it: a = d = E* = h_rms = 1."""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands
from validation.analysis.statistics import Estimate, Sample, difference_of_halves, log_mean, weighted_mean
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
    """int C_F dq / F_Hertz^2 over each band of springs with that input spectrum, (14.12)."""
    c1d = TrackSpectrum(spectrum, rule)
    return _over_bands(lambda q: force_spectrum_1d(q, c1d, contact_radius=1.0, modulus=1.0), bands)


@cache
def level_3d(spectrum: PiecewisePowerLaw, bands: Bands) -> FloatArray:
    """The same of the half-space."""
    return _over_bands(lambda q: force_3d(q, spectrum), bands)


def force_3d(q: FloatArray, spectrum: PiecewisePowerLaw) -> FloatArray:
    """C_F(q) of the half-space."""
    return force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)


def _over_bands(spectrum: Spectrum, bands: Bands) -> FloatArray:
    edges = np.array(bands.edges)
    q = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * ((np.arange(POINTS) + 0.5) / POINTS)
    return np.asarray(spectrum(q).mean(axis=1) * np.diff(edges) / HERTZ**2)


def over_exact(levels: Sample, exact: FloatArray, weights: FloatArray) -> Estimate:
    """ln of mean levels over exact ones, in the mean over bands."""
    used = weights > 0
    found = levels.estimate(weighted_mean(weights, log_mean))
    return Estimate(found.value - float(weights[used] @ np.log(exact[used])), found.error, found.samples)


def ratio_of_pairs(pairs: Sample, weights: FloatArray) -> Estimate:
    """ln of the second half of the levels over the first, realisation by realisation, in the mean over bands."""
    return pairs.estimate(difference_of_halves(weighted_mean(weights, log_mean)))
