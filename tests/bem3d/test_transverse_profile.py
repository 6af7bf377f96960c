"""A measured profile across the track: a parabola is its radius, a worn one is solved, bad ones are refused."""

import numpy as np
import pytest

import bem3d
from bem3d.smooth_wheel import equivalent_radius
from tests.seeded import catches

SETTINGS = {"spacing": 2.5e-4, "modulus": 1.154e11}
STRIP = 2e-7 * np.random.default_rng(5).standard_normal((64, 48))


def across(columns, step):
    return (np.arange(columns) - (columns - 1) / 2) * step


@pytest.mark.parametrize("columns", [47, 48])
@pytest.mark.parametrize("load", [{"approach": 2e-5}, {"force": 8e3}])
def test_a_parabola_is_its_radius(columns, load):
    """To the rounding of a solve that ends at 1e-5: the same steps of the same iteration."""
    y = across(columns, 2.5e-4)
    settings = {**SETTINGS, **load, "positions": 5}
    radius = bem3d.roll(STRIP[:, :columns], radius=(0.46, 0.3), **settings)
    profile = bem3d.roll(STRIP[:, :columns], radius=0.46, transverse_profile=-(y**2) / 0.6, **settings)
    np.testing.assert_allclose(profile.force, radius.force, rtol=1e-9)
    np.testing.assert_allclose(profile.approach, radius.approach, rtol=1e-9)
    np.testing.assert_array_equal(profile.area, radius.area)


def worn(y):
    """A crown of 300 mm that turns into one of 40 mm, 2 mm from the middle, without an edge."""
    beyond = np.maximum(np.abs(y) - 2e-3, 0.0)
    return -(y**2) / 0.6 - beyond**2 * (1 / 0.08 - 1 / 0.6)


@catches("a profile across for the parabola that it is about").at(
    "bem3d.rolling_frame.checked_profile",
    lambda z, columns, step: (
        -(((np.arange(columns) - (columns - 1) / 2) * step) ** 2) / (2 * equivalent_radius(z, step))
    ),
)
def test_a_worn_profile_against_a_fine_solve_of_the_plain_contact():
    """Force and pressure at an approach; the reference has four times as many cells a side and no rolling in it."""
    found = []
    for step in (4e-4, 2e-4):
        y = across(round(12.8e-3 / step) + 1, step)
        track = bem3d.Track(
            height=np.zeros((round(24e-3 / step), y.size)),
            spacing=step,
            radius=0.46,
            modulus=1.154e11,
            transverse_profile=worn(y),
        )
        found.append(bem3d.RollingContact(track).press(0, 5e-5).force)
    fine = 1e-4
    x, y = across(161, fine)[:, np.newaxis], across(129, fine)
    half_space = bem3d.HalfSpace(shape=(161, 129), spacing=fine, modulus=1.154e11)
    reference = bem3d.solve(half_space, x**2 / 0.92 - worn(y), approach=5e-5).force
    errors = [abs(force / reference - 1) for force in found]
    assert errors[1] < 2e-3
    assert errors[1] < errors[0] / 1.5
    # neither of the two radii alone has this contact
    alone = [bem3d.Track(height=np.zeros((99, 99)), radius=(0.46, r), **SETTINGS) for r in (0.3, 0.04)]
    below, above = sorted(bem3d.RollingContact(track).press(0, 5e-5).force for track in alone)
    assert below * 1.03 < reference < above / 1.03


def test_a_profile_whose_top_is_beside_the_middle_moves_the_contact():
    y = across(61, 2.5e-4)
    tracks = [
        bem3d.Track(height=np.zeros((64, 61)), radius=0.46, transverse_profile=-((y - at) ** 2) / 0.6, **SETTINGS)
        for at in (0.0, 10 * 2.5e-4)
    ]
    wheels = [bem3d.RollingContact(track) for track in tracks]
    middle, beside = (wheel.carry(0, 5e3) for wheel in wheels)
    assert beside.approach == pytest.approx(middle.approach, rel=1e-5)
    _, places, pressure = wheels[1].pressure()
    assert places[pressure.sum(axis=0).argmax()] == pytest.approx(10 * 2.5e-4)
