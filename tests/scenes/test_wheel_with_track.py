"""A wheel with a track to roll along in time: what its scene must have, what others have not, its earlier names."""

import math
import re
from dataclasses import asdict, replace

import numpy as np
import pytest

import validation
from tests.scenes.test_scene_files import TABLE, written
from tests.seeded import catches
from validation.advice.compare import content_of
from validation.engine.engine import identity
from validation.scenes.description import describe
from validation.scenes.load import bundled_with_track, load_scene, load_scene_with_track
from validation.scenes.material import Material
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import MOST_WAVES, RollingScene
from validation.scenes.roughness import Roughness

ROUGH = Roughness(rms=0.5e-6, hurst=0.7, longest=10e-3, shortest=1e-3)
STEEL = Material(contact_modulus=236.25e9)
STILL = {"name": "it", "radius": 0.5, "load": 4905.0, "material": STEEL, "ground": ROUGH}
MOVING = {**STILL, "mass": 500.0, "speed": 20.0}
ON_TRACK = {**MOVING, "distance": 0.65, "springs": 100}
HEIGHTS = MeasuredHeights(height=1e-7 * np.eye(400), spacing=(1e-4, 1e-4))


def test_roughness_of_rail_and_wheel_is_described_by_the_root_of_both_squares():
    """3 and 4 are 5; d = a^2 / R is 7.857 um under Table 14.1, and h' a / d = h' R / a."""
    rail, wheel = (replace(ROUGH, rms=rms) for rms in (0.3e-6, 0.4e-6))
    pairs = dict(describe(RollingScene(**{**ON_TRACK, "ground": rail, "wheel": wheel})))
    assert pairs["rms height h"] == "500 nm, h/d = 0.0636"
    slope, ratio = re.fullmatch(r"(\S+), in one .*, h' a/d = (\S+)", pairs["rms slope h'"]).groups()
    assert float(slope) == pytest.approx(ROUGH.slope_along, rel=5e-3)
    assert float(ratio) == pytest.approx(ROUGH.slope_along * math.sqrt(0.5 / 7.857e-6), rel=5e-3)


def test_a_wheel_has_a_motion_a_track_or_neither():
    still, moving, on_track = (RollingScene(**settings) for settings in (STILL, MOVING, ON_TRACK))
    assert [scene.has_motion for scene in (still, moving, on_track)] == [False, True, True]
    assert [scene.has_track for scene in (still, moving, on_track)] == [False, False, True]
    assert on_track.for_compare() == moving and moving.for_compare() is moving


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"distance": None}, "simulation.distance and simulation.springs must both be given or neither, got None, 100"),
        ({"springs": None}, "simulation.distance and simulation.springs must both be given or neither, got 0.65, None"),
        ({"mass": None, "speed": None}, "simulation needs a wheel that moves: wheel.mass and wheel.speed, got neither"),
        ({"mass": None}, "wheel.mass and wheel.speed must both be given or neither, got None, 20.0"),
        ({"distance": None, "springs": None, "wheel": ROUGH}, "wheel.roughness needs a track to be rolled along: "),
        (
            {"ground": HEIGHTS},
            "simulation must be left out beside rail.heights, as by scene.for_compare(): tracks are drawn",
        ),
        ({"material": None}, "modulus must be given, or a material which has it, got neither"),
        ({"modulus": 2e11}, "modulus must be that of the material, 2.3625e+11 Pa, got 2e+11 Pa"),
    ],
)
def test_what_does_not_belong_together_is_refused(changes, said):
    with pytest.raises(ValueError, match=f"^{re.escape(said)}"):
        RollingScene(**{**ON_TRACK, **changes})


@pytest.mark.parametrize("settings", [STILL, MOVING])
def test_a_smooth_rail_needs_a_track(settings):
    with pytest.raises(TypeError, match=r"^rail.roughness must be given where there is no track, or rail.heights, got"):
        RollingScene(**{**settings, "ground": None})
    assert RollingScene(**{**ON_TRACK, "ground": None}).rough_surfaces == {}


@pytest.mark.parametrize("number", ["spacing", "points", "length", "time_step", "circumference_points", "track"])
def test_numbers_of_a_track_are_of_a_scene_that_has_one(number):
    assert getattr(RollingScene(**ON_TRACK), number)
    with pytest.raises(ValueError, match=r"^scene 'it' must have a track for this, simulation.distance and simulation"):
        getattr(RollingScene(**MOVING), number)


@pytest.mark.parametrize("number", ["rolling_speed", "eigenfrequency", "jump", "period_length", "oscillation_period"])
def test_numbers_of_a_motion_are_of_a_scene_that_has_one(number):
    assert getattr(RollingScene(**MOVING), number) == getattr(RollingScene(**ON_TRACK), number)
    with pytest.raises(ValueError, match=r"^scene 'it' must have a motion for this, wheel.mass and wheel.speed, got"):
        getattr(RollingScene(**STILL), number)


def test_a_modulus_is_that_of_the_material():
    scene = RollingScene(**ON_TRACK)
    soft = Material(contact_modulus=1e9)
    assert scene.modulus == STEEL.modulus and scene == RollingScene(**ON_TRACK, modulus=STEEL.modulus)
    with pytest.raises(ValueError, match="must be that of the material"):
        replace(scene, material=soft)
    assert replace(scene, material=soft, modulus=soft.modulus).modulus == 1e9


# Scene files


def test_a_track_is_read_where_a_file_has_one(tmp_path):
    assert bundled_with_track() == ("rough_wheel", "table_14_1")
    for name in bundled_with_track():
        scene = load_scene(name)
        assert scene == load_scene_with_track(name) and scene.has_track and scene.has_motion
    assert not load_scene(written(tmp_path, text=TABLE.partition("[simulation]")[0])).has_track
    assert not load_scene("rolling_wheel").has_motion
    assert load_scene("table_14_1", heights=HEIGHTS).ground is HEIGHTS


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([('mass = "500 kg"', "")], "simulation is unknown, a scene must be made of name, wheel, material, rail"),
        ([("springs = 100", "")], "simulation.springs is missing, simulation must have it, as: springs = 100"),
        ([("[simulation]", "[wheel.simulation]")], "wheel.simulation is unknown, wheel must be made of"),
    ],
)
def test_keys_of_a_track_are_refused_where_they_do_not_belong(tmp_path, changes, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        load_scene(written(tmp_path, *changes))


# compare


@catches("a rough wheel that is compared as a smooth one").at(
    "validation.scenes.wheel_body.OnTrack.rail_alone_is_rough", property(lambda scene: True)
)
def test_a_rough_wheel_is_loaded_and_not_compared():
    for scene in (load_scene("rough_wheel"), RollingScene(**{**ON_TRACK, "wheel": ROUGH})):
        sentence = f"scene '{scene.name}' must have a rough rail and a smooth wheel to be compared"
        compared = refusal_of(lambda scene=scene: validation.compare(scene))
        assert compared == sentence


def refusal_of(ask):
    """The sentence of a ValueError; empty where there is none."""
    try:
        ask()
    except ValueError as error:
        return str(error)
    return ""


def test_waves_are_counted_where_there_is_no_track():
    fine = replace(ROUGH, shortest=RollingScene(**STILL).contact_radius / MOST_WAVES / 1.5)
    scene = RollingScene(**{**ON_TRACK, "ground": fine, "springs": 4 * MOST_WAVES})
    for ask in (scene.for_compare, lambda: validation.compare(scene)):
        assert refusal_of(ask).startswith("rail.roughness.shortest must be at least 1.98 µm, 1000 waves to the contact")


@catches("a track in the digest of a scene that has none").at("validation.advice.compare.values_of", asdict)
def test_keys_of_what_is_stored_are_those_of_a_scene_without_a_track():
    """As before there were tracks: neither digest nor key names what a scene has not."""
    moving = RollingScene(**MOVING)
    key = identity(moving)
    assert not {"wheel=", "distance", "springs"} & set(re.findall(r"wheel=|distance|springs", key))
    assert key.startswith("RollingScene(name='it', radius=0.5, load=4905.0, modulus=236250000000.0, ground=R")
    assert key.endswith("mass=500.0, speed=20.0, material=" + identity(STEEL) + ", damping=0.0)")
    assert identity(RollingScene(**ON_TRACK)) == f"{key[:-1]}, distance=0.65, springs=100)"
    assert content_of(moving) == "2b193498bd7b3da5"
    assert content_of(RollingScene(**ON_TRACK)) != content_of(moving)


def test_a_track_changes_no_answer():
    asked = {"quantity": "acceleration", "models": ["linear filter, 1D"], "tolerance": 0.3}
    found = [validation.compare(RollingScene(**settings), **asked) for settings in (MOVING, ON_TRACK)]
    assert validation.to_json(found[0]) == validation.to_json(found[1])
    assert not found[1].scene.has_track


# Earlier names


def test_earlier_names_work_for_one_release_and_say_so():
    scene = load_scene("table_14_1")
    of_rail = {name: getattr(scene, name) for name in ("name", "radius", "mass", "load", "speed", "material", "rail")}
    of_track = {name: getattr(scene, name) for name in ("wheel", "distance", "springs")}
    with pytest.warns(FutureWarning, match=r"^WheelScene is RollingScene now, its rail the ground; ") as warned:
        assert validation.WheelScene(**of_rail, **of_track) == scene
    # at the line of the user
    assert [one.filename for one in warned] == [__file__]
    with pytest.warns(FutureWarning, match=r"^load_wheel_scene is load_scene now; ") as warned:
        assert validation.load_wheel_scene("rough_wheel") == load_scene("rough_wheel")
    assert [one.filename for one in warned] == [__file__]
    with pytest.warns(FutureWarning, match=r"^RollingScene.of_wheel\(scene\) is scene.for_compare\(\) now; ") as warned:
        assert RollingScene.of_wheel(scene) == scene.for_compare()
    assert [one.filename for one in warned] == [__file__]


@pytest.mark.parametrize("name", ["rolling_wheel", "sphere", "rail"])
def test_an_earlier_name_refuses_what_it_refused(name):
    with pytest.warns(FutureWarning), pytest.raises(ValueError, match=r"is missing|is unknown|of a dynamic wheel"):
        validation.load_wheel_scene(name)
