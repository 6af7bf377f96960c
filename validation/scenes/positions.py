"""Columns that are places and no heights: they run evenly, count the points, or stand for the axes of a grid."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import FloatArray
from validation.scenes.number_table import NumberTable
from validation.scenes.units import UNITS, in_unit, metres_of

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
