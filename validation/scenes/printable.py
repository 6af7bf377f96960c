"""Values as messages print them: on one line, of bounded length, without control characters."""

import reprlib
import unicodedata

MAX_CHARACTERS = 120
"""Characters of a value in a message, at the most."""

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


def printable(text: object, *, lines: bool = False) -> str:
    """A text whose control characters are written as escapes, its line breaks, too, unless it may have lines."""
    return "".join(
        c if (lines and c == "\n") or _harmless(c) else c.encode("unicode_escape").decode() for c in str(text)
    )


def is_printable(text: str) -> bool:
    """Whether it has neither control characters nor line breaks, nor marks that turn the direction of writing."""
    return all(map(_harmless, text))


ESCAPED = str.maketrans({"\\": r"\\", '"': r"\""})


def _harmless(character: str) -> bool:
    # spaces other than the plain one print nothing, and harm nothing
    return character.isprintable() or unicodedata.category(character) == "Zs"
