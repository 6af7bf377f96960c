"""The front page: seconds at equal error, the figures of the book, contact filters, and how much there is to read."""

import re
from dataclasses import replace

import pytest

from tests.report.remade import remade
from tests.report.test_claims import claim, section_of
from tests.report.test_printed import html_of
from validation.analysis.evidence import Table, Verdict, VerdictCell, Whose
from validation.benchmarks.work_precision.faster import FASTER
from validation.cases.limits.limits import SUMMARY
from validation.cases.rail.across_study import LOUDER
from validation.report.answers.failures import failures
from validation.report.answers.front_tables import OF_A3, WORST, rail_filters, right_filters, times_faster_said
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
    found = [("springs", 13.9, True), ("other", 2.0, True), ("springs, rolling spectrum", 843.0, True)]
    rows = [{"model": model, "times faster": times, "enough": enough} for model, times, enough in found]
    rows.append({"model": "springs", "times faster": 9999.0, "enough": False})
    said = "Where springs are within 10 % or 1 dB, they are 14 to 840 times faster than boundary elements"
    assert times_faster_said(rows) == said
    assert times_faster_said(rows[1:2]) == ""


def test_seconds_at_equal_error_stand_on_the_page():
    row = {"scene": "wheel", "quantity": "rms", "model": "springs", "unit": "%", "error": 4.0, "seconds": 1.2e-4}
    more = {"error of boundary elements": 3.0, "seconds of boundary elements": 0.12}
    table = Table(
        FASTER, {n: [v] for n, v in (row | more | {"times faster": 1000.0, "from": 900.0, "to": 1100.0}).items()}
    )
    section = section_of(claim([Verdict.AGREE]))
    timed = replace(section, name="precision", entry=TIMED["precision"])
    text = html_of(replace(timed, evidence=replace(section.evidence, tables=(table,))))
    assert re.search(r"<b>1000</b> \(900 to 1.1e\+03\)|<b>1000</b> \(900 to 1100\)", text)
    assert "4 %, 120 µs" in text and "3 %, 120 ms" in text


@pytest.mark.parametrize("figure", BOOK_FIGURES, ids=lambda figure: figure.place)
def test_a_figure_of_the_book_has_claims_and_a_figure_of_ours(figure):
    drawing(figure.drawn)
    tests = [test for test in (figure.computed, figure.confirmed) if test]
    for test in tests:
        claims = [one.says for one in CASES[test.case].study.claims]
        assert sum(test.claim in one for one in claims) == 1


def test_a_figure_of_the_book_has_the_status_of_its_claims():
    held = replace(claim([Verdict.AGREE]), claim="The peak of Fig. 14.4 is there.", whose=Whose.BOOK)
    ((row, computed, confirmed),) = book_figures([section_of(held, name="wheel")])
    assert (row.place, computed.status, confirmed) == ("Fig. 14.4", "holds", None)


def test_a_filter_is_right_where_it_agrees_over_all_grounds():
    agree, differ = VerdictCell("+0.1 dB", Verdict.AGREE), VerdictCell("+3 dB", Verdict.DIFFER)
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
    section = section_of(claim([Verdict.AGREE]), name="across")
    table = rail_filters([replace(section, evidence=replace(section.evidence, page_tables=(worst, loud)))])
    assert right_filters(table) == "two"
    assert right_filters(Table("none", {"filter": ["one"], f"{WORST} ridges": ["-"]})) == ""
    # rows by their names, of two tables in different order
    assert table.columns["rms force over isotropic ground [dB(A)]"] == ["3", "4"]
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
    section = section_of(claim([Verdict.AGREE]))
    table = Table(SUMMARY, cells)
    edge, strip = failures([replace(section, name="limits", evidence=replace(section.evidence, tables=(table,)))])
    assert list(edge.values()) == ["edge of the grid", "side / 2 a < 1", "force above 0.001", "EdgeWarning"]
    assert list(strip.values()) == ["rolling: strip", "width / 2 a < 1", "force above 0.01", "none"]
