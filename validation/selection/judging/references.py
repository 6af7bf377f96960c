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

from validation.analysis.judgement import DEVIATION, LEVEL, RATIO

FOLDER = Path(__file__).with_suffix("")
VALUES = "value", "sample", "grid"
Place = float | str


@dataclass(frozen=True)
class Reference:
    """A number of boundary elements.

    where: the conditions, by name; sample, grid: half-widths of 95 % that the surfaces and the cells leave, over the
    value, of levels in decibels. Where the report has both in one interval, that is the sample, and the grid is zero.
    unit: by which a number is compared with it.
    """

    where: Mapping[str, Place]
    value: float
    sample: float
    grid: float
    unit: str = RATIO


@cache
def curve(quantity: str) -> Sequence[Reference]:
    """All that is known of a quantity, point by point. Raises LookupError for one without a file."""
    rows = csv.DictReader(line for line in _lines(quantity) if not line.startswith("#"))
    stated = str(about(quantity).get("unit"))
    unit = LEVEL if stated.startswith(LEVEL) else DEVIATION if stated == DEVIATION else RATIO
    return [
        Reference({n: _cell(w) for n, w in row.items() if n not in VALUES}, value, sample, grid, unit)
        for row in rows
        for value, sample, grid in [[float(row[name]) for name in VALUES]]
    ]


@cache
def about(quantity: str) -> Mapping[str, Any]:
    """Unit, case, commit and settings behind a file."""
    pairs = (line[2:].partition(": ") for line in _lines(quantity) if line.startswith("# "))
    return {name: json.loads(value) if name == "settings" else value for name, _, value in pairs}


def quantities() -> list[str]:
    """That have a file."""
    return [str(about(path.stem)["quantity"]) for path in sorted(FOLDER.glob("*.csv"))]


def _lines(quantity: str) -> list[str]:
    path = FOLDER / file_name(quantity)
    if not path.exists():
        raise LookupError(f"quantity must be one of {', '.join(quantities())}, got {quantity!r}")
    return path.read_text(encoding="utf-8").splitlines()


def _cell(word: str) -> Place:
    try:
        return float(word)
    except ValueError:
        return word


def file_name(quantity: str) -> str:
    return f"{quantity.replace(',', '').replace(' ', '_')}.csv"


def as_file(head: Mapping[str, Any], rows: Sequence[Reference]) -> bytes:
    """What `curve` reads: the head as comments, then a row a point, to seven digits, errors to four."""
    lines = [f"# {name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in head.items()]
    cells = [
        [*map(_word, row.where.values()), f"{row.value:.7g}", f"{row.sample:.4g}", f"{row.grid:.4g}"] for row in rows
    ]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([[*rows[0].where, *VALUES], *cells])
    return "\n".join([*lines, text.getvalue()]).encode()


def _word(place: Place) -> str:
    return place if isinstance(place, str) else f"{place:.7g}"
