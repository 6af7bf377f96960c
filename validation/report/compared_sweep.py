"""The figure of a sweep: a quantity over the swept value, a line a model with the band of its error."""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from numpy.typing import NDArray

from validation.report.style import curve, tick
from validation.selection.compare import Comparison
from validation.selection.side_by_side import counts, reference_of, shown_models

FloatArray = NDArray[np.float64]

PANELS = 4
"""Bands of a spectrum that are drawn: those that change most among the ones that count."""
DECADE = 10.0
"""Ratio of swept values from which on their axis is logarithmic."""
SAME = 10**0.05
"""Ratio of wavelengths within one band, at the most."""


@dataclass(frozen=True)
class Line:
    """name: of a model, or of a scene by its selected model; rows: (values of the sweep, 3), value, low and high."""

    name: str
    rows: FloatArray


def draw_sweep(figure: SubFigure, found: Sequence[Comparison], most: int) -> None:
    """Of a spectrum a panel a band."""
    waves = (_changing(found) if found[0].is_level else []) or [math.nan]
    columns = 2 if len(waves) > 1 else 1
    axes = figure.subplots(-(-len(waves) // columns), columns, sharex=True, squeeze=False).flat
    scenes = list(dict.fromkeys(one.swept.scene for one in found if one.swept))
    figure.suptitle(f"{', '.join(scenes)}: {found[0].quantity}", x=0.01, ha="left", fontsize=9)
    for axis, wave in itertools.zip_longest(axes, waves):
        if wave is None:
            axis.set_axis_off()
            continue
        lines = list(_lines(found, scenes, wave))
        _draw(axis, found, lines[:most])
        axis.set_title("" if np.isnan(wave) else f"{wave:.4g} mm", loc="left")
    if not lines:
        axes[0].set_title("no model has a result", loc="left")
        return
    more = len(lines) - most
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        loc="outside lower center",
        ncols=2,
        title_fontsize=8,
        title=f"and {more} more in the CSV" if more > 0 else None,
    )


def _draw(axes: Axes, found: Sequence[Comparison], lines: Sequence[Line]) -> None:
    values = list(dict.fromkeys(one.swept.value for one in found if one.swept))
    numbers = all(isinstance(value, float) for value in values)
    x = np.array(values if numbers else range(len(values)), dtype=np.float64)
    order = np.argsort(x)
    for i, line in enumerate(lines):
        value, low, high = line.rows[order].T
        axes.plot(x[order], value, label=line.name, **{"marker": ".", **curve(i)})
        axes.fill_between(x[order], low, high, color=curve(i)["color"], alpha=0.12, linewidth=0)
        edges = {"color": curve(i)["color"], "linestyle": curve(i)["linestyle"], "linewidth": 0.5}
        axes.plot(x[order], np.column_stack([low, high]), **edges)
    if not numbers:
        axes.set_xticks(x, [str(value) for value in values])
        axes.margins(x=0.2)
    elif x.min() > 0 and x.max() >= DECADE * x.min():
        axes.set_xscale("log")
        tick(axes, x)
    swept = found[0].swept
    axes.set_xlabel(swept.label if swept else "")
    axes.set_ylabel(f"{found[0].quantity} [{found[0].unit}]")


def _lines(found: Sequence[Comparison], scenes: Sequence[str], wave: float) -> Iterator[Line]:
    """Models of one scene, those first that are shown of its first value; of several scenes their selected models."""
    if len(scenes) > 1:
        for scene in scenes:
            mine = [one for one in found if one.swept and one.swept.scene == scene]
            yield Line(scene, np.array([_at(one, one.model, wave) for one in mine]))
        return
    for name in dict.fromkeys(name for one in found if one.selection.solved for name in shown_models(one)):
        yield Line(name, np.array([_at(one, name, wave) for one in found]))


def _at(comparison: Comparison, name: str, wave: float) -> tuple[float, float, float]:
    """Value, low and high of a model at a wavelength, NaN where it was not solved or has no such band."""
    for one in comparison.selection.solved:
        at = 0 if np.isnan(wave) else _band(comparison, wave)
        if one.name == name and at is not None:
            value, half = comparison.value_of(one)[at], comparison.errors_of(one)[at]
            half = half if np.isfinite(half) else np.nan
            return float(value), float(value - half), float(value + half)
    return np.nan, np.nan, np.nan


def _band(comparison: Comparison, wave: float) -> int | None:
    off = np.abs(np.log(comparison.wavelength_mm / wave))
    return int(np.argmin(off)) if off.size and off.min() < np.log(SAME) else None


def _changing(found: Sequence[Comparison]) -> list[float]:
    """Wavelengths of the bands that change most [mm], from long to short."""
    solved = [one for one in found if one.selection.solved]
    known = [(one, one.selection.best or reference_of(one)) for one in solved]
    if not known:
        return []
    first, chosen = known[0]
    spread = {}
    for wave in first.wavelength_mm[counts(first, chosen)].tolist():
        values = [_at(one, of.name, wave)[0] for one, of in known]
        spread[wave] = float(np.ptp([value for value in values if np.isfinite(value)]))
    return sorted(sorted(spread, key=spread.__getitem__)[-PANELS:], reverse=True)
