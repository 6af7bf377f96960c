"""What a person reads of a judgement: strips by range, the worst points, and a paragraph for a paper."""

import math
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
    LEVEL,
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
from validation.selection.tolerance import Tolerance, decibels

if TYPE_CHECKING:
    from validation.report.judged import Judgement

SIGN = {AGREE: "=", DIFFER: "#", UNDECIDED: "?", REFUSED: "r", FAILED: "x"}
WORD = {AGREE: "yes", DIFFER: "no", UNDECIDED: "open", REFUSED: "refused", FAILED: "failed"}
COLUMNS, CURVES, LISTED = 110, 24, 6
"""Of a line; groups of a quantity that are shown; values of a condition that a paper lists."""
REFERENCES = {"contact_law": "springs (MDR) under a wheel with a mass"}
"""Of a kind whose references are not boundary elements."""


def summary_lines(judgement: "Judgement") -> Iterator[str]:
    """Of one model."""
    points = judgement.verdicts
    count = Counter(point.verdict for point in points)
    counted = ", ".join(f"{count[verdict]} {verdict}" for verdict in VERDICTS if count[verdict]) or "none"
    what, took = judgement.kind.replace("_", " "), f"{len(points)} points in {judgement.seconds:.1f} s"
    yield f"{judgement.model}: {what}, tolerance {judgement.tolerance}, {took}: {counted}"
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
        yield from (f"  {point.quantity}, {placed(point.where) or 'everywhere'}: {point.shown}" for point in found)
        if found[0].verdict == DIFFER and (common := shared(found, scenes)):
            yield f"  They share: {common}."
    yield from _breaks(points)
    if judgement.costs:
        yield f"\nMedian error of the {MAIN[judgement.kind]}, and seconds of the call that took longest:"
        yield from (f"  {c.model:32s}{in_unit(c.error, c.unit):>10s}{c.seconds:10.2g} s" for c in judgement.costs)
    yield "\nFor a paper:"
    yield from textwrap.wrap(paragraph(judgement), COLUMNS, initial_indent="  ", subsequent_indent="  ")


def _strip(curve: JudgedCurve) -> str:
    """A sign a point, then the ranges in words."""
    strip, first = "".join(SIGN[point.verdict] for point in curve.points), curve.points[0]
    if len(curve.points) == 1:
        return f"  {placed(first.where) or 'all':32s} {strip}  {WORD[first.verdict]}: {first.shown}"
    ranges = {v: ", ".join(_range(r.start, r.stop) for r in curve.enough if r.verdict == v) for v in VERDICTS}
    said = "; ".join(f"{WORD[verdict]} {some}" for verdict, some in ranges.items() if some)
    return f"  {placed(curve.where) or 'all':32s} {strip}  {said}"


def _range(start: float, stop: float) -> str:
    return f"{start:.3g} to {stop:.3g}" if stop > start else f"{start:.3g}"


def _breaks(points: Sequence[JudgedPoint]) -> Iterator[str]:
    """Rules that it does not follow, and ends at which it is no closed form, and whether it warned of that."""
    curves = [curve for some in curves_of(points) for curve in some if curve.is_rule]
    found = [_broken(curve, *zip(*run, strict=True)) for curve in curves for run in curve.runs]
    asked = [curve.quantity for curve in curves if curve.quantity in SWEPT]
    if any(found) or asked:
        yield "\nWhere it breaks:"
        yield from filter(None, found) if any(found) else [f"  nowhere, as far as it was led: {', '.join(asked)}"]


def _broken(curve: JudgedCurve, at: Sequence[float], run: Sequence[JudgedPoint]) -> str:
    """Neighbouring points of one verdict; nothing of those that agree or are open."""
    if run[0].verdict in (AGREE, UNDECIDED):
        return ""
    where = f"{curve.along} = {_range(at[0], at[-1])}" if curve.along else placed(curve.where)
    shown = max(run, key=lambda point: abs(point.difference)).shown
    silent = ", without a warning" if curve.quantity in SWEPT else ""
    warned = next((f", {point.reason}" for point in run if point.reason), silent)
    return f"  {curve.quantity}, {where}: {shown}{warned if run[0].verdict == DIFFER else ''}"


def paragraph(judgement: "Judgement") -> str:
    """Sentences that could stand in a paper: beside what, how near, over which conditions, and what was found."""
    points, tolerance = judgement.verdicts, judgement.tolerance
    compared = [point for point in points if math.isfinite(point.reference)]
    beside, version = REFERENCES.get(judgement.kind, "boundary elements"), metadata.version("mdr-validation")
    said = [
        f"The model {judgement.model!r} was compared with {beside}, the references of mdr-validation {version}.",
        f"A number is within {tolerance} where its whole 95 % interval is, by the errors of both.",
    ]
    said += [_of_quantity(tolerance, curves) for curves in curves_of(compared) if not curves[0].is_rule]
    count = Counter(point.verdict for point in points)
    if known := count[AGREE] + count[DIFFER] + count[UNDECIDED]:
        said.append(f"Of {known} points {count[AGREE]} agree, {count[DIFFER]} differ and the others are open.")
    if (most := worst([point for point in points if point.quantity not in SWEPT], 1)) and most[0].verdict == DIFFER:
        apart = in_unit(most[0].difference, most[0].unit, "+")
        said.append(f"The largest difference, of its {most[0].quantity}, is {apart} at {placed(most[0].where)}.")
    if lost := len(points) - known:
        said.append(f"It has no value at {lost} of {len(points)} points.")
    return " ".join(said)


def _of_quantity(tolerance: Tolerance, curves: Sequence[JudgedCurve]) -> str:
    """Where it agrees in all of its curves; of many curves, or of points apart, at how many."""
    first, points = curves[0], [point for curve in curves for point in curve.points]
    compared = "; ".join(_values(name, points) for name in dict.fromkeys(name for p in points for name in p.where))
    compared = f" (compared: {compared})" if compared else ""
    within = f"{decibels(tolerance.relative):.2g} dB" if points[0].unit == LEVEL else str(tolerance)
    if not first.along or len(curves) > CURVES // 2 or min(len(curve.points) for curve in curves) == 1:
        agree = sum(point.verdict == AGREE for point in points)
        return f"Its {first.quantity} is within {within} at {agree} of {len(points)} points{compared}."
    wrong = {point.where[first.along] for point in points if point.verdict != AGREE}
    at = sorted({x for curve in curves for x in curve.at})
    runs = [(right, list(run)) for right, run in groupby(at, lambda x: x not in wrong)]
    ranges = " and ".join(_range(run[0], run[-1]) for right, run in runs if right)
    every = f" at every {', '.join(first.where)}" if first.where and len(curves) > 1 else ""
    if not ranges:
        return f"For no {first.along} its {first.quantity} is within {within}{every} for certain{compared}."
    return f"Its {first.quantity} is within {within} for {first.along} = {ranges}{every}{compared}."


def _values(name: str, points: Sequence[JudgedPoint]) -> str:
    """Of a condition: all of them, or their ends, or how many there are."""
    found = list(dict.fromkeys(point.where[name] for point in points if name in point.where))
    numbers = sorted(value for value in found if isinstance(value, float))
    if len(numbers) < len(found):
        return ", ".join(map(str, found)) if len(found) <= LISTED else f"{len(found)} values of {name}"
    listed = ", ".join(f"{x:.0f}" if x.is_integer() else f"{x:.3g}" for x in numbers)
    return f"{name} = {listed if len(numbers) <= LISTED else _range(numbers[0], numbers[-1])}"
