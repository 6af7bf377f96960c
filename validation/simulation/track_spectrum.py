"""Spectra of an isotropic surface, and those that springs along a track get for it."""

import math
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

import mdr
from validation.theory.rolling import section

FloatArray = NDArray[np.float64]
InputSpectrum = Literal["geike", "line", "rolling"]
"""Geike's rule; the line trace of the surface; the rolling-equivalent spectrum, `mdr.rolling_spectrum`."""

INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "line", "rolling")


@dataclass(frozen=True, kw_only=True)
class PiecewisePowerLaw:
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


def self_affine(hurst: float, first: float = 1.0, last: float = 20.0) -> PiecewisePowerLaw:
    """C_2D ~ q^(-2H-2) between two wavenumbers times a."""
    return PiecewisePowerLaw(edges=(first, last), exponents=(2 * hurst + 2,))


@dataclass(frozen=True)
class TrackSpectrum:
    """C_1D(q) of a track for an isotropic surface; values are kept, since each is a quadrature.

    contact_radius: on which the rolling-equivalent spectrum depends.
    """

    spectrum: PiecewisePowerLaw
    input_spectrum: InputSpectrum
    contact_radius: float = 1.0

    def __call__(self, q: NDArray[np.floating]) -> FloatArray:
        return _values(self, tuple(q.ravel().tolist())).reshape(q.shape)


@cache
def _values(track: TrackSpectrum, q: tuple[float, ...]) -> FloatArray:
    c2d, edges = track.spectrum.c2d, track.spectrum.edges
    if track.input_spectrum == "geike":
        return mdr.geike(np.array(q), c2d)
    if track.input_spectrum == "line":
        return section(np.array(q), c2d, edges=edges)
    return mdr.rolling_spectrum(np.array(q), c2d, edges=edges, contact_radius=track.contact_radius)
