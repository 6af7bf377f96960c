"""Spectra of an isotropic surface, and those that springs along a track get for it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

import mdr
from validation.engine.engine import FloatArray
from validation.scenes.roughness import RoughSurface
from validation.theory.rolling import section, slope_in_one_direction

InputSpectrum = Literal["geike", "line", "rolling"]
"""Geike's rule; the line trace of the surface; the rolling-equivalent spectrum, `mdr.rolling_spectrum`."""

INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "line", "rolling")
INPUT_NAMES: Mapping[InputSpectrum, str] = {
    "geike": "Geike's spectrum",
    "line": "line trace",
    "rolling": "rolling-equivalent spectrum",
}


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
        values = [1.0]
        for low, high, n in zip(self.edges, self.edges[1:], self.exponents, strict=False):
            values.append(values[-1] * (high / low) ** -n)
        levels = np.array(values[:-1])
        return levels / self._moment(levels, 0)

    @property
    def gradient(self) -> float:
        """g a for h_rms = 1: g^2 = 2 pi int q^3 C_2D dq, the mean square gradient, and that of Geike's profile."""
        return math.sqrt(self._moment(self._levels, 2))

    @property
    def slope_along(self) -> float:
        """h' a for h_rms = 1, h' the rms slope along the track, in one direction, of all waves."""
        return slope_in_one_direction(self.gradient)

    def _moment(self, levels: FloatArray, order: int) -> float:
        """2 pi int q^(1 + order) C_2D dq."""
        total = 0.0
        for low, high, n, level in zip(self.edges, self.edges[1:], self.exponents, levels, strict=False):
            power, log = 2 + order - n, math.log(high / low)
            integral = log if power == 0 else math.expm1(power * log) / power
            total += 2 * math.pi * level * low ** (2 + order) * integral
        return total


def self_affine(hurst: float, first: float = 1.0, last: float = 20.0) -> PiecewisePowerLaw:
    """C_2D ~ q^(-2H-2) between two wavenumbers times a."""
    return PiecewisePowerLaw(edges=(first, last), exponents=(2 * hurst + 2,))


@dataclass(frozen=True)
class TrackSpectrum:
    """C_1D(q) of a track for an isotropic surface; values are kept where each is a quadrature.

    contact_radius: on which the rolling-equivalent spectrum depends.
    """

    spectrum: PiecewisePowerLaw | RoughSurface
    input_spectrum: InputSpectrum
    contact_radius: float = 1.0

    def __call__(self, q: NDArray[np.floating]) -> FloatArray:
        if self.input_spectrum == "geike":
            return mdr.geike(q, self.spectrum.c2d)
        return _spectrum_by_quadrature(self, tuple(q.ravel().tolist())).reshape(q.shape)


@cache
def _spectrum_by_quadrature(track: TrackSpectrum, q: tuple[float, ...]) -> FloatArray:
    """C_1D of the line trace or of the rolling-equivalent spectrum at the wavenumbers, each a quadrature."""
    c2d, edges = track.spectrum.c2d, track.spectrum.edges
    if track.input_spectrum == "line":
        return section(np.array(q), c2d, edges=edges)
    return mdr.rolling_spectrum(np.array(q), c2d, edges=edges, contact_radius=track.contact_radius)
