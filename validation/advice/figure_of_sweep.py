"""The figure of a sweep: a quantity over the swept value, a line a model with the band of its error."""

import itertools
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure

from validation.advice.compare import Comparison
from validation.advice.side_by_side import counts, reference_of, shown_models
from validation.report.style import in_two_lines, legend_name, styles_of, tick

Interval = tuple[float, float, float]
"""Value, low and high; NaN where a model was not solved, or its error is unknown."""

PANELS = 4
"""Of a spectrum: the A-weighted force where there is one, and the bands that change most among those that count."""
DECADE = 10.0
"""Ratio of swept values from which on their axis is logarithmic."""
SAME = 10**0.05
"""Ratio of wavelengths within one band, at the most."""


Points = list[tuple[Comparison, str]]
"""Of a line: comparisons of a sweep, each with the name of its model."""
SweepPanel = tuple[str, str, Callable[[Comparison, str], Interval]]
"""Title, label, and what it shows of a comparison by a model."""


def draw_sweep(figure: SubFigure, found: Sequence[Comparison], most: int) -> None:
    """Of a spectrum a panel a band, and one of the force."""
    scenes = list(dict.fromkeys(one.swept.scene for one in found if one.swept))
    title = f"{scenes[0]}: {found[0].quantity}" if len(scenes) == 1 else found[0].quantity
    figure.suptitle(in_two_lines(title), x=0.01, ha="left", fontsize=9)
    lines, panels = _lines(found, scenes), list(_panels(found))
    columns = 2 if len(panels) > 1 else 1
    axes = figure.subplots(max(1, math.ceil(len(panels) / columns)), columns, sharex=True, squeeze=False).flat
    for axis, panel in itertools.zip_longest(axes, panels):
        if panel is None:
            axis.set_axis_off()
        else:
            _draw(axis, panel, dict(list(lines.items())[:most]), names_of_users(found, list(lines)))
    if not lines:
        axes[0].set_title("no model has a result", loc="left")
        return
    more = len(lines) - most
    others = f"and {more} more in the CSV" if more > 0 else None
    named = axes[0].get_legend_handles_labels()
    figure.legend(*named, loc="outside lower center", ncols=2, title=others, title_fontsize=8)


def names_of_users(found: Sequence[Comparison], shown: Sequence[str]) -> set[str]:
    """Of the names that a figure shows those that are not the package's own: of scenes, and of models of a user's."""
    candidates = [candidate for one in found for candidate in one.selection.candidates]
    own = {
        str(of.name) for of in candidates if not getattr(getattr(of.model, "model", of), "setting", "").startswith("@")
    }
    return set(shown) - own


def _draw(axes: Axes, panel: SweepPanel, lines: Mapping[str, Points], users: Collection[str]) -> None:
    title, label, interval = panel
    swept = {name: [one.swept for one, _ in points if one.swept] for name, points in lines.items()}
    first = next(iter(swept.values()))
    numbers = all(isinstance(of.value, float) for of in first)
    texts = list(dict.fromkeys(str(of.value) for of in first))
    styles = styles_of(lines, users)
    for name, points in lines.items():
        values = [of.value if numbers else texts.index(str(of.value)) for of in swept[name]]
        order = np.argsort(values, kind="stable")
        x = np.array(values, dtype=np.float64)[order]
        value, low, high = np.array([interval(*point) for point in points])[order].T
        style = styles[name]
        axes.plot(x, value, label=in_two_lines(legend_name(name), 48), **style)
        axes.fill_between(x, low, high, color=style["color"], alpha=0.12, linewidth=0)
        edges = {"color": style["color"], "linestyle": style["linestyle"], "linewidth": 0.5}
        axes.plot(x, np.column_stack([low, high]), **edges)
    if not numbers:
        axes.set_xticks(range(len(texts)), texts)
        axes.margins(x=0.2)
    elif x.min() > 0 and x.max() >= DECADE * x.min():
        axes.set_xscale("log")
        tick(axes, x)
    axes.set_title(title, loc="left")
    axes.set(xlabel=first[0].label, ylabel=label)


def _lines(found: Sequence[Comparison], scenes: Sequence[str]) -> dict[str, Points]:
    """Models of one scene, those first that are shown of its first value; of several scenes their selected models."""
    if len(scenes) > 1:
        return {s: [(one, one.model) for one in found if one.swept and one.swept.scene == s] for s in scenes}
    return {
        name: [(one, name) for one in found] for each in found if each.selection.solved for name in shown_models(each)
    }


def _panels(found: Sequence[Comparison]) -> Iterator[SweepPanel]:
    """None where a spectrum has no answer."""
    label = f"{found[0].quantity} [{found[0].unit}]"
    if not found[0].is_level:
        yield "", label, partial(_at, wave=None)
        return
    force = all(one.force for one in found)
    if force:
        yield "contact force at a constant height", "A-weighted [dB re 1 N]", _force
    for wave in _changing(found, PANELS - force):
        yield f"{wave:.4g} mm", label, partial(_at, wave=wave)


def _at(comparison: Comparison, name: str, wave: float | None) -> Interval:
    """At a wavelength [mm]; None of one number."""
    for one in comparison.selection.solved:
        at = 0 if wave is None else _band(comparison, wave)
        if one.name == name and at is not None:
            return _interval(comparison.value_of(one)[at], comparison.errors_of(one)[at])
    return math.nan, math.nan, math.nan


def _force(comparison: Comparison, name: str) -> Interval:
    """The sum over all bands; the error of the selected model alone is known."""
    force = comparison.force
    if force is None or name not in force.levels:
        return math.nan, math.nan, math.nan
    return _interval(force.total(name), force.error if name == force.chosen else math.inf)


def _interval(value: float, half: float) -> Interval:
    known = half if math.isfinite(half) else math.nan
    return float(value), float(value - known), float(value + known)


def _band(comparison: Comparison, wave: float) -> int | None:
    off = np.abs(np.log(comparison.wavelength_mm / wave))
    return int(np.argmin(off)) if off.size and off.min() < np.log(SAME) else None


def _changing(found: Sequence[Comparison], most: int) -> list[float]:
    """Wavelengths of the bands that change most [mm], from long to short."""
    solved = [one for one in found if one.selection.solved]
    known = [(one, (one.selection.best or reference_of(one)).name) for one in solved]
    waves = solved[0].wavelength_mm[counts(solved[0], reference_of(solved[0]))].tolist() if solved else []
    levels = {wave: np.array([_at(one, name, wave)[0] for one, name in known]) for wave in waves}
    spread = {wave: float(np.ptp(of[np.isfinite(of)])) for wave, of in levels.items() if np.isfinite(of).any()}
    return sorted(sorted(spread, key=spread.__getitem__)[-most:], reverse=True)
