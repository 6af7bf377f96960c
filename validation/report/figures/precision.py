"""Figures of error against cost, a chart a quantity: of what has no closed form, and of what has one."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from validation.analysis.evidence import Table
from validation.benchmarks.timing import FINISHED
from validation.benchmarks.work_precision.pareto import SHOWN, TOLERANCES
from validation.benchmarks.work_precision.problem import RolledOffPunchProblem
from validation.report.drawing import name_curves
from validation.report.style import BARS, GUIDE, SOFT, Style, panels, styles_of

CHART = ("scene", "quantity")
PARETO: Style = {"color": "#bbbbbb", "linewidth": 4.0, "zorder": 0.5, "solid_capstyle": "round"}
CROSS: Style = {"marker": "x", "linestyle": "none", "markersize": 6}
OFFSETS = ((3, 1), (3, -6), (-3, 1), (-3, -6), (3, 6), (3, -11), (-3, 6), (-3, -11))
"""From a mark to the beginning of its label, or to its end on the left [points]; the first with room is taken."""
ROOM = 3.0
"""How far a chart goes on, as a factor, below what is drawn and above."""


def draw(points: Table) -> Figure:
    """Error against seconds, of what has no closed form: the punch of Fig. 14.1 and the rolling wheel."""
    return _draw(points, lambda scene, exact: not exact and scene != RolledOffPunchProblem.name)


def draw_interface(points: Table) -> Figure:
    """The same of the punch with a roll-off."""
    return _draw(points, lambda scene, exact: scene == RolledOffPunchProblem.name)


def draw_others(points: Table) -> Figure:
    """The same of what has a closed form."""
    return _draw(points, lambda scene, exact: exact)


def _draw(points: Table, shows: Callable[[str, bool], bool]) -> Figure:
    """A panel a chart; shows: whether a scene, with or without a closed form, is drawn."""
    exact = set(zip(*(points.rows(points["reference itself"])[name] for name in CHART), strict=True))
    keys = dict.fromkeys(zip(*(points[name] for name in CHART), strict=True))
    charts = [key for key in keys if shows(str(key[0]), key in exact)]
    columns = 2 if len(charts) in (1, 2, 4) else 3
    figure, axes = panels(max(1, -(-len(charts) // columns)), columns)
    styles = styles_of(points["method"].tolist())
    for i, (axis, key) in enumerate(zip(axes, charts, strict=False)):
        rows = points.where(**dict(zip(CHART, key, strict=True)))
        _chart(axis, rows, styles)
        scene, quantity = key
        title = f"{axis.get_title(loc='left')} {scene}:\n{quantity}"
        axis.set_title(title, loc="left")
        below = i + columns >= len(charts)
        axis.set(xlabel="seconds of one realisation" if below else "", ylabel=f"error [{rows['unit'][0]}]")
    for axis in (spare := axes[len(charts) :]):
        axis.set_axis_off()
        axis.set_title("", loc="left")
    if charts:
        name_curves(figure, axes[: len(charts)], columns, spare)
    return figure


def _chart(axis: Axes, points: Table, styles: Mapping[str, Style]) -> None:
    unit = str(points["unit"][0])
    scale, done = SHOWN[unit], points["status"] == FINISHED
    error, half, band = (scale * points[name] for name in ("error", "± sample", "band"))
    x, compared = points["median [s]"], done & ~points["reference itself"]
    tolerances = [scale * tolerance for tolerance in TOLERANCES[unit]]
    floor, top = _limits(error[compared], half[compared], float(band[0]))
    bottom, top = min(floor, *tolerances) / ROOM, max(top, 2 * max(tolerances))
    seconds = x[np.isfinite(x) & (x > 0)]
    axis.set(xscale="log", yscale="log", ylim=(bottom, top), xlim=(seconds.min() / ROOM, seconds.max() * ROOM))
    axis.xaxis.set_major_locator(LogLocator(numticks=5))
    axis.yaxis.set_major_formatter("{x:g}")
    axis.minorticks_off()
    axis.axhspan(bottom, floor, color="#000000", alpha=0.08, linewidth=0, label="uncertainty of the reference")
    for tolerance in tolerances:
        axis.axhline(tolerance, **{**GUIDE, "linewidth": 0.8}, zorder=0.7, label="tolerances")
        end: Any = {"xy": (1.0, tolerance), "xycoords": ("axes fraction", "data"), "textcoords": "offset points"}
        axis.annotate(f"{tolerance:g} {unit}", **end, xytext=(-2, 1), ha="right", fontsize=6, color=SOFT)
    ahead = np.flatnonzero(points["front"])[np.argsort(x[points["front"]])]
    rank = np.maximum(_largest_from_here(error, points["method"], compared), floor)[ahead]
    axis.step(x[ahead], rank, where="post", label="Pareto front: no setting is both cheaper and closer", **PARETO)
    quartiles = points["lower quartile [s]"], points["upper quartile [s]"]
    for method in dict.fromkeys(points["method"].tolist()):
        rows, style = points["method"] == method, styles[method]
        finished = rows & done & np.isfinite(x)
        if finished.any():
            across = [np.abs(end - x)[finished] for end in quartiles]
            axis.plot([], [], label=method, **style)
            _curve(axis, x[finished], error[finished], half[finished], floor, across, style)
        for place in x[rows & ~done]:
            # along the top; on the left who has no cost
            at = (place, axis.get_xaxis_transform()) if np.isfinite(place) and place > 0 else (0.03, axis.transAxes)
            axis.plot([at[0]], [0.96], **{**CROSS, "color": style["color"]}, transform=at[1])
    axis.plot([], [], **CROSS, color=SOFT, label="no result: out of range, or failed")
    axis.plot(
        [], [], marker="$12$", markersize=9, color=SOFT, linestyle="none", label="setting: springs, cells or residual"
    )
    shown = np.flatnonzero(compared & np.isfinite(x))
    texts = [_text_of_setting(str(points["setting"][i]), float(points["value"][i])) for i in shown]
    colors = [styles[str(points["method"][i])]["color"] for i in shown]
    _label_settings(axis, x[shown], np.maximum(error[shown], floor), texts, colors)


def _largest_from_here(error: np.ndarray, method: np.ndarray, finished: np.ndarray) -> np.ndarray:
    """The largest error of each setting and of the finer ones of its method, which come later."""
    largest = np.array(error)
    for name in dict.fromkeys(method.tolist()):
        mine = np.flatnonzero((method == name) & finished)
        largest[mine] = np.maximum.accumulate(error[mine][::-1])[::-1]
    return largest


def _text_of_setting(setting: str, value: float) -> str:
    """The number of the setting, nothing where it has none: a closed form has no setting."""
    return f"{value:g}" if f"{value:g}" in setting else ""


def _label_settings(axis: Axes, x: np.ndarray, y: np.ndarray, texts: Sequence[str], colors: Sequence[str]) -> None:
    """Write each setting beside its mark, where there is room for it: of settings at one place the first and last."""
    axis.figure.draw_without_rendering()  # type: ignore[union-attr]
    marks = axis.transData.transform(np.column_stack([x, y])) * (72 / axis.figure.dpi)
    boxes = [(px - 2.0, py - 2.0, px + 2.0, py + 2.0) for px, py in marks]
    for i in sorted(range(len(texts)), key=lambda i: min(i, len(texts) - 1 - i)):
        width = 3.6 * len(texts[i])
        for dx, dy in OFFSETS if texts[i] else ():
            left, low = marks[i] + (dx if dx > 0 else dx - width, dy)
            box = (left, low, left + width, low + 5.5)
            if not any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3] for b in boxes):
                boxes.append(box)
                near: Any = {"textcoords": "offset points", "ha": "left" if dx > 0 else "right", "fontsize": 5.5}
                axis.annotate(texts[i], (x[i], y[i]), (dx, dy), color=colors[i], **near)
                break


def _limits(error: np.ndarray, half: np.ndarray, band: float) -> tuple[float, float]:
    """The edge below which nothing is ranked, no farther down than what is drawn; the top of the chart."""
    positive = error[error > 0]
    floor = max(band, float(positive.min()) / ROOM if positive.size else band)
    top = float((error + half).max()) if error.size else 10 * band
    return floor, max(top, 2 * floor) * ROOM


def _curve(
    axis: Axes, x: np.ndarray, off: np.ndarray, half: np.ndarray, floor: float, across: Any, style: Style
) -> None:
    """With bars; who lies below the floor is drawn there, pointing down."""
    y = np.maximum(off, floor)
    bars = [np.maximum(y - np.maximum(off - half, floor), 0.0), np.maximum(off + half, floor) - y]
    axis.errorbar(x, y, yerr=bars, xerr=across, **style, **BARS)
    within = off <= floor
    if within.any():
        pointing = {**style, "marker": "v", "linestyle": "none", "markersize": 5, "markerfacecolor": style["color"]}
        axis.plot(x[within], y[within], **pointing)
