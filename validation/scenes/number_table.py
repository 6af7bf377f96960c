"""A table of numbers in a text of others: levels, lines, heights and profiles as they are exported.

Some columns are places: they run evenly, count the points, or stand for the axes of a grid.
"""

import codecs
import math
import re
from array import array
from collections import Counter
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import IO

import numpy as np
from numpy.typing import NDArray

from validation.analysis.escapes import quoted
from validation.analysis.statistics import FloatArray
from validation.scenes import text_dialect
from validation.scenes.text_dialect import COMMENTS, Column, Dialect, about_row, columns_of, token, unit_of_all
from validation.scenes.units import UNITS, in_unit, metres_of

MOST_VALUES = 2**24
"""Of a table: 4096 x 4096 heights."""
SENTINELS = (-999.0, -9999.0, -99999.0, -32768.0, -32767.0, 32767.0, 9999.0, 99999.0, 999999.0)
"""What instruments write where they have no data; beyond `HUGE` no number is a height."""
HUGE, LONELY = 1e30, 3.0
"""LONELY: how many spans of all other numbers lie between them and such a value, at the least."""
NUMERIC = re.compile(r"[+-]?\d+\.?\d*")
UP_TO_999, LIKE_THOUSANDS = re.compile(r"[+-]?\d{1,3}"), re.compile(r"[+-]?[1-9]\d{0,2}(?:[.,]\d{3})+")
FEWEST_SIGNS, HUNDRED = 10, 3
"""Whole numbers below a thousand, and others as they may be written beside these; cells of a column with a sign that
may stand between thousands, and digits of a whole number beside them, at the least."""
MOST_SHOWN = 12
"""Texts of cells without data that a sentence names."""
FEW = 8
"""Columns of a table whose columns may be different quantities."""


@dataclass(frozen=True, kw_only=True)
class TableForm:
    """What a scene says about a table, None where recognition decides.

    skip: lines at the top that are none of the table; columns: names or numbers, from one, of those to read; decimal:
    "." or ","; encoding: a name of Python; nodata: numbers or texts of points without data; key: the array of an .npz.
    """

    skip: int | None = None
    columns: tuple[str | int, ...] | None = None
    decimal: str | None = None
    encoding: str | None = None
    nodata: tuple[str | float, ...] = ()
    key: str | None = None

    @property
    def of_text(self) -> list[str]:
        """Keys about the writing of a text that have a value."""
        return [name for name in ("skip", "decimal", "encoding") if getattr(self, name) is not None]


@dataclass(frozen=True, eq=False, kw_only=True)
class NumberTable:
    """Numbers of shape (rows, columns), NaN without data; a name a column; the unit of all; how it was read.

    spacing: of the points along the axes in that unit, where the file has it, which an instrument wrote; missing: what
    stands in cells without data, and how often; header: lines of a text above its numbers.
    """

    values: FloatArray
    columns: tuple[Column, ...] = ()
    unit: str = ""
    spacing: tuple[float, ...] | None = None
    notes: tuple[str, ...] = ()
    missing: str = ""
    header: int = 0

    def __post_init__(self) -> None:
        if not self.columns and self.values.ndim > 1:
            object.__setattr__(self, "columns", (Column(),) * self.values.shape[1])

    def names(self, places: Sequence[int]) -> str:
        """Columns as a sentence has them: by their names, or by their numbers where they have none."""
        words = [token(str(self.columns[i]), bare=True) or f"column {i + 1}" for i in places[:FEW]]
        return " and ".join(words) + (f" and {len(places) - FEW} more" if len(places) > FEW else "")

    def chosen(self, columns: Sequence[str | int] | None) -> "NumberTable":
        """The columns that are asked for, in this order. Raises ValueError for one that is not there."""
        if columns is None:
            return self
        places = [self._column_index(column) for column in columns]
        return replace(self, values=self.values[:, places], columns=tuple(self.columns[i] for i in places))

    def _column_index(self, column: str | int) -> int:
        """Index of the column with this name, or this number from one. Raises ValueError unless there is just one."""
        width = len(self.columns)
        if isinstance(column, int):
            if not 1 <= column <= width:
                raise ValueError(f"columns must be numbers from 1 to {width}, or names, got {column}")
            return column - 1
        matches = [i for i, candidate in enumerate(self.columns) if candidate.is_called(column)]
        if len(matches) != 1:
            names = [candidate.written or candidate.name for candidate in self.columns[:FEW]]
            available = ", ".join(map(quoted, filter(None, names))) or "without names"
            raise ValueError(
                f"columns must name one column each, got {quoted(column)}: the table has {width}, {available}"
            )
        return matches[0]


def table_of_text(file: IO[bytes], form: TableForm) -> NumberTable:
    """The table of a CSV or another text, read as its first lines are written. ValueError names a key.

    Where columns are chosen, others may be texts.
    """
    lines, encoding = text_dialect.lines_of(file, form.encoding)
    if form.columns is not None:
        with suppress(ValueError):
            return _parse_table(lines, encoding, form, None)
    return _parse_table(lines, encoding, form, None if form.columns is None else len(form.columns))


def _parse_table(lines: Sequence[str], encoding: str, form: TableForm, numeric: int | None) -> NumberTable:
    """The table of these lines, its sentinels masked, its columns chosen. numeric: as of a `Dialect`."""
    skip, nodata = form.skip or 0, frozenset(str(value).strip().lower() for value in form.nodata)
    sample = text_dialect.sample_of(lines, skip)
    dialect, first, width = text_dialect.recognise_dialect(sample, skip, form.decimal, nodata, numeric)
    _check_thousands(sample[first:], first, dialect, width)
    values, below, missing, grouped = _parse_rows(lines[first:], first, dialect, width)
    above = lines[skip:first]
    units, columns = unit_of_all(above), columns_of(above, width, dialect.delimiter)
    unit = units.pop() if len(units) == 1 and not any(column.unit for column in columns) else ""
    notes = _dialect_notes(dialect, width, lines[:first], encoding)
    notes += (f"{below} {'line' if below == 1 else 'lines'} below its numbers",) if below else ()
    notes += (f"{grouped} of its rows have a sign between thousands",) if grouped else ()
    notes += (f"cells without a number have no data: {_missing_summary(missing)}",) if _has_errors(missing) else ()
    notes += (f"its header has the unit {unit}",) if unit else ()
    if width > 1 and np.isnan(values[:, -1]).all() and not columns[-1].name:
        # a delimiter at the end of each line
        values, columns = values[:, :-1], columns[:-1]
    table = NumberTable(
        values=values, columns=columns, unit=unit, notes=notes, missing=_missing_summary(missing), header=first
    )
    return mask_sentinels(table, form.nodata).chosen(form.columns)


def _check_thousands(lines: Sequence[str], first: int, dialect: Dialect, columns: int) -> None:
    """Raises ValueError where a decimal sign may stand between thousands.

    A column then has whole numbers below a thousand, and three digits behind each sign.
    """
    if dialect.sure:
        return
    rows = [(i, dialect.cells(line)) for i, line in enumerate(lines, first) if dialect.row(line) == columns]
    for column in zip(*(cells for _, cells in rows), strict=True):
        bare = ((i, cell.strip().strip('"').strip()) for (i, _), cell in zip(rows, column, strict=True))
        texts = {i: text for i, text in bare if not dialect.says_missing(text)}
        signed = {i: text for i, text in texts.items() if dialect.decimal in text}
        whole_numbers = [text for text in texts.values() if UP_TO_999.fullmatch(text)]
        both = len(signed) >= FEWEST_SIGNS and any(len(text) >= HUNDRED for text in whole_numbers)
        if (
            both
            and len(signed) + len(whole_numbers) == len(texts)
            and all(map(LIKE_THOUSANDS.fullmatch, signed.values()))
        ):
            at = min(signed)
            raise ValueError(text_dialect.about_thousands(signed[at], at))


def _parse_rows(
    lines: Iterable[str], first: int, dialect: Dialect, width: int
) -> tuple[FloatArray, int, Counter[str], int]:
    """Rows, up to the first line without a number; how many lines stand below, none of which has one.

    Also cells without data by what stands in them, and how many rows have signs between thousands.
    """
    numbers, below, problem = array("d"), 0, ""
    missing, grouped = Counter[str](), 0
    for index, line in enumerate(lines, first):
        if dialect.says_nothing(line):
            continue
        cells = dialect.cells(line)
        try:
            if len(cells) != width or below:
                raise ValueError
            plain = dialect.plain(cells)
            numbers.extend(dialect.numbers(cells) if plain is None else plain)
            if plain is None or any(map(math.isnan, plain)):
                missing.update(token(cell, bare=True) for cell in cells if dialect.says_missing(cell))
                grouped += any(dialect.without_thousands(text) != text for text in (cell.strip() for cell in cells))
        except ValueError:
            problem = problem or about_row(line, index, dialect, width)
            if any(map(text_dialect.STARTS, cells)):
                raise ValueError(problem) from None
            below += 1
        if len(numbers) > MOST_VALUES * max(1, 3 * (width == 3)):
            raise ValueError(f"the table must hold at most {MOST_VALUES} heights, got more")
    return np.frombuffer(numbers, dtype=np.float64).reshape(-1, width), below, missing, grouped


def _missing_summary(missing: Counter[str]) -> str:
    """What stands in cells without data, and how often; nothing of empty ones."""
    shown = [f"{text} {count}" for text, count in missing.most_common(MOST_SHOWN) if text]
    return ", ".join(shown) + (f" and {len(missing) - MOST_SHOWN} others" if len(missing) > MOST_SHOWN else "")


def _has_errors(missing: Counter[str]) -> bool:
    """Whether a cell without data holds an error of a spreadsheet, as #DIV/0!."""
    return any(text_dialect.ERRORS.fullmatch(text.lower()) for text in missing)


def mask_sentinels(table: NumberTable, nodata: Sequence[str | float] = ()) -> NumberTable:
    """The table with NaN in place of the values of nodata, and of sentinels of instruments far from all data."""
    values, notes, missing = table.values, list(table.notes), [table.missing]
    nodata_numbers = [
        float(value) for value in nodata if not isinstance(value, str) or NUMERIC.fullmatch(value.strip())
    ]
    absent = np.isin(values, nodata_numbers)
    for i in range(values.shape[1]) if values.shape[1] <= FEW else [slice(None)]:
        part = values[:, i]
        huge = np.isfinite(part) & (np.abs(part) > HUGE)
        masks = {
            f"{value:g}": part == value
            for value in SENTINELS
            if value not in nodata_numbers and _is_lonely(part, value)
        }
        for label, mask in [*masks.items(), *([(f"more than {HUGE:g}", huge)] if huge.any() else [])]:
            absent[:, i] |= mask
            notes.append(f"{label} stands for no data at {int(mask.sum())} of {part.size} points, far from all others")
            missing.append(f"{label} {int(mask.sum())}")
    if not absent.any():
        return table
    values = np.where(absent, np.nan, values)
    return replace(table, values=values, notes=tuple(notes), missing=", ".join(filter(None, missing)))


def _is_lonely(values: FloatArray, sentinel: float) -> bool:
    """Whether a sentinel occurs and lies more than `LONELY` spans of all data from them."""
    if not (values == sentinel).any():
        return False
    data = values[np.isfinite(values) & (np.abs(values) <= HUGE) & ~np.isin(values, SENTINELS)]
    if data.size < FEW:
        return False
    low, high = float(data.min()), float(data.max())
    return max(low - sentinel, sentinel - high) > LONELY * (high - low)


def _dialect_notes(dialect: Dialect, width: int, header: Sequence[str], encoding: str) -> tuple[str, ...]:
    """How a text differs from a plain CSV with commas, points, one line of names and UTF-8, in a note; none if not."""
    delimiter = (
        {";": "semicolons", "\t": "tabs", "|": "bars", "": "spaces", ",": ""}[dialect.delimiter] if width > 1 else ""
    )
    above = sum(bool(line.strip()) and not line.strip().startswith(COMMENTS) for line in header)
    deviations = [
        f"{delimiter} between its columns" if delimiter else "",
        "decimal commas" if dialect.decimal == "," else "",
        f"{above} lines above its numbers" if above > 1 else "",
        "" if encoding.startswith("utf-8") else f"the encoding {codecs.lookup(encoding).name}",
    ]
    words = ", ".join(filter(None, deviations))
    return (f"it has {words}",) if words else ()


FEWEST = 8
"""Points of a column that can be told to run evenly."""
CLOSE, ROUNDED = 1e-2, 0.45
"""Steps that places may be off, and steps over which the last digit to which they are rounded may go."""
MOST_OFF = 0.2
"""Of the steps of places that run evenly for the most part."""
SAME = 1e-6
"""Over all places along an axis: what is closer is one place."""
AGREE = 2e-3
"""By how much two spacings may differ, one of which is rounded."""


@dataclass(frozen=True, eq=False)
class Places:
    """Positions of evenly spaced rows: the step, and the number of each row on the grid, which may have gaps."""

    step: float
    first: float
    number: NDArray[np.intp]

    @property
    def gaps(self) -> int:
        """Places of the grid that no row has."""
        return int(self.number.max()) + 1 - self.number.size

    @property
    def before_gap(self) -> float:
        """The last place before the first gap."""
        return self.first + self.step * float(self.number[int(np.argmax(np.diff(self.number) > 1))])

    @property
    def counts(self) -> bool:
        """Whether it may count the points, from zero or one."""
        return self.step == 1 and self.first in (0.0, 1.0)


def places_of(values: FloatArray) -> Places | None:
    """Places of a column that runs evenly up or down, but for the last digit and missing rows; None of another."""
    if values.size < FEWEST or not np.isfinite(values).all():
        return None
    steps = np.diff(values)
    if not ((steps > 0).all() or (steps < 0).all()):
        return None
    digit = _last_digit(values)
    # rows that are all there, or rows some of which are missing
    for number in (np.arange(values.size), np.append(0, np.cumsum(np.rint(steps / np.median(steps))))):
        if number[-1] > 2 * values.size or not (np.diff(number) > 0).all():
            continue
        # the mean step of all rows is exact where single ones are rounded
        step = float(values[-1] - values[0]) / float(number[-1])
        off = float(np.abs(values - values[0] - step * number).max())
        rounded = 1.01 * digit if digit < ROUNDED * abs(step) else 0.0
        if off <= max(CLOSE * abs(step), rounded):
            return Places(step=step, first=float(values[0]), number=number.astype(np.intp))
    return None


def _last_digit(values: FloatArray) -> float:
    """The decimal place to which all values are rounded; zero where there is none."""
    tolerance = 1e-12 * max(1.0, np.abs(values).max())
    decimals = (n for n in range(10) if np.allclose(np.round(values, n), values, rtol=1e-15, atol=tolerance))
    return next((10.0**-n for n in decimals), 0.0)


def runs_one_way(values: FloatArray) -> bool:
    """Whether a column of some length ascends or descends all along, as no rough line does; rounded places may stay."""
    steps = np.diff(values)
    return values.size >= 2 * FEWEST and bool(steps.any()) and bool((steps >= 0).all() or (steps <= 0).all())


def faults_of_places(values: FloatArray) -> str:
    """Where a column that runs evenly for the most part turns back, repeats a place or jumps; empty of any other."""
    steps = np.diff(values)
    usual = float(np.median(steps)) if steps.size >= FEWEST else 0.0
    if usual == 0 or not np.isfinite(values).all():
        return ""
    off = np.abs(steps - usual) > max(CLOSE * abs(usual), 1.01 * _last_digit(values))
    if off.mean() > MOST_OFF:
        return ""
    faults = {
        "runs back from {} to {}": steps * np.sign(usual) < 0,
        "has {} and {} behind another": steps == 0,
        "jumps from {} to {}": off,
    }
    for words, where in faults.items():
        if where.any():
            at = int(np.argmax(where))
            ends = (f"{values[i]:.6g}" for i in (at, at + 1))
            remaining = int(where.sum()) - 1
            more = f", and in {remaining} other {'row' if remaining == 1 else 'rows'}" if remaining else ""
            return f"{words.format(*ends)} in row {at + 2}{more}"
    return ""


def first_of_each(values: FloatArray) -> NDArray[np.bool_]:
    """Rows that do not repeat the place of the row before."""
    return np.append(True, np.diff(values) != 0)


def metres_of_step(step: float, unit: str, spacing: float | None, what: str) -> float:
    """The spacing of places a step apart [m], which must be `spacing` unless that is None.

    unit: of the places, empty where it is not known: then `spacing` tells it. Raises ValueError.
    """
    metres = abs(step)
    if unit:
        metres *= metres_of(f"the unit of {what}", unit)
        if spacing is not None and abs(metres / spacing - 1) > AGREE:
            step_length, spacing_length = in_unit(metres, "length"), in_unit(spacing, "length")
            raise ValueError(f"spacing must be that of {what}, {step_length}, or be left out, got {spacing_length}")
        return metres if spacing is None else spacing
    if spacing is None:
        raise ValueError(
            f"spacing is missing: the step of {what} is {metres:.6g}, in no unit that the file names, as: "
            'spacing = "1 mm"'
        )
    if not any(abs(metres * float(metre) / spacing - 1) < AGREE for metre in UNITS["length"].values()):
        raise ValueError(
            f"spacing must be that of {what}, {metres:.6g} apart in some unit of length, got "
            f"{in_unit(spacing, 'length')}"
        )
    return spacing


def own_spacing(numbers: NumberTable, metre: float | None, spacing: Sequence[float | None]) -> tuple[float, ...]:
    """The spacing in the file of an instrument [m], in its own unit or in `metre`, checked against `spacing`."""
    if not numbers.unit and metre is None:
        raise ValueError('unit is missing: the file names none, as: unit = "um"')
    scale = 1.0 if numbers.unit else metre or 1.0
    return tuple(
        metres_of_step(step * scale, numbers.unit or "m", length, "the file")
        for step, length in zip(numbers.spacing or (), spacing, strict=True)
    )


def grid_of(x: FloatArray, y: FloatArray, z: FloatArray) -> tuple[FloatArray, tuple[float, float]]:
    """Heights of shape (nx, ny), NaN where no row has the point, and the steps along both axes, from rows in any order.

    Raises ValueError where there is no regular grid.
    """
    if not (np.isfinite(x).all() and np.isfinite(y).all()):
        raise ValueError("x and y must be known in each row, got some without data")
    axes = []
    for name, values in (("x", x), ("y", y)):
        ends = np.unique(values)
        ends = ends[np.concatenate([[True], np.diff(ends) > SAME * max(np.ptp(ends), 1e-300)])]
        places = places_of(ends)
        if places is None:
            raise ValueError(
                f"three columns must be x, y and height on a regular grid, got {ends.size} places along {name} that "
                "are not evenly apart: resample them, or say which columns are meant by columns"
            )
        axes.append((places, np.rint((values - ends[0]) / places.step).astype(np.intp)))
    (of_x, i), (of_y, j) = axes
    height = np.full((int(of_x.number.max()) + 1, int(of_y.number.max()) + 1), np.nan)
    flat = i * height.shape[1] + j
    if height.size > 4 * z.size or np.unique(flat).size < flat.size:
        raise ValueError(
            f"three columns must be x, y and height on a regular grid, got {z.size} rows for "
            f"{height.shape[0]} x {height.shape[1]} places, with some twice or most missing"
        )
    height.flat[flat] = z
    return height, (of_x.step, of_y.step)
