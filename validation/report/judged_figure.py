"""The figure of judgements: how far off a model is along the number that decides, a panel a quantity."""

import math
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.judgement import Group, JudgedPoint, groups_of, is_property
from validation.report.style import FORMATS, SETTINGS, graded, in_two_lines, picture, plain_figure

if TYPE_CHECKING:
    from validation.report.judged import Judgement

MOST, PANELS = 8, 12
"""Curves of a panel, and panels."""


def figure_of(judgements: Sequence["Judgement"], form: str) -> bytes:
    """A picture. Raises ValueError for another form than svg, png or pdf."""
    if form not in FORMATS:
        raise ValueError(f"a figure must be one of {', '.join(FORMATS)}, got {form!r}")
    panels: list[tuple[Judgement, str, list[Group]]] = []
    for one in judgements:
        for quantity, some in groupby(groups_of(one.times or one.verdicts), lambda group: group[0]):
            curves = [group for group in some if group[2] and len(group[3]) > 1 and not is_property(group)]
            if curves and len(panels) < PANELS:
                panels.append((one, quantity, curves))
    with matplotlib.rc_context(SETTINGS):
        columns = 2 if len(panels) > 1 else 1
        rows = -(-max(len(panels), 1) // columns)
        figure = Figure(figsize=(4.6 * columns, 3.2 * rows), layout="constrained")
        axes = list(figure.subplots(rows, columns, squeeze=False).flat)
        for axis, panel in zip(axes, panels, strict=False):
            _panel(axis, *panel)
        for axis in axes[len(panels) :]:
            axis.set_visible(False)
    plain_figure(figure)
    return picture(figure, form)


def _panel(axes: Axes, judgement: "Judgement", quantity: str, curves: Sequence[Group]) -> None:
    if judgement.kind == "contact_solver":  # right or wrong by numbers that no figure needs; its times
        _times(axes, judgement.model, curves[0][3])
        return
    in_decibels = curves[0][3][0].unit == "dB"
    factor = 1.0 if in_decibels else 100.0
    within = 20 * math.log10(1 + judgement.tolerance.relative) if in_decibels else 100 * judgement.tolerance.relative
    along = curves[0][2]
    for i, (_, where, _, points) in enumerate(curves[:MOST]):
        x = np.array([float(point.where[along]) for point in points])
        apart, half = (
            factor * np.array([getattr(point, name) for point in points]) for name in ("difference", "error")
        )
        label = ", ".join(f"{name} = {v:g}" if isinstance(v, float) else str(v) for name, v in where.items())
        axes.errorbar(x, apart, half, capsize=2, label=label or None, **graded(i, min(len(curves), MOST)))
        if i == 0 and (x > 0).all() and x.max() > 20 * x.min():
            axes.set_xscale("log")
    axes.axhspan(-within, within, color="#009E73", alpha=0.15, linewidth=0)
    axes.set_title(in_two_lines(f"{judgement.model}: {quantity}", 60), loc="left")
    axes.set_xlabel(along)
    axes.set_ylabel(f"off the reference [{'dB' if in_decibels else '%'}]")
    if any(where for _, where, _, _ in curves):
        axes.legend(fontsize=7)


def _times(axes: Axes, model: str, points: Sequence[JudgedPoint]) -> None:
    """Of a solver and of ours, on the same grids."""
    cells = [float(point.where["cells"]) for point in points]
    for i, (name, what) in enumerate(((model, "value"), ("bem3d", "reference"))):
        axes.loglog(cells, [getattr(point, what) for point in points], label=name, **graded(i, 2))
    axes.set_title(in_two_lines(f"{model}: seconds, one thread", 60), loc="left")
    axes.set_xlabel("cells on a side")
    axes.set_ylabel("seconds")
    axes.legend(fontsize=7)
