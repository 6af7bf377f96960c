"""Results and tables as the contents of files, and back: strict JSON, and CSV."""

import csv
import io
import json
import math
import re
from collections.abc import Sequence

from validation.analysis.evidence import Table

BOOLEAN = {"True": True, "False": False}
INTEGER = re.compile(r"-?\d+")


def as_json(value: object) -> bytes:
    """Readable, in the order of the value, strict: no NaN, no infinity."""
    return (json.dumps(value, indent=1, allow_nan=False, ensure_ascii=False) + "\n").encode()


def as_csv(table: Table) -> bytes:
    """Numbers to ten digits, more than any curve shows; what is not finite is left empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.columns)
    for row in zip(*table.columns.values(), strict=True):
        writer.writerow(_cell(value) for value in row)
    return text.getvalue().encode()


def _cell(value: object) -> object:
    if not isinstance(value, float):
        return value
    return f"{value:.10g}" if math.isfinite(value) else ""


def from_csv(name: str, text: str) -> Table:
    """What `as_csv` wrote: numbers, NaN where a column of numbers is empty, True and False, else text."""
    names, *rows = csv.reader(io.StringIO(text))
    found = list(zip(*rows, strict=True)) or [()] * len(names)
    return Table(name, {column: _values(cells) for column, cells in zip(names, found, strict=True)})


def as_written(table: Table) -> Table:
    """What a reader of its CSV file has."""
    return from_csv(table.name, as_csv(table).decode())


def _values(cells: Sequence[str]) -> Sequence[object]:
    """Of one column, which has one type."""
    if all(cell in BOOLEAN for cell in cells):
        return [BOOLEAN[cell] for cell in cells]
    if all(INTEGER.fullmatch(cell) for cell in cells):
        return [int(cell) for cell in cells]
    try:
        return [float(cell) if cell else math.nan for cell in cells]
    except ValueError:
        return cells
