"""Names that a user gives are text in every figure: a $ begins no mathematics, and no name hides a curve."""

import io
from dataclasses import replace
from types import SimpleNamespace

import pytest
from markupsafe import Markup
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

import validation.scenes.bundled
from tests.advice.planted_answers import Finding, planted, punch
from tests.seeded import catches
from validation.__main__ import main
from validation.advice.compare import Comparison
from validation.advice.figure import FORMATS, names_of_users, panels_of, to_figure
from validation.advice.hierarchy import select_model
from validation.analysis.chart import Chart
from validation.analysis.evidence import Evidence, Table
from validation.report import style
from validation.report.drawing import draw
from validation.report.formats import templates

NAMES = (r"costs $\frac{$", "$x^2$", "a$b", r"\$ and $", r"$\alpha_{$ and \\", "_hidden", "10 % of #1 & <b>")


def pixels(text, **how):
    figure = Figure(figsize=(3, 1))
    figure.text(0.02, 0.4, text, **how)
    buffer = io.BytesIO()
    FigureCanvasAgg(figure).print_raw(buffer)
    return buffer.getvalue()


@catches("texts of users as mathematics", name="$x^2$").at("validation.report.style.plain", lambda text: text)
@pytest.mark.parametrize("name", [name for name in NAMES if not name.startswith("_")])
def test_a_plain_text_is_drawn_as_it_is_written(name):
    assert pixels(style.plain(name)) == pixels(name, parse_math=False)


def of_name(name):
    return Comparison(punch(load=1.0, name=name), "stiffness", select_model([Finding(name=name)], 0.2))


@pytest.mark.slow
@pytest.mark.parametrize(("form", "name"), [*((form, NAMES[0]) for form in FORMATS), *(("png", n) for n in NAMES)])
def test_every_form_of_a_figure_is_drawn_whatever_a_scene_is_called(name, form):
    assert len(to_figure(of_name(name), form=form)) > 1000


BEGINNINGS = [name for name, of in style.MODELS.items() if of["marker"] == "none"]


STYLES = style.styles_of


@catches("a model of a user's in the style of one of the package", name="Persson").at(
    "validation.report.style.styles_of", lambda n, users=(): STYLES(n)
)
@pytest.mark.parametrize("name", BEGINNINGS)
def test_a_model_of_a_user_has_a_marker_however_its_name_begins(name):
    """As points it would be invisible, and two of them one line."""
    names = [f"{name} with a twist", f"{name} again", "boundary elements"]
    first, second, own = style.styles_of(names, names[:2]).values()
    assert "none" not in (first["marker"], second["marker"]) and first["marker"] != second["marker"]
    assert (first["color"], first["linestyle"]) != (second["color"], second["linestyle"])
    assert own == style.styles_of(["boundary elements"])["boundary elements"]


def test_scenes_and_models_of_users_have_styles_of_their_own_in_the_figures_of_compare():
    """What is neither a model of the package, nor was one of a scene, is of a user."""
    assert names_of_users([of_name("fit")], ["fit", "Hertz wheel"]) == {"Hertz wheel"}
    settings = {"Hertz of mine": "@stiffness_model", "Hertz": "a formula"}
    models = [
        SimpleNamespace(name=name, model=SimpleNamespace(model=SimpleNamespace(setting=setting)))
        for name, setting in settings.items()
    ]
    found = [SimpleNamespace(selection=SimpleNamespace(candidates=models))]
    assert names_of_users(found, list(settings)) == {"Hertz of mine"}


@catches("texts of users on a page as they are").at("validation.report.formats.printable", lambda text, lines: text)
def test_a_text_on_a_page_has_no_character_that_acts():
    page = templates().from_string("{{ text }}|{{ ours }}")
    said = page.render(text="a\x1b[31m<b>\u202e\nb", ours=Markup("<i>\x1b</i>"))
    assert said == "a\\x1b[31m&lt;b&gt;\\u202e\nb|<i>\x1b</i>"


@pytest.mark.filterwarnings("error")
def test_names_of_any_length_stay_inside_a_figure():
    """In the title, the legend and on the axis: no more than two lines, and no axes pushed out."""
    for words in ("long name " * 50, "x" * 400):
        assert [len(line) <= 48 for line in style.in_two_lines(words, 48).split("\n")] == [True, True]
        for found in (of_name(words), [of_name(words), of_name("short")]):
            assert len(to_figure(found, form="png")) > 1000
    assert style.in_two_lines("springs, rolling spectrum (MDR)", 48) == "springs, rolling spectrum (MDR)"


def test_curves_of_several_scenes_are_named_in_the_legend():
    spectrum = planted("rail", "contact-filter")
    found = [replace(spectrum, scene=replace(spectrum.scene, name=name)) for name in ("_one", "$two$")]
    title, ((panel, table),) = panels_of(found)
    evidence = Evidence(title="", method="", numbers=(), tables=(table,), conclusions=(), captions={})
    figure = draw(Chart("it", panels=(panel,), title=title), evidence)
    style.plain_figure(figure)
    names = [
        text.get_text() for text in (*figure.findobj(Text),) if "one" in text.get_text() or "two" in text.get_text()
    ]
    assert sorted(names) == [" _one", r"\$two\$"]


def test_figures_of_cases_take_the_texts_of_their_tables_as_they_are():
    """Of a case and a scene of a user's own, too; mathematics of our own figures stays."""
    table = Table("it", {"scene": ["$a", "b$", "$c$"], "x": [1.0, 2.0, 3.0]})
    evidence = Evidence(title="t", method="m", numbers=(), tables=(table,), conclusions=(), captions={})
    seen = []

    def draw(given):
        seen.extend(given.table("it")["scene"].tolist())
        return Figure()

    style.drawn(draw, evidence, "full")
    assert seen == [r"\$a", r"b\$", r"\$c\$"] and evidence.table("it")["x"].tolist() == [1.0, 2.0, 3.0]
    assert evidence.table("it")["scene"].tolist() == ["$a", "b$", "$c$"]


@pytest.mark.slow
def test_the_command_draws_and_reports_a_scene_of_any_name(tmp_path, capsys):
    text = validation.scenes.bundled.path_of("sphere").read_text(encoding="utf-8")
    scene = tmp_path / "my.toml"
    scene.write_text(text.replace('name = "Smooth sphere"', r"name = 'costs $\frac{$ & <b>'"), encoding="utf-8")
    words = ["compare", str(scene), "--report", str(tmp_path / "page"), "--figure", str(tmp_path / "it.png")]
    assert main(words) == 0
    page = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert r"costs $\frac{$ &amp; &lt;b&gt;: stiffness" in page and "<b>: stiffness" not in page
