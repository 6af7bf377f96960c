"""Tables of transverse profiles: places across the track and heights, of a rail or a wheel."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.scenes.number_table import NumberTable, TableForm
from validation.scenes.printable import printable
from validation.scenes.table_files import PLAIN, heights_of_columns, read_table
from validation.scenes.transverse_profile import TransverseProfile
from validation.scenes.units import in_unit

FloatArray = NDArray[np.float64]

COLUMNS = "y [mm],height [mm]"
"""The header of a file, in other units of length too."""
SAME_PLACE = 1e-4
"""How far behind an end points of a vertical flank may lie [m]."""


def read_profile(
    name: str, path: Path, form: TableForm = PLAIN, *, metre: float | None = None, flip: bool = False
) -> tuple[TransverseProfile, tuple[str, ...]]:
    """Profile of a file, y in either order, and what was assumed of it, in sentences.

    metre: the unit of both columns [m], where they do not name it; flip: whether heights of the file point away from
    the other body. Raises OSError for a file that cannot be read, ValueError for one that holds no profile.
    """
    table = read_table(name, path, form)
    try:
        y, height = _in_metres(table, metre)
        known = np.isfinite(y) & np.isfinite(height)
        y, height, of_ends = _ascending(y[known], height[known] * (-1 if flip else 1))
        profile = TransverseProfile(y=tuple(y.tolist()), height=tuple(height.tolist()), source=path.name)
    except ValueError as problem:
        raise ValueError(f"{name} {printable(path)}: {printable(problem)}") from None
    missing = int((~known).sum())
    notes = (f"{missing} of its points have no data and are left out",) if missing else ()
    return profile, (*table.notes, *notes, *of_ends)


def _in_metres(table: NumberTable, metre: float | None) -> tuple[FloatArray, FloatArray]:
    """Places and heights [m]. Raises ValueError."""
    columns = table.columns
    if len(columns) != 2:
        raise ValueError(f"a profile must have two columns, as {COLUMNS!r}, got {len(columns)}: as: columns = [1, 2]")
    if metre is None and not (table.unit or all(column.unit for column in columns)):
        raise ValueError(
            f'the columns must be named as {COLUMNS!r}, with their units, got {table.names([0, 1])}: or as: unit = "mm"'
        )
    of_y = 1 if columns[1].name.lower() == "y" and columns[0].name.lower() != "y" else 0
    return heights_of_columns(table, [of_y], metre)[:, 0], heights_of_columns(table, [1 - of_y], metre)[:, 0]


def _ascending(y: FloatArray, height: FloatArray) -> tuple[FloatArray, FloatArray, tuple[str, ...]]:
    """The longest run of places that ascend. Beyond it flanks may turn back, of a flange or of the sides of a head.

    Raises ValueError where a point that is no part of it lies between its ends.
    """
    if y.size > 1 and y[0] > y[-1]:
        y, height = y[::-1], height[::-1]
    breaks = np.flatnonzero(np.diff(y) <= 0) + 1
    if not breaks.size:
        return y, height, ()
    first, last = max(zip([0, *breaks], [*breaks, y.size], strict=True), key=lambda run: run[1] - run[0])
    run, rest = y[first:last], np.concatenate([y[:first], y[last:]])
    if ((rest > run[0] + SAME_PLACE) & (rest < run[-1] - SAME_PLACE)).any():
        at = int(breaks[0])
        raise ValueError(f"y must ascend, got {y[at]:g} m behind {y[at - 1]:g} m")
    span = [in_unit(end, "length") for end in (run[0], run[-1])]
    note = f"it goes from {span[0]} to {span[1]} across: {rest.size} points of flanks that turn back are left out"
    return run, height[first:last], (note,)
