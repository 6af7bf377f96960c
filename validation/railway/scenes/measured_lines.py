"""Measured lines along a rail, one or several side by side: the columns that have them, their levels and files."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import get_args

import numpy as np

from mdr.checks import finite, positive
from validation.analysis.escapes import printable, shortened
from validation.analysis.spectra import Detrend, NominalBands
from validation.analysis.statistics import FloatArray
from validation.railway.scenes.level_files import LEAST, MICROMETRE, RoughnessLevels, curve
from validation.railway.scenes.line_edits import UNTOUCHED, LineEdits, Outliers, edited
from validation.railway.scenes.line_steps import STANDS_OUT, noise_among
from validation.scenes.measured_heights import MeasuredHeights, complete_heights, edited_lines, without_unknown_ends
from validation.scenes.number_table import (
    MOST_OFF,
    NumberTable,
    Places,
    faults_of_places,
    first_of_each,
    metres_of_step,
    own_spacing,
    places_of,
    runs_one_way,
)
from validation.scenes.reader import Reader, errors_of, one_word, table, values
from validation.scenes.table_files import FORM, heights_of_columns, read_scene_table, sentence_about
from validation.scenes.text_dialect import PLACE, Column
from validation.scenes.units import LENGTHS, UNITS, in_unit, quantity, unit_of

MOSTLY = 0.9
"""Of the rows of a column of places, at the least, that have one."""
EVEN = 1e-6
"""By how much the steps of a first row of places may differ, over one."""
EPOCH = 9e8, 2.2e9
"""Seconds since 1970 from 1998 to 2039; a place so far from its origin is in metres at most."""
TIME_NAMES = re.compile(r"(?i)(?:time|date|datum|zeit|uhrzeit|timestamp|time[ _-]?stamp|zeitstempel|utc|datetime)s?")
HALF = 0.5
"""Of its rows have heights, of a line that measured something, at the least."""
EVENLY = 3
"""Places of a first row that can run evenly, at the least."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Lines:
    """Heights of shape (points, lines) [m] in the order of their places, their spacing and positions [m], and notes."""

    height: FloatArray
    spacing: float
    positions: Sequence[float]
    notes: tuple[str, ...]


def along_the_track(
    numbers: NumberTable, metre: float | None, spacing: float | None, positions: Sequence[float] | None
) -> Lines:
    """metre, spacing, positions: as given. Raises ValueError that begins with a key."""
    numbers, spacing = _as_columns(numbers, metre, spacing)
    numbers, of_header = _without_first_row(numbers, positions)
    numbers, repeated = _without_repeats(numbers)
    several = len(numbers.columns) > 1
    places, left_out = _kinds(numbers, None if positions is None else len(positions)) if several else ({}, {})
    rest = [i for i in range(len(numbers.columns)) if i not in left_out]
    if not rest:
        raise ValueError(f"file must have heights beside places, got {numbers.names(sorted(left_out))} alone")
    height = heights_of_columns(numbers, rest, metre)
    where, dead = _positions_of(numbers, positions, rest, sorted(set(left_out) - set(places)))
    notes = [*of_header, *repeated]
    for i, why in sorted(left_out.items()):
        if i not in places:
            notes.append(f"{numbers.names([i])}{dead.get(i, '')} {why} and is left out")
    notes += _units_of_lines(numbers, rest)
    if not places:
        if spacing is None:
            raise ValueError(
                'spacing is missing: no column of the file runs evenly, as places do, as: spacing = "1 mm"'
            )
        return Lines(height=height, spacing=spacing, positions=where, notes=tuple(notes))
    ((at, place),) = places.items()
    name = numbers.names([at])
    step = metres_of_step(place.step, numbers.columns[at].unit, spacing, name)
    lines = f"{numbers.names(rest)} {'is a line' if len(rest) == 1 else 'are lines'}"
    notes.append(f"{name} is the place along the track, {in_unit(step, 'length')} apart, and {lines}")
    on_grid = np.full((int(place.number[-1]) + 1, len(rest)), np.nan)
    has_place = np.isfinite(numbers.values[:, at])
    on_grid[place.number] = height[has_place]
    if not has_place.all():
        count = int((~has_place).sum())
        notes.append(
            f"{count} {'row has' if count == 1 else 'rows have'} no place and {'is' if count == 1 else 'are'} left out"
        )
    if place.gaps:
        notes.append(f"{place.gaps} of its places have no row, the first behind {place.before_gap:.6g}")
    ordered = on_grid[:: -1 if place.step < 0 else 1]
    return Lines(height=ordered, spacing=step, positions=where, notes=tuple(notes))


def _units_of_lines(numbers: NumberTable, rest: Sequence[int]) -> list[str]:
    """What is said where lines of one file are in several units."""
    units = dict.fromkeys(numbers.columns[i].unit for i in rest)
    return [f"its lines are in {' and '.join(units)}, each in its own"] if len(units) > 1 and all(units) else []


def _positions_of(
    numbers: NumberTable, positions: Sequence[float] | None, rest: Sequence[int], dead: Sequence[int]
) -> tuple[Sequence[float], dict[int, str]]:
    """Of the lines that are left, and those of the others in words. Raises ValueError.

    Positions may be those of all lines, or of those that measured something.
    """
    lines = sorted([*rest, *dead])
    if positions is None:
        if len(rest) == 1:
            return (0.0,), {}
        row = numbers.values[0, rest]
        even = np.isfinite(row).all() and _runs_evenly(row)
        # places in the names of columns, or an example
        names = [PLACE.fullmatch(numbers.columns[i].name) for i in rest]
        named = [f"{name[1].replace(',', '.')} {name[2] or 'mm'}" for name in names if name]
        first = ", and its first row runs evenly, as such places do" if even else ""
        if len(named) == len(rest):
            first, example = (
                ", which the names of its columns may be",
                "[" + ", ".join(f'"{place}"' for place in named) + "]",
            )
        else:
            example = _as_key(row if even else np.asarray(10.0 * np.arange(-(len(rest) // 2), (len(rest) + 1) // 2)))
        raise ValueError(
            f"positions is missing: the file has {len(rest)} lines, whose places across the rail are needed{first}, "
            f"as: positions = {example}"
        )
    if len(positions) == len(lines):
        shown = {i: f" at {1e3 * positions[lines.index(i)]:g} mm" for i in dead}
        return [positions[lines.index(i)] for i in rest], shown
    if len(positions) != len(rest):
        without = f", without {numbers.names(dead)}, which measured nothing" if dead else ""
        those = "line" if len(rest) == 1 else "lines"
        raise ValueError(
            f"positions must be one a line, got {len(positions)} for {len(rest)} {those}, {numbers.names(rest)}"
            f"{without}, in a table of {len(numbers.values)} rows"
        )
    return positions, {}


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


def _without_first_row(numbers: NumberTable, positions: Sequence[float] | None) -> tuple[NumberTable, tuple[str, ...]]:
    """Less a first row that has the positions of the lines in place of heights. Raises ValueError where none are given.

    It has those that are given in some unit, or it runs evenly and is far from the rows below it.
    """
    row, below = numbers.values[0], numbers.values[1:]
    if numbers.spacing is not None or len(below) < 50 or row.size < 2:
        return numbers, ()
    has_value = np.isfinite(row)
    # of places along the track the first row may have none, or any number
    for first in (0, 1):
        inside = row[first:]
        if inside.size < 2 or not has_value[first:].all():
            continue
        has_positions = positions is not None and len(positions) == inside.size and _are(inside, np.array(positions))
        if not has_positions and not (_runs_evenly(inside) and _is_far(inside, below[:, first:])):
            continue
        shown = ", ".join(f"{value:g}" for value in inside)
        if positions is None:
            raise ValueError(
                f"positions is missing: the first row of the file, {shown}, runs evenly and is far from the others, as "
                f"positions do, as: positions = {_as_key(inside)}"
            )
        return replace(numbers, values=below), (f"its first row, {shown}, has positions and is no row of heights",)
    return numbers, ()


def _without_repeats(numbers: NumberTable) -> tuple[NumberTable, tuple[str, ...]]:
    """Less rows that have the place of the row before, as of a trolley that stood still, and a note of them."""
    for i in range(len(numbers.columns) if len(numbers.columns) > 1 else 0):
        values = numbers.values[:, i]
        kept = first_of_each(values)
        if kept.all() or kept.mean() < 1 - MOST_OFF or places_of(values[kept]) is None:
            continue
        at = int(np.argmin(kept))
        count = int((~kept).sum())
        words = f"{count} {'row repeats' if count == 1 else 'rows repeat'} the place of the row before"
        note = f"{words}, the first {values[at]:.6g} in row {at + 1}, and {'is' if count == 1 else 'are'} left out"
        return replace(numbers, values=numbers.values[kept]), (note,)
    return numbers, ()


def _as_key(row: FloatArray) -> str:
    """Numbers as positions in a scene file, which nearly all are in millimetres."""
    return "[" + ", ".join(f'"{value:g} mm"' for value in row) + "]"


def _are(row: FloatArray, positions: FloatArray) -> bool:
    """Whether numbers are lengths in some unit."""
    return any(np.allclose(row * float(metre), positions, rtol=1e-6, atol=1e-12) for metre in UNITS["length"].values())


def _runs_evenly(row: FloatArray) -> bool:
    steps = np.diff(row)
    even = np.abs(steps - steps.mean()).max() <= EVEN * abs(float(steps.mean()))
    return row.size >= EVENLY and bool(even and steps[0] != 0)


def _is_far(row: FloatArray, below: FloatArray) -> bool:
    """Whether most numbers of a row are further from the next than any two neighbours of their column are, about."""
    jumps = np.abs(np.diff(below, axis=0))
    usual = np.nanmedian(jumps, axis=0) / 0.6745
    far = np.abs(row - below[0]) > STANDS_OUT * usual
    return 2 * int(far.sum()) > row.size


def _kinds(numbers: NumberTable, count: int | None) -> tuple[dict[int, Places], dict[int, str]]:
    """The column of places, if any, and why columns are no lines. Raises ValueError."""
    places: dict[int, Places] = {}
    nothing: dict[int, str] = {}
    one_way = []
    for i in range(len(numbers.columns)):
        values = numbers.values[np.isfinite(numbers.values[:, i]), i]
        if (share := values.size / len(numbers.values)) < HALF:
            nothing[i] = f"has no data in {100 - 100 * share:.3g} % of its rows" if values.size else "has no data"
        if values.size < MOSTLY * len(numbers.values):
            continue
        if is_time(numbers.columns[i], values):
            nothing[i] = "has time stamps"
        elif place := places_of(values):
            places[i] = place
        elif runs_one_way(values):
            one_way.append(i)
        elif np.ptp(values) == 0:
            nothing[i] = f"is {values[0]:g} everywhere"
        elif fault := faults_of_places(values):
            raise ValueError(
                f"columns must have places that run evenly, got {numbers.names([i])}, which {fault}: cut the file there"
            )
    # beside places, or where all columns are told to be lines, a line may be as tilted as that
    if one_way and not places and count != len(numbers.columns):
        fault = faults_of_places(numbers.values[:, one_way[0]])
        raise ValueError(
            f"columns must be lines of heights, got {numbers.names(one_way)}, which runs one way but not evenly, as "
            f"places do that are not equally far apart{fault and ': it '}{fault}: resample the lines, or leave it out "
            "by columns"
        )
    evenly = dict.fromkeys(places, "runs evenly")
    rest = [i for i in range(len(numbers.columns)) if i not in evenly and i not in nothing]
    heights = [numbers.values[np.isfinite(numbers.values[:, i]), i] for i in rest]
    nothing |= {rest[i]: "is noise, whose neighbouring points have nothing in common," for i in noise_among(heights)}
    lines = len(numbers.columns) - len(evenly) - len(nothing)
    return _one_place(numbers, places), {**evenly, **nothing} if lines else evenly


def is_time(column: Column, values: FloatArray) -> bool:
    """Whether a column that runs one way has times: by its name, or as seconds or milliseconds since 1970."""
    if not (np.diff(values) >= 0).all() or values[0] == values[-1] or column.unit in LENGTHS:
        return False
    since = any(EPOCH[0] * scale <= values[0] and values[-1] <= EPOCH[1] * scale for scale in (1.0, 1e3, 1e6, 1e9))
    return bool(TIME_NAMES.fullmatch(column.name.strip()) or (since and not column.unit))


def _one_place(numbers: NumberTable, places: dict[int, Places]) -> dict[int, Places]:
    """The one column of places among those that run evenly. Raises ValueError."""
    lengths = {i: place for i, place in places.items() if numbers.columns[i].unit in LENGTHS}
    unnamed = {i: place for i, place in places.items() if not numbers.columns[i].unit}
    candidates = lengths or {i: place for i, place in unnamed.items() if not place.counts} or unnamed
    if len(candidates) > 1:
        raise ValueError(
            f"columns must have one that runs evenly, the place along the track, got "
            f"{numbers.names(sorted(candidates))}: say which to read by columns"
        )
    return candidates


WAVES_PER_LINE = 4
"""Of the longest band, at the least: with fewer waves it is narrower than what a line resolves."""
SMOOTHEST, ROUGHEST = -35.0, 45.0
"""Levels of a rail re the limit curve of ISO 3095 [dB], in the middle: others are heights in another unit."""
POINTS_PER_WAVE = 2.5
"""Of the shortest band, at the least: EN 15610 has 1 mm for 2.5 mm."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MeasuredLines:
    """Heights of parallel lines on a rail, shape (points, lines) or (points,), positive towards the wheel [m].

    spacing: of the points along the track [m]; positions: of the lines across it, ascending [m]; longest, shortest:
    nominal wavelengths of the first and the last band [m], None for all that lines of four waves and points of 2.5 to a
    wave have; detrend: what is subtracted from each line before its spectrum; edits: what was wrong in the lines, as
    `edited` finds it, whose error the levels have.

    Raises ValueError or TypeError for heights that are no real numbers, masked or not finite, positions that are not
    one a line and ascending, and waves that are too long for the lines or too short for the points.
    """

    height: FloatArray
    spacing: float
    positions: Sequence[float] = (0.0,)
    longest: float | None = None
    shortest: float | None = None
    detrend: Detrend = "plane"
    edits: LineEdits = UNTOUCHED

    def __post_init__(self) -> None:
        values = complete_heights(self.height)
        height = values[:, np.newaxis] if values.ndim == 1 else values
        positive("spacing", self.spacing)
        one_word("detrend", self.detrend, words=get_args(Detrend))
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
        of_lines = self.bands.powers_of_records(self.height.T, spacing=self.spacing, detrend=self.detrend)
        powers = of_lines.mean(axis=0)
        empty = powers < MICROMETRE**2 * 10 ** (LEAST / 10)
        if empty.any() and not empty.all():
            raise ValueError(
                f"levels must lie above {LEAST:g} dB re 1 um, got less in bands of {self.bands.names(empty)}: longest "
                "and shortest leave them out, or is the unit another?"
            )
        count = len(self.positions)
        source = f"{count} measured {'line' if count == 1 else 'lines'}"
        errors = self.edits.errors(self.bands, of_lines)
        return RoughnessLevels.of_powers(self.bands, powers, source=source, errors=errors, fault=self.edits.fault)

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


def lines_in(name: str, value: object, *, folder: Path, notes: list[str]) -> MeasuredLines:
    """Of a table in a scene file: the file beside it, and how to read it. notes: takes what was assumed of it."""
    own: dict[str, Reader] = {"unit": unit_of, "positions": _positions, "outliers": _outliers}
    readers = values("file", "spacing") | own | values("longest", "shortest", "fill", "detrend") | FORM
    entries = table(readers, tuple(readers)[1:], name, value)
    path, numbers = read_scene_table(name, entries, folder)
    with errors_of(f"{name}."):
        unit, spacing, positions = (entries.pop(key, None) for key in ("unit", "spacing", "positions"))
        lines = along_the_track(numbers, unit, spacing, positions)
        fill = entries.pop("fill", False)
        height, ends = (lines.height, ()) if fill else without_unknown_ends(lines.height)
        height, edits = edited_lines(height, fill=fill, asked_by="fill = true", missing=numbers.missing)
        if not np.ptp(height, axis=0).any():
            raise ValueError("file must have heights that differ along a line, got zeros alone, or one other number")
        order = np.argsort(lines.positions, kind="stable")
        flaws = edited(height[:, order], lines.spacing, entries.pop("outliers", "remove"))
        measured = MeasuredLines(
            height=flaws.result(height[:, order]),
            spacing=lines.spacing,
            positions=np.array(lines.positions)[order].tolist(),
            edits=flaws,
            **entries,
        )
        try:
            _ = measured.levels  # heights in a wrong unit are refused here, by their levels
        except ValueError as problem:
            raise ValueError(f"{problem} If so, {_other_unit(numbers)}") from None
    if unit is None and (doubt := _doubt(measured.levels, _other_unit(numbers))):
        measured = replace(measured, edits=replace(flaws, doubt=doubt))
        notes.append(f"{printable(path.name)}: {doubt}.")
    notes += [*sentence_about(path, (*numbers.notes, *lines.notes, *ends)), *edits.notes]
    notes += [f"{printable(path.name)}: {sentence}" for sentence in flaws.notes(measured.positions)]
    return measured


def _other_unit(numbers: NumberTable) -> str:
    """Keys that say another unit of heights than a file does: of one that names units the header is left out."""
    if not numbers.unit and not any(column.unit in LENGTHS for column in numbers.columns):
        return 'as: unit = "um"'
    return f'skip = {numbers.header} leaves out the header, beside unit = "um" and spacing = "1 mm"'


def _doubt(levels: RoughnessLevels, other: str) -> str:
    """What is wrong with the unit that a file names; empty where nothing is. other: the keys that change it.

    The middle of the differences from the limit curve of ISO 3095, in the bands that both have.
    """
    limit = dict(zip(*(getattr(curve("iso3095-2013"), of) for of in ("wavelengths", "levels")), strict=True))
    both = zip(levels.wavelengths, levels.levels, strict=True)
    over = float(np.median([level - limit[wave] for wave, level in both if wave in limit] or [0.0]))
    if SMOOTHEST <= over <= ROUGHEST:
        return ""
    return (
        f"the levels are {over:+.0f} dB re the limit curve of ISO 3095, which no rail has: is the unit another "
        f"than the file names? If so, {other}"
    )


def _positions(name: str, value: object) -> list[float]:
    if not isinstance(value, list):
        raise ValueError(f'{name} must be a list of lengths, as ["-10 mm", "0 mm"], got {shortened(value)}')
    return [quantity(f"{name}[{i}]", position, "length") for i, position in enumerate(value)]


_outliers = partial(one_word, words=get_args(Outliers))
