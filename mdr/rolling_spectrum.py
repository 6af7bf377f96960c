"""The input spectrum with which springs have, for rolling, the force level of the half-space.

C_1D(q) = int_{-inf}^{inf} e(s a) / e(q a) C_2D(s) dk, s^2 = q^2 + k^2, e(t) = 1 / (1 + t^2).

A wave of wavenumber s that crosses the track at an angle appears along it as a longer wave q. On the half-space its
force goes as sin^2(s a) / s^2; that of the springs goes as sin^2(q a) / q^2. Averaged over their oscillation both go
from a^2 for long waves to 1 / (2 s^2) for short ones; a^2 e stands for that average. The result is exact in level
where both waves are long (then it is the line trace) or both short (then it is the integral of q^2 / s^2 C_2D, the
default). For an unbounded power law the default is Gamma(H + 3/2) / (sqrt(pi) Gamma(H + 2)) times Geike's spectrum.
Between these limits it is a compromise. Where s a >> 1 and q a << 1 it is 3 dB too high; e = 1 / (1 + 2 t^2) would be
right there, and 3 dB too low where waves of s a = 1 appear so.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import overload

import numpy as np

from mdr.checks import (
    FloatArray,
    Numbers,
    Spectrum,
    callable_spectrum,
    density,
    doubles,
    finite_array,
    held,
    number_or_array,
    positive,
)
from mdr.spectrum import gauss_legendre

NODES = 24
PANEL_RATIO = 1.4
"""Largest ratio of both ends of a panel of the quadrature, for power laws."""


@overload
def rolling_spectrum(q: float, c2d: Spectrum, *, edges: Sequence[float], contact_radius: float = math.inf) -> float: ...
@overload
def rolling_spectrum(
    q: Numbers, c2d: Spectrum, *, edges: Sequence[float], contact_radius: float = math.inf
) -> FloatArray: ...
def rolling_spectrum(
    q: float | Numbers, c2d: Spectrum, *, edges: Sequence[float], contact_radius: float = math.inf
) -> float | FloatArray:
    """Input spectrum with which springs have the force level of an isotropic surface on the half-space.

    Parameters
    ----------
    q : float or array_like
        Wavenumbers along the track, of any sign [rad/m]. Zero needs a finite ``contact_radius``.
    c2d : callable
        Isotropic spectrum C_2D(q) of the surface [m^4], smooth between the ``edges``, zero outside.
    edges : sequence of float
        Ends of the band and of its smooth pieces, ascending, positive [rad/m].
    contact_radius : float, optional
        Radius of contact a of the smooth wheel, positive [m]. Infinite by default: all waves are short beside it.

    Returns
    -------
    float or ndarray
        C_1D, shape of ``q`` [m^3]. It is for rolling alone: it keeps neither the height nor the gradient of the
        surface.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range, or ``c2d`` is not callable.

    Notes
    -----
    C_1D(q) = int_{-inf}^{inf} e(s a) / e(q a) C_2D(s) dk, s^2 = q^2 + k^2, e(t) = 1 / (1 + t^2). The level is exact
    for waves much longer or much shorter than the contact, and up to 3 dB off between; see the top of this file for
    the reasons. Source: linear elasticity of a circular contact of constant radius, by reciprocity with the flat
    punch.

    Examples
    --------
    >>> rough = mdr.SelfAffine(hurst=0.8, q_min=1e3, q_max=1e5, rms=1e-6)
    >>> q = np.array([2e3, 1e4, 5e4])
    >>> mdr.rolling_spectrum(q, rough.c2d, edges=(rough.q_min, rough.q_max)) / rough.c1d(q)
    array([0.3926, 0.3926, 0.3863])
    """
    wavenumber, ends = np.abs(finite_array("q", q)), _ascending(edges)
    if contact_radius != math.inf:
        positive("contact_radius", contact_radius)
    elif (wavenumber == 0).any():
        raise ValueError("q must not be zero where contact_radius is infinite, got a zero wavenumber")
    c2d = callable_spectrum("c2d", c2d)
    with doubles(q=float(wavenumber.max(initial=0.0)), edges=str(ends), contact_radius=contact_radius):
        flat = 0.0 if contact_radius == math.inf else 1 / contact_radius**2
        held(flat, ends[-1] ** 2)
        values = [_across(one, c2d, ends, flat) for one in wavenumber.ravel().tolist()]
        held(*values)
    return number_or_array(np.array(values).reshape(wavenumber.shape))


def _across(q: float, c2d: Spectrum, edges: list[float], flat: float) -> float:
    """int (flat + q^2) / (flat + s^2) C_2D(s) dk, over k, where the end point s = q is regular; flat = 1 / a^2."""
    if q >= edges[-1]:
        return 0.0
    ends = np.array(_panels(max(q, edges[0]), edges))
    k = np.sqrt(np.maximum(ends**2 - q**2, 0.0))
    node, weight = gauss_legendre(NODES)
    half = np.diff(k)[:, np.newaxis] / 2
    s = np.hypot(q, k[:-1, np.newaxis] + half * (1 + node))
    return float(2 * np.sum(half * weight * (flat + q**2) / (flat + s**2) * density("c2d", c2d(s))))


def _panels(first: float, edges: list[float]) -> list[float]:
    ends = [first]
    for edge in edges[1:]:
        while ends[-1] < edge:
            ends.append(min(edge, PANEL_RATIO * ends[-1]))
            held(ends[-1] - ends[-2], positive=True)
    return ends


def _ascending(edges: Sequence[float]) -> list[float]:
    given = finite_array("edges", edges, ndim=1)
    if given.size < 2 or given[0] <= 0 or (np.diff(given) <= 0).any():
        raise ValueError(f"edges must be two or more positive wavenumbers, ascending, got {given.tolist()}")
    return [float(edge) for edge in given]
