"""Filters of linear theory that are read backwards: roughness of a surface from levels of the force in bands.

Units: contact radius a = 1, approach d = 1, E* = 1; levels over the square of Hertz's force. Roughness is int C_1D dq
over each band, Geike's: half of the mean square height of its waves.
"""

from functools import cache

import numpy as np
from scipy.optimize import nnls

from validation.analysis.spectra import Bands
from validation.engine.engine import FloatArray
from validation.simulation.rolling_strip import HERTZ, level_3d, over_bands
from validation.simulation.track_spectrum import PiecewisePowerLaw
from validation.theory.rolling import mean_force_spectrum_1d

ASSUMED = 3.0
"""Exponent of C_2D within a one-third octave, which a measured force does not tell; the true one is 2 H + 2."""


def by_mean_filter(bands: Bands, levels: FloatArray) -> FloatArray:
    """(14.14): C_1D = q^2 C_F / (2 E*^2), by the mean of the filter over a band."""
    passed = over_bands(lambda q: mean_force_spectrum_1d(q, flat, modulus=1.0), bands) / HERTZ**2
    return np.asarray(levels * over_bands(flat, bands) / passed)


def by_filter_3d(bands: Bands, levels: FloatArray) -> FloatArray:
    """The heights of all bands, none negative, that have these levels, each met as well as all others, however small.

    A wave s of the surface has a part of its force in each band below s.
    """
    return np.asarray(nnls(filter_3d(bands) / levels[:, np.newaxis], np.ones(levels.size))[0])


def flat(q: FloatArray) -> FloatArray:
    """C_1D = pi q C_2D within a band, times any constant."""
    return np.asarray(q ** (1 - ASSUMED))


@cache
def filter_3d(bands: Bands) -> FloatArray:
    """Level of the force in each band (rows) of int C_1D dq = 1 in each band (columns): zero above the waves' own."""
    edges = zip(bands.edges, bands.edges[1:], strict=False)
    # a piece of unit height has int C_1D dq = 1/2 over positive q
    pieces = [PiecewisePowerLaw(edges=pair, exponents=(ASSUMED,)) for pair in edges]
    return np.stack([2 * level_3d(piece, bands) for piece in pieces], axis=1)
