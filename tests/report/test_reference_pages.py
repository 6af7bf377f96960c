"""All pages of the reference report together: they lead to each other, and stay short enough to be read."""

import re

import pytest
from markupsafe import Markup

from tests.report.accessibility import faults
from tests.report.remade import remade
from validation.report.columns import SYMBOLS

MOST_WORDS, MOST_BYTES = 40_000, 1_500_000
"""Of all pages, with all that is folded."""

pytestmark = pytest.mark.slow

AWAITED = {"symbol-κ"}
"""Symbols of tables that the reference report has when its case `interface` is remade."""


def words(page):
    return len(Markup(re.sub("<style>.*?</style>", "", page, flags=re.DOTALL)).striptags().split())


def test_the_pages_lead_to_each_other():
    assert faults(remade()) == []


def test_they_are_short_enough():
    assert sum(map(words, remade().values())) <= MOST_WORDS
    assert sum(len(page.encode()) for page in remade().values()) <= MOST_BYTES


def test_every_symbol_of_the_list_is_used_on_a_page():
    used = {name for page in remade().values() for name in re.findall(r'<dt><a href="reading.html#([^"]+)"', page)}
    unused = {str(Markup.escape(symbol.address)) for symbol in SYMBOLS} - used
    assert unused == AWAITED and used <= {str(Markup.escape(symbol.address)) for symbol in SYMBOLS}
