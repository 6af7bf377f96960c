"""Linear theory of a wheel that rolls over roughness, and of its motion on the contact; imports neither method.

The contact is a circle that keeps its radius a. A wave of roughness h exp(i k.x) under it then changes the normal force
by reciprocity with the flat punch: dF = (E* / pi) int h dA / sqrt(a^2 - r^2).
Spectra are two-sided: <F^2> = int_{-inf}^{inf} C_F dq. Wavenumbers in rad/m, C_2D in m^4, C_F in N^2 m.

A wheel with a mass: M z'' = F - F_N - c z', z upward, the approach d downward, F = F_N + k (d - d_N) + dF,
c = 2 zeta M omega_0, omega_0 = sqrt(k / M). Frequencies are angular, omega in rad/s; its spectra are those of (14.17),
two-sided over the frequency f: <x^2> = int A df.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.theory.closed_forms import circular_punch_stiffness, positive
from validation.theory.half_space import on_panels

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
    damper. It is sqrt(k / M) on a rigid rail, and where the sum is not negative there, otherwise higher.
    Source: Thompson, Railway Noise and Vibration, chapter 2.
    """
    rigid = math.sqrt(stiffness / mass)

    def left(omega: float) -> float:
        return omega / stiffness - 1 / (omega * mass) + float((1 / impedance(omega)).imag)

    high = rigid
    while left(high) < 0:
        high *= 2
    return float(scipy.optimize.brentq(left, rigid, high)) if high > rigid else rigid


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


Spectrum = Callable[[FloatArray], FloatArray]

NODES = 24
"""Nodes of Gauss and Legendre on a panel no longer than half a wave of sin^2."""
WIDEST = 1.4
"""Largest ratio of both ends of a panel, on which a power law is a polynomial to rounding."""


def response(wavenumber: ArrayLike, *, contact_radius: float, modulus: float) -> FloatArray:
    """From the height of a wave to the force, 2 E* sin(k a) / k; 2 E* a for the longest [N/m].

    On the half-space: with h = exp(i k x) in the integral over rings of the circle, int J_0(k r) 2 pi r dr /
    sqrt(a^2 - r^2) = 2 pi sin(k a) / k, whatever the direction of the wave. On springs: E* int_{-a}^{a} exp(i q x) dx.
    Source: Popov and Hess, (14.11); for the half-space, the flat punch: Johnson, Contact Mechanics, chapter 3.
    """
    positive(contact_radius=contact_radius, modulus=modulus)
    ka = np.asarray(wavenumber, dtype=np.float64) * contact_radius
    return np.asarray(2 * modulus * contact_radius * np.sinc(ka / np.pi))


def force_spectrum_1d(q: ArrayLike, c1d: Spectrum, *, contact_radius: float, modulus: float) -> FloatArray:
    """C_F(q) = 4 E*^2 sin^2(q a) / q^2 C_1D(q). Source: Popov and Hess, (14.12); ridges across the track in 3D."""
    q = np.asarray(q, dtype=np.float64)
    return np.asarray(response(q, contact_radius=contact_radius, modulus=modulus) ** 2 * c1d(q))


def mean_force_spectrum_1d(q: ArrayLike, c1d: Spectrum, *, modulus: float) -> FloatArray:
    """2 E*^2 C_1D(q) / q^2: the mean of (14.12) where q a >> 1. Source: Popov and Hess, (14.14)."""
    positive(modulus=modulus)
    q = np.asarray(q, dtype=np.float64)
    return np.asarray(2 * modulus**2 * c1d(q) / q**2)


def force_spectrum_3d(
    q: ArrayLike, c2d: Spectrum, *, edges: Sequence[float], contact_radius: float, modulus: float
) -> FloatArray:
    """Spectrum of the force along the track over an isotropic surface on the half-space.

    C_F(q) = 2 int_q^inf G(s) C_2D(s) s / sqrt(s^2 - q^2) ds = int_{-inf}^{inf} G(s) C_2D(s) dk,  s^2 = q^2 + k^2,
    G(s) = 4 E*^2 sin^2(s a) / s^2: the surface filtered by `response`, cut along the track. Over k the end point
    s = q is regular; panels end at edges of the spectrum, and follow power laws and the oscillation.

    q: any sign, any shape; c2d: callable of abs(q), smooth between the edges, zero outside; edges: ascending, two or
    more.
    """

    def filtered(s: FloatArray) -> FloatArray:
        return np.asarray(response(s, contact_radius=contact_radius, modulus=modulus) ** 2 * c2d(s))

    return section(q, filtered, edges=edges, period=math.pi / contact_radius)


def section(q: ArrayLike, c2d: Spectrum, *, edges: Sequence[float], period: float = math.inf) -> FloatArray:
    """The spectrum along a line, int_{-inf}^{inf} C_2D(sqrt(q^2 + k^2)) dk.

    q, c2d, edges: as of `force_spectrum_3d`; period: of an oscillation of c2d over its argument.
    """
    return np.asarray(
        np.vectorize(lambda wavenumber: _section(abs(wavenumber), c2d, edges, period))(np.asarray(q, dtype=np.float64))
    )


def _section(q: float, c2d: Spectrum, edges: Sequence[float], period: float) -> float:
    """`section` at one wavenumber, not negative, by Gauss and Legendre on each panel over k."""
    ends = np.array(_panels(q, edges, period))
    if ends.size < 2:
        return 0.0
    k, weight = on_panels(np.sqrt(np.maximum(ends**2 - q**2, 0.0)), NODES)
    return float(2 * np.sum(weight * c2d(np.hypot(q, k))))


def _panels(q: float, edges: Sequence[float], period: float) -> list[float]:
    """Ends of the panels over s, from q or the first edge to the last."""
    # the edges themselves belong to the panels below and above, which never touch them
    ends = [max(q, edges[0])]
    for edge in edges[1:]:
        while ends[-1] < edge:
            ends.append(min(edge, WIDEST * ends[-1], ends[-1] + period))
    return ends if q < edges[-1] else []


def force_variance(c2d: Spectrum, *, edges: Sequence[float], contact_radius: float, modulus: float) -> float:
    """<dF^2> = 2 pi int_0^inf G(s) C_2D(s) s ds at one position on the half-space [N^2].

    With C_1D = pi q C_2D it is int (14.12) dq too: Geike's rule keeps the variance of the force exactly.
    """
    s, weight = on_panels(_panels(edges[0], edges, math.pi / contact_radius), NODES)
    power = response(s, contact_radius=contact_radius, modulus=modulus) ** 2 * c2d(s) * s
    return float(2 * math.pi * np.sum(weight * power))


def rms_gradient(c2d: Spectrum, *, edges: Sequence[float]) -> float:
    """g, the root mean square of abs(grad h) of an isotropic surface: g^2 = 2 pi int_0^inf q^3 C_2D dq [-].

    The profile that Geike's rule makes of the surface has the slope g; a line on it has `slope_in_one_direction`.
    c2d, edges: as of `force_spectrum_3d`.
    """
    s, weight = on_panels(_panels(edges[0], edges, math.inf), NODES)
    return math.sqrt(2 * math.pi * float(np.sum(weight * s**3 * c2d(s))))


def slope_in_one_direction(gradient: float) -> float:
    """h' = g / sqrt(2), the rms slope in one direction, as along a track, of isotropic roughness [-].

    h'^2 = int q_x^2 C_2D dq_x dq_y = pi int_0^inf q^3 C_2D dq: half of the mean square gradient.
    """
    return gradient / math.sqrt(2)


def contact_lost(c2d: Spectrum, *, edges: Sequence[float], contact_radius: float, radius: float) -> float:
    """Share of the circle of contact in which linear theory has the half-space pull [-].

    Hertz's p_0 sqrt(1 - r^2/a^2), p_0 = 2 E* a / (pi R), and the pressures that close the gaps of Gaussian roughness,
    E* q / 2 for each wave, so that their rms is E* g / 2 with the `rms_gradient` g:
    int_0^1 Phi(-p_0 u / (E* g / 2)) 2 u du, u^2 = 1 - r^2/a^2. The modulus cancels.
    Source: Hertz; Westergaard's wave, whose full pressure is E* q h / 2; Johnson, Contact Mechanics, chapters 4, 13.
    """
    positive(contact_radius=contact_radius, radius=radius)
    gradient = rms_gradient(c2d, edges=edges)
    peak = 2 * contact_radius / (math.pi * radius)
    u, weight = on_panels([0.0, 1.0], NODES)
    return float(2 * np.sum(weight * u * special.ndtr(-peak * u / (gradient / 2))))


def level_ratio(hurst: float) -> float:
    """Mean level of C_F in 3D over that of (14.12) with Geike's spectrum, for q a >> 1 of an unbounded power law [-].

    Gamma(H + 3/2) / (sqrt(pi) Gamma(H + 2)): with sin^2 = 1/2, 2 int_q^inf s^(-2H-3) / sqrt(s^2 - q^2) ds =
    q^(-2H-3) sqrt(pi) Gamma(H + 3/2) / Gamma(H + 2), over pi q^(-2H-3).
    """
    positive(hurst=hurst)
    return math.gamma(hurst + 1.5) / (math.sqrt(math.pi) * math.gamma(hurst + 2))


def oscillation(q: ArrayLike, *, hurst: float, contact_radius: float) -> FloatArray:
    """C_F in 3D over its mean level, for q a >> 1 of an unbounded power law: to first order in (q a)^(-1/2) [-].

    1 - Gamma(H + 2) / Gamma(H + 3/2) cos(2 q a + pi/4) / sqrt(q a): of the part -cos(2 s a) of 2 sin^2, only the end
    point s = q of the integral is left, int_0^inf cos(2 (q + t) a) t^(-1/2) dt = sqrt(pi / (2 a)) cos(2 q a + pi/4).
    The zeros of sin^2 fill in, the more the larger q a.
    """
    positive(contact_radius=contact_radius, hurst=hurst)
    qa = np.asarray(q, dtype=np.float64) * contact_radius
    depth = math.gamma(hurst + 2) / math.gamma(hurst + 1.5)
    return np.asarray(1 - depth * np.cos(2 * qa + np.pi / 4) / np.sqrt(qa))


def linear_force(height: ArrayLike, *, spacing: float, radius: float, modulus: float, approach: float) -> FloatArray:
    """The force along a periodic surface as linear theory has it, on the half-space, shape (nx,) [N].

    Hertz, and each wave by `response`, above the middle of axis 1, over the centres of the cells along axis 0.
    height: shape (nx, ny), positive towards the wheel, periodic [m].
    """
    positive(spacing=spacing, radius=radius, approach=approach)
    h = np.asarray(height, dtype=np.float64)
    a = math.sqrt(radius * approach)
    (nx, ny), dx = h.shape, spacing
    qx, qy = (2 * np.pi * np.fft.fftfreq(n, dx) for n in (nx, ny))
    filtered = response(np.hypot(qx[:, np.newaxis], qy), contact_radius=a, modulus=modulus) * np.fft.fft2(h)
    along = np.fft.ifft(filtered @ np.exp(1j * qy * dx * (ny - 1) / 2) / ny).real
    return np.asarray(4 / 3 * modulus * a * approach + along)


ComplexArray = NDArray[np.complex128]

POINTS = 16_000
"""Intervals of the trapezoidal rule from -q_max to q_max."""


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
        wavenumbers = np.atleast_1d(np.asarray(q, dtype=np.float64))
        integrals = np.array(
            [np.trapezoid(self._pairs(k, wavenumber - k, c1d), k) for wavenumber in wavenumbers.tolist()]
        )
        return np.asarray(2 * (self.modulus * self.radius / (4 * self.contact_radius)) ** 2 * integrals)

    def _pairs(self, k: FloatArray, other: FloatArray, c1d: Callable[[FloatArray], FloatArray]) -> FloatArray:
        """Integrand of `force_spectrum` for waves k and other = q - k: C_1D C_1D abs(U U + V V)^2 [m^6]."""
        power = c1d(np.abs(k)) * c1d(np.abs(other))
        nonzero = power > 0
        k, other = k[nonzero], other[nonzero]
        motion, other_motion = self.motion(k), self.motion(other)
        phase, other_phase = np.exp(1j * k * self.contact_radius), np.exp(1j * other * self.contact_radius)
        ends = (phase + motion) * (other_phase + other_motion) + (phase.conj() + motion) * (
            other_phase.conj() + other_motion
        )
        power[nonzero] *= np.abs(ends) ** 2
        return power

    def acceleration(self, omega: ArrayLike, c1d: Callable[[FloatArray], FloatArray], *, q_max: float) -> FloatArray:
        """A of the second order: C_F over the frequency, times abs(omega^2 compliance)^2 [(m/s^2)^2 s].

        omega: below q_min v_0, where the first order has nothing [rad/s]; c1d, q_max: as of `force_spectrum`.
        """
        q = np.asarray(omega, dtype=np.float64) / self.speed
        force = over_frequency(self.force_spectrum(q, c1d, q_max=q_max), speed=self.speed)
        return np.asarray(force * np.abs((q * self.speed) ** 2 * self.compliance(q)) ** 2)

    def over_resonance(self, c1d: Callable[[FloatArray], FloatArray], *, q_max: float) -> float:
        """int A df over the resonance, positive frequencies, of the second order: region 1 [(m/s^2)^2].

        A_F2(omega_0) omega_0 / (8 zeta M^2), of leading order in zeta: it goes as one over the damping and depends on
        no length of a record.
        omega_0 below q_min v_0; c1d, q_max: as of `force_spectrum`. Raises ValueError without damping.
        """
        stiffness = circular_punch_stiffness(radius=self.contact_radius, modulus=self.modulus)
        omega = math.sqrt(stiffness / self.mass)
        (force,) = over_frequency(self.force_spectrum(omega / self.speed, c1d, q_max=q_max), speed=self.speed)
        return float(force) * over_the_resonance(eigenfrequency=omega, mass=self.mass, damping=self.damping)
