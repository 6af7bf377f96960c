"""Several scenes, or one key at several values, in one table, file and figure."""

import csv
import json
import re
from dataclasses import replace

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import punch
from validation.__main__ import main
from validation.advice.compare import SceneProblem, content_of
from validation.advice.several_scenes import compare_scenes
from validation.advice.summary import summary
from validation.engine.engine import Engine
from validation.railway.scenes.measured_lines import MeasuredLines

SWEEP = ["compare", "rolling_wheel", "--tolerance", "10%", "--workers", "1", "--sweep", "wheel.load=2000 N,4905 N"]
HEIGHTS = np.random.default_rng(4).standard_normal((64, 64)) * 1e-3


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    """Finished scenes are stored below the working folder."""
    monkeypatch.chdir(tmp_path)


def test_a_sweep_is_one_table_with_a_row_a_value(tmp_path, capsys):
    assert main([*SWEEP, "--json", "out.json", "--csv", "out.csv", "--figure", "out.svg"]) == 0
    lines = capsys.readouterr().out.splitlines()
    names = ["Rolling wheel, load = 2000 N", "Rolling wheel, load = 4905 N"]
    assert len(lines) == 3 and [line[: len(names[0])] for line in lines[1:]] == names
    alone = validation.compare(validation.load_scene("rolling_wheel"))
    objects = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert [found["scene"] for found in objects] == names
    assert objects[0]["value"][0] < objects[1]["value"][0] == pytest.approx(alone.value)
    rows = list(csv.DictReader((tmp_path / "out.csv").read_text(encoding="utf-8").splitlines()))
    assert [row["scene"] for row in rows] == names
    told = [(row["swept"], float(row["swept_value"]), row["swept_unit"]) for row in rows]
    assert told == [("wheel.load", 2000.0, "N"), ("wheel.load", 4905.0, "N")]
    assert [(one["swept"], one["swept_value"], one["swept_unit"]) for one in objects] == told
    assert (tmp_path / "out.svg").read_bytes().startswith(b"<?xml")


def test_what_would_help_is_said_of_each_that_is_not_met(capsys):
    words = ["compare", "rough_punch", "--models", "springs", "--tolerance", "20%", "--workers", "1"]
    assert main([*words, "--sweep", "punch.load=1 N,50 N"]) == 3
    text = " ".join(capsys.readouterr().out.split())
    assert re.search(
        r"load = 1 N: what would help: boundary elements \d+², which was not asked, with a predicted error of \S+ %",
        text,
    )
    assert "load = 50 N: what" not in text


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("wheels.load", "1 N", "wheels.load must be a key in a table of the scene"),
        ("wheel", "1", "wheel must be a key with a value, got a table"),
        ("wheel.weight", "1 N", "wheel.weight is unknown"),
    ],
)
def test_a_key_that_is_none_is_refused(key, value, said, capsys):
    assert main(["compare", "rolling_wheel", "--sweep", f"{key}={value}"]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("word", ["wheel.load", "=1 N", "wheel.load=", "wheel.load=1 N,", "loudness"])
def test_a_sweep_without_values_and_an_unknown_quantity_are_refused(word, capsys):
    option = "--quantity" if word == "loudness" else "--sweep"
    with pytest.raises(SystemExit) as refused:
        main(["compare", "rolling_wheel", option, word])
    assert refused.value.code == 2 and option in capsys.readouterr().err


def problem(**changes):
    rolling = {"scene": validation.load_scene("rolling_wheel"), "quantities": ("force-rms",), "tolerance": "1 dB"}
    return SceneProblem(**{**rolling, **changes})


def measured(height=HEIGHTS):
    return punch(ground=validation.MeasuredHeights(height=height, spacing=(1 / 64, 1 / 64)))


@pytest.mark.slow
def test_a_stored_comparison_is_the_one_that_was_solved(tmp_path):
    """Bit for bit, text and files but for the clock; of a rail its errors in bands, of a measured face all heights."""
    problems = [
        problem(),
        problem(solve_all=True, models=("mdr",)),
        problem(scene=measured(), quantities=("stiffness",), tolerance=0.9),
    ]
    problems.append(problem(scene=validation.load_scene("rail"), quantities=("contact-filter",)))
    engine = Engine(store=tmp_path)
    solved, stored = (compare_scenes(problems, engine) for _ in range(2))
    for one, *found in zip(problems, solved, stored, strict=True):
        alone = validation.compare(one.scene, one.tolerance, quantity=one.quantities[0], models=one.models or None)
        for comparison in (replace(each, timed=False) for each in found):
            assert (summary(comparison), validation.to_json(comparison)) == (summary(alone), validation.to_json(alone))


def test_an_interrupted_sweep_goes_on(monkeypatch, capsys):
    solved, compared = [], SceneProblem.compared

    def interrupted(problem):
        solved.append(problem.scene.name)
        if len(solved) == 2:
            raise KeyboardInterrupt
        return compared(problem)

    monkeypatch.setattr(SceneProblem, "compared", interrupted)
    assert main(SWEEP) == 130
    assert "the same command goes on" in capsys.readouterr().err
    assert main(SWEEP) == 0
    assert solved == ["Rolling wheel, load = 2000 N", *["Rolling wheel, load = 4905 N"] * 2]


@pytest.mark.parametrize("place", [0, 1, 700, 1500, 2999])
def test_no_place_of_a_measured_line_is_left_out_of_the_digest_of_its_scene(place):
    def content(height):
        rail = validation.load_scene("rail")
        return content_of(
            replace(rail, roughness=MeasuredLines(height=height, spacing=1e-3), lateral_structure="ridges")
        )

    line = np.random.default_rng(6).standard_normal(3000) * 1e-6
    changed = line.copy()
    changed[place] *= 1.001
    assert content(line) == content(line.copy()) != content(changed)


def test_heights_that_differ_in_one_point_are_another_scene():
    changed = HEIGHTS.copy()
    changed[31, 31] += 1e-6
    contents = [content_of(measured(heights)) for heights in (HEIGHTS, HEIGHTS.copy(), changed)]
    assert contents[0] == contents[1] != contents[2]
    scene = validation.load_scene("rail")
    before = content_of(scene)
    _ = scene.contact, scene.levels.rms  # what is computed and kept is no part of it
    assert content_of(scene) == before


def test_two_quantities_are_told_apart_by_a_column_and_a_panel(tmp_path, capsys):
    table, picture = tmp_path / "out.csv", tmp_path / "out.svg"
    assert main(["compare", "sphere", "rolling_wheel", "--csv", str(table), "--figure", str(picture)]) == 0
    assert [row["quantity"] for row in csv.DictReader(table.read_text(encoding="utf-8").splitlines())] == [
        "stiffness",
        "force-rms",
    ]
    assert "Rolling wheel: force-rms" in capsys.readouterr().out
    assert picture.read_bytes().startswith(b"<?xml")
