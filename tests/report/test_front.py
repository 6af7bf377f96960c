"""The front page: seconds at equal error, the figures of the book, contact filters, and how much there is to read."""

import math
import re
from dataclasses import replace

import pytest

from tests.report.remade import remade
from tests.report.test_claims import claim, section_of
from tests.report.test_printed import html_of
from tests.seeded import catches
from validation.analysis.evidence import Number, Table, Verdict, VerdictCell, Whose, table_of
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS
from validation.benchmarks.work_precision.pareto import CHEAPEST_SETTING, FACTOR, SHOWN, TOLERANCES
from validation.benchmarks.work_precision.problem import (
    BEM_METHOD,
    RolledOffPunchProblem,
    RollingProblem,
    RoughPunchProblem,
)
from validation.cases.limits.limits import SUMMARY
from validation.cases.wheel.ensembles import LEVEL
from validation.cases.wheel.half_space import GEIKE, OVER_BEM
from validation.cases.wheel.half_space_study import WHEEL
from validation.railway.cases.across_study import LOUDER
from validation.railway.front_page import OF_A3, WORST, rail_filters, right_filters
from validation.report.answers.front_tables import failures, times_faster, times_faster_said
from validation.report.chapter import BOOK_FIGURES, book_figures
from validation.report.contents import CASES, TIMED
from validation.report.figures import drawing

MOST_WORDS = 3000


def visible(text):
    """Of a page, without what is folded, its navigation and its style."""
    main = text[text.index("<main") : text.index("</main>")]
    while (shorter := re.sub(r"<details(?:(?!<details).)*?</details>", " ", main, flags=re.DOTALL)) != main:
        main = shorter
    return re.sub(r"<[^>]+>", " ", main).split()


@pytest.mark.slow
def test_the_front_page_of_the_reference_report_is_read_in_ten_minutes():
    assert 1000 < len(visible(remade()["index.html"])) <= MOST_WORDS


WITHIN, OUTSIDE, OPEN = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE


def fast(method, factor, verdict=WITHIN, elements=WITHIN, meets=True):
    return {"method": method, FACTOR: factor, "verdict": verdict, "a setting within": meets} | {
        "elements": {"verdict": elements} if elements else None
    }


@catches("another model counted as springs").at(
    "validation.report.answers.front_tables.SPRINGS", ("springs", "other", "springs, rolling spectrum")
)
def test_springs_alone_are_said_to_be_so_much_faster_where_both_are_within_the_tolerance():
    rows = [fast("springs", 13.9), fast("other", 2.0), fast("springs, rolling spectrum", 843.0)]
    rows += [
        fast("springs", 9999.0, OUTSIDE, meets=False),
        fast("springs", 9999.0, OPEN),
        fast("springs", 1.0, elements=OPEN),
    ]
    rows += [fast("springs", math.nan, elements=None)]
    said = "Within 10, 3 or 1 % (3 or 1 dB) springs are 14 to 840 times faster than boundary elements"
    assert times_faster_said(rows) == said
    assert times_faster_said(rows[:1]) == said.replace("14 to 840", "14")
    assert times_faster_said(rows[1:2]) == ""


SETTING = {"setting": "16 springs a side", "time [s]": 1.2e-4, "time from [s]": 1e-4, "time to [s]": 1.4e-4}
ELEMENTS = {"setting": "BEM, finer cells: 32 cells a side", "time [s]": 0.12, "time from [s]": 0.1, "time to [s]": 0.14}
CLOSED_FORM = "square punch"


def timed(unit="%", value=3.5, half=0.5, verdict=WITHIN, scene=RoughPunchProblem.name, meets=True):
    """A model of 120 µs beside boundary elements of 120 ms, at two tolerances; and a scene with a closed form."""
    rows = []
    for of_scene, tolerance in ((scene, TOLERANCES[unit][0]), (scene, TOLERANCES[unit][1]), (CLOSED_FORM, 0.1)):
        common = {"scene": of_scene, "quantity": "rms", "unit": unit, "tolerance": SHOWN[unit] * tolerance}
        inside = meets if tolerance == TOLERANCES[unit][0] else False
        factor = dict(zip((FACTOR, "factor from", "factor to"), (1000.0, 900.0, 1100.0), strict=True))
        error = {"error": value, "± sample": half, "± reference": 0.0}
        none = dict.fromkeys(factor, math.nan)
        rows.append(
            {**common, "method": "springs", **error, "verdict": verdict, **SETTING, **(factor if inside else none)}
        )
        rows[-1]["a setting within"] = inside
        error = {"error": 2.5, "± sample": 0.25, "± reference": 0.25}
        rows.append({**common, "method": BEM_METHOD, **error, "verdict": WITHIN, **ELEMENTS, **none})
        rows[-1]["a setting within"] = True
    steps = {"method": ["springs", "boundary elements"], "a/dx": [100, 40]}
    hours = {"Fig. 14.4 [h]": [0.001, 4.0], "from [h]": [0.0008, 3.0], "to [h]": [0.0016, 6.0]}
    section = section_of(claim([Verdict.WITHIN]))
    rolled_off = {"hurst": 0.7, "waves": 16, "roll_off": 4, "force": 2.36}
    settings = {
        "fractal": {"force": 0.1},
        "rolled_off": rolled_off,
        "rolling": {"hurst": 0.7, "height": 0.1, "last": 10.0},
    }
    precision = replace(section, name="precision", entry=TIMED["precision"], settings=settings)
    tables = table_of(CHEAPEST_SETTING, rows), Table(COST_OF_STEPS, {**steps, "one wheel [s]": [0.01, 50.0], **hours})
    return replace(precision, evidence=replace(section.evidence, tables=tables))


def test_times_within_the_same_tolerance_stand_on_the_page():
    text = html_of(timed())
    assert re.search(r"<b>1000</b> \(900 to 1.1e\+03\)|<b>1000</b> \(900 to 1100\)", text)
    assert "3.50 ± 0.50 %, within tolerance" in text and "120 µs (100 µs to 140 µs), 16 springs a side" in text
    assert "2.50 ± 0.50 %, within tolerance; 120 ms (100 ms to 140 ms), BEM, finer cells: 32 cells a side" in text
    assert "no setting within" in html_of(timed(meets=False))


def test_a_row_has_a_setting_within_its_tolerance_or_is_the_one_that_has_none():
    """Scenes with a closed form are no questions."""
    assert [(row["scene"], row["tolerance"], row["a setting within"]) for row in times_faster([timed()])] == [
        (RoughPunchProblem.name, 10.0, True)
    ]
    (row,) = times_faster([timed(meets=False, verdict=OUTSIDE)])
    assert not row["a setting within"] and row["elements"]["setting"] == ELEMENTS["setting"]
    (row,) = times_faster([timed("dB")])
    assert (row["unit"], row["tolerance"]) == ("dB", 3.0)


@catches("an error of the dynamic wheel that is left out").at(
    "validation.report.answers.front_tables.worst", lambda numbers: numbers[0]
)
def test_the_dynamic_wheel_has_a_row_with_the_error_of_its_worst_band():
    """4 h beside 0.001 h; the ends of both intervals; not within 3 dB in region 2."""
    common = {"quantity": LEVEL, "model": OVER_BEM[GEIKE], "reference": 0.0, "tolerance": 1.0, "reason": "made up"}
    numbers = [
        Number(**common, source="BEM", value=value, unit="dB", sample=0.5, grid=0.25, where={"range": place})
        for place, value in (("region 3", 2.0), ("region 2", -38.0))
    ]
    section = section_of(claim([Verdict.WITHIN]), name="wheel_3d")
    scene = Table(WHEEL, {"h/d": [0.1], "h' a/d": [0.37]})
    wheel = replace(section, evidence=replace(section.evidence, numbers=tuple(numbers), tables=(scene,), claims=()))
    row = times_faster([timed(), wheel])[-1]
    assert (row["scene"], row["place"], row["error"], row["verdict"]) == ("dynamic wheel", "Fig. 14.4", -38.0, OUTSIDE)
    assert (row[FACTOR], row["factor from"], row["factor to"]) == pytest.approx((4000, 3 / 0.0016, 6 / 0.0008))
    assert row["time [s]"] == 3.6 and row["elements"]["time to [s]"] == 6 * 3600
    assert times_faster_said([row]) == ""
    assert "-38.00 ± 0.75 dB, outside tolerance" in html_of(timed(), wheel)
    assert len(times_faster([timed()])) == 1


@pytest.mark.parametrize(
    ("scene", "place"),
    [
        (RoughPunchProblem.name, "Fbar = 0.1"),
        (RolledOffPunchProblem.name, "10 % contact in Persson's theory"),
        (RollingProblem.name, "h' a/d = 0.19"),
    ],
)
def test_seconds_are_of_a_place_on_the_axis_of_the_answers(scene, place):
    """g^2 = int q^3 C_2D = h^2 2 H (last^(2 - 2 H) - 1) / ((2 - 2 H) (1 - last^(-2 H))), half of it along a line."""
    (row,) = times_faster([timed(scene=scene)])
    assert row["place"] == place
    hurst, last = 0.7, 10.0
    gradient = 0.1**2 * 2 * hurst * (last ** (2 - 2 * hurst) - 1) / ((2 - 2 * hurst) * (1 - last ** (-2 * hurst)))
    if scene == RollingProblem.name:
        assert f"{math.sqrt(gradient / 2):.2g}" in place


@pytest.mark.parametrize("figure", BOOK_FIGURES, ids=lambda figure: figure.place)
def test_a_figure_of_the_book_has_claims_and_a_figure_of_ours(figure):
    drawing(figure.drawn)
    tests = [test for test in (figure.computed, figure.confirmed) if test]
    for test in tests:
        assert test.claim in [one.key for one in CASES[test.case].study.claims]


def test_a_figure_of_the_book_has_the_status_of_its_claims():
    held = replace(
        claim([Verdict.WITHIN]), key="peak-and-jump", claim="The peak of Fig. 14.4 is there.", whose=Whose.BOOK
    )
    ((row, computed, confirmed),) = book_figures([section_of(held, name="wheel")])
    assert (row.place, computed.status, confirmed) == ("Fig. 14.4", "supported", None)


def test_a_filter_is_right_where_it_agrees_over_all_grounds():
    agree, differ = VerdictCell("+0.1 dB", Verdict.WITHIN), VerdictCell("+3 dB", Verdict.OUTSIDE)
    worst = Table(
        f"{OF_A3}, a wheel",
        {
            "model": ["one", "two"],
            "ridges": [agree, agree],
            "alpha = 8": [differ] * 2,
            "isotropic ground": [differ, agree],
        },
    )
    loud = Table(LOUDER, {"model": ["two", "one"], "ridges": ["2", "1"], "isotropic ground": ["4", "3"]})
    section = section_of(claim([Verdict.WITHIN]), name="across")
    table = rail_filters([replace(section, evidence=replace(section.evidence, page_tables=(worst, loud)))])
    assert right_filters(table) == "two"
    assert right_filters(Table("none", {"filter": ["one"], f"{WORST} ridges": ["-"]})) == ""
    # rows by their names, of two tables in different order
    assert table.columns["sound power, isotropic ground [dB(A)]"] == ["3", "4"]
    assert table.name.endswith(": a wheel")


def test_boundary_elements_fail_where_their_limits_say():
    cells = {
        "limit": [
            "springs: the last asperity",
            "boundary elements: edge of the grid",
            "boundary elements, rolling: strip",
        ],
        "fails where": ["springs in contact < 8: so many", "side / 2 a < 1: side = 2 a", "width / 2 a < 1: as: wide"],
        "error": ["stiffness above 0.05", "force above 0.001; reference: a wider grid", "force above 0.01"],
        "message of the software": ["none", "EdgeWarning: widen the grid", "none"],
    }
    section = section_of(claim([Verdict.WITHIN]))
    table = Table(SUMMARY, cells)
    edge, strip = failures([replace(section, name="limits", evidence=replace(section.evidence, tables=(table,)))])
    assert list(edge.values()) == ["edge of the grid", "side / 2 a < 1", "force above 0.001", "EdgeWarning"]
    assert list(strip.values()) == ["rolling: strip", "width / 2 a < 1", "force above 0.01", "none"]
