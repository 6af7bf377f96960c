"""Text files of two columns, their units in the names of these: what stands in each line, and numbers in a row."""

import csv
from collections.abc import Sequence

from validation.scenes.printable import shortened


def rows_of_two(text: str, must: str) -> list[list[str]]:
    """Both cells of each line that is neither blank nor behind a #, the header first.

    must: the beginning of the sentence, what such a file must have. Raises ValueError for no line, and for one that has
    not two cells between semicolons, commas or tabs, whichever the header has.
    """
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    sign = next((sign for sign in (";", ",", "\t") if sign in "".join(lines[:1])), ",")
    rows = [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=sign)]
    if not rows:
        raise ValueError(f"{must}, got none")
    for row in rows:
        if len(row) != 2:
            raise ValueError(
                f"{must}, got {shortened(sign.join(row))}: a line that is none of these begins with a #, and numbers "
                "have decimal points"
            )
    return rows


def numbers_of(row: Sequence[str]) -> tuple[float, float]:
    """Both cells as numbers. Raises ValueError for a text that is none."""
    try:
        return float(row[0]), float(row[1])
    except ValueError:
        shown = " and ".join(map(repr, row))
        raise ValueError(f"a row must be two numbers, with decimal points, got {shown}") from None
