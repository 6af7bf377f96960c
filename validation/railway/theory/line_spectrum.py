"""The spectrum of a line along a rough rail as power laws between points, and of the isotropic surface that has it.

Spectra are two-sided: <h^2> = int_{-inf}^{inf} C_line dq = 2 pi int_0^inf q C_2D dq. Wavenumbers in rad/m.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.theory.half_space import gauss_legendre

FloatArray = NDArray[np.float64]

LEAST_FALL, MOST_FALL = 1.0, 20.0
"""Exponents beyond the shortest wave at the least and at the most: C ~ 1/q has the same level in each one-third octave,
and of a spectrum that falls by 19 dB a band nothing is left there."""
NODES = 12
"""Of Gauss and Legendre, on a panel."""
WIDEST = 1.3
"""Largest ratio of both ends of a panel, on which a power law is a polynomial to rounding."""


@dataclass(frozen=True)
class LineSpectrum:
    """C_line(q) = c_i (q / q_i)^(-p_i) between the wavenumbers q_i [rad/m] at which it has the densities c_i [m^3].

    The first law continues to longer waves, the last to shorter ones, where it falls as 1/q at the least and as q^-20
    at the most: all integrals over short waves have an end. wavenumbers: two or more, ascending, positive; densities:
    positive.
    """

    wavenumbers: tuple[float, ...]
    densities: tuple[float, ...]

    def __post_init__(self) -> None:
        q, c = np.array(self.wavenumbers), np.array(self.densities)
        if q.ndim != 1 or q.size < 2 or not (np.isfinite(q).all() and q[0] > 0 and (np.diff(q) > 0).all()):
            raise ValueError(f"wavenumbers must be two or more, positive and ascending, got {self.wavenumbers}")
        if c.shape != q.shape or not (np.isfinite(c).all() and (c > 0).all()):
            raise ValueError(f"densities must be positive, one a wavenumber, got {self.densities}")

    @classmethod
    def through(cls, wavenumbers: ArrayLike, densities: ArrayLike) -> "LineSpectrum":
        """Of arrays."""
        q, c = (np.asarray(each, dtype=np.float64).tolist() for each in (wavenumbers, densities))
        return cls(tuple(q), tuple(c))

    def steeper(self, by: float) -> "LineSpectrum":
        """The same with exponents p_i + by, and with its density at the first wavenumber."""
        q = np.array(self.wavenumbers)
        return LineSpectrum.through(q, np.array(self.densities) * (q / q[0]) ** -by)

    def from_wavenumber(self, q: float) -> "LineSpectrum":
        """The same with a first point at q, where that is less than the first; to it the line does not fall."""
        if q >= self.wavenumbers[0]:
            return self
        return LineSpectrum((q, *self.wavenumbers), (max(float(self(q)), self.densities[0]), *self.densities))

    @cached_property
    def exponents(self) -> FloatArray:
        """p_i, between the points and beyond the last."""
        between = -np.diff(np.log(self.densities)) / np.diff(np.log(self.wavenumbers))
        return np.append(between, np.clip(between[-1], LEAST_FALL, MOST_FALL))

    def __call__(self, q: ArrayLike) -> FloatArray:
        """C_line of wavenumbers q of any sign [m^3]."""
        k = np.abs(np.asarray(q, dtype=np.float64))
        law = np.clip(np.searchsorted(self.wavenumbers, k, side="right") - 1, 0, None)
        start, density = np.array(self.wavenumbers)[law], np.array(self.densities)[law]
        return np.asarray(density * (k / start) ** -self.exponents[law])

    def isotropic(self, s: ArrayLike) -> FloatArray:
        """C_2D(s) = -(1/pi) int_s^inf C_line'(q) dq / sqrt(q^2 - s^2), Abel's inverse of the line trace [m^4].

        Over k = sqrt(q^2 - s^2) the end point is regular, dq / k = dk / q; the last law has a beta integral. Negative
        where no isotropic surface has such a line: where a spectrum rises too steeply with q. s: positive, any shape.
        """
        radial = np.asarray(s, dtype=np.float64)
        flat = radial.ravel()
        found = sum((self._of_piece(flat, i) for i in range(len(self.wavenumbers) - 1)), self._of_last(flat))
        return np.asarray(found / math.pi).reshape(radial.shape)

    def _of_piece(self, s: FloatArray, law: int) -> FloatArray:
        """p c int q^(-p-2) dk over one of the laws; the first begins at s."""
        low, high = self.wavenumbers[law : law + 2]
        reached = s < high
        start = s[reached] if law == 0 else np.maximum(low, s[reached])
        panels = 1 + math.ceil(math.log(high / min(float(start.min(initial=high)), low)) / math.log(WIDEST))
        ends = np.geomspace(start, high, panels + 1)
        k = np.sqrt(np.maximum(ends**2 - s[reached] ** 2, 0.0))
        node, weight = gauss_legendre(NODES)
        half = np.diff(k, axis=0)[:, np.newaxis] / 2
        q = np.hypot(s[reached], k[:-1, np.newaxis] + half * (1 + node[:, np.newaxis]))
        found = np.zeros_like(s)
        found[reached] = np.sum(half * weight[:, np.newaxis] * self._falling(law, q) / q, axis=(0, 1))
        return found

    def _of_last(self, s: FloatArray) -> FloatArray:
        """p c int_{max(s, q_n)}^inf q^(-p-1) / sqrt(q^2 - s^2) dq = p c s^(-p-1) B((p+1)/2, 1/2; s^2/q^2) / 2."""
        last = len(self.wavenumbers) - 1
        p = float(self.exponents[-1])
        u = np.minimum(s / self.wavenumbers[last], 1.0) ** 2
        beta = special.beta((p + 1) / 2, 0.5) * special.betainc((p + 1) / 2, 0.5, u)
        return np.asarray(self._falling(last, s) * beta / 2)

    def _falling(self, law: int, q: FloatArray) -> FloatArray:
        """-C_line' = p c_i (q / q_i)^-p / q of one of the laws."""
        p = self.exponents[law]
        return np.asarray(p * self.densities[law] * (q / self.wavenumbers[law]) ** -p / q)
