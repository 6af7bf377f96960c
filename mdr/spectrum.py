"""Self-affine spectra; Geike's rule, its inverse; the line trace.

Power spectral densities are two-sided: <h^2> = int_{-inf}^{inf} C_1D dq = 2 pi int_0^inf q C_2D dq.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from mdr.checks import FloatArray, Spectrum, count, density, doubles, finite, finite_array, held, positive

# The wave at q_min = 2 pi / L carries most of the height; rounding must not push it out of the band.
EDGE = 1e-9
# Below this fraction of q_min the line trace equals its limit at q = 0 to rounding.
FLAT = 1e-8


def geike(q: ArrayLike, c2d: ArrayLike | Spectrum) -> FloatArray:
    """The 1D spectrum that keeps every moment of an isotropic 2D spectrum.

    C_1D(q) = pi |q| C_2D(|q|), so that int |q|^n C_1D dq = int |q|^n C_2D d^2q for every n.

    q: angular wavenumbers, any sign [rad/m]; c2d: densities at q, or a callable of |q| [m^4].
    Returns C_1D, shape of q and c2d broadcast [m^3].
    Raises ValueError for negative densities, NaN or infinities.
    Source: rule of Geike; Popov and Hess, (10.12).
    """
    wavenumber = np.abs(finite_array("q", q))
    values = _values("c2d", c2d, wavenumber)
    with doubles(q=_largest(wavenumber), c2d=_largest(values)):
        mapped = np.pi * wavenumber * values
        held(mapped)
    return mapped


def inverse_geike(q: ArrayLike, c1d: ArrayLike | Spectrum) -> FloatArray:
    """The isotropic 2D spectrum whose Geike transform is the given 1D spectrum.

    C_2D(q) = C_1D(q) / (pi |q|), q != 0.

    q: angular wavenumbers, not zero [rad/m]; c1d: densities at q, or a callable of |q| [m^3].
    Returns C_2D [m^4].
    Raises ValueError for q = 0, negative densities, NaN or infinities.
    Source: Popov and Hess, (10.12), solved for C_2D.
    """
    wavenumber = np.abs(finite_array("q", q))
    if (wavenumber == 0).any():
        raise ValueError("q must not be zero for the inverse of Geike's rule, got a zero wavenumber")
    values = _values("c1d", c1d, wavenumber)
    with doubles(q=_largest(wavenumber), c1d=_largest(values)):
        mapped: FloatArray = values / (np.pi * wavenumber)
        held(mapped, np.pi * wavenumber)
    return mapped


def line_trace(q: ArrayLike, c2d: Spectrum, *, q_max: float, nodes: int = 400) -> FloatArray:
    """The spectrum along a straight line cut through an isotropic surface.

    C_line(q) = int C_2D(sqrt(q^2 + k^2)) dk = 2 int_q^inf C_2D(s) s / sqrt(s^2 - q^2) ds,
    by Gauss-Legendre quadrature over k, where the integrand has no singularity.

    q: along the line [rad/m]; c2d: callable, smooth up to q_max and zero beyond [m^4]; nodes: of the quadrature.
    A spectrum with jumps inside the band converges slowly: use `SelfAffine.line` for a power law with cut-offs.
    Returns C_line, shape of q [m^3].
    Source: the spectrum of a section is that of the surface, integrated across it; s^2 = q^2 + k^2.
    """
    wavenumber = np.abs(finite_array("q", q))
    q_max, (node, weight) = positive("q_max", q_max), _gauss_legendre(count("nodes", nodes, least=2))
    with doubles(q=_largest(wavenumber), q_max=q_max):
        reach = np.sqrt(np.maximum(q_max**2 - wavenumber**2, 0.0))
        across = reach[..., np.newaxis] * (node + 1) / 2
        total = np.hypot(wavenumber[..., np.newaxis], across)
        integral: FloatArray = np.sum(_values("c2d", c2d, total) * weight, axis=-1) * reach
        held(integral)
    return integral


@dataclass(frozen=True, kw_only=True)
class SelfAffine:
    """Isotropic self-affine roughness between two cut-offs, no roll-off.

    C_2D(q) = A q^(-2H-2) for q_min <= q <= q_max, else 0;  A = H rms^2 / (pi (q_min^(-2H) - q_max^(-2H))).

    hurst: H in (0, 1.2]; q_min < q_max: angular wavenumbers [rad/m]; rms: root mean square height [m].
    The edges of the band belong to it, within a relative 1e-9.
    Raises ValueError naming the argument that is out of range.
    """

    hurst: float
    q_min: float
    q_max: float
    rms: float

    def __post_init__(self) -> None:
        hurst = finite("hurst", self.hurst)
        if not 0 < hurst <= 1.2:
            raise ValueError(f"hurst must lie in (0, 1.2], got {hurst}")
        if not positive("q_min", self.q_min) < positive("q_max", self.q_max):
            raise ValueError(f"q_min must be below q_max, got q_min={self.q_min} and q_max={self.q_max}")
        for name in ("hurst", "q_min", "q_max", "rms"):
            object.__setattr__(self, name, positive(name, getattr(self, name)))
        with doubles(q_min=self.q_min, q_max=self.q_max, rms=self.rms):
            held(self._level, positive=True)

    def c2d(self, q: ArrayLike) -> FloatArray:
        """C_2D(|q|) [m^4]."""
        q, inside = self._in_band(q)
        power = (np.where(inside, q, self.q_min) / self.q_min) ** (-2 * self.hurst - 2)
        return np.where(inside, self._level * power, 0.0)

    def c1d(self, q: ArrayLike) -> FloatArray:
        """C_1D(q) = pi |q| C_2D(|q|), Geike's rule (10.12) [m^3]."""
        return geike(q, self.c2d)

    def line(self, q: ArrayLike) -> FloatArray:
        """Spectrum along a straight line through the surface [m^3].

        C_line(q) = A |q|^(-2H-1) int t^(H-1/2) (1-t)^(-1/2) dt over (q/q_max)^2 < t < min(1, (q/q_min)^2),
        with t = (q/s)^2: an incomplete beta function. Below q_min it is a plateau, not zero.
        Source: `line_trace`, with C_2D inserted.
        """
        q, _ = self._in_band(q)
        flat = q < FLAT * self.q_min
        q = np.where(flat, FLAT * self.q_min, np.minimum(q, self.q_max))
        low, high = (q / self.q_max) ** 2, np.minimum(1.0, (q / self.q_min) ** 2)
        b, c = self.hurst + 0.5, 0.5
        # near t = 1 the complement keeps the digits that the difference of two values near one would lose
        upper = special.betainc(c, b, 1 - low)
        between = np.where(high < 1, special.betainc(b, c, high) - special.betainc(b, c, low), upper)
        with doubles(q_min=self.q_min, rms=self.rms):
            trace = self._level * self.q_min * (q / self.q_min) ** (-2 * self.hurst - 1) * special.beta(b, c) * between
            held(trace)
        return np.asarray(trace, dtype=np.float64)

    @property
    def _level(self) -> float:
        """C_2D at q_min [m^4]."""
        lost_above = -math.expm1(-2 * self.hurst * math.log(self.q_max / self.q_min))
        return self.hurst * self.rms**2 / (math.pi * self.q_min**2 * lost_above)

    def _in_band(self, q: ArrayLike) -> tuple[FloatArray, NDArray[np.bool_]]:
        wavenumber = np.abs(finite_array("q", q))
        return wavenumber, (wavenumber >= self.q_min * (1 - EDGE)) & (wavenumber <= self.q_max * (1 + EDGE))


@cache
def _gauss_legendre(nodes: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights on [-1, 1]."""
    return np.polynomial.legendre.leggauss(nodes)


def _largest(values: FloatArray) -> float:
    return float(values.max(initial=0.0))


def _values(name: str, given: ArrayLike | Spectrum, q: FloatArray) -> FloatArray:
    values = density(name, given(q) if callable(given) else given)
    try:
        np.broadcast_shapes(values.shape, q.shape)
    except ValueError:
        raise ValueError(f"{name} and q must have matching shapes, got {values.shape} and {q.shape}") from None
    return values
