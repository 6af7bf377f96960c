"""The front page: seconds at equal error, the figures of the book, contact filters, and how much there is to read."""

import math
import re
from dataclasses import replace

import pytest

from tests.report.remade import remade
from tests.report.test_claims import claim, section_of
from tests.report.test_printed import html_of
from tests.seeded import catches
from validation.analysis.evidence import Table, Verdict, VerdictCell, Whose
from validation.benchmarks.work_precision.case import POINTS
from validation.benchmarks.work_precision.pareto import FASTER
from validation.benchmarks.work_precision.problem import RollingProblem, RoughPunchProblem
from validation.cases.limits.limits import SUMMARY
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


def test_springs_alone_are_said_to_be_so_much_faster():
    found = [("springs", 13.9), ("other", 2.0), ("springs, rolling spectrum", 843.0)]
    rows = [{"model": model, "times faster": times, "enough": "within tolerance"} for model, times in found]
    rows += [{"model": "springs", "times faster": 9999.0, "enough": no} for no in ("outside tolerance", "inconclusive")]
    said = "Where springs are within 10 % or 1 dB, they are 14 to 840 times faster than boundary elements"
    assert times_faster_said(rows) == said
    assert times_faster_said(rows[1:2]) == ""


def timed(unit="%", value=3.5, half=0.5, end=4.0, scene="wheel"):
    """A model of 120 µs, whose error with its interval is as large as that of boundary elements of 120 ms."""
    row = {"scene": scene, "quantity": "rms", "model": "springs", "unit": unit, "error": end, "seconds": 1.2e-4}
    more = {"error of boundary elements": 3.0, "seconds of boundary elements": 0.12}
    table = Table(
        FASTER, {n: [v] for n, v in (row | more | {"times faster": 1000.0, "from": 900.0, "to": 1100.0}).items()}
    )
    scale = 1.0 if unit == "dB" else 100.0
    points = {
        "scene": [scene, scene, "another"],
        "quantity": 3 * ["rms"],
        "method": 3 * ["springs"],
        "median [s]": [1e-5, 1.2e-4, 1.2e-4],
        "error": [0.9, value / scale, 0.9],
        "± sample": [0.9, half / scale, 0.9],
    }
    section = section_of(claim([Verdict.WITHIN]))
    settings = {
        "fractal": {"force": 0.1},
        "rolling": {"hurst": 0.7, "height": 0.1, "last": 10.0},
    }
    precision = replace(section, name="precision", entry=TIMED["precision"], settings=settings)
    return replace(precision, evidence=replace(section.evidence, tables=(table, Table(POINTS, points))))


def test_seconds_at_equal_error_stand_on_the_page():
    text = html_of(timed())
    assert re.search(r"<b>1000</b> \(900 to 1.1e\+03\)|<b>1000</b> \(900 to 1100\)", text)
    assert "3.50 ± 0.50 %, 120 µs" in text and "3 %, 120 ms" in text


@catches("the end of an interval for the error", *("dB", 0.65, 0.85, 1.5, "inconclusive")).at(
    "validation.report.answers.front_tables.ENOUGH", {"%": 0.0, "dB": -1.0}
)
@pytest.mark.parametrize(
    ("unit", "value", "half", "end", "verdict"),
    [
        ("%", 9.0, 1.0, 10.0, "within tolerance"),
        ("%", 9.0, 1.1, 10.1, "inconclusive"),
        # a finer setting that has a larger error
        ("%", 9.0, 0.5, 30.0, "inconclusive"),
        ("%", 12.0, 1.9, 13.9, "outside tolerance"),
        # across the tolerance from above
        ("%", 12.0, 2.5, 14.5, "inconclusive"),
        ("dB", 1.2, 0.3, 1.5, "inconclusive"),
        ("dB", 0.65, 0.85, 1.5, "inconclusive"),
        ("dB", 0.65, 0.35, 1.0, "within tolerance"),
        ("dB", 4.8, 0.4, 5.2, "outside tolerance"),
    ],
)
def test_a_model_is_no_less_within_tolerance_in_one_table_than_in_the_next(unit, value, half, end, verdict):
    """An interval across the tolerance decides nothing: the linear filter in 3D is no counterexample of itself."""
    (row,) = times_faster([timed(unit, value, half, end)])
    assert (row["enough"], row["value"], row["half"]) == (verdict, pytest.approx(value), pytest.approx(half))
    assert f'<td data-of="Verdict">{verdict}</td>' in html_of(timed(unit, value, half, end))


@pytest.mark.parametrize(
    ("scene", "place"),
    [("wheel", ""), (RoughPunchProblem.name, "Fbar = 0.1"), (RollingProblem.name, "h' a/d = 0.19")],
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
