"""Values as messages print them: on one line, of bounded length, without control characters."""

import codecs
import reprlib
import unicodedata
from collections.abc import Iterable
from typing import Any

from validation.analysis.escapes import is_printable as is_printable
from validation.analysis.escapes import printable as printable

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
