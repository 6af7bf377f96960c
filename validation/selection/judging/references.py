"""References of the judges: the curves of a full report, as small files beside this module."""

import csv
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from validation.analysis.statistics import FloatArray

FOLDER = Path(__file__).with_name("references")
VALUES = "value", "sample", "grid"
MADE_BY = "mdr-validation calibrate --references REPORT"
Place = float | str


@dataclass(frozen=True, eq=False)
class Curve:
    """A quantity of boundary elements along a parameter.

    where: the conditions, by name; along, at: the parameter and its values; value; sample, grid: half-widths of 95 % that
    the surfaces and the cells leave, in the unit of the value. Where the report has both in one interval that is the
    sample, and the grid is zero.
    """

    quantity: str
    where: Mapping[str, Place]
    along: str
    at: FloatArray
    value: FloatArray
    sample: FloatArray
    grid: FloatArray

    @property
    def error(self) -> FloatArray:
        """Both together, as the report adds them."""
        return np.asarray(self.sample + self.grid)

    def points(self) -> Iterator[tuple[dict[str, Place], float, float]]:
        """Of each point the place, the value and its error."""
        for at, value, error in zip(self.at.tolist(), self.value.tolist(), self.error.tolist(), strict=True):
            yield {**self.where, self.along: at}, value, error


def curve(quantity: str, **where: Place) -> Curve:
    """The one curve under these conditions. Raises LookupError where it is none, or one of several."""
    found = [one for one in curves(quantity) if where.items() <= one.where.items()]
    if len(found) != 1:
        raise LookupError(f"one curve of {quantity!r} must have {where}, got {len(found)}")
    return found[0]


@cache
def curves(quantity: str) -> tuple[Curve, ...]:
    """All of a quantity. Raises LookupError for a quantity without a file."""
    names, rows = _table(quantity)
    *conditions, along = names[: -len(VALUES)]
    parted = groupby(rows, key=lambda row: [row[name] for name in conditions])
    return tuple(_curve(quantity, conditions, along, list(some)) for _, some in parted)


def _curve(quantity: str, conditions: Sequence[str], along: str, rows: Sequence[Mapping[str, Place]]) -> Curve:
    columns = (np.array([float(row[name]) for row in rows]) for name in (along, *VALUES))
    at, value, sample, grid = (np.nan_to_num(column) for column in columns)
    return Curve(quantity, {name: rows[0][name] for name in conditions}, along, at, value, sample, grid)


@cache
def about(quantity: str) -> Mapping[str, Any]:
    """Unit, case, commit and settings behind a file."""
    lines = [line[2:] for line in _text(quantity).splitlines() if line.startswith("# ")]
    pairs = (line.partition(": ") for line in lines)
    return {name: json.loads(value) if name == "settings" else value for name, _, value in pairs}


def quantities() -> list[str]:
    """That have a file."""
    return sorted(path.stem.replace("_", " ") for path in FOLDER.glob("*.csv"))


def _text(quantity: str) -> str:
    path = FOLDER / file_name(quantity)
    if not path.exists():
        raise LookupError(f"quantity must be one of {', '.join(quantities())}, got {quantity!r}")
    return path.read_text(encoding="utf-8")


def _table(quantity: str) -> tuple[list[str], list[dict[str, Place]]]:
    names, *rows = csv.reader(line for line in _text(quantity).splitlines() if not line.startswith("#"))
    return names, [dict(zip(names, map(_cell, row), strict=True)) for row in rows]


def _cell(word: str) -> Place:
    try:
        return float(word or math.nan)
    except ValueError:
        return word


def file_name(quantity: str) -> str:
    return f"{quantity.replace(' ', '_')}.csv"


def as_file(head: Mapping[str, Any], rows: Sequence[Mapping[str, Place]]) -> bytes:
    """What `curves` reads: the head as comments, a row a point, seven digits; values are the last three columns."""
    lines = [f"# {name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in head.items()]
    cells = [[f"{cell:.7g}" if isinstance(cell, float) else str(cell) for cell in row.values()] for row in rows]
    quoted = [",".join(f'"{cell}"' if "," in cell else cell for cell in row) for row in [list(rows[0]), *cells]]
    return ("\n".join([*lines, *quoted]) + "\n").replace("nan", "").encode()
