"""The page of a report passes axe-core, in windows wide and narrow; `make accessibility` installs what it needs."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.report.axe import LACKING, violations
from tests.report.test_page import ABOUT, MATRIX, PICTURES, section_of
from validation.report import page
from validation.report.answers.first_screen import MAP

pytestmark = [pytest.mark.slow, pytest.mark.skipif(bool(LACKING), reason=f"not there: {', '.join(LACKING)}")]
WIDE, NARROW = 1300, 400
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 500"><path d="M0 0L1000 500" stroke="black"/></svg>'
REFERENCE = Path(__file__).parents[2] / "reports" / "reference" / "index.html"
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
    pictures = dict.fromkeys((*PICTURES, MAP), SVG)
    about = ABOUT | {"seconds": dict.fromkeys(("geike", "hertz", "reduced_models"), 1.0)}
    return page.page(sections, "full", pictures, about, None).decode()


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_no_rule_is_violated(tmp_path, width):
    assert violations(whole(), tmp_path, width) == {}


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_no_rule_is_violated_by_the_reference_report(tmp_path, width):
    assert violations(REFERENCE.read_text(encoding="utf-8"), tmp_path, width) == {}


def test_what_violates_rules_is_found(tmp_path):
    wrong = whole()
    for right, planted in (*FAULTS.values(), ('href="#validity-large"', "")):
        assert right in wrong
        wrong = wrong.replace(right, planted)
    found = violations(wrong, tmp_path, NARROW)
    assert {*FAULTS, "scrollable-region-focusable"} <= set(found)
