"""Hertz on an ellipse, and contact filters: published figures, the textbook's integrals, limits."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate, special

from validation.railway.theory.contact_filters import half_space_filter, remington_filter, spring_bed_filter
from validation.theory.closed_forms import hertz_approach, hertz_contact_radius
from validation.theory.half_space import elliptic_contact

STEEL = 210e9 / (2 * (1 - 0.3**2))
ratios = st.floats(0.01, 100)


def test_the_published_example_of_contact():
    """100 kN, G = 82 GPa, nu = 0.28 on both bodies, gap 0.001015 x^2 + 0.0004215 y^2 in mm: 0.08190 mm, 770.6 MPa."""
    modulus = 2 * 82e9 * (1 + 0.28) / (2 * (1 - 0.28**2))
    radii = tuple(1e-3 / (2 * curvature) for curvature in (0.001015, 0.0004215))
    found = elliptic_contact(radii, modulus=modulus, force=1e5)
    assert found.approach == pytest.approx(0.08190e-3, rel=2e-4)
    assert found.pressure == pytest.approx(770.6e6, rel=2e-4)
    assert found.across > found.along


@given(ratio=ratios, radius=st.floats(0.1, 10), force=st.floats(1, 1e6))
def test_the_integrals_of_the_textbook(ratio, radius, force):
    """1/(2 R) of both axes from the axes found, by K and E of the eccentricity; the half-space, not its inverse."""
    found = elliptic_contact((radius, radius * ratio), modulus=STEEL, force=force)
    a, b = max(found.along, found.across), min(found.along, found.across)
    m = 1 - (b / a) ** 2
    if m < 0.05:
        return  # K - E loses its digits
    k, e, p = special.ellipk(m), special.ellipe(m), found.pressure / STEEL
    assert p * b * (k - e) / (m * a**2) == pytest.approx(1 / (2 * radius * max(ratio, 1)), rel=1e-9)
    assert p * b * (e * a**2 / b**2 - k) / (m * a**2) == pytest.approx(1 / (2 * radius * min(ratio, 1)), rel=1e-9)
    assert found.approach == pytest.approx(p * b * k, rel=1e-9)
    assert found.force == pytest.approx(2 / 3 * math.pi * a * b * found.pressure, rel=1e-12)


@pytest.mark.parametrize("slightly", [0.0, 1e-15, -1e-12, 1e-9, 1e-6])
def test_the_circle_is_its_limit_without_loss_of_digits(slightly):
    found = elliptic_contact((1.0, 1.0 + slightly), modulus=STEEL, force=100.0)
    approach = hertz_approach(radius=1.0, modulus=STEEL, force=100.0)
    assert found.approach == pytest.approx(approach, rel=1e-14 + abs(slightly))
    radius = hertz_contact_radius(radius=1.0, approach=approach)
    assert found.along == pytest.approx(radius, rel=1e-14 + abs(slightly))
    assert found.stiffness == pytest.approx(2 * STEEL * radius, rel=1e-14 + abs(slightly))


@given(ratio=ratios, force=st.floats(1, 1e6))
def test_force_and_approach_are_inverse_and_axes_change_places(ratio, force):
    found = elliptic_contact((1.0, ratio), modulus=STEEL, force=force)
    back = elliptic_contact((1.0, ratio), modulus=STEEL, approach=found.approach)
    assert back.force == pytest.approx(force, rel=1e-12)
    turned = elliptic_contact((ratio, 1.0), modulus=STEEL, force=force)
    assert (turned.along, turned.across) == (found.across, found.along)


@pytest.mark.parametrize("given_", [{}, {"force": 1.0, "approach": 1.0}, {"force": -1.0}, {"approach": math.nan}])
def test_a_contact_needs_one_load(given_):
    with pytest.raises(ValueError, match=r"force|approach"):
        elliptic_contact((1.0, 1.0), modulus=1.0, **given_)


@given(kb=st.floats(1e-6, 60), alpha=st.floats(0.01, 5))
def test_remington_is_the_bed_of_springs_over_its_band(kb, alpha):
    """The mean of |2 J_1(S) / S|^2 over waves with |k_y| < alpha k_x, on a circle, by another quadrature."""
    of_band = integrate.quad(
        lambda t: float(spring_bed_filter(kb, t * kb, semi_axes=(1.0, 1.0))) ** 2, 0, alpha, limit=400, epsabs=1e-13
    )[0]
    assert float(remington_filter(kb, radius=1.0, alpha=alpha)) == pytest.approx(of_band / alpha, rel=1e-8, abs=1e-12)


def test_all_filters_let_long_waves_pass_and_the_half_space_follows_springs_over_ridges():
    axes = (5.7e-3, 4.3e-3)
    for waves in (half_space_filter, spring_bed_filter):
        assert waves(0.0, 0.0, semi_axes=axes) == 1.0
    k = np.linspace(0, 5e3, 101)
    np.testing.assert_allclose(half_space_filter(k, 0.0, semi_axes=axes), np.sinc(k * axes[0] / np.pi), rtol=1e-12)
    # along either axis the filter is of k a alone
    np.testing.assert_allclose(
        half_space_filter(0.0, k / axes[1], semi_axes=axes), half_space_filter(k / axes[0], 0.0, semi_axes=axes)
    )


def test_the_spring_bed_is_the_mean_height_over_the_patch():
    """Of a wave over the ellipse, by a sum over points inside."""
    a, b = 2.0, 0.7
    x, y = np.meshgrid(np.linspace(-a, a, 1601), np.linspace(-b, b, 1601))
    inside = (x / a) ** 2 + (y / b) ** 2 <= 1
    mean = np.cos(1.3 * x[inside] + 2.1 * y[inside]).mean()
    assert float(spring_bed_filter(1.3, 2.1, semi_axes=(a, b))) == pytest.approx(mean, abs=2e-4)
