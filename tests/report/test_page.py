"""The page can be read by everyone, is folded until asked, and its figures can be found, cited and drawn again."""

import re
from dataclasses import replace

import pytest

from tests.report.accessibility import Tree, contrast, faults, words_seen
from tests.report.test_command_line import SMALL
from tests.report.test_printed import evidence_with, number
from validation import __main__ as command
from validation.analysis.contents import as_csv, from_csv
from validation.analysis.evidence import JudgedClaim, Role, Table, Verdict, VerdictCell
from validation.cases.wheel.contrast import CONTRAST
from validation.report import page
from validation.report.contents import CASES
from validation.report.figure_tables import tables_of
from validation.report.page_figure import figures_of
from validation.report.redraw import redraw
from validation.report.section import Section
from validation.report.style import svg
from validation.report.verdict_map import map_of

ABOUT = {
    **dict.fromkeys(("python", "system", "processor", "cores", "workers"), ""),
    **{
        "libraries": {},
        "seeds": {},
        "kept": {},
        "timed": (),
        "seconds": dict.fromkeys(("geike", "hertz", "rolling"), 1.0),
    },
    **{"version": "1.2.3", "commit": "abc1234", "documentation": ""},
}
FIELDS = [VerdictCell("+1 %", Verdict.AGREE), VerdictCell("+9 %", Verdict.DIFFER), "no value"]
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


# --- for everyone ---


def test_the_page_can_be_read_by_everyone():
    pages = pages_of(section_of("geike"), section_of("hertz", criterion=9.0), section_of("rolling"))
    assert list(pages) == ["exact.html", "rolling.html", "index.html"]
    assert faults(pages) == []


@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ('lang="en"', "", "html has no lang"),
        ("<h1>", "<h1>x</h1><h1>", "not one h1"),
        ('<h2 id="geike-title">Case</h2>', '<h5 id="geike-title">Case</h5>', "h5 follows h1"),
        ('alt="A curve"', 'alt=""', "img says nothing"),
        ('id="figure-geike"', 'id="geike"', "id geike twice"),
        ('href="index.html#asked"', 'href="#nowhere"', "link to #nowhere"),
        ('href="exact.html#geike"', 'href="exact.html#nowhere"', "link to exact.html#nowhere"),
        ('<th scope="col">H', "<th>H", "header 'H' has no scope"),
        ("--soft: #5a5a5a", "--soft: #9a9a9a", "#9a9a9a on #ffffff has a contrast of 2.8"),
        ("<summary>Method</summary>", "", "details does not begin with its summary"),
        ('role="region"', "", "what the keyboard reaches has no role"),
    ],
)
def test_a_page_that_somebody_cannot_read_is_found(right, wrong, said):
    text = html_of(section_of("geike", title="Case"))
    assert right in text
    others = pages_of(section_of("geike", title="Case"))
    assert any(said in fault for fault in faults(others | {"exact.html": text.replace(right, wrong)}))


def test_contrast_is_that_of_the_guidelines():
    """Black on white has 21; #767676 is the lightest grey that passes on white."""
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#767676", "#ffffff") >= 4.5 > contrast("#777777", "#ffffff")


def test_colours_of_the_verdict_map_differ_in_grey():
    """From each other by a step that is seen, beside their letters."""
    style = html_of(section_of("geike")).partition("</style>")[0]
    grounds = [re.search(rf"table\.map td\.{v} {{ background: (#\w+)", style)[1] for v in ("agree", "differ")]
    assert contrast(*grounds) > 4.5
    assert re.search(r"table\.map td\.undecided {[^}]*repeating-linear-gradient", style)


# --- folded ---


def test_most_of_a_case_is_folded():
    body = next(e for e in Tree(html_of(section_of("geike"))).root.walk() if e.attributes.get("id") == "geike")
    assert words_seen(body) < 0.6 * len(body.text.split())


@pytest.mark.parametrize(("criterion", "said"), [(1.0, 0), (9.0, 1)])
def test_a_criterion_that_is_missed_is_said_above_the_figures(criterion, said):
    text = html_of(section_of("geike", criterion=criterion))
    assert text.partition("<figure")[0].count("Missed criterion:") == said


def test_the_first_words_of_a_case_are_its_finding_and_then_the_claim():
    """The answer of the first claim where it has no finding, and that is then not said twice."""
    for changes, lead in (({"finding": "It is 1."}, "It is 1."), ({}, "Yes: it is 1.")):
        text = html_of(section_of("geike", **changes))
        start = text.index('<section id="geike"')
        case = text[start : text.index("</section>", start)]
        assert f"<p><b>{lead}</b></p>" in case
        assert case.index(lead) < case.index("It is so.") < case.index("<figure")
        assert case.count("Yes: it is 1.") == 1


def test_the_first_figure_is_open_and_titled_by_its_finding():
    captions = {"geike": "A curve.", "hertz": "A sphere."}
    shown = section_of("geike", headlines={"geike": "Springs are 30 dB too quiet"})
    shown = replace(shown, evidence=replace(shown.evidence, captions=captions))
    figures = [e for e in Tree(html_of(shown)).root.walk() if e.attributes.get("class") == "figure"]
    assert ["open" in figure.attributes for figure in figures] == [True, False]
    assert ["".join(f.children[0].words).strip() for f in figures] == ["Springs are 30 dB too quiet", "A sphere"]
    assert ["".join(f.children[0].children[0].words) for f in figures] == ["Figure 1.", "Figure 2."]
    assert all(e.attributes["alt"] for f in figures for e in f.walk() if e.tag == "img")


# --- the map of verdicts ---


def test_a_table_of_verdicts_is_a_lettered_map_with_the_table_behind_it():
    found = map_of(MATRIX)
    assert [(place, "".join(f.letter for f in fields)) for place, fields in found.rows] == [
        (("0.4",), "A–"),
        (("0.7",), "DD"),
        (("1",), "–A"),
    ]
    assert found.summary == "2 agree, 2 differ"
    text = html_of(section_of("geike"))
    assert text.count('<td class="differ" title="+9 %: differ">D</td>') == 2
    assert text.index('class="map"') < text.index("Table behind it")


@pytest.mark.parametrize("columns", [{"H": ["0.4", "1"], "verdict": FIELDS[:2]}, {"H": ["1"], "a": ["b"]}])
def test_a_table_with_few_verdicts_stays_as_it_is(columns):
    assert map_of(Table("t", columns)) is None


# --- figures ---


def test_a_figure_is_numbered_on_the_page_and_cited_by_name_version_and_commit():
    text = html_of(section_of("hertz"), section_of("geike"))
    assert text.index('id="figure-hertz"') < text.index('id="figure-geike"')
    figure = figures_of([section_of("hertz"), section_of("geike")])["geike"]
    assert (figure.number, figure.finding) == (2, "A curve")
    assert figure.citation(ABOUT, "full") == (
        "Figure 2, “A curve”, in: Reduced contact models: validation report (mdr-validation 1.2.3, commit abc1234, "
        "profile full), exact.html#figure-geike"
    )
    assert figure.citation(ABOUT, "full") in text
    assert "commit 0ld0000, profile" in figure.citation({**ABOUT, "kept": {"geike": "0ld0000"}}, "full")
    assert "commit abc1234, profile" in figure.citation({**ABOUT, "kept": {"hertz": "0ld0000"}}, "full")


def test_no_finding_is_stated_of_a_scene_without_a_steady_answer():
    shown = section_of("geike", headlines={"geike": "Springs agree"})
    assert figures_of([shown], unsteady=True)["geike"].finding == "A curve"


def test_a_table_comes_back_from_its_file():
    values = {"x": [1.5, float("nan")], "n": [1, 2], "yes": [True, False], "name": ["a", ""]}
    back = from_csv("t", as_csv(Table("t", values)).decode())
    assert {name: type(column[0]) for name, column in back.columns.items()} == {
        "x": float,
        "n": int,
        "yes": bool,
        "name": str,
    }
    assert as_csv(back) == as_csv(Table("t", values))


def test_the_tables_of_a_figure_are_those_that_it_asks_for():
    assert tables_of("geike") == ("C_1D [m³]", "moment over that of the surface")
    assert CONTRAST in tables_of("wheel") and CONTRAST not in tables_of("wheel-parameters")
    assert set(tables_of("wheel-contact")) == {"springs", "pressure"}


@pytest.mark.slow
def test_the_line_beside_a_figure_draws_it_again(tmp_path, monkeypatch):
    """From the files alone, and the same to the printed digit."""
    monkeypatch.setitem(CASES, "geike", replace(CASES["geike"], quick=SMALL["geike"]))
    assert command.main(["report", "--only", "geike", "--out", str(tmp_path), "--workers", "1"]) == 0
    text = (tmp_path / "exact.html").read_text()
    linked = set(re.findall(r'href="(data/[^"]*\.csv)"', text))
    assert linked == {
        "data/geike-C_1D_m³.csv",
        "data/geike-moment_over_that_of_the_surface.csv",
        "data/geike-numbers.csv",
    }
    assert all((tmp_path / path).exists() for path in linked)
    line = re.search(r"<code>(.*?)</code>", text)[1].replace("&#34;", '"')
    monkeypatch.chdir(tmp_path)
    exec(line)
    assert (tmp_path / "geike.pdf").stat().st_size > 1000
    assert svg(redraw(tmp_path, "geike")) == (tmp_path / "figures" / "geike.svg").read_bytes()
    with pytest.raises(ValueError, match="nowhere"):
        redraw(tmp_path, "nowhere")
    with pytest.raises(FileNotFoundError, match="hertz"):
        redraw(tmp_path, "hertz")
