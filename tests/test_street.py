"""The houses of the street: any of them may be deleted from its far end, and the rest still runs."""

import re
from importlib import import_module

import pytest

import validation
from tests.copies import copied
from validation.engine import street

AWAY = [street.HOUSES[place:] for place in range(len(street.HOUSES))]
FACE = dict(validation.MODULES)
COMMANDS = {house: import_module(f"validation.{house}").COMMANDS for house in street.HOUSES}
IMPORTED = """import validation
assert {place} in validation.__file__
print(*(getattr(validation, name).__name__ for name in {names}))
"""


@pytest.mark.slow
@pytest.mark.parametrize("away", AWAY, ids=" and ".join)
def test_the_rest_runs_without_the_houses_at_the_far_end(away, tmp_path):
    run = copied(tmp_path, away)
    names = [name for name, module in FACE.items() if module.partition(".")[0] not in away and name != "CASES"]
    assert set(names) <= set(run("-c", IMPORTED.format(place=repr(str(tmp_path)), names=names)).split())
    shown = run("-m", "validation", "--help")
    for house, commands in COMMANDS.items():
        for command in commands:
            assert bool(re.search(rf"^ +{command}\b", shown, re.MULTILINE)) == (house not in away), command
    run("-m", "validation", "report", "--only", "hertz", "geike", "--out", "made")
    page = (tmp_path / "made" / "index.html").read_text(encoding="utf-8")
    assert "hertz" in page and "geike" in page
    listed = {line.split()[0] for line in run("-m", "validation", "cases").splitlines() if line.strip()}
    assert ("across" in listed) == ("railway" not in away) and ("ladder" in listed) == ("advice" not in away)
    if "advice" not in away:
        assert "stiffness = " in run("-m", "validation", "compare", "rough_punch", "--tolerance", "20%")


def test_what_a_house_brings_is_there():
    """The places of all uses, each of a house that is at that place itself."""
    for house in street.houses():
        for use, place in import_module(f"validation.{house}").BRINGS.items():
            assert place.startswith(f"validation.{house}") and street.objects_of_houses(use), use


def test_a_house_that_is_away_brings_nothing(monkeypatch):
    monkeypatch.setattr(street, "houses", lambda: ("advice",))
    assert street.objects_of_houses("quantities") == [] and street.objects_of_houses("model_for")
    assert set(street.commands()) == set(COMMANDS["advice"])
    assert {module.__name__.split(".")[1] for module in street.modules_in("cases")} == {"advice"}
