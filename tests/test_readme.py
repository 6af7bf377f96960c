"""The examples, links, names and statuses of the pages that people read."""

import json
import re
import runpy
from pathlib import Path

import pytest

import bem3d
import mdr
import validation
from validation.__main__ import Exit, main

ROOT = Path(__file__).parents[1]
PAGES = ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CONVENTIONS.md", "CHANGELOG.md", "reports/README.md")
EXAMPLES = [
    pytest.param(example, id=f"{page}-{number}")
    for page in (*PAGES, "reports/docs/two_methods.md")
    for number, example in enumerate(
        re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    )
]


def test_there_are_examples():
    assert {example.id.split("-")[0] for example in EXAMPLES} == {
        "README.md",
        "CONTRIBUTING.md",
        "reports/docs/two_methods.md",
    }


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES)
def test_example(example):
    exec(compile(example, "example", "exec"), {})


@pytest.mark.parametrize("page", PAGES)
def test_files_that_are_linked_exist(page):
    for link, place in re.findall(r"\]\(([^)#:]*)(?:#([^)]*))?\)", (ROOT / page).read_text(encoding="utf-8")):
        linked = (ROOT / page).parent / link if link else ROOT / page
        assert linked.exists(), link
        if place and linked.suffix == ".md":
            headings = re.findall(r"^#+ (.*)", linked.read_text(encoding="utf-8"), flags=re.MULTILINE)
            assert place in [re.sub(r"[^\w\- ]", "", heading).lower().replace(" ", "-") for heading in headings]
        if place and linked.suffix == ".html":
            assert f'id="{place}"' in linked.read_text(encoding="utf-8")


@pytest.mark.parametrize("page", [*PAGES, "tests/README.md"])
def test_files_that_are_named_exist(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert "@@" not in text
    for path in re.findall(r"`((?:validation|tests|mdr|bem3d|reports)/[a-z0-9_/.]*)`", text):
        assert (ROOT / path).exists(), path


def test_readme_is_short_and_names_no_module_of_validation():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 150
    assert set(re.findall(r"validation\.(\w+)", text)) <= set(validation.__all__)


def test_the_answers_of_the_readme_are_those_of_the_reference_report():
    """`make answers` writes them. Another answer is another table."""
    with_answers = runpy.run_path(str(ROOT / ".ci" / "readme.py"))["with_answers"]
    text, results = (
        (ROOT / "README.md").read_text(encoding="utf-8"),
        (ROOT / "reports" / "reference" / "results.json").read_text(encoding="utf-8"),
    )
    assert with_answers(text, json.loads(results)) == text
    answers = "Within tolerance|Outside tolerance|Inconclusive|In part|Outside tolerance or inconclusive"
    rows = re.findall(rf"^\| .* \| \*\*(?:{answers})(?:\.\*\*|\*\*:) ", text, flags=re.MULTILINE)
    assert len(rows) == len(json.loads(results)["when_mdr_is_accurate_enough"]) == 8
    assert with_answers(text, json.loads(results.replace('"verdict": "within', '"verdict": "outside'))) != text


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


def test_what_compare_prints(capsys):
    """The first page of the documentation shows lines of this output."""
    assert main(["compare", "rough_punch", "--tolerance", "20%"]) == 0
    lines = capsys.readouterr().out.splitlines()
    text = (ROOT / "reports" / "docs" / "start.md").read_text(encoding="utf-8")
    shown = text[text.index("Rough punch: ") :].split("```")[0]
    for line in shown.splitlines():
        words = [word for word in line.split() if word != "..."]
        assert any(printed.split()[: len(words)] == words for printed in lines), line
