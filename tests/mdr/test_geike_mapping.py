"""Geike's rule between the spectra of a line and of a surface: what it keeps, what would be refuted in its place."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import mdr
from tests.oracles import gauss_legendre, moment_1d, moment_2d
from tests.seeded import Times, catches
from tests.strategies import bumps, hursts, scales, self_affine

KEPT = {"height": 0, "gradient": 2, "curvature": 4}
# Gauss-Legendre in ln q is exact to rounding for power laws and for bumps this smooth
QUADRATURE = 1e-9
# far out in the tail of a bump, values are subnormal and lose their digits
TINY = 1e-290


def share_kept(c1d, c2d, n, low, high):
    """Moment of a 1D spectrum over that of the surface."""
    return moment_1d(c1d, n, low, high) / moment_2d(c2d, n, low, high)


@catches("line trace for Geike", n=2).at("mdr.SelfAffine.c1d", mdr.SelfAffine.line)
@pytest.mark.parametrize("n", KEPT.values(), ids=KEPT.keys())
@given(spectrum=self_affine())
@example(spectrum=mdr.SelfAffine(hurst=1.2, q_min=1e-9, q_max=1e-3, rms=1e9))
@example(spectrum=mdr.SelfAffine(hurst=0.01, q_min=1e9, q_max=1.03e9, rms=1e-9))
def test_moments_of_power_laws_are_kept(spectrum, n):
    assert share_kept(spectrum.c1d, spectrum.c2d, n, spectrum.q_min, spectrum.q_max) == pytest.approx(1, rel=QUADRATURE)


@catches("q C_2D for Geike", n=0).at("mdr.geike", Times(1 / np.pi))
@pytest.mark.slow
@pytest.mark.parametrize("n", [0, 1, 2, 3, 4])
@given(spectrum=bumps())
def test_moments_of_arbitrary_spectra_are_kept(spectrum, n):
    def c1d(q):
        return mdr.geike(q, spectrum.c2d)

    assert share_kept(c1d, spectrum.c2d, n, spectrum.q_low, spectrum.q_high) == pytest.approx(1, rel=QUADRATURE)


@given(spectrum=self_affine())
def test_self_affine_spectra_have_their_rms(spectrum):
    square = moment_2d(spectrum.c2d, 0, spectrum.q_min, spectrum.q_max)
    assert square == pytest.approx(spectrum.rms**2, rel=QUADRATURE, abs=0)


@given(spectrum=bumps(), q=scales)
def test_round_trip(spectrum, q):
    q = np.array([q, 2 * q])
    there = mdr.geike(q, spectrum.c2d)
    np.testing.assert_allclose(mdr.inverse_geike(q, there), spectrum.c2d(q), rtol=1e-14, atol=TINY)
    np.testing.assert_allclose(mdr.geike(q, mdr.inverse_geike(q, there)), there, rtol=1e-14, atol=TINY)


@given(spectrum=self_affine())
def test_two_sided_and_zero_outside_the_band(spectrum):
    q = np.geomspace(spectrum.q_min, spectrum.q_max, 5)
    np.testing.assert_array_equal(spectrum.c1d(-q), spectrum.c1d(q))
    assert (spectrum.c1d(q) > 0).all()
    outside = np.array([0.0, 0.99 * spectrum.q_min, 1.01 * spectrum.q_max])
    assert (spectrum.c1d(outside) == 0).all()
    assert (spectrum.c2d(outside) == 0).all()
    edges = spectrum.q_min, spectrum.q_max
    assert mdr.rolling_spectrum(1.01 * spectrum.q_max, spectrum.c2d, edges=edges, contact_radius=1.0) == 0


@given(spectrum=self_affine(), fraction=st.floats(1e-6, 1.0))
def test_line_trace_is_the_integral_across_the_line(spectrum, fraction):
    """C_line(q) = 2 int C_2D(s) s ds / sqrt(s^2 - q^2), by quadrature over t, s = q cosh t."""
    q = fraction * spectrum.q_max * 0.999
    nodes, weights = gauss_legendre(400)
    start, end = (np.arccosh(max(1.0, edge / q)) for edge in (spectrum.q_min, spectrum.q_max))
    s = q * np.cosh(start + (end - start) * (nodes + 1) / 2)
    level = spectrum.c2d(spectrum.q_min) * spectrum.q_min ** (2 * spectrum.hurst + 2)
    expected = np.sum(weights * level * s ** (-2 * spectrum.hurst - 1)) * (end - start)
    # arccosh near one, and the difference of two edges that nearly coincide, keep half of the digits
    assert spectrum.line(q) == pytest.approx(expected, rel=1e-7)


@catches("Geike for the line trace").at("mdr.SelfAffine.line", mdr.SelfAffine.c1d)
@given(hurst=hursts)
def test_line_trace_of_a_wide_power_law(hurst):
    wide = mdr.SelfAffine(hurst=hurst, q_min=1.0, q_max=1e12, rms=1.0)
    known = math.gamma(hurst + 0.5) / (math.sqrt(math.pi) * math.gamma(hurst + 1))
    assert wide.line(10.0) / wide.c1d(10.0) == pytest.approx(known, rel=1e-9)


@given(scale=st.floats(0.1, 10))
def test_line_trace_of_an_arbitrary_spectrum_against_its_closed_form(scale):
    """A Gaussian is its own line trace but for a factor: C_2D = exp(-q^2 / s^2) gives sqrt(pi) s exp(-q^2 / s^2)."""
    q = scale * np.linspace(0, 3, 6).reshape(2, 3)
    trace = mdr.line_trace(q, lambda k: np.exp(-((k / scale) ** 2)), q_max=8 * scale)
    np.testing.assert_allclose(trace, np.sqrt(np.pi) * scale * np.exp(-((q / scale) ** 2)), rtol=1e-9)


def test_the_edges_of_a_band_belong_to_it_within_a_billionth():
    """To the last bit of the wavenumber."""
    band = mdr.SelfAffine(hurst=0.7, q_min=3.0, q_max=50.0, rms=1.0)
    first, last = 3.0 * (1 - 1e-9), 50.0 * (1 + 1e-9)
    assert (band.c2d([first, last]) > 0).all()
    assert (band.c2d([np.nextafter(first, 0), np.nextafter(last, 99)]) == 0).all()
