"""Whether today's code measures what the table of the calibration holds: some of its scenes, measured again."""

from collections import defaultdict
from pathlib import Path

import numpy as np

from validation.engine.engine import SERIAL, Engine
from validation.engine.files import write_given
from validation.scenes.printable import printable
from validation.selection.calibrate import (
    MODEL_TOLERANCE,
    CalibrationScene,
    as_table,
    measure_errors,
    rows_of_point,
    today,
)
from validation.simulation.calibration import TABLE, code_behind, provenance, rows_of, table

SAME = 1e-3
"""Relative difference of an error measured again: the last bits of a solve are those of the machine, and its residual
leaves more than they do."""
Row = dict[str, str]


def check_calibration(
    scenes: int, engine: Engine = SERIAL, path: Path = TABLE, *, stamp: bool = False
) -> tuple[list[str], str]:
    """Measure so many scenes of each kind and quantity of a table again.

    stamp: whether today's code becomes that of all rows where these are the same; the table is left as it is
    otherwise. Returns the rows that differ, in words, and how many solves were measured.
    """
    rows, about = rows_of(path), provenance(path)
    if not rows:
        raise ValueError(f"no table of the calibration is in {printable(path)}")
    seed = int(about["command"].rsplit(" ", 1)[1])
    points = [point for group in _points(rows, seed).values() for point in _spread(group, scenes)]
    outcomes = engine.map(measure_errors, points)
    differing = [
        line
        for point, outcome in zip(points, outcomes, strict=True)
        for line in _differences(
            [row for row in rows if _point(row, seed) == point],
            [{name: str(value) for name, value in row.items()} for row in rows_of_point(point, outcome)],
        )
    ]
    solves = f"{len(points)} of {len({_point(row, seed) for row in rows})} solves"
    if stamp and not differing:
        checked = {**about, "checked": f"{today().isoformat()}, {solves}"}
        write_given(path, as_table(checked, [_with_code_of_today(row, seed) for row in rows]))
        table.cache_clear()
    return differing, solves


def _points(rows: list[Row], seed: int) -> dict[tuple[str, str], list[CalibrationScene]]:
    """Of each kind and quantity, those that have rows."""
    found = defaultdict(list)
    for point in dict.fromkeys(_point(row, seed) for row in rows):
        found[point.kind, point.quantity].append(point)
    return found


def _point(row: Row, seed: int) -> CalibrationScene:
    return CalibrationScene(kind=row["kind"], number=int(row["number"]), quantity=row["quantity"], seed=seed)


def _spread(points: list[CalibrationScene], count: int) -> list[CalibrationScene]:
    """From the first to the last."""
    return [points[i] for i in dict.fromkeys(np.linspace(0, len(points) - 1, count).astype(int).tolist())]


def _differences(rows: list[Row], again: list[Row]) -> list[str]:
    before, after = ({row["model"]: row for row in some} for some in (rows, again))
    name = f"{rows[0]['kind']} {rows[0]['number']}, {rows[0]['quantity']}"
    lines = [f"{name}, {model}: in the table or measured alone" for model in before.keys() ^ after.keys()]
    for model in before.keys() & after.keys():
        first, second = (float(some[model]["error"]) for some in (before, after))
        if abs(second - first) > SAME * first:
            lines.append(f"{name}, {model}: an error of {first:g} in the table, of {second:g} today")
    return sorted(lines)


def _with_code_of_today(row: Row, seed: int) -> Row:
    point = _point(row, seed)
    (model,) = (one for one in point.cheap if one.name == row["model"])
    return {**row, "code": code_behind(model, point.target(MODEL_TOLERANCE))}
