"""A page begins with the symbols that it uses, and with no others."""

import pytest

from tests.report.test_page import pages_of, section_of
from tests.seeded import catches
from validation.report.columns import SYMBOLS, symbols_in


def names_in(text):
    return [symbol.name for symbol in symbols_in(text)]


@catches("a symbol found inside of words", text="a wheel on E*", names=["E*"]).at(
    "validation.report.columns.Symbol.stands_in", lambda symbol, text: symbol.name in text
)
@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("at h' a/d = 0.2", ["d, d_N", "a, a_x, a_y", "h'", "h' a/d"]),
        ("a wheel on E*", ["E*"]),
        ("h/d and the force", ["d, d_N", "h", "h/d"]),
        ("omega_eigen dt", ["ω_eigen", "dx, dt"]),
        ("kbar over Fbar", ["Fbar", "kbar"]),
        ("p* is full contact", ["p, p*"]),
        ("Fig. 14.45 of dBase", []),
    ],
)
def test_a_symbol_is_a_word_of_its_own(text, names):
    assert names_in(text) == names


def test_a_page_begins_with_its_symbols_and_leads_to_the_list():
    pages = pages_of(section_of("geike", finding="Springs agree at h/d = 0.1 & Fbar = 1."))
    page = pages["exact.html"]
    assert page.index("F/(E* h L): the load") < page.index("Springs agree at")
    assert "angular eigenfrequency" not in page
    assert all(f'id="{symbol.address}"'.replace("'", "&#39;") in pages["reading.html"] for symbol in SYMBOLS)
