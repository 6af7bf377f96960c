"""Colours and borders of verdicts: what is well is green, what is not is red, and both are known without colour."""

import re
from pathlib import Path

import pytest

from tests.seeded import catches
from validation import report

TEMPLATES = Path(report.__file__).parent / "templates"
YES = (".strip .within", ".cell.within", "table.map td.within", ".verdict.within", ".supported")
NO = (".strip .outside", ".cell.outside", "table.map td.outside", ".verdict.outside", ".refuted")
OPEN = (
    ".strip .inconclusive",
    ".cell.inconclusive",
    "table.map td.inconclusive",
    ".verdict.inconclusive",
    ".verdict.inconclusive",
)
NAMED = {"white": "#ffffff"}


def sheet():
    return "".join(file.read_text(encoding="utf-8") for file in sorted(TEMPLATES.glob("*.css")))


def declared(selector, text):
    """The declarations of all rules of a selector, the last of each property."""
    found = {}
    for names, body in re.findall(r"([^{}]+)\{([^{}]*)\}", text):
        if selector in [" ".join(name.split()) for name in names.split(",")]:
            found |= {key.strip(): value.strip() for key, value in re.findall(r"([\w-]+):([^;]+)", body)}
    return found


def painted(selector, text):
    """Red, green, blue of what a reader sees the meaning by, 0 to 1: the field where it is filled, else the type."""
    rules = declared(selector, text)
    value = rules.get("background", rules["color"])
    if value == "white":
        value = rules["color"]
    if variable := re.fullmatch(r"var\((--[\w-]+)\)", value):
        value = declared(":root", text)[variable[1]]
    digits = re.match(r"#([0-9a-f]{6})", NAMED.get(value, value))[1]
    return tuple(int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4))


SHEET = sheet()


def exchanged(one, other):
    """The style sheet with two classes in each other's place."""
    return lambda: SHEET.replace(f".{one}", ".between").replace(f".{other}", f".{one}").replace(".between", f".{other}")


@catches("yes in the colours of no", yes=".cell.within", no=".cell.outside", undecided=".cell.inconclusive").at(
    f"{__name__}.sheet", exchanged("within", "outside")
)
@catches(
    "what differs in the colours of what agrees",
    yes=".verdict.within",
    no=".verdict.outside",
    undecided=".verdict.inconclusive",
).at(f"{__name__}.sheet", exchanged("within", "outside"))
@pytest.mark.parametrize(("yes", "no", "undecided"), list(zip(YES, NO, OPEN, strict=True)))
def test_yes_is_green_no_is_red_and_undecided_is_neither(yes, no, undecided):
    text = sheet()
    (r, g, b), (red, green, blue), between = (painted(name, text) for name in (yes, no, undecided))
    assert g > r and g > b
    assert red > green and red > blue
    assert between[2] < between[0] and abs(between[0] - between[1]) < 0.05


def borders(*selectors):
    found = [declared(selector, sheet()) for selector in selectors]
    return [f"{rules.get('border', '')} {rules.get('border-style', '')}" for rules in found]


def test_what_is_not_yes_has_a_border_of_its_own():
    assert all("double" in border for border in borders(".strip .outside", ".verdict.outside"))
    assert all("dashed" in border for border in borders(".strip .inconclusive", ".verdict.inconclusive"))
    assert not any("double" in b or "dashed" in b for b in borders(".strip .within", ".verdict.within"))
