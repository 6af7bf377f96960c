"""The examples, links, names and statuses of the pages that people read."""

import json
import re
import runpy
import shlex
import warnings
from pathlib import Path

import pytest

import bem3d
import mdr
from validation.__main__ import Exit, main

ROOT = Path(__file__).parents[1]
DOCS = tuple(f"reports/docs/{path.name}" for path in sorted((ROOT / "reports" / "docs").glob("*.md")))
ROOT_PAGES = ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CONVENTIONS.md", "CHANGELOG.md")
PAGES = (*ROOT_PAGES, "reports/README.md", "tests/README.md", *DOCS)
QUOTES = runpy.run_path(str(ROOT / ".ci" / "readme.py"))
EXAMPLES = [
    pytest.param(example, id=f"{page}-{number}")
    for page in PAGES
    for number, example in enumerate(
        re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    )
]


def test_there_are_examples():
    assert {example.id.rpartition("-")[0] for example in EXAMPLES} == {
        "CONTRIBUTING.md",
        *(f"reports/docs/{name}.md" for name in ("own_data", "own_model", "own_model_reference", "start")),
        *(f"reports/docs/{name}.md" for name in ("two_methods", "verdicts")),
    }


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES)
def test_an_example_runs_as_printed_and_warns_of_nothing(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(compile(example, "example", "exec"), {})


def test_an_example_that_warns_fails():
    (example,) = (example.values[0] for example in EXAMPLES if example.id == "reports/docs/two_methods.md-0")
    with warnings.catch_warnings(), pytest.raises(bem3d.EdgeWarning, match="reaches the edge of the grid"):
        warnings.simplefilter("error")
        exec(compile(example.replace(", indenter_ends_at_edge=True", ""), "example", "exec"), {})


@pytest.mark.parametrize("page", PAGES)
def test_files_that_are_linked_exist(page):
    text = re.sub(r"```.*?```", "", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    for link, place in re.findall(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)", text):
        linked = (ROOT / page).parent / link if link else ROOT / page
        assert linked.exists(), link
        if place and linked.suffix == ".md":
            assert place in headings(linked), place
        if place and linked.suffix == ".html":
            assert f'id="{place}"' in linked.read_text(encoding="utf-8")


def headings(page):
    """Their anchors, those of included pages among them."""
    text = page.read_text(encoding="utf-8")
    for included in re.findall(r"```\{include\} (\S+)", text):
        text += (page.parent / included).read_text(encoding="utf-8")
    lines = re.findall(r"^#+ (.*)", re.sub(r"```.*?```", "", text, flags=re.DOTALL), flags=re.MULTILINE)
    return [re.sub(r"[^\w\- ]", "", line).strip().lower().replace(" ", "-") for line in lines]


@pytest.mark.parametrize("page", PAGES)
def test_files_that_are_named_exist(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert "@@" not in text
    for path in re.findall(r"`((?:validation|tests|mdr|bem3d|reports/docs|reports/reference)/[a-z0-9_/.]*)`", text):
        assert (ROOT / path).exists(), path


def test_readme_is_short():
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 110
    for first in ("pip install .", "make report", "make test", "mdr-validation report", "pytest -n auto"):
        assert any(first in line for line in lines[:40]), first


def test_the_normalised_load_is_defined_before_it_is_used():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert text.index("F̄ = F / (E") == text.index("F̄")
    assert "Fbar" not in text and text.index("k̄ = k / (E") == text.index("k̄")


def test_the_answers_of_the_readme_are_those_of_the_reference_report():
    """`make answers` writes them. Another answer is another table."""
    with_answers = QUOTES["with_answers"]
    text, results = (
        (ROOT / "README.md").read_text(encoding="utf-8"),
        (ROOT / "reports" / "reference" / "results.json").read_text(encoding="utf-8"),
    )
    assert with_answers(text, json.loads(results)) == text
    answers = "Within tolerance|Outside tolerance|Inconclusive|In part|Outside tolerance or inconclusive"
    rows = re.findall(rf"^\| .* \| \*\*(?:{answers})(?:\.\*\*|\*\*:) ", text, flags=re.MULTILINE)
    assert len(rows) == len(json.loads(results)["when_mdr_is_accurate_enough"]) == 8
    assert with_answers(text, json.loads(results.replace('"verdict": "within', '"verdict": "outside'))) != text


@pytest.mark.slow
@pytest.mark.parametrize("page", QUOTES["QUOTING"])
def test_a_page_quotes_what_a_command_prints(page):
    """`make answers` writes it. Durations may differ, nothing else."""
    text = (ROOT / page).read_text(encoding="utf-8")
    (quoted,) = QUOTES["OUTPUT"].finditer(text)
    assert len(quoted["text"].splitlines()) > 5
    assert QUOTES["with_outputs"](text) == text
    stale = text.replace(quoted["text"], quoted["text"].replace("5", "6"))
    assert QUOTES["timeless"](QUOTES["with_outputs"](stale)) == QUOTES["timeless"](text)


def test_exit_statuses():
    rows = re.findall(r"^\| (\d+) \|", (ROOT / "reports/README.md").read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert [int(row) for row in rows] == [status.value for status in Exit]


def test_names_of_the_last_release_stay():
    rows = re.findall(
        r"^ *\| `(\w+\.\w+)` \| `(\w+\.\w+)` \|$",
        (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
        flags=re.MULTILINE,
    )
    assert rows
    packages = {"mdr": mdr, "bem3d": bem3d}
    for old, new in rows:
        (package, before), (_, after) = old.split("."), new.split(".")
        assert getattr(packages[package], before) is getattr(packages[package], after), old


COMMANDS = sorted(
    {
        (page, line.partition("   #")[0].strip())
        for page in PAGES
        for block in re.findall(r"```\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
        for line in re.findall(r"^mdr-validation (?!\w+ FILE\|).*", block, flags=re.MULTILINE)
    }
)


@pytest.mark.parametrize(("page", "line"), COMMANDS)
def test_a_command_has_the_options_that_a_page_gives_it(page, line, capsys):
    words = shlex.split(line.partition(" > ")[0])[1:]
    with pytest.raises(SystemExit) as ended:
        main([words[0], "--help"])
    printed = capsys.readouterr().out
    assert ended.value.code == 0
    for option in words:
        assert not option.startswith("--") or option in printed, option
