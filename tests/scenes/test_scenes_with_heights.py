"""Scenes that `compare` takes, with measured heights and without: what is read, what is refused by name."""

import math
import re
from contextlib import nullcontext
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from tests.scenes.test_height_forms import PUNCH
from tests.scenes.test_measured_heights import N, drawn, heights, refusal
from tests.scenes.test_scene_files import IN_FILE, TABLE, written
from tests.seeded import Times, catches
from validation.__main__ import main
from validation.advice.compare import SceneProblem, compare, content_of
from validation.scenes.bundled import SCENES
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene, load_scene_with_track, load_varied
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingScene

SMOOTH, LOAD = PUNCH.partition("[roughness]")[0], 'load = "23.076923 N"'
ROLLING = (SCENES / "rolling_wheel.toml").read_text(encoding="utf-8")
FACE = (
    'name = "ball"\n[sphere]\nradius = "1 mm"\nload = "1 mN"\n[material]\ncontact_modulus = "1 GPa"\n'
    '[heights]\nfile = "face.npy"\nspacing = ["1 um", "2 um"]\n'
)


@pytest.mark.parametrize(
    ("text", "old", "new", "words"),
    [
        (PUNCH, "[punch]", "[block]", ["a scene must have one of sphere, punch, wheel, got none"]),
        (PUNCH, "[material]", '[sphere]\nradius = "1 m"\n[material]', ["a scene must have one of", "sphere and punch"]),
        (PUNCH, "side =", "radius =", ["punch.radius is unknown", "side, load"]),
        (PUNCH, 'longest = "1 mm"', 'longest = "2 mm"', ["roughness.longest must", "0.001 m", "0.002 m"]),
        (ROLLING, 'load = "4905 N"', 'load = "4905 N"\nspeed = "20 m/s"', ["wheel.speed is unknown", "radius, load"]),
    ],
)
def test_scenes_are_refused_by_key_and_value(tmp_path, text, old, new, words):
    with pytest.raises(ValueError, match=f"^{IN_FILE}{'.*'.join(map(re.escape, words))}"):
        load_scene(written(tmp_path, (old, new), text=text))


def test_a_mean_pressure_of_a_punch_is_its_load_over_the_side_squared(tmp_path):
    of_load, of_pressure = (
        load_scene(written(tmp_path, (LOAD, line), text=SMOOTH)) for line in ('load = "7 uN"', 'pressure = "7 N/m2"')
    )
    assert (of_load.size, of_load.load, of_load.pressure) == (1e-3, 7e-6, pytest.approx(7.0, rel=1e-15))
    assert (of_pressure.size, of_pressure.load) == (1e-3, pytest.approx(7e-6, rel=1e-15))
    varied = load_varied(tmp_path / "scene.toml", "punch.pressure", "2 MPa")
    assert varied.load == pytest.approx(2.0, rel=1e-15)
    for lines, got in ((f'{LOAD}\npressure = "1 Pa"', "load and pressure"), ("", "none")):
        with pytest.raises(ValueError, match=rf"^{IN_FILE}punch must have one of load, pressure, got {got}$"):
            load_scene(written(tmp_path, (LOAD, lines), text=SMOOTH))


@pytest.mark.parametrize(
    ("text", "key", "value", "old", "new"),
    [
        (ROLLING, "wheel.load", "60 kN", 'load = "4905 N"', 'load = "60 kN"'),
        (ROLLING, "rail.roughness.hurst", "5e-1", "hurst = 0.7", "hurst = 0.5"),
        (ROLLING, "rail.roughness.hurst", "1", "hurst = 0.7", "hurst = 1.0"),
        (TABLE, "simulation.springs", "37", "springs = 100", "springs = 37"),
        (FACE, "heights.spacing", "2 um", 'spacing = ["1 um", "2 um"]', 'spacing = "2 um"'),
        (FACE, "heights.file", "other.npy", "face.npy", "other.npy"),
    ],
)
def test_a_varied_scene_is_that_of_its_file_with_the_other_value(tmp_path, text, key, value, old, new):
    for name in ("face.npy", "other.npy"):
        np.save(tmp_path / name, drawn(len(name)))
    varied = load_varied(written(tmp_path, text=text), key, value)
    other = load_scene(written(tmp_path, (old, new), text=text))
    assert content_of(varied) == content_of(replace(other, name=f"{other.name}, {key.split('.')[-1]} = {value}"))


@pytest.mark.parametrize("key", ["name.first", "wheel.load.unit", "rail.roughness.rms.unit", "wheels.load", "a.b.c"])
def test_a_key_below_a_value_is_none_of_a_scene(tmp_path, key):
    with pytest.raises(ValueError, match=rf"^{IN_FILE}{key} must be a key in a table of the scene"):
        load_varied(written(tmp_path, text=ROLLING), key, "1 N")


def test_a_smooth_rail_is_no_scene_to_roll_over(tmp_path):
    start, _, _ = ROLLING.partition("[rail.roughness]")
    with pytest.raises(ValueError, match=rf"^{IN_FILE}rail must have one of roughness, heights, got none$"):
        load_scene(written(tmp_path, text=start + "[rail]\n"))
    with pytest.raises(ValueError, match=r"must have a rough rail and a smooth wheel to be compared$"):
        compare(load_scene("rough_wheel"))


def test_ground_is_a_spectrum_or_heights_not_both(tmp_path):
    np.save(tmp_path / "face.npy", drawn())
    text = PUNCH + '\n[heights]\nfile = "face.npy"\nspacing = "1 um"\n'
    with pytest.raises(
        ValueError, match=rf"^{IN_FILE}a scene must have one of roughness, heights, got roughness and heights$"
    ):
        load_scene(written(tmp_path, text=text))


@pytest.mark.parametrize(
    ("key", "changes", "got"),
    [
        ("shape", {"shape": "cone"}, "'cone'"),
        ("punch.side", {"size": 0.0}, "0.0"),
        ("punch.load", {"load": math.nan}, "nan"),
        ("modulus", {"modulus": -1.0}, "-1.0"),
        ("name", {"name": " "}, "' '"),
    ],
)
def test_scenes_at_the_prompt_are_refused_by_key_and_value(key, changes, got):
    settings = {"name": "it", "shape": "punch", "size": 1.0, "load": 1.0, "modulus": 1.0}
    with pytest.raises(ValueError, match=f"^{key} must .*, got {got}$"):
        IndentationScene(**{**settings, **changes})


def test_heights_must_cover_the_body():
    ground = heights(drawn())
    settings = {"name": "it", "load": 1.0, "modulus": 1e9, "ground": ground}
    with pytest.raises(ValueError, match=r"^heights must be as large as the punch, punch.side = 0.001 m"):
        IndentationScene(shape="punch", size=1e-3, **settings)
    with pytest.raises(ValueError, match=r"^heights must be .* long and .* wide"):
        IndentationScene(shape="sphere", size=1.0, **settings)
    with pytest.raises(ValueError, match=r"^rail.heights must be .* long and .* wide"):
        RollingScene(radius=1.0, **settings)
    far = {**settings, "ground": MeasuredHeights(height=ground.height, spacing=(0.2, 0.2)), "load": 1e-3}
    for scene in (partial(RollingScene, radius=1e-3), partial(IndentationScene, shape="sphere", size=1e-3)):
        with pytest.raises(ValueError, match=r"^heights.spacing must be no more than the contact radius, .* 0.2 m"):
            scene(**far)


@pytest.mark.parametrize(
    ("along", "across", "said"),
    [
        (3.01 / N, 3.01 / N, ""),
        (2.99 / N, 0.5, "heights must be .* long and .* wide"),
        (0.5, 2.99 / N, "heights must be .* long and .* wide"),
        (0.99, 0.99, ""),
        (1.01, 0.5, "heights.spacing must be no more than the contact radius"),
        (0.5, 1.01, "heights.spacing must be no more than the contact radius"),
    ],
)
@catches("the diameter of the contact of a sphere for its radius", 3.01 / N, 3.01 / N, "").at(
    "validation.scenes.indentation.IndentationScene.contact_radius", Times(2.0)
)
def test_heights_under_a_sphere_reach_over_three_contact_radii_and_have_a_point_to_each(along, across, said):
    """Spacings over a = (3 F R / (4 E*))^(1/3). No side is that of the sphere, and no square is needed."""
    a = (3 * 0.5 * 0.01 / (4 * 1e9)) ** (1 / 3)
    ground = heights(drawn(), (along * a, across * a))
    sphere = partial(IndentationScene, name="it", shape="sphere", size=0.01, load=0.5, modulus=1e9, ground=ground)
    assert re.match(said or "$", refusal(sphere))


@pytest.mark.parametrize(
    ("longer", "wider", "said"),
    [
        (5e-7, 0.0, ""),
        (-5e-7, 0.0, ""),
        (0.0, 5e-7, ""),
        (2e-6, 0.0, "punch.side = "),
        (-2e-6, 0.0, "punch.side = "),
        (0.0, 2e-6, "a square"),
        (0.0, -2e-6, "a square"),
    ],
)
def test_heights_are_as_large_as_their_punch_and_square_to_a_millionth(longer, wider, said):
    ground = heights(drawn(), (1e-6 * (1 + longer), 1e-6 * (1 + longer + wider)))
    size = N * 1e-6 * (1 + max(wider, 0))
    with pytest.raises(ValueError, match=f"^heights must be as large as the punch, {said}") if said else nullcontext():
        IndentationScene(name="it", shape="punch", size=size, load=0.01, modulus=1e9, ground=ground)


def test_the_side_that_is_asked_for_is_taken():
    settings = {
        "name": "it",
        "shape": "punch",
        "load": 0.01,
        "modulus": 1e9,
        "ground": heights(drawn(), (1.00012345e-6,) * 2),
    }
    with pytest.raises(ValueError, match=r'as: side = "[\d.]+ µm"$') as refusal:
        IndentationScene(size=1e-3, **settings)
    side = float(str(refusal.value).split('"')[1].removesuffix(" µm")) / 1e6
    assert IndentationScene(size=side, **settings).size == pytest.approx(N * 1.00012345e-6, rel=1e-6)


def test_a_dynamic_wheel_is_compared_without_a_simulation_which_is_checked_where_it_is_there(tmp_path):
    path = written(tmp_path, text=TABLE.partition("[simulation]")[0])
    assert load_scene(path) == load_scene("table_14_1").for_compare()
    # which rolls along it in time
    with pytest.raises(ValueError, match="simulation is missing"):
        load_scene_with_track(path)
    with pytest.raises(ValueError, match=r"simulation\.distance must be a length"):
        load_scene(written(tmp_path, ('distance = "0.65 m"', 'distance = "0.65 kg"')))


PRESSED = "the mean pressure on the punch is 2.38e+04 of E*, more than a tenth: no half-space; are the units of"


@pytest.mark.parametrize(
    ("size", "load", "modulus", "doubt"),
    [
        (1e-3, 5.0, 210.0, PRESSED),
        (1e-3, 5.0, 210e9, ""),
        # a tenth
        (1e-3, 5.0, 5.01e7, ""),
        (1e-3, 5.0, 4.99e7, "the mean pressure"),
        (1e-3, 1e-6, 210.0, "E* is 210 Pa, softer than a gel: is its unit Pa?"),
        # the unit of pressure of who has none
        (1.0, 5.0, 1.0, ""),
    ],
)
def test_a_smooth_punch_is_asked_for_its_units(size, load, modulus, doubt):
    found = IndentationScene(name="it", shape="punch", size=size, load=load, modulus=modulus).diagnose()
    assert len(found) == bool(doubt) and "".join(found).startswith(doubt)


# The command


@pytest.mark.parametrize("word", ["0", "-1%", "nan", "inf", "five", "5 percent", ""])
def test_tolerances_that_are_none_are_refused(capsys, word):
    with pytest.raises(SystemExit) as refusal:
        main(["compare", "sphere", "--tolerance", word])
    assert refusal.value.code == 2
    assert "--tolerance" in capsys.readouterr().err


def test_the_seed_of_a_comparison_is_that_of_the_command(capsys, monkeypatch):
    seeds, real = [], SceneProblem.compared

    def seen(problem, *callback):
        seeds.append(problem.seed)
        return real(problem, *callback)

    monkeypatch.setattr(SceneProblem, "compared", seen)
    for words in ([], ["--seed", "0"], ["--seed", "7"]):
        assert main(["compare", "sphere", *words]) == 0
    assert seeds == [0, 0, 7]
