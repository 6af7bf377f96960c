"""The figure of speed against accuracy: what each model of a scene takes, and how far it is from the reference."""

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.advice.compare import Comparison
from validation.advice.side_by_side import speed_and_accuracy
from validation.analysis.evidence import Table
from validation.report.style import GUIDE, SETTINGS, Style, in_two_lines, picture, plain_figure

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
    if not any(np.isfinite(comparison.seconds_of(one)) for one in comparison.selection.solved):
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
        _draw(axes, table)
        figure.legend(loc="lower center", ncols=4)
    plain_figure(figure)
    return picture(figure, form)


def _draw(axes: Axes, table: Table) -> None:
    shown = np.where(table["is_reference"] | ~(table["error"] > 0), table["high"], table["error"])
    positive = np.concatenate([shown, table["low"]])
    least = float(np.min(positive[positive > 0], initial=np.inf)) / ROOM
    reference_kind, mdr, other = KINDS
    kinds = np.where(table["is_reference"], reference_kind, np.where(table["is_mdr"], mdr, other))
    for kind, style in KINDS.items():
        mine = kinds == kind
        y, low, high = shown[mine], np.maximum(table["low"][mine], least), table["high"][mine]
        if mine.any():
            bars = np.nan_to_num([y - low, high - y]).clip(0)
            axes.errorbar(table["seconds"][mine], y, yerr=bars, label=kind, **style, **BARS)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.15, y=0.1)
    axes.set_ylim(bottom=least if np.isfinite(least) else None)
    (reference,) = table.where(is_reference=True)["model"]
    axes.set_xlabel("time of the solves [s]")
    axes.set_ylabel(f"difference from {reference} [{table['unit'][0]}]")
    seen = np.isfinite(shown) & (shown > 0)
    _label(axes, table["seconds"][seen], shown[seen], table["model"][seen].tolist())


def _label(axes: Axes, x: np.ndarray, y: np.ndarray, names: list[str]) -> None:
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
