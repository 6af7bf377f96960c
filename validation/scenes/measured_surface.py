"""Measured heights over an area, of an object or a file that has them, as they were asked for: cropped, filled in."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mdr.checks import positive
from validation.analysis.spectra import Detrend
from validation.analysis.statistics import FloatArray
from validation.scenes.measured import (
    FEWEST,
    HeightEdits,
    MeasuredHeights,
    central_square,
    check_grid,
    filled_in,
    points_to_fill,
    real_numbers,
)
from validation.scenes.number_table import NumberTable
from validation.scenes.positions import grid_of, metres_of_step, own_spacing, places_of
from validation.scenes.printable import shortened
from validation.scenes.reader import LENGTH, Reader, table, values
from validation.scenes.table_files import FORM, heights_of_columns, sentence_about, table_beside
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
    for name, wish in (("crop", crop), ("fill", fill)):
        if not isinstance(wish, bool):
            raise TypeError(f"{name} must be True or False, got {shortened(wish)}")
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
    return as_asked(height * metres, spacing, crop=crop, fill=fill, asked_by="fill=True", detrend=detrend)


def as_asked(
    height: FloatArray,
    spacing: tuple[float, float],
    *,
    crop: bool,
    fill: bool,
    asked_by: str,
    told: tuple[str, ...] = (),
    missing: str = "",
    detrend: Detrend = "plane",
) -> MeasuredHeights:
    """Heights in metres, NaN where there are no data, after the edits that were asked for.

    The square is cut out first, so that points without data count in it alone. asked_by: how fill is asked for; told:
    what was assumed of their file; missing: what stands in its cells without data; detrend: what is
    subtracted. Raises ValueError as `central_square`, `points_to_fill` and `MeasuredHeights`.
    """
    check_grid(height)
    part = central_square(height, spacing) if crop else height
    count, share = points_to_fill(part, fill=fill, asked_by=asked_by, missing=missing)
    cropped = None if part.shape == height.shape else height.shape
    edits = HeightEdits(filled=count, share=share, cropped_from=cropped, told=told)
    known = filled_in(part, spacing) if count else part
    return MeasuredHeights(height=known, spacing=spacing, edits=edits, detrend=detrend)


def _metres(surface: Any, given: str | None) -> float:
    """The unit of a surface, as it names it or as it is given. Raises ValueError for none, and for two."""
    info = getattr(surface, "info", None)
    noted = info.get("unit") if isinstance(info, Mapping) else None
    named = {"unit": getattr(surface, "unit", None), "info": noted, "unit=": given}
    factors = {metres_of("unit of the surface", one) for one in named.values() if one}
    if not factors:
        raise ValueError(
            'unit of the surface must be known, got an object that names none: measured(surface, unit="m") says it'
        )
    if len(factors) > 1:
        shown = " and ".join(f"{name} {shortened(one)}" for name, one in named.items() if one)
        raise ValueError(f"unit of the surface must be one, got {shown}")
    return factors.pop()


# Of a file in a scene


Spacing = tuple[float, float]
Face = tuple[FloatArray, Spacing | None, tuple[str, ...]]
"""Heights [m], their spacing [m] as far as it is known, and what was assumed."""


def heights_of(name: str, given: object, *, folder: Path) -> MeasuredHeights:
    """Of a table in a scene file: the file beside it, how to read it, spacing and unit, and what to do to the heights.

    Heights that are already there are those.
    """
    if isinstance(given, MeasuredHeights):
        return given
    readers: dict[str, Reader] = {
        **values("file"),
        "spacing": _spacing,
        "unit": unit_of,
        **FORM,
        **values("crop", "fill", "detrend"),
    }
    found = table(readers, tuple(readers)[1:], name, given)
    path, numbers = table_beside(name, found, folder)
    wishes = {"crop": found.get("crop", False), "fill": found.get("fill", False), "missing": numbers.missing}
    wishes["detrend"] = found.get("detrend", "plane")
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
    values, along, across = numbers.values, None, None
    if min(values.shape) > FEWEST:
        across = places_of(values[0, 1:]) if places_of(values[1:, 0]) else None
        across = None if across is None or across.gaps else across
        along = places_of(values[1 if across else 0 :, 0])
    if along is None or along.gaps:
        return _below_first_row(numbers, metre, spacing)
    axes = [(along, numbers.columns[0].unit, "first column"), *([(across, "", "first row")] if across else [])]
    height, notes = heights_of_columns(numbers, range(1, values.shape[1]), metre)[len(axes) - 1 :], []
    for (places, unit, what), given in zip(axes, spacing or (None, None), strict=False):
        step = metres_of_step(places.step, unit, given, f"the {what}")
        notes.append(f"its {what} runs evenly, {in_unit(step, 'length')} apart, and is left out of the heights")
    return height[tuple(slice(None, None, -1 if one.step < 0 else 1) for one, _, _ in axes)], spacing, tuple(notes)


def _below_first_row(numbers: NumberTable, metre: float | None, spacing: Spacing | None) -> Face:
    """A row for each x; a first row that runs evenly, as the second does not, has the places of y."""
    values = numbers.values
    height = heights_of_columns(numbers, range(values.shape[1]), metre)
    across = places_of(values[0]) if min(values.shape) > FEWEST and places_of(values[1]) is None else None
    if across is None or across.gaps:
        return height, spacing, ()
    step = metres_of_step(across.step, "", spacing[1] if spacing else None, "the first row")
    note = f"its first row runs evenly, {in_unit(step, 'length')} apart, and is left out of the heights"
    return height[1:, :: -1 if across.step < 0 else 1], spacing, (note,)


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


def _spacing(name: str, given: object) -> Spacing:
    """One distance of points for both axes, or two."""
    if not isinstance(given, list):
        both: float = LENGTH(name, given)
        return both, both
    if len(given) != 2:
        raise ValueError(f'{name} must be a length or two, as ["1 um", "2 um"] along x and y, got {shortened(given)}')
    return LENGTH(f"{name}[0]", given[0]), LENGTH(f"{name}[1]", given[1])
