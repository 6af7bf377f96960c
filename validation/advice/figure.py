"""The figures of `compare`: spectra with their error, or one number of each model, side by side."""

import itertools
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from numpy.typing import ArrayLike

from validation.advice.compare import Comparison, OneOrSeveral, listed
from validation.advice.exported import by_quantity, table_of_several
from validation.advice.side_by_side import counted_bands, reference_of, shown_models, speed_and_accuracy
from validation.analysis.evidence import Table
from validation.report.style import (
    BLUE,
    FORMATS,
    GUIDE,
    INK,
    MARKERS,
    SETTINGS,
    Style,
    in_two_lines,
    legend_name,
    picture,
    plain_figure,
    styles_of,
    tick,
)

TICKS = 12
"""Wavelengths on the axis, at the most."""
NAME = 48
"""Characters of a line of a name in a figure, at the most."""
MOST = 5
"""Curves in one panel: of more, none is told from the others."""


def to_figure(comparison: OneOrSeveral, *, form: str = "svg") -> bytes:
    """Picture of a comparison: the models that were solved, the selected one with its error.

    Of spectra at most five: the selected model, the reference, springs of MDR, and what is nearest to the selected.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list a panel a quantity, of a sweep or with the selected model of each scene.
    form : str, optional
        "svg", "png" or "pdf".

    Returns
    -------
    bytes
        The file that ``mdr-validation compare --figure FILE`` writes.

    Raises
    ------
    ValueError
        For another form.

    Examples
    --------
    >>> picture = validation.to_figure(validation.compare(validation.load_scene("sphere")), form="png")
    >>> picture[1:4]
    b'PNG'
    """
    if form not in FORMATS:
        raise ValueError(f"form must be one of {', '.join(FORMATS)}, got {form!r}")
    panels = list(by_quantity(listed(comparison)).values())
    with matplotlib.rc_context(SETTINGS):
        heights = [_height(comparisons) for comparisons in panels]
        figure = Figure(figsize=(7.0, sum(heights)), layout="constrained")
        parts = figure.subfigures(len(panels), 1, squeeze=False, height_ratios=heights)
        for part, comparisons in zip(parts[:, 0], panels, strict=True):
            if _is_sweep(comparisons):
                draw_sweep(part, comparisons, MOST)
                continue
            title, table = _title_and_rows(comparisons)
            axes = part.subplots()
            axes.set_title(in_two_lines(title), loc="left")
            spectra = comparisons[0].is_level and np.isfinite(table["wavelength_mm"]).all()
            users = names_of_users(comparisons, table["model"].tolist())
            if spectra and len(table["model"]):
                _draw_spectra(axes, table, users)
            else:
                _draw_numbers(axes, table)
    plain_figure(figure)
    return picture(figure, form)


def _is_sweep(comparisons: Sequence[Comparison]) -> bool:
    """Whether these are several values of a swept key."""
    return len(comparisons) > 1 and comparisons[0].swept is not None


def _height(comparisons: Sequence[Comparison]) -> float:
    """Height of a panel [inch]; of single numbers it grows with their rows."""
    rows = len(comparisons[0].selection.solved) if len(comparisons) == 1 else len(comparisons)
    if _is_sweep(comparisons):
        return 5.5 if comparisons[0].is_level else 4.2
    return 4.2 if comparisons[0].is_level else 1.2 + 0.4 * rows


def _title_and_rows(comparisons: Sequence[Comparison]) -> tuple[str, Table]:
    """Title and rows, of spectra in the order in which curves are drawn."""
    first, table = comparisons[0], table_of_several(comparisons)
    if len(comparisons) > 1:
        return first.quantity, _selected_rows(table)
    title = f"{first.scene.name}: {first.quantity}"
    if not first.is_level or not first.selection.solved:
        return title, table
    order = shown_models(first)
    rows = sorted(range(len(table["model"])), key=lambda row: order.index(str(table["model"][row])))
    return title, Table(table.name, {name: [column[row] for row in rows] for name, column in table.columns.items()})


def _selected_rows(table: Table) -> Table:
    """The selected model of each scene alone, named by its scene."""
    selected = table.where(selected=True)
    names = [legend_name(str(name)) for name in selected.columns["scene"]]
    return Table(table.name, {**selected.columns, "model": names, "selected": [False] * len(names)})


def _draw_spectra(axes: Axes, table: Table, users: Collection[str] = ()) -> None:
    """The selected model with the band of its error; the others beside it. users: names that are no models of ours."""
    models = list(dict.fromkeys(table["model"].tolist()))
    for model, style in styles_of(models[:MOST], users).items():
        rows = table.where(model=model)
        x, selected = rows["wavelength_mm"], bool(rows["selected"][0])
        name = legend_name(f"{model}, selected" if selected else model)
        axes.plot(x, rows["value"], label=in_two_lines(name, NAME), **style)
        if selected:
            axes.fill_between(x, rows["low"], rows["high"], color=style["color"], alpha=0.2, linewidth=0)
    axes.set_xscale("log")
    waves = table.where(model=models[0])["wavelength_mm"]
    tick(axes, (float(f"{wave:.3g}") for wave in waves[:: 1 + len(waves) // TICKS]))
    axes.invert_xaxis()
    axes.set_xlabel("wavelength [mm]")
    if np.isfinite(table["frequency_hz"]).all():
        _add_frequencies(axes, float(table["wavelength_mm"][0] * table["frequency_hz"][0]))
    axes.set_ylabel(f"{table.name} [{table['unit'][0]}]")
    more = len(models) - MOST
    axes.legend(title=f"and {more} more in the CSV" if more > 0 else None, title_fontsize=8)


def _add_frequencies(axes: Axes, speed: float) -> None:
    """A second axis on top; speed: [mm/s]."""

    def over(values: ArrayLike) -> np.ndarray:
        """Frequencies of wavelengths, and the other way round; matplotlib tries zero, too."""
        return speed / np.maximum(np.asarray(values, dtype=np.float64), 1e-12)

    above = axes.secondary_xaxis("top", functions=(over, over))
    above.xaxis.set_major_formatter("{x:g}")
    above.set_xlabel("frequency [Hz]")


def _draw_numbers(axes: Axes, table: Table) -> None:
    """A row a model, or a scene."""
    names = [in_two_lines(name, NAME) for name in table["model"].tolist()]
    for i, (value, low, selected) in enumerate(zip(table["value"], table["low"], table["selected"], strict=True)):
        style: Style = {"color": BLUE if selected else INK, "fmt": MARKERS[i % len(MARKERS)]}
        half: Any = value - low if np.isfinite(low) else 0.0
        axes.errorbar(value, i, xerr=half, capsize=3 if half else 0, markersize=4, **style)
        if selected:
            names[i] += ",\nselected"
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_xlabel(f"{table.name} [{table['unit'][0]}]" if names else "no model has a result with a known error")


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


def draw_sweep(figure: SubFigure, comparisons: Sequence[Comparison], most: int) -> None:
    """Of a spectrum a panel a band, and one of the force."""
    scenes = list(dict.fromkeys(comparison.swept.scene for comparison in comparisons if comparison.swept))
    title = f"{scenes[0]}: {comparisons[0].quantity}" if len(scenes) == 1 else comparisons[0].quantity
    figure.suptitle(in_two_lines(title), x=0.01, ha="left", fontsize=9)
    lines, panels = _lines_of_sweep(comparisons, scenes), list(_panels_of_sweep(comparisons))
    columns = 2 if len(panels) > 1 else 1
    axes = figure.subplots(max(1, math.ceil(len(panels) / columns)), columns, sharex=True, squeeze=False).flat
    for axis, panel in itertools.zip_longest(axes, panels):
        if panel is None:
            axis.set_axis_off()
        else:
            _draw_panel(axis, panel, dict(list(lines.items())[:most]), names_of_users(comparisons, list(lines)))
    if not lines:
        axes[0].set_title("no model has a result", loc="left")
        return
    more = len(lines) - most
    legend_title = f"and {more} more in the CSV" if more > 0 else None
    named = axes[0].get_legend_handles_labels()
    figure.legend(*named, loc="outside lower center", ncols=2, title=legend_title, title_fontsize=8)


def names_of_users(comparisons: Sequence[Comparison], shown: Sequence[str]) -> set[str]:
    """Of the names that a figure shows those that are not the package's own: of scenes, and of models of a user's."""
    candidates = [candidate for comparison in comparisons for candidate in comparison.selection.candidates]
    own = {
        str(candidate.name)
        for candidate in candidates
        if not getattr(getattr(candidate.model, "model", candidate), "setting", "").startswith("@")
    }
    return set(shown) - own


def _draw_panel(axes: Axes, panel: SweepPanel, lines: Mapping[str, Points], users: Collection[str]) -> None:
    """A line a model with the band of its error, as a function of the swept value; texts are equidistant."""
    title, label, interval = panel
    swept = {name: [comparison.swept for comparison, _ in points if comparison.swept] for name, points in lines.items()}
    first = next(iter(swept.values()))
    numbers = all(isinstance(point.value, float) for point in first)
    texts = list(dict.fromkeys(str(point.value) for point in first))
    styles = styles_of(lines, users)
    for name, points in lines.items():
        values = [point.value if numbers else texts.index(str(point.value)) for point in swept[name]]
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


def _lines_of_sweep(comparisons: Sequence[Comparison], scenes: Sequence[str]) -> dict[str, Points]:
    """Models of one scene, those first that are shown of its first value; of several scenes their selected models."""
    if len(scenes) > 1:
        return {
            s: [
                (comparison, comparison.model)
                for comparison in comparisons
                if comparison.swept and comparison.swept.scene == s
            ]
            for s in scenes
        }
    return {
        name: [(comparison, name) for comparison in comparisons]
        for each in comparisons
        if each.selection.solved
        for name in shown_models(each)
    }


def _panels_of_sweep(comparisons: Sequence[Comparison]) -> Iterator[SweepPanel]:
    """Panels of a sweep: one of a single number, else of the force and of `PANELS` bands; none without an answer."""
    label = f"{comparisons[0].quantity} [{comparisons[0].unit}]"
    if not comparisons[0].is_level:
        yield "", label, partial(_interval_of_model, wave=None)
        return
    force = all(comparison.force for comparison in comparisons)
    if force:
        yield "contact force at a constant height", "A-weighted [dB re 1 N]", _interval_of_force
    for wave in _most_changing_waves(comparisons, PANELS - force):
        yield f"{wave:.4g} mm", label, partial(_interval_of_model, wave=wave)


def _interval_of_model(comparison: Comparison, name: str, wave: float | None) -> Interval:
    """Value and error of a model in the band at a wavelength [mm]; wave: None of one number."""
    for candidate in comparison.selection.solved:
        at = 0 if wave is None else _index_of_band(comparison, wave)
        if candidate.name == name and at is not None:
            return _interval(comparison.value_of(candidate)[at], comparison.errors_of(candidate)[at])
    return math.nan, math.nan, math.nan


def _interval_of_force(comparison: Comparison, name: str) -> Interval:
    """The sum over all bands; the error of the selected model alone is known."""
    force = comparison.force
    if force is None or name not in force.levels:
        return math.nan, math.nan, math.nan
    return _interval(force.total(name), force.error if name == force.chosen else math.inf)


def _interval(value: float, half: float) -> Interval:
    """Value with the ends value - half and value + half, NaN where the half-width is not finite."""
    half_width = half if math.isfinite(half) else math.nan
    return float(value), float(value - half_width), float(value + half_width)


def _index_of_band(comparison: Comparison, wave: float) -> int | None:
    """Index of the band at a wavelength [mm], within the ratio `SAME`; None where the comparison has no such band."""
    off = np.abs(np.log(comparison.wavelength_mm / wave))
    return int(np.argmin(off)) if off.size and off.min() < np.log(SAME) else None


def _most_changing_waves(comparisons: Sequence[Comparison], most: int) -> list[float]:
    """Wavelengths of the bands that change most [mm], from long to short."""
    solved = [comparison for comparison in comparisons if comparison.selection.solved]
    points = [(comparison, (comparison.selection.best or reference_of(comparison)).name) for comparison in solved]
    waves = solved[0].wavelength_mm[counted_bands(solved[0], reference_of(solved[0]))].tolist() if solved else []
    levels = {
        wave: np.array([_interval_of_model(comparison, name, wave)[0] for comparison, name in points]) for wave in waves
    }
    finite = {wave: level[np.isfinite(level)] for wave, level in levels.items()}
    spread = {wave: float(np.ptp(level)) for wave, level in finite.items() if level.size}
    return sorted(sorted(spread, key=spread.__getitem__)[-most:], reverse=True)


KINDS: dict[str, Style] = {
    "reference, its own error": {"color": "#000000", "marker": "*", "markersize": 9},
    "MDR": {"color": "#D55E00", "marker": "s", "markersize": 5, "markerfacecolor": "none"},
    "other models": {"color": "#0072B2", "marker": "o", "markersize": 5},
}
BARS: Style = {"linestyle": "none", "capsize": 3, "elinewidth": 0.6}
ROOM = 1.6
"""Factor by which the axis of errors goes on below the smallest."""
LINE = 10.0
"""Height of a label [points]."""


def figure_over_seconds(comparison: Comparison, form: str) -> bytes:
    """Error over seconds, both logarithmic, a point a model. Raises ValueError where no model was timed."""
    if not any(np.isfinite(comparison.seconds_of(candidate)) for candidate in comparison.selection.solved):
        raise ValueError("--over seconds needs models that were solved, got none")
    table = speed_and_accuracy(comparison)
    tolerance = comparison.tolerance.relative
    limit = 20 * np.log10(1 + tolerance) if table["unit"][0] == "dB" else 100 * tolerance
    with matplotlib.rc_context(SETTINGS):
        figure = Figure(figsize=(7.0, 5.0))
        # labels are placed by the size of the panel, which no layout may change afterwards
        axes = figure.subplots(gridspec_kw={"left": 0.1, "right": 0.98, "bottom": 0.18, "top": 0.93})
        axes.set_title(in_two_lines(f"{comparison.scene.name}: {comparison.quantity}"), loc="left")
        axes.axhline(limit, label=f"tolerance, {comparison.tolerance}", **GUIDE)
        _draw_times(axes, table)
        figure.legend(loc="lower center", ncols=4)
    plain_figure(figure)
    return picture(figure, form)


def _draw_times(axes: Axes, table: Table) -> None:
    """Points of `speed_and_accuracy`, a kind of model a marker; where the error is not positive, its upper end."""
    shown = np.where(table["is_reference"] | ~(table["error"] > 0), table["high"], table["error"])
    positive = np.concatenate([shown, table["low"]])
    least = float(np.min(positive[positive > 0], initial=np.inf)) / ROOM
    reference_kind, mdr, other = KINDS
    kinds = np.where(table["is_reference"], reference_kind, np.where(table["is_mdr"], mdr, other))
    for kind, style in KINDS.items():
        mask = kinds == kind
        y, low, high = shown[mask], np.maximum(table["low"][mask], least), table["high"][mask]
        if mask.any():
            bars = np.nan_to_num([y - low, high - y]).clip(0)
            axes.errorbar(table["seconds"][mask], y, yerr=bars, label=kind, **style, **BARS)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.15, y=0.1)
    axes.set_ylim(bottom=least if np.isfinite(least) else None)
    (reference,) = table.where(is_reference=True)["model"]
    axes.set_xlabel("time of the solves [s]")
    axes.set_ylabel(f"difference from {reference} [{table['unit'][0]}]")
    seen = np.isfinite(shown) & (shown > 0)
    _label_points(axes, table["seconds"][seen], shown[seen], table["model"][seen].tolist())


def _label_points(axes: Axes, x: np.ndarray, y: np.ndarray, names: list[str]) -> None:
    """Each name beside its point, towards the middle, a line above the one below it at the least."""
    points = 72 / axes.figure.dpi * axes.transData.transform(np.column_stack([x, y]))
    middle = 36 / axes.figure.dpi * (axes.bbox.x0 + axes.bbox.x1)
    heights = {"left": -np.inf, "right": -np.inf}
    for i in np.argsort(points[:, 1]):
        side = "left" if points[i, 0] < middle else "right"
        up = max(0.0, heights[side] + LINE - points[i, 1])
        heights[side] = points[i, 1] + up
        axes.annotate(
            names[i],
            (x[i], y[i]),
            xytext=(8 if side == "left" else -8, up),
            textcoords="offset points",
            ha=side,
            va="center",
            fontsize=7.5,
            arrowprops={"arrowstyle": "-", "linewidth": 0.4, "color": "#888888"} if up else None,
        )
