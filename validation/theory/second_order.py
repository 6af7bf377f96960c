"""Second order in the roughness: the force of one-sided springs under a rolling wheel, and the acceleration it makes.

The linear force has no wave outside of the band of the roughness; products of two of its waves have sums and
differences of their wavenumbers. References, which import neither method. Spectra are two-sided: <F^2> = int C_F dq;
A is that of (14.17).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.theory.closed_forms import circular_punch_stiffness
from validation.theory.rolling import response
from validation.theory.wheel import dynamic_stiffness, over_frequency

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

POINTS = 16_000
"""Of the trapezoidal rule from -q_max to q_max."""


@dataclass(frozen=True, kw_only=True)
class RollingWheel:
    """A wheel that rolls on springs, in static equilibrium but for what the roughness does.

    radius: R [m]; modulus: E* [Pa]; contact_radius: a [m]; mass: M [kg], infinite for a fixed approach; speed: v_0
    [m/s]; damping: ratio zeta of a dashpot to the ground, c = 2 zeta M omega_0, not negative.

    With the heights at the ends of the contact over the wheel in its linear motion d_1, u(x) = h(x + a) + d_1(x) and
    v(x) = h(x - a) + d_1(x), the contact is longer there by R u / (2 a), and the springs of that part bear u / 2 in the
    mean: F_2 = E* R / (4 a) (u^2 + v^2). That is k' d_1^2 / 2 + d_1 dF_1/dd + F_2(x) in one: the stiffness that grows
    with the approach, the contact that grows under a bump, and the ends of the contact.
    Range: h much smaller than d, slopes much smaller than 2 a / R at the ends of the contact; Gaussian heights.
    Source: expansion of (14.15), Popov and Hess, to second order in h and d_1.
    """

    radius: float
    modulus: float
    contact_radius: float
    mass: float
    speed: float
    damping: float = 0.0

    def compliance(self, q: ArrayLike) -> ComplexArray:
        """-d / F of the wheel on its contact spring, 1 / (k - M omega^2 + i c omega), omega = q v_0 [m/N]."""
        omega = np.asarray(q, dtype=np.float64) * self.speed
        if math.isinf(self.mass):
            return np.zeros(omega.shape, dtype=np.complex128)
        stiffness = circular_punch_stiffness(radius=self.contact_radius, modulus=self.modulus)
        return 1 / dynamic_stiffness(omega, stiffness=stiffness, mass=self.mass, damping=self.damping)

    def motion(self, q: ArrayLike) -> ComplexArray:
        """d_1 / h of a wave h exp(i q x): the linear force 2 E* sin(q a) / q times minus the compliance [-]."""
        force = response(q, contact_radius=self.contact_radius, modulus=self.modulus)
        return np.asarray(-force * self.compliance(q))

    def force_spectrum(self, q: ArrayLike, c1d: Callable[[FloatArray], FloatArray], *, q_max: float) -> FloatArray:
        """C_F of F_2 [N^2 m].

        (E* R / 4a)^2 2 int C_1D(k) C_1D(q - k) abs(U(k) U(q - k) + V(k) V(q - k))^2 dk, U(k) = exp(i k a) + d_1 / h,
        V(k) = exp(-i k a) + d_1 / h: Gaussian heights have no fourth moment but those of pairs of waves. At a fixed
        approach the last factor is 4 cos^2(q a).
        q: [rad/m]; c1d: C_1D of the track, two-sided [m^3], zero beyond q_max.
        """
        k = np.linspace(-q_max, q_max, POINTS + 1)
        places = np.atleast_1d(np.asarray(q, dtype=np.float64))
        found = np.array([np.trapezoid(self._pairs(k, one - k, c1d), k) for one in places.tolist()])
        return np.asarray(2 * (self.modulus * self.radius / (4 * self.contact_radius)) ** 2 * found)

    def _pairs(self, k: FloatArray, other: FloatArray, c1d: Callable[[FloatArray], FloatArray]) -> FloatArray:
        power = c1d(np.abs(k)) * c1d(np.abs(other))
        some = power > 0
        k, other = k[some], other[some]
        mine, its = self.motion(k), self.motion(other)
        turn, its_turn = np.exp(1j * k * self.contact_radius), np.exp(1j * other * self.contact_radius)
        ends = (turn + mine) * (its_turn + its) + (turn.conj() + mine) * (its_turn.conj() + its)
        power[some] *= np.abs(ends) ** 2
        return power

    def acceleration(self, omega: ArrayLike, c1d: Callable[[FloatArray], FloatArray], *, q_max: float) -> FloatArray:
        """A of the second order: C_F over the frequency, times abs(omega^2 compliance)^2 [(m/s^2)^2 s].

        omega: below q_min v_0, where the first order has nothing [rad/s]; c1d, q_max: as of `force_spectrum`.
        """
        q = np.asarray(omega, dtype=np.float64) / self.speed
        force = over_frequency(self.force_spectrum(q, c1d, q_max=q_max), speed=self.speed)
        return np.asarray(force * np.abs((q * self.speed) ** 2 * self.compliance(q)) ** 2)
