"""Figure of bandwidth and roll-off."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import GUIDE, Style, graded, panels, visible

LINES = ("-", "--", "-.", (0, (6, 1, 1, 1, 1, 1)))
"""No dots, which are the fit."""


def draw(evidence: Evidence) -> Figure:
    """Mean stiffness and relative deviation, MDR over boundary elements, and the relative deviation itself."""
    curves = evidence.table("curves")
    figure, axes = panels(1, 3, width=11.0, height=4.2, sharex=True)
    mean, over, deviation = axes
    kinds = list(dict.fromkeys(zip(curves["q_max / q_min"], curves["q_r L / 2π"], strict=True)))
    for i, (bandwidth, roll_off) in enumerate(kinds):
        mine = curves.where(**{"q_max / q_min": bandwidth, "q_r L / 2π": roll_off})
        style = graded(i, len(kinds)) | {"linestyle": LINES[i % len(LINES)]}
        label = f"q_max / q_min = {bandwidth:g}" + (f", q_r L / 2π = {roll_off:g}" if roll_off > 1 else "")
        for axis, quantity in ((mean, "mean stiffness"), (over, "relative deviation")):
            _with_bars(axis, mine, f"mdr over bem3d {quantity}", {**style, "label": label}, shift=1.04**i)
        if i in (0, len(kinds) - 1):
            fit = mine["fit over bem3d mean stiffness"]
            mean.plot(mine["Fbar"], fit, **{**GUIDE, "color": style["color"]}, label=f"fit, {label}")
        _with_bars(deviation, mine, "bem3d relative deviation", {**style, "linestyle": "none"}, shift=1.04**i)
        line = {**style, "marker": "none"}
        deviation.plot(mine["Fbar"], visible(mine["mdr relative deviation"]), **line)
    titles = ("mean stiffness, over bem3d", "relative deviation, MDR over bem3d", "relative deviation")
    for axis, title in zip(axes, titles, strict=True):
        axis.set(xscale="log", xlabel="force Fbar = F / (E* h L)", title=title)
    mean.set(ylim=(0.75, 1.25))
    over.set(yscale="log", ylim=(0.3, 3))
    over.set_yticks([0.3, 0.5, 0.7, 1, 1.5, 2, 3], ["0.3", "0.5", "0.7", "1", "1.5", "2", "3"])
    over.minorticks_off()
    deviation.set(yscale="log", ylim=(5e-4, 1))
    for axis in (mean, over):
        axis.axhline(1.0, color="#000000", linewidth=0.8)
    figure.legend(*mean.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _with_bars(axis: Axes, mine: Table, column: str, style: Style, shift: float) -> None:
    """Moved along the force a little, so that intervals stand side by side."""
    value, low, high = (visible(mine[f"{column}{end}"]) for end in ("", " low", " high"))
    axis.errorbar(shift * mine["Fbar"], value, yerr=[value - low, high - value], capsize=1.5, elinewidth=0.7, **style)
