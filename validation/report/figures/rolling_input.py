"""Figures of the input spectrum of springs for rolling."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.input_spectrum_numbers import NAMES
from validation.report.style import graded, panels, tick, visible

STYLES = {
    name: {**graded(i, 3), "linestyle": dash}
    for i, (name, dash) in enumerate(zip(NAMES.values(), ("-", "--", "-."), strict=True))
}
LOWEST = -60.0
DECIBELS = (-11.0, 11.0)
"""Limits of the axis."""


def draw(evidence: Evidence) -> Figure:
    """Linear theory: error of each input, one panel a spectrum."""
    bands = evidence.table("bands")
    names = list(dict.fromkeys(bands.columns["spectrum"]))
    figure, axes = panels(2, 3, height=5.6, sharex=True, sharey="all")
    for axis, name in zip(axes, names, strict=True):
        mine = bands.where(spectrum=name)
        _shade_tolerance(axis)
        for label in NAMES.values():
            axis.plot(mine["q a"], visible(mine[f"{label} [dB]"], above=LOWEST), label=label, **STYLES[label])
        _format_axis(axis, str(name))
    _label_axes(figure, axes, 3, "(14.12) over linear theory in 3D [dB]")
    return figure


def draw_springs(evidence: Evidence) -> Figure:
    """Springs over boundary elements: a row a height, a column a spectrum."""
    rolled = evidence.table("rolled")
    names, heights = list(dict.fromkeys(rolled.columns["spectrum"])), np.unique(rolled["h/d"])
    tall = 0.8 + 2.5 * heights.size
    figure, axes = panels(heights.size, len(names), width=10.5, height=tall, sharex=True, sharey="all")
    for axis, (height, name) in zip(axes, [(h, n) for h in heights for n in names], strict=True):
        mine = rolled.where(**{"spectrum": name, "h/d": height})
        _shade_tolerance(axis)
        for label in NAMES.values():
            level, bars = visible(mine[f"{label} [dB]"], above=LOWEST), mine[f"{label} ± [dB]"]
            axis.errorbar(mine["q a"], level, yerr=bars, capsize=1.5, label=label, **STYLES[label])
        _format_axis(axis, f"{name}, h/d = {height:g}")
    _label_axes(figure, axes, len(names), "springs over boundary\nelements [dB]")
    return figure


def draw_punch(evidence: Evidence) -> Figure:
    punches = evidence.table("punches")
    figure, (axis,) = panels(1, 1, width=5.4, height=3.6)
    axis.axhspan(0.9, 1.1, color="#000000", alpha=0.07, linewidth=0)
    for i, label in enumerate(NAMES.values()):
        mine = punches.where(input=label)
        value = mine["mdr over bem3d"]
        bars = [value - mine["low"], mine["high"] - value]
        axis.errorbar(mine["Fbar"] * (0.95 + 0.05 * i), value, yerr=bars, capsize=2, label=label, **STYLES[label])
    axis.set(xscale="log", xlabel="force Fbar = F / (E* h L)", ylabel="mean stiffness, MDR over boundary elements")
    tick(axis, np.unique(punches["Fbar"]))
    axis.legend()
    return figure


def _shade_tolerance(axis: Axes) -> None:
    axis.axhspan(-3, 3, color="#000000", alpha=0.07, linewidth=0)
    axis.axhline(0, color="#000000", linewidth=0.8)


def _format_axis(axis: Axes, title: str) -> None:
    axis.set(xscale="log", ylim=DECIBELS)
    axis.set_title(title)
    tick(axis, (0.5, 1, 2, 5, 10, 20))


def _label_axes(figure: Figure, axes: list[Axes], columns: int, label: str) -> None:
    for axis in axes[::columns]:
        axis.set_ylabel(label)
    for axis in axes[-columns:]:
        axis.set_xlabel("q a")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
