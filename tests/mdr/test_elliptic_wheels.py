"""Wheels with two radii on springs: the load curve of Hertz on an ellipse, the filter over ridges, equal radii."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import mdr
from mdr import elliptic_wheel
from mdr.elliptic_wheel import spring_wheel
from tests.seeded import catches
from validation.theory.half_space import elliptic_contact


@catches("the radius along the track for that of the contact").at(
    f"{__name__}.spring_wheel", lambda radius, modulus: (radius[0], modulus, 1.0)
)
@given(pair=st.tuples(st.floats(0.05, 5), st.floats(0.05, 5)), approach=st.floats(1e-7, 1e-4))
@example(pair=(0.46, 0.3), approach=6e-5)
def test_springs_have_the_load_curve_and_the_length_of_the_ellipse(pair, approach):
    radius, modulus, aspect = spring_wheel(pair, 2e11)
    smooth = elliptic_contact(pair, modulus=2e11, approach=approach)
    assert math.sqrt(radius * approach) == pytest.approx(smooth.along, rel=1e-9, abs=0)
    assert aspect == pytest.approx(smooth.across / smooth.along, rel=1e-9)
    assert 4 / 3 * modulus * math.sqrt(radius) * approach**1.5 == pytest.approx(smooth.force, rel=1e-9)
    assert 2 * modulus * smooth.along == pytest.approx(smooth.stiffness, rel=1e-9)


@catches("springs of an ellipse as stiff as those of a sphere").at(
    "mdr.rolling.spring_wheel",
    lambda radius, modulus: elliptic_wheel.spring_wheel(radius, 1.0)._replace(modulus=modulus),
)
def test_the_smooth_wheel_rolls_at_the_approach_of_the_ellipse():
    smooth = elliptic_contact((0.46, 0.3), modulus=1.154e11, force=5e4)
    rolled = mdr.roll(np.zeros(4096), spacing=smooth.along / 400, radius=(0.46, 0.3), modulus=1.154e11, force=5e4)
    assert rolled.approach[0] == pytest.approx(smooth.approach, rel=1e-5)
    assert rolled.stiffness[0] == pytest.approx(smooth.stiffness, rel=5e-3)


@pytest.mark.parametrize("wave", [1, 3, 7, 20])
def test_ridges_across_the_track_pass_with_the_filter_of_the_semi_axis_along(wave):
    smooth = elliptic_contact((0.46, 0.3), modulus=1.154e11, force=5e4)
    points, spacing = 4096, smooth.along / 400
    q = 2 * np.pi * wave / (points * spacing)
    track = 1e-4 * smooth.approach * np.cos(q * spacing * np.arange(points))
    settings = {"spacing": spacing, "radius": (0.46, 0.3), "modulus": 1.154e11, "force": 5e4}
    moved = mdr.roll(track, **settings).approach - mdr.roll(np.zeros(points), **settings).approach
    mode = -2 * np.fft.rfft(moved)[wave].real / points / (1e-4 * smooth.approach)
    assert mode == pytest.approx(np.sinc(q * smooth.along / np.pi), abs=5e-3)


@catches("an ensemble on the springs of a sphere").at(
    "mdr.rolling_ensemble.spring_wheel",
    lambda radius, modulus: elliptic_wheel.spring_wheel(radius, modulus)._replace(modulus=modulus),
)
def test_an_ensemble_rolls_as_its_wheels_one_by_one():
    """Under a force and at an approach, for two radii: to the rounding of the quantum."""
    tracks = 1e-7 * np.random.default_rng(2).standard_normal((512, 3))
    settings = {"spacing": 1e-4, "radius": (0.46, 0.3), "modulus": 2e11}
    ensemble = mdr.RollingEnsemble(tracks, force=900.0, **settings)
    for i, track in enumerate(tracks.T):
        alone = mdr.roll(track, force=900.0, **settings)
        assert ensemble.approach(7, 900.0)[i] == pytest.approx(alone.approach[7], rel=1e-10, abs=0)
        force = mdr.rolling_force(track, approach=4e-6, **settings)
        assert ensemble.force(7, np.full(3, 4e-6))[i] == pytest.approx(force[7], rel=1e-10)


def test_equal_radii_are_one_to_the_last_digit():
    tracks = 1e-7 * np.random.default_rng(2).standard_normal((512, 3))
    settings = {"spacing": 1e-4, "modulus": 2e11, "force": 900.0}
    one, pair = (mdr.RollingEnsemble(tracks, radius=r, **settings) for r in (0.5, (0.5, 0.5)))
    np.testing.assert_array_equal(one.approach(3, 900.0), pair.approach(3, 900.0))
    np.testing.assert_array_equal(one.force(3, np.full(3, 5e-6)), pair.force(3, np.full(3, 5e-6)))
    one, pair = (mdr.roll(tracks[:, 0], radius=r, **settings).approach for r in (0.5, (0.5, 0.5)))
    np.testing.assert_array_equal(one, pair)
