"""Texts of users where they leave: without characters that steer a terminal, turn the direction of writing, or compute.

What prints, writes a file or a page, and draws a figure passes them through here; so nothing else has to. Values in
messages stand on one line of bounded length.
"""

import codecs
import json
import os
import re
import reprlib
import sys
import unicodedata
from collections.abc import Iterable
from typing import Any

FORMULAS = "=+-@\t\r\uff1d\uff0b\uff0d\uff20"
"""First characters of a cell that spreadsheets compute, those of full width included."""
QUOTE = "'"
"""Before such a cell: it makes it a text."""


def printable(text: object, *, lines: bool = False) -> str:
    """A text whose control characters are written as escapes, its line breaks, too, unless it may have lines."""
    return "".join(
        c if (lines and c == "\n") or _harmless(c) else c.encode("unicode_escape").decode() for c in str(text)
    )


def coloured(text: str) -> str:
    """A text whose words for verdicts are coloured where standard output is a terminal and NO_COLOR is not set.

    The words say all that the colours do.
    """
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" or not sys.stdout.isatty():
        return text
    for colour, words in COLOURS.items():
        text = re.sub(words, lambda word, colour=colour: f"\x1b[{colour}m{word[0]}\x1b[0m", text)  # type: ignore[misc]
    return text


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


COLOURS = {
    31: r"(?:\boutside tolerance\b|\bno result\b|\brejected(?=: )|\bcheck not passed\b|\bexit status [1-9]\b)",
    33: r"\brefuted(?=: )|\binconclusive(?=: )",
    32: r"\bwithin tolerance\b|\bsupported(?: within limits)?(?=: )|(?<=  )selected\b|\bexit status 0\b",
}
"""Numbers of colours of a terminal, red, yellow and green, and the words that have them."""
MAX_CHARACTERS = 120
"""Characters of a value in a message, at the most."""

PLAIN = "mdr-validation-plain"
"""How a stream treats what its encoding lacks: an error handler, see `plain`."""
IN_ASCII = {
    "±": "+-",
    "µ": "u",
    "μ": "u",
    "×": "x",
    "·": ".",
    "—": "-",
    "–": "-",
    "−": "-",
    "°": " deg",
    "≤": "<=",
    "≥": ">=",
}
"""Of characters without a decomposition."""

_SHORT = reprlib.Repr()
_SHORT.maxlevel, _SHORT.maxdict, _SHORT.maxlist, _SHORT.maxtuple = 3, 4, 4, 4
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = MAX_CHARACTERS


def shortened(value: object) -> str:
    """A value as Python writes it, shortened, however deep it is nested."""
    return printable(_SHORT.repr(value))


MOST_IN_LINE = 99
"""Characters of what a result prints of itself."""


def one_line(text: str) -> str:
    """A printable line of less than 100 characters, cut where it is longer."""
    line = printable(text)
    return line if len(line) <= MOST_IN_LINE else f"{line[: MOST_IN_LINE - 4]}...{line[-1]}"


def shortened_text(text: str, most: int = 32) -> str:
    """A name, cut where a line has no room for more."""
    return text if len(text) <= most else f"{text[: most - 3]}..."


def quoted(value: object) -> str:
    """The same, a text in double quotes, as in a scene file."""
    if not isinstance(value, str):
        return shortened(value)
    text = value if len(value) <= MAX_CHARACTERS else f"{value[: MAX_CHARACTERS - 3]}..."
    return f'"{printable(text.translate(ESCAPED))}"'


ESCAPED = str.maketrans({"\\": r"\\", '"': r"\""})


def plain(error: UnicodeError) -> tuple[str, int]:
    """An error handler of codecs: +- for ±, the letter of an accented one, a question mark for all else."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_in_ascii, error.object[error.start : error.end])), error.end


def never_fatal(streams: Iterable[Any]) -> None:
    """Streams that would raise for a character that their encoding lacks write it as `plain` does."""
    codecs.register_error(PLAIN, plain)
    for stream in streams:
        # a stream in the place of one of Python's may have no encoding, and none may be there
        if getattr(stream, "errors", None) in ("strict", "surrogateescape") and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=PLAIN)


def _in_ascii(character: str) -> str:
    text = IN_ASCII.get(character) or unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return text or "?"
