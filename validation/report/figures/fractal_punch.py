"""Figures of the fractal punch: Fig. 14.1 of the book, both methods in one panel, and their ratio."""

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import BEM, GUIDE, MDR_LINE, MDR_OTHER, graded, panels, visible

FORCE = "force Fbar = F / (E* h L)"
SIGN = {"agree": "=", "differ": "≠", "undecided": "?"}


def draw(evidence: Evidence) -> Figure:
    """As in the book: the relative deviation of every Hurst exponent, (a) in three dimensions, (b) in one."""
    curves = evidence.table("curves")
    figure, axes = panels(1, 2, height=4.0, sharex=True, sharey="row")
    hursts = np.unique(curves["H"])
    for axis, method, title in zip(axes, ("bem3d", "mdr"), ("boundary elements", "MDR"), strict=True):
        for i, hurst in enumerate(hursts):
            mine = curves.where(H=hurst)
            value = visible(mine[f"{method} relative deviation"])
            few = mine["bem3d few cells"] & (method == "bem3d")
            style = graded(i, hursts.size)
            axis.plot(mine["Fbar"], value, label=f"H = {hurst:g}", **style)
            low, high = (visible(mine[f"{method} relative deviation {end}"]) for end in ("low", "high"))
            axis.fill_between(mine["Fbar"], low, high, color=style["color"], alpha=0.15, linewidth=0)
            axis.plot(mine["Fbar"][few], value[few], **{**style, "linestyle": "none", "markerfacecolor": "white"})
        axis.set(xscale="log", xlabel=FORCE, title=title, ylim=(0, None))
        axis.legend(loc="upper right")
    axes[0].set_ylabel("relative standard deviation of the stiffness")
    return figure


def draw_overlay(evidence: Evidence) -> Figure:
    return _by_hurst(evidence, _overlay, "relative standard deviation")


def _overlay(axis: Axes, evidence: Evidence, hurst: float) -> None:
    _compare(axis, evidence.table("curves").where(H=hurst), "relative deviation")
    axis.set(yscale="log", ylim=(1e-3, 1))


def draw_difference(evidence: Evidence) -> Figure:
    """MDR over boundary elements: force by force, and the worst force of each decade with its verdict."""
    return _by_hurst(evidence, _difference, "deviation, MDR over boundary elements")


def _difference(axis: Axes, evidence: Evidence, hurst: float) -> None:
    curves = evidence.table("curves").where(H=hurst)
    marks = _marks(evidence)
    near, claimed = 10 ** (marks["tolerance of the relative deviation [dB]"] / 20), marks["claimed of rolling [dB]"]
    axis.axhspan(1 / near, near, color="#bbbbbb", linewidth=0)
    for side in (-1, 1):
        label = f"{claimed:g} dB" if side > 0 else None
        axis.axhline(10 ** (side * claimed / 20), label=label, **GUIDE)
    _with_bars(axis, curves, "mdr over bem3d relative deviation", "at each force")
    decades = evidence.table("decades").where(H=hurst, quantity="relative deviation")
    for row in (dict(zip(decades.columns, row, strict=True)) for row in zip(*decades.columns.values(), strict=True)):
        if not row["verdict"]:
            continue
        half = row["± sample"] + row["± grid"]
        middle, low, high = (
            10 ** (v / 20) for v in (row["difference"], row["difference"] - half, row["difference"] + half)
        )
        ends = row["Fbar from"], row["Fbar to"]
        axis.fill_between(ends, [low] * 2, [high] * 2, facecolor="none", edgecolor="#000000", linewidth=0.8)
        label = "worst of a decade" if ends[0] == evidence.table("decades")["Fbar from"].min() else None
        axis.plot(ends, [middle] * 2, color="#000000", linewidth=2, label=label)
        centre = np.sqrt(ends[0] * ends[1])
        axis.annotate(SIGN[row["verdict"]], (centre, 2.9), ha="center", va="top", fontsize=11, annotation_clip=True)
    axis.set(yscale="log", ylim=(0.3, 3))
    axis.set_yticks([0.3, 0.5, 0.7, 1, 1.5, 2, 3], ["0.3", "0.5", "0.7", "1", "1.5", "2", "3"])
    axis.minorticks_off()


def draw_mean(evidence: Evidence) -> Figure:
    return _by_hurst(evidence, _mean, "mean stiffness kbar = k / (E* L)")


def _mean(axis: Axes, evidence: Evidence, hurst: float) -> None:
    curves = evidence.table("curves").where(H=hurst)
    _compare(axis, curves, "mean stiffness")
    force, stiffness = curves["Fbar"], curves["bem3d mean stiffness"]
    power = force ** (1 / (1 + hurst))
    pinned = force.size // 2
    unsaturated = force <= 1
    guide = stiffness[pinned] * power / power[pinned]
    axis.plot(force[unsaturated], guide[unsaturated], label="slope 1 / (1 + H)", **GUIDE)
    axis.set_yscale("log")


def draw_exponent(evidence: Evidence) -> Figure:
    return _by_hurst(evidence, _exponent, "exponent d ln k / d ln F")


def _exponent(axis: Axes, evidence: Evidence, hurst: float) -> None:
    marks = _marks(evidence)
    published = marks["smallest published exponent"], marks["largest published exponent"]
    axis.axhspan(*published, color="#dddddd", linewidth=0)
    _compare(axis, evidence.table("curves").where(H=hurst), "exponent")
    axis.axhline(1 / (1 + hurst), label="1 / (1 + H)", **GUIDE)
    axis.set_ylim(0, 1)


def _by_hurst(evidence: Evidence, one: Callable[[Axes, Evidence, float], None], quantity: str) -> Figure:
    """A panel for each Hurst exponent on common axes, four in a row, and the legend in the next one."""
    hursts = np.unique(evidence.table("curves")["H"])
    columns = min(4, hursts.size + 1)
    rows = -(-(hursts.size + 1) // columns)
    figure, axes = panels(rows, columns, width=11.0, height=3.0 * rows, sharex=True, sharey="all")
    for axis, hurst in zip(axes, hursts, strict=False):
        one(axis, evidence, hurst)
        axis.set_title(f"H = {hurst:g}")
        axis.set_xscale("log")
        axis.tick_params(labelbottom=True)
    for axis in axes[hursts.size :]:
        axis.set_axis_off()
        axis.set_title("", loc="left")
    for row in range(rows):
        axes[row * columns].set_ylabel(quantity)
    for axis in axes[max(0, hursts.size - columns) : hursts.size]:
        axis.set_xlabel(FORCE)
    axes[hursts.size].legend(*axes[0].get_legend_handles_labels(), loc="center", fontsize=9)
    return figure


def _compare(axis: Axes, curves: Table, name: str) -> None:
    _with_bars(axis, curves, f"bem3d {name}", "boundary elements")
    force = curves["Fbar"]
    axis.plot(force, visible(curves[f"mdr {name}"]), label="MDR, L_1D = L", **MDR_LINE)
    low, high = visible(curves[f"mdr {name} low"]), visible(curves[f"mdr {name} high"])
    axis.fill_between(force, low, high, color=MDR_LINE["color"], alpha=0.25, linewidth=0)
    axis.plot(force, visible(curves[f"mdr 1.1523 L {name}"]), label="MDR, L_1D = 1.1523 L", **MDR_OTHER)


def _with_bars(axis: Axes, curves: Table, column: str, label: str) -> None:
    """Circles with their 95 % intervals, open where contacts have few cells."""
    force = curves["Fbar"]
    value, low, high = (visible(curves[f"{column}{end}"]) for end in ("", " low", " high"))
    few = curves["bem3d few cells"]
    for drawn, face, name in ((~few, BEM["color"], label), (few, "white", f"{label}, few cells")):
        if drawn.any():
            bars = [(value - low)[drawn], (high - value)[drawn]]
            style = {**BEM, "markerfacecolor": face, "markersize": 3}
            axis.errorbar(force[drawn], value[drawn], yerr=bars, capsize=1.5, elinewidth=0.8, label=name, **style)


def _marks(evidence: Evidence) -> dict[str, float]:
    marks = evidence.table("marks")
    return dict(zip(marks["mark"], marks["value"], strict=True))
