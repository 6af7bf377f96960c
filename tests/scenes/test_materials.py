"""Whose modulus it is: E* of two bodies, no default for the other one, and what a scene tells of it."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from tests.seeded import catches, catches_root_of_two
from validation.__main__ import main
from validation.scenes import roughness
from validation.scenes.bundled import SCENES
from validation.scenes.description import describe
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene, load_scene_with_track
from validation.scenes.material import Elastic, Material
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.units import in_unit

SPHERE, WHEEL, PUNCH = (
    (SCENES / f"{name}.toml").read_text(encoding="utf-8") for name in ("sphere", "table_14_1", "rough_punch")
)
LINE = re.compile(r"counterface = .*\n")
ALUMINIUM = '[material.counterface]\nyoungs_modulus = "70 GPa"\npoisson_ratio = 0.33\n'


def steel(**changes):
    return Material(**{"youngs_modulus": 210e9, "poisson_ratio": 0.3, "counterface": "rigid", **changes})


def written(folder, text, line=""):
    """A scene whose material ends in another line."""
    assert len(LINE.findall(text)) == 1
    path = folder / "scene.toml"
    path.write_text(LINE.sub(line, text), encoding="utf-8")
    return path


# E*


@catches("the other body taken for a rigid one").at(
    "validation.scenes.material.Material.modulus", property(lambda both: both._body.against_rigid)
)
def test_two_bodies_share_the_compliance():
    for first, other in ((210e9, 70e9), (1e6, 3e9)):
        body = steel(youngs_modulus=first, counterface=Elastic(youngs_modulus=other, poisson_ratio=0.33))
        assert 1 / body.modulus == pytest.approx((1 - 0.3**2) / first + (1 - 0.33**2) / other, rel=1e-14)


def test_the_words_are_the_ends_of_the_sum():
    rigid, same = steel(), steel(counterface="same")
    for ratio in (0, 0.3, 0.5):
        assert steel(poisson_ratio=ratio).modulus == pytest.approx(210e9 / (1 - ratio**2), rel=1e-15)
    assert same.modulus == rigid.modulus / 2
    assert steel(counterface=Elastic(youngs_modulus=210e9, poisson_ratio=0.3)).modulus == pytest.approx(same.modulus)
    assert steel(counterface=Elastic(youngs_modulus=1e30, poisson_ratio=0.3)).modulus == pytest.approx(rigid.modulus)


EXAMPLES = {"sphere": (1, 4905), "rolling_wheel": (1, 4905), "table_14_1": (1, 4905), "rail": (2, 50e3)}


@pytest.mark.parametrize("name", [*EXAMPLES, "rough_punch"])
def test_example_scenes_have_the_modulus_and_the_load_of_what_they_show(name):
    """210 GPa: of the book's wheel nu = 1/3 on a rigid body; of the punch F = 0.1 E* h L; of the rail two bodies."""
    scene, ratio = load_scene(name), 0.3 if name in ("rail", "rough_punch") else 1 / 3
    bodies, load = EXAMPLES.get(name, (1, 0.1 * scene.modulus * 1e-6 * 1e-3))
    assert scene.modulus == pytest.approx(210e9 / (1 - ratio**2) / bodies, rel=1e-12)
    assert scene.load == pytest.approx(load, rel=1e-6)


NONE = {"youngs_modulus": None, "poisson_ratio": None, "counterface": None}
SOFT = Elastic(youngs_modulus=-1.0, poisson_ratio=0.3)
SWELLING = Elastic(youngs_modulus=1e9, poisson_ratio=0.7)


@pytest.mark.parametrize(
    ("changes", "error", "sentence"),
    [
        (NONE, ValueError, "material must have contact_modulus, or else youngs_modulus, "),
        ({"youngs_modulus": math.inf}, ValueError, "material.youngs_modulus must be finite, got inf"),
        ({"youngs_modulus": "1"}, TypeError, "material.youngs_modulus must be a real number, got '1'"),
        ({"youngs_modulus": None}, ValueError, "material.youngs_modulus is missing, material must have it"),
        ({"poisson_ratio": -0.1}, ValueError, "material.poisson_ratio must lie in [0, 0.5], got -0.1"),
        ({"counterface": None}, ValueError, "material.counterface is missing: E* depends on the other body, too"),
        ({"counterface": "Steel"}, ValueError, 'material.counterface must be "rigid", "same", or a table with '),
        ({"counterface": SOFT}, ValueError, "material.counterface.youngs_modulus must be positive, got -1.0"),
        ({"counterface": SWELLING}, ValueError, "material.counterface.poisson_ratio must lie in [0, 0.5], got 0.7"),
        ({"contact_modulus": 1e9}, ValueError, "material.contact_modulus must stand alone, got youngs_modulus, poiss"),
        ({"youngs_modulus": 1.7e308, "poisson_ratio": 0.5}, ValueError, "material: E* of both bodies must be finite"),
    ],
)
def test_materials_are_refused_by_the_key(changes, error, sentence):
    with pytest.raises(error, match=f"^{re.escape(sentence)}"):
        steel(**changes)


def test_a_modulus_is_that_of_its_material():
    settings = {"name": "it", "load": 1.0, "material": steel()}
    with pytest.raises(ValueError, match=r"^modulus must be that of the material, 2.30769e\+11 Pa, got 2e\+11 Pa$"):
        IndentationScene(shape="punch", size=1.0, modulus=2e11, **settings)
    with pytest.raises(ValueError, match="must be that of the material"):
        RollingScene(radius=1.0, modulus=2e11, ground=Roughness(rms=1, hurst=0.7, longest=2, shortest=1), **settings)


# Scene files


@pytest.mark.parametrize("text", [SPHERE, PUNCH, WHEEL])
def test_a_scene_that_does_not_say_is_shown_both_lines(tmp_path, capsys, text):
    path = written(tmp_path, text)
    assert main(["compare", str(path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"error: scene {path}: material.counterface is missing")
    lines = [line.strip() for line in said.splitlines() if line.startswith("    counterface = ")]
    assert [line.partition("#")[0].strip() for line in lines] == ['counterface = "rigid"', 'counterface = "same"']
    rigid, same = (load_scene(written(tmp_path, text, f"{line}\n")) for line in lines)
    assert rigid.modulus == 2 * same.modulus
    for scene, line in zip((rigid, same), lines, strict=True):
        assert line.endswith(f" = {in_unit(scene.modulus, 'pressure', digits=6)}")


@pytest.mark.parametrize("text", [SPHERE, PUNCH, WHEEL])
def test_another_body_is_a_table_of_its_own_and_a_contact_modulus_may_be_given_instead(tmp_path, text):
    path = written(tmp_path, text, ALUMINIUM)
    scene = load_scene(path)
    assert scene.material.counterface == Elastic(youngs_modulus=70e9, poisson_ratio=0.33)
    assert scene.modulus == scene.material.modulus < 70e9 / (1 - 0.33**2)
    path.write_text(
        re.sub(r"\[material\]\n(.+\n)+", '[material]\ncontact_modulus = "115 GPa"\n', text), encoding="utf-8"
    )
    assert load_scene(path).modulus == 115e9


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        (ALUMINIUM.replace("poisson_ratio = 0.33\n", ""), "material.counterface.poisson_ratio is missing"),
        (ALUMINIUM.replace("70 GPa", "70 N"), "material.counterface.youngs_modulus must be a pressure"),
    ],
)
@pytest.mark.parametrize(("text", "load"), [(SPHERE, load_scene), (WHEEL, load_scene), (WHEEL, load_scene_with_track)])
def test_what_contradicts_itself_is_refused_by_name(tmp_path, text, load, line, sentence):
    path = written(tmp_path, text, line)
    with pytest.raises(ValueError, match=f"^scene {re.escape(str(path))}: {re.escape(sentence)}"):
        load(path)


# What was understood


slope_in_one_direction = roughness.Roughness.slope_along.fget


@catches_root_of_two("the gradient of a drawn surface", "validation.scenes.roughness.rms_gradient")
@catches("the slope of the gradient for that along the track").at(
    "validation.scenes.roughness.Roughness.slope_along",
    property(lambda rough: math.sqrt(2) * slope_in_one_direction(rough)),
)
def test_slopes_are_those_of_the_spectrum():
    for hurst in (0.3, 0.7, 1.0, 1.2):
        rough = Roughness(rms=2e-6, hurst=hurst, longest=1e-3, shortest=1e-4)
        q = np.geomspace(rough.q_min, rough.q_max, 20001)
        assert rough.slope_along == pytest.approx(math.sqrt(np.pi * np.trapezoid(q**3 * rough.c2d(q), q)), rel=1e-5)


@catches_root_of_two("h' of measured heights", "validation.scenes.measured_heights.MeasuredHeights.slope_along")
@catches_root_of_two("the gradient of measured heights", "validation.scenes.measured_heights.MeasuredHeights.gradient")
def test_slopes_are_those_of_heights():
    rough, n = Roughness(rms=1e-6, hurst=0.7, longest=2.5e-4, shortest=3.2e-5), 512
    height = bem3d.rough_surface(rough.c2d, shape=(n, n), spacing=1e-3 / n, rng=np.random.default_rng(1), rms=1e-6)
    found = MeasuredHeights(height=height, spacing=(1e-3 / n, 1e-3 / n))
    # differences of 16 points to the shortest wave are 2 % low, one surface has a few hundred waves
    assert found.slope_along == pytest.approx(rough.slope_along, rel=0.1)
    assert math.hypot(found.slope_along, MeasuredHeights(height=height.T, spacing=found.spacing).slope_along) == (
        pytest.approx(found.gradient, rel=1e-12)
    )


def test_rail_and_wheel_are_understood_together():
    """Heights and slopes of both add by squares; each has its own waves."""
    wheel = Roughness(rms=2e-6, hurst=0.5, longest=5e-3, shortest=1e-3)
    scene = replace(load_scene_with_track("table_14_1"), wheel=wheel)
    pairs = dict(describe(scene))
    both = math.hypot(2e-6, 0.5e-6)
    assert pairs["rms height h"] == f"{in_unit(both, 'length')}, h/d = {both / scene.approach:.3g}"
    slope = math.hypot(scene.rail.slope_along, wheel.slope_along)
    assert pairs["rms slope h'"].startswith(f"{slope:.3g}, in one direction")
    assert pairs["waves of the wheel"].startswith("5 mm to 1 mm, Hurst exponent 0.5, ")
    assert pairs["waves of the rail"].startswith("10 mm to 200 µm, Hurst exponent 0.7, ")
