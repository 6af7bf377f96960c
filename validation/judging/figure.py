"""The chart of judgements: the deviation of a model along the parameter, a panel a quantity, and its seconds."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import TYPE_CHECKING

from validation.advice.tolerance import decibels
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Table, table_of
from validation.analysis.series import ENDS
from validation.judging.judgement import LEVEL, Conditions, JudgedSeries, conditions_text, series_of
from validation.judging.kinds.own import MAIN
from validation.report.drawing import DrawnPanel, picture_of
from validation.report.style import FORMATS, in_two_lines

if TYPE_CHECKING:
    from validation.judging.judge import Judgement

CURVES, PANELS, TITLE = 6, 60, 25
"""Curves of a panel, of more there are several; panels of a figure; characters of a line of a title."""
MARGIN, LARGEST = 0.05, 1e100
"""Of a scale beyond its points; of a number that an axis has room for."""
YOURS = " (this model)"
"""After a name that a model of the package has as well."""


def figure_of(judgements: Sequence["Judgement"], form: str) -> bytes:
    """A picture: of each judgement a panel a quantity and six curves, and a panel of seconds.

    Raises ValueError for another form than svg, png or pdf.
    """
    if form not in FORMATS:
        raise ValueError(f"a figure must be one of {', '.join(FORMATS)}, got {form!r}")
    shown = judgements[: len(judgements) - len(left_out(judgements))]
    drawn = [panel for judgement in shown for panel in _deviation_panels(judgement)]
    drawn += [panel for judgement in shown for panel in _cost_panels(judgement)]
    chart, tables = chart_of(drawn)
    names = left_out(judgements)
    title = in_two_lines(f"not shown: {', '.join(names)}") if names else ""
    return picture_of(replace(chart, title=title), tables, form, users=_names_of_users(judgements, tables))


def chart_of(drawn: Sequence[DrawnPanel]) -> tuple[Chart, tuple[Table, ...]]:
    """The chart, and the tables that it draws; without a panel it says so."""
    panels = tuple(panel for panel, _ in drawn) or (Panel("", "nothing to draw", log=""),)
    return Chart("judgement", panels=panels), tuple(table for _, table in drawn)


def left_out(judgements: Sequence["Judgement"]) -> list[str]:
    """Names of the models that a figure has no room for: the last ones."""
    counts = [len([*_deviation_panels(judgement), *_cost_panels(judgement)]) for judgement in judgements]
    return [judgement.model for i, judgement in enumerate(judgements) if i and sum(counts[: i + 1]) > PANELS]


def _names_of_users(judgements: Sequence["Judgement"], tables: Sequence[Table]) -> set[str]:
    """All names of curves but for those of the package's own models."""
    names = {str(name) for table in tables for name in table.columns.get("model", ())}
    return names - {cost.model for judgement in judgements for cost in judgement.costs[1:]}


def _deviation_panels(judgement: "Judgement") -> Iterator[DrawnPanel]:
    """Of series with a number, but closed forms; none of a solver, which is right or wrong."""
    for series in series_of(judgement.numbers) if judgement.kind != "contact_solver" else ():
        drawn = [part for part in series if part.along and len(part.numbers) > 1 and not part.is_closed_form]
        curves = [part for part in drawn if part.has_a_number]
        for common, group in groupby(curves, lambda curve: list(curve.where.items())[:-1]):
            yield from _panels_of_curves(judgement, dict(common), list(group))


def _panels_of_curves(
    judgement: "Judgement", common: Conditions, curves: Sequence[JudgedSeries]
) -> Iterator[DrawnPanel]:
    """Panels of at most six curves, which have these conditions in common: their names have the last one alone."""
    count = -(-len(curves) // CURVES)
    size = -(-len(curves) // count)
    for i in range(count):
        subtitle = filter(None, (conditions_text(common), f"{i + 1} of {count}" if count > 1 else ""))
        yield _deviation_panel(judgement, curves[size * i : size * (i + 1)], ", ".join(subtitle))


def _cost_panels(judgement: "Judgement") -> Iterator[DrawnPanel]:
    """Of a solver and of `bem3d`, on the same grids; of a model and of those of its kind, with the error."""
    if judgement.times:
        yield _times_panel(judgement)
    if judgement.costs:
        yield _errors_panel(judgement)


def _deviation_panel(judgement: "Judgement", curves: Sequence[JudgedSeries], subtitle: str) -> DrawnPanel:
    """The deviation with its 95 % interval along the parameter, the tolerance as a shade."""
    first, tolerance = curves[0], judgement.tolerance.relative
    is_level = first.numbers[0].unit == LEVEL
    factor, limit = (1.0, decibels(tolerance)) if is_level else (100.0, 100 * tolerance)
    y = "deviation from the reference [dB]" if is_level else "relative deviation from the reference [%]"
    rows = [
        {
            "model": conditions_text(dict(list(curve.where.items())[-1:])),
            first.along: x,
            **_ends(factor * number.difference, factor * number.error),
        }
        for curve in curves
        for x, number in zip(curve.at, curve.numbers, strict=True)
    ]
    name, log = f"{judgement.model}: {first.quantity}", "x" if first.at[-1] > 20 * first.at[0] > 0 else ""
    title = "\n".join(in_two_lines(words, TITLE) for words in (name, subtitle) if words)
    table = f"{name}, {subtitle}"
    limits = _limits_of(judgement, first.quantity, factor, limit)
    panel = Panel(first.along, y, title=title, log=log, shade=(-limit, limit), ylim=limits)
    return panel.of(Curve(table, by=("model",), bars=True)), table_of(table, rows)


def _limits_of(judgement: "Judgement", quantity: str, factor: float, limit: float) -> tuple[float, float]:
    """Of the axis: one scale of a quantity of one model, so that a model that is far off leaves others readable."""
    intervals = [
        _ends(factor * number.difference, factor * number.error)
        for number in judgement.numbers
        if number.quantity == quantity
    ]
    ends = [end for interval in intervals for end in interval.values() if math.isfinite(end)]
    low, high = min(-limit, *ends, limit), max(-limit, *ends, limit)
    return low - MARGIN * (high - low), high + MARGIN * (high - low)


def _times_panel(judgement: "Judgement") -> DrawnPanel:
    """Seconds of a solver and of `bem3d` by the cells on a side."""
    x, name = "cells on a side", f"{judgement.model}: seconds, one thread"
    model = judgement.model + YOURS * (judgement.model == "bem3d")
    rows = [{"model": model, x: time.cells, **_ends(time.seconds)} for time in judgement.times]
    rows += [{"model": "bem3d", x: time.cells, **_ends(time.bem3d)} for time in judgement.times]
    panel = Panel(x, "seconds", title=in_two_lines(name, TITLE), log="xy", ticked=True)
    return panel.of(Curve(name, by=("model",))), table_of(name, rows)


def _errors_panel(judgement: "Judgement") -> DrawnPanel:
    """The chart of error against seconds of a call."""
    cost, *of_suite = judgement.costs
    is_named_twice = any(cost.model == other.model for other in of_suite)
    costs = [cost._replace(model=cost.model + YOURS * is_named_twice), *of_suite]
    unit, factor = ("dB", 1.0) if cost.unit == LEVEL else ("%", 100.0)
    x, name = "seconds of a call", f"{judgement.model}: {MAIN[judgement.kind]}"
    rows = [{"model": cost.model, x: cost.seconds, **_ends(factor * cost.error)} for cost in costs]
    errors = [factor * cost.error for cost in costs if 0 < factor * cost.error < LARGEST]
    # room for a tick, however near they are
    ylim = (min(errors) / 2, 2 * max(errors)) if errors else None
    panel = Panel(x, f"median error [{unit}]", title=in_two_lines(name, TITLE), log="xy", ylim=ylim)
    return panel.of(Curve(table := f"{name} and seconds", style="marks", by=("model",))), table_of(table, rows)


def _ends(value: float, half_width: float = 0.0) -> dict[str, float]:
    """The value and its interval; NaN, which is not drawn, for an end that is too large for an axis."""
    ends = dict(zip(ENDS, (value, value - half_width, value + half_width), strict=True))
    return {name: end if abs(end) < LARGEST else math.nan for name, end in ends.items()}
