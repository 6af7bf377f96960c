"""Input spectra of springs along a rail: the rolling spectrum on an ellipse, and Geike's rule beside the line."""

import math

import numpy as np
import pytest

import mdr
from tests.seeded import Times, catches
from validation.railway.theory import contact_filters as spring_input
from validation.railway.theory.transverse_structure import IsotropicGround, LineSpectrum

ROUGH = mdr.SelfAffine(hurst=0.7, q_min=100.0, q_max=2e4, rms=1e-6)


def power_law(exponent):
    """C_line ~ q^-p."""
    q = (1.0, 10.0)
    return LineSpectrum(q, tuple(1e-9 * k**-exponent for k in q))


def filtered_line(q, axes):
    """int T^2 C_2D dk by a sum over k in equal steps of its logarithm."""
    k = np.concatenate([[0.0], np.geomspace(1e-3, ROUGH.q_max, 200_001)])
    passed = spring_input.rolling_input_filter(q, k, semi_axes=axes) ** 2 * ROUGH.c2d(np.hypot(q, k))
    return 2 * np.trapezoid(passed, k)


def circle_for_the_ellipse(along, across, *, semi_axes):
    return ellipse_of_springs(along, across, semi_axes=(semi_axes[0], semi_axes[0]))


ellipse_of_springs = spring_input.rolling_input_filter


@catches("a circle for the ellipse in the rolling spectrum of a rail", wavenumber=700.0).at(
    "validation.railway.theory.contact_filters.rolling_input_filter", circle_for_the_ellipse
)
@pytest.mark.parametrize("wavenumber", [120.0, 700.0, 5e3])
def test_on_a_circle_it_is_the_rolling_spectrum_of_a_wheel(wavenumber):
    a = 2e-3
    expected = mdr.rolling_spectrum(wavenumber, ROUGH.c2d, edges=(ROUGH.q_min, ROUGH.q_max), contact_radius=a)
    assert filtered_line(wavenumber, (a, a)) == pytest.approx(float(expected), rel=1e-3)
    # a contact twice as long across has another spectrum
    assert filtered_line(wavenumber, (a, 2 * a)) < 0.98 * float(expected)


def test_ridges_are_read_as_they_are_and_long_waves_pass():
    q = np.geomspace(1, 1e5, 50)
    ridges = spring_input.rolling_input_filter(q, 0.0, semi_axes=(5e-3, 4e-3))
    np.testing.assert_allclose(ridges, 1.0, rtol=1e-12)
    assert spring_input.rolling_input_filter(1.0, 1.0, semi_axes=(5e-3, 4e-3)) == pytest.approx(1.0, abs=1e-4)
    assert spring_input.rolling_input_filter(0.0, 1e4, semi_axes=(5e-3, 4e-3)) < 0.05


@pytest.mark.parametrize(("exponent", "share"), [(1.8, 1.8 / 2.8), (2.4, 2.4 / 3.4), (3.0, 0.75)])
def test_short_waves_of_a_power_law_have_the_level_of_the_half_space(exponent, share):
    """p / (p + 1) of the line: int q^2 / s^2 C_2D dk over int C_2D dk, s^2 = q^2 + k^2, on a circle."""
    ground, a = IsotropicGround(power_law(exponent)), 10.0
    q = np.array([50.0, 80.0])
    passed = ground.mean_square(q, lambda x, y: spring_input.rolling_input_filter(x, y, semi_axes=(a, a)), semi_axis=a)
    np.testing.assert_allclose(passed, share, rtol=5e-3)


@catches("Geike's rule over the line without pi", exponent=2.0).at(
    "validation.railway.theory.contact_filters.geike_over_line", Times(1 / math.pi)
)
@pytest.mark.parametrize("exponent", [1.0, 2.0, 3.0, 3.4])
def test_geikes_rule_over_the_line_of_a_power_law(exponent):
    """sqrt(pi) Gamma((p + 1) / 2) / Gamma(p / 2), 1, pi / 2 and 2 for p = 1, 2 and 3."""
    ratio = spring_input.geike_over_line([2.0, 5.0, -5.0], IsotropicGround(power_law(exponent)))
    expected = math.sqrt(math.pi) * math.gamma((exponent + 1) / 2) / math.gamma(exponent / 2)
    np.testing.assert_allclose(ratio, expected, rtol=2e-3)


def test_bad_arguments_are_refused():
    with pytest.raises(ValueError, match="across must be finite and positive"):
        spring_input.rolling_input_filter(1.0, 1.0, semi_axes=(1.0, 0.0))
    with pytest.raises(ValueError, match="wavenumber must not be zero"):
        spring_input.geike_over_line([1.0, 0.0], IsotropicGround(power_law(2.0)))
