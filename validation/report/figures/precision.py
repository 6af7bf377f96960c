"""Figures of error against cost, a chart a quantity: of what has no closed form, and of what has one."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from validation.analysis.evidence import Table
from validation.report.drawing import name_curves
from validation.report.style import BARS, Style, panels, styles_of

CHART = ("scene", "quantity")
ROOM = 3.0
"""How far a chart goes on, as a factor, below what is drawn and above."""


def draw(points: Table) -> Figure:
    """Error against seconds, of what has no closed form: the questions of the front page."""
    return _draw(points, without_closed_form=True)


def draw_others(points: Table) -> Figure:
    """The same of what has one."""
    return _draw(points, without_closed_form=False)


def _draw(points: Table, *, without_closed_form: bool) -> Figure:
    exact = set(zip(*(points.rows(points["reference itself"])[name] for name in CHART), strict=True))
    charts = [
        key
        for key in dict.fromkeys(zip(*(points[name] for name in CHART), strict=True))
        if without_closed_form != (key in exact)
    ]
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
    name_curves(figure, axes[: len(charts)], columns, spare)
    return figure


def _chart(axis: Axes, points: Table, styles: Mapping[str, Style]) -> None:
    scale, done = 100.0 if points["unit"][0] == "%" else 1.0, points["status"] == "finished"
    error, half, band = (scale * points[name] for name in ("error", "± sample", "band"))
    x, compared = points["median [s]"], done & ~points["reference itself"]
    floor, top = _limits(error[compared], half[compared], float(band[0]))
    seconds = x[np.isfinite(x) & (x > 0)]
    axis.set(xscale="log", yscale="log", ylim=(floor / ROOM, top), xlim=(seconds.min() / ROOM, seconds.max() * ROOM))
    axis.xaxis.set_major_locator(LogLocator(numticks=5))
    axis.minorticks_off()
    axis.axhspan(floor / ROOM, floor, color="#000000", alpha=0.08, linewidth=0, label="uncertainty of the reference")
    ahead = np.flatnonzero(points["front"])[np.argsort(x[points["front"]])]
    rank = np.maximum(error + half, floor)[ahead]
    axis.step(
        x[ahead], rank, where="post", color="#bbbbbb", linewidth=4.0, zorder=0.5, solid_capstyle="round", label="front"
    )
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
            axis.plot([at[0]], [0.96], marker="x", color=style["color"], transform=at[1], markersize=6)


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
