"""Wheels with two radii: Hertz on an ellipse, the waves under it, equal radii."""

import math

import numpy as np
import pytest

import bem3d
from bem3d.smooth_wheel import smooth_contact
from tests.seeded import catches
from validation.railway.theory.contact_filters import half_space_filter
from validation.theory.half_space import elliptic_contact

RADII = [(1.0, 0.2), (0.2, 1.0), (0.46, 0.3)]


def flat(radii, cells, across=None):
    """A flat strip, the long semi-axis a whole number of cells, at the approach of a^2 = 1e-4."""
    smooth = elliptic_contact(radii, modulus=1.0, approach=1e-4)
    spacing = max(smooth.along, smooth.across) / cells
    return smooth, spacing, np.zeros((3 * cells, across or 3 * cells))


@pytest.mark.parametrize("radii", RADII)
def test_the_smooth_contact_tends_to_hertz(radii):
    """Force at an approach: an error of second order in the cell, small on 24 cells to the long semi-axis."""
    errors = []
    for cells in (12, 24):
        smooth, spacing, strip = flat(radii, cells)
        rolled = bem3d.roll(strip, spacing=spacing, radius=radii, modulus=1.0, approach=1e-4, positions=1)
        errors.append(abs(rolled.force[0] / smooth.force - 1))
        assert rolled.area[0] == pytest.approx(math.pi * smooth.along * smooth.across, rel=1 / cells)
    assert errors[1] < 2e-3
    assert errors[1] < errors[0] / 2


def test_the_published_example_of_contact():
    """100 kN, G = 82 GPa, nu = 0.28 on both bodies, gap 0.001015 x^2 + 0.0004215 y^2 in mm: 0.08190 mm."""
    modulus = 2 * 82e9 * (1 + 0.28) / (2 * (1 - 0.28**2))
    radii = tuple(1e-3 / (2 * curvature) for curvature in (0.001015, 0.0004215))
    track = bem3d.Track(height=np.zeros((80, 128)), spacing=0.2e-3, radius=radii, modulus=modulus)
    wheel = bem3d.RollingContact(track)
    found = wheel.carry(0, 1e5)
    assert found.converged
    assert found.approach == pytest.approx(0.08190e-3, rel=1e-3)
    assert wheel.pressure()[2].max() == pytest.approx(770.6e6, rel=5e-3)


@catches("a circle of the mean radius for an ellipse").at(
    "bem3d.rolling_frame.smooth_contact", lambda radii: smooth_contact((math.sqrt(radii[0] * radii[1]),) * 2)
)
def test_the_expected_contact_is_the_ellipse_of_hertz():
    """From which a force begins, frames are made and diagnostics are: no solve tells it wrong."""
    hertz = elliptic_contact((0.46, 0.3), modulus=1.0, force=1e-3)
    smooth = bem3d.Track(height=np.zeros((4, 4)), spacing=1.0, radius=(0.46, 0.3), modulus=1.0).smooth
    assert smooth.approach(1e-3) == pytest.approx(hertz.approach, rel=1e-12)
    assert smooth.semi_axes(hertz.approach) == pytest.approx((hertz.along, hertz.across), rel=1e-12)


def test_a_track_that_is_turned_has_the_radii_changed_about():
    forces = []
    for radii, steps, shape in (((1.0, 0.2), (2e-4, 1e-4), (96, 80)), ((0.2, 1.0), (1e-4, 2e-4), (80, 96))):
        rolled = bem3d.roll(np.zeros(shape), spacing=steps, radius=radii, modulus=1.0, approach=1e-5, positions=1)
        forces.append(rolled.force[0])
    assert forces[0] == pytest.approx(forces[1], rel=1e-4)


@catches("the radii along and across exchanged", radii=(1.0, 0.2), waves=(1, 0)).at(
    "bem3d.Track.radii", property(lambda track: track.radius[::-1])
)
@pytest.mark.parametrize("radii", RADII[:2])
@pytest.mark.parametrize("waves", [(1, 0), (0, 1), (2, 1)])
def test_low_waves_under_an_ellipse_have_the_filter_of_the_half_space(radii, waves):
    """The first harmonic of the force over one period of the track, for waves along, across and aslant."""
    smooth, spacing, strip = flat(radii, 12)
    nx, ny = strip.shape
    along, across = (2 * np.pi * w / (n * spacing) for w, n in zip(waves, strip.shape, strict=True))
    x, y = np.arange(nx)[:, np.newaxis] * spacing, (np.arange(ny) - (ny - 1) / 2) * spacing
    height = 1e-3 * 1e-4 * np.cos(along * x) * np.cos(across * y)
    settings = {"spacing": spacing, "radius": radii, "modulus": 1.0, "approach": 1e-4, "tolerance": 1e-8}
    rough = bem3d.roll(height, **settings).force - bem3d.roll(strip, **settings).force
    mode = np.fft.rfft(rough)[waves[0]] / nx * (2 if waves[0] else 1)
    expected = smooth.stiffness * half_space_filter(along, across, semi_axes=(smooth.along, smooth.across))
    assert mode.real / 1e-7 == pytest.approx(float(expected), abs=0.03 * smooth.stiffness)


def test_equal_radii_are_a_sphere_to_the_last_digit():
    rng = np.random.default_rng(3)
    height = 1e-7 * rng.standard_normal((48, 48))
    settings = {"spacing": 1e-4, "modulus": 2e11, "force": 900.0, "positions": 6}
    sphere, pair = (bem3d.roll(height, radius=radius, **settings) for radius in (0.5, (0.5, 0.5)))
    np.testing.assert_array_equal(sphere.approach, pair.approach)
