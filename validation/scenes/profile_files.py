"""Files of transverse profiles: a CSV of y and height, their units in the names of the columns."""

import re
from collections.abc import Sequence
from pathlib import Path

from validation.scenes.input_files import contents_of
from validation.scenes.printable import printable
from validation.scenes.transverse_profile import TransverseProfile
from validation.scenes.two_columns import numbers_of, rows_of_two
from validation.scenes.units import UNITS, quantity

MOST_BYTES = 5_000_000
COLUMNS = "y [mm],height [mm]"
"""The header of a file, in other units of length too; y_mm and height_mm do as well."""


def read_profile(name: str, path: Path) -> TransverseProfile:
    """Profile of a file, y in either order; lines that are blank or begin with a # do not count.

    Raises OSError for a file that cannot be read, ValueError for one that holds no profile; both name it.
    """
    contents = contents_of(name, path, most=MOST_BYTES)
    try:
        rows = rows_of_two(contents.decode("utf-8-sig"), f"a profile must have two columns, named as {COLUMNS!r}")
        metres = [_metre(cell, word, rows[0]) for cell, word in zip(rows[0], ("y", "height"), strict=True)]
        points = [(y * metres[0], height * metres[1]) for y, height in map(numbers_of, rows[1:])]
        if len(points) > 1 and points[0][0] > points[-1][0]:
            points.reverse()
        y, height = zip(*points, strict=True) if points else ((), ())
        return TransverseProfile(y=y, height=height, source=path.name)
    except ValueError as problem:
        raise ValueError(f"{name} {printable(path)}: {printable(problem)}") from None


def _metre(cell: str, word: str, header: Sequence[str]) -> float:
    """The unit of a column in metres, by its name."""
    words = re.findall(r"[a-zµμ]+", cell.replace("_", " "), flags=re.IGNORECASE)
    if len(words) != 2 or words[0].lower() != word or words[1] not in UNITS["length"]:
        raise ValueError(f"the columns must be named as {COLUMNS!r}, with their units, got {','.join(header)!r}")
    return quantity(word, f"1 {words[1]}", "length")
