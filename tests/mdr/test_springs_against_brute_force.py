"""The foundation against a sum over its springs, and the sphere against Hertz."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from matplotlib import pyplot
from matplotlib.figure import Figure

import mdr
from mdr import foundation
from tests.oracles import spring_sum
from tests.seeded import E_FOR_E_STAR, catches
from tests.strategies import profiles, scales
from validation.theory import closed_forms

load_curve = foundation.load_curve


@catches("E for E* in springs").at(
    "mdr.load_curve",
    lambda height, *, length, modulus: load_curve(height, length=length, modulus=E_FOR_E_STAR * modulus),
)
@given(height=profiles, approach=st.floats(-2, 3))
@example(height=np.zeros(4), approach=0.0)
@example(height=np.array([1.0, 1.0, 0.0]), approach=-1.0)
@example(height=np.array([0.5]), approach=1.0)
def test_force_and_stiffness_at_an_approach(height, approach):
    point = mdr.load_curve(height, length=2.0, modulus=3.0).at_approach(approach)
    force, stiffness = spring_sum(height, 2.0, 3.0, approach)
    assert point.force == pytest.approx(force, rel=1e-13, abs=1e-15)
    assert point.stiffness == pytest.approx(stiffness, rel=1e-13)


@given(height=profiles, fraction=st.floats(1e-6, 3))
def test_force_to_approach_and_back(height, fraction):
    curve = mdr.load_curve(height, length=2.0, modulus=3.0)
    force = fraction * max(curve.force[-1], 1.0)
    there = curve.at_force(force)
    back = curve.at_approach(there.approach)
    assert there.force == force
    assert back.force == pytest.approx(force, rel=1e-12, abs=1e-14)


@given(height=profiles, fraction=st.floats(0, 2))
def test_arrays_are_answered_like_numbers(height, fraction):
    curve = mdr.load_curve(height, length=2.0, modulus=3.0)
    forces = fraction * np.array([0.0, 0.5, 1.0])
    together = curve.at_force(forces)
    for i, force in enumerate(forces):
        alone = curve.at_force(float(force))
        assert (together.approach[i], together.force[i], together.stiffness[i]) == (
            alone.approach,
            alone.force,
            alone.stiffness,
        )


@given(height=profiles, fraction=st.floats(1e-6, 3))
@example(height=np.zeros(4), fraction=1.0)
@example(height=np.array([0.5]), fraction=1.0)
def test_many_profiles_are_as_stiff_as_each(height, fraction):
    rows = np.array([height, height[::-1], 2 * height])
    force = fraction * max(mdr.load_curve(height, length=2.0, modulus=3.0).force[-1], 1.0)
    together = mdr.stiffness_under(force, rows, length=2.0, modulus=3.0)
    for stiffness, row in zip(together, rows, strict=True):
        # springs that are just met may or may not carry: the force that is missing is none
        curve = mdr.load_curve(row, length=2.0, modulus=3.0)
        below, above = (curve.at_force(force * (1 + side * 1e-12)).stiffness for side in (-1, 1))
        assert below * (1 - 1e-12) <= stiffness <= above * (1 + 1e-12)


@given(height=profiles, scale=scales, modulus=scales, d=st.floats(-1, 2))
def test_scaling(height, scale, modulus, d):
    """F ~ E* L^2, k ~ E* L when all lengths, heights included, are scaled."""
    one = mdr.load_curve(height, length=2.0, modulus=1.0).at_approach(d)
    other = mdr.load_curve(scale * height, length=2.0 * scale, modulus=modulus).at_approach(scale * d)
    assert other.force == pytest.approx(modulus * scale**2 * one.force, rel=1e-12, abs=1e-14 * modulus * scale**2)


def test_zero_force_is_no_contact():
    nothing = mdr.load_curve(np.array([0.2, -0.1]), length=1.0, modulus=1.0).at_force(0.0)
    assert (nothing.approach, nothing.force, nothing.stiffness) == (-0.2, 0.0, 0.0)


@given(radius=scales, modulus=scales, approach=scales)
def test_sphere_is_hertz(radius, modulus, approach):
    sphere = mdr.press_sphere(radius=radius, modulus=modulus, approach=approach)
    hertz = closed_forms.hertz_force(radius=radius, modulus=modulus, approach=approach)
    a = closed_forms.hertz_contact_radius(radius=radius, approach=approach)
    assert sphere.force == pytest.approx(hertz, rel=1e-14)
    assert sphere.contact_radius == pytest.approx(a, rel=1e-14)
    assert sphere.stiffness == pytest.approx(
        closed_forms.circular_punch_stiffness(radius=a, modulus=modulus), rel=1e-14
    )
    assert mdr.press_sphere(radius=radius, modulus=modulus, force=hertz).approach == pytest.approx(approach, rel=1e-13)


def test_profile_of_the_sphere():
    """x^2 / R: at x = a = sqrt(R d) it has risen by d, by which it differs from the sphere itself."""
    np.testing.assert_array_equal(mdr.sphere_profile([-6.0, 0.0, 3.0], radius=4.0), [9.0, 0.0, 2.25])


@catches("x^2 / 2R in one dimension", offset=0.1).at(
    "mdr.sphere_profile", lambda x, *, radius: np.asarray(x) ** 2 / (2 * radius)
)
@pytest.mark.parametrize("offset", [0.0, 0.1, 0.37, 0.5])
def test_springs_under_a_parabola_tend_to_the_sphere_at_second_order(offset):
    """Midpoint rule: (dx/a)^2 / 8 inside, at most 3/8 from both ends, wherever the springs lie."""
    for cells in (16, 64, 256):
        x = (np.arange(-2 * cells, 2 * cells) + offset) / cells
        curve = mdr.load_curve(-mdr.sphere_profile(x, radius=1.0), length=4.0, modulus=1.0)
        assert curve.at_approach(1.0).force == pytest.approx(4 / 3, rel=0.5 / cells**2)


def test_a_load_curve_is_drawn_on_axes_of_a_user(monkeypatch):
    curve, axis = mdr.load_curve([-1e-6, -2e-6, -3e-6], length=3e-3, modulus=1e9), Figure().add_subplot()
    assert curve.plot(axis) is axis and curve.plot(axis) is axis
    for line in axis.lines:
        assert np.array_equal(line.get_xdata(), curve.approach) and np.array_equal(line.get_ydata(), curve.force)
    with pytest.raises(TypeError, match="ax must be an Axes of matplotlib, or None for a new figure, got str"):
        curve.plot("here")
    monkeypatch.setattr(pyplot, "subplots", lambda **_: (None, Figure().add_subplot()))
    assert len(curve.plot().lines) == 1
