"""The figure of judgements: how far off a model is along the number that decides, a panel a quantity."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.judgement import LEVEL, JudgedCurve, curves_of, placed
from validation.report.style import FORMATS, SETTINGS, graded, in_two_lines, picture, plain_figure
from validation.selection.judging.own import MAIN

if TYPE_CHECKING:
    from validation.report.judged import Judgement

Drawing = Callable[[Axes, "Judgement", Sequence[JudgedCurve]], None]
MOST, PANELS = 8, 12
"""Curves of a panel, and panels."""


def figure_of(judgements: Sequence["Judgement"], form: str) -> bytes:
    """A picture. Raises ValueError for another form than svg, png or pdf."""
    if form not in FORMATS:
        raise ValueError(f"a figure must be one of {', '.join(FORMATS)}, got {form!r}")
    drawn = (
        (one, [curve for curve in curves if curve.along and len(curve.points) > 1 and not curve.is_rule])
        for one in judgements
        for curves in curves_of(one.times or one.verdicts)
    )
    panels = [(_drawing(one), one, curves) for one, curves in drawn if curves][:PANELS]
    panels += [(_costs, one, []) for one in judgements if one.costs]
    with matplotlib.rc_context(SETTINGS):
        columns = 2 if len(panels) > 1 else 1
        rows = -(-max(len(panels), 1) // columns)
        figure = Figure(figsize=(4.6 * columns, 3.2 * rows), layout="constrained")
        axes = list(figure.subplots(rows, columns, squeeze=False).flat)
        for axis, (draw, one, curves) in zip(axes, panels, strict=False):
            draw(axis, one, curves)
        for axis in axes[len(panels) :]:
            axis.set_visible(False)
    plain_figure(figure)
    return picture(figure, form)


def _drawing(judgement: "Judgement") -> Drawing:
    """A solver is right or wrong by numbers that no figure needs; its times."""
    return _times if judgement.kind == "contact_solver" else _differences


def _differences(axes: Axes, judgement: "Judgement", curves: Sequence[JudgedCurve]) -> None:
    first, tolerance = curves[0], judgement.tolerance.relative
    in_decibels = first.points[0].unit == LEVEL
    factor, within = (1.0, 20 * math.log10(1 + tolerance)) if in_decibels else (100.0, 100 * tolerance)
    for i, curve in enumerate(curves[:MOST]):
        x, apart, half = np.array(
            [(at, factor * p.difference, factor * p.error) for at, p in zip(curve.at, curve.points, strict=True)]
        ).T
        label = placed(curve.where) or None
        axes.errorbar(x, apart, half, capsize=2, label=label, **graded(i, min(len(curves), MOST)))
        if i == 0 and (x > 0).all() and x.max() > 20 * x.min():
            axes.set_xscale("log")
    axes.axhspan(-within, within, color="#009E73", alpha=0.15, linewidth=0)
    _labelled(
        axes, f"{judgement.model}: {first.quantity}", first.along, f"off the reference [{'dB' if in_decibels else '%'}]"
    )
    if any(curve.where for curve in curves):
        axes.legend(fontsize=7)


def _times(axes: Axes, judgement: "Judgement", curves: Sequence[JudgedCurve]) -> None:
    """Of a solver and of ours, on the same grids."""
    for i, (name, what) in enumerate(((judgement.model, "value"), ("bem3d", "reference"))):
        axes.loglog(curves[0].at, [getattr(p, what) for p in curves[0].points], label=name, **graded(i, 2))
    _labelled(axes, f"{judgement.model}: seconds, one thread", "cells on a side", "seconds")
    axes.legend(fontsize=7)


def _costs(axes: Axes, judgement: "Judgement", _: Sequence[JudgedCurve]) -> None:
    """The chart of error against seconds: the model, and the suite's own of its kind."""
    unit = judgement.unit_of_costs
    for i, one in enumerate(judgement.costs):
        style = {**graded(i, len(judgement.costs)), "linestyle": "none"}
        axes.loglog(one.seconds, one.error * (1 if unit == LEVEL else 100), label=one.model, **style)
    what = f"median error [{'dB' if unit == LEVEL else '%'}]"
    _labelled(axes, f"{judgement.model}: {MAIN[judgement.kind]}", "seconds of a call", what)
    axes.legend(fontsize=7)


def _labelled(axes: Axes, title: str, x: str, y: str) -> None:
    axes.set_title(in_two_lines(title, 60), loc="left")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
