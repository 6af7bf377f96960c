"""Figure of what MDR does not model."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import GUIDE, graded, panels, visible


def draw(evidence: Evidence) -> Figure:
    """Contact fraction, mean gap, stiffness of the interface over force, relative deviation; all roll-offs in each."""
    curves = evidence.table("curves")
    figure, axes = panels(2, 2, height=6.4, sharex=True)
    area, gap, interface, deviation = axes
    _draw(area, curves, "contact fraction")
    for i, roll_off in enumerate(roll_offs := np.unique(curves["q_r L / 2π"])):
        mine = curves.where(**{"q_r L / 2π": roll_off})
        style = {**GUIDE, "color": graded(i, roll_offs.size)["color"]}
        area.plot(mine["Fbar"], mine["Persson contact fraction"], label="_" if i else "Persson", **style)
    area.set(yscale="log", ylabel="contact fraction")
    _draw(gap, curves, "mean gap")
    gap.set(yscale="log", ylim=(0.02, None), ylabel="mean gap / h")
    _draw(interface, curves, "interface", over_force=True)
    interface.set(yscale="log", ylabel="stiffness of the interface over force\nk_i / (E* L) / Fbar")
    interface.set_yticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    interface.minorticks_off()
    _draw(deviation, curves, "relative deviation")
    deviation.set(yscale="log", ylabel="relative standard deviation of k")
    titles = ("contact fraction", "mean gap", "interface: constant if k ~ F", "fluctuation of the punch")
    for axis, title in zip(axes, titles, strict=True):
        axis.set_title(title)
    for axis in (interface, deviation):
        axis.set_xlabel("force Fbar = F / (E* h L)")
    area.set_xscale("log")
    figure.legend(*area.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


def _draw(axis: Axes, curves: Table, name: str, over_force: bool = False) -> None:
    roll_offs = np.unique(curves["q_r L / 2π"])
    for i, roll_off in enumerate(roll_offs):
        mine = curves.where(**{"q_r L / 2π": roll_off})
        style = {**graded(i, roll_offs.size), "linestyle": "none"}
        force, few = mine["Fbar"], mine["bem3d few cells"]
        unit = force if over_force else np.ones(force.size)
        value, low, high = (mine[f"bem3d {name}{end}"] / unit for end in ("", " low", " high"))
        named = f"q_r L / 2π = {roll_off:g}"
        for drawn, face, label in ((~few, style["color"], f"boundary elements, {named}"), (few, "white", "_")):
            bars = [(value - low)[drawn], (high - value)[drawn]]
            look = {**style, "markerfacecolor": face}
            axis.errorbar(force[drawn], value[drawn], yerr=bars, capsize=2, label=label, **look)
        value, low, high = (visible(mine[f"mdr {name}{end}"], above=1e-6) / unit for end in ("", " low", " high"))
        line = {"color": style["color"], "linestyle": ("-", "--", "-.")[i % 3], "linewidth": 1.6}
        axis.plot(force, value, label=f"MDR, {named}", **line)
        axis.fill_between(force, low, high, color=style["color"], alpha=0.2, linewidth=0)
