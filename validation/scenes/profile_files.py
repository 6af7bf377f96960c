"""Tables of transverse profiles: places across the track and heights, of a rail or a wheel."""

from pathlib import Path

import numpy as np
import scipy
from numpy.typing import NDArray

from validation.scenes.height_files import unit_of
from validation.scenes.measured_surface import LENGTHS
from validation.scenes.number_table import NumberTable
from validation.scenes.printable import printable
from validation.scenes.reader import Reader, nonblank_text, table, yes_or_no
from validation.scenes.table_files import FORM, heights_of_columns, sentence_about, table_beside
from validation.scenes.transverse_profile import TransverseProfile
from validation.scenes.units import in_unit

FloatArray = NDArray[np.float64]

COLUMNS = "y [mm],height [mm]"
"""The header of a file, in other units of length too."""
SAME_PLACE, HIDDEN, FLANK = 1e-4, 1e-3, 2e-3
"""How far points of a flank may turn back, lie below the profile, where the other body never comes, and beyond [m]."""
APART = 1e-6
"""How far apart points are, at the least [m]: between closer ones a spline would follow their noise."""
KNOTS, DENSE = 1e-3, 6
"""Distance of the knots of the spline that smooths a profile [m], with so many points to each or more."""


def profile_in(name: str, given: object, *, folder: Path, told: list[str]) -> TransverseProfile:
    """Of a file beside a scene: its name, or a table that has it and says how to read it. y runs in either order.

    told: takes what was assumed. Raises OSError for a file that cannot be read, ValueError for one that holds none.
    """
    readers: dict[str, Reader] = {"file": nonblank_text, "unit": unit_of, "flip": yes_or_no, **FORM}
    found = table(readers, tuple(readers)[1:], name, {"file": given} if isinstance(given, str) else given)
    key = name if isinstance(given, str) else f"{name}.file"
    path, numbers = table_beside(name, found, folder, key=key)
    try:
        y, height = _in_metres(numbers, found.get("unit"))
        known = np.isfinite(y) & np.isfinite(height)
        y, height, of_ends = _ascending(y[known], height[known] * (-1 if found.get("flip") else 1))
        smooth, of_noise = _smoothed(y, height)
        profile = TransverseProfile(y=tuple(y.tolist()), height=tuple(smooth.tolist()), source=path.name)
    except ValueError as problem:
        raise ValueError(f"{key} {printable(path)}: {printable(problem)}") from None
    missing = int((~known).sum())
    notes = (f"{missing} of its points have no data and are left out",) if missing else ()
    told += sentence_about(path, (*numbers.notes, *notes, *of_ends, *of_noise))
    return profile


def _in_metres(table: NumberTable, metre: float | None) -> tuple[FloatArray, FloatArray]:
    """Places and heights [m]. Raises ValueError."""
    lengths = [i for i, column in enumerate(table.columns) if column.unit in LENGTHS]
    if len(lengths) == 2:
        table = table.chosen([i + 1 for i in lengths])
    columns = table.columns
    if len(columns) != 2:
        raise ValueError(
            f"a profile must have two columns, as {COLUMNS!r}, got {table.names(range(len(columns)))}: say which to "
            f"read, as: columns = [{len(columns) - 1}, {len(columns)}]"
        )
    if metre is None and not (table.unit or all(column.unit for column in columns)):
        raise ValueError(
            f'the columns must be named as {COLUMNS!r}, with their units, got {table.names([0, 1])}: or as: unit = "mm"'
        )
    of_y = 1 if columns[1].name.lower() == "y" and columns[0].name.lower() != "y" else 0
    return heights_of_columns(table, [of_y], metre)[:, 0], heights_of_columns(table, [1 - of_y], metre)[:, 0]


def _ascending(y: FloatArray, height: FloatArray) -> tuple[FloatArray, FloatArray, tuple[str, ...]]:
    """From the highest point to both sides, as far as places ascend. Beyond, flanks turn back under the profile.

    Raises ValueError where points that are left out would be seen by the other body.
    """
    if y.size < 2:
        return y, height, ()
    top = int(np.argmax(height))
    if y[max(top - 1, 0)] > y[min(top + 1, y.size - 1)]:
        y, height, top = y[::-1], height[::-1], y.size - 1 - top
    kept = np.concatenate([top - _onward(-y[top::-1])[:0:-1], top + _onward(y[top:])])
    run, of_run = y[kept], height[kept]
    if run.size < 2:
        raise ValueError(f"y must ascend, got {y[0]:g} m first and {y[-1]:g} m last, and nowhere two in a row")
    rest = np.setdiff1d(np.arange(y.size), kept)
    below = height[rest] < np.interp(y[rest], run, of_run) - HIDDEN
    next_to = np.searchsorted(run, y[rest]).clip(1, run.size - 1)
    near = np.minimum(np.abs(run[next_to] - y[rest]), np.abs(run[next_to - 1] - y[rest])) <= SAME_PLACE
    beyond = (y[rest] < run[0] - FLANK) | (y[rest] > run[-1] + FLANK)
    if ((~below & ~near) | beyond).any():
        at = int(np.argmax(np.diff(y) <= 0))
        raise ValueError(f"y must ascend, got {y[at + 1]:g} m behind {y[at]:g} m")
    span = [in_unit(end, "length") for end in (run[0], run[-1])]
    note = f"it goes from {span[0]} to {span[1]} across: {rest.size} points that turn back are left out"
    return run, of_run, (note,) if rest.size else ()


def _onward(y: FloatArray) -> NDArray[np.intp]:
    """Those that go on upwards, up to where places turn back by more than a flank scatters."""
    most = np.maximum.accumulate(y)
    turned = np.flatnonzero(most - y > SAME_PLACE)
    return np.flatnonzero(np.append(True, y[1:] > most[:-1] + APART)[: turned[0] if turned.size else y.size])


def _smoothed(y: FloatArray, height: FloatArray) -> tuple[FloatArray, tuple[str, ...]]:
    """A cubic spline of least squares through many points: what is shorter than its knots is noise, or roughness."""
    if y.size < 2 * DENSE:
        return height, ()
    each = round(KNOTS / float(np.median(np.diff(y))))
    if not DENSE <= each < y.size / DENSE:
        return height, ()
    knots = np.concatenate([y[[0] * 4], y[each:-each:each], y[[-1] * 4]])
    smooth = np.asarray(scipy.interpolate.make_lsq_spline(y, height, knots)(y))
    off = in_unit(float(np.sqrt(np.mean((smooth - height) ** 2))), "length", digits=2)
    return smooth, (
        f"a spline with a knot every {in_unit(KNOTS, 'length')} smooths its points, which are {off} rms off it",
    )
