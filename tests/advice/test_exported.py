"""What `compare` writes for other programs: strict JSON as its schema says, equal numbers in CSV, whole files."""

import csv
import io
import json
import math
import re
from dataclasses import replace
from importlib import resources
from typing import get_args

import pytest

import validation
from tests.advice.json_schema import faults
from tests.advice.planted_answers import Fake, Finding, compared, planted
from validation.__main__ import main
from validation.advice.compare import Swept
from validation.advice.exported import to_json_of
from validation.advice.hierarchy import Status
from validation.advice.models_of_scene import all_quantities, quantities_of
from validation.scenes.bundled import path_of
from validation.scenes.load import bundled_for_compare


def refuse_constant(name):
    raise AssertionError(name)


def read(comparison):
    return json.loads(validation.to_json(comparison), parse_constant=refuse_constant)


def rows_of(comparison):
    return list(csv.DictReader(io.StringIO(validation.to_csv(comparison))))


def spectrum(**settings):
    return validation.compare(
        validation.load_scene("rolling_wheel"), quantity="force-spectrum", tolerance="3 dB", **settings
    )


def test_the_contact_that_is_assumed_is_that_of_hertz():
    """p0 = 3 F / (2 pi a^2) of a sphere, and a^2 = R d."""
    scene = validation.load_scene("sphere")
    found = read(validation.compare(scene))["assumed"]
    assert found["a_x_m"] ** 2 == pytest.approx(0.5 * found["approach_m"])
    assert found["largest_pressure_Pa"] == pytest.approx(3 * 4905 / (2 * math.pi * found["a_y_m"] ** 2))
    assert (found["E_star_Pa"], found["load_N"]) == (scene.modulus, 4905.0)
    rail = read(validation.compare(validation.load_scene("rail"), tolerance="1 dB"))["assumed"]
    # an ellipsoid of pressure has two thirds of its peak in the mean
    assert 2 / 3 * rail["largest_pressure_Pa"] * math.pi * rail["a_x_m"] * rail["a_y_m"] == pytest.approx(50e3)
    assert abs(rail["a_x_m"] / rail["a_y_m"] - 1) > 0.1
    assert set(read(validation.compare(validation.load_scene("rough_punch"), tolerance=0.5))["assumed"]) == {
        "E_star_Pa",
        "load_N",
    }


def test_what_is_not_known_is_null():
    models = [Fake(name="unknown", claimed=math.inf), Fake(name="lost", failed="why"), Finding(claimed=9.0)]
    nothing = compared(*models[:2])
    found = read(nothing)
    assert (found["model"], found["value"], found["error"], found["met"]) == (None, [None], [None], False)
    assert [one["predicted_error"] for one in found["models"]] == [None, 0.0]
    # under its former name, too, for one release
    assert [one["claimed"] for one in found["models"]] == [None, 0.0] and found["schema_version"] == 2
    assert [one["value"] for one in found["models"]] == [None, None]
    (row,) = rows_of(nothing)
    assert row["value"] == row["model"] == ""


def test_the_error_of_a_number_is_in_its_unit():
    found = read(compared(Finding(value=(5.0,), parts=(0.1, 0, 0))))
    assert (found["tolerance"], found["tolerance_dB"]) == (0.2, pytest.approx(20 * math.log10(1.2)))
    assert (found["value"], found["error"]) == ([5.0], pytest.approx([0.5]))
    assert found["error_parts"] == {"model": pytest.approx([0.5]), "grid": [0.0], "sample": [0.0]}
    assert found["models"][0]["error"] == pytest.approx(0.1)


def test_a_row_has_the_value_of_its_sweep_and_none_without_one():
    alone = compared(Finding())
    of_sweep = replace(alone, swept=Swept("punch.load", 5.0, "kN", "one"))
    (row,), (other,) = rows_of(of_sweep), rows_of(alone)
    assert (row["swept"], float(row["swept_value"]), row["swept_unit"]) == ("punch.load", 5.0, "kN")
    assert {name: cell for name, cell in row.items() if not name.startswith("swept")} == other
    assert [read(one)["swept_value"] for one in (of_sweep, alone)] == [5.0, None]


@pytest.mark.parametrize(("form", "start"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_the_command_writes_what_the_library_returns(form, start, tmp_path):
    places = {
        "--json": tmp_path / "new/out.json",
        "--csv": tmp_path / "new/out.csv",
        "--figure": tmp_path / f"new/o.{form}",
    }
    words = ["compare", "rolling_wheel", "--quantity", "force-spectrum", "--tolerance", "3 dB"]
    assert main([*words, *(str(word) for option in places.items() for word in option)]) == 0
    assert places["--json"].read_text(encoding="utf-8") == validation.to_json(spectrum())
    assert places["--csv"].read_text(encoding="utf-8") == validation.to_csv(spectrum())
    assert places["--figure"].read_bytes().startswith(start)
    assert set((tmp_path / "new").iterdir()) == set(places.values())


@pytest.mark.parametrize("place", ["rail.toml", "far/../levels.csv", "link.json"])
def test_no_result_replaces_a_file_that_the_scene_reads(place, tmp_path, capsys):
    """The scene itself, and what it names, by any path."""
    (tmp_path / "far").mkdir()
    (tmp_path / "link.json").symlink_to("levels.csv")
    (tmp_path / "levels.csv").write_text("wavelength [mm],level [dB re 1 um]\n63,3\n50,2\n40,1\n", encoding="utf-8")
    text = path_of("rail").read_text(encoding="utf-8").replace('curve = "iso3095-2013"', 'file = "levels.csv"')
    (tmp_path / "rail.toml").write_text(text, encoding="utf-8")
    words = ["compare", str(tmp_path / "rail.toml"), "--tolerance", "3 dB"]
    assert main([*words, "--json", str(tmp_path / place)]) == 2
    assert re.search(r"--json must be a file of its own, got .*, which the scene reads", capsys.readouterr().err)
    assert (tmp_path / "rail.toml").read_text(encoding="utf-8") == text
    assert main([*words, "--json", "/dev/null", "--csv", "/dev/null"]) == 0


SCHEMA = json.loads((resources.files("validation.advice") / "comparison.schema.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", bundled_for_compare())
def test_every_quantity_of_every_scene_is_as_the_schema_says(name):
    scene = validation.load_scene(name)
    assert scene.diagnose() == ()
    for quantity in quantities_of(scene):
        found = planted(name, quantity)
        written = json.loads(validation.to_json(found))
        assert faults(written, SCHEMA, SCHEMA) == []
        if found.is_level:
            lengths = {len(written[key]) for key in ("value", "error", "wavelength_mm")}
            lengths |= {len(one["value"]) for one in written["models"]}
            assert len(lengths) == 1
        assert len(written["frequency_hz"]) == len(written["nominal_hz"])


def test_what_is_not_known_and_lists_are_as_the_schema_says():
    nothing = compared(Fake(claimed=float("inf")), Fake(failed="lost"))
    unmet = compared(Finding(parts=(0.5, 0.1, 0.1)))
    beyond = compared(Finding(claimed=float("inf")), solve_all=True, beyond=lambda _: True)
    for found in ([nothing], [unmet], [beyond], [nothing, unmet, beyond], [compared()]):
        assert faults(json.loads(to_json_of(found)), SCHEMA, SCHEMA) == []


@pytest.mark.parametrize(
    ("key", "value", "fault"),
    [
        ("schema_version", 1, "enum"),
        ("met", 1, "type"),
        ("met", None, "type"),
        ("tolerance", 0.0, "exclusiveMinimum"),
        ("unit", "furlong", "enum"),
        ("value", [], "minItems"),
        ("value", ["5"], "type"),
        ("surprise", 1, "additionalProperties"),
        ("models", [{"model": "fit"}], "required"),
        ("assumed", {"E_star_Pa": 1.0}, "required"),
    ],
)
def test_what_is_wrong_is_found(key, value, fault):
    written = json.loads(to_json_of([compared(Finding())]))
    assert any(fault in said for said in faults({**written, key: value}, SCHEMA["$defs"]["comparison"], SCHEMA))
    assert faults({**written, key: value}, SCHEMA, SCHEMA) != []


def test_the_lists_of_words_are_those_of_the_code():
    found = SCHEMA["$defs"]["comparison"]["properties"]
    assert found["quantity"]["enum"] == list(all_quantities())
    assert SCHEMA["$defs"]["model"]["properties"]["status"]["enum"] == list(get_args(Status))
    assert set(SCHEMA["$defs"]["comparison"]["required"]) == set(found)
