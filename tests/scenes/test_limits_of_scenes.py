"""Each limit of a scene from both sides: what is noted just beyond it is not noted just before."""

import math
from dataclasses import replace

import pytest

from tests.scenes.test_scene_files import written
from tests.seeded import catches
from validation.scenes.bundled import path_of
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene
from validation.scenes.material import Elastic, Material
from validation.scenes.scene import ContactEllipse
from validation.scenes.wheel_body import DampedWheel, Wheel, damping_rate

PUNCH = IndentationScene(name="it", shape="punch", size=1.0, load=1.0, modulus=2e9)
SPHERE = IndentationScene(name="it", shape="sphere", size=1.0, load=1.0, modulus=2e9)
RAIL = path_of("rail").read_text(encoding="utf-8")
# a / R = (3 F / (4 E* R^2))^(1/3)
TENTH = 4 / 3 * 2e9 * 0.1**3
ROLLING, STEEL = load_scene("rolling_wheel"), {"youngs_modulus": 210e9, "counterface": "rigid"}


@pytest.mark.parametrize(
    ("scene", "beyond", "before", "words"),
    [
        (PUNCH, {"load": 0.101 * 2e9}, {"load": 0.099 * 2e9}, "mean pressure on the punch is 0.101 of E"),
        (PUNCH, {"modulus": 990.0, "load": 1e-3}, {"modulus": 1010.0, "load": 1e-3}, "softer than a gel"),
        (PUNCH, {"modulus": 2.0, "load": 1e-3}, {"modulus": 1.0, "load": 1e-3}, "softer than a gel"),
        (SPHERE, {"load": 1.01 * TENTH}, {"load": 0.99 * TENTH}, "of sphere.radius, more than a tenth"),
        (
            ROLLING,
            {"ground": replace(ROLLING.ground, rms=0.34 * ROLLING.approach)},
            {"ground": replace(ROLLING.ground, rms=0.33 * ROLLING.approach)},
            "the roughness is 0.34 of the approach",
        ),
    ],
)
def test_what_is_noted(scene, beyond, before, words):
    assert any(words in note for note in replace(scene, **beyond).diagnose())
    assert not any(words.rpartition(" ")[2] in note for note in replace(scene, **before).diagnose())


@pytest.mark.parametrize(
    ("old", "new", "value"),
    [
        ('radius = "460 mm"', 'diameter = "920 mm"', {"radius": 0.46}),
        ('load = "50 kN"', 'axle_load = "400 kN"\nwheels_per_axle = 8', {"load": 5e4}),
        ('load = "50 kN"', 'axle_load = "400 kN"\nwheels_per_axle = 9', "wheels_per_axle must be at most 8, got 9"),
        ('load = "50 kN"', 'axle_load = "50 kN"\nwheels_per_axle = 1', {"load": 5e4}),
        ('load = "50 kN"', 'axle_load = "400 kN"\nwheels_per_axle = 0', "wheels_per_axle must be at least 1, got 0"),
        ("poisson_ratio = 0.3", "poisson_ratio = 0.5", {}),
        ("poisson_ratio = 0.3", "poisson_ratio = 0.501", "poisson_ratio must lie in"),
        ("poisson_ratio = 0.3", "poisson_ratio = -0.001", "poisson_ratio must lie in"),
        ("# mass = ", 'mass = "1 t"\ndamping = 0.999  # ', {"damping": 0.999, "mass": 1e3}),
        ("# mass = ", 'mass = "1 t"\ndamping = 1.0  # ', "wheel.damping must be at least 0 and below 1"),
    ],
)
def test_what_a_rail_is_made_of(old, new, value, tmp_path):
    path = written(tmp_path, (old, new), text=RAIL)
    if isinstance(value, str):
        with pytest.raises(ValueError, match=value):
            load_scene(path)
        return
    found = load_scene(path)
    assert {key: getattr(found, key) for key in value} == pytest.approx(value, rel=1e-14)


@catches("E of one body for E / (1 - nu^2)").at(
    "validation.scenes.material.Elastic.against_rigid", property(lambda body: body.youngs_modulus)
)
def test_two_bodies_yield_each_by_itself():
    """1 / E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2, by hand."""
    other = Elastic(youngs_modulus=70e9, poisson_ratio=0.25)
    both = Material(**STEEL | {"counterface": other}, poisson_ratio=0.3)
    assert 1 / both.modulus == pytest.approx(0.91 / 210e9 + 0.9375 / 70e9, rel=1e-14)


def test_a_dashpot_is_twice_its_ratio_times_the_resonance():
    wheel = DampedWheel(radius=0.5, mass=500.0, modulus=2e11, load=4905.0, damping=0.02)
    assert damping_rate(wheel) == pytest.approx(0.04 * wheel.eigenfrequency, rel=1e-14)
    assert damping_rate(replace(wheel, damping=0.0)) == 0.0


@pytest.mark.parametrize("name", ["radius", "mass", "modulus", "load"])
@pytest.mark.parametrize("value", [math.inf, math.nan, 0.0, -1.0])
def test_a_wheel_has_finite_and_positive_parameters(name, value):
    with pytest.raises(ValueError, match=f"^{name} must be finite and positive, got {value}$"):
        Wheel(**{"radius": 0.5, "mass": 500.0, "modulus": 2e11, "load": 5e3, name: value})


def test_the_largest_pressure_of_an_ellipse_is_that_of_hertz():
    """p_0 of the sphere, (2 E* / pi) sqrt(d / R), with a = sqrt(R d) and F = 4/3 E* sqrt(R) d^(3/2)."""
    modulus, radius, approach = 2e11, 0.5, 1e-5
    a, load = math.sqrt(radius * approach), 4 / 3 * modulus * math.sqrt(radius) * approach**1.5
    ellipse = ContactEllipse(along=a, across=a, approach=approach, load=load)
    assert ellipse.largest_pressure == pytest.approx(2 * modulus / math.pi * math.sqrt(approach / radius))
