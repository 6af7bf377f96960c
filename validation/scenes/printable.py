"""Values as messages print them: on one line, of bounded length, without control characters."""

import reprlib

from validation.analysis.escapes import is_printable as is_printable
from validation.analysis.escapes import printable as printable

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


ESCAPED = str.maketrans({"\\": r"\\", '"': r"\""})
