"""Moments of spectra, int |q|^n C: of a surface, of a line, and as sums over the waves of a grid."""

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


def sum_over_profile(c1d: Spectrum, n: int, points: int, length: float) -> float:
    """sum |q|^n 2 pi C_1D / L over the waves of the points."""
    q = 2 * np.pi * np.abs(np.fft.fftfreq(points, length / points))
    return float(np.sum(q**n * (2 * np.pi / length * c1d(q))))


def sum_over_surface(c2d: Spectrum, n: int, points: int, length: float) -> float:
    """sum |q|^n (2 pi / L)^2 C_2D over the waves of the square grid."""
    axis = 2 * np.pi * np.fft.fftfreq(points, length / points)
    q = np.hypot(axis[:, np.newaxis], axis)
    return float(np.sum(q**n * ((2 * np.pi / length) ** 2 * c2d(q))))


def mean_power_of_cosine(n: int) -> float:
    """Mean of |cos|^n over all directions: Gamma((n+1)/2) / (sqrt(pi) Gamma(n/2+1))."""
    return math.gamma((n + 1) / 2) / (math.sqrt(math.pi) * math.gamma(n / 2 + 1))


def _integral(f: Callable[[float], ArrayLike], low: float, high: float) -> float:
    """Adaptive quadrature, relative error 1e-10."""
    value, _ = integrate.quad(f, low, high, epsabs=0.0, epsrel=1e-11, limit=400)
    return float(value)
