"""Boundary elements on a strip with a measured shape across: a parabola is its radius, a worn one is not."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import bem3d
from tests.seeded import catches
from validation import compare, load_scene
from validation.railway.problems import rail_models
from validation.railway.problems.equivalent_displacement import (
    heights_across,
    lifted,
    linear_displacement,
    roll_boundary_elements,
)
from validation.railway.problems.rail_strip import strip_of
from validation.railway.scenes.rail import ProfiledRail
from validation.railway.scenes.transverse_profile import TransverseProfile, both_together
from validation.simulation.model_names import BEM, LINEAR

RAIL = load_scene("rail")
Y = np.linspace(-30e-3, 30e-3, 241)


def worn(y):
    """A crown of 300 mm that turns into one of 40 mm, 2 mm from the middle, without an edge [m]."""
    return -(y**2) / 0.6 - np.maximum(np.abs(y) - 2e-3, 0.0) ** 2 * (1 / 0.08 - 1 / 0.6)


def profiled(height):
    profile = TransverseProfile(y=tuple(Y.tolist()), height=tuple(height.tolist()), source="head.csv")
    names = ("name", "radius", "load", "modulus", "material", "roughness", "speed", "lateral_structure")
    return ProfiledRail(**{name: getattr(RAIL, name) for name in names}, profile=profile)


@pytest.mark.slow
def test_a_parabola_rolls_as_its_radius():
    scene = profiled(-(Y**2) / 0.6)
    strip = strip_of(scene, "isotropic", 5, 0, 3)
    found = lifted(roll_boundary_elements(strip, 3e-6, scene.profile, positions=6).approach)
    expected = lifted(roll_boundary_elements(strip_of(RAIL, "isotropic", 5, 0, 3), 3e-6, positions=6).approach)
    np.testing.assert_allclose(found, expected, atol=1e-4 * np.abs(expected).max())


def on_the_fitted_radius(strip, profile):
    """The parabola that stands in for the profile."""
    y = (np.arange(strip.shape[1]) - (strip.shape[1] - 1) / 2) * strip.spacing
    return slice(None), -(y**2) / (2 * strip.radii[1])


@catches("a fitted radius in place of the transverse profile").at(
    "validation.railway.problems.equivalent_displacement.heights_across", on_the_fitted_radius
)
@pytest.mark.slow
def test_a_worn_rail_rolls_as_its_profile_and_not_as_the_radius_of_its_contact():
    scene = profiled(worn(Y))
    strip = strip_of(scene, "isotropic", 5, 0, 3)
    found = lifted(roll_boundary_elements(strip, 3e-6, scene.profile, positions=6).approach)
    columns, z = heights_across(strip, scene.profile)
    places = (np.arange(strip.shape[1]) - (strip.shape[1] - 1) / 2)[columns] * strip.spacing
    np.testing.assert_allclose(z, worn(places), atol=2e-7)
    radius = lifted(roll_boundary_elements(strip, 3e-6, positions=6).approach)
    assert np.abs(found - radius).max() > 0.03 * np.abs(found).max()


def test_models_of_two_radii_are_told_and_boundary_elements_take_the_profile(monkeypatch):
    monkeypatch.setattr(rail_models, "STRIPS", 2)
    monkeypatch.setattr(rail_models, "COARSE", 3)
    monkeypatch.setattr(rail_models, "FINE", 4)
    taken = []

    def louder_than_linear(problem):
        taken.append(problem.profile)
        linear = linear_displacement(problem.strip, LINEAR)
        return {LINEAR: linear, BEM: 10 ** (1 / 20) * linear, "failed": np.array(0.0)}

    monkeypatch.setattr(rail_models, "roll_rail", louder_than_linear)
    scene = replace(profiled(worn(Y)), name="worn rail")
    found = compare(scene, quantity="contact-filter", tolerance="3 dB", models=[BEM, LINEAR])
    assert taken and set(taken) == {scene.profile}
    by_name = {one.name: one for one in found.models}
    assert found.model == BEM and by_name[BEM].estimate.in_range and not by_name[BEM].answer.failed
    assert not by_name[LINEAR].estimate.in_range and np.isinf(by_name[LINEAR].error)
    assert "head.csv has a radius of 176 mm" in by_name[LINEAR].estimate.reason
    over = found.value_of(by_name[BEM]) - found.value_of(by_name[LINEAR])
    rolled_over = (found.wavelength_mm < 60) & (found.wavelength_mm > 3)
    np.testing.assert_allclose(over, np.where(rolled_over, 1.0, 0.0), atol=1e-6)
    # shorter waves than those of a strip: nothing rolled over them
    assert np.isinf(found.errors_of(by_name[BEM])[found.wavelength_mm < 2.5]).all()


@pytest.mark.parametrize("cone", [0.0, 0.01])
def test_a_cone_and_a_flange_press_as_the_ellipse_of_the_crown(cone):
    """A smooth crown of 300 mm under a tread with a flange beside it: Hertz's approach and pressure."""
    rail = -(Y**2) / 0.6 - 40 * np.maximum(np.abs(Y) - 0.02, 0.0) ** 2
    tread = -cone * Y + 30 * np.maximum(-0.022 - Y, 0.0) ** 2
    bodies = [TransverseProfile(y=tuple(Y.tolist()), height=tuple(z.tolist())) for z in (rail, tread)]
    assert tread.argmax() == 0
    profile = both_together(bodies, 0.0)
    assert profile.at == pytest.approx(-0.3 * cone, abs=3e-6)
    names = ("name", "radius", "load", "modulus", "material", "roughness", "speed", "lateral_structure")
    scene = ProfiledRail(**{name: getattr(RAIL, name) for name in names}, profile=profile)
    strip = SimpleNamespace(spacing=0.3e-3, shape=(64, 64))
    columns, z = heights_across(strip, scene.profile)
    x = (np.arange(64) - 31.5) * strip.spacing
    halfspace = bem3d.HalfSpace(shape=(64, z.size), spacing=strip.spacing, modulus=scene.modulus)
    found = bem3d.solve(halfspace, np.subtract.outer(x**2 / (2 * scene.radius), z), force=scene.load)
    assert columns == slice(0, 64)
    # 20 cells to a semi-axis: half a per cent
    assert found.approach == pytest.approx(RAIL.contact.approach, rel=5e-3)
    assert found.pressure.max() == pytest.approx(RAIL.contact.pressure, rel=5e-3)
