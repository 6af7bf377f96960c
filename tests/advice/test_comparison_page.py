"""The page of `compare --report`: what it says is what was found, and its folder is replaced whole or not at all."""

import html
import json
import re

import pytest

import validation
from tests.advice.planted_answers import Fake, Finding, punch
from validation.__main__ import main
from validation.advice.advice import in_full
from validation.advice.compare import Comparison, SceneProblem
from validation.advice.hierarchy import select_model
from validation.advice.page import PAGE, files_of_comparison
from validation.advice.sound_power import LEVELS
from validation.advice.summary import label

ABOUT = dict.fromkeys(("version", "commit", "python", "system"), "0") | {"libraries": {}, "seeds": {"compare": 0}}


def files_of(*found):
    return files_of_comparison(found, ABOUT)


def text_of(page):
    return " ".join(html.unescape(re.sub(r"<style>.*?</style>|<[^>]*>", " ", page.decode(), flags=re.DOTALL)).split())


def of_models(*models, **settings):
    return Comparison(punch(load=1.0), "stiffness", select_model(models, 0.2, **settings))


@pytest.mark.slow
def test_the_page_has_scene_answer_claims_and_costs():
    scene = validation.load_scene("rolling_wheel")
    found = validation.compare(
        scene, quantity="force-spectrum", tolerance="3 dB", models=["linear filter, 3D", "springs"]
    )
    files = files_of(found)
    text = text_of(files[PAGE])
    for said in ("Rolling wheel: force-spectrum within 3 dB", "contact radius a 1.982 mm", "✓ tolerance met"):
        assert said in text
    assert all(label(one.name, is_mdr=one.is_mdr) in text and one.reason in text for one in found.models)
    assert all(sentence in text for sentence in in_full(found))
    assert files["figures/scene-1.svg"].startswith(b"<?xml") and files["figures/scene-1.pdf"].startswith(b"%PDF")
    assert files["comparison.json"].decode() == validation.to_json(found)
    assert files["data/levels.csv"].decode() == validation.to_csv(found)
    assert files == files_of(found)


@pytest.mark.slow
def test_the_page_of_a_rail_has_its_levels_its_sound_power_and_the_seconds_of_its_models():
    """A section a quantity; what has the same name in text and page has the same words."""
    names = ("linear, ellipse", "Remington")
    scene, quantities = validation.load_scene("rail"), ("contact-filter", "equivalent-roughness")
    found = SceneProblem(scene, quantities, "1 dB", solve_all=True, models=names).compared()
    files = files_of(*found.values())
    text, power = text_of(files[PAGE]), found["contact-filter"].power
    assert files[PAGE].count(b"<section id=") == 2 and "figures/all.svg" not in files
    assert "Wheel on a rail: contact-filter, equivalent-roughness within 1 dB" in text
    assert text.count(power.sentences[0]) == 2 and text.count(LEVELS) == 2
    for words in ("Took", "sum [dB(A) re 1 pW]", f"{power.total('Remington'):.1f}", "band [Hz] L_r A3 L_eq ± [dB]"):
        assert words in text
    assert "L_FA" not in text and "re 1 N" not in text


@pytest.mark.slow
def test_the_page_needs_no_other_file():
    page = files_of(of_models(Finding()))[PAGE].decode()
    assert not re.findall(r"<script|<link|@import|url\(|src=\"(?!data:)|https?://", page)
    assert page.count("<th") - page.count("<thead") == len(re.findall(r'<th scope="(?:col|row)"', page)) > 7
    assert set(re.findall(r'href="([^"#]+)"', page)) <= set(files_of(of_models(Finding())))


@pytest.mark.slow
def test_what_was_not_met_says_what_would_help():
    text = text_of(files_of(of_models(Finding(parts=(0.5, 0, 0))))[PAGE])
    assert "✗ tolerance not met" in text and "What would help: a tolerance of 52 %" in text
    nothing = files_of(of_models(Fake(failed="it was lost", claimed=0.1)))
    assert "No model has a result" in text_of(nothing[PAGE]) and "it was lost" in text_of(nothing[PAGE])
    assert not any(name.startswith("figures/") for name in nothing)


@pytest.mark.slow
def test_several_scenes_have_one_figure_and_a_section_each():
    one, other = (of_models(Finding(value=(value,))) for value in (1.0, 2.0))
    files = files_of(one, other)
    assert {name for name in files if name.endswith(".svg")} == {
        f"figures/{n}.svg" for n in ("all", "scene-1", "scene-2")
    }
    assert files[PAGE].count(b"<section id=") == 2
    assert [found["value"] for found in json.loads(files["comparison.json"])] == [[1.0], [2.0]]


@pytest.mark.slow
def test_a_folder_is_written_and_replaced_and_no_other_touched(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    mine, theirs, report = (tmp_path / name for name in ("mine", "theirs", "report"))
    for _ in range(2):
        assert main(["compare", "sphere", "--report", str(mine)]) == 0
    assert f"report: {mine / PAGE}" in capsys.readouterr().out
    names = {str(path.relative_to(mine)) for path in mine.rglob("*") if path.is_file()}
    assert names == {"manifest.json", *files_of(validation.compare(validation.load_scene("sphere")))}
    theirs.mkdir()
    (theirs / "thesis.tex").write_text("mine", encoding="utf-8")
    report.mkdir()
    (report / "manifest.json").write_text(
        '{"kind": "mdr-validation report", "format": 1, "files": {}}', encoding="utf-8"
    )
    for folder, said in ((theirs, "--report must be a new or empty folder"), (report, "not the list of a comparison")):
        assert main(["compare", "sphere", "--report", str(folder)]) == 2
        assert said in capsys.readouterr().err
        assert len(list(folder.iterdir())) == 1
    assert main(["report", "--only", "hertz", "--out", str(mine)]) == 2
    assert "not the list of a report" in capsys.readouterr().err
