"""Several scenes, or one key at several values, in one table, file and figure."""

import csv
import json

import pytest

import validation
from validation.__main__ import main
from validation.scenes.load import load_varied

SWEEP = ["compare", "rolling_wheel", "--tolerance", "10%", "--sweep", "wheel.load=2000 N,4905 N"]


def test_a_sweep_is_one_table_with_a_row_a_value(tmp_path, capsys):
    places = {form: tmp_path / f"out.{form}" for form in ("json", "csv", "svg")}
    options = {"json": "--json", "csv": "--csv", "svg": "--figure"}
    words = [word for form, place in places.items() for word in (options[form], str(place))]
    assert main([*SWEEP, *words]) == 0
    lines = capsys.readouterr().out.splitlines()
    names = ["Rolling wheel, load = 2000 N", "Rolling wheel, load = 4905 N"]
    assert len(lines) == 3 and [line[: len(names[0])] for line in lines[1:]] == names
    alone = validation.compare(validation.load_scene("rolling_wheel"))
    objects = json.loads(places["json"].read_text())
    assert [found["scene"] for found in objects] == names
    assert objects[1]["value"] == pytest.approx(alone.value.tolist())
    assert objects[0]["value"][0] < objects[1]["value"][0]
    rows = list(csv.DictReader(places["csv"].read_text().splitlines()))
    assert [row["scene"] for row in rows] == names
    assert places["svg"].read_bytes().startswith(b"<?xml")


def test_several_scenes_end_as_the_worst_of_them(capsys):
    assert main(["compare", "sphere", "rough_punch", "--tolerance", "50%"]) == 0
    text = capsys.readouterr().out
    assert "Smooth sphere" in text and "Rough punch" in text and "±" in text


def test_a_value_is_read_as_in_the_file():
    assert load_varied("rolling_wheel", "wheel.load", "2 kN").load == 2000.0
    assert load_varied("rough_punch", "roughness.hurst", "0.5").ground.hurst == 0.5
    assert load_varied("rolling_wheel", "wheel.load", "4905 N").load == validation.load_scene("rolling_wheel").load


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("wheels.load", "1 N", "wheels.load must be a key in a table of the scene"),
        ("wheel", "1", "wheel must be a key with a value, got a table"),
        ("wheel.weight", "1 N", "wheel.weight is unknown"),
        ("wheel.load", "1 m", "wheel.load must be a force"),
    ],
)
def test_a_key_that_is_none_is_refused(key, value, said, capsys):
    assert main(["compare", "rolling_wheel", "--sweep", f"{key}={value}"]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("word", ["wheel.load", "=1 N", "wheel.load=", "wheel.load=1 N,"])
def test_a_sweep_without_values_is_refused(word, capsys):
    with pytest.raises(SystemExit) as refused:
        main(["compare", "rolling_wheel", "--sweep", word])
    assert refused.value.code == 2 and "--sweep" in capsys.readouterr().err
