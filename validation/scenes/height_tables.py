"""Tables of numbers in text files of others: a header above, a delimiter between, bounded lines."""

from codecs import BOM_UTF8
from collections.abc import Iterator
from functools import partial
from itertools import islice
from typing import IO

import numpy as np
from numpy.typing import NDArray

MOST_LINES, LONGEST_LINE = 2**20, 2**25
"""Of a table of 2**24 values, 16 along a side; characters of a line."""
COMMENTS = (b"#", b"%", b"//")
"""How a line above the numbers begins that holds none."""
MOST_HEADER = 100
"""Lines in which the first row of numbers is looked for, to say how many to skip."""


def table_of_numbers(file: IO[bytes], skip: int | None = 0) -> NDArray[np.generic]:
    """Of a CSV or another text, its delimiter that of its first row. Lines above it that are comments are left out.

    skip: lines at the top that are none of the table, comments and blank lines among them; None where the caller
    cannot say it. Raises ValueError.
    """
    for _ in _lines(file):
        pass
    file.seek(0)
    above, first = _above(file, skip or 0)
    if not first:
        raise ValueError(f"no line below the {skip} to skip" if skip else "an empty file")
    delimiter = _delimiter(first)
    file.seek(above)
    try:
        return np.loadtxt(file, delimiter=delimiter, ndmin=2, encoding="utf-8-sig")
    except ValueError as problem:
        if "number of columns changed" in str(problem):
            changed = str(problem).partition(";")[0].removeprefix("the ")
            raise ValueError(f"rows of different length, the {changed}") from None
        hint = _hint(file, skip, str(problem)) if "could not convert" in str(problem) else ""
        raise ValueError(f"{str(problem).splitlines()[0]}{hint}") from None


def _above(file: IO[bytes], skip: int) -> tuple[int, bytes]:
    """Where the first line begins that is neither to skip nor blank nor a comment, and that line; empty for none."""
    for _ in range(skip):
        file.readline()
    while True:
        start = file.tell()
        line = file.readline()
        if not line or not _is_comment(line):
            return start, line.removeprefix(BOM_UTF8)


def _is_comment(line: bytes) -> bool:
    text = line.removeprefix(BOM_UTF8).strip()
    return not text or text.startswith(COMMENTS)


def _delimiter(line: bytes) -> str | None:
    """None for white space."""
    return next((sign for sign in (";", ",", "\t") if sign.encode() in line), None)


def _hint(file: IO[bytes], skip: int | None, problem: str) -> str:
    """What would help where a text is no number."""
    if "string ''" in problem:
        return " (a point without data is nan)"
    if skip is None:
        return " (a header belongs behind a #)"
    file.seek(0)
    rows = (number for number, line in enumerate(islice(_lines(file), MOST_HEADER)) if _is_row(line))
    first = next(rows, 0)
    return f" (a header begins with #, or is left out, as: skip = {first})" if first > skip else ""


def _is_row(line: bytes) -> bool:
    """Whether a line is made of numbers."""
    delimiter = _delimiter(line)
    try:
        return bool([float(part) for part in line.decode("utf-8-sig").split(delimiter)])
    except ValueError:
        return False


def _lines(file: IO[bytes]) -> Iterator[bytes]:
    """Of bounded number and length."""
    for number, line in enumerate(iter(partial(file.readline, LONGEST_LINE + 1), b"")):
        if number >= MOST_LINES or len(line) > LONGEST_LINE:
            raise ValueError(f"more than {MOST_LINES} lines, or one of more than {LONGEST_LINE} characters")
        yield line
