"""The first screen: a cell has the verdicts of its numbers, a sentence changes its words with them."""

import json
import re
import runpy
from dataclasses import replace
from pathlib import Path

import pytest

from tests.report.test_printed import html_of, number
from tests.seeded import catches
from validation.analysis import statistics
from validation.analysis.evidence import Evidence, Role, Table, Verdict
from validation.analysis.number_text import level_as_factor, level_in_decibels, level_in_per_cent
from validation.benchmarks.work_precision.case import POINTS
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS
from validation.benchmarks.work_precision.problem import BEM
from validation.cases.punch import fractal_punch_study
from validation.cases.punch.ensembles import DEVIATION, MEAN, OVER
from validation.cases.rolling.force_spectrum import LINEAR_3D, RMS_FORCE, RMS_LEVEL, SPRINGS
from validation.cases.rolling.force_spectrum import OVER as OVER_ROLLED
from validation.cases.wheel.ensembles import LEVEL as LEVEL_OF_WHEEL
from validation.cases.wheel.half_space import GEIKE, OVER_BEM
from validation.railway.cases import across, rolled_filters
from validation.railway.cases.filters import OFFSET
from validation.railway.cases.rail_dynamic import BEAM, BESIDE, RAIL, RMS, SPRINGS_OVER_BEM
from validation.report.answers import first_screen, strip
from validation.report.answers import question as seconds
from validation.report.answers.first_screen import answered_questions, from_to, plain
from validation.report.answers.questions import QUESTIONS
from validation.report.answers.strip import Cell, span
from validation.report.contents import CASES, TIMED
from validation.report.section import Section, case_results

ROOT = Path(__file__).parents[2]
TEN = fractal_punch_study.LEVEL.tolerance
GRIDS = {
    "value": [16.0, 32.0, 256.0, 512.0],
    "status": ["finished", "finished", "finished", "failed: lost"],
    "median [s]": [1e-3, 5.8e-3, 5.3e-2, 9.0],
    "error": [0.11, 0.04, 0.01, 0.0],
    "± sample": [0.0, 0.05, 0.0, 0.0],
}
DECADES = {(0.01, 0.1): "0.01 to 0.1", (0.1, 1.0): "0.1 to 1", (1.0, 10.0): "1 to 10"}


def at(decade, value, half=0.0, hurst=0.7, **changes):
    """MDR over boundary elements in a decade [dB], within 10 %."""
    where = {"H": hurst, "Fbar": decade, "worst at": decade[0]}
    settings = {"reference": 0.0, "tolerance": TEN, "sample": half, "model": OVER, "role": Role.FINDING}
    return number(value, **{"quantity": MEAN, "where": where, "reason": "10 %: reason", **settings, **changes})


def section_of(name, numbers, *tables, **settings):
    evidence = Evidence(title="t", method="m", numbers=tuple(numbers), tables=tables, conclusions=(), captions={})
    return Section(name, (CASES | TIMED)[name], "none", settings, evidence)


def punch(*numbers):
    return section_of("fractal_punch", numbers)


def timed():
    """Boundary elements on a rough punch, and a wheel of Fig. 14.4."""
    columns = {
        "scene": 4 * ["fractal punch"],
        "quantity": 4 * ["mean stiffness"],
        "method": 4 * [BEM],
        "setting": ["16 a side", "32 a side", "256 a side", "512 a side"],
    }
    wheel = Table(COST_OF_STEPS, {"method": ["springs", "boundary elements"], "one wheel [s]": [0.01, 55.4]})
    return section_of("precision", [], Table(POINTS, {**columns, **GRIDS}), wheel)


def row_of(name, *sections):
    (row,) = (row for row in answered_questions(sections) if row.question.name == name)
    return row


def mean_stiffness(*numbers):
    return row_of("mean-stiffness", punch(*numbers))


def strip_of(row):
    """Places with their words."""
    return [(cell.place, cell.word) for cell in row.strip]


def words_of(row):
    return [word for _, word in strip_of(row)]


def enough_by_most(cell):
    """A counterexample outvoted."""
    return (
        Verdict.WITHIN
        if 2 * sum(number.verdict is Verdict.WITHIN for number in cell.numbers) > len(cell.numbers)
        else Verdict.OUTSIDE
    )


@catches("a cell that says what most of its numbers say").at(
    "validation.report.answers.strip.Cell.verdict", property(enough_by_most)
)
def test_one_counterexample_among_all_exponents_is_a_no():
    """At each place the worst of its numbers decides, and the sentence has the numbers that differ, no others."""
    values = ((0.4, 0.1), (0.7, 2.0), (1.0, 0.2), ("mean over H", 0.0))
    row = mean_stiffness(*(at((0.1, 1.0), value, hurst=hurst) for hurst, value in values))
    assert words_of(row)[1:-1] == ["outside"]
    assert ": off by +26 %" in row.answer


def test_a_place_without_all_of_its_numbers_is_no_yes():
    row = mean_stiffness(at((0.1, 1.0), 0.0, hurst=0.4), at((0.1, 1.0), 0.0), at((1.0, 10.0), 0.0))
    assert words_of(row)[1:-1] == ["within", "inconclusive"]
    assert "inconclusive for 1 ≤ Fbar ≤ 10: some numbers are missing" in row.answer


# --- a strip and where it ends ---


def test_a_sentence_has_a_clause_for_each_side_and_ends_where_it_was_measured():
    numbers = [at((0.01, 0.1), 1.0, 1.5), at((0.1, 1.0), 0.3, 0.1), at((1.0, 10.0), -1.2, 0.02)]
    row = mean_stiffness(*reversed(numbers))
    assert row.word == "In part"
    for clause in (
        "Within tolerance for 0.1 ≤ Fbar < 1: off by +2 to +5 %, error bars included;",
        "outside tolerance for 1 ≤ Fbar ≤ 10: off by -13 %;",
        "inconclusive for 0.01 ≤ Fbar < 0.1: off by -6 to +33 %, error bars included.",
    ):
        assert clause in row.answer
    places = ("< 0.01", "0.01 to 0.1", "0.1 to 1", "1 to 10", "> 10")
    assert strip_of(row) == list(
        zip(places, ("not measured", "inconclusive", "within", "outside", "not measured"), strict=True)
    )
    assert (row.measured, row.margin) == ("Fbar = 0.01 to 10, H = 0.7", "10 %: reason")
    (told,) = plain([row])
    assert {name: told["strip"][2][name] for name in ("place", "within_tolerance", "enough", "verdict", "ends")} == {
        "place": "0.1 to 1",
        "within_tolerance": True,
        "enough": "yes",
        "verdict": "within tolerance",
        "ends": (0.1, 1.0),
    }
    assert (told["case"], told["of"]) == ("fractal_punch", "ensemble mean")
    # the page has a class for each word
    cells = re.findall(
        r'<li class="(\w+)"><span class="at">.*?</span> <b>.*?([\w ]+)(?:</span>)?</b>',
        html_of(punch(*numbers)),
    )
    assert cells == [(word.replace("not measured", "unmeasured"), word) for word in words_of(row)]


def test_neighbours_of_one_side_are_one_range_and_others_are_not():
    row = mean_stiffness(*(at(decade, value) for decade, value in zip(DECADES, (0.0, 3.0, 0.1), strict=True)))
    assert row.answer.startswith("Within tolerance for 0.01 ≤ Fbar < 0.1 and for 1 ≤ Fbar ≤ 10: ")
    row = mean_stiffness(*(at(decade, 0.0) for decade in DECADES))
    assert row.answer.startswith("Within tolerance for 0.01 ≤ Fbar ≤ 10: ")


BY_HURST = {(0.001, 0.01): "aaad", (0.01, 0.1): "aaaa", (0.1, 1.0): "uaaa", (1.0, 10.0): "dddd"}
"""As the mean stiffness of Fig. 14.1: a letter a Hurst exponent."""


def by_hurst():
    values = {"a": (0.0, 0.0), "d": (9.0, 0.0), "u": (0.0, 9.0)}
    return [
        at(decade, *values[letter], hurst=hurst)
        for decade, letters in BY_HURST.items()
        for letter, hurst in zip(letters, (0.4, 0.55, 0.7, 1.0), strict=True)
    ]


@catches("a strip that hides its Hurst exponent").at(
    "validation.report.answers.strip.separating_conditions", lambda *_: ()
)
def test_a_strip_and_its_sentence_name_the_hurst_exponents_on_which_a_verdict_depends():
    row = mean_stiffness(*by_hurst())
    assert [cell.alone for cell in row.strip] == ["", "H = 1 alone", "", "H = 0.4 alone", "", ""]
    assert [cell.by for cell in row.strip][1] == "within tolerance at H = 0.4 to 0.7; outside tolerance at H = 1"
    assert row.answer.startswith("Within tolerance for 0.01 ≤ Fbar < 0.1: ")
    assert "outside tolerance for 0.001 ≤ Fbar < 0.01 (H = 1 alone) and for 1 ≤ Fbar ≤ 10: " in row.answer
    assert "inconclusive for 0.1 ≤ Fbar < 1 (H = 0.4 alone): " in row.answer
    text = html_of(punch(*by_hurst()))
    assert text.count('<span class="alone">H = 1 alone</span>') == 1
    assert "Fbar, 0.1 to 1: within tolerance at H = 0.55 to 1; inconclusive at H = 0.4." in text


@catches("neighbours that share a value").at(
    f"{__name__}.plain", lambda rows: [{**row, "strip": []} for row in first_screen.plain(rows)]
)
def test_the_table_of_the_readme_names_them_and_its_ranges_share_no_value():
    (row,) = (row for row in plain([mean_stiffness(*by_hurst())]))
    _, answer, over, _ = runpy.run_path(str(ROOT / ".ci" / "readme.py"))["cells"](json.loads(json.dumps(row)))
    assert (over, answer) == (
        "F̄",
        "**In part.** within tolerance: 0.01 ≤ F̄ < 0.1; inconclusive: 0.1 ≤ F̄ < 1 (H = 0.4 alone); "
        "outside tolerance: 0.001 ≤ F̄ < 0.01 (H = 1 alone) and 1 ≤ F̄ ≤ 10",
    )


def test_what_is_an_ensemble_mean_is_called_one():
    """And nothing on the page answers for a single surface before it was solved."""
    rows = answered_questions([punch(*by_hurst())])
    assert all("ensemble" in row.question.asks for row in rows)
    assert {row["of"] for row in plain(rows)} == {"ensemble mean"}
    section = replace(punch(*by_hurst()), needed="the model of an estimate")
    assert "the model of an estimate" not in html_of(section)
    kept = case_results(section)
    assert kept["model_needed"] == kept["model needed"] == "the model of an estimate"
    assert "single surface" in kept["model_needed_is"] and "before a solve" in kept["model_needed_is"]


# --- what else ---


def test_an_alternative_is_offered_where_its_own_numbers_agree():
    def fit(value, half=0.0):
        return at((0.3, 10.0), value, half, model="fit", tolerance=0.5)

    failing, agreeing = at((1.0, 10.0), -1.2), at((0.1, 1.0), 0.1)
    row = row_of("mean-stiffness", punch(failing, fit(0.2)), timed())
    formula, bem = row.instead
    assert formula[:2] == ("the fit 1/kbar = 1/1.1523 + 0.48/Fbar for 0.3 ≤ Fbar ≤ 10, within 6 %", "a formula")
    assert bem == ("boundary elements", "5.8 ms a surface and load, 32 a side", "precision")
    for row in (mean_stiffness(failing, fit(0.2, 0.4)), mean_stiffness(failing)):
        assert row.instead == (("boundary elements", "", ""),)
    assert mean_stiffness(agreeing, fit(0.2)).instead == ()
    assert len(mean_stiffness(agreeing, failing, fit(0.2)).instead) == 2


def test_boundary_elements_cost_what_the_coarsest_grid_that_is_enough_does_or_the_finest():
    evidence = timed().evidence
    assert seconds.a_surface("mean stiffness")(evidence) == "5.8 ms a surface and load, 32 a side"
    assert seconds.a_surface()(evidence) == "53 ms a surface and load, 256 a side"
    assert seconds.a_surface("mean gap")(evidence) == ""


def test_an_alternative_on_an_axis_of_its_own_says_which():
    """Springs that read the surface, in motion on a rail, by the rms over bands."""
    of_wheel = {"quantity": LEVEL_OF_WHEEL, "tolerance": 1.0, "where": {"range": "region 2"}}
    failing = at((0.1, 1.0), 9.0, **of_wheel | {"model": OVER_BEM[GEIKE]})
    found = {"h/d": [0.1], "h' a/d": [0.37]}
    wheel = section_of("wheel_3d", [failing], Table("wheel", found))
    moving = {"quantity": RMS + BESIDE, "model": SPRINGS_OVER_BEM, "tolerance": 1.0}
    where = {RAIL: BEAM, OFFSET: 0.0, "f [Hz]": (100.0, 900.0)}
    rail = section_of("rail_dynamic", [at((0.1, 1.0), 0.2, **moving | {"where": where})])
    row = row_of("dynamic-wheel", wheel, rail, timed())
    assert words_of(row) == ["outside"]
    assert row.measured == "h' a/d = 0.37"
    on_rail, in_time = row.instead
    assert on_rail[0].endswith("in the time loop at 0 dB over ISO 3095, within 1 dB rms over bands")
    assert on_rail[1:] == ("", "rail_dynamic")
    assert in_time == ("boundary elements in the time loop", "55 s a wheel of Fig. 14.4", "precision")


# --- what is not there ---


def test_a_case_that_was_not_run_or_has_no_number_says_so():
    found = {row.question.name: row for row in answered_questions([punch(at((0.1, 1.0), 0.0))])}
    assert found["contact-filter"].word == "Not run"
    assert "across" in found["contact-filter"].answer
    assert found["scatter"].word == "Not measured"
    assert not found["contact-filter"].strip
    lost = Section("fractal_punch", CASES["fractal_punch"], "none", {}, None, ("surface 1",))
    assert row_of("mean-stiffness", lost).word == "No result"


def test_a_report_without_any_of_the_cases_has_no_rows():
    other = section_of("geike", [number()])
    assert answered_questions([other]) == [] and 'id="answers"' not in html_of(other)


# --- every row finds its numbers ---

OF_SPRINGS = "springs over boundary elements"
SOURCES = {
    "mean-stiffness": ("fractal_punch", "mean stiffness", OF_SPRINGS, "Fbar"),
    "scatter": ("fractal_punch", "relative deviation", OF_SPRINGS, "Fbar"),
    "roll-off": ("interface", "stiffness", OF_SPRINGS, "contact in Persson's theory [%]"),
    "rolling-rms": ("rolling", "rms force", OF_SPRINGS, "h' a/d"),
    "rolling-spectrum": ("rolling", "rms of level of an octave", OF_SPRINGS, "h' a/d"),
    "contact-filter": ("across", "A3 over that of boundary elements", "linear, on the line", "across"),
    "dynamic-wheel": ("wheel_3d", "level", "springs, Geike's rule over boundary elements", "range"),
}
INSTEAD = {
    ("mean-stiffness", "the fit"): ("fractal_punch", "mean stiffness", "fit"),
    ("rolling-rms", "linear filter, 3D"): ("rolling", "rms force", "linear filter, 3D over boundary elements"),
    ("rolling-spectrum", "linear filter, 3D"): (
        *("rolling", "rms of level of an octave", "linear filter, 3D over boundary elements"),
    ),
    ("rolling-spectrum", "boundary elements, 4 cells"): (
        "reduced_models",
        "rms over octaves of the level over boundary elements",
        "boundary elements, 1/3 of the cells",
    ),
    ("contact-filter", "linear, ellipse"): ("across", "A3 over that of boundary elements", "linear, ellipse"),
    ("contact-filter", "spring bed"): ("across", "A3 over that of boundary elements", "spring bed wider by 2/√3"),
    ("rolling-spectrum", "springs, rolling spectrum"): (
        *("rolling", "rms of level of an octave", "springs, rolling spectrum over boundary elements"),
    ),
    ("dynamic-wheel", "springs, rolling spectrum"): (
        *("wheel_3d", "level", "springs, rolling spectrum over boundary elements"),
    ),
    ("dynamic-wheel", "linear filter, 3D"): ("wheel_3d", "level", "linear filter, 3D over boundary elements"),
    ("dynamic-wheel", "on a rail"): (
        "rail_dynamic",
        "rms of filter in motion, of two models",
        "springs that read the surface over boundary elements",
    ),
}


def test_a_question_is_answered_by_the_quantity_that_it_asks_for_and_so_is_what_else_is_offered():
    """By the names in the data, written out."""
    sources = {question.name: question.source for question in QUESTIONS}
    assert {name: (one.case, one.quantity, one.model, one.axis) for name, one in sources.items()} == SOURCES
    offered = {
        key: (other.source.case, other.source.quantity, other.source.model)
        for question in QUESTIONS
        for other in question.instead
        if other.source
        for key in INSTEAD
        if key[0] == question.name and other.name.startswith(key[1])
    }
    assert offered == INSTEAD
    assert sum(other.source is not None for question in QUESTIONS for other in question.instead) == len(INSTEAD)


def rolling(quantity, model, value, half=0.1):
    where = {"h/d": 0.1, "h' a/d": 0.27} | ({"q a": (1.0, 10.0)} if quantity == RMS_LEVEL else {})
    settings = {"reference": 0.0, "tolerance": 3.0, "sample": half, "role": Role.FINDING}
    planted = number(value, quantity=quantity, model=model + OVER_ROLLED, where=where, **settings)
    return section_of("rolling", [planted], hurst=0.7)


@pytest.mark.parametrize(("name", "quantity"), [("rolling-rms", RMS_FORCE), ("rolling-spectrum", RMS_LEVEL)])
def test_a_rolling_wheel_is_judged_over_its_slope(name, quantity):
    row = row_of(name, rolling(quantity, SPRINGS, -30.0))
    assert strip_of(row)[1] == ("0.27", "outside") and row.answer.startswith("Outside tolerance at h' a/d = 0.27")
    assert row.measured.endswith("H = 0.7")


def test_numbers_of_another_model_are_no_answer():
    assert row_of("rolling-spectrum", rolling(RMS_LEVEL, LINEAR_3D, 0.0)).word == "Not measured"


@catches("cells that overlap").at(
    "validation.report.answers.strip._joined_overlaps", lambda found: dict(sorted(found.items()))
)
def test_ranges_that_overlap_are_one_cell():
    """One H was measured less far than the other: both are numbers of the same cell."""
    numbers = [
        at(decade, value, hurst=hurst)
        for hurst, last, value in ((0.4, 2.15, 20.0), (0.7, 10.0, -6.0))
        for decade in ((0.1, 1.0), (1.0, last))
    ]
    assert [place for place, _ in strip_of(mean_stiffness(*numbers))] == ["< 0.1", "0.1 to 1", "1 to 10", "> 10"]


apart = strip._joined_overlaps


def last_of_those_that_join(found):
    return {place: numbers[-1:] for place, numbers in apart(found).items()}


@catches("numbers dropped where ranges join", off=0).at(
    "validation.report.answers.strip._joined_overlaps", last_of_those_that_join
)
@pytest.mark.parametrize("off", range(4))
def test_ranges_that_join_keep_all_of_their_numbers(off):
    """Of each range: whichever of the numbers differs, the joined place has its verdict and its size."""
    places = [(1.0, 2.15), (1.0, 4.64), (1.0, 10.0), (2.15, 10.0)]
    numbers = [
        at(place, 3.0 if i == off else 0.0, hurst=hurst)
        for i, (place, hurst) in enumerate(zip(places, (0.4, 0.55, 0.7, 1.0), strict=True))
    ]
    row = mean_stiffness(*numbers)
    assert strip_of(row)[1:-1] == [("1 to 10", "outside")] and ": off by +41 %." in row.answer
    (cell,) = row.question.source.cells(punch(*numbers).evidence)
    assert sorted(number.where["H"] for number in cell.numbers) == [0.4, 0.55, 0.7, 1.0]
    assert cell.alone == f"H = {(0.4, 0.55, 0.7, 1.0)[off]:g} alone"


def test_a_range_within_another_does_not_shorten_it():
    """One H has a part of what another was measured over."""
    numbers = [at((1.0, 10.0), 0.0, hurst=0.4), at((2.15, 4.64), 0.0, hurst=0.7), at((10.0, 100.0), 0.0, hurst=0.4)]
    places = [place for place, _ in strip_of(mean_stiffness(*numbers))]
    assert places == ["< 1", "1 to 10", "10 to 1e+02", "> 1e+02"]


def test_differences_below_and_above_are_told_apart():
    """What differs is nowhere near zero: a single range would say that it were."""
    row = mean_stiffness(*(at((0.1, 1.0), value, hurst=value) for value in (-3.0, -2.0, 2.0, 3.0)))
    assert "off by -29 to -21 % and +26 to +41 %" in row.answer
    assert ": off by -29 %." in mean_stiffness(at((0.1, 1.0), -3.0)).answer
    both = mean_stiffness(at((0.1, 1.0), -3.0, hurst=0.4), at((0.1, 1.0), 0.0))
    assert ": off by -29 %." in both.answer


def test_a_rail_is_judged_by_what_lies_across_from_ridges_to_isotropic_ground():
    def off(ground, value, offset=0.0):
        where = {"wheel": "50 kN, 920 mm", OFFSET: offset, "across": ground, "wavelength [mm]": (8.0, 100.0)}
        model, quantity = across.LINES[0], rolled_filters.OVER_BEM
        return at((0.1, 1.0), value, where=where, quantity=quantity, model=model, tolerance=1.0)

    numbers = [off("ridges", 0.1), off("alpha = 1", 2.0), off("isotropic ground", 3.0), off("ridges", 9.0, offset=10.0)]
    row = row_of("contact-filter", section_of("across", numbers))
    assert strip_of(row) == [("ridges", "within"), ("alpha = 1", "outside"), ("isotropic ground", "outside")]


def test_springs_are_asked_for_no_contact_area_and_no_gap():
    """They have neither."""
    assert not any("area" in question.asks or "gap" in question.asks for question in QUESTIONS)


def test_the_scatter_has_numbers_of_its_own():
    found = punch(at((0.1, 1.0), 0.0), at((0.1, 1.0), -30.0, quantity=DEVIATION))
    assert [row_of(name, found).word for name in ("scatter", "mean-stiffness")] == [
        "Outside tolerance",
        "Within tolerance",
    ]


# --- words ---


@catches("the power of a ratio printed for its amplitude").at(
    "validation.analysis.number_text.DECIBEL", statistics.POWER_DECIBEL
)
def test_decibels_are_printed_as_their_quantity():
    assert level_in_per_cent(TEN) == "+10 %"
    assert level_in_per_cent(-1e-9) == "+0 %"
    assert level_as_factor(20.0) == "10 times"
    assert level_as_factor(51.0) == "350 times"
    assert level_in_decibels(-0.01) == "+0 dB"
    assert from_to([2.5, -1.0], level_in_decibels) == "-1 to +2.5 dB"
    assert from_to([2.0], level_in_decibels) == "+2 dB"


AGREES, DIFFERS, UNDECIDED = (0.0, 0.0), (9.0, 0.0), (0.0, 9.0)
"""Value and half-width."""
YES, NO, OPEN = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE


def enough_unless_it_differs(cell):
    """What is undecided taken for what agrees."""
    right = verdict_of_a_cell(cell)
    return Verdict.WITHIN if right is Verdict.INCONCLUSIVE and not cell.lacking else right


verdict_of_a_cell = strip.Cell.verdict.fget


@catches(
    "a place with one number that is undecided under a yes", found=[AGREES, UNDECIDED], verdict=Verdict.INCONCLUSIVE
).at("validation.report.answers.strip.Cell.verdict", property(enough_unless_it_differs))
@pytest.mark.parametrize(
    ("found", "verdict"),
    [
        ([AGREES, AGREES], YES),
        ([AGREES, UNDECIDED, DIFFERS], NO),
        ([UNDECIDED, DIFFERS], NO),
        ([AGREES, UNDECIDED], OPEN),
        ([UNDECIDED, AGREES, AGREES], OPEN),
    ],
)
def test_a_cell_says_yes_only_where_all_agree_and_nothing_lacks(found, verdict):
    numbers = [at((0.1, 1.0), *one, hurst=i / 10) for i, one in enumerate(found)]
    assert Cell(0.1, tuple(numbers)).verdict is verdict
    assert Cell(0.1, tuple(numbers), lacking=1).verdict is (NO if verdict is NO else OPEN)
    row = mean_stiffness(*numbers)
    assert row.word.lower() == verdict and words_of(row)[1] == verdict.removesuffix(" tolerance")
    # beside a place that is inconclusive
    both = mean_stiffness(*numbers, *(at((1.0, 10.0), *UNDECIDED, hurst=i / 10) for i in range(len(found))))
    assert both.word == {YES: "In part", NO: "Outside tolerance or inconclusive", OPEN: "Inconclusive"}[verdict]


@pytest.mark.parametrize(
    ("places", "name", "said"),
    [
        ((-10.0, 10.0), OFFSET, "-10 to 10 dB over ISO 3095"),
        ((5.0,), OFFSET, "5 dB over ISO 3095"),
        ((0.01, 0.3), "h/d", "h/d = 0.01 to 0.3"),
        (("region 2", "region 3"), "the spectrum", "region 2 and region 3"),
    ],
)
def test_a_range_has_the_name_of_its_axis_and_the_unit_behind(places, name, said):
    assert span(places, name) == said
