"""A table of the calibration in the place of that of the package: never one with fewer scenes or kinds."""

import os
from collections import Counter
from pathlib import Path

from validation.engine.files import write_given
from validation.scenes.printable import printable
from validation.selection.calibrate import CalibrationRun
from validation.simulation.calibration import TABLE, rows_of, table


def check_installable(run: CalibrationRun, path: Path = TABLE) -> None:
    """Raises ValueError, before anything is measured, where a run has fewer scenes than the table that is there."""
    if not (os.access(path, os.W_OK) and os.access(path.parent, os.W_OK)):
        raise ValueError(f"--install must be allowed to write {printable(path)}, the table of the package")
    there = {(row["kind"], row["quantity"], row["number"]) for row in rows_of(path)}
    _check(
        Counter(f"{point.kind} {point.quantity}" for point in run.points),
        Counter(f"{kind} {quantity}" for kind, quantity, _ in there),
    )


def install(measured: Path, path: Path = TABLE) -> None:
    """Raises ValueError where a model has fewer scenes in the table that was measured than in the one that is there."""
    _check(_scenes_of_models(measured), _scenes_of_models(path))
    write_given(path, measured.read_bytes())
    table.cache_clear()


def _scenes_of_models(path: Path) -> Counter[str]:
    return Counter(f"{row['kind']} {row['quantity']}, {row['model']}" for row in rows_of(path))


def _check(mine: Counter[str], there: Counter[str]) -> None:
    for what, count in there.items():
        if mine[what] < count:
            raise ValueError(
                f"--install must leave as many scenes as the table of the package has, {count} of {what}, "
                f"got {mine[what]}"
            )
