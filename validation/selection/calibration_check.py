"""A table of the calibration: some of its scenes measured again, and one in the place of that of the package."""

import os
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np

from validation.engine.engine import SERIAL, Engine
from validation.engine.files import write_given
from validation.scenes.printable import printable
from validation.selection.calibrate import (
    CalibrationRun,
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
    of_point, groups = defaultdict[CalibrationScene, list[Row]](list), defaultdict[str, list[CalibrationScene]](list)
    for row in rows:
        of_point[_point(row, seed)].append(row)
    for point in of_point:
        groups[f"{point.kind} {point.quantity}"].append(point)
    points = [point for group in groups.values() for point in _spread(group, scenes)]
    outcomes = engine.map(measure_errors, points)
    differing = [
        line
        for point, outcome in zip(points, outcomes, strict=True)
        for line in _differences(of_point[point], rows_of_point(point, outcome))
    ]
    solves = f"{len(points)} of {sum(map(len, groups.values()))} solves"
    if stamp and not differing:
        checked = {**about, "checked": f"{today().isoformat()}, {solves}"}
        write_given(path, as_table(checked, [_with_code_of_today(row, seed) for row in rows]))
        table.cache_clear()
    return differing, solves


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
    return {**row, "code": code_behind(model, point.target())}


def check_installable(run: CalibrationRun, path: Path = TABLE) -> None:
    """Raises ValueError, before anything is measured, where a run has fewer scenes than the table that is there."""
    if not (os.access(path, os.W_OK) and os.access(path.parent, os.W_OK)):
        raise ValueError(f"--install must be allowed to write {printable(path)}, the table of the package")
    there = {(row["kind"], row["quantity"], row["number"]) for row in rows_of(path)}
    _refuse_fewer(
        Counter(f"{point.kind} {point.quantity}" for point in run.points),
        Counter(f"{kind} {quantity}" for kind, quantity, _ in there),
    )


def install(measured: Path, path: Path = TABLE) -> None:
    """Raises ValueError where a model has fewer scenes in the table that was measured than in the one that is there."""
    _refuse_fewer(_scenes_of_models(measured), _scenes_of_models(path))
    write_given(path, measured.read_bytes())
    table.cache_clear()


def _scenes_of_models(path: Path) -> Counter[str]:
    return Counter(f"{row['kind']} {row['quantity']}, {row['model']}" for row in rows_of(path))


def _refuse_fewer(mine: Counter[str], there: Counter[str]) -> None:
    for what, count in there.items():
        if mine[what] < count:
            raise ValueError(
                f"--install must leave as many scenes as the table of the package has, {count} of {what}, "
                f"got {mine[what]}"
            )
