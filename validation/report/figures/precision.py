"""Figures of error against cost: a chart a quantity, and all of them in one."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from validation.analysis.evidence import Table
from validation.report.style import Style, panels

STYLES: dict[str, Style] = {
    "closed form": {"color": "#000000", "marker": "*", "linestyle": "none", "markersize": 8},
    "fit": {"color": "#000000", "marker": "x", "linestyle": "none", "markersize": 6},
    "linear filter, 1D": {"color": "#E69F00", "marker": "P", "linestyle": "-."},
    "linear filter, 3D": {"color": "#000000", "marker": "X", "linestyle": "none", "markersize": 7},
    "springs": {"color": "#D55E00", "marker": "s", "markerfacecolor": "white", "linestyle": "-"},
    "springs, rolling spectrum": {"color": "#009E73", "marker": "^", "markerfacecolor": "white", "linestyle": "--"},
    "BEM, finer cells": {"color": "#0072B2", "marker": "o", "linestyle": "-"},
    "BEM, looser residual": {"color": "#0072B2", "marker": "d", "markerfacecolor": "white", "linestyle": "--"},
    "BEM, extrapolated": {"color": "#332288", "marker": "h", "linestyle": "-."},
}
NEW: Style = {"color": "#AA4499", "marker": "p", "markerfacecolor": "white", "linestyle": "-"}
"""Of a model that has no style of its own."""
COMMON: Style = {"markersize": 4.5, "linewidth": 0.9}
BARS: Style = {"capsize": 1.5, "elinewidth": 0.7}
PLACES = {"left": 0.065, "right": 0.985, "bottom": 0.06, "top": 0.965, "wspace": 0.22, "hspace": 0.27}
ROOM = 3.0
"""How far a chart goes on, as a factor, below what is drawn and above."""


def _style(method: str) -> Style:
    return {**COMMON, **STYLES.get(method, NEW)}


def _methods(points: Table) -> list[str]:
    """In the order of the styles, new models last."""
    known = list(STYLES)
    names = dict.fromkeys(points["method"].tolist())
    return sorted(names, key=lambda name: known.index(name) if name in known else len(known))


def draw(points: Table) -> Figure:
    """Error against seconds."""
    charts = list(dict.fromkeys(zip(points["scene"].tolist(), points["quantity"].tolist(), strict=True)))
    figure, axes = panels(3, 3, width=12.5, height=10.0, within=PLACES)
    for i, (axis, (scene, quantity)) in enumerate(zip(axes, charts, strict=False)):
        mine = points.where(scene=scene, quantity=quantity)
        _chart(axis, mine)
        axis.set_title(f"{axis.get_title(loc='left')} {scene}: {quantity} [{mine['unit'][0]}]", loc="left")
        below, left = i >= len(charts) - 3, i % 3 == 0
        axis.set(xlabel="seconds of one realisation" if below else "", ylabel="error" if left else "")
    for axis in axes[len(charts) :]:
        axis.set_axis_off()
        axis.set_title("", loc="left")
    handles = [axes[-1].plot([], [], label=method, **_style(method))[0] for method in _methods(points)]
    axes[-1].legend(handles=handles, loc="center", fontsize=9)
    return figure


def _chart(axis: Axes, points: Table) -> None:
    scale, done = 100.0 if points["unit"][0] == "%" else 1.0, points["status"] == "finished"
    error, half, band = (scale * points[name] for name in ("error", "± sample", "band"))
    x, others = points["median [s]"], done & ~points["reference itself"]
    floor, top = _limits(error[others], half[others], float(band[0]))
    known = x[np.isfinite(x) & (x > 0)]
    axis.set(xscale="log", yscale="log", ylim=(floor / ROOM, top), xlim=(known.min() / ROOM, known.max() * ROOM))
    axis.xaxis.set_major_locator(LogLocator(numticks=6))
    axis.minorticks_off()
    axis.axhspan(floor / ROOM, floor, color="#000000", alpha=0.12, linewidth=0)
    ahead = np.flatnonzero(points["front"])[np.argsort(x[points["front"]])]
    rank = np.maximum(error + half, floor)[ahead]
    axis.step(x[ahead], rank, where="post", color="#bbbbbb", linewidth=4.0, zorder=0.5, solid_capstyle="round")
    quartiles = points["lower quartile [s]"], points["upper quartile [s]"]
    for method in dict.fromkeys(points["method"].tolist()):
        mine, style = points["method"] == method, _style(method)
        some = mine & done & np.isfinite(x)
        if some.any():
            across = [np.abs(end - x)[some] for end in quartiles]
            _curve(axis, x[some], error[some], half[some], floor, across, style)
        for place in x[mine & ~done]:
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
        pointing = {**style, "marker": "v", "linestyle": "none", "markersize": 7, "markerfacecolor": style["color"]}
        axis.plot(x[within], y[within], **pointing)
