"""Keys of JSON: snake_case in schema 2, and beside them for one release those of schema 1 that were renamed."""

import json
import re

import pytest

from tests.report.remade import REFERENCE, sections
from tests.report.test_answers import at, punch
from validation.analysis.contents import condition_key
from validation.engine.former_names import value_of
from validation.report import earlier_report
from validation.report.answers.first_screen import answered_questions, plain
from validation.report.section import case_results

FORMER = {
    "chapter_14": "chapter 14",
    "when_mdr_is_accurate_enough": "when MDR is enough",
    "page_tables": "page tables",
    "model_needed": "model needed",
    "model_needed_is": "model needed is",
    "deciding_number": "number that decides",
    "by_condition": "by condition",
}
WORDS = {True: ("yes",), False: ("no",), None: ("open", "not measured")}
RESULTS = json.loads((REFERENCE / "results.json").read_text(encoding="utf-8"))
OPEN = {"settings", "where", "columns", "captions", "headlines", "verdicts"}
"""Whose keys are names of fields, conditions, columns and figures, not those of the schema."""


def objects(value):
    """All objects with keys of the schema."""
    if isinstance(value, dict):
        yield value
        yield from (one for name, part in value.items() if name not in OPEN for one in objects(part))
    elif isinstance(value, list):
        yield from (one for part in value for one in objects(part))


def test_the_committed_results_have_both_keys_with_the_same_value():
    found = set()
    for one in objects(RESULTS):
        for key in FORMER.keys() & one.keys():
            found.add(key)
            assert one[FORMER[key]] == one[key]
    assert found == FORMER.keys() and RESULTS["schema_version"] == 2


def test_no_other_key_has_a_space():
    known = {*FORMER.values(), "confirmed by"}
    names = {name for one in objects(RESULTS) for name in one} - {*RESULTS["cases"]}
    assert {name for name in names if not re.fullmatch(r"[a-zA-Z]\w*", name, flags=re.ASCII)} == known


def test_a_cell_of_a_strip_says_within_tolerance_and_what_it_said_before():
    cells = [cell for row in RESULTS["when_mdr_is_accurate_enough"] for cell in row["strip"]]
    assert {cell["within_tolerance"] for cell in cells} == WORDS.keys()
    for cell in cells:
        assert cell["enough"] in WORDS[cell["within_tolerance"]]
        assert (cell["verdict"] == "within tolerance") == (cell["within_tolerance"] is True)
    (row,) = plain([answered_questions([punch(at((0.1, 1.0), 0.5, 0.01))])[0]])
    assert [cell["within_tolerance"] for cell in row["strip"]] == [None, True, None]


def test_conditions_have_keys_and_the_values_of_where():
    numbers = [number for case in RESULTS["cases"].values() for number in case["numbers"]]
    for number in numbers:
        assert list(number["conditions"].values()) == list(number["where"].values())
        assert all(re.fullmatch(r"[a-zA-Z]\w*", key, flags=re.ASCII) for key in number["conditions"])


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("wavelength [mm]", "wavelength_mm"),
        ("Fbar", "normalised_load"),
        ("H", "hurst"),
        ("q_r L / 2π", "q_r_L_2pi"),
        ("ω [rad/s]", "omega_rad_s"),
        ("h' a/d", "h_a_d"),
        ("zero of sin²(q a)", "zero_of_sin2_q_a"),
    ],
)
def test_keys_of_conditions(name, key):
    assert condition_key(name) == key


def test_different_conditions_have_different_keys():
    names = {name for case in RESULTS["cases"].values() for number in case["numbers"] for name in number["where"]}
    assert len({condition_key(name) for name in names}) == len(names) > 20


def test_a_report_of_schema_1_is_read_as_one_of_schema_2():
    """As `report --keep` and the pages of the committed report read it."""
    (section,) = [one for one in sections() if one.name == "hertz"]
    case = json.loads(json.dumps(case_results(section), default=str))
    before = {name: value for name, value in case.items() if name not in FORMER}
    for claim in before["claims"]:
        claim.pop("confirmed_by")
    assert case_results(earlier_report._section(REFERENCE, "hertz", before)) == case_results(section)
    with pytest.raises(ValueError, match="page tables"):
        earlier_report._section(REFERENCE, "hertz", {name: v for name, v in before.items() if name != "page tables"})


def test_a_value_is_that_of_todays_key():
    assert value_of({"new": 1, "old": 2}, "new", "old") == 1 == value_of({"old": 1}, "new", "old")
    with pytest.raises(KeyError, match="old"):
        value_of({}, "new", "old")
