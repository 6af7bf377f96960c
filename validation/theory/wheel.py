"""A wheel on its contact spring: the resonance, free vibration, and the leakage of a finite record.

References of the dynamic wheel, which import neither method. M z'' = F - F_N, z upward, the approach d downward.
Frequencies are angular, omega in rad/s; spectra are those of (14.17), two-sided over the frequency f: <x^2> = int A df.
"""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.theory.gauss_legendre import gauss_legendre

FloatArray = NDArray[np.float64]

NODES = 100
"""Of Gauss and Legendre on each part of a period."""
SLIVER = 1e-6
"""Of the approach without contact, which no part of a period of its own resolves."""


def eigenfrequency(*, contact_radius: float, modulus: float, mass: float) -> float:
    """omega_eigen = sqrt(2 a E* / M) [rad/s]. Source: Popov and Hess, section 14.3; k = 2 E* a of Hertz."""
    return math.sqrt(2 * contact_radius * modulus / mass)


def hertz_period(highest: float) -> float:
    """Period of free vibration on a Hertz contact, over that of a small one, 2 pi / omega_0 [-].

    M d'' = F_N - F_N (d/d_N)^(3/2), released at the approach `highest`, over d_N of static equilibrium, above one. With
    u = d / d_N and tau = omega_0 t, u'' = (2/3) (1 - u^(3/2)), since omega_0^2 = (3/2) F_N / (M d_N); without contact
    u'' = 2/3. The energy u'^2 / 2 + V(u) is kept, V = (2/3) ((2/5) max(u, 0)^(5/2) - u), so the period is
    2 int du / sqrt(2 (V(highest) - V(u))) between both turning points; u = middle - half cos(theta) takes the singular
    ends away, for Gauss and Legendre.
    """
    if not highest > 1:
        raise ValueError(f"highest must be above one, got {highest}")
    above = highest - 1
    energy = _potential(above)
    below = _other_turning_point(energy)
    middle, half = (above + below) / 2, (above - below) / 2
    # where contact is lost the force has no second derivative
    ends = [0.0, math.acos((middle + 1) / half), math.pi] if below < -1 - SLIVER else [0.0, math.pi]
    node, weight = gauss_legendre(NODES)
    period = 0.0
    for first, last in pairwise(ends):
        theta = (first + last) / 2 + (last - first) / 2 * node
        left = energy - np.vectorize(_potential)(middle - half * np.cos(theta))
        period += (last - first) / 2 * float(weight @ (2 * half * np.sin(theta) / np.sqrt(2 * left)))
    return period / (2 * math.pi)


def _potential(x: float) -> float:
    """V over that of rest at u = 1 + x; by its series where rounding would leave no digits."""
    if x < -1:
        return -2 / 3 * (x + 0.4)
    if abs(x) < 0.03:
        terms = (0.4 * float(special.binom(2.5, k)) * x ** (k - 2) for k in range(2, 14))
        return 2 / 3 * x * x * math.fsum(terms)
    return 2 / 3 * (0.4 * (math.pow(1 + x, 2.5) - 1) - x)


def _other_turning_point(energy: float) -> float:
    """x below rest of this energy; without contact V = -(2/3) (x + 2/5)."""
    if energy >= _potential(-1.0):
        return -1.5 * energy - 0.4
    low, high = -1.0, 0.0
    while True:
        middle = (low + high) / 2
        if middle in (low, high):
            return middle
        low, high = (middle, high) if _potential(middle) > energy else (low, middle)


def acceleration_over_force(omega: ArrayLike, *, eigenfrequency: float, mass: float) -> FloatArray:
    """abs(a(omega) / dF(omega))^2 = 1 / (M (1 - (omega_0 / omega)^2))^2 [kg^-2], dF at a fixed approach.

    M z'' = dF - k z without damping: a = -omega^2 z.
    """
    ratio = eigenfrequency / np.asarray(omega, dtype=np.float64)
    return np.asarray(1 / (mass * (1 - ratio**2)) ** 2)


def over_frequency(force_spectrum: ArrayLike, *, speed: float) -> FloatArray:
    """From C_F(q), <F^2> = int C_F dq, to (14.17), <F^2> = int A df: A(q v_0 / (2 pi)) = 2 pi C_F(q) / v_0 [N^2 s]."""
    return np.asarray(2 * math.pi / speed * np.asarray(force_spectrum, dtype=np.float64))


def leakage(omega: ArrayLike, *, jump: ArrayLike, time_step: float, duration: float) -> FloatArray:
    """The floor ~ omega^-2 that a jump between the end and the beginning of a record adds to (14.17).

    The periodic continuation of a ramp with a jump J has abs(FFT) = abs(J / (2 sin(omega dt / 2))), so A = J^2 dt^2 /
    (4 T sin^2(omega dt / 2)), which is J^2 / (omega^2 T) for omega dt << 1.
    jump: J of each record, or its root mean square, as x; time_step: dt [s]; duration: T [s]. Returns [x^2 s].
    """
    half = np.asarray(omega, dtype=np.float64) * time_step / 2
    return np.asarray(np.asarray(jump) ** 2 * time_step**2 / (4 * duration * np.sin(half) ** 2))


def mean_square_jump(forced: float, *, eigenfrequency: float, duration: float) -> float:
    """<J^2> of a wheel from static equilibrium on an open track: (1 + cos^2(omega_0 T)) <a_f^2> [m^2/s^4].

    The record begins with a = 0, where free vibration cancels the forced acceleration a_f = dF / M; it ends with
    another a_f, and with that vibration turned by omega_0 T. For waves far above the resonance, whose motion is small.
    forced: <a_f^2>, int A df of linear theory.
    """
    return forced * (1 + math.cos(eigenfrequency * duration) ** 2)


def break_exponent(hurst: float) -> float:
    """omega_break ~ T^(1 / (2 H + 1)): where a floor J^2 / (omega^2 T) meets a spectrum ~ omega^(-2 H - 3) [-]."""
    return 1 / (2 * hurst + 1)
