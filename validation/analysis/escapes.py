"""Texts of users where they leave: without characters that steer a terminal, turn the direction of writing, or compute.

What prints, writes a file or a page, and draws a figure passes them through here; so nothing else has to.
"""

import json
import unicodedata

FORMULAS = "=+-@\t\r\uff1d\uff0b\uff0d\uff20"
"""First characters of a cell that spreadsheets compute, those of full width included."""
QUOTE = "'"
"""Before such a cell: it makes it a text."""


def printable(text: object, *, lines: bool = False) -> str:
    """A text whose control characters are written as escapes, its line breaks, too, unless it may have lines."""
    return "".join(
        c if (lines and c == "\n") or _harmless(c) else c.encode("unicode_escape").decode() for c in str(text)
    )


def is_printable(text: str) -> bool:
    """Whether it has neither control characters nor line breaks, nor marks that turn the direction of writing."""
    return all(map(_harmless, text))


def cell_text(text: str) -> str:
    """The text as a cell of CSV; a quote precedes what a spreadsheet would compute, but not a lone sign."""
    kept = printable(text)
    is_formula = len(text) > 1 and (text[0] in FORMULAS or text.lstrip()[:1] in tuple(FORMULAS))
    return QUOTE + kept if is_formula else kept


def json_text(value: object) -> str:
    """The value as JSON on one line; unprintable characters are escaped, NaN and infinity raise ValueError."""
    text = json.dumps(value, allow_nan=False, ensure_ascii=False)
    return text if is_printable(text) else "".join(c if _harmless(c) else json.dumps(c)[1:-1] for c in text)


def _harmless(character: str) -> bool:
    # spaces other than the plain one print nothing, and harm nothing
    return character.isprintable() or unicodedata.category(character) == "Zs"
