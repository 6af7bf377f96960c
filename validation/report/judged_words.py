"""What a person reads of a judgement: strips by range, the worst points, and a paragraph for a paper."""

import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib import metadata
from itertools import groupby
from typing import TYPE_CHECKING

from validation.analysis.judgement import (
    AGREE,
    DIFFER,
    FAILED,
    REFUSED,
    UNDECIDED,
    VERDICTS,
    JudgedCurve,
    JudgedPoint,
    curves_of,
    in_unit,
    placed,
    shared,
    worst,
)
from validation.selection.judging.own import MAIN
from validation.selection.judging.sweeps import SWEPT

if TYPE_CHECKING:
    from validation.report.judged import Judgement

SIGN = {AGREE: "=", DIFFER: "#", UNDECIDED: "?", REFUSED: "r", FAILED: "x"}
WORD = {AGREE: "yes", DIFFER: "no", UNDECIDED: "open", REFUSED: "refused", FAILED: "failed"}
COLUMNS, CURVES = 110, 24
"""Of a line, and groups of a quantity that are shown."""


def summary_lines(judgement: "Judgement") -> Iterator[str]:
    """Of one model."""
    points, tolerance = judgement.verdicts, str(judgement.tolerance)
    count = Counter(point.verdict for point in points)
    counted = ", ".join(f"{count[verdict]} {verdict}" for verdict in VERDICTS if count[verdict]) or "none"
    what, took = judgement.kind.replace("_", " "), f"{len(points)} points in {judgement.seconds:.1f} s"
    yield f"{judgement.model}: {what}, tolerance {tolerance}, {took}: {counted}"
    yield f"strips: {', '.join(f'{SIGN[verdict]} {WORD[verdict]}' for verdict in VERDICTS)}"
    for curves in curves_of(points):
        along = curves[0].along if len(curves[0].points) > 1 else ""
        yield f"\n{curves[0].quantity}{f', along {along}' if along else ''}"
        yield from (_strip(curve) for curve in curves[:CURVES])
        if len(curves) > CURVES:
            yield f"  and {len(curves) - CURVES} more"
    scenes = [point for point in points if point.quantity not in SWEPT]
    if found := worst(scenes):
        yield f"\nThe worst{f' {len(found)}' if len(found) > 1 else ''}:"
        yield from (f"  {point.quantity}, {point.place or 'everywhere'}: {point.shown}" for point in found)
        if found[0].verdict == DIFFER and (common := shared(found, scenes)):
            yield f"  They share: {common}."
    yield from _breaks(points)
    if judgement.costs:
        yield f"\nMedian error of the {MAIN[judgement.kind]}, and seconds of the call that took longest:"
        unit = judgement.unit_of_costs
        yield from (f"  {one.model:32s}{in_unit(one.error, unit):>10s}{one.seconds:10.2g} s" for one in judgement.costs)
    yield "\nFor a paper:"
    said = paragraph(judgement.model, tolerance, points)
    yield from textwrap.wrap(said, COLUMNS, initial_indent="  ", subsequent_indent="  ")


def _breaks(points: Sequence[JudgedPoint]) -> Iterator[str]:
    """Rules that it does not follow, and ends at which it is no closed form, and whether it warned of that."""
    found = [line for curves in curves_of(points) for curve in curves if curve.is_rule for line in _broken(curve)]
    asked = [curves[0].quantity for curves in curves_of(points) if curves[0].quantity in SWEPT]
    if found or asked:
        yield "\nWhere it breaks:"
        yield from found or [f"  nowhere, as far as it was led: {', '.join(asked)}"]


def _broken(curve: JudgedCurve) -> Iterator[str]:
    for some in (some for some in curve.enough if some.verdict in (DIFFER, REFUSED, FAILED)):
        mine = [
            p for p, x in zip(curve.points, curve.at, strict=True) if some.start <= x <= some.stop or len(curve.at) == 1
        ]
        where = f"{curve.along} = {_range(some.start, some.stop)}" if curve.along else placed(curve.where)
        warned = next(
            (f", {p.reason}" for p in mine if p.reason), ", without a warning" if curve.quantity in SWEPT else ""
        )
        shown = max(mine, key=lambda p: abs(p.difference)).shown
        yield f"  {curve.quantity}, {where}: {shown}{warned if some.verdict == DIFFER else ''}"


def _strip(curve: JudgedCurve) -> str:
    """A sign a point, then the ranges in words."""
    strip, first = "".join(SIGN[point.verdict] for point in curve.points), curve.points[0]
    if len(curve.points) == 1:
        return f"  {first.place or 'all':32s} {strip}  {WORD[first.verdict]}: {first.shown}"
    ranges = {v: ", ".join(_range(r.start, r.stop) for r in curve.enough if r.verdict == v) for v in VERDICTS}
    said = "; ".join(f"{WORD[verdict]} {some}" for verdict, some in ranges.items() if some)
    return f"  {placed(curve.where) or 'all':32s} {strip}  {said}"


def _range(start: float, stop: float) -> str:
    return f"{start:.3g} to {stop:.3g}" if stop > start else f"{start:.3g}"


def paragraph(model: str, tolerance: str, points: Sequence[JudgedPoint]) -> str:
    """Sentences that could stand in a paper."""
    version = metadata.version("mdr-validation")
    said = [f"The model {model!r} was compared with the references of mdr-validation {version} (95 % intervals)."]
    for curves in curves_of(points):
        ranges = curves[0].along and len(curves) <= CURVES // 2 and all(len(curve.points) > 1 for curve in curves)
        if ranges and not curves[0].is_rule:
            said.append(_everywhere(tolerance, curves))
    count = Counter(point.verdict for point in points)
    if known := count[AGREE] + count[DIFFER] + count[UNDECIDED]:
        said.append(f"Of {known} points {count[AGREE]} agree, {count[DIFFER]} differ and the others are open.")
    if (most := worst([point for point in points if point.quantity not in SWEPT], 1)) and most[0].verdict == DIFFER:
        apart = in_unit(most[0].difference, most[0].unit, "+")
        said.append(f"The largest difference, of its {most[0].quantity}, is {apart} at {most[0].place}.")
    if lost := len(points) - known:
        said.append(f"It has no value at {lost} of {len(points)} points.")
    return " ".join(said)


def _everywhere(tolerance: str, curves: Sequence[JudgedCurve]) -> str:
    """Where a quantity agrees in all of its curves."""
    first, pairs = curves[0], [pair for curve in curves for pair in zip(curve.at, curve.points, strict=True)]
    wrong = {x for x, point in pairs if point.verdict != AGREE}
    runs = [(right, list(run)) for right, run in groupby(sorted({x for x, _ in pairs}), lambda x: x not in wrong)]
    ranges = [_range(run[0], run[-1]) for right, run in runs if right]
    every = f" at every {', '.join(first.where)}" if first.where and len(curves) > 1 else ""
    if not ranges:
        return f"There is no {first.along} for which its {first.quantity} is within {tolerance}{every} for certain."
    return f"Its {first.quantity} is within {tolerance} for {first.along} = {' and '.join(ranges)}{every}."
