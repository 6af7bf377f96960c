"""Draws the figures that cases declare, from their tables alone."""

import math
import textwrap
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Literal

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.container import Container
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Evidence, Table, Verdict, placed
from validation.analysis.series import ENDS, JUDGED
from validation.report.style import (
    BARS,
    GUIDE,
    INK,
    SETTINGS,
    SOFT,
    WIDTH,
    EachNumber,
    Style,
    graded,
    legend_name,
    panels,
    picture,
    plain_figure,
    styles_of,
    tick,
    visible,
)

LINE, ROW, LETTER, KEY = 9.0, 12.0, 4.2, 34.0
"""Height of a line of names, and of one of a legend, width of a letter, and of the sample before a name [points]."""
MOST, FARTHEST = 6, 1.5
"""Curves that are named at their ends; how far a name is moved, in lines."""
LONGEST = 40
"""Letters of a name that has room at the end of its curve."""
BESIDE = 14
"""Names for which a spare place of the grid has room."""
TITLE, WIDE = 30, 90
"""Letters of a line of a title, above one of several panels and across the figure."""
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
        widest = KEY + LETTER * max(len(line) for name in handles for line in name.split("\n"))
        most = max(1, min(len(handles), int(72 * WIDTH / widest)))
        # the panels keep their height
        lines = -(-len(handles) // most) * max(1 + name.count("\n") for name in handles)
        figure.set_figheight(figure.get_figheight() + ROW * lines / 72)
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=most)


def _at_the_ends(axis: Axes, named: Mapping[str, Artist]) -> bool:
    """Draw them right of the panel, lowest first. False where they are no curves, end elsewhere, or are too near."""
    if len(named) < 2 or any(len(name) > LONGEST or "\n" in name for name in named):
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
FEW_DECADES, ASIDE, TICKS = 300, 1.2, 16
WORST = "worst of a range and its interval: = within tolerance, ≠ outside, ? inconclusive"
SIGN = {Verdict.WITHIN: "=", Verdict.OUTSIDE: "≠", Verdict.INCONCLUSIVE: "?"}


def draw(chart: Chart, evidence: Evidence, users: Collection[str] = ()) -> Figure:
    """users: names of models that are not the package's own."""
    facets = [(panel, facet) for panel in chart.panels for facet in _facets(panel, evidence)]
    columns = chart.columns or (len(facets) if len(facets) < 4 else 2 if len(facets) == 4 else 3)
    rows = -(-len(facets) // columns)
    heights = [max(panel.height for panel, _ in facets[row * columns :][:columns]) for row in range(rows)]
    figure, grid = panels(rows, columns, heights=heights)
    axes, spare = grid[: len(facets)], grid[len(facets) :]
    _share(axes, [panel for panel, _ in facets])
    curves = [curve for panel in chart.panels for curve in _curves_with_table(panel, evidence)]
    styles = styles_of((name for curve in curves for name in _models(_rows_of_curve(evidence, curve, {}))), users)
    for axis, (panel, facet) in zip(axes, facets, strict=True):
        try:
            _panel(axis, panel, facet, evidence, styles)
        except KeyError as error:
            raise ValueError(f"chart {chart.name!r} names {error}, which is no column of its tables") from error
        _title(axis, panel, facet, TITLE if columns > 1 else WIDE)
    for axis, (panel, _) in zip(axes, facets, strict=True):
        _limits(axis, panel)
    _name_axes_once(axes, columns)
    for axis in spare:
        axis.set_axis_off()
        axis.set_title("", loc="left")
    if chart.title:
        figure.suptitle(textwrap.fill(chart.title, WIDE), x=0.01, ha="left", fontsize="medium")
    name_curves(figure, axes, columns, spare)
    for axis, (panel, facet) in zip(axes, facets, strict=True):
        _name_points(axis, panel, facet, evidence)
    return figure


DrawnPanel = tuple[Panel, Table]
"""A panel, and the table that it draws."""


def picture_of(chart: Chart, tables: Iterable[Table], form: str, users: Collection[str] = ()) -> bytes:
    """A chart that is of no case, in one of the `FORMATS`; the texts of its tables are no markup."""
    evidence = Evidence(title="", method="", numbers=(), tables=tuple(tables), conclusions=(), captions={})
    with matplotlib.rc_context(SETTINGS):
        figure = draw(chart, evidence, users)
    plain_figure(figure)
    return picture(figure, form)


def drawn_on(axis: Axes | None, panel: Panel, table: Table, users: Collection[str] = ()) -> Axes:
    """One panel on axes of a user, or on those of a new figure of pyplot, with a legend; its texts are no markup.

    Raises TypeError for what is no Axes.
    """
    if axis is None:
        # imported where a figure is asked for: it chooses a backend
        import matplotlib.pyplot as plt

        axis = plt.subplots(layout="constrained")[1]
    if not isinstance(axis, Axes):
        raise TypeError(f"ax must be an Axes of matplotlib, or None for a new figure, got {type(axis).__name__}")
    evidence = Evidence(title="", method="", numbers=(), tables=(table,), conclusions=(), captions={})
    curves = _curves_with_table(panel, evidence)
    styles = styles_of((name for curve in curves for name in _models(_rows_of_curve(evidence, curve, {}))), users)
    with matplotlib.rc_context(SETTINGS):
        _panel(axis, panel, {}, evidence, styles)
        _limits(axis, panel)
        title = axis.set_title(textwrap.fill(panel.title.replace("\n", ", "), WIDE // 2), loc="left")
        handles = [] if panel.rows else axis.get_legend_handles_labels()[0]
        legend = axis.legend(fontsize="small") if handles else None
        for text in (axis.xaxis.label, axis.yaxis.label, title, *(legend.get_texts() if legend else ())):
            text.set_parse_math(False)
    return axis


def _share(axes: Sequence[Axes], drawn: Sequence[Panel]) -> None:
    """The same quantity on the same scale has one axis, and so have the panels of a facet; rows have their names."""
    scales = [(panel.y, panel.log, panel.ylim, panel.decades, i * bool(panel.rows)) for i, panel in enumerate(drawn)]
    for axis, panel, scale in zip(axes, drawn, scales, strict=True):
        same, of_facet = axes[scales.index(scale)], axes[drawn.index(panel)]
        if same is not axis and not panel.own_y:
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
    for name, y in panel.limits.items():
        axis.axhline(y, label=name, **GUIDE)
    places = _places(panel, facet, evidence)
    for curve in _curves_with_table(panel, evidence):
        # a family has one style in all facets
        family_keys = [key for key, *_ in _families(curve, _rows_of_curve(evidence, curve, {}))]
        for key, values, rows in _families(curve, _rows_of_curve(evidence, curve, facet)):
            i = family_keys.index(key)
            is_ordered = set(curve.by) - {"model"}
            own = graded(i, len(family_keys)) if is_ordered else styles[_models(rows)[0]]
            style = {**own, **FORMS[curve.style]}
            if panel.rows:
                _points_in_rows(axis, curve, panel, rows, places, style)
            else:
                _curve(axis, curve, panel, _at_places(rows, panel.x, places), values, style, i)
    if panel.judged:
        _verdicts(axis, _matching_rows(evidence.table(panel.judged + JUDGED), facet))
    axis.set(xlabel=panel.x, ylabel=textwrap.fill(panel.y, round(26 * max(1.0, panel.height / 2))))
    _scales(axis, panel, places)


def _title(axis: Axes, panel: Panel, facet: dict[str, object], most: int) -> None:
    """Behind the letter of the panel, its title or the values of its facet. most: characters of a line."""
    title = panel.title or ", ".join(_value_label(*f) for f in facet.items())
    lines = f"{axis.get_title(loc='left')} {title}".strip().split("\n")
    axis.set_title("\n".join(textwrap.fill(line, most) for line in lines), loc="left")


def _scales(axis: Axes, panel: Panel, places: Mapping[str, int]) -> None:
    """Linear or logarithmic axes, or names at the places that they have."""
    axis.set(xscale="log" if "x" in panel.log else "linear", yscale="log" if "y" in panel.log else "linear")
    named: Literal["x", "y", ""] = "" if not places else "y" if panel.rows else "x"
    names: tuple[Literal["x", "y"], ...] = ("x", "y")
    for name in names:
        if name not in panel.log and name != named:
            axis.locator_params(axis=name, nbins=5)
            (axis.xaxis if name == "x" else axis.yaxis).set_major_formatter(EachNumber())
    if named == "y":
        axis.set_yticks(list(places.values()), list(places))
        axis.set_ylim(len(places) - 0.4, -0.6)
    elif named == "x":
        axis.set_xticks(list(places.values()), list(places))
        axis.margins(x=0.2)


def _places(panel: Panel, facet: dict[str, object], evidence: Evidence) -> dict[str, int]:
    """Numbers of the rows of a panel, or of the texts of its horizontal axis, by what stands there; none of numbers."""
    column = panel.rows or panel.x
    tables = [_rows_of_curve(evidence, curve, facet) for curve in _curves_with_table(panel, evidence)]
    cells = [cell for table in tables for cell in table.columns.get(column, ())]
    names = dict.fromkeys(map(str, cells)) if panel.rows or any(isinstance(cell, str) for cell in cells) else ()
    return {name: i for i, name in enumerate(names)}


def _at_places(rows: Table, x: str, places: Mapping[str, int]) -> Table:
    """The rows with the places of texts in a column."""
    return replace(rows, columns={**rows.columns, x: [places[str(cell)] for cell in rows[x]]}) if places else rows


def _points_in_rows(
    axis: Axes, curve: Curve, panel: Panel, rows: Table, places: Mapping[str, int], style: Style
) -> None:
    """A point and its horizontal interval in the row of each name; an interval alone is shaded across all rows."""
    value, low, high = (np.asarray(rows[end], dtype=np.float64) for end in ENDS)
    if curve.style == "interval":
        for i in np.flatnonzero(np.isfinite(low) & np.isfinite(high)):
            axis.axvspan(low[i], high[i], color=style["color"], alpha=0.1, linewidth=0)
        return
    bars = np.nan_to_num([value - low, high - value], posinf=0.0)
    marker = style["marker"] if style["marker"] != "none" else "o"
    own: Style = {**style, "linestyle": "none", "markersize": 5, "marker": marker}
    axis.errorbar(value, [places[str(name)] for name in rows[panel.rows]], xerr=bars, **own, capsize=3, elinewidth=1.0)


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
    if any(curve.named for curve in panel.curves):
        # room for names
        axis.margins(x=0.15, y=0.1)
    if panel.decades:
        top = max((np.nanmax(np.asarray(line.get_ydata(), dtype=np.float64)) for line in lines), default=1.0)
        low = top * 10**-panel.decades if "y" in panel.log else top - panel.decades
        axis.set_ylim(low, 6 * top if "y" in panel.log else top + 0.1 * panel.decades)
    if panel.xlim:
        axis.set_xlim(*panel.xlim)
    if panel.ylim:
        axis.set_ylim(*panel.ylim)
    _ticks(axis, panel, lines)
    for x in panel.at:
        if axis.get_xlim()[0] < x < axis.get_xlim()[1]:
            axis.axvline(x, **GUIDE)
    if panel.downward:
        axis.xaxis.set_inverted(True)
    if panel.above:
        _second_axis(axis, *panel.above)


def _ticks(axis: Axes, panel: Panel, lines: Sequence[Line2D]) -> None:
    """Ticks at the values of the curves, or at round ones of logarithmic axes."""
    if panel.ticked:
        tick(axis, _separate_ticks(np.unique(np.concatenate([line.get_xdata() for line in lines]))))
    elif "x" in panel.log and max(axis.get_xlim()) < LARGE:
        tick(axis, _round_ticks(*sorted(axis.get_xlim())))
    if "y" in panel.log and axis.get_ylim()[1] < FEW_DECADES * axis.get_ylim()[0]:
        tick(axis, _round_ticks(*axis.get_ylim()), up=True)


def _second_axis(axis: Axes, name: str, constant: float) -> None:
    """An axis above, on which constant / x stands."""

    def reciprocal(values: ArrayLike) -> np.ndarray:
        """Of x, and the other way round; matplotlib tries zero, too."""
        return constant / np.maximum(np.asarray(values, dtype=np.float64), 1e-12)

    above = axis.secondary_xaxis("top", functions=(reciprocal, reciprocal))
    above.set_xlabel(name)
    ticks = _round_ticks(*sorted(reciprocal(axis.get_xlim()).tolist()))
    above.set_xticks(ticks, [f"{value:g}" for value in ticks])
    above.xaxis.minorticks_off()


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
    """Without those of curves that are moved aside, and of many each second, or third, from the largest on."""
    kept: list[float] = []
    for value in values.tolist():
        if not kept or value > ASIDE * kept[-1]:
            kept.append(value)
    return kept[:: -1 - len(kept) // TICKS][::-1]


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
    label = "_" if curve.named else label if label == curve.label else legend_name(label)
    if curve.upright:
        for x, name in zip(rows["value"], rows["model"], strict=True):
            axis.axvline(x, label=label or "_", **style)
            up = axis.get_xaxis_transform()
            axis.text(x, 0.02, "" if label else name, transform=up, rotation=90, va="bottom", ha="right", fontsize=7)
        return
    if curve.named:
        style["markersize"] = 5
    if (style["marker"], style["linestyle"]) == ("none", "none"):
        # a point without a form is not seen
        style["marker"] = "o"
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
        # its edges are seen in grey, and where bands lie over each other
        edge = {"edgecolor": to_rgba(style["color"], 0.5), "linewidth": 0.5, "linestyle": style["linestyle"]}
        axis.fill_between(x, low, high, facecolor=to_rgba(style["color"], 0.15), **edge)


def _name_points(axis: Axes, panel: Panel, facet: dict[str, object], evidence: Evidence) -> None:
    """Names of points beside these, towards the middle, a line above the one below it at the least."""
    points = [
        (float(x), float(y), legend_name(curve.label or str(name)))
        for curve in _curves_with_table(panel, evidence)
        if curve.named
        for rows in [_rows_of_curve(evidence, curve, facet)]
        for x, y, name in zip(rows[panel.x], rows["value"], rows["model"], strict=True)
    ]
    points = [point for point in points if np.isfinite(point[:2]).all() and ("y" not in panel.log or point[1] > 0)]
    if not points:
        return
    # places on the page are known once it is laid out
    axis.figure.draw_without_rendering()  # type: ignore[union-attr]
    ends = 72 / axis.figure.dpi * axis.transData.transform([point[:2] for point in points])
    middle = 36 / axis.figure.dpi * (axis.bbox.x0 + axis.bbox.x1)
    occupied: list[tuple[float, float, float]] = []
    for i in np.argsort(ends[:, 1]):
        (x, y), length = ends[i].tolist(), LETTER * len(points[i][2])
        side: Literal["left", "right"] = "left" if x < middle else "right"
        left, right = (x, x + length) if side == "left" else (x - length, x)
        height = y
        while near := [at for start, stop, at in occupied if left < stop and start < right and abs(at - height) < LINE]:
            height = max(near) + LINE
        occupied.append((left, right, height))
        leader = {"arrowstyle": "-", "linewidth": 0.4, "color": SOFT} if height > y else None
        words: Style = {"ha": side, "va": "center", "fontsize": 7.5, "arrowprops": leader, "in_layout": False}
        shift = (8 if side == "left" else -8, height - y)
        axis.annotate(points[i][2], points[i][:2], xytext=shift, textcoords="offset points", **words)
