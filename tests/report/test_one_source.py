"""Numbers in prose have one source: durations, patience, scenes, cells to a contact radius."""

import re
from pathlib import Path

import pytest

from validation.__main__ import COMMANDS
from validation.benchmarks.solvers import CASE as RACE
from validation.benchmarks.solvers import PATIENCE
from validation.benchmarks.work_precision.case import FULL, QUICK
from validation.cases.rolling import reduced_models as reduced
from validation.report.answers.questions import QUESTIONS
from validation.report.contents import CASES
from validation.report.durations import duration_text, seconds_of
from validation.simulation.reduced_models import MODELS

ROOT = Path(__file__).parents[2]
REPORTS = (ROOT / "reports" / "README.md").read_text(encoding="utf-8")
EVERY = [name for name in seconds_of("full") if name != "race"]


def line_with(words):
    (line,) = (line for line in REPORTS.splitlines() if words in line)
    return line


@pytest.mark.parametrize(
    ("words", "duration"),
    [
        ("make report            #", duration_text("quick", EVERY, 2)),
        ("make full-report ", duration_text("full", EVERY, 2)),
        ("make reference ", duration_text("full", seconds_of("full"), 2)),
        ("--only fractal_punch --profile full", duration_text("full", ["fractal_punch"], 2)),
        ("mdr-validation precision --profile full", duration_text("full", ["precision"])),
        ("mdr-validation benchmark --profile full", duration_text("full", ["race"])),
        ("the quick size they take", f"{duration_text('quick', ['precision'])} and {duration_text('quick', ['race'])}"),
    ],
)
def test_durations_on_the_page_of_reports_are_those_of_the_table(words, duration):
    assert duration in line_with(words)


def test_no_other_duration_stands_there():
    """But what a user sets, or the program waits for."""
    stated = re.findall(r"about ([\d.]+ (?:seconds|minutes|hours))", REPORTS)
    assert len(stated) == 8  # two of them in one line
    assert not re.search(r"half an hour|twenty minutes|half a minute|hours? on two cores, less", REPORTS)


@pytest.mark.parametrize(("name", "case"), [("precision", "precision"), ("benchmark", "race")])
def test_the_help_has_the_same_durations(name, case):
    assert COMMANDS[name].endswith(f"the full size takes {duration_text('full', [case])}")


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(4.4, "about 4 seconds"), (89.0, "about 90 seconds"), (90.0, "about 1.5 minutes"), (760.0, "about 13 minutes")],
)
def test_a_duration_has_two_digits_and_its_unit(monkeypatch, seconds, words):
    monkeypatch.setattr("validation.report.durations.seconds_of", lambda profile: {"hertz": seconds, "race": seconds})
    assert duration_text("full", ["hertz"]) == duration_text("full", ["race"]) == words
    # what is timed has one core
    assert duration_text("full", ["race"], 2) == words != duration_text("full", ["hertz"], 2)


def test_a_solver_is_left_out_after_the_seconds_that_the_page_says():
    assert f"longer than {PATIENCE:g} seconds there is left out" in REPORTS.replace("\n", " ")


def test_the_grids_of_the_race_are_those_of_the_page():
    cells = (*RACE.full.cells, *RACE.full.large)
    assert f"{cells[0]}² to {cells[-1]}² cells" in line_with("mdr-validation benchmark --profile full")
    assert f"The full size has grids of {cells[-2]}² and {cells[-1]}² cells" in REPORTS
    assert f"on {RACE.quick.cells[0]}² cells" in REPORTS


@pytest.mark.parametrize("case", [QUICK, FULL])
def test_the_scenes_of_precision_are_counted_once(case):
    """By the page, which names them; the help counts none."""
    assert len(case.problems()) == 5 and "five scenes: a sphere, a square punch, the punch of Fig. 14.1, one with" in (
        REPORTS.replace("\n", " ")
    )
    assert "scenes" not in COMMANDS["precision"]


def test_a_label_of_a_coarse_grid_is_printed_with_its_cells_per_contact_radius():
    """4 of 12: a ninth of the cells, and no third. The label stays as the key of numbers and columns."""
    case = CASES["reduced_models"]
    for settings in (case.quick, case.full):
        for label, text in reduced.PRINTED.items():
            assert text == f"boundary elements, {settings.cells // MODELS[label][1]} cells per contact radius"
    texts = [
        *(alternative.name for question in QUESTIONS for alternative in question.instead),
        *(claim.short for claim in case.study.claims),
        *(curve.label for chart in case.study.charts for panel in chart.panels for curve in panel.curves),
        *(text for matrix in case.study.matrices for text in matrix.named.values()),
    ]
    assert sum("4 cells per contact radius" in text for text in texts) == 5
    assert not [text for text in texts if "third" in text or "1/3" in text]


def test_no_curve_of_a_coarse_grid_has_its_label_for_a_name():
    """A curve by models prints theirs."""
    curves = [curve for chart in CASES["reduced_models"].study.charts for p in chart.panels for curve in p.curves]
    models = [(curve.model, curve.label) for curve in curves if set(reduced.PRINTED) & {*curve.model, curve.model}]
    assert models and all(label in ("_", *reduced.PRINTED.values()) for _, label in models)
