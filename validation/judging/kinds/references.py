"""References of the judges: what boundary elements have in a full report, as small files beside this module.

`from_report` writes them; each says in comments of which case, commit and settings it is.
"""

import csv
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from validation.analysis.contents import from_csv
from validation.analysis.evidence import Table
from validation.analysis.quantity import key_of, quantity_with
from validation.judging.judgement import DEVIATION, LEVEL, RATIO, Conditions

FOLDER = Path(__file__).with_suffix("")
VALUES = "value", "sample", "grid"


@dataclass(frozen=True)
class Reference:
    """A number of boundary elements.

    where: the conditions, by name; sample, grid: half-widths of 95 % that the surfaces and the cells leave, over the
    value, of levels in decibels. Where the report has both in one interval, that is the sample, and the grid is zero.
    unit: by which a number is compared with it.
    """

    where: Conditions
    value: float
    sample: float = 0.0
    grid: float = 0.0
    unit: str = RATIO
    quantity: str = ""

    def __getitem__(self, name: str) -> float:
        """A condition that is a number."""
        return float(self.where[name])


def reference_rows(*quantities: str, where: Conditions | None = None) -> list[Reference]:
    """All that is known of them under these conditions, point by point. Raises LookupError for one without a file."""
    return [row for quantity in quantities for row in _curve(quantity) if (where or {}).items() <= row.where.items()]


@cache
def _curve(quantity: str) -> Sequence[Reference]:
    stated = str(about(quantity).get("unit"))
    unit = next((unit for unit in (LEVEL, DEVIATION) if stated.startswith(unit)), RATIO)
    lines = (line for line in _lines(quantity) if not line.startswith("#"))
    references = []
    for row in rows_of(from_csv(quantity, "\n".join(lines))):
        value, sample, grid = (float(row.pop(name)) for name in VALUES)
        where = {name: place if isinstance(place, str) else float(place) for name, place in row.items()}
        references.append(Reference(where, value, sample, grid, unit, quantity))
    return references


def rows_of(table: Table) -> list[dict[str, Any]]:
    return [dict(zip(table.columns, row, strict=True)) for row in zip(*table.columns.values(), strict=True)]


@cache
def about(quantity: str) -> Mapping[str, Any]:
    """Unit, case, commit and settings behind a file."""
    pairs = (line[2:].partition(": ") for line in _lines(quantity) if line.startswith("# "))
    return {name: json.loads(value) if name == "settings" else value for name, _, value in pairs}


def quantities() -> list[str]:
    """Quantities that have a file of reference numbers."""
    return [quantity_with(str(about(path.stem)["quantity"])) for path in sorted(FOLDER.glob("*.csv"))]


def _lines(quantity: str) -> list[str]:
    path = FOLDER / file_name(quantity)
    if not path.exists():
        raise LookupError(f"quantity must be one of {', '.join(quantities())}, got {quantity!r}")
    return path.read_text(encoding="utf-8").splitlines()


def file_name(quantity: str) -> str:
    """The name of the CSV that has the reference numbers of a quantity."""
    return f"{key_of(quantity)}.csv"


def as_file(head: Mapping[str, Any], rows: Sequence[Reference]) -> bytes:
    """What `reference_rows` reads: the head as comments, then a row a point, to seven digits, errors to four."""
    lines = [f"# {name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in head.items()]
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow([*rows[0].where, *VALUES])
    for row in rows:
        places = [place if isinstance(place, str) else f"{place:.7g}" for place in row.where.values()]
        table.writerow([*places, f"{row.value:.7g}", f"{row.sample:.4g}", f"{row.grid:.4g}"])
    return "\n".join([*lines, text.getvalue()]).encode()
