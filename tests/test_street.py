"""The houses of the street: any of them may be deleted from its far end, and the rest still runs."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import validation
from validation.engine import street

ROOT = Path(__file__).parents[1]
AWAY = [street.HOUSES[place:] for place in range(len(street.HOUSES))]


@pytest.fixture
def left(tmp_path, request):
    """A copy of the packages without some houses, and a function that runs a command in it."""
    for package in ("mdr", "bem3d", "validation"):
        ignored = shutil.ignore_patterns("__pycache__", *(request.param if package == "validation" else ()))
        shutil.copytree(ROOT / package, tmp_path / package, ignore=ignored)
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "OMP_NUM_THREADS": "1"}

    def run(*words):
        done = subprocess.run(
            [sys.executable, *words], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


IMPORTED = """import validation
assert {place} in validation.__file__
print(*(getattr(validation, name).__name__ for name in {names}))
"""


@pytest.mark.slow
@pytest.mark.parametrize("left", AWAY, indirect=True, ids=" and ".join)
def test_the_rest_runs_without_the_houses_at_the_far_end(left, tmp_path, request):
    away = request.node.callspec.params["left"]
    gone = {name for name, module in FACE.items() if module.partition(".")[0] in away}
    kept = [name for name, module in FACE.items() if name not in gone and name != "CASES"]
    names = left("-c", IMPORTED.format(place=repr(str(tmp_path)), names=kept)).split()
    assert set(kept) <= set(names)
    shown = left("-m", "validation", "--help")
    for house in street.HOUSES:
        for command in COMMANDS[house]:
            assert (f"    {command} " in shown) == (house not in away), command
    left("-m", "validation", "report", "--only", "hertz", "geike", "--out", "made")
    page = (tmp_path / "made" / "index.html").read_text(encoding="utf-8")
    assert "hertz" in page and "geike" in page
    listed = {line.split()[0] for line in left("-m", "validation", "cases").splitlines() if line.strip()}
    assert ("across" in listed) == ("railway" not in away) and ("ladder" in listed) == ("advice" not in away)
    if "advice" not in away:
        assert "stiffness = " in left("-m", "validation", "compare", "rough_punch", "--tolerance", "20%")


FACE = dict(validation.MODULES)
COMMANDS = {house: __import__(f"validation.{house}", fromlist=["COMMANDS"]).COMMANDS for house in street.HOUSES}


def test_what_a_house_brings_is_there():
    """The places of all uses, each of a house that is at that place itself."""
    for house in street.houses():
        brings = __import__(f"validation.{house}", fromlist=["BRINGS"]).BRINGS
        for use, place in brings.items():
            assert place.startswith(f"validation.{house}"), use
            assert street.brought(use), use


def test_a_house_that_is_away_brings_nothing(monkeypatch):
    monkeypatch.setattr(street, "houses", lambda: ("advice",))
    assert street.brought("quantities") == [] and street.brought("model_for")
    assert set(street.commands()) == set(COMMANDS["advice"])
    assert {module.__name__.split(".")[1] for module in street.modules_in("cases")} == {"advice"}
