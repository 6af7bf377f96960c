"""The schema of the JSON: every kind of answer is as it says, and what is not is found."""

import json
from importlib import resources
from typing import get_args

import pytest

import validation
from tests.selection.json_schema import faults
from tests.selection.planted_answers import Fake, Finding, compared, planted
from validation.scenes.load import bundled_for_compare
from validation.selection.exported import to_json_of
from validation.selection.hierarchy import Status
from validation.selection.quantities import QUANTITIES, quantities_of

SCHEMA = json.loads((resources.files("validation.selection") / "comparison.schema.json").read_text(encoding="utf-8"))


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
    assert found["quantity"]["enum"] == list(QUANTITIES)
    assert SCHEMA["$defs"]["model"]["properties"]["status"]["enum"] == list(get_args(Status))
    assert set(SCHEMA["$defs"]["comparison"]["required"]) == set(found)
