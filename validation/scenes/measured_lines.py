"""Measured lines along a rail, one or several side by side: their levels, and the files that have them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from mdr.checks import finite, positive
from validation.analysis.nominal_bands import NominalBands
from validation.analysis.statistics import FloatArray
from validation.scenes.height_edits import edited_lines, known_heights
from validation.scenes.measured import MeasuredHeights
from validation.scenes.number_table import NumberTable
from validation.scenes.positions import Places, metres_of_step, own_spacing, places_of, runs_one_way
from validation.scenes.printable import shortened
from validation.scenes.reader import Reader, errors_of, table, values
from validation.scenes.roughness_levels import LEAST, MICROMETRE, RoughnessLevels
from validation.scenes.table_files import FORM, heights_of_columns, sentence_about, table_beside
from validation.scenes.units import LENGTHS, in_unit, quantity, unit_of

WAVES_PER_LINE = 4
"""Of the longest band, at the least: with fewer waves it is narrower than what a line resolves."""
POINTS_PER_WAVE = 2.5
"""Of the shortest band, at the least: EN 15610 has 1 mm for 2.5 mm."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MeasuredLines:
    """Heights of parallel lines on a rail, shape (points, lines) or (points,), positive towards the wheel [m].

    spacing: of the points along the track [m]; positions: of the lines across it, ascending [m]; longest, shortest:
    nominal wavelengths of the first and the last band [m], None for all that lines of four waves and points of 2.5 to a
    wave have. Raises ValueError or TypeError for heights that are no real numbers, masked or not finite, positions that
    are not one a line and ascending, and waves that are too long for the lines or too short for the points.
    """

    height: FloatArray
    spacing: float
    positions: Sequence[float] = (0.0,)
    longest: float | None = None
    shortest: float | None = None

    def __post_init__(self) -> None:
        values = known_heights(self.height)
        height = values[:, np.newaxis] if values.ndim == 1 else values
        positive("spacing", self.spacing)
        positions = tuple(finite(f"positions[{i}]", position) for i, position in enumerate(self.positions))
        if height.ndim != 2 or height.shape[1] != len(positions):
            raise ValueError(
                f"positions must be one a line, got {len(positions)} for heights of shape {values.shape}, whose first "
                "axis is along the track"
            )
        if not all(np.diff(positions) > 0):
            raise ValueError(f"positions must ascend, got {positions}")
        object.__setattr__(self, "height", height)
        object.__setattr__(self, "positions", positions)
        self._check_bands()

    @classmethod
    def of_heights(cls, heights: MeasuredHeights) -> "MeasuredLines":
        """The lines of a measured surface along its first axis."""
        return cls(height=heights.height, spacing=heights.spacing[0], positions=heights.places[1].tolist())

    @property
    def length(self) -> float:
        """Of each line [m]."""
        return len(self.height) * self.spacing

    @cached_property
    def bands(self) -> NominalBands:
        """Those between the longest and the shortest wavelength."""
        longest = self.length / WAVES_PER_LINE if self.longest is None else self.longest
        shortest = POINTS_PER_WAVE * self.spacing if self.shortest is None else self.shortest
        try:
            return NominalBands().within(longest, shortest)
        except ValueError as reason:
            raise ValueError(
                f"spacing must be that of the points of the lines, as 1 mm, with longest above shortest: {reason}; got "
                f"{len(self.height)} points, {1e3 * self.spacing:g} mm apart"
            ) from None

    @cached_property
    def levels(self) -> RoughnessLevels:
        """Levels of the mean energy of all lines, which expects that of one and scatters less."""
        powers = self.bands.powers_of_records(self.height.T, spacing=self.spacing).mean(axis=0)
        empty = powers < MICROMETRE**2 * 10 ** (LEAST / 10)
        if empty.any() and not empty.all():
            raise ValueError(
                f"levels must lie above {LEAST:g} dB re 1 um, got less in bands of {self.bands.names(empty)}: longest "
                "and shortest leave them out, or is the unit another?"
            )
        count = len(self.positions)
        source = f"{count} measured {'line' if count == 1 else 'lines'}"
        return RoughnessLevels.of_powers(self.bands, powers, source=source)

    def _check_bands(self) -> None:
        slack = 1 + 1e-9
        if self.longest is not None and self.longest * WAVES_PER_LINE > self.length * slack:
            shown = [in_unit(value, "length") for value in (positive("longest", self.longest), self.length)]
            raise ValueError(f"longest must be a quarter of the lines at the most, {shown[1]} long, got {shown[0]}")
        if self.shortest is not None and self.shortest * slack < self.spacing * POINTS_PER_WAVE:
            shown = [in_unit(value, "length") for value in (positive("shortest", self.shortest), self.spacing)]
            raise ValueError(f"shortest must be {POINTS_PER_WAVE} points or more, {shown[1]} apart, got {shown[0]}")
        _ = self.bands


# Of a file in a scene


MOSTLY = 0.9
"""Of the rows of a column of places, at the least, that have one."""


def lines_in(name: str, given: object, *, folder: Path, told: list[str]) -> MeasuredLines:
    """Of a table in a scene file: the file beside it, and how to read it. told: takes what was assumed of it."""
    own: dict[str, Reader] = {"unit": unit_of, "positions": _positions}
    readers = values("file", "spacing") | own | values("longest", "shortest", "fill") | FORM
    found = table(readers, tuple(readers)[1:], name, given)
    path, numbers = table_beside(name, found, folder)
    with errors_of(f"{name}."):
        count = len(found["positions"]) if "positions" in found else None
        height, spacing, notes = _along_the_track(numbers, found.pop("unit", None), found.pop("spacing", None), count)
        if count is None and height.shape[1] > 1:
            raise ValueError(
                f"positions is missing: the file has {height.shape[1]} lines, whose places across the rail are needed, "
                'as: positions = ["-10 mm", "0 mm"]'
            )
        height, edits = edited_lines(height, fill=found.pop("fill", False), asked_by="fill = true")
        if count == height.shape[1]:
            order = np.argsort(found["positions"], kind="stable")
            found["positions"], height = np.array(found["positions"])[order].tolist(), height[:, order]
        measured = MeasuredLines(height=height, spacing=spacing, **found)
        if not np.ptp(measured.height, axis=0).any():
            raise ValueError("file must have heights that differ along a line, got zeros alone, or one other number")
        try:
            _ = measured.levels  # heights in a wrong unit are refused here, by their levels
        except ValueError as problem:
            raise ValueError(f'{problem} As: unit = "um"') from None
    told += [*sentence_about(path, (*numbers.notes, *notes)), *edits.notes]
    return measured


def _along_the_track(
    numbers: NumberTable, metre: float | None, spacing: float | None, count: int | None = None
) -> tuple[FloatArray, float, tuple[str, ...]]:
    """Heights of shape (points, lines) [m] in the order of their places, their spacing [m], and what was assumed.

    metre, spacing: as given; count: how many lines there are, if it is known. Raises ValueError that begins with a key.
    """
    numbers, spacing = _as_columns(numbers, metre, spacing)
    places, left_out = _kinds(numbers, count) if len(numbers.columns) > 1 else ({}, {})
    rest = [i for i in range(len(numbers.columns)) if i not in left_out]
    if not rest:
        raise ValueError(f"file must have heights beside places, got {numbers.names(sorted(left_out))} alone")
    notes = [f"{numbers.names([i])} {why} and is left out" for i, why in sorted(left_out.items()) if i not in places]
    height = heights_of_columns(numbers, rest, metre)
    if not places:
        if spacing is None:
            raise ValueError(
                'spacing is missing: no column of the file runs evenly, as places do, as: spacing = "1 mm"'
            )
        return height, spacing, tuple(notes)
    ((at, place),) = places.items()
    name = numbers.names([at])
    step = metres_of_step(place.step, numbers.columns[at].unit, spacing, name)
    lines = f"{numbers.names(rest)} {'is a line' if len(rest) == 1 else 'are lines'}"
    notes.append(f"{name} is the place along the track, {in_unit(step, 'length')} apart, and {lines}")
    if count not in (None, len(rest)):
        raise ValueError(f"positions must be one a line, got {count} for {len(rest)}: {notes[-1]}")
    whole = np.full((int(place.number[-1]) + 1, len(rest)), np.nan)
    whole[place.number] = height[np.isfinite(numbers.values[:, at])]
    if place.gaps:
        notes.append(f"{place.gaps} of its places have no row")
    return whole[:: -1 if place.step < 0 else 1], step, tuple(notes)


def _as_columns(numbers: NumberTable, metre: float | None, spacing: float | None) -> tuple[NumberTable, float | None]:
    """A column a line, and the spacing that is given, or that of an instrument. Raises ValueError."""
    values = numbers.values
    if values.ndim == 1 or (values.ndim == 2 and len(values) == 1):
        numbers = replace(numbers, values=values.reshape(-1, 1), columns=(), spacing=None)
    if numbers.values.ndim != 2:
        raise ValueError(f"file must have a column a line, got an array of shape {shortened(values.shape)}")
    alone = numbers.values.shape[1] == 1
    if numbers.spacing is not None and not alone:
        raise ValueError("file must have lines, got heights over an area: they belong to [rail.heights]")
    if alone and places_of(numbers.values[:, 0]):
        raise ValueError("file must have heights, got one column that runs evenly, as places do")
    return numbers, spacing if numbers.spacing is None else own_spacing(numbers, metre, [spacing])[0]


def _kinds(numbers: NumberTable, count: int | None) -> tuple[dict[int, Places], dict[int, str]]:
    """The column of places, if any, and why columns are no lines. Raises ValueError."""
    places: dict[int, Places] = {}
    constant: dict[int, str] = {}
    one_way = []
    for i in range(len(numbers.columns)):
        values = numbers.values[np.isfinite(numbers.values[:, i]), i]
        if values.size < MOSTLY * len(numbers.values):
            continue
        if found := places_of(values):
            places[i] = found
        elif runs_one_way(values):
            one_way.append(i)
        elif values.size and np.ptp(values) == 0:
            constant[i] = f"is {values[0]:g} everywhere"
    # beside places, or where all columns are told to be lines, a line may be as tilted as that
    if one_way and not places and count != len(numbers.columns):
        raise ValueError(
            f"columns must be lines of heights, got {numbers.names(one_way)}, which runs one way but not evenly, as "
            "places do that are not equally far apart: resample the lines, or leave it out by columns"
        )
    evenly = dict.fromkeys(places, "runs evenly")
    lines = len(numbers.columns) - len(evenly) - len(constant)
    return _one_place(numbers, places), {**evenly, **constant} if lines else evenly


def _one_place(numbers: NumberTable, places: dict[int, Places]) -> dict[int, Places]:
    """The one column of places among those that run evenly. Raises ValueError."""
    lengths = {i: one for i, one in places.items() if numbers.columns[i].unit in LENGTHS}
    unnamed = {i: one for i, one in places.items() if not numbers.columns[i].unit}
    found = lengths or {i: one for i, one in unnamed.items() if not one.counts} or unnamed
    if len(found) > 1:
        raise ValueError(
            f"columns must have one that runs evenly, the place along the track, got {numbers.names(sorted(found))}: "
            "say which to read by columns"
        )
    return found


def _positions(name: str, given: object) -> list[float]:
    if not isinstance(given, list):
        raise ValueError(f'{name} must be a list of lengths, as ["-10 mm", "0 mm"], got {shortened(given)}')
    return [quantity(f"{name}[{i}]", one, "length") for i, one in enumerate(given)]
