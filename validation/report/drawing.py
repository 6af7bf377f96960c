"""Draws the figures that cases declare, from their tables alone."""

import math
from collections.abc import Iterator, Mapping
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Evidence, Table, placed
from validation.analysis.series import ENDS, JUDGED
from validation.report.style import BEM, EXACT, GUIDE, MDR, MDR_LINE, MDR_OTHER, Style, graded, panels, tick, visible

STYLES: dict[str, Style] = {
    "exact": EXACT,
    "thick": {"color": "#999999", "linewidth": 3.0},
    "bem": BEM,
    "bem, few cells": {**BEM, "markerfacecolor": "white"},
    "mdr": MDR,
    "mdr around": {**MDR, "markersize": 8},
    "mdr line": MDR_LINE,
    "other": MDR_OTHER,
    "guide": GUIDE,
    "dashed": {**GUIDE, "linestyle": "--"},
    "interval": {"color": "#000000"},
    "crosses": {"color": "#000000", "marker": "x", "linestyle": "none"},
    "bem line": {"color": BEM["color"], "linestyle": "--", "linewidth": 1.2},
    "dots": {"color": MDR["color"], "marker": ".", "markersize": 2.5, "linestyle": "none"},
}
GRADED: dict[str, Style] = {
    "graded": {},
    "marks": {"linestyle": "none"},
    "lines": {"marker": "none"},
    "dotted": {"marker": "none", "linestyle": ":"},
    "open": {"markerfacecolor": "white", "linestyle": ":"},
    "open marks": {"markerfacecolor": "white", "linestyle": "none"},
}
FIRST = "first"
FEW, LARGE = 15, 1e5
FEW_DECADES, ASIDE = 300, 1.2
HIGHEST = 4.8
"""Of a row of panels."""
SIGN = {"agree": "=", "differ": "≠", "undecided": "?"}


def draw(chart: Chart, evidence: Evidence) -> Figure:
    facets = [(panel, facet) for panel in chart.panels for facet in _facets(panel, evidence)]
    columns = min(chart.columns or len(facets), len(facets))
    rows = -(-len(facets) // columns)
    shared: Literal["all", "none"] = "all" if chart.sharey else "none"
    figure, axes = panels(rows, columns, width=chart.width, height=min(chart.height, HIGHEST * rows), sharey=shared)
    for axis, (panel, facet) in zip(axes, facets, strict=False):
        try:
            _panel(axis, panel, facet, evidence)
        except KeyError as error:
            raise ValueError(
                f"chart {chart.name!r} names {error}, which is no style, and no column of its tables"
            ) from error
    for axis, (panel, _) in zip(axes, facets, strict=False):
        _limits(axis, panel)
    for axis in axes[len(facets) :]:
        axis.set_visible(False)
    for i, axis in enumerate(axes):
        if chart.sharey and i % columns:
            axis.set_ylabel("")
    without = [axis for axis, (panel, _) in zip(axes, facets, strict=False) if not panel.legend]
    labels = dict(pair for axis in without for pair in zip(*axis.get_legend_handles_labels()[::-1], strict=True))
    if labels:
        figure.legend(labels.values(), labels.keys(), loc="outside lower center", ncols=4)
    return figure


def _facets(panel: Panel, evidence: Evidence) -> list[dict[str, object]]:
    names = (panel.facet,) if isinstance(panel.facet, str) else panel.facet
    if not names or not names[0]:
        return [{}]
    tables = [_rows(evidence, curve, {}) for curve in _there(panel, evidence)]
    values = dict.fromkeys(key for one in tables for key in zip(*(one.columns.get(n, ()) for n in names), strict=True))
    return [dict(zip(names, key, strict=True)) for key in values] or [{}]


def _there(panel: Panel, evidence: Evidence) -> list[Curve]:
    """A run need not have every quantity."""
    return [curve for curve in panel.curves if evidence.has_table(curve.quantity)]


def _panel(axis: Axes, panel: Panel, facet: dict[str, object], evidence: Evidence) -> None:
    if panel.shade:
        axis.axhspan(*panel.shade, color="#000000", alpha=0.07, linewidth=0)
    for y in panel.lines:
        axis.axhline(y, color="#000000", linewidth=0.8)
    for curve in _there(panel, evidence):
        # a family has one style in all facets
        every = [key for key, *_ in _families(curve, _rows(evidence, curve, {}))]
        for key, values, mine in _families(curve, _rows(evidence, curve, facet)):
            _curve(axis, curve, panel, mine, values, every.index(key), len(every))
    if panel.judged:
        _verdicts(axis, _chosen(evidence.table(panel.judged + JUDGED), facet))
    axis.set(xlabel=panel.x, ylabel=panel.y, title=panel.title or ", ".join(_said(*f) for f in facet.items()))
    axis.set(xscale="log" if "x" in panel.log else "linear", yscale="log" if "y" in panel.log else "linear")
    if panel.legend and axis.get_legend_handles_labels()[1]:
        axis.legend(loc=panel.legend, fontsize=7)  # type: ignore[call-overload]


def _verdicts(axis: Axes, judged: Table) -> None:
    """The worst point of each range with its interval, and a sign."""
    for x, to, value, low, high, verdict in zip(
        *(judged[name] for name in ("from", "to", *ENDS, "verdict")), strict=True
    ):
        axis.fill_between((x, to), [low] * 2, [high] * 2, facecolor="none", edgecolor="#000000", linewidth=0.8)
        axis.plot((x, to), [value] * 2, color="#000000", linewidth=2)
        axis.text(math.sqrt(x * to), 0.97, SIGN[verdict], transform=axis.get_xaxis_transform(), ha="center", va="top")


def _limits(axis: Axes, panel: Panel) -> None:
    # lines across the panel have ends in parts of it
    lines = [line for line in axis.lines if line.get_transform() == axis.transData]
    if panel.decades:
        top = max((np.nanmax(np.asarray(line.get_ydata(), dtype=np.float64)) for line in lines), default=1.0)
        low = top * 10**-panel.decades if "y" in panel.log else top - panel.decades
        axis.set_ylim(low, 6 * top if "y" in panel.log else top + 0.1 * panel.decades)
    if panel.xlim:
        axis.set_xlim(*panel.xlim)
    if panel.ylim:
        axis.set_ylim(*panel.ylim)
    if panel.ticked:
        tick(axis, _apart(np.unique(np.concatenate([line.get_xdata() for line in lines]))))
    elif "x" in panel.log and axis.get_xlim()[1] < LARGE:
        tick(axis, _round(*axis.get_xlim()))
    if "y" in panel.log and axis.get_ylim()[1] < FEW_DECADES * axis.get_ylim()[0]:
        tick(axis, _round(*axis.get_ylim()), up=True)
    for x in panel.at:
        if axis.get_xlim()[0] < x < axis.get_xlim()[1]:
            axis.axvline(x, **GUIDE)
    if panel.downward:
        axis.invert_xaxis()


def _round(low: float, high: float) -> list[float]:
    """Powers of ten, of few decades two and five times them too, of many some."""
    steps = (1, 2, 5) if high < FEW_DECADES * low else (1,)
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    powers = range(first, last, max(1, (last - first) // 5))
    return [x for power in powers for step in steps if low <= (x := step * 10.0**power) <= high]


def _apart(values: np.ndarray) -> list[float]:
    """Without those of curves that are moved aside."""
    kept: list[float] = []
    for value in values.tolist():
        if not kept or value > ASIDE * kept[-1]:
            kept.append(value)
    return kept


def _said(name: str, value: object) -> str:
    """A value by its name; a name by itself, unless it is a number of a column that has names too."""
    try:
        return placed(name, f"{float(value):g}")  # type: ignore[arg-type]
    except ValueError:
        return str(value)


def _rows(evidence: Evidence, curve: Curve, more: dict[str, object]) -> Table:
    return _chosen(evidence.table(curve.quantity), {"model": curve.model, **curve.of, **more})


def _chosen(table: Table, of: Mapping[str, object]) -> Table:
    """Rows that have these values; "first" is the first of a column."""
    for name, wanted in of.items():
        if name in table.columns and wanted != ():
            column = table[name]
            values = (column[0],) if wanted == FIRST else wanted if isinstance(wanted, tuple) else (wanted,)
            table = table.rows(np.isin(column, np.asarray(values, dtype=column.dtype)))
    return table


def _families(curve: Curve, table: Table) -> Iterator[tuple[tuple[str, ...], dict[str, object], Table]]:
    size = len(next(iter(table.columns.values())))
    keys = list(zip(*(map(str, table.columns[name]) for name in curve.by), strict=True)) or [()] * size
    for key in dict.fromkeys(keys):
        mine = table.rows([i for i in range(size) if keys[i] == key])
        yield key, {name: column[0] for name, column in mine.columns.items()}, mine


def _curve(axis: Axes, curve: Curve, panel: Panel, mine: Table, values: dict[str, object], i: int, count: int) -> None:
    style = {**(STYLES.get(curve.style) or {**graded(i, count), **GRADED[curve.style]})}
    where = {name: value for name, value in values.items() if value == value}
    label = curve.label or ", ".join(_said(name, where[name]) for name in curve.by if name in where)
    if curve.upright:
        for x, name in zip(mine["value"], mine["model"], strict=True):
            axis.axvline(x, label=label or "_", **style)
            up = axis.get_xaxis_transform()
            axis.text(x, 0.02, "" if label else name, transform=up, rotation=90, va="bottom", ha="right", fontsize=7)
        return
    x, above, down = mine[panel.x], 0.0 if "y" in panel.log else -np.inf, i * curve.down
    y, low, high = (visible(mine[name], above=above) for name in ENDS)
    if curve.style == "interval":
        axis.fill_between(x, low, high, color=style["color"], alpha=0.2, linewidth=0, label=label)
        return
    if curve.apart or curve.style == "graded":
        style["markevery"] = curve.apart or max(y.size // FEW, 1)
    if curve.bars and np.any(high > low):
        # down to nothing: on a logarithmic axis a decade
        down_to = np.where(np.asarray(mine["low"]) > above, low, 0.1 * y)
        bars = [np.nan_to_num(y - down_to), np.nan_to_num(high - y)]
        # moved a little, so that intervals stand side by side
        beside = curve.beside**i if "x" in panel.log else 1.0
        axis.errorbar(beside * x, y - down, yerr=bars, capsize=1.5, elinewidth=0.7, label=label, **style)
    else:
        axis.plot(x, y - down, label=label, **style)
    if curve.band:
        axis.fill_between(x, low, high, color=style["color"], alpha=0.15, linewidth=0)
