"""A wheel on its contact spring: the resonance, and the leakage of a finite record.

References of the dynamic wheel, which import neither method. M z'' = F - F_N - c z', z upward, the approach d
downward, F = F_N + k (d - d_N) + dF, c = 2 zeta M omega_0, omega_0 = sqrt(k / M).
Frequencies are angular, omega in rad/s; spectra are those of (14.17), two-sided over the frequency f: <x^2> = int A df.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

FloatArray = NDArray[np.float64]


def eigenfrequency(*, contact_radius: float, modulus: float, mass: float) -> float:
    """omega_eigen = sqrt(2 a E* / M) [rad/s]. Source: Popov and Hess, section 14.3; k = 2 E* a of Hertz."""
    return math.sqrt(2 * contact_radius * modulus / mass)


def dynamic_stiffness(
    omega: ArrayLike, *, stiffness: float, mass: float, damping: float = 0.0, time_step: float = 0.0
) -> NDArray[np.complex128]:
    """-dF / (d - d_N) = k - M omega^2 + i c omega of a linear contact [N/m].

    damping: zeta, of critical. time_step: of velocity Verlet, whose motion has it exactly with 2 sin(omega dt / 2) / dt
    in place of the omega of the mass, and sin(omega dt) / dt of the dashpot; zero: of continuous time [s].
    """
    w = np.asarray(omega, dtype=np.float64)
    inertia, speed = w**2, w
    if time_step:
        inertia, speed = (2 * np.sin(w * time_step / 2) / time_step) ** 2, np.sin(w * time_step) / time_step
    dashpot = 2 * damping * np.sqrt(stiffness * mass)
    return np.asarray(stiffness - mass * inertia + 1j * dashpot * speed)


def contact_resonance(*, stiffness: float, mass: float, impedance: Callable[[float], NDArray[np.complex128]]) -> float:
    """omega at which the imaginary parts of i omega / k + 1 / (i omega M) + 1 / Z(omega) cancel [rad/s].

    The mobilities of the contact spring, of the wheel and of the rail under it; impedance: Z [N s/m], of a mass or a
    damper. Above sqrt(k / M), where the rail is rigid. Source: Thompson, Railway Noise and Vibration, chapter 2.
    """
    rigid = math.sqrt(stiffness / mass)

    def left(omega: float) -> float:
        return omega / stiffness - 1 / (omega * mass) + float((1 / impedance(omega)).imag)

    high = rigid
    while left(high) < 0:
        high *= 2
    return float(brentq(left, rigid, high)) if high > rigid else rigid


def acceleration_over_force(
    omega: ArrayLike, *, eigenfrequency: float, mass: float, damping: float = 0.0
) -> FloatArray:
    """abs(a(omega) / dF(omega))^2 = omega^4 / abs(k - M omega^2 + i c omega)^2 [kg^-2], dF at a fixed approach.

    Without damping 1 / (M (1 - (omega_0 / omega)^2))^2. At the resonance 1 / (2 zeta M)^2.
    """
    ratio = eigenfrequency / np.asarray(omega, dtype=np.float64)
    return np.asarray(1 / ((mass * (1 - ratio**2)) ** 2 + (2 * damping * mass * ratio) ** 2))


def over_the_resonance(*, eigenfrequency: float, mass: float, damping: float) -> float:
    """int abs(a(omega) / dF(omega))^2 df over the resonance, positive frequencies, omega_0 / (8 zeta M^2) [Hz/kg^2].

    Leading order in zeta, positive: under a force whose spectrum is level there, what region 1 of the acceleration
    holds. Without damping there is no such integral: the level grows as the record gets longer.
    """
    if not damping > 0:
        raise ValueError(f"damping must be positive, got {damping:g}: a resonance of no width has no integral")
    return eigenfrequency / (8 * damping * mass**2)


def contact_force_over_force(omega: ArrayLike, *, eigenfrequency: float, damping: float) -> FloatArray:
    """abs((F - F_N) / dF)^2: the force of the contact that moves, over that at a fixed approach [-].

    (1 + (2 zeta r)^2) / ((1 - r^2)^2 + (2 zeta r)^2), r = omega_0 / omega.
    """
    ratio = eigenfrequency / np.asarray(omega, dtype=np.float64)
    dashpot = (2 * damping * ratio) ** 2
    return np.asarray((1 + dashpot) / ((1 - ratio**2) ** 2 + dashpot))


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


def break_exponent(hurst: float) -> float:
    """omega_break ~ T^(1 / (2 H + 1)): where a floor J^2 / (omega^2 T) meets a spectrum ~ omega^(-2 H - 3) [-]."""
    return 1 / (2 * hurst + 1)
