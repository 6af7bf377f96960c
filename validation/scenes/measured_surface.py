"""Measured heights over an area, of an object or a file that has them, as they were asked for: cropped, filled in."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mdr.checks import positive
from validation.analysis.escapes import shortened
from validation.analysis.spectra import Detrend
from validation.analysis.statistics import FloatArray
from validation.scenes.measured_heights import (
    FEWEST,
    HeightEdits,
    MeasuredHeights,
    central_square,
    check_grid,
    filled_in,
    points_to_fill,
    real_numbers,
)
from validation.scenes.number_table import NumberTable, grid_of, metres_of_step, own_spacing, places_of
from validation.scenes.reader import LENGTH, Reader, table, values
from validation.scenes.table_files import FORM, heights_of_columns, read_scene_table, sentence_about
from validation.scenes.units import in_unit, metres_of, unit_of


def measured(
    surface: Any, *, unit: str | None = None, crop: bool = False, fill: bool = False, detrend: Detrend = "plane"
) -> MeasuredHeights:
    """Measured heights of any object with heights and a size, as the `Topography` of SurfaceTopography.

    Parameters
    ----------
    surface : object
        With ``heights``, an array of shape (nx, ny) or a method that returns one, and ``physical_sizes``, (Lx, Ly).
        Both are in the unit that ``surface.unit`` or ``surface.info["unit"]`` names, or in the given one.
    unit : str or None, optional
        Of an object that names none: "m", "mm", "um", "nm" or another length. None: the object names it.
    crop : bool, optional
        Whether to cut out the central square, as the face of a punch needs it.
    fill : bool, optional
        Whether to fill in points without data, NaN or masked, where they are fewer than 1 %: by harmonic interpolation
        from their neighbours.
    detrend : "none", "mean" or "plane", optional
        What is subtracted from the heights: nothing, their mean, or their mean plane, which is the default.

    Returns
    -------
    MeasuredHeights
        Heights, by default about their mean plane, for the ``ground`` of a scene. Its notes and the description of
        the scene say what was cropped and filled in.

    Raises
    ------
    TypeError
        If the object has no heights or no size, or ``crop`` or ``fill`` are no bool.
    ValueError
        If points have no data and are not to be filled in or are too many, heights are infinite, there is no square to
        crop, sizes are not valid, or there is no unit, or more than one.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> heights = np.random.default_rng(1).standard_normal((64, 64))
    >>> face = validation.measured(SimpleNamespace(heights=heights, physical_sizes=(1000, 1000), unit="um"))
    >>> print(f"rms height {face.rms:.3g} m on {face.sides[0]:.3g} m")
    rms height 1e-06 m on 0.001 m
    """
    if not (hasattr(surface, "heights") and hasattr(surface, "physical_sizes")):
        raise TypeError(f"surface must have heights and physical_sizes, got {type(surface).__name__}")
    for name, option in (("crop", crop), ("fill", fill)):
        if not isinstance(option, bool):
            raise TypeError(f"{name} must be True or False, got {shortened(option)}")
    height = real_numbers(surface.heights() if callable(surface.heights) else surface.heights)
    sizes = surface.physical_sizes
    if not isinstance(sizes, (Sequence, np.ndarray)) or height.ndim != 2 or len(sizes) != 2:
        raise ValueError(
            f"heights must be two-dimensional with two physical_sizes, got shape {height.shape} and {shortened(sizes)}"
            ": an object is right that has an array of shape (nx, ny) and physical_sizes=(Lx, Ly)"
        )
    lengths = [positive(f"physical_sizes[{i}]", size) for i, size in enumerate(sizes)]
    metres = _metres(surface, unit)
    sides = [length * metres for length in lengths]
    spacing = sides[0] / max(height.shape[0], 1), sides[1] / max(height.shape[1], 1)
    return edit_heights(height * metres, spacing, crop=crop, fill=fill, asked_by="fill=True", detrend=detrend)


def edit_heights(
    height: FloatArray,
    spacing: tuple[float, float],
    *,
    crop: bool,
    fill: bool,
    asked_by: str,
    assumptions: tuple[str, ...] = (),
    missing: str = "",
    detrend: Detrend = "plane",
) -> MeasuredHeights:
    """Heights in metres, NaN where there are no data, after the edits that were asked for.

    The square is cut out first, so that points without data count in it alone. asked_by: how fill is asked for;
    assumptions: sentences about their file; missing: what stands in its cells without data; detrend: what is
    subtracted. Raises ValueError as `central_square`, `points_to_fill` and `MeasuredHeights`.
    """
    check_grid(height)
    part = central_square(height, spacing) if crop else height
    count, share = points_to_fill(part, fill=fill, asked_by=asked_by, missing=missing)
    cropped = None if part.shape == height.shape else height.shape
    edits = HeightEdits(filled=count, share=share, cropped_from=cropped, assumptions=assumptions)
    complete = filled_in(part, spacing) if count else part
    return MeasuredHeights(height=complete, spacing=spacing, edits=edits, detrend=detrend)


def _metres(surface: Any, argument: str | None) -> float:
    """The unit of a surface in metres, by its own name or the argument. Raises ValueError for none, and for two."""
    info = getattr(surface, "info", None)
    info_unit = info.get("unit") if isinstance(info, Mapping) else None
    units = {"unit": getattr(surface, "unit", None), "info": info_unit, "unit=": argument}
    factors = {metres_of("unit of the surface", unit) for unit in units.values() if unit}
    if not factors:
        raise ValueError(
            'unit of the surface must be known, got an object that names none: measured(surface, unit="m") says it'
        )
    if len(factors) > 1:
        listing = " and ".join(f"{name} {shortened(unit)}" for name, unit in units.items() if unit)
        raise ValueError(f"unit of the surface must be one, got {listing}")
    return factors.pop()


# Of a file in a scene


Spacing = tuple[float, float]
Face = tuple[FloatArray, Spacing | None, tuple[str, ...]]
"""Heights [m], their spacing [m] as far as it is known, and what was assumed."""


def heights_of(name: str, value: object, *, folder: Path) -> MeasuredHeights:
    """Heights of a table in a scene file: a file, how to read it, spacing and unit, and the edits of the heights.

    MeasuredHeights in place of a table are returned as they are.
    """
    if isinstance(value, MeasuredHeights):
        return value
    readers: dict[str, Reader] = {
        **values("file"),
        "spacing": _read_spacing,
        "unit": unit_of,
        **FORM,
        **values("crop", "fill", "detrend"),
    }
    settings = table(readers, tuple(readers)[1:], name, value)
    path, numbers = read_scene_table(name, settings, folder)
    edits = {"crop": settings.get("crop", False), "fill": settings.get("fill", False), "missing": numbers.missing}
    edits["detrend"] = settings.get("detrend", "plane")
    try:
        height, spacing, notes = _face(numbers, settings.get("unit"), settings.get("spacing"))
        if spacing is None:
            raise ValueError(f'spacing is missing, {name} must have it, as: spacing = "1 um"')
        assumptions = sentence_about(path, (*numbers.notes, *notes))
        return edit_heights(height, spacing, **edits, asked_by="fill = true", assumptions=assumptions)
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
        return _face_of_points(numbers, metre, spacing)
    return _face_of_rows(numbers, metre, spacing)


def _face_of_rows(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """Heights in rows, one for each x, less the places of x in the first column, and of y in a first row."""
    values, along, across = numbers.values, None, None
    if min(values.shape) > FEWEST:
        across = places_of(values[0, 1:]) if places_of(values[1:, 0]) else None
        across = None if across is None or across.gaps else across
        along = places_of(values[1 if across else 0 :, 0])
    if along is None or along.gaps:
        return _face_below_first_row(numbers, metre, spacing)
    axes = [(along, numbers.columns[0].unit, "first column"), *([(across, "", "first row")] if across else [])]
    height, notes = heights_of_columns(numbers, range(1, values.shape[1]), metre)[len(axes) - 1 :], []
    for (places, unit, what), length in zip(axes, spacing or (None, None), strict=False):
        step = metres_of_step(places.step, unit, length, f"the {what}")
        notes.append(f"its {what} runs evenly, {in_unit(step, 'length')} apart, and is left out of the heights")
    return height[tuple(slice(None, None, -1 if axis.step < 0 else 1) for axis, _, _ in axes)], spacing, tuple(notes)


def _face_below_first_row(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """Heights in rows, one for each x; a first row that runs evenly, as the second does not, has the places of y."""
    values = numbers.values
    height = heights_of_columns(numbers, range(values.shape[1]), metre)
    across = places_of(values[0]) if min(values.shape) > FEWEST and places_of(values[1]) is None else None
    if across is None or across.gaps:
        return height, spacing, ()
    step = metres_of_step(across.step, "", spacing[1] if spacing else None, "the first row")
    note = f"its first row runs evenly, {in_unit(step, 'length')} apart, and is left out of the heights"
    return height[1:, :: -1 if across.step < 0 else 1], spacing, (note,)


def _face_of_points(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """Heights on the grid of three columns: x, y and height by these names, or in this order."""
    named = [column.name.lower() for column in numbers.columns]
    x, y = (named.index("x"), named.index("y")) if {"x", "y"} <= set(named) else (0, 1)
    z = 3 - x - y
    height, steps = grid_of(numbers.values[:, x], numbers.values[:, y], heights_of_columns(numbers, [z], metre)[:, 0])
    units = [numbers.columns[i].unit for i in (x, y)]
    dx, dy = (
        metres_of_step(step, unit, length, numbers.names([x, y]))
        for step, unit, length in zip(steps, units, spacing or (None, None), strict=True)
    )
    size = " x ".join(map(str, height.shape))
    shown = f"{in_unit(dx, 'length')} and {in_unit(dy, 'length')}"
    return height, (dx, dy), (f"its columns are x, y and height of {size} points, {shown} apart",)


def _read_spacing(name: str, value: object) -> Spacing:
    """The distances of points along both axes, of a length for both or a list of two [m]."""
    if not isinstance(value, list):
        length: float = LENGTH(name, value)
        return length, length
    if len(value) != 2:
        raise ValueError(f'{name} must be a length or two, as ["1 um", "2 um"] along x and y, got {shortened(value)}')
    return LENGTH(f"{name}[0]", value[0]), LENGTH(f"{name}[1]", value[1])
