"""The pages lead to each other, and figures can be found, cited and drawn again."""

import re
from dataclasses import replace

import pytest

from tests.report.accessibility import faults
from tests.report.test_command_line import SMALL
from tests.report.test_printed import ABOUT, evidence_with, number
from tests.seeded import catches
from validation import __main__ as command
from validation.analysis.contents import as_csv, from_csv
from validation.analysis.evidence import JudgedClaim, Role, Table, Verdict, VerdictCell
from validation.report import page
from validation.report.contents import CASES
from validation.report.formats import format_field, map_of
from validation.report.page import PageFigure
from validation.report.redraw import redraw
from validation.report.section import Section
from validation.report.style import picture

FIELDS = [VerdictCell("+1 %", Verdict.WITHIN), VerdictCell("+9 %", Verdict.OUTSIDE), "no value"]
MATRIX = Table("Deviation", {"H": ["0.4", "0.7", "1"], "Fbar 1 to 10": FIELDS, "Fbar 10 to 100": FIELDS[::-1]})


def section_of(name, *, criterion=1.0, **changes):
    finding = number(quantity="found", role=Role.FINDING)
    shown = evidence_with(
        [finding, number(criterion, quantity="checked")],
        page_tables=[MATRIX],
        claims=[JudgedClaim(claim="It is so.", answer="Yes: it is 1.", numbers=(finding,))],
    )
    shown = replace(shown, method="By hand.", captions={name: "(a) A curve. (b) Another."}, **changes)
    return Section(name, CASES[name], "none", {}, shown)


def pages_of(*sections):
    return {name: text.decode() for name, text in page.pages(sections, "full", ABOUT, None).items()}


def html_of(*sections):
    """Of a chapter."""
    return pages_of(*sections)["exact.html"]


def test_the_pages_lead_to_each_other():
    pages = pages_of(section_of("geike"), section_of("hertz", criterion=9.0), section_of("rolling"))
    assert list(pages) == ["exact.html", "rolling.html", "reading.html", "book.html", "index.html"]
    assert faults(pages) == []


@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ("<h1>", "<h1>x</h1><h1>", "not one h1"),
        ('id="figure-geike"', 'id="geike"', "id geike twice"),
        ('href="index.html#asked"', 'href="#nowhere"', "link to #nowhere"),
        ('href="exact.html#geike"', 'href="exact.html#nowhere"', "link to exact.html#nowhere"),
        ('<th scope="col">H', "<th>H", "header without a scope"),
    ],
)
def test_a_page_that_leads_nowhere_is_found(right, wrong, said):
    pages = pages_of(section_of("geike", title="Case"))
    assert right in pages["exact.html"]
    assert any(said in fault for fault in faults(pages | {"exact.html": pages["exact.html"].replace(right, wrong)}))


@pytest.mark.parametrize(("criterion", "said"), [(1.0, 0), (9.0, 1)])
def test_a_criterion_that_is_missed_is_said_above_the_figures(criterion, said):
    text = html_of(section_of("geike", criterion=criterion))
    assert text.partition("<figure")[0].count("Missed criterion:") == said


def test_the_first_figure_is_open_and_each_is_titled_by_its_finding():
    captions = {"geike": "A curve.", "hertz": "A sphere."}
    shown = section_of("geike", headlines={"geike": "Springs are 30 dB too quiet"})
    shown = replace(shown, evidence=replace(shown.evidence, captions=captions))
    assert re.findall(r'<p class="title">.*?</b> (.*?)</p>', html_of(shown)) == ["Springs are 30 dB too quiet"]
    folded = re.findall(r'<details class="figure"><summary><b>.*?</b> (.*?)</summary>', html_of(shown))
    assert folded == ["A sphere"]
    # what the case begins with is not said twice
    shown = replace(shown, evidence=replace(shown.evidence, finding="Springs are 30 dB too quiet."))
    assert html_of(shown).count("Springs are 30 dB too quiet.</b>") == 1 and "</b> Springs are" not in html_of(shown)


def test_figures_claims_tables_and_numbers_have_an_address():
    signs = re.findall(r'class="sign" href="#([^"]+)"', html_of(section_of("geike")))
    assert signs == ["geike", "figure-geike", "claim-geike-It_is_so.", "table-geike-Deviation", "numbers-geike"]


def test_a_table_of_verdicts_is_a_map_of_symbols_with_the_table_behind_it():
    found = map_of(MATRIX)
    fields = {place: "".join(re.findall(">(.)<", "".join(map(format_field, cells)))) for place, cells in found.rows}
    assert fields == {("0.4",): "✓–", ("0.7",): "≠≠", ("1",): "–✓"}
    assert found.summary == "2 within tolerance, 2 outside tolerance"
    text = html_of(section_of("geike"))
    assert text.count('<td class="outside" title="+9 %: outside tolerance">≠</td>') == 2
    assert text.index('class="map"') < text.index("Table behind it")


@pytest.mark.parametrize("columns", [{"H": ["0.4", "1"], "verdict": FIELDS[:2]}, {"H": ["1"], "a": ["b"]}])
def test_a_table_with_few_verdicts_stays_as_it_is(columns):
    assert map_of(Table("t", columns)) is None


CITATION = PageFigure.citation


@catches("a figure of a case that is kept is cited with today's commit").at(
    "validation.report.page.PageFigure.citation",
    lambda figure, about, profile: CITATION(figure, {**about, "kept": {}}, profile),
)
def test_a_figure_is_numbered_on_the_page_and_cited_by_name_version_and_commit():
    text = html_of(section_of("hertz"), section_of("geike"))
    assert text.index('id="figure-hertz"') < text.index('id="figure-geike"')
    figure = page.figures_of([section_of("hertz"), section_of("geike")])["geike"]
    cited = figure.citation(ABOUT, "full")
    assert cited in text and cited.startswith("Figure 2, in: ")
    assert cited.endswith("(mdr-validation 1.2.3, commit abc1234, profile full), exact.html#figure-geike")
    assert "commit 0ld0000, profile" in figure.citation({**ABOUT, "kept": {"geike": "0ld0000"}}, "full")
    assert "commit abc1234, profile" in figure.citation({**ABOUT, "kept": {"hertz": "0ld0000"}}, "full")


def test_of_a_scene_without_a_steady_answer_nothing_is_claimed_and_no_verdict_is_shown():
    shown = section_of("geike", headlines={"geike": "Springs agree"}).not_steady("it grows")
    text = html_of(shown)
    assert page.figures_of([shown])["geike"].finding == "A curve"
    assert shown.claims == () and shown.unconverged == ("no steady answer: it grows",)
    assert "no steady answer: it grows" in text and 'class="verdict within"' not in text and 'class="map"' not in text


def test_a_table_comes_back_from_its_file():
    values = {"x": [1.5, float("nan")], "n": [1, 2], "yes": [True, False], "name": ["a", ""]}
    back = from_csv("t", as_csv(Table("t", values)).decode())
    assert [type(column[0]) for column in back.columns.values()] == [float, int, bool, str]
    assert as_csv(back) == as_csv(Table("t", values)) == b"x,n,yes,name\n1.5,1,True,a\n,2,False,\n"
    assert as_csv(Table("t", {"x": [float("inf")]})) == b'x\n""\n'
    assert as_csv(Table("t", {"x": [2e9 / 3]})) == b"x\n666666666.7\n"


@pytest.mark.slow
def test_the_line_beside_a_figure_draws_it_again(tmp_path, monkeypatch):
    """From the files alone, and the same to the printed digit."""
    monkeypatch.setitem(CASES, "geike", replace(CASES["geike"], quick=SMALL["geike"]))
    assert command.main(["report", "--only", "geike", "--out", str(tmp_path), "--workers", "1"]) == 0
    text = (tmp_path / "exact.html").read_text(encoding="utf-8")
    linked = set(re.findall(r'href="(data/[^"]*\.csv)"', text))
    tables = ("C_1D_m3", "moment_over_that_of_the_surface", "numbers")
    assert linked == {f"data/geike-{table}.csv" for table in tables}
    assert all((tmp_path / path).exists() for path in (*linked, "data/columns.csv"))
    line = re.search(r"<code>(.*?)</code>", text)[1].replace("&#34;", '"')
    monkeypatch.chdir(tmp_path)
    exec(line)
    assert (tmp_path / "geike.pdf").stat().st_size > 1000
    assert picture(redraw(tmp_path, "geike")) == (tmp_path / "figures" / "geike.svg").read_bytes()
    with pytest.raises(ValueError, match="nowhere"):
        redraw(tmp_path, "nowhere")
    with pytest.raises(FileNotFoundError, match="hertz"):
        redraw(tmp_path, "hertz")
