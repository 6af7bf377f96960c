"""Figures are drawn once, by workers, while other cases are solved; and how long all of it is expected to take."""

import math
import tomllib
from pathlib import Path
from types import SimpleNamespace

import pytest
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.engine.progress import Part
from validation.engine.workers import Workers
from validation.report import contents
from validation.report import page as pictures


def test_figures_come_by_their_names_and_are_counted(monkeypatch):
    monkeypatch.setattr(pictures, "draw_figure", lambda name, evidence, profile: f"{name} {profile}".encode())
    progress = Part("figures")
    evidence = SimpleNamespace(captions=dict.fromkeys("abc", ""))
    begun = pictures.begin_to_draw(evidence, Workers(1), progress, "quick")
    assert {name: drawn.result() for name, drawn in begun.items()} == {name: f"{name} quick".encode() for name in "abc"}
    assert progress.line == "figures: drawn 3/3"


def test_a_figure_is_drawn_from_what_its_files_hold(monkeypatch):
    """Infinities are empty there and digits end: drawn with them, it would not be what `redraw` draws."""
    table = Table("levels", {"off": [-math.inf, 1 / 3]})
    evidence = Evidence(title="a", method="", numbers=(), tables=(table,), conclusions=(), captions={"a": ""})
    seen = []
    monkeypatch.setattr(pictures, "drawing", lambda name: lambda evidence: seen.append(evidence) or Figure())
    pictures.draw_figure("a", evidence, "full")
    (off,) = (found.table("levels")["off"] for found in seen)
    assert math.isnan(off[0]) and off[1] == 0.3333333


def test_the_table_of_durations_names_cases_and_others_are_like_their_mean():
    known = tomllib.loads(Path(contents.__file__).with_name("durations.toml").read_text(encoding="utf-8"))
    assert known.keys() <= {*contents.CASES, *contents.TIMED, pictures.FIGURES}
    for profile, seconds in zip(("quick", "full"), zip(*known.values(), strict=True), strict=True):
        expected = contents.expected_seconds(["ladder", "a new case"], profile)
        assert expected["ladder"] == known["ladder"][profile == "full"]
        assert expected["a new case"] == pytest.approx(sum(seconds) / len(known))
