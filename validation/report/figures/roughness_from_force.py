"""Figure of the roughness that is found from the force."""

import math

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.roughness_from_force import FILTERS
from validation.report.style import GUIDE, graded, panels, tick


def draw(evidence: Evidence) -> Figure:
    """Found over true roughness, one panel a height."""
    table = evidence.table("roughness")
    heights = np.unique(table["h/d"])
    figure, axes = panels(1, heights.size, width=3.2 * heights.size, height=3.6, sharey="all")
    for axis, height in zip(axes, heights, strict=True):
        axis.axhspan(-3, 3, color="#000000", alpha=0.07, linewidth=0)
        for i, name in enumerate(FILTERS):
            mine = table.where(**{"h/d": height, "filter": name})
            y, half = mine["found over true [dB]"], np.minimum(mine["± [dB]"], 20.0)
            axis.errorbar(mine["q a"] * 1.03 ** (i - 1), y, yerr=half, capsize=2, label=name, **graded(i, len(FILTERS)))
        for zero in np.arange(1, mine["q a"].max() / math.pi + 0.5):
            axis.axvline(zero * math.pi, **GUIDE)
        slope = mine["h' a/d"][0]
        axis.set(xscale="log", xlabel="q a", ylim=(-16, 10), title=f"h/d = {height:g}, h' a/d = {slope:.2g}")
        tick(axis, [q for q in (1, 2, 5, 10, 20) if 0.8 * mine["q a"].min() <= q <= 1.2 * mine["q a"].max()])
    axes[0].set_ylabel("roughness found over true [dB]")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
