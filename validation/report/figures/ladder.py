"""Figure of the calibration test: estimated beside true errors, and savings."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Table
from validation.cases.selection.model_selection import MODELS
from validation.report.style import GUIDE, MARKERS, Style, graded, panels

SMALLEST = 1e-4
"""Errors below are drawn there."""


def draw(scenes: Table, claims: Table) -> Figure:
    """True over estimated error of selected models, what selection saved, and the estimates of all cheap models."""
    figure, (truth, saving, every) = panels(1, 3, height=3.9)
    met = scenes["met"] == 1
    first = scenes["tolerance"] == scenes["tolerance"].min()
    for i, model in enumerate(MODELS):
        mine = met & (scenes["model"] == model)
        style: Style = {**graded(i, len(MODELS)), "marker": MARKERS[i], "linestyle": "none"}
        for some, face, label in ((mine & first, style["color"], model), (mine & ~first, "white", "_")):
            _dots(truth, scenes, some, "true error", {**style, "markerfacecolor": face, "label": label})
            _dots(saving, scenes, some, "saved", {**style, "markerfacecolor": face})
        _dots(every, claims, claims["model"] == model, "true error", style)
    for axis, title in ((truth, "selected models"), (every, "all cheap models")):
        ends = np.array([SMALLEST, 1.0])
        axis.plot(ends, ends, **GUIDE)
        axis.set(xlabel="estimated error", ylabel="true error", title=title)
    every.set(xlim=(None, 10.0), ylim=(None, 10.0))
    saving.axhline(1.0, **GUIDE)
    saving.set(
        xlim=(SMALLEST, 1.0), xlabel="estimated error", ylabel="fine boundary elements over the selection", title="cost"
    )
    figure.legend(*truth.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _dots(axis: Axes, table: Table, some: np.ndarray, column: str, style: Style) -> None:
    estimated, values = (np.maximum(table[name][some], SMALLEST) for name in ("estimated error", column))
    axis.loglog(estimated, values, **style)
