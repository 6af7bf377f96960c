"""Moments of spectra, int |q|^n C, of a surface and of a line."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import integrate

import mdr

Spectrum = Callable[[ArrayLike], NDArray[np.float64]]


def surface_moment(spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_2D d^2q."""
    return _integral(lambda q: 2 * np.pi * q ** (n + 1) * spectrum.c2d(q), spectrum.q_min, spectrum.q_max)


def line_moment(c1d: Spectrum, spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_1D dq, both sides; a line has waves below q_min too."""
    below = _integral(lambda q: 2 * q**n * c1d(q), 0.0, spectrum.q_min * (1 - 1e-9))
    return below + _integral(lambda q: 2 * q**n * c1d(q), spectrum.q_min * (1 + 1e-12), spectrum.q_max)


def mean_power_of_cosine(n: int) -> float:
    """Mean of |cos|^n over all directions: Gamma((n+1)/2) / (sqrt(pi) Gamma(n/2+1))."""
    return math.gamma((n + 1) / 2) / (math.sqrt(math.pi) * math.gamma(n / 2 + 1))


def _integral(f: Callable[[float], ArrayLike], low: float, high: float) -> float:
    """Adaptive quadrature, relative error 1e-10."""
    value, _ = integrate.quad(f, low, high, epsabs=0.0, epsrel=1e-11, limit=400)
    return float(value)
