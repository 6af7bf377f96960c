"""What lies across a track: the surface of a line, and means of filters, beside adaptive quadrature."""

import math
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from scipy import integrate

from tests.seeded import Times, catches
from validation.railway.theory import transverse_structure
from validation.railway.theory.contact_filters import half_space_filter, row_of_means_filter
from validation.railway.theory.transverse_structure import (
    IsotropicGround,
    LineSpectrum,
    Ridges,
    WaveBand,
    has_isotropic_surface,
)

AXES = (5.7e-3, 4.3e-3)
RAIL = LineSpectrum((10.0, 100.0, 1e3, 4e3), (1e-12, 3e-14, 2e-16, 3e-17))
"""Three laws; the last continues."""
SMOOTH = LineSpectrum((1.0, 10.0), (1e-9, 1e-9 * 10**-2.4))
"""One law, q^-2.4."""


def test_a_line_passes_through_its_points_and_falls_beyond_them():
    np.testing.assert_allclose(RAIL(RAIL.wavenumbers), RAIL.densities, rtol=1e-12)
    np.testing.assert_allclose(RAIL([-1e3, 1e3]), RAIL(1e3), rtol=1e-12)
    assert float(RAIL(math.sqrt(10 * 100))) / math.sqrt(1e-12 * 3e-14) == pytest.approx(1.0)
    rising = LineSpectrum((1.0, 2.0), (1.0, 8.0))
    assert float(rising(0.5)) == pytest.approx(1 / 8)
    assert float(rising(4.0)) == pytest.approx(4.0)


@pytest.mark.parametrize(
    "given_", [((1.0,), (1.0,)), ((2.0, 1.0), (1.0, 1.0)), ((1.0, 2.0), (1.0, 0.0)), ((1.0, 2.0), (1.0,))]
)
def test_a_line_needs_ascending_points_with_power(given_):
    with pytest.raises(ValueError, match=r"wavenumbers|densities"):
        LineSpectrum(*given_)


@pytest.mark.parametrize("s", [0.3, 3.0, 30.0])
def test_the_surface_of_a_power_law(s):
    """C_2D = C_line p Gamma(p/2 + 1/2) / (2 sqrt(pi) Gamma(p/2 + 1) s), everywhere."""
    p = 2.4
    ratio = p * math.gamma(p / 2 + 0.5) / (2 * math.sqrt(math.pi) * math.gamma(p / 2 + 1))
    assert float(SMOOTH.isotropic(s)) / (ratio * float(SMOOTH(s)) / s) == pytest.approx(1.0, rel=1e-11)


@catches("half of Abel's inverse", q=50.0).at(
    "validation.railway.theory.transverse_structure.LineSpectrum.isotropic", Times(0.5)
)
@pytest.mark.parametrize("q", [3.0, 50.0, 700.0, 2e4])
def test_a_line_over_its_surface_is_that_line(q):
    """int C_2D dk by another quadrature, over t with k = q tan t, law by law."""
    bends = [math.acos(q / node) for node in RAIL.wavenumbers if node > q]
    integral = integrate.quad(
        lambda t: float(RAIL.isotropic(q / math.cos(t))) * q / math.cos(t) ** 2,
        *(0, math.pi / 2),
        points=bends or None,
        limit=400,
        epsabs=0,
        epsrel=1e-9,
    )[0]
    assert 2 * integral / float(RAIL(q)) == pytest.approx(1.0, rel=1e-7)


@pytest.mark.parametrize("last", [1e-19, 1e-27, 1e-35])
def test_long_waves_of_a_surface_do_not_see_a_cliff_of_its_line(last):
    """Of long waves all ends are alike that fall at once: beside one that falls by 20 dB in a third of an octave."""
    q, c = RAIL.wavenumbers, RAIL.densities
    cliff, slope = (LineSpectrum((*q, 1.26 * q[-1]), (*c, end)) for end in (last, 0.01 * c[-1]))
    long = np.geomspace(1.0, 0.05 * q[-1], 30)
    assert has_isotropic_surface(cliff)
    np.testing.assert_allclose(cliff.isotropic(long), slope.isotropic(long), rtol=0.01)


def test_a_steeper_line_has_larger_exponents_and_longer_waves_do_not_fall():
    q = np.array([3.0, 20.0, 300.0, 9e3])
    np.testing.assert_allclose(RAIL.steeper(0.3)(q) / RAIL(q), (q / RAIL.wavenumbers[0]) ** -0.3, rtol=1e-12)
    np.testing.assert_allclose(RAIL.from_wavenumber(0.5)([0.5, 2.0, 50.0]), RAIL([0.5, 2.0, 50.0]), rtol=1e-12)
    assert RAIL.from_wavenumber(20.0) is RAIL
    rising = LineSpectrum((1.0, 2.0, 4.0), (1.0, 1.1, 0.2))
    assert float(rising(0.1)) < 1.0 == float(rising.from_wavenumber(0.1)(0.1))


def test_lines_of_isotropic_surfaces_are_those_that_nowhere_rise_too_steeply():
    assert has_isotropic_surface(RAIL) and has_isotropic_surface(LineSpectrum((1.0, 2.0), (1.0, 1.0)))
    steep = LineSpectrum((1.0, 2.0, 4.0), (1.0, 20.0, 10.0))
    assert not has_isotropic_surface(steep)
    with pytest.raises(ValueError, match="no isotropic surface has this line"):
        IsotropicGround(steep)


@catches("ridges for isotropic ground", q=150.0).at(
    "validation.railway.theory.transverse_structure.IsotropicGround.mean_square",
    transverse_structure.Ridges.mean_square,
)
@pytest.mark.slow
@pytest.mark.parametrize("q", [5.0, 150.0, 2500.0])
def test_the_mean_over_isotropic_ground(q):
    """Adaptive quadrature of |H|^2 C_2D over k_y, to the accuracy of the table of C_2D."""
    transfer = partial(half_space_filter, semi_axes=AXES)
    ends = [0.0, *np.geomspace(0.1, 3e4, 60)]
    passed = sum(
        integrate.quad(lambda k: float(transfer(q, k)) ** 2 * float(RAIL.isotropic(math.hypot(q, k))), a, b, epsabs=0)[
            0
        ]
        for a, b in pairwise(ends)
    )
    mean = IsotropicGround(RAIL).mean_square(q, transfer, semi_axis=AXES[1])
    assert float(mean) == pytest.approx(2 * passed / float(RAIL(q)), rel=3e-3)


def test_a_filter_that_does_not_see_across_has_the_mean_of_ridges():
    """Also where much of the power lies far across: C_line ~ 1/q has a level of its own in each octave."""
    flat = LineSpectrum((1.0, 1e4), (1.0, 1e-4))
    q = np.array([5.0, 50.0, 1000.0])
    mean = IsotropicGround(flat).mean_square(q, lambda along, across: np.cos(along) + 0 * across, semi_axis=4e-3)
    assert mean == pytest.approx(Ridges().mean_square(q, lambda along, across: np.cos(along), semi_axis=4e-3), rel=2e-3)


@catches("a line that keeps the waves which its surface has lost").at(
    "validation.railway.theory.transverse_structure.IsotropicGround.line_power", lambda ground, q: ground.line(q)
)
def test_ground_without_its_shortest_waves_has_the_line_that_is_left():
    """A cut at q_max takes waves from the line below it too, and the mean is over what is left."""
    ground = IsotropicGround(RAIL, q_max=2e3)
    q = 900.0
    end = math.sqrt(ground.q_max**2 - q**2)
    line = 2 * integrate.quad(lambda k: float(RAIL.isotropic(math.hypot(q, k))), 0, end, epsabs=0)[0]
    assert float(ground.line_power(q)) / line == pytest.approx(1.0, rel=1e-3)
    assert line < 0.9 * float(RAIL(q))
    passed = ground.mean_square(q, lambda x, y: np.ones(np.broadcast(x, y).shape), semi_axis=AXES[1])
    assert float(passed) == pytest.approx(1.0, rel=2e-3)
    assert float(ground.c2d(2.001e3)) == 0.0


def test_a_narrow_band_is_ridges_and_its_density_has_the_line():
    transfer = partial(half_space_filter, semi_axes=AXES)
    q = np.geomspace(3.0, 1e3, 12)
    ridges = Ridges().mean_square(q, transfer, semi_axis=AXES[1])
    np.testing.assert_allclose(ridges, np.sinc(q * AXES[0] / np.pi) ** 2, rtol=1e-12)
    np.testing.assert_allclose(WaveBand(1e-5).mean_square(q, transfer, semi_axis=AXES[1]), ridges, atol=1e-8)
    band = WaveBand(0.5)
    k = (np.arange(4000) + 0.5) / 4000 * 100.0
    line = 2 * band.density(100.0, k, RAIL).sum() * 100 / 4000
    assert line / float(RAIL(100.0)) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("structure", [Ridges(), WaveBand(1.0), IsotropicGround(RAIL)])
def test_bands_of_long_waves_pass_and_powers_of_bands_are_integrals(structure):
    transfer = partial(half_space_filter, semi_axes=AXES)
    edges = [5.0, 6.0, 600.0, 700.0]
    powers = structure.band_power(RAIL, transfer, edges=edges, semi_axes=AXES)
    assert powers[0] == pytest.approx(1.0, abs=5e-3)
    q = np.linspace(600, 700, 4001)
    power = structure.mean_square(q, transfer, semi_axis=AXES[1]) * RAIL(q)
    assert powers[2] == pytest.approx(integrate.trapezoid(power, q) / integrate.trapezoid(RAIL(q), q), rel=1e-4)


def test_the_row_of_means_is_a_uniform_mean_over_a_rectangle():
    x, y = (np.linspace(-a, a, 801) for a in (2.0, 0.7))
    mean = np.cos(1.3 * x).mean() * np.cos(2.1 * y).mean()
    assert float(row_of_means_filter(1.3, 2.1, semi_axes=(2.0, 0.7))) == pytest.approx(mean, abs=2e-3)


# --- contacts that are wide beside the waves ---

WIDE = (0.08, 0.06)
"""Semi-axes at which waves of 1 mm have q a_x of 500."""


@catches(
    "a place for its period, where a contact is many waves wide", structure=transverse_structure.Ridges(), way=0
).at("validation.railway.theory.transverse_structure._periods", lambda ends, period: transverse_structure.gauss(ends))
@pytest.mark.parametrize("structure", [Ridges(), WaveBand(1.0), WaveBand(0.2), IsotropicGround(RAIL)])
@pytest.mark.parametrize("way", [0, 1])
def test_some_periods_stand_for_all(structure, way):
    """Of a filter that oscillates along or across with the contact, whose mean is one half."""
    edges = 2 * np.pi / 1e-3 * np.array([10**-0.05, 10**0.05])
    seen = lambda *waves: np.sin(waves[way] * WIDE[way]) + 0 * sum(waves)  # noqa: E731
    powers = structure.band_power(RAIL, seen, edges=edges, semi_axes=WIDE)
    expected = 0.0 if way and structure == Ridges() else 0.5
    assert powers[0] == pytest.approx(expected, abs=0.01)


@catches("a work that grows with a contact that is many waves wide", structure=transverse_structure.WaveBand(1.0)).at(
    "validation.railway.theory.transverse_structure.FAR", math.inf
)
@pytest.mark.parametrize("structure", [Ridges(), WaveBand(1.0), WaveBand(20.0), IsotropicGround(RAIL)])
def test_work_ends_where_the_contact_is_many_waves_wide(structure):
    """It is counted: a filter tells how often it is evaluated. From there on a band costs the same."""
    counted = []
    for scale in (1, 10, 100, 1000):
        axes, evaluated = (scale * 1e-3, scale * 1e-3), []

        def transfer(x, y, evaluated=evaluated):
            evaluated.append(np.broadcast(x, y).size)
            return np.ones(np.broadcast(x, y).shape)

        edges = 2 * np.pi / 1e-3 * np.array([10**-0.05, 10**0.05])
        structure.band_power(RAIL, transfer, edges=edges, semi_axes=axes)
        expected = structure.evaluations(edges=edges, semi_axes=axes)
        # the end of the last panel apart
        assert 0 <= sum(evaluated) - expected <= 1000
        counted.append(expected)
    # but for a panel across more a factor 1.4
    assert counted[3] < 1.5 * counted[2]
    assert max(counted) < 400_000


def power_law_line(p):
    q = np.geomspace(1.0, 1e4, 33)
    return LineSpectrum.through(q, q**-p)


periods = transverse_structure._periods


panels_across = transverse_structure._panels_across


@catches("far waves over half of a period", structure=transverse_structure.WaveBand(0.7)).at(
    "validation.railway.theory.transverse_structure._periods",
    lambda ends, period: periods(ends, np.asarray(period) / 2),
)
@catches("near waves counted among the far, too", structure=transverse_structure.WaveBand(0.7)).at(
    "validation.railway.theory.transverse_structure._panels_across",
    lambda q, end, period, begin=0.0: panels_across(q, end, period),
)
@pytest.mark.parametrize("structure", [WaveBand(0.7), WaveBand(3.0), IsotropicGround(power_law_line(2.0))])
def test_far_waves_are_all_there_once_and_a_fast_filter_has_its_mean(structure):
    """Contacts of 300 and 2000 waves: a filter of one lets all pass, abs(sin k_y b)^2 one half."""
    for semi_axis in (6.0, 40.0):
        q = np.array([50.0, 53.0])
        assert structure.mean_square(q, lambda x, y: 1 + 0 * (x + y), semi_axis=semi_axis) == pytest.approx(1, abs=5e-3)
        half = structure.mean_square(q, lambda x, y, b=semi_axis: np.sin(y * b) + 0 * x, semi_axis=semi_axis)
        assert half == pytest.approx(0.5, abs=5e-3)


def test_waves_beyond_the_last_pass_as_the_most_oblique_ones():
    """Of C_line ~ q^-1.2, whose oblique waves are many: the mean of exp(-t^2) with the weight (1 + t^2)^-1.1."""
    ground = IsotropicGround(power_law_line(1.2))
    mean = ground.mean_square(np.array([10.0]), lambda x, y: np.exp(-((y / x) ** 2) / 2), semi_axis=0.01)
    passed, every = (
        integrate.quad(lambda t, on=on: (1 + t * t) ** -1.1 * math.exp(-on * t * t), 0, np.inf)[0] for on in (1, 0)
    )
    assert mean[0] == pytest.approx(passed / every, rel=2e-3)
