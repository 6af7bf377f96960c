"""Self-affine spectra, Geike's rule and its inverse, the line trace.

Power spectral densities are two-sided: <h^2> = int_{-inf}^{inf} C_1D dq = 2 pi int_0^inf q C_2D dq.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import overload

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from mdr.checks import (
    FloatArray,
    Numbers,
    Spectrum,
    callable_spectrum,
    count,
    density,
    doubles,
    finite,
    finite_array,
    held,
    number_or_array,
    positive,
)
from mdr.results import short

# The wave at q_min = 2 pi / L carries most of the height; rounding must not push it out of the band.
BAND_TOLERANCE = 1e-9
# Below this fraction of q_min the line trace equals its limit at q = 0 to rounding.
PLATEAU_FRACTION = 1e-8


@overload
def geike(q: float, c2d: float | Spectrum) -> float: ...
@overload
def geike(q: Numbers, c2d: ArrayLike | Spectrum) -> FloatArray: ...
@overload
def geike(q: float, c2d: Numbers) -> FloatArray: ...
def geike(q: float | Numbers, c2d: ArrayLike | Spectrum) -> float | FloatArray:
    """Geike's rule: the 1D spectrum with every moment of an isotropic 2D spectrum.

    Parameters
    ----------
    q : float or array_like
        Angular wavenumbers, of any sign [rad/m].
    c2d : array_like or callable
        Isotropic spectrum C_2D [m^4]: values at ``q``, or a callable of abs(q).

    Returns
    -------
    float or ndarray
        C_1D [m^3], of the shape to which ``q`` and ``c2d`` broadcast.

    Raises
    ------
    ValueError
        If a density is negative, a value is not finite, or shapes do not match.

    Notes
    -----
    C_1D(q) = pi abs(q) C_2D(abs(q)) [1]_, so that int abs(q)^n C_1D dq = int q^n C_2D d^2q for every n: the height
    and the gradient of the surface are kept.

    References
    ----------
    .. [1] Popov and Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, (10.12).

    Examples
    --------
    >>> mdr.geike([1.0, -2.0], [1.0, 1.0])
    array([3.1416, 6.2832])
    """
    wavenumber = np.abs(finite_array("q", q))
    values = _values("c2d", c2d, wavenumber)
    with doubles(q=_largest(wavenumber), c2d=_largest(values)):
        mapped = np.pi * wavenumber * values
        held(mapped)
    return number_or_array(mapped)


@overload
def inverse_geike(q: float, c1d: float | Spectrum) -> float: ...
@overload
def inverse_geike(q: Numbers, c1d: ArrayLike | Spectrum) -> FloatArray: ...
@overload
def inverse_geike(q: float, c1d: Numbers) -> FloatArray: ...
def inverse_geike(q: float | Numbers, c1d: ArrayLike | Spectrum) -> float | FloatArray:
    """Isotropic 2D spectrum whose 1D spectrum by Geike's rule is given.

    Parameters
    ----------
    q : float or array_like
        Angular wavenumbers, not zero [rad/m].
    c1d : array_like or callable
        Spectrum C_1D [m^3]: values at ``q``, or a callable of abs(q).

    Returns
    -------
    float or ndarray
        C_2D(q) = C_1D(q) / (pi abs(q)) [m^4], of the shape to which ``q`` and ``c1d`` broadcast.

    Raises
    ------
    ValueError
        If a wavenumber is zero, a density is negative, a value is not finite, or shapes do not match.

    Notes
    -----
    Source: Popov and Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, (10.12), solved for
    C_2D.

    Examples
    --------
    >>> q = np.array([1.0, 2.0])
    >>> mdr.inverse_geike(q, mdr.geike(q, [3.0, 5.0]))
    array([3., 5.])
    """
    wavenumber = np.abs(finite_array("q", q))
    if (wavenumber == 0).any():
        raise ValueError("q must not be zero for the inverse of Geike's rule, got a zero wavenumber")
    values = _values("c1d", c1d, wavenumber)
    with doubles(q=_largest(wavenumber), c1d=_largest(values)):
        mapped: FloatArray = values / (np.pi * wavenumber)
        held(mapped, np.pi * wavenumber)
    return number_or_array(mapped)


@overload
def line_trace(q: float, c2d: Spectrum, *, q_max: float, nodes: int = 400) -> float: ...
@overload
def line_trace(q: Numbers, c2d: Spectrum, *, q_max: float, nodes: int = 400) -> FloatArray: ...
def line_trace(q: float | Numbers, c2d: Spectrum, *, q_max: float, nodes: int = 400) -> float | FloatArray:
    """Spectrum along a straight line through an isotropic surface.

    Parameters
    ----------
    q : float or array_like
        Angular wavenumbers along the line, of any sign [rad/m].
    c2d : callable
        Isotropic spectrum C_2D(q) [m^4], smooth up to ``q_max`` and zero beyond.
    q_max : float
        End of the spectrum [rad/m].
    nodes : int, optional
        Nodes of the quadrature, at least 2.

    Returns
    -------
    float or ndarray
        C_line, shape of ``q`` [m^3].

    Raises
    ------
    ValueError
        If a value is not finite or out of range, or a density is negative.

    See Also
    --------
    SelfAffine.line : The closed form for a power law with cut-offs, for which this quadrature converges slowly.

    Notes
    -----
    C_line(q) = int C_2D(sqrt(q^2 + k^2)) dk = 2 int_q^inf C_2D(s) s / sqrt(s^2 - q^2) ds. The quadrature is that of
    Gauss and Legendre over k, where the integrand has no singularity. A line keeps the height of the surface, and
    half of its mean square gradient.

    Examples
    --------
    A constant spectrum up to q_max has C_line = 2 sqrt(q_max^2 - q^2):

    >>> mdr.line_trace([0.0, 0.6], lambda q: np.where(q <= 1, 1.0, 0.0), q_max=1.0)
    array([2. , 1.6])
    """
    wavenumber = np.abs(finite_array("q", q))
    q_max, (node, weight) = positive("q_max", q_max), gauss_legendre(count("nodes", nodes, least=2))
    with doubles(q=_largest(wavenumber), q_max=q_max):
        reach = np.sqrt(np.maximum(q_max**2 - wavenumber**2, 0.0))
        across = reach[..., np.newaxis] * (node + 1) / 2
        total = np.hypot(wavenumber[..., np.newaxis], across)
        integral: FloatArray = np.sum(_values("c2d", c2d, total) * weight, axis=-1) * reach
        held(integral)
    return number_or_array(integral)


@dataclass(frozen=True, kw_only=True)
class SelfAffine:
    """Isotropic self-affine roughness between two cut-offs, without roll-off.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, in (0, 1.2].
    q_min, q_max : float
        Cut-off wavenumbers, q_min < q_max [rad/m]. They belong to the band, within a relative 1e-9.
    rms : float
        Root mean square height h [m].

    Raises
    ------
    ValueError, TypeError
        If an argument is out of range; the message names it.

    Notes
    -----
    C_2D(q) = A q^(-2H-2) for q_min <= q <= q_max, else 0, with A = H h^2 / (pi (q_min^(-2H) - q_max^(-2H))). The
    two-sided spectrum has <h^2> = 2 pi int q C_2D dq.

    Examples
    --------
    >>> rough = mdr.SelfAffine(hurst=0.8, q_min=1e4, q_max=1e5, rms=1e-6)
    >>> q = np.linspace(1e4, 1e5, 20001)
    >>> print(f"{np.sqrt(np.trapezoid(2 * rough.c1d(q), q)):.4g} m")
    1e-06 m
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

    def __repr__(self) -> str:
        ends = ", ".join(f"{name}={short(getattr(self, name), 5)}" for name in ("hurst", "q_min", "q_max", "rms"))
        return f"SelfAffine({ends})"

    @overload
    def c2d(self, q: float) -> float: ...
    @overload
    def c2d(self, q: Numbers) -> FloatArray: ...
    def c2d(self, q: float | Numbers) -> float | FloatArray:
        """Isotropic spectrum C_2D(abs(q)) of the surface, shape of ``q`` [m^4]."""
        return number_or_array(self._density(np.abs(finite_array("q", q))))

    def _density(self, q: FloatArray) -> FloatArray:
        """C_2D at q >= 0 [m^4]."""
        inside = self._in_band(q)
        power = (np.where(inside, q, self.q_min) / self.q_min) ** (-2 * self.hurst - 2)
        return np.where(inside, self._level * power, 0.0)

    @overload
    def c1d(self, q: float) -> float: ...
    @overload
    def c1d(self, q: Numbers) -> FloatArray: ...
    def c1d(self, q: float | Numbers) -> float | FloatArray:
        """Spectrum of Geike's rule, C_1D(q) = pi abs(q) C_2D(abs(q)), shape of ``q`` [m^3]."""
        return geike(q, self.c2d)

    @overload
    def line(self, q: float) -> float: ...
    @overload
    def line(self, q: Numbers) -> FloatArray: ...
    def line(self, q: float | Numbers) -> float | FloatArray:
        """Spectrum along a straight line through the surface, shape of ``q`` [m^3].

        Notes
        -----
        `line_trace` of C_2D: C_line(q) = A abs(q)^(-2H-1) int t^(H-1/2) (1-t)^(-1/2) dt, t = (q/s)^2, over
        (q/q_max)^2 < t < min(1, (q/q_min)^2): an incomplete beta function. Below q_min it is a plateau, not zero.
        """
        along = np.abs(finite_array("q", q))
        flat = along < PLATEAU_FRACTION * self.q_min
        along = np.where(flat, PLATEAU_FRACTION * self.q_min, np.minimum(along, self.q_max))
        low, high = (along / self.q_max) ** 2, np.minimum(1.0, (along / self.q_min) ** 2)
        b, c = self.hurst + 0.5, 0.5
        # near t = 1 the complement keeps the digits that the difference of two values near one would lose
        upper = scipy.special.betainc(c, b, 1 - low)
        between = np.where(high < 1, scipy.special.betainc(b, c, high) - scipy.special.betainc(b, c, low), upper)
        with doubles(q_min=self.q_min, rms=self.rms):
            whole = scipy.special.beta(b, c)
            trace = self._level * self.q_min * (along / self.q_min) ** (-2 * self.hurst - 1) * whole * between
            held(trace)
        return number_or_array(np.asarray(trace, dtype=np.float64))

    @property
    def _level(self) -> float:
        """C_2D at q_min [m^4]."""
        lost_above = -math.expm1(-2 * self.hurst * math.log(self.q_max / self.q_min))
        return self.hurst * self.rms**2 / (math.pi * self.q_min**2 * lost_above)

    def _in_band(self, q: FloatArray) -> NDArray[np.bool_]:
        """Where q >= 0 lies between the cut-offs."""
        return (q >= self.q_min * (1 - BAND_TOLERANCE)) & (q <= self.q_max * (1 + BAND_TOLERANCE))


@cache
def gauss_legendre(nodes: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights on [-1, 1]."""
    return np.polynomial.legendre.leggauss(nodes)


def _largest(values: FloatArray) -> float:
    return float(values.max(initial=0.0))


def _values(name: str, given: ArrayLike | Spectrum, q: FloatArray) -> FloatArray:
    if hasattr(given, name):
        given = callable_spectrum(name, given)
    values = density(name, given(q) if callable(given) else given)
    try:
        np.broadcast_shapes(values.shape, q.shape)
    except ValueError:
        raise ValueError(f"{name} and q must have matching shapes, got {values.shape} and {q.shape}") from None
    return values
