"""Scenes that `compare` takes, with measured heights and without: what is read, what is refused by name."""

import math
import re
from functools import partial

import numpy as np
import pytest

from tests.scenes.test_height_forms import PUNCH
from tests.scenes.test_measured_heights import drawn, heights
from tests.scenes.test_scene_files import IN_FILE, TABLE, written
from validation.__main__ import main
from validation.advice.compare import SceneProblem, compare
from validation.scenes.bundled import SCENES
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene, load_scene_with_track, load_varied
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingScene

SMOOTH, LOAD = PUNCH.partition("[roughness]")[0], 'load = "23.076923 N"'
ROLLING = (SCENES / "rolling_wheel.toml").read_text(encoding="utf-8")


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
