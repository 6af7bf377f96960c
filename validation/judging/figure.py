"""The chart of judgements and the table that it draws: deviations of a model along the parameter, and its seconds."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import TYPE_CHECKING

from matplotlib.axes import Axes

from validation.advice.tolerance import decibels
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Table, table_of, where_text
from validation.analysis.series import ENDS
from validation.judging.judgement import LEVEL, Conditions, JudgedSeries, series_of
from validation.judging.kinds.own import MAIN
from validation.report.drawing import drawn_on, picture_of
from validation.report.style import FORMATS, in_two_lines

if TYPE_CHECKING:
    from validation.judging.judge import Judgement

CURVES, PANELS, TITLE = 6, 60, 25
"""Curves of a panel, of more there are several; panels of a figure; characters of a line of a title."""
MARGIN, LARGEST = 0.05, 1e100
"""Of a scale beyond its points; of a number that an axis has room for."""
YOURS = " (this model)"
"""After a name that a model of the package has as well."""
DRAWN, PANEL = "drawn", "panel"
"""The table of a figure, and its column that tells panels apart."""
DEVIATIONS, TIMES, ERRORS = (Curve(DRAWN, by=("model",), **form) for form in ({"bars": True}, {}, {"style": "marks"}))
DrawnPanel = tuple[Panel, Sequence[Mapping[str, object]]]
"""A panel of one curve, or a family, and the rows of its table."""


def figure_of(judgements: Sequence["Judgement"], form: str) -> bytes:
    """A picture: of each judgement a panel a quantity and six curves, and a panel of seconds.

    Raises ValueError for another form than svg, png or pdf.
    """
    if form not in FORMATS:
        raise ValueError(f"a figure must be one of {', '.join(FORMATS)}, got {form!r}")
    missing = left_out(judgements)
    chart, table = chart_of(judgements[: len(judgements) - len(missing)])
    title = in_two_lines(f"not shown: {', '.join(missing)}") if missing else ""
    of_package = {cost.model for judgement in judgements for cost in judgement.costs[1:]}
    users = {*map(str, table.columns["model"])} - of_package
    return picture_of(replace(chart, title=title), (table,), form, users=users)


def plot(judgement: "Judgement", ax: Axes | None = None) -> Axes:
    """The first panel of `figure_of` on axes of a user, or on those of a new figure."""
    chart, table = chart_of([judgement])
    of_package = {cost.model for cost in judgement.costs[1:]}
    return drawn_on(ax, chart.panels[0], table, {*map(str, table.columns["model"])} - of_package)


def chart_of(judgements: Sequence["Judgement"]) -> tuple[Chart, Table]:
    """Deviations before seconds, and the table of both; without a panel it says so."""
    drawn = [panel for of in (_deviation_panels, _cost_panels) for judgement in judgements for panel in of(judgement)]
    if not drawn:
        return Chart("judgement", panels=(Panel("", "nothing to draw", log=""),)), Table(DRAWN, {"model": ()})
    panels = [panel.of(replace(panel.curves[0], of={PANEL: i})) for i, (panel, _) in enumerate(drawn)]
    table = table_of(DRAWN, [{PANEL: i, **row} for i, (_, rows) in enumerate(drawn) for row in rows])
    return Chart("judgement", panels=tuple(panels)), table


def left_out(judgements: Sequence["Judgement"]) -> list[str]:
    """Names of the models that a figure has no room for: the last ones."""
    counts = [len([*_deviation_panels(judgement), *_cost_panels(judgement)]) for judgement in judgements]
    return [judgement.model for i, judgement in enumerate(judgements) if i and sum(counts[: i + 1]) > PANELS]


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
        subtitle = filter(None, (where_text(common), f"{i + 1} of {count}" if count > 1 else ""))
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
            "model": where_text(dict(list(curve.where.items())[-1:])),
            first.along: x,
            **_ends(factor * number.difference, factor * number.error),
        }
        for curve in curves
        for x, number in zip(curve.at, curve.numbers, strict=True)
    ]
    name, log = f"{judgement.model}: {first.quantity}", "x" if first.at[-1] > 20 * first.at[0] > 0 else ""
    title = "\n".join(in_two_lines(words, TITLE) for words in (name, subtitle) if words)
    limits = _limits_of(judgement, first.quantity, factor, limit)
    return Panel(first.along, y, (DEVIATIONS,), title, log=log, shade=(-limit, limit), ylim=limits), rows


def _limits_of(judgement: "Judgement", quantity: str, factor: float, limit: float) -> tuple[float, float]:
    """Of the axis: one scale of a quantity of one model, so that a model that is far off leaves others readable."""
    numbers = [number for number in judgement.numbers if number.quantity == quantity]
    intervals = [_ends(factor * number.difference, factor * number.error).values() for number in numbers]
    ends = [-limit, limit, *(end for interval in intervals for end in interval if math.isfinite(end))]
    low, high = min(ends), max(ends)
    return low - MARGIN * (high - low), high + MARGIN * (high - low)


def _times_panel(judgement: "Judgement") -> DrawnPanel:
    """Seconds of a solver and of `bem3d` by the cells on a side."""
    x, name = "cells on a side", f"{judgement.model}: seconds, one thread"
    model = judgement.model + YOURS * (judgement.model == "bem3d")
    rows = [{"model": model, x: time.cells, **_ends(time.seconds)} for time in judgement.times]
    rows += [{"model": "bem3d", x: time.cells, **_ends(time.bem3d)} for time in judgement.times]
    return Panel(x, "seconds", (TIMES,), in_two_lines(name, TITLE), log="xy", ticked=True), rows


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
    return Panel(x, f"median error [{unit}]", (ERRORS,), in_two_lines(name, TITLE), log="xy", ylim=ylim), rows


def _ends(value: float, half_width: float = 0.0) -> dict[str, float]:
    """The value and its interval; NaN, which is not drawn, for an end that is too large for an axis."""
    ends = dict(zip(ENDS, (value, value - half_width, value + half_width), strict=True))
    return {name: end if abs(end) < LARGEST else math.nan for name, end in ends.items()}
