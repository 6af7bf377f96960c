"""The page of a report passes axe-core, in windows wide and narrow; `make accessibility` installs what it needs."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.report.axe import LACKING, violations
from tests.report.test_page import MATRIX, section_of
from tests.report.test_printed import ABOUT
from validation.report import page
from validation.report.answers.first_screen import MAP

pytestmark = [pytest.mark.slow, pytest.mark.skipif(bool(LACKING), reason=f"not there: {', '.join(LACKING)}")]
WIDE, NARROW = 1300, 400
REFERENCE = Path(__file__).parents[2] / "reports" / "reference"
FAULTS = {
    "color-contrast": ("--soft: #5a5a5a", "--soft: #9a9a9a"),
    "image-alt": (' alt="', ' data-alt="'),
    "html-has-lang": (' lang="en"', ""),
    "aria-roles": ('role="region"', 'role="area"'),
}


def titled(name, **changes):
    """Its title and its table have names that no other case has."""
    return section_of(name, title=name, page_tables=[replace(MATRIX, name=f"Deviation of {name}")], **changes)


def whole():
    """With numbers, tables, figures, a criterion that is missed, and the map of the first screen."""
    models = replace(titled("reduced_models").evidence, captions={MAP: "How far models carry."})
    sections = [titled("geike"), titled("hertz", criterion=9.0), replace(titled("reduced_models"), evidence=models)]
    return {name: text.decode() for name, text in page.pages(sections, "full", ABOUT, None).items()}


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_no_rule_is_violated(tmp_path, width):
    assert {name: violations(text, tmp_path, width) for name, text in whole().items()} == {name: {} for name in whole()}


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_no_rule_is_violated_by_the_reference_report(tmp_path, width):
    found = {
        path.name: violations(path.read_text(encoding="utf-8"), tmp_path, width) for path in REFERENCE.glob("*.html")
    }
    assert not any(found.values()), found


def test_what_violates_rules_is_found(tmp_path):
    wrong = "".join(whole().values())
    for right, planted in (*FAULTS.values(), ('href="#validity-large"', "")):
        assert right in wrong
        wrong = wrong.replace(right, planted)
    found = violations(wrong, tmp_path, NARROW)
    assert {*FAULTS, "scrollable-region-focusable"} <= set(found)
