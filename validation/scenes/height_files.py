"""Files of measured heights over an area: rows along x, or x, y and height in three columns, or of an instrument."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.scenes.measured import FEWEST, MeasuredHeights
from validation.scenes.measured_surface import as_asked, metres_of
from validation.scenes.number_table import NumberTable
from validation.scenes.positions import grid_of, metres_of_step, own_spacing, places_of
from validation.scenes.printable import shortened
from validation.scenes.reader import LENGTH, Reader, nonblank_text, table, yes_or_no
from validation.scenes.table_files import FORM, heights_of_columns, sentence_about, table_beside
from validation.scenes.units import in_unit

FloatArray = NDArray[np.float64]
Spacing = tuple[float, float]
Face = tuple[FloatArray, Spacing | None, tuple[str, ...]]
"""Heights [m], their spacing [m] as far as it is known, and what was assumed."""


def heights_of(name: str, given: object, *, folder: Path) -> MeasuredHeights:
    """Of a table in a scene file: the file beside it, how to read it, spacing and unit, and what to do to the heights.

    Heights that are already there are those.
    """
    if isinstance(given, MeasuredHeights):
        return given
    readers: dict[str, Reader] = {"file": nonblank_text, "spacing": _spacing, "unit": unit_of, **FORM}
    readers |= {"crop": yes_or_no, "fill": yes_or_no}
    found = table(readers, tuple(readers)[1:], name, given)
    path, numbers = table_beside(name, found, folder)
    wishes = {key: found.get(key, False) for key in ("crop", "fill")}
    try:
        height, known, notes = _face(numbers, found.get("unit"), found.get("spacing"))
        if known is None:
            raise ValueError(f'spacing is missing, {name} must have it, as: spacing = "1 um"')
        told = sentence_about(path, (*numbers.notes, *notes))
        return as_asked(height, known, **wishes, asked_by="fill = true", told=told)
    except ValueError as problem:
        separator = "." if str(problem).partition(" ")[0] in readers else ": "
        raise ValueError(f"{name}{separator}{problem}") from None


def _face(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """Heights over an area of any of the forms of a file. Raises ValueError."""
    values = numbers.values
    if values.ndim != 2 or not values.size:
        return values, spacing or (1.0, 1.0), ()
    if numbers.spacing is not None:
        if len(numbers.spacing) != 2:
            raise ValueError("file must have heights over an area, got one line: it belongs to [rail.lines]")
        dx, dy = own_spacing(numbers, metre, spacing or (None, None))
        return heights_of_columns(numbers, range(values.shape[1]), metre), (dx, dy), ()
    if {"x", "y", "z"} <= {column.name.lower() for column in numbers.columns}:
        numbers = numbers.chosen(["x", "y", "z"])
    if numbers.values.shape[1] == 3 and len(values) > FEWEST:
        return _of_three(numbers, metre, spacing)
    return _of_rows(numbers, metre, spacing)


def _of_rows(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """A row for each x, without its places: those of x in the first column, and of y in a first row."""
    values, given = numbers.values, spacing or (None, None)
    if min(values.shape) <= FEWEST:
        return heights_of_columns(numbers, range(values.shape[1]), metre), spacing, ()
    across = places_of(values[0, 1:])
    top = 0 if across is None or across.gaps or places_of(values[1:, 0]) is None else 1
    along = places_of(values[top:, 0])
    if along is None or along.gaps:
        return heights_of_columns(numbers, range(values.shape[1]), metre), spacing, ()
    height, notes = heights_of_columns(numbers, range(1, values.shape[1]), metre)[top:], []
    for places, unit, own, what in (
        (along, numbers.columns[0].unit, given[0], "first column"),
        *([(across, "", given[1], "first row")] if top and across else []),
    ):
        step = metres_of_step(places.step, unit, own, f"the {what}")
        notes.append(f"its {what} runs evenly, {in_unit(step, 'length')} apart, and is left out of the heights")
    turned = height[:: -1 if along.step < 0 else 1]
    return turned[:, :: -1 if top and across and across.step < 0 else 1], spacing, tuple(notes)


def _of_three(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """x, y and height in columns of these names, or in this order."""
    named = [column.name.lower() for column in numbers.columns]
    x, y = (named.index("x"), named.index("y")) if {"x", "y"} <= set(named) else (0, 1)
    z = 3 - x - y
    height, steps = grid_of(numbers.values[:, x], numbers.values[:, y], heights_of_columns(numbers, [z], metre)[:, 0])
    units = [numbers.columns[i].unit for i in (x, y)]
    dx, dy = (
        metres_of_step(*one, numbers.names([x, y])) for one in zip(steps, units, spacing or (None, None), strict=True)
    )
    size = " x ".join(map(str, height.shape))
    shown = f"{in_unit(dx, 'length')} and {in_unit(dy, 'length')}"
    return height, (dx, dy), (f"its columns are x, y and height of {size} points, {shown} apart",)


def unit_of(name: str, given: object) -> float:
    """How many metres one of a unit of heights is."""
    try:
        return metres_of(name, given)
    except ValueError as problem:
        raise ValueError(f'{problem}, as: unit = "um"') from None


def _spacing(name: str, given: object) -> Spacing:
    """One distance of points for both axes, or two."""
    if not isinstance(given, list):
        both: float = LENGTH(name, given)
        return both, both
    if len(given) != 2:
        raise ValueError(f'{name} must be a length or two, as ["1 um", "2 um"] along x and y, got {shortened(given)}')
    return LENGTH(f"{name}[0]", given[0]), LENGTH(f"{name}[1]", given[1])
