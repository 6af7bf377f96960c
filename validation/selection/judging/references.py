"""References as data: what boundary elements have, with the errors of sample and grid."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).with_suffix("")
COLUMNS = ("value", "sample", "grid")


@dataclass(frozen=True)
class Reference:
    """where: the conditions; sample, grid: half-widths of 95 % over the value."""

    where: Mapping[str, float | str]
    value: float
    sample: float
    grid: float


@cache
def curve(quantity: str) -> list[Reference]:
    """All that is known of a quantity."""
    name = quantity.replace(",", "").replace(" ", "_")
    with (FOLDER / f"{name}.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [
        Reference(
            {name: float(row[name]) for name in row if name not in COLUMNS}, *(float(row[name]) for name in COLUMNS)
        )
        for row in rows
    ]
