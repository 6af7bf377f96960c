"""Models of an interface beside the diffusion of pressures, sums over drawn asperities, drawn surfaces, and limits."""

import math
import types

import numpy as np
import pytest
from scipy import integrate, linalg, special

from tests.seeded import Times, catches
from validation.theory import interface
from validation.theory.half_space import elliptic_contact
from validation.theory.interface import (
    Barber,
    BearingArea,
    BushGibsonThomas,
    GreenwoodWilliamson,
    MeasuredGap,
    Persson,
    RoughnessSpectrum,
    TailFormula,
    full_contact_pressure,
    gaussian_tail,
    quantities_of,
)

EDGES = (2.0, 3.0, 24.0)


def c2d(q):
    """A plateau and a power law of H = 0.7."""
    return 1e-3 * np.where(q < 3, 1.0, (q / 3) ** -3.4)


def persson(*, gamma=0.45, modulus=2.0, spectrum=c2d, edges=EDGES):
    return Persson(RoughnessSpectrum.of_c2d(spectrum, edges), modulus, gamma)


def stiffness(p, **settings):
    return persson(**settings).stiffness(p)


def contact_fraction(pressure, gradient):
    """True area over nominal area: erf(sqrt(2) p / (E* g)), pressure and gradient over one E*."""
    return special.erf(math.sqrt(2) * pressure / gradient)


# --- Persson's theory ---


@catches("pressures that diffuse half as fast").at(
    "validation.theory.interface.special", types.SimpleNamespace(erf=lambda x: special.erf(x / math.sqrt(2)))
)
def test_the_area_is_that_of_pressures_that_diffuse():
    """The pressure is p at first, diffuses by dW = W'' dV / 2 and is absorbed at zero: Crank and Nicolson, from a
    variance that all but misses zero to that of full contact, E*^2 g^2 / 4. Second order: 120 steps, 300 pressures."""
    p, variance = 0.3, np.linspace(0.004, 0.09, 120)
    step = 0.008
    sigma = step * np.arange(1, 300)
    density = np.exp(-((sigma - p) ** 2) / (2 * variance[0])) / math.sqrt(2 * math.pi * variance[0])
    half = (variance[1] - variance[0]) / 4 / step**2
    banded = np.repeat([[-half], [1 + 2 * half], [-half]], sigma.size, axis=1)
    for reached in variance[1:]:
        spread = np.diff(density, 2, prepend=0.0, append=0.0)
        density = linalg.solve_banded((1, 1), banded, density + half * spread)
        # one wave of q = 1 and this gradient, E* = 1
        theory = Persson(RoughnessSpectrum((1.0,), (4 * reached,)), 1.0).area_fraction(p)
        assert theory == pytest.approx(step * density.sum(), abs=5e-4)
    assert theory < 0.7


def gap(p, gamma):
    """u = int_p^inf dU/dp' / p' dp' for E* = 2, dU/dp a difference of energies."""
    q = np.geomspace(EDGES[0], EDGES[-1], 5001)
    gradient = np.sqrt(2 * np.pi * integrate.cumulative_trapezoid(q**3 * c2d(q), q))
    pressures = np.geomspace(p, 20 * gradient[-1], 121)
    share = contact_fraction(pressures[:, np.newaxis], 2 * gradient)
    stored = (q**2 * c2d(q))[1:] * share * (gamma + (1 - gamma) * share**2)
    work = np.diff(np.pi * np.trapezoid(stored, q[1:]))
    return float(np.sum(work / np.sqrt(pressures[1:] * pressures[:-1])))


SHELLS = RoughnessSpectrum.__dict__["shells"].func


@property
def slopes_in_one_direction(spectrum):
    s, weight, length = SHELLS(spectrum)
    return s / math.sqrt(2), weight / math.sqrt(2), length


@catches("waves of an interface by their slope in one direction", gamma=0.45).at(
    "validation.theory.interface.RoughnessSpectrum.shells", slopes_in_one_direction
)
@catches("the contact of an interface without the root of two", gamma=0.45).at(
    "validation.theory.interface.special",
    types.SimpleNamespace(erf=lambda x: special.erf(x / math.sqrt(2)), exp1=special.exp1),
)
@pytest.mark.parametrize("gamma", [1.0, 0.45])
def test_the_stiffness_is_the_slope_of_the_gap_that_the_energy_leaves(gamma):
    """-dp/du by a difference over 2 %: good to its square, and to that of the steps of 6 % in the work."""
    for p in (0.02, 0.2):
        slope = 0.02 * p / (gap(0.99 * p, gamma) - gap(1.01 * p, gamma))
        assert stiffness(p, gamma=gamma) == pytest.approx(slope, rel=0.01)


@catches("a gap without the energy of waves in part contact", gamma=0.45).at(
    "validation.theory.interface._tail_of_squares", lambda: (np.array([0.0, 6.0]), np.zeros(2))
)
@pytest.mark.parametrize("gamma", [1.0, 0.45])
def test_the_gap_is_the_work_of_the_load_on_the_elastic_energy(gamma):
    """By sums of differences of the energy in steps of 6 %; -du/dp is 1 / K to the digits of a difference over 2e-4."""
    theory, p = persson(gamma=gamma), np.array([0.02, 0.2])
    assert theory.mean_gap(p) == pytest.approx([gap(x, gamma) for x in p], rel=0.01)
    slope = (theory.mean_gap(p * (1 - 1e-4)) - theory.mean_gap(p * (1 + 1e-4))) / (2e-4 * p)
    assert slope * theory.stiffness(p) == pytest.approx([1.0, 1.0], rel=1e-4)


def test_a_light_load_is_proportional_and_a_heavy_one_closes_the_gap():
    """K = p / u_0, u_0 = gamma sqrt(pi) int q^2 C w dq; the gap closes before the pressure is E*."""
    light = np.array([1e-5, 1e-4])
    length = light / stiffness(light)
    assert length[0] == pytest.approx(length[1], rel=1e-3)

    def integrand(t):
        # q = 2 + t^2 takes the root out of w at the first wave
        q = 2 + t**2
        cubes, _ = integrate.quad(lambda k: k**3 * c2d(k), 2, q, points=[3.0] if q > 3 else None)
        return q**2 * c2d(q) / math.sqrt(cubes) * 2 * t

    u_0, _ = integrate.quad(integrand, 1e-6, math.sqrt(22), points=[1.0])
    assert length[0] == pytest.approx(0.45 * u_0, rel=1e-3)
    assert light[0] / stiffness(light[0], gamma=1.0) == pytest.approx(u_0, rel=1e-3)
    assert stiffness(100.0) > 1e12 and persson().area_fraction(100.0) == 1.0
    # kappa of Persson
    slope = persson().area_fraction(1e-5) * 2 * persson().spectrum.gradient / 1e-5
    assert slope == pytest.approx(math.sqrt(8 / math.pi), rel=1e-6)


def test_the_stiffness_scales_with_modulus_height_and_length():
    """K(p; E*, h, L) = E* / L K(p L / (E* h)); twice as long and as high, of the same slopes, has 16 times C_2D."""
    assert stiffness(0.6, modulus=6.0) == pytest.approx(3 * stiffness(0.2), rel=1e-12)
    higher = stiffness(0.4, spectrum=lambda q: 4 * c2d(q))
    assert higher == pytest.approx(stiffness(0.2), rel=1e-12)
    longer = stiffness(0.2, spectrum=lambda q: 16 * c2d(2 * q), edges=(1.0, 1.5, 12.0))
    assert longer == pytest.approx(stiffness(0.2) / 2, rel=1e-9)


# --- the roughness that is drawn ---


def drawn(cells, seed=3):
    """A Gaussian surface on the unit square of 24 to 32 waves a side, by another transform than the models use."""
    rng = np.random.default_rng(seed)
    n = np.fft.fftfreq(cells, 1 / cells)
    ring = np.hypot(n[:, np.newaxis], n)
    # the same waves on every grid
    phase = np.zeros(ring.shape)
    inside = (ring >= 24) & (ring <= 32)
    order = np.lexsort((n[np.nonzero(inside)[1]], n[np.nonzero(inside)[0]]))
    places = tuple(axis[order] for axis in np.nonzero(inside))
    phase[places] = rng.uniform(0, 2 * np.pi, order.size)
    waves = np.where(inside, np.exp(1j * phase), 0.0)
    height = np.fft.ifft2(waves).real
    return height / height.std()


@catches("the fourth moment of all directions in one").at(
    "validation.theory.interface.RoughnessSpectrum.m4", property(lambda spectrum: spectrum._sum(4))
)
def test_moments_are_those_of_differences_of_a_drawn_surface():
    """Second order in the spacing, 16 cells to the shortest wave: 2 % of second derivatives; both directions."""
    cells = 512
    z, step = drawn(cells), 1 / cells
    moments = RoughnessSpectrum.of_heights(z, spacing=step)
    slopes = [np.mean(((np.roll(z, -1, axis) - np.roll(z, 1, axis)) / (2 * step)) ** 2) for axis in (0, 1)]
    bends = [np.mean(((np.roll(z, -1, axis) - 2 * z + np.roll(z, 1, axis)) / step**2) ** 2) for axis in (0, 1)]
    assert moments.m0 == pytest.approx(1.0, rel=1e-9)
    assert moments.m2 == pytest.approx(np.mean(slopes), rel=0.05)
    assert moments.m4 == pytest.approx(np.mean(bends), rel=0.03)
    assert moments.gradient == pytest.approx(math.sqrt(sum(slopes)), rel=0.03)


@catches("twice the summits").at("validation.theory.interface.GreenwoodWilliamson.density", Times(2.0))
@catches("summits as high as all points").at("validation.theory.interface.GreenwoodWilliamson.summits", Times(0.5))
@catches("asperities of half the radius").at("validation.theory.interface.GreenwoodWilliamson.radius", Times(0.5))
@catches("heights of summits that scatter as all do").at(
    "validation.theory.interface.GreenwoodWilliamson.deviation", Times(1.5)
)
def test_asperities_are_the_summits_of_a_drawn_surface():
    """Maxima of eight cells around, some 1500 of them: the sampling error is 2 to 3 %, that of the grid less."""
    cells = 512
    z, step = drawn(cells), 1 / cells
    around = [np.roll(z, shift, (0, 1)) for shift in np.ndindex(3, 3)]
    centre = around[4]
    summit = np.logical_and.reduce([centre > other for i, other in enumerate(around) if i != 4])
    x, y = ((np.roll(z, 2, a) - 2 * np.roll(z, 1, a) + z) / step**2 for a in (0, 1))
    curvature = -(np.roll(x, 1, 1) + np.roll(y, 1, 0)) / 2
    asperities = GreenwoodWilliamson(RoughnessSpectrum.of_heights(z, spacing=step), 1.0)
    assert summit.sum() == pytest.approx(asperities.density, rel=0.05)
    assert centre[summit].mean() == pytest.approx(asperities.summits, rel=0.05)
    assert centre[summit].std() == pytest.approx(asperities.deviation, rel=0.1)
    assert 1 / curvature[summit].mean() == pytest.approx(asperities.radius, rel=0.05)


def test_a_spectrum_is_its_moments_on_nodes_and_on_waves():
    """2 pi int q^(1+n) C dq of a power law in closed form; one wave has alpha = 1.5."""
    law = RoughnessSpectrum.of_c2d(lambda q: q**-4.0, (1.0, 10.0))
    assert law.m0 == pytest.approx(np.pi * (1 - 1e-2), rel=1e-6)
    assert law.m2 == pytest.approx(np.pi * math.log(10), rel=1e-6)
    assert law.m4 == pytest.approx(3 / 8 * np.pi * 99, rel=1e-6)
    assert RoughnessSpectrum((7.0,), (2.0,)).bandwidth == pytest.approx(1.5)


# --- asperities ---

MOMENTS = RoughnessSpectrum.of_c2d(c2d, EDGES)


@catches("another tail", 1.5, 2.0).at(
    "validation.theory.interface.math",
    types.SimpleNamespace(gamma=lambda n: math.gamma(n - 0.5), sqrt=math.sqrt, pi=math.pi),
)
@pytest.mark.parametrize("order", [0.0, 0.5, 1.0, 1.5])
@pytest.mark.parametrize("t", [-6.0, -2.0, 0.0, 2.0, 6.0, 12.0])
def test_the_tail_is_its_integral(order, t):
    """s = t + y^2 takes the root out of the integrand."""

    def integrand(y):
        return 2 * y ** (2 * order + 1) * math.exp(-((t + y * y) ** 2) / 2) / math.sqrt(2 * math.pi)

    value, _ = integrate.quad(integrand, 0, math.sqrt(max(-t, 0) + 9), epsabs=0, limit=200)
    assert gaussian_tail(order, t) == pytest.approx(value, rel=1e-6)


@catches("Greenwood and Williamson's stiffness at half the gap").at(
    "validation.theory.interface.gaussian_tail", lambda n, t: gaussian_tail(n, np.asarray(t) * 0.5)
)
def test_spherical_asperities_are_a_sum_over_hertz_contacts():
    """4/3 E* sqrt(R) w^(3/2), pi R w and 2 E* sqrt(R w) over quantiles of the heights of summits: 1e5, good to 1e-3."""
    model = GreenwoodWilliamson(MOMENTS, 2.0)
    share = (np.arange(100_000) + 0.5) / 100_000
    z = model.summits + model.deviation * special.ndtri(share)
    for u in (0.0, MOMENTS.height, 2 * MOMENTS.height):
        w = np.maximum(z - u, 0.0)
        p = 4 / 3 * 2.0 * math.sqrt(model.radius) * model.density * np.mean(w**1.5)
        area = math.pi * model.radius * model.density * np.mean(w)
        k = 2 * 2.0 * math.sqrt(model.radius) * model.density * np.mean(np.sqrt(w))
        assert model.mean_gap(p) == pytest.approx(u, abs=2e-3 * MOMENTS.height)
        assert model.area_fraction(p) == pytest.approx(area, rel=3e-3)
        assert model.stiffness(p) == pytest.approx(k, rel=3e-3)


def summits_by_chance(moments, count):
    """Heights and curvatures of stationary points by their covariance, with det(Hessian) as weights: 1 and 2 maxima."""
    m0, m2, m4 = moments.m0, moments.m2, moments.m4
    covariance = [[m0, -m2, -m2, 0], [-m2, m4, m4 / 3, 0], [-m2, m4 / 3, m4, 0], [0, 0, 0, m4 / 3]]
    z, xx, yy, xy = np.random.default_rng(5).multivariate_normal(np.zeros(4), covariance, count).T
    mean, deviator = -(xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    weight = np.where(mean > deviator, mean**2 - deviator**2, 0.0) / (2 * math.pi * m2)
    return z, mean - deviator, mean + deviator, weight


def hertz_of_curvatures(low, high, depth, modulus):
    """Force and area of elliptic contacts by Johnson's table of b/a, (4.26): complete elliptic integrals K and E."""
    ratio = np.linspace(1e-4, 1 - 1e-6, 20_001)
    first, second = special.ellipkm1(ratio**2), special.ellipe(1 - ratio**2)
    of_ratio = (first - second) / (second / ratio**2 - first)
    flat = np.interp(low / high, of_ratio, ratio)
    first, second = special.ellipkm1(flat**2), special.ellipe(1 - flat**2)
    short = np.sqrt(depth * second / first / ((low + high) / 2))
    area = math.pi * short**2 / flat
    return 2 / 3 * modulus * area * depth / (short * first), area


AT_GAP = BushGibsonThomas.at_gap


@catches("summits that are as high as their mean, whatever their curvature").at(
    "validation.theory.interface.BushGibsonThomas.at_gap",
    lambda model, gap: AT_GAP(model, np.asarray(gap) - 0.3 * model.spectrum.height),
)
@catches("asperities that are spheres").at(
    "validation.theory.interface.elliptic_contact",
    lambda radii, **settings: elliptic_contact((1.0, 1.0), **settings),
)
def test_elliptic_asperities_are_a_sum_over_summits_by_chance():
    """2 000 000 points, of which a few per cent touch: some tenths of a per cent of pressure, area and stiffness."""
    model = BushGibsonThomas(MOMENTS, 2.0)
    z, low, high, weight = summits_by_chance(MOMENTS, 2_000_000)
    for u in (MOMENTS.height, 1.5 * MOMENTS.height):
        on = (weight > 0) & (z > u)
        force, area = hertz_of_curvatures(low[on], high[on], z[on] - u, 2.0)
        share = weight[on] / z.size
        p = np.sum(share * force)
        k = np.sum(share * 1.5 * force / (z[on] - u))
        assert np.sum(weight) / z.size == pytest.approx(GreenwoodWilliamson(MOMENTS, 1.0).density, rel=0.01)
        assert model.mean_gap(p) == pytest.approx(u, abs=0.01 * MOMENTS.height)
        assert model.area_fraction(p) == pytest.approx(np.sum(share * area), rel=0.02)
        assert model.stiffness(p) == pytest.approx(k, rel=0.02)


@pytest.mark.parametrize("model", [GreenwoodWilliamson(MOMENTS, 2.0), BushGibsonThomas(MOMENTS, 2.0)])
def test_the_stiffness_of_asperities_is_the_slope_of_their_gap(model):
    p = np.array([1e-6, 1e-3, 0.1])
    slope = (model.mean_gap(p * (1 - 1e-4)) - model.mean_gap(p * (1 + 1e-4))) / (2e-4 * p)
    assert slope * model.stiffness(p) == pytest.approx(np.ones(3), rel=1e-5)
    assert quantities_of(model) == interface.QUANTITIES


def test_elliptic_asperities_have_a_proportional_area_at_loads_of_no_size():
    """A E* g / p tends to sqrt(2 pi) as 1 / u^2: 1e-24 has a gap of 10 h; spheres have no limit."""
    p = np.array([1e-12, 1e-24])
    kappa = BushGibsonThomas(MOMENTS, 2.0).area_fraction(p) * 2 * MOMENTS.gradient / p
    assert kappa[0] < kappa[1] < math.sqrt(2 * math.pi)
    assert kappa[1] == pytest.approx(math.sqrt(2 * math.pi), rel=0.015)
    spheres = GreenwoodWilliamson(MOMENTS, 2.0).area_fraction(p) * 2 * MOMENTS.gradient / p
    assert spheres[1] > spheres[0] > 1.3 * math.sqrt(2 * math.pi)


# --- models with the measured gap ---


@catches("the tail of all orders alike").at(
    "validation.theory.interface.gaussian_tail", lambda n, t: gaussian_tail(1.5, t) if n else gaussian_tail(0, t)
)
def test_the_tail_formula_is_the_slope_of_springs_under_a_gaussian():
    """d ln p / du of p = mean (z - u)^(3/2), over 1e5 quantiles z of heights h = 0.2."""
    z = 0.2 * special.ndtri((np.arange(100_000) + 0.5) / 100_000)
    p = np.array([np.mean(np.maximum(z - u, 0.0) ** 1.5) for u in (0.4 + 1e-3, 0.4, 0.4 - 1e-3)])
    formula = TailFormula(0.2, MeasuredGap(tuple(p.tolist()), (0.401, 0.4, 0.399)))
    assert formula.stiffness(p[1]) == pytest.approx((p[2] - p[0]) / 2e-3, rel=5e-3)
    assert quantities_of(formula) == ("stiffness",)


def test_the_bearing_area_leaves_the_measured_gap():
    """Sorted heights, cut at d: the mean of what is left below is the gap, the share above the area."""
    z = 0.2 * special.ndtri((np.arange(100_000) + 0.5) / 100_000)
    for d in (-0.1, 0.1, 0.5):
        gap = float(np.maximum(d - z, 0.0).mean())
        section = BearingArea(0.2, MeasuredGap((1.0, 2.0), (gap, gap)))
        assert section.area_fraction(1.5) == pytest.approx(np.mean(z > d), rel=1e-2)
    assert quantities_of(section) == ("area_fraction",)


@catches("a half-space of twice the modulus").at(
    "validation.theory.interface.np.fft.ifft2", lambda x: np.fft.ifftn(2 * x)
)
def test_a_wave_is_closed_by_westergaards_pressure():
    """pi E* h / lambda; the bounds enclose a stiffness only if the gap is open."""
    x = (np.arange(256) + 0.5) / 256
    wave = np.broadcast_to(0.01 * np.cos(2 * np.pi * 2 * x), (256, 256))
    full = full_contact_pressure(wave, spacing=1 / 256, modulus=3.0)
    assert full == pytest.approx(math.pi * 3.0 * 0.01 / 0.5, rel=2e-3)
    least, most = Barber(0.01, full).stiffness_bounds(0.1 * full, 0.006)
    assert least == pytest.approx(0.1 * full / 0.004) and most == pytest.approx(0.9 * full / 0.006)
    assert Barber(0.01, full).stiffness(0.1 * full) <= least < most


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"p": 0.0}, "pressure must be finite and positive, got 0.0"),
        ({"gamma": 1.1}, r"gamma must be in \(0, 1\], got 1.1"),
        ({"edges": (2.0,)}, r"edges must be two or more, positive and ascending, got \(2.0,\)"),
        ({"modulus": -1.0}, "modulus must be finite and positive, got -1.0"),
    ],
)
def test_what_has_no_answer_is_refused(wrong, said):
    with pytest.raises(ValueError, match=f"^{said}$"):
        stiffness(**{"p": 0.1, **wrong})


def test_a_gap_that_was_not_measured_and_waves_out_of_order_are_refused():
    with pytest.raises(ValueError, match="pressure must be from 1 to 2 Pa, where gaps were measured, got 3"):
        MeasuredGap((1.0, 2.0), (0.2, 0.1))(3.0)
    with pytest.raises(ValueError, match="wavenumbers must be positive and ascending"):
        RoughnessSpectrum((2.0, 1.0), (1.0, 1.0))
    for model in (GreenwoodWilliamson, BushGibsonThomas):
        with pytest.raises(ValueError, match="modulus must be finite and positive, got 0"):
            model(MOMENTS, 0.0)
