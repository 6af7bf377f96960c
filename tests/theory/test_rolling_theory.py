"""The referees of rolling against each other, against slow sums, and what springs must be fed to agree with them."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

import mdr
from tests.oracles import moment_1d
from tests.seeded import Times, catches, catches_root_of_two
from tests.strategies import bumps
from validation.analysis import spectra
from validation.analysis.spectra import Bands, waves
from validation.theory import rolling
from validation.theory.rolling import (
    contact_lost,
    force_spectrum_1d,
    force_spectrum_3d,
    force_variance,
    level_ratio,
    linear_force,
    mean_force_spectrum_1d,
    response,
    section,
)

UNIT = {"contact_radius": 1.0, "modulus": 1.0}
HURSTS = (0.4, 0.7, 1.0)


def power_law(hurst, first=1.0, last=20.0):
    """Of unit height, and its edges."""
    spectrum = mdr.SelfAffine(hurst=hurst, q_min=first, q_max=last, rms=1.0)
    return spectrum, (first, last)


@catches("factor 4 lost in the spectrum of the half-space", hurst=0.7, q=1.7).at(
    "validation.theory.rolling.response", Times(0.5)
)
@pytest.mark.parametrize("hurst", HURSTS)
@pytest.mark.parametrize("q", [0.0, 0.3, 1.0, 1.7, math.pi, 10.0, 19.0])
def test_force_spectrum_by_adaptive_quadrature(hurst, q):
    """Over k, from the edge of the band to its other edge, panel by panel."""
    spectrum, edges = power_law(hurst)
    k = np.sqrt(np.linspace(max(q, edges[0]), edges[1], 30) ** 2 - q**2)

    def power(across):
        s = math.hypot(q, across)
        return 8 * math.sin(s) ** 2 / s**2 * float(spectrum.c2d(s))

    expected = sum(integrate.quad(power, low, high, epsabs=0, epsrel=1e-11)[0] for low, high in pairwise(k))
    assert float(force_spectrum_3d(q, spectrum.c2d, edges=edges, **UNIT)) == pytest.approx(expected, rel=1e-8)
    assert float(force_spectrum_3d(-q, spectrum.c2d, edges=edges, **UNIT)) == pytest.approx(expected, rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("a", [0.05, 1.0, 3.0])
@pytest.mark.parametrize("hurst", HURSTS)
def test_the_force_spectrum_integrates_to_the_variance_of_the_force(hurst, a):
    """int C_F dq of the half-space = 2 pi int G C_2D s ds; the next test has int (14.12) dq with C_1D = pi q C_2D."""
    spectrum, edges = power_law(hurst)
    wheel = {"contact_radius": a, "modulus": 3.0}
    whole = force_variance(spectrum.c2d, edges=edges, **wheel)
    # C_F has a kink, k ~ sqrt(1 - q^2), where the band begins: panels graded towards it from both sides
    graded = np.geomspace(1e-9, 1.0, 20)
    ends = np.concatenate([1 - graded, [1.0], 1 + graded, np.linspace(2, 20, math.ceil(20 * a) + 10)[1:]])
    node, weight = np.polynomial.legendre.leggauss(12)
    ends.sort()
    half, middle = np.diff(ends)[:, np.newaxis] / 2, (ends[1:] + ends[:-1])[:, np.newaxis] / 2
    values = force_spectrum_3d(middle + half * node, spectrum.c2d, edges=edges, **wheel)
    total = 2 * float(np.sum(half * weight * values))
    assert total == pytest.approx(whole, rel=1e-5)


@pytest.mark.slow
@given(spectrum=bumps(), a=st.floats(-2, 2))
def test_geikes_rule_keeps_the_variance_of_any_spectrum(spectrum, a):
    wheel = {"contact_radius": 10**a / math.exp(spectrum.centre[0]), "modulus": 1.0}
    # beyond a hundred radians to the radius the sum below would have to resolve them
    high = min(spectrum.q_high, 100 / wheel["contact_radius"])
    whole = force_variance(spectrum.c2d, edges=(spectrum.q_low, high), **wheel)

    def springs(q):
        return force_spectrum_1d(q, lambda k: mdr.geike(k, spectrum.c2d), **wheel)

    panels = pairwise(np.geomspace(spectrum.q_low, high, 300))
    assert sum(moment_1d(springs, 0, *ends, nodes=24) for ends in panels) == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize(("hurst", "ratio"), [(0.4, 0.437), (0.7, 0.402), (1.0, 0.375)])
def test_levels_of_both_methods_differ_by_a_constant_ratio(hurst, ratio):
    """The numbers of section 7; and the limit of the quadrature, over whole periods of the oscillation.

    The band ends at 30 q, which leaves out a part 30^(-2H-3) and the like; over a period of an oscillation of
    (q a)^(-1/2), which fades by a part 1 / (q a), that leaves (q a)^(-3/2).
    """
    assert level_ratio(hurst) == pytest.approx(ratio, abs=5e-4)
    spectrum, edges = power_law(hurst, 1.0, 6e3)
    q = 200 + np.pi * (np.arange(64) + 0.5) / 64
    mean = mean_force_spectrum_1d(q, spectrum.c1d, modulus=1.0)
    surface = force_spectrum_3d(q, spectrum.c2d, edges=edges, **UNIT) / mean
    springs = force_spectrum_1d(q, spectrum.c1d, **UNIT) / mean
    assert springs.mean() == pytest.approx(1, rel=1e-12)
    assert surface.mean() == pytest.approx(level_ratio(hurst), rel=200**-1.5)


@given(
    k=st.integers(-6, 6), m=st.integers(-6, 6), phase=st.floats(0, 6.28), approach=st.floats(0.01, 1), odd=st.booleans()
)
def test_a_plane_wave_at_any_angle_acts_by_its_own_length(k, m, phase, approach, odd):
    """dF = 2 E* sin(|k| a) / |k| cos of its phase under the middle of the wheel."""
    nx, ny, dx, radius, modulus = 30 + odd, 24 + odd, 0.1, 2.0, 5.0
    x = np.arange(nx)[:, np.newaxis] * dx
    y = (np.arange(ny) - (ny - 1) / 2) * dx
    kx, ky = 2 * np.pi * k / (nx * dx), 2 * np.pi * m / (ny * dx)
    height = 0.3 * np.cos(kx * x + ky * y + phase)
    a, s = math.sqrt(radius * approach), math.hypot(kx, ky)
    gain = 2 * modulus * math.sin(s * a) / s if s else 2 * modulus * a
    expected = 4 / 3 * modulus * a * approach + 0.3 * gain * np.cos(kx * x[:, 0] + phase)
    found = linear_force(height, spacing=dx, radius=radius, modulus=modulus, approach=approach)
    assert found == pytest.approx(expected, abs=1e-12 * (np.abs(expected).max() + 0.3 * 2 * modulus * a))


def test_the_response_is_that_of_the_flat_punch():
    """(E* / pi) int J_0(k r) 2 pi r dr / sqrt(a^2 - r^2), and E* int exp(i q x) dx on springs."""
    a, modulus = 1.3, 2.0
    angle = (np.arange(400) + 0.5) * np.pi / 800
    for k in (0.0, 0.5, 2.4, 7.0):
        around = (np.arange(200) + 0.5) * 2 * np.pi / 200
        # r = a sin t takes the root away
        wave = np.cos(k * a * np.sin(angle)[:, np.newaxis] * np.cos(around))
        ring = modulus / np.pi * np.sum(wave * a * np.sin(angle)[:, np.newaxis]) * (np.pi / 800) * (2 * np.pi / 200)
        line = modulus * integrate.quad(lambda x, k=k: math.cos(k * x), -a, a)[0]
        expected = float(response(k, contact_radius=a, modulus=modulus))
        assert ring == pytest.approx(expected, abs=1e-5 * 2 * modulus * a)
        assert line == pytest.approx(expected, abs=1e-12 * 2 * modulus * a)


@catches("Geike for the line trace in rolling", hurst=0.7).at("mdr.SelfAffine.line", mdr.SelfAffine.c1d)
@pytest.mark.parametrize("hurst", HURSTS)
def test_sections_are_line_traces(hurst):
    spectrum, edges = power_law(hurst)
    q = np.array([0.0, 0.5, 0.999, 1.001, 3.0, 19.0, 19.999, 20.0, 21.0])
    assert section(q, spectrum.c2d, edges=edges) == pytest.approx(spectrum.line(q), rel=1e-9, abs=1e-18)


@catches("springs that roll fed by the line trace", hurst=0.7).at(
    "mdr.rolling_spectrum._across", lambda q, c2d, edges, flat: float(rolling.section(q, c2d, edges=edges))
)
@pytest.mark.parametrize("hurst", HURSTS)
def test_large_wheels_are_fed_less_than_geike(hurst):
    """By the ratio of levels, for an unbounded power law: its band ends at 1000 q and leaves 1000^(-2H-3) out."""
    spectrum, edges = power_law(hurst, 1.0, 1e5)
    q = np.array([1.0, 3.0, 100.0])
    fed = mdr.rolling_spectrum(q, spectrum.c2d, edges=edges)
    assert fed / spectrum.c1d(q) == pytest.approx(level_ratio(hurst), rel=1e-6)
    near = mdr.rolling_spectrum(q, spectrum.c2d, edges=edges, contact_radius=1e4)
    assert near == pytest.approx(fed, rel=1e-7)


@pytest.mark.slow
@given(share=st.floats(0, 1), a=st.floats(-2, 2), hurst=st.floats(0.05, 1.2))
def test_the_feed_by_adaptive_quadrature(share, a, hurst):
    """By panels that end inside of the band, too."""
    (spectrum, _), edges = power_law(hurst), (1.0, 5.0, 20.0)
    q, a = 20 * share, 10**a
    found = float(mdr.rolling_spectrum(q, spectrum.c2d, edges=edges, contact_radius=a))
    if q > 19.99:
        return
    ends = np.sqrt(np.geomspace(max(q, 1.0), 20.0, 8) ** 2 - q**2)

    def power(k):
        s = math.hypot(q, k)
        return 2 * (1 + (q * a) ** 2) / (1 + (s * a) ** 2) * float(spectrum.c2d(s))

    expected = sum(integrate.quad(power, low, high, epsabs=0, epsrel=1e-11)[0] for low, high in pairwise(ends))
    assert found == pytest.approx(expected, rel=1e-7)
    assert found == float(mdr.rolling_spectrum(-q, spectrum.c2d, edges=edges, contact_radius=a))


def between(first, last):
    """Bands of which one begins at the first wavenumber."""
    return Bands.around(first * 2 ** (1 / 6), first, last)


def band_levels(values, q, bands):
    """Sums over each band, of values at many wavenumbers."""
    inside = [(q >= low) & (q < high) for low, high in pairwise(bands.edges)]
    return np.array([values[band].sum() for band in inside])


@catches("springs that roll fed by Geike", hurst=0.7, first=1.0).at(
    "mdr.rolling_spectrum._across", lambda q, c2d, edges, flat: float(np.pi * q * c2d(np.array(q)))
)
@pytest.mark.slow
@pytest.mark.parametrize("first", [1.0, 2 ** (1 / 6)])
@pytest.mark.parametrize("hurst", HURSTS)
def test_springs_that_are_fed_for_rolling_have_the_level_of_the_half_space(hurst, first):
    """Within 1.75 dB in third octaves of q a = 1 to 20, but where sin^2(q a) is zero and fills in on the half-space.

    Measured: 1.72 dB at H = 0.4. Lower, by up to 7.4 dB, in bands with the first zero, q a = pi, and by up to 3.7 dB in
    those with the second, or with either at an edge, as the first one has when bands begin at q a = 1.
    Beyond, a band holds a period and more.
    """
    spectrum, edges = power_law(hurst, 1.0, 20.0)
    bands = between(first, 20.0)
    q = np.geomspace(first, 20.0, 400, endpoint=False)

    def fed(k):
        return mdr.rolling_spectrum(k, spectrum.c2d, edges=edges, contact_radius=1.0)

    springs = band_levels(force_spectrum_1d(q, fed, **UNIT) * q, q, bands)
    surface = band_levels(force_spectrum_3d(q, spectrum.c2d, edges=edges, **UNIT) * q, q, bands)
    geike = band_levels(force_spectrum_1d(q, spectrum.c1d, **UNIT) * q, q, bands)
    low, high = np.array(bands.edges[:-1]) / 1.02, np.array(bands.edges[1:]) * 1.02
    zero = ((low < np.pi) & (high > np.pi)) | ((low < 2 * np.pi) & (high > 2 * np.pi))
    decibels = 10 * np.log10(springs / surface)
    assert np.abs(decibels[~zero]).max() <= 1.75
    assert decibels.max() <= 1.75
    # Geike's spectrum is too loud by the ratio of levels: the rule is needed
    assert np.median(10 * np.log10(geike / surface)) > 3


two_sided = spectra.Waves.spectrum.fget


@catches("one-sided spectrum of a track").at(
    "validation.analysis.spectra.Waves.spectrum", property(lambda waves: 2 * two_sided(waves))
)
def test_spectra_of_profiles_are_the_ones_they_are_drawn_from():
    """Two-sided, wave by wave, since the amplitudes are fixed."""
    spectrum = mdr.SelfAffine(hurst=0.7, q_min=5.0, q_max=60.0, rms=1.0)
    profile = mdr.rough_profile(spectrum.c1d, length=10.0, points=512, rng=np.random.default_rng(0))
    found = waves(profile, spacing=10.0 / 512)
    assert found.spectrum == pytest.approx(spectrum.c1d(found.q), rel=1e-9, abs=1e-15)


@catches_root_of_two("the gradient of lost contact", "validation.theory.rolling.rms_gradient", height=1.0)
@pytest.mark.parametrize("height", [0.003, 0.05, 1.0, 1e6])
def test_contact_that_linear_theory_loses_by_drawing_pressures(height):
    c2d, edges = (lambda q: np.where((q >= 1) & (q <= 8), height**2 * q**-3.4, 0.0)), (1.0, 8.0)
    found = contact_lost(c2d, edges=edges, contact_radius=1.0, radius=2.0)
    slope = math.sqrt(2 * math.pi * integrate.quad(lambda q: q**3 * height**2 * q**-3.4, 1, 8)[0])
    rng = np.random.default_rng(3)
    radius, drawn = np.sqrt(rng.random(200_000)), rng.standard_normal(200_000)
    pressure = 2 / (math.pi * 2.0) * np.sqrt(1 - radius**2) + slope / 2 * drawn
    share = np.mean(pressure < 0)
    # three standard errors of a share; half is lost under endless roughness
    assert found == pytest.approx(share, abs=3 * math.sqrt(max(share, 1e-5) / drawn.size) + 1e-6)
    assert found <= 0.5
