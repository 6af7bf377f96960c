"""A wheel on its linear contact spring with a dashpot to the inertial frame: what a change of the force moves.

M z'' = F - F_N - c z' with F = F_N + k (d - d_N) + dF, c = 2 zeta M omega_0 and omega_0 = sqrt(k / M). Frequencies are
angular, omega in rad/s; motions go as exp(i omega t).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


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


def acceleration_over_force(omega: ArrayLike, *, eigenfrequency: float, mass: float, damping: float) -> FloatArray:
    """abs(a(omega) / dF(omega))^2 = omega^4 / abs(k - M omega^2 + i c omega)^2 [kg^-2], dF at a fixed approach.

    With damping zero `theory.wheel.acceleration_over_force`. At the resonance 1 / (2 zeta M)^2.
    """
    ratio = eigenfrequency / np.asarray(omega, dtype=np.float64)
    return np.asarray(1 / ((mass * (1 - ratio**2)) ** 2 + (2 * damping * mass * ratio) ** 2))


def contact_force_over_force(omega: ArrayLike, *, eigenfrequency: float, damping: float) -> FloatArray:
    """abs((F - F_N) / dF)^2: the force of the contact that moves, over that at a fixed approach [-].

    (1 + (2 zeta r)^2) / ((1 - r^2)^2 + (2 zeta r)^2), r = omega_0 / omega.
    """
    ratio = eigenfrequency / np.asarray(omega, dtype=np.float64)
    dashpot = (2 * damping * ratio) ** 2
    return np.asarray((1 + dashpot) / ((1 - ratio**2) ** 2 + dashpot))
