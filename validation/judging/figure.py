"""The figure of judgements, declared: how far off a model is along the number that decides, a panel a quantity."""

import math
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

import matplotlib

from validation.advice.tolerance import decibels
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Evidence, Table, table_of
from validation.judging.judgement import LEVEL, Conditions, JudgedCurve, curves_of, placed
from validation.judging.kinds.own import MAIN
from validation.report.drawing import draw
from validation.report.style import FORMATS, SETTINGS, in_two_lines, picture, plain_figure

if TYPE_CHECKING:
    from validation.judging.judge import Judgement

MOST, PANELS, TITLE = 6, 60, 25
"""Curves of a panel, of more there are several; panels of a figure; characters of a line of a title."""
MARGIN, LARGEST = 0.05, 1e100
"""Of a scale beyond its points; of a number that an axis has room for."""
YOURS = " (this model)"
"""After a name that a model of the package has as well."""
Drawn = tuple[Panel, Table]


def figure_of(judgements: Sequence["Judgement"], form: str) -> bytes:
    """A picture: of each judgement a panel a quantity and six curves, and one of seconds.

    Raises ValueError for another form than svg, png or pdf.
    """
    if form not in FORMATS:
        raise ValueError(f"a figure must be one of {', '.join(FORMATS)}, got {form!r}")
    shown = judgements[: len(judgements) - len(left_out(judgements))]
    drawn = [panel for judgement in shown for panel in _differences(judgement)]
    drawn += [panel for judgement in shown for panel in _seconds(judgement)]
    panels = tuple(panel for panel, _ in drawn) or (Panel("", "nothing to draw", log=""),)
    chart = Chart("judgement", panels=panels)
    tables = tuple(table for _, table in drawn)
    evidence = Evidence(title="", method="", numbers=(), tables=tables, conclusions=(), captions={})
    with matplotlib.rc_context(SETTINGS):
        figure = draw(chart, evidence, users=_names_of_users(judgements, tables))
    if names := left_out(judgements):
        figure.suptitle(in_two_lines(f"not shown: {', '.join(names)}"), fontsize=8)
    plain_figure(figure)
    return picture(figure, form)


def left_out(judgements: Sequence["Judgement"]) -> list[str]:
    """Models that a figure has no room for, by name: the last ones."""
    counts = [len(list(_differences(one))) + len(list(_seconds(one))) for one in judgements]
    return [one.model for i, one in enumerate(judgements) if i and sum(counts[: i + 1]) > PANELS]


def _names_of_users(judgements: Sequence["Judgement"], tables: Sequence[Table]) -> set[str]:
    """All names of curves but for those of the package's own models."""
    names = {str(name) for table in tables for name in table.columns.get("model", ())}
    return names - {cost.model for one in judgements for cost in one.costs[1:]}


def _differences(judgement: "Judgement") -> Iterator[Drawn]:
    """Curves with a number; a solver is right or wrong by numbers that no figure needs."""
    for some in curves_of(judgement.verdicts) if judgement.kind != "contact_solver" else ():
        drawn = [one for one in some if one.along and len(one.points) > 1 and not one.is_rule]
        curves = [one for one in drawn if any(math.isfinite(point.difference) for point in one.points)]
        for common, group in groupby(curves, lambda curve: list(curve.where.items())[:-1]):
            yield from _parts(judgement, dict(common), list(group))


def _parts(judgement: "Judgement", common: Conditions, curves: Sequence[JudgedCurve]) -> Iterator[Drawn]:
    """Panels of at most six curves, which have these conditions in common: their names have the last one alone."""
    count = -(-len(curves) // MOST)
    size = -(-len(curves) // count)
    for i in range(count):
        about = filter(None, (placed(common), f"{i + 1} of {count}" if count > 1 else ""))
        yield _difference(judgement, curves[size * i : size * (i + 1)], ", ".join(about))


def _seconds(judgement: "Judgement") -> Iterator[Drawn]:
    """Of a solver and of ours, on the same grids; of a model and of those of its kind, beside the error."""
    if judgement.times:
        yield _times(judgement)
    if judgement.costs:
        yield _costs(judgement)


def _difference(judgement: "Judgement", curves: Sequence[JudgedCurve], about: str) -> Drawn:
    first, tolerance = curves[0], judgement.tolerance.relative
    levels = first.points[0].unit == LEVEL
    unit, factor, within = ("dB", 1.0, decibels(tolerance)) if levels else ("%", 100.0, 100 * tolerance)
    rows = [
        {
            "model": placed(dict(list(curve.where.items())[-1:])),
            first.along: x,
            **_with(factor * point.difference, factor * point.error),
        }
        for curve in curves
        for x, point in zip(curve.at, curve.points, strict=True)
    ]
    name, log = f"{judgement.model}: {first.quantity}", "x" if first.at[-1] > 20 * first.at[0] > 0 else ""
    y, title = f"off the reference [{unit}]", "\n".join(in_two_lines(words, TITLE) for words in (name, about) if words)
    name = f"{name}, {about}"
    limits = _limits_of(judgement, first.quantity, factor, within)
    panel = Panel(first.along, y, title=title, log=log, shade=(-within, within), ylim=limits)
    return panel.of(Curve(name, by=("model",), bars=True)), table_of(name, rows)


def _limits_of(judgement: "Judgement", quantity: str, factor: float, within: float) -> tuple[float, float]:
    """One scale of a quantity of one model: another one that is far off leaves it readable."""
    shown = [
        _with(factor * one.difference, factor * one.error) for one in judgement.verdicts if one.quantity == quantity
    ]
    ends = [end for row in shown for end in row.values() if math.isfinite(end)]
    low, high = min(ends, default=0.0), max(ends, default=0.0)
    low, high = min(low, -within), max(high, within)
    return low - MARGIN * (high - low), high + MARGIN * (high - low)


def _times(judgement: "Judgement") -> Drawn:
    x, name = "cells on a side", f"{judgement.model}: seconds, one thread"
    own = judgement.model + YOURS * (judgement.model == "bem3d")
    rows = [{"model": own, x: time.cells, **_with(time.seconds)} for time in judgement.times]
    rows += [{"model": "bem3d", x: time.cells, **_with(time.bem3d)} for time in judgement.times]
    panel = Panel(x, "seconds", title=in_two_lines(name, TITLE), log="xy", ticked=True)
    return panel.of(Curve(name, by=("model",))), table_of(name, rows)


def _costs(judgement: "Judgement") -> Drawn:
    """The chart of error against seconds."""
    own, *others = judgement.costs
    costs = [own._replace(model=own.model + YOURS * any(own.model == one.model for one in others)), *others]
    unit, factor = ("dB", 1.0) if judgement.costs[0].unit == LEVEL else ("%", 100.0)
    x, name = "seconds of a call", f"{judgement.model}: {MAIN[judgement.kind]}"
    rows = [{"model": one.model, x: one.seconds, **_with(factor * one.error)} for one in costs]
    errors = [factor * one.error for one in judgement.costs if 0 < factor * one.error < LARGEST]
    # room for a tick, however near they are
    ylim = (min(errors) / 2, 2 * max(errors)) if errors else None
    panel = Panel(x, f"median error [{unit}]", title=in_two_lines(name, TITLE), log="xy", ylim=ylim)
    return panel.of(Curve(table := f"{name} and seconds", style="marks", by=("model",))), table_of(table, rows)


def _with(value: float, half: float = 0.0) -> dict[str, float]:
    """Its interval; what is too large for an axis is not drawn."""
    ends = {"value": value, "low": value - half, "high": value + half}
    return {name: end if abs(end) < LARGEST else math.nan for name, end in ends.items()}
