"""Measured lines along a rail, one or several side by side: their levels, and the files that have them."""

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
from validation.railway.scenes.line_columns import along_the_track
from validation.railway.scenes.line_edits import UNTOUCHED, LineEdits, Outliers, edited
from validation.scenes.measured_heights import MeasuredHeights, complete_heights, edited_lines, without_unknown_ends
from validation.scenes.number_table import NumberTable
from validation.scenes.reader import Reader, errors_of, one_word, table, values
from validation.scenes.table_files import FORM, read_scene_table, sentence_about
from validation.scenes.units import LENGTHS, in_unit, quantity, unit_of

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
