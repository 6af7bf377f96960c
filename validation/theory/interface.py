"""Models of a rough interface without edges: true contact area, mean gap and normal stiffness under a mean pressure.

Each is a plain object with a name and those of `area_fraction`, `mean_gap` and `stiffness` that it has, functions of
the mean pressure p [Pa]. Symbols: h the rms height, g the rms gradient, u the mean gap, which is the distance of the
mean planes; K = -dp/du [Pa/m]. Linear elasticity without friction and adhesion, E* on a rigid isotropic Gaussian
roughness.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.theory.closed_forms import positive
from validation.theory.half_space import elliptic_contact, gauss_legendre, on_panels

FloatArray = NDArray[np.float64]
QUANTITIES = "area_fraction", "mean_gap", "stiffness"
"""What a model may have: functions of the mean pressure."""


@runtime_checkable
class InterfaceModel(Protocol):
    """A model of an interface: a name and some of ``QUANTITIES``."""

    @property
    def name(self) -> str: ...


def quantities_of(model: InterfaceModel) -> tuple[str, ...]:
    """Those of ``QUANTITIES`` that the model has."""
    return tuple(quantity for quantity in QUANTITIES if callable(getattr(model, quantity, None)))


@dataclass(frozen=True)
class RoughnessSpectrum:
    """Power of an isotropic roughness by wavenumber: of a drawn surface its discrete PSD, or quadrature nodes of C_2D.

    wavenumbers: ascending, positive [rad/m]; power: of the waves of each, its sum is the mean square height [m^2].
    The moments are those of Nayak, along any straight line: m_n = int q^n C_1D dq = c_n sum q^n power with c_0 = 1,
    c_2 = 1/2, c_4 = 3/8, the means of cos^n over all directions. Source: Nayak, J. Lubr. Technol. 93, 398 (1971).
    """

    wavenumbers: tuple[float, ...]
    power: tuple[float, ...]

    def __post_init__(self) -> None:
        q, power = np.array(self.wavenumbers), np.array(self.power)
        if q.size == 0 or q.shape != power.shape or not (q[0] > 0 and (np.diff(q) > 0).all() and (power >= 0).all()):
            raise ValueError("wavenumbers must be positive and ascending, with a power of zero or more for each")

    @classmethod
    def of_heights(cls, heights: ArrayLike, *, spacing: float) -> "RoughnessSpectrum":
        """Of a periodic surface, heights at the centres of square cells [m]; waves of equal length are one."""
        z = np.asarray(heights, dtype=np.float64)
        q_x, q_y = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in z.shape)
        q = np.hypot(q_x[:, np.newaxis], q_y).ravel()
        power = np.abs(np.fft.fft2(z, norm="forward")).ravel() ** 2
        # transforms leave rounding where there is no wave
        kept = (q > 0) & (power > 1e-20 * power[q > 0].sum())
        lengths, places = np.unique(np.round(q[kept], 9 - int(np.log10(q.max()))), return_inverse=True)
        return cls(tuple(lengths.tolist()), tuple(np.bincount(places, power[kept]).tolist()))

    @classmethod
    def of_c2d(cls, c2d: Callable[[FloatArray], FloatArray], edges: Sequence[float]) -> "RoughnessSpectrum":
        """Of C_2D(q) [m^4], smooth between ascending edges [rad/m]: <h^2> = 2 pi int q C_2D dq."""
        if len(edges) < 2 or not (edges[0] > 0 and (np.diff(edges) > 0).all()):
            raise ValueError(f"edges must be two or more, positive and ascending, got {tuple(edges)}")
        # the rms gradient of the waves up to q rises as a root from the longest wave on
        first = edges[0] + (edges[1] - edges[0]) * np.linspace(0, 1, PANELS + 1) ** 4
        ends = np.unique(np.concatenate([first, *(np.geomspace(*pair, PANELS + 1) for pair in pairwise(edges[1:]))]))
        q, weight = on_panels(ends, 2)
        return cls(tuple(q.tolist()), tuple((2 * np.pi * weight * q * c2d(q)).tolist()))

    def _sum(self, order: int) -> float:
        return float((np.array(self.wavenumbers) ** order * np.array(self.power)).sum())

    @cached_property
    def m0(self) -> float:
        """Mean square height [m^2]."""
        return self._sum(0)

    @cached_property
    def m2(self) -> float:
        """Mean square slope in one direction [-]."""
        return self._sum(2) / 2

    @cached_property
    def m4(self) -> float:
        """Mean square second derivative in one direction [1/m^2]."""
        return 3 / 8 * self._sum(4)

    @property
    def height(self) -> float:
        """h, the rms height [m]."""
        return math.sqrt(self.m0)

    @property
    def gradient(self) -> float:
        """g, the rms of abs(grad h), the root of two times the slope in one direction [-]."""
        return math.sqrt(2 * self.m2)

    @property
    def bandwidth(self) -> float:
        """Nayak's alpha = m0 m4 / m2^2, 1.5 for one wavelength [-]."""
        return self.m0 * self.m4 / self.m2**2

    @cached_property
    def shells(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Nodes of int f(s) / q ds: s, its weights and 1/q, where 2 pi s^2 is the square gradient of all waves up to q.

        q is that of the wave which takes s from one value to the next; graded towards s = 0.
        """
        q, power = np.array(self.wavenumbers), np.array(self.power)
        reached = np.sqrt(np.cumsum(q**2 * power) / (2 * np.pi))
        ends = np.unique([0.0, *(reached[0] * 2.0 ** -np.arange(20, 0, -1)), *reached])
        s, weight = on_panels(ends, NODES)
        place = np.minimum(np.searchsorted(reached, s), q.size - 1)
        return s, weight, 1 / q[place]


PANELS, NODES = 1000, 4
LONGEST_STEP = 4.0
"""Of the gap over h, so that no pressure is zero in double precision."""
YANG_AND_PERSSON = 0.45
"""gamma: 0.42 to 0.48 in their simulations; one takes the energy of full contact on the area that touches."""
KAPPA_PERSSON, KAPPA_BUSH_GIBSON_THOMAS = math.sqrt(8 / math.pi), math.sqrt(2 * math.pi)
"""kappa = A E* g / (A_0 p) at vanishing load, g the rms gradient."""


def _pressures(pressure: ArrayLike) -> FloatArray:
    p = np.asarray(pressure, dtype=np.float64)
    if not (np.isfinite(p).all() and (p > 0).all()):
        raise ValueError(f"pressure must be finite and positive, got {p}")
    return p


@dataclass(frozen=True)
class Persson:
    """Persson's theory: pressures diffuse as shorter and shorter waves are added, and are absorbed at zero.

    Waves up to q leave P = erf(x) of the area in contact, x = p / (sqrt(pi) E* s), s(q)^2 = int^q q'^3 C_2D dq'. The
    elastic energy an area, U = (pi/2) E* int q^2 C P (gamma + (1 - gamma) P^2) dq, is the work of the pressure,
    p du = -dU, so

        p / K = 2 int f(x) / q ds,  u = 2 int int_x^inf f(t) / t dt / q ds,
        f(x) = (gamma + 3 (1 - gamma) erf(x)^2) exp(-x^2).

    For p -> 0: A / A_0 = sqrt(8 / pi) p / (E* g), K = p / u_0 with u_0 = 2 gamma int ds / q, about 1.2 gamma h for a
    plateau and a power law beyond. K grows beyond all bounds towards full contact.

    spectrum: of the roughness; modulus: E* [Pa]; gamma: in (0, 1], fitted to simulations. ValueError names what is out
    of range. Source: Persson, J. Chem. Phys. 115, 3840 (2001) for P, Phys. Rev. Lett. 99, 125502 (2007) for u with
    gamma = 1; Yang and Persson, J. Phys.: Condens. Matter 20, 215214 (2008) for gamma.
    """

    spectrum: RoughnessSpectrum
    modulus: float
    gamma: float = YANG_AND_PERSSON

    def __post_init__(self) -> None:
        positive(modulus=self.modulus, gamma=self.gamma)
        if self.gamma > 1:
            raise ValueError(f"gamma must be in (0, 1], got {self.gamma}")

    @property
    def name(self) -> str:
        return f"Persson, γ = {self.gamma:g}"

    def area_fraction(self, pressure: ArrayLike) -> FloatArray:
        """A / A_0 = erf(sqrt(2) p / (E* g))."""
        return np.asarray(special.erf(math.sqrt(2) * _pressures(pressure) / (self.modulus * self.spectrum.gradient)))

    def mean_gap(self, pressure: ArrayLike) -> FloatArray:
        """u [m], see the class."""
        return self._over_waves(pressure, lambda x: _gap_integral(x, self.gamma))

    def stiffness(self, pressure: ArrayLike) -> FloatArray:
        """K = -dp/du [Pa/m], see the class."""
        with np.errstate(divide="ignore"):
            return np.asarray(_pressures(pressure) / self._over_waves(pressure, lambda x: _energy(x, self.gamma)))

    def _over_waves(self, pressure: ArrayLike, f: Callable[[FloatArray], FloatArray]) -> FloatArray:
        """2 int f(x) / q ds."""
        s, weight, length = self.spectrum.shells
        x = _pressures(pressure)[..., np.newaxis] / (np.sqrt(np.pi) * self.modulus * s)
        return np.asarray(2 * (f(x) * weight * length).sum(axis=-1))


def _energy(x: FloatArray, gamma: float) -> FloatArray:
    """f = (gamma + 3 (1 - gamma) erf(x)^2) exp(-x^2)."""
    return np.asarray((gamma + 3 * (1 - gamma) * special.erf(x) ** 2) * np.exp(-(x**2)))


def _gap_integral(x: FloatArray, gamma: float) -> FloatArray:
    """int_x^inf f(t) / t dt = gamma E_1(x^2) / 2 + 3 (1 - gamma) int_x^inf erf(t)^2 exp(-t^2) / t dt."""
    t, tail = _tail_of_squares()
    return np.asarray(gamma / 2 * special.exp1(x**2) + 3 * (1 - gamma) * np.interp(x, t, tail))


@cache
def _tail_of_squares() -> tuple[FloatArray, FloatArray]:
    """x from 0 to 6, and int_x^inf erf(t)^2 exp(-t^2) / t dt."""
    ends = np.linspace(0, 6, 6001)
    t, weight = on_panels(ends, 2)
    parts = (weight * special.erf(t) ** 2 * np.exp(-(t**2)) / t).reshape(-1, 2).sum(axis=1)
    return ends, np.append(np.cumsum(parts[::-1])[::-1], 0.0)


def gaussian_tail(order: float, t: ArrayLike) -> FloatArray:
    """F_n(t) = int_t^inf (s - t)^n phi(s) ds, phi the standard normal density; n > -1, dF_n/dt = -n F_{n-1}.

    By the parabolic cylinder function: Gamma(n + 1) exp(-t^2 / 4) D_{-n-1}(t) / sqrt(2 pi). Range: t from -10 to 30.
    Source: Greenwood and Williamson, Proc. R. Soc. A 295, 300 (1966); Abramowitz and Stegun, 19.5.
    """
    t = np.asarray(t, dtype=np.float64)
    cylinder, _ = special.pbdv(-order - 1, t)
    return np.asarray(math.gamma(order + 1) / math.sqrt(2 * math.pi) * np.exp(-(t**2) / 4) * cylinder)


class _ByGap(ABC):
    """A model whose pressure, area and stiffness are functions of the gap, a pressure that falls with it."""

    spectrum: RoughnessSpectrum

    @abstractmethod
    def at_gap(self, gap: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Mean pressure [Pa], contact fraction and stiffness -dp/du [Pa/m] at each gap u, of any sign [m]."""

    def area_fraction(self, pressure: ArrayLike) -> FloatArray:
        """True contact area over the nominal area; the asperities do not merge, so that it may exceed one."""
        return self.at_gap(self.mean_gap(pressure))[1]

    def mean_gap(self, pressure: ArrayLike) -> FloatArray:
        """u under each pressure [m], negative where the asperities are pressed below the mean plane.

        Newton's method on ln p(u), which is concave: from the first step beyond it on the gap is approached from above.
        """
        p = _pressures(pressure)
        gap = np.zeros(p.shape)
        for _ in range(100):
            at_gap, _, stiffness = self.at_gap(gap)
            step = np.minimum(np.log(at_gap / p) * at_gap / stiffness, LONGEST_STEP * self.spectrum.height)
            gap = gap + step
            if (np.abs(step) <= 1e-10 * self.spectrum.height).all():
                break
        return gap

    def stiffness(self, pressure: ArrayLike) -> FloatArray:
        """K = -dp/du [Pa/m]."""
        return self.at_gap(self.mean_gap(pressure))[2]


@dataclass(frozen=True)
class GreenwoodWilliamson(_ByGap):
    """Spherical asperities of one radius and Gaussian heights, by Nayak's spectral moments; they do not interact.

    With the mean plane of the summits 4 sqrt(m0 / (pi alpha)) above that of the surface, t the distance of the flat
    from there over sigma:

        p = 4/3 E* D sqrt(R) sigma^(3/2) F_3/2(t),  A / A_0 = pi D R sigma F_1(t),  K = 2 E* D sqrt(R sigma) F_1/2(t).

    spectrum: of the roughness; modulus: E* [Pa]. Its gap is that of the flat and the undeformed mean plane. Range:
    light loads; asperities neither merge nor lower each other. Source: Greenwood and Williamson, Proc. R. Soc. A 295,
    300 (1966); McCool, Wear 107, 37 (1986), for the moments.
    """

    spectrum: RoughnessSpectrum
    modulus: float
    name: str = "Greenwood-Williamson"

    def __post_init__(self) -> None:
        positive(modulus=self.modulus)

    @property
    def density(self) -> float:
        """D = m4 / (6 pi sqrt(3) m2), summits an area [1/m^2]."""
        return self.spectrum.m4 / (6 * math.pi * math.sqrt(3) * self.spectrum.m2)

    @property
    def radius(self) -> float:
        """R = 3/8 sqrt(pi / m4), one over the mean curvature of the summits [m]."""
        return 3 / 8 * math.sqrt(math.pi / self.spectrum.m4)

    @property
    def deviation(self) -> float:
        """sigma = sqrt((1 - 0.8968 / alpha) m0), the standard deviation of the heights of summits [m]."""
        return math.sqrt((1 - 0.8968 / self.spectrum.bandwidth) * self.spectrum.m0)

    @property
    def summits(self) -> float:
        """4 sqrt(m0 / (pi alpha)), the mean height of the summits [m]."""
        return 4 * math.sqrt(self.spectrum.m0 / (math.pi * self.spectrum.bandwidth))

    def at_gap(self, gap: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        sigma, root = self.deviation, math.sqrt(self.radius * self.deviation)
        t = (gap - self.summits) / sigma
        pressure = 4 / 3 * self.modulus * self.density * root * sigma * gaussian_tail(1.5, t)
        area = math.pi * self.density * self.radius * sigma * gaussian_tail(1.0, t)
        return pressure, area, 2 * self.modulus * self.density * root * gaussian_tail(0.5, t)


@dataclass(frozen=True)
class BushGibsonThomas(_ByGap):
    """Elliptic asperities: all summits of a Gaussian surface, each a Hertz contact of its two curvatures.

    A summit has the mean curvature s and the curvatures s (1 - e) and s (1 + e), 0 <= e < 1. With v = m4 / 3, a
    Gaussian s of variance 2 v, a Rayleigh deviator r = e s of <r^2> = 2 v, its height z at given s of mean
    3 m2 s / (2 m4) and variance m0 (1 - 3 / (2 alpha)), the summits an area are (s^2 - r^2) / (2 pi m2) times the
    density of (s, r, z). Pressed by w = z - u, each has the force c_F(e) E* w^(3/2) / sqrt(s) and the area
    c_A(e) w / s; the sums over z are `gaussian_tail`. No asymptote is used: for p -> 0, A / A_0 tends to
    sqrt(2 pi) p / (E* g), which a wide spectrum reaches at loads of no use alone.

    spectrum: of the roughness; modulus: E* [Pa]. The gap and the range are those of `GreenwoodWilliamson`;
    gaps up to 10 h. Source: Bush, Gibson and Thomas, Wear 35, 87 (1975); Longuet-Higgins, Phil. Trans. R. Soc. A 250,
    157 (1957).
    """

    spectrum: RoughnessSpectrum
    modulus: float
    name: str = "Bush-Gibson-Thomas"

    def __post_init__(self) -> None:
        positive(modulus=self.modulus)

    @cached_property
    def _summits(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Mean curvatures s [1/m], and the sums of c_F and of c_A over e, summits an area at each node."""
        v, m2 = self.spectrum.m4 / 3, self.spectrum.m2
        s, weight = on_panels(np.linspace(0, 8 * math.sqrt(2 * v), 7), 8)
        ellipticity, share, force, area = _elliptic_asperities()
        gaussian = np.exp(-(s**2) / (4 * v)) / math.sqrt(4 * math.pi * v)
        # (s^2 - r^2) r dr / v = s^4 (1 - e^2) e de / v
        deviator = np.exp(-((ellipticity * s[:, np.newaxis]) ** 2) / (2 * v)) * share
        of_summits = weight * gaussian * s**4 / v / (2 * math.pi * m2)
        return s, of_summits * (deviator @ force), of_summits * (deviator @ area)

    def at_gap(self, gap: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        moments = self.spectrum
        curvature, forces, areas = self._summits
        sigma = math.sqrt(moments.m0 * (1 - 1.5 / moments.bandwidth))
        t = (gap[..., np.newaxis] - 1.5 * moments.m2 / moments.m4 * curvature) / sigma
        forces = self.modulus * forces / np.sqrt(curvature)
        pressure = sigma**1.5 * gaussian_tail(1.5, t) @ forces
        stiffness = 1.5 * math.sqrt(sigma) * gaussian_tail(0.5, t) @ forces
        return pressure, sigma * gaussian_tail(1.0, t) @ (areas / curvature), stiffness


@cache
def _elliptic_asperities() -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Nodes e, weights of (1 - e^2) e de, and c_F, c_A of paraboloids of curvatures 1 - e and 1 + e."""
    node, weight = gauss_legendre(48)
    # x = sqrt(1 - e) takes the root out of the areas of long asperities
    x = (1 + node) / 2
    e = 1 - x**2
    contacts = [elliptic_contact((1 / (1 - r), 1 / (1 + r)), modulus=1.0, approach=1.0) for r in e.tolist()]
    force = np.array([contact.force for contact in contacts])
    area = np.array([math.pi * contact.along * contact.across for contact in contacts])
    return e, weight * x * (1 - e**2) * e, force, area


@dataclass(frozen=True)
class MeasuredGap:
    """Mean gaps [m] that were measured under ascending pressures [Pa]: p falls exponentially with u between them."""

    pressures: tuple[float, ...]
    gaps: tuple[float, ...]

    def __call__(self, pressure: ArrayLike) -> FloatArray:
        """u [m]; ValueError for a pressure that was not measured."""
        p, ends = _pressures(pressure), (self.pressures[0], self.pressures[-1])
        if (p < ends[0] * (1 - 1e-9)).any() or (p > ends[1] * (1 + 1e-9)).any():
            raise ValueError(f"pressure must be from {ends[0]:g} to {ends[1]:g} Pa, where gaps were measured, got {p}")
        return np.asarray(np.interp(np.log(p), np.log(self.pressures), self.gaps))


@dataclass(frozen=True)
class TailFormula:
    """The stiffness of independent springs of Hertz under the Gaussian tail of all heights, at the measured gap.

    p ~ F_3/2(u / h) as of `GreenwoodWilliamson` with the heights of the surface in place of those of its summits; the
    factor drops out of K = -dp/du = 1.5 p / h F_1/2(u / h) / F_3/2(u / h). It has no parameter, and no gap or area.
    Source: Greenwood and Williamson (1966), whose heights are those of summits; the gap is measured.
    """

    height: float
    gap: MeasuredGap
    name: str = "Gaussian tail at the measured gap"

    def stiffness(self, pressure: ArrayLike) -> FloatArray:
        """K [Pa/m], h = `height` [m]."""
        t = self.gap(pressure) / self.height
        return np.asarray(1.5 * _pressures(pressure) / self.height * gaussian_tail(0.5, t) / gaussian_tail(1.5, t))


@dataclass(frozen=True)
class BearingArea:
    """The section of the undeformed roughness, cut off so that the mean gap over it is the measured one.

    A plane at d leaves the gap h F_1(-d / h) and cuts A / A_0 = F_0(d / h), Gaussian heights. Abbott and Firestone's
    curve has no pressure: the gap is measured. Source: Abbott and Firestone, Mech. Eng. 55, 569 (1933).
    """

    height: float
    gap: MeasuredGap
    name: str = "bearing area at the measured gap"

    def area_fraction(self, pressure: ArrayLike) -> FloatArray:
        """A / A_0 of the section."""
        u = self.gap(pressure) / self.height
        d = u
        # F_1(-d) = u is convex and rising in d
        for _ in range(50):
            d = d - (gaussian_tail(1.0, -d) - u) / gaussian_tail(0.0, -d)
        return np.asarray(special.ndtr(-d))


@dataclass(frozen=True)
class Barber:
    """Bounds that no load path of this surface leaves.

    Contact begins at the gap `highest`, and contact areas only grow with the load, so p(u) is convex: from (highest, 0)
    to (u, p) its chord is no steeper than K, and its tangent at u meets u = 0 no higher than `full`, the pressure of
    full contact: p / highest <= p / (highest - u) <= K <= (full - p) / u. The first is of Barber's theorem: the curve
    lies between those of the smooth faces shifted by the extreme heights.

    highest: the largest height over the mean plane [m]; full: the mean pressure that just closes all gaps [Pa].
    Source: Barber, Proc. R. Soc. A 459, 53 (2003); the others follow from the convexity.
    """

    highest: float
    full: float
    name: str = "at the least (Barber)"

    def stiffness(self, pressure: ArrayLike) -> FloatArray:
        """p / highest, the least that is possible [Pa/m]."""
        return np.asarray(_pressures(pressure) / self.highest)

    def stiffness_bounds(self, pressure: ArrayLike, gap: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """The least and the largest K at a pressure and the gap under it [Pa/m]."""
        p, u = _pressures(pressure), np.asarray(gap, dtype=np.float64)
        return np.asarray(p / (self.highest - u)), np.asarray((self.full - p) / u)


def full_contact_pressure(heights: ArrayLike, *, spacing: float, modulus: float) -> float:
    """Mean pressure [Pa] that just closes all gaps of periodic heights [m]: minus the least of p(q) = E* q h(q) / 2.

    Source: Johnson, Contact Mechanics, chapter 13; the periodic half-space, u(q) = 2 p(q) / (E* q).
    """
    z = np.asarray(heights, dtype=np.float64)
    q_x, q_y = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in z.shape)
    q = np.hypot(q_x[:, np.newaxis], q_y)
    return float(-np.fft.ifft2(modulus * q / 2 * np.fft.fft2(z)).real.min())
