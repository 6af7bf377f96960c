"""Figure of the ladder: claims beside truth, and savings."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.cases.selection.model_selection import RUNGS
from validation.report.style import GUIDE, MARKERS, Style, graded, panels

SMALLEST = 1e-4
"""Errors below are drawn there."""


def draw(evidence: Evidence) -> Figure:
    """True against claimed error of climbs, what they saved, and the claims of all cheap rungs."""
    scenes, claims = evidence.table("scenes"), evidence.table("claims")
    figure, (truth, saving, every) = panels(1, 3, height=3.9)
    met = scenes["met"] == 1
    first = scenes["tolerance"] == scenes["tolerance"].min()
    for i, rung in enumerate(RUNGS):
        mine = met & (scenes["rung"] == rung)
        style: Style = {**graded(i, len(RUNGS)), "marker": MARKERS[i], "linestyle": "none"}
        for some, face, label in ((mine & first, style["color"], rung), (mine & ~first, "white", "_")):
            _dots(truth, scenes, some, "true error", {**style, "markerfacecolor": face, "label": label})
            _dots(saving, scenes, some, "saved", {**style, "markerfacecolor": face})
        _dots(every, claims, claims["rung"] == rung, "true error", style)
    for axis, title in ((truth, "climbs"), (every, "all cheap rungs")):
        ends = np.array([SMALLEST, 1.0])
        axis.plot(ends, ends, **GUIDE)
        axis.set(xlabel="claimed error", ylabel="true error", title=title)
    every.set(xlim=(None, 10.0), ylim=(None, 10.0))
    saving.axhline(1.0, **GUIDE)
    saving.set(
        xlim=(SMALLEST, 1.0), xlabel="claimed error", ylabel="fine boundary elements over the climb", title="cost"
    )
    figure.legend(*truth.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _dots(axis: Axes, table: Table, some: np.ndarray, column: str, style: Style) -> None:
    claimed, values = (np.maximum(table[name][some], SMALLEST) for name in ("claimed error", column))
    axis.loglog(claimed, values, **style)
