"""Draws the figures that cases declare, from their tables alone."""

import math
import textwrap
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Literal

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.container import Container
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Evidence, Table, Verdict, placed
from validation.analysis.series import ENDS, JUDGED
from validation.report.style import (
    BARS,
    GUIDE,
    INK,
    WIDTH,
    EachNumber,
    Style,
    graded,
    legend_name,
    panels,
    styles_of,
    tick,
    visible,
)

LINE, ROW, LETTER, KEY = 9.0, 12.0, 4.2, 34.0
"""Height of a line of names, and of one of a legend, width of a letter, and of the sample before a name [points]."""
MOST, FARTHEST = 6, 1.5
"""Curves that are named at their ends; how far a name is moved, in lines."""
BESIDE = 14
"""Names for which a spare place of the grid has room."""
NEAR_THE_EDGE = 0.8
"""Part of the panel from which on a curve ends at its side."""


def name_curves(figure: Figure, axes: Sequence[Axes], columns: int, spare: Sequence[Axes] = ()) -> None:
    """Each name once; the legend is in a spare place of the grid where there is one, else below all panels."""
    named = [dict(zip(*axis.get_legend_handles_labels()[::-1], strict=True)) for axis in axes]
    handles = {name: handle for handles_of_axis in named for name, handle in handles_of_axis.items()}
    last = min(columns, len(axes)) - 1
    if not spare and len(named[last]) == len(handles) <= MOST and _at_the_ends(axes[last], handles):
        return
    if spare and len(handles) <= BESIDE:
        names = [textwrap.fill(name, 30) for name in handles]
        spare[0].legend(handles.values(), names, loc="center", borderaxespad=0.0)
    elif handles:
        widest = KEY + LETTER * max(map(len, handles))
        most = max(1, min(len(handles), int(72 * WIDTH / widest)))
        # the panels keep their height
        figure.set_figheight(figure.get_figheight() + ROW * -(-len(handles) // most) / 72)
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=most)


def _at_the_ends(axis: Axes, named: Mapping[str, Artist]) -> bool:
    """Draw them right of the panel, lowest first. False where they are no curves, end elsewhere, or are too near."""
    if len(named) < 2:
        return False
    axis.figure.draw_without_rendering()  # type: ignore[union-attr]
    step = LINE * axis.figure.dpi / 72 / axis.bbox.height
    ends = [(name, line, _end(axis, line)) for name, handle in named.items() for line in [_line_of(handle)] if line]
    if len(ends) < len(named) or any(x < NEAR_THE_EDGE or not 0 <= y <= 1 for _, _, (x, y) in ends):
        return False
    ends.sort(key=lambda end: end[2][1])
    at = np.array([y for _, _, (_, y) in ends])
    places = at.copy()
    for i in range(1, at.size):
        places[i] = max(places[i], places[i - 1] + step)
    places -= (places - at).max() / 2
    if np.abs(places - at).max() > FARTHEST * step:
        return False
    for (name, line, end), place in zip(ends, places, strict=True):
        ends_at = {"relpos": (0, 0.5), "shrinkA": 0, "shrinkB": 0}
        leader = {"arrowstyle": "-", "color": line.get_color(), "linewidth": 0.6, **ends_at}
        words: Style = {"va": "center", "fontsize": 7.5, "annotation_clip": False, "arrowprops": leader}
        axis.annotate(name, end, (1.04, place), xycoords="axes fraction", textcoords="axes fraction", **words)
    return True


def _line_of(handle: Artist | Container) -> Line2D | None:
    first = handle[0] if isinstance(handle, Container) else handle
    return first if isinstance(first, Line2D) else None


def _end(axis: Axes, line: Line2D) -> tuple[float, float]:
    """Of what is farthest on the right, in parts of the panel."""
    data = np.column_stack([np.asarray(values, dtype=np.float64) for values in line.get_data()])
    places = axis.transAxes.inverted().transform(axis.transData.transform(data[np.isfinite(data).all(axis=1)]))
    x, y = places[np.argmax(places[:, 0])].tolist() if places.size else (np.nan, np.nan)
    return x, y


FORMS: dict[str, Style] = {
    "": {},
    "lines": {"marker": "none"},
    "marks": {"linestyle": "none"},
    "dotted": {"marker": "none", "linestyle": ":"},
    "dashed": {"marker": "none", "linestyle": "--"},
    "open": {"markerfacecolor": "white", "linestyle": ":"},
    "open marks": {"markerfacecolor": "white", "linestyle": "none"},
    "around": {"markerfacecolor": "none", "markersize": 7, "linestyle": "none"},
    "thick": {"marker": "none", "linestyle": "-", "linewidth": 3.0, "alpha": 0.45},
    "dots": {"marker": ".", "markersize": 2, "linestyle": "none"},
    "crosses": {"color": INK, "marker": "x", "linestyle": "none"},
    "black": {"color": INK, "marker": "none", "linestyle": "-"},
    "guide": GUIDE,
    "dashed guide": {**GUIDE, "linestyle": "--"},
    "interval": {},
}
"""Of a curve, over the style of its model, or of its place among ordered values."""
FIRST, FIRST_OF_ALL = "first", "first of all"
FEW, FEWEST, LARGE = 15, 3, 1e5
FEW_DECADES, ASIDE = 300, 1.2
WORST = "worst of a range and its interval: = within tolerance, ≠ outside, ? inconclusive"
SIGN = {Verdict.WITHIN: "=", Verdict.OUTSIDE: "≠", Verdict.INCONCLUSIVE: "?"}


def draw(chart: Chart, evidence: Evidence, users: Collection[str] = ()) -> Figure:
    """users: names of models that are not the package's own."""
    facets = [(panel, facet) for panel in chart.panels for facet in _facets(panel, evidence)]
    columns = len(facets) if len(facets) < 4 else 2 if len(facets) == 4 else 3
    rows = -(-len(facets) // columns)
    figure, grid = panels(rows, columns)
    axes, spare = grid[: len(facets)], grid[len(facets) :]
    _share(axes, [panel for panel, _ in facets])
    curves = [curve for panel in chart.panels for curve in _curves_with_table(panel, evidence)]
    styles = styles_of((name for curve in curves for name in _models(_rows_of_curve(evidence, curve, {}))), users)
    for axis, (panel, facet) in zip(axes, facets, strict=True):
        try:
            _panel(axis, panel, facet, evidence, styles)
        except KeyError as error:
            raise ValueError(f"chart {chart.name!r} names {error}, which is no column of its tables") from error
    for axis, (panel, _) in zip(axes, facets, strict=True):
        _limits(axis, panel)
    _name_axes_once(axes, columns)
    for axis in spare:
        axis.set_axis_off()
        axis.set_title("", loc="left")
    name_curves(figure, axes, columns, spare)
    return figure


def _share(axes: Sequence[Axes], drawn: Sequence[Panel]) -> None:
    """The same quantity on the same scale has one axis, and so have the panels of a facet."""
    scales = [(panel.y, panel.log, panel.ylim, panel.decades) for panel in drawn]
    for axis, panel, scale in zip(axes, drawn, scales, strict=True):
        same, of_facet = axes[scales.index(scale)], axes[drawn.index(panel)]
        if same is not axis:
            axis.sharey(same)
        if of_facet is not axis:
            axis.sharex(of_facet)


def _name_axes_once(axes: Sequence[Axes], columns: int) -> None:
    """Left of a row, and below a column."""
    for i, axis in enumerate(axes):
        if i % columns and axis.get_shared_y_axes().joined(axis, axes[i - 1]):
            axis.set_ylabel("")
            axis.tick_params(labelleft=False)
        if i + columns < len(axes) and axis.get_shared_x_axes().joined(axis, axes[i + columns]):
            axis.set_xlabel("")
            axis.tick_params(labelbottom=False)


def _facets(panel: Panel, evidence: Evidence) -> list[dict[str, object]]:
    names = (panel.facet,) if isinstance(panel.facet, str) else panel.facet
    if not names or not names[0]:
        return [{}]
    tables = [_rows_of_curve(evidence, curve, {}) for curve in _curves_with_table(panel, evidence)]
    values = dict.fromkeys(
        key for table in tables for key in zip(*(table.columns.get(n, ()) for n in names), strict=True)
    )
    return [dict(zip(names, key, strict=True)) for key in values] or [{}]


def _curves_with_table(panel: Panel, evidence: Evidence) -> list[Curve]:
    """A run need not have every quantity."""
    return [curve for curve in panel.curves if evidence.has_table(curve.quantity)]


def _panel(axis: Axes, panel: Panel, facet: dict[str, object], evidence: Evidence, styles: Mapping[str, Style]) -> None:
    if panel.shade:
        axis.axhspan(*panel.shade, color="#000000", alpha=0.08, linewidth=0, label="within the margin")
    for y in panel.lines:
        axis.axhline(y, color="#000000", linewidth=0.8)
    for curve in _curves_with_table(panel, evidence):
        # a family has one style in all facets
        family_keys = [key for key, *_ in _families(curve, _rows_of_curve(evidence, curve, {}))]
        for key, values, rows in _families(curve, _rows_of_curve(evidence, curve, facet)):
            i = family_keys.index(key)
            is_ordered = set(curve.by) - {"model"}
            own = graded(i, len(family_keys)) if is_ordered else styles[_models(rows)[0]]
            _curve(axis, curve, panel, rows, values, {**own, **FORMS[curve.style]}, i)
    if panel.judged:
        _verdicts(axis, _matching_rows(evidence.table(panel.judged + JUDGED), facet))
    title = panel.title or ", ".join(_value_label(*f) for f in facet.items())
    lines = f"{axis.get_title(loc='left')} {title}".strip().split("\n")
    axis.set_title("\n".join(textwrap.fill(line, 30) for line in lines), loc="left")
    axis.set(xlabel=panel.x, ylabel=textwrap.fill(panel.y, 26))
    axis.set(xscale="log" if "x" in panel.log else "linear", yscale="log" if "y" in panel.log else "linear")
    names: tuple[Literal["x", "y"], ...] = ("x", "y")
    for name in names:
        if name not in panel.log:
            axis.locator_params(axis=name, nbins=5)
            (axis.xaxis if name == "x" else axis.yaxis).set_major_formatter(EachNumber())


def _verdicts(axis: Axes, judged: Table) -> None:
    """The worst point of each range with its interval, and a sign."""
    for x, to, value, low, high, verdict in zip(
        *(judged[name] for name in ("from", "to", *ENDS, "verdict")), strict=True
    ):
        axis.fill_between(
            (x, to), [low] * 2, [high] * 2, facecolor="none", edgecolor="#000000", linewidth=0.6, label=WORST
        )
        axis.plot((x, to), [value] * 2, color="#000000", linewidth=2)
        sign = SIGN[Verdict(verdict)]
        axis.text(math.sqrt(x * to), 0.97, sign, transform=axis.get_xaxis_transform(), ha="center", va="top")


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
        tick(axis, _separate_ticks(np.unique(np.concatenate([line.get_xdata() for line in lines]))))
    elif "x" in panel.log and max(axis.get_xlim()) < LARGE:
        tick(axis, _round_ticks(*sorted(axis.get_xlim())))
    if "y" in panel.log and axis.get_ylim()[1] < FEW_DECADES * axis.get_ylim()[0]:
        tick(axis, _round_ticks(*axis.get_ylim()), up=True)
    for x in panel.at:
        if axis.get_xlim()[0] < x < axis.get_xlim()[1]:
            axis.axvline(x, **GUIDE)
    if panel.downward:
        axis.xaxis.set_inverted(True)


def _round_ticks(low: float, high: float) -> list[float]:
    """Powers of ten, of many some; three times them too, or more, where a panel would have few."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    powers = range(first, last + 1, max(1, (last - first) // 4))
    ticks: list[float] = []
    for steps in ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0)):
        if len(ticks) < FEWEST:
            ticks = [x for power in powers for step in steps if low <= (x := step * 10.0**power) <= high]
    return ticks


def _separate_ticks(values: np.ndarray) -> list[float]:
    """Without those of curves that are moved aside."""
    kept: list[float] = []
    for value in values.tolist():
        if not kept or value > ASIDE * kept[-1]:
            kept.append(value)
    return kept


def _value_label(name: str, value: object) -> str:
    """A value by its name; a name by itself, unless it is a number of a column that has names too."""
    try:
        return placed(name, f"{float(value):g}")  # type: ignore[arg-type]
    except ValueError:
        return str(value)


def _rows_of_curve(evidence: Evidence, curve: Curve, more: dict[str, object]) -> Table:
    return _matching_rows(evidence.table(curve.quantity), {"model": curve.model, **curve.of, **more})


def _matching_rows(table: Table, of: Mapping[str, object]) -> Table:
    """Rows that have these values, or none; "first" is that of the rows so far, "first of all" that of the table."""
    complete_table = table
    for name, choice in of.items():
        if name in table.columns and choice != () and table[name].size:
            column, firsts = table[name], {FIRST: table, FIRST_OF_ALL: complete_table}
            if isinstance(choice, str) and choice in firsts:
                values = (firsts[choice][name][0],)
            else:
                values = choice if isinstance(choice, tuple) else (choice,)
            table = table.rows(np.isin(column, np.asarray(values, dtype=column.dtype)))
    return table


def _models(table: Table) -> list[str]:
    return list(dict.fromkeys(map(str, table.columns.get("model", [""]))))


def _families(curve: Curve, table: Table) -> Iterator[tuple[tuple[str, ...], dict[str, object], Table]]:
    size = len(next(iter(table.columns.values())))
    keys = list(zip(*(map(str, table.columns[name]) for name in curve.by), strict=True)) or [()] * size
    for key in dict.fromkeys(keys):
        rows = table.rows([i for i in range(size) if keys[i] == key])
        yield key, {name: column[0] for name, column in rows.columns.items()}, rows


def _curve(
    axis: Axes, curve: Curve, panel: Panel, rows: Table, values: dict[str, object], style: Style, i: int
) -> None:
    where = {name: value for name, value in values.items() if value == value}
    label = curve.label or ", ".join(_value_label(name, where[name]) for name in curve.by if name in where)
    label = label or (curve.model if isinstance(curve.model, str) else "")
    label = label if label == curve.label else legend_name(label)
    if curve.upright:
        for x, name in zip(rows["value"], rows["model"], strict=True):
            axis.axvline(x, label=label or "_", **style)
            up = axis.get_xaxis_transform()
            axis.text(x, 0.02, "" if label else name, transform=up, rotation=90, va="bottom", ha="right", fontsize=7)
        return
    above, down = 0.0 if "y" in panel.log else -np.inf, i * curve.down
    x, *ends = (
        np.maximum(rows[name], least) if least > -np.inf else rows[name]
        for name, least in zip((panel.x, *ENDS), (panel.least[0], *[panel.least[1]] * 3), strict=True)
    )
    y, low, high = (visible(values, above=above) for values in ends)
    if curve.style == "interval":
        axis.fill_between(x, low, high, color=style["color"], alpha=0.2, linewidth=0, label=label)
        return
    if curve.marker_spacing or (y.size > FEW and not curve.bars and style["linestyle"] != "none"):
        style["markevery"] = curve.marker_spacing or max(y.size // FEW, 1)
    if curve.bars and np.any(high > low):
        # down to nothing: on a logarithmic axis a decade
        down_to = np.where(np.asarray(rows["low"]) > above, low, 0.1 * y)
        bars = [np.nan_to_num(y - down_to), np.nan_to_num(high - y)]
        # moved a little, so that intervals stand side by side
        factor = curve.x_factor**i if "x" in panel.log else 1.0
        axis.errorbar(factor * x, y - down, yerr=bars, label=label, **style, **BARS)
    else:
        axis.plot(x, y - down, label=label, **style)
    if curve.band:
        axis.fill_between(x, low, high, color=style["color"], alpha=0.15, linewidth=0)
