"""The figure of judgements, declared: how far off a model is along the number that decides, a panel a quantity."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import matplotlib

from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Evidence, Table, table_of
from validation.analysis.judgement import LEVEL, JudgedCurve, curves_of, placed
from validation.report.drawing import draw
from validation.report.style import FORMATS, SETTINGS, in_two_lines, picture, plain_figure
from validation.selection.judging.own import MAIN
from validation.selection.tolerance import decibels

if TYPE_CHECKING:
    from validation.report.judged import Judgement

MOST, PANELS, TITLE = 6, 12, 30
"""Curves of a panel; panels; characters of a line of a title."""
Drawn = tuple[Panel, Table]


def figure_of(judgements: Sequence["Judgement"], form: str) -> bytes:
    """A picture. Raises ValueError for another form than svg, png or pdf."""
    if form not in FORMATS:
        raise ValueError(f"a figure must be one of {', '.join(FORMATS)}, got {form!r}")
    drawn = [one for judgement in judgements for one in _differences(judgement)][:PANELS]
    drawn += [_times(one) for one in judgements if one.times] + [_costs(one) for one in judgements if one.costs]
    panels = tuple(panel for panel, _ in drawn) or (Panel("", "nothing to draw", log=""),)
    chart = Chart("judgement", panels=panels)
    tables = tuple(table for _, table in drawn)
    evidence = Evidence(title="", method="", numbers=(), tables=tables, conclusions=(), captions={})
    with matplotlib.rc_context(SETTINGS):
        figure = draw(chart, evidence)
    plain_figure(figure)
    return picture(figure, form)


def _differences(judgement: "Judgement") -> Iterator[Drawn]:
    """Curves with a number; a solver is right or wrong by numbers that no figure needs."""
    for some in curves_of(judgement.verdicts) if judgement.kind != "contact_solver" else ():
        drawn = [one for one in some if one.along and len(one.points) > 1 and not one.is_rule]
        if curves := [one for one in drawn if any(math.isfinite(point.difference) for point in one.points)]:
            yield _difference(judgement, curves[:MOST])


def _difference(judgement: "Judgement", curves: Sequence[JudgedCurve]) -> Drawn:
    first, tolerance = curves[0], judgement.tolerance.relative
    levels = first.points[0].unit == LEVEL
    unit, factor, within = ("dB", 1.0, decibels(tolerance)) if levels else ("%", 100.0, 100 * tolerance)
    rows = [
        {"model": placed(curve.where), first.along: x, **_with(factor * point.difference, factor * point.error)}
        for curve in curves
        for x, point in zip(curve.at, curve.points, strict=True)
    ]
    name, log = f"{judgement.model}: {first.quantity}", "x" if first.at[-1] > 20 * first.at[0] > 0 else ""
    y, title = f"off the reference [{unit}]", in_two_lines(name, TITLE)
    panel = Panel(first.along, y, title=title, log=log, shade=(-within, within))
    return panel.of(Curve(name, by=("model",), bars=True)), table_of(name, rows)


def _times(judgement: "Judgement") -> Drawn:
    """Of a solver and of ours, on the same grids."""
    x, name = "cells on a side", f"{judgement.model}: seconds, one thread"
    rows = [{"model": judgement.model, x: time.cells, **_with(time.seconds)} for time in judgement.times]
    rows += [{"model": "bem3d", x: time.cells, **_with(time.bem3d)} for time in judgement.times]
    panel = Panel(x, "seconds", title=in_two_lines(name, TITLE), log="xy", ticked=True)
    return panel.of(Curve(name, by=("model",))), table_of(name, rows)


def _costs(judgement: "Judgement") -> Drawn:
    """The chart of error against seconds: the model, and the suite's own of its kind."""
    unit, factor = ("dB", 1.0) if judgement.costs[0].unit == LEVEL else ("%", 100.0)
    x, name = "seconds of a call", f"{judgement.model}: {MAIN[judgement.kind]}"
    rows = [{"model": one.model, x: one.seconds, **_with(factor * one.error)} for one in judgement.costs]
    errors = [factor * one.error for one in judgement.costs if one.error > 0]
    # room for a tick, however near they are
    ylim = (min(errors) / 2, 2 * max(errors)) if errors else None
    panel = Panel(x, f"median error [{unit}]", title=in_two_lines(name, TITLE), log="xy", ylim=ylim)
    return panel.of(Curve(table := f"{name} and seconds", style="marks", by=("model",))), table_of(table, rows)


def _with(value: float, half: float = 0.0) -> dict[str, float]:
    """Its interval."""
    return {"value": value, "low": value - half, "high": value + half}
