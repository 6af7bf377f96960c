"""What a person reads of a judgement: strips by range, the worst points, and a paragraph for a paper."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from importlib import metadata
from itertools import groupby

from validation.analysis.judgement import (
    AGREE,
    DIFFER,
    FAILED,
    REFUSED,
    UNDECIDED,
    VERDICTS,
    Group,
    JudgedPoint,
    groups_of,
    in_unit,
    is_property,
    placed,
    shared,
    worst,
)

SIGN = {AGREE: "=", DIFFER: "#", UNDECIDED: "?", REFUSED: "r", FAILED: "x"}
WORD = {AGREE: "yes", DIFFER: "no", UNDECIDED: "open", REFUSED: "refused", FAILED: "failed"}
COLUMNS, CURVES = 110, 24
"""Of a line, and groups of a quantity that are shown."""


def summary_lines(
    model: str, kind: str, tolerance: str, points: Sequence[JudgedPoint], seconds: float
) -> Iterator[str]:
    """Of one model."""
    counted = ", ".join(f"{n} {verdict}" for verdict in VERDICTS if (n := _count(points, verdict)))
    what = kind.replace("_", " ")
    yield f"{model}: {what}, tolerance {tolerance}, {len(points)} points in {seconds:.1f} s: {counted or 'none'}"
    yield f"strips: {', '.join(f'{SIGN[verdict]} {WORD[verdict]}' for verdict in VERDICTS)}"
    for quantity, some in groupby(groups_of(points), lambda group: group[0]):
        groups = list(some)
        along = groups[0][2]
        yield f"\n{quantity}{f', along {along}' if along and len(groups[0][3]) > 1 else ''}"
        yield from (_strip(group) for group in groups[:CURVES])
        if len(groups) > CURVES:
            yield f"  and {len(groups) - CURVES} more"
    yield from _worst_lines(points)
    yield "\nFor a paper:"
    yield from textwrap.wrap(paragraph(model, tolerance, points), COLUMNS, initial_indent="  ", subsequent_indent="  ")


def _count(points: Sequence[JudgedPoint], verdict: str) -> int:
    return sum(point.verdict == verdict for point in points)


def _strip(group: Group) -> str:
    """A sign a point, then the ranges in words."""
    _, where, along, points = group
    strip = "".join(SIGN[point.verdict] for point in points)
    name = placed(where) or "all"
    if len(points) == 1:
        return f"  {placed(points[0].where) or 'all':32s} {strip}  {WORD[points[0].verdict]}: {points[0].shown}"
    said = [f"{WORD[verdict]} {', '.join(_ranges(points, along, verdict))}" for verdict in VERDICTS]
    return f"  {name:32s} {strip}  {'; '.join(some for some in said if not some.endswith(' '))}"


def _ranges(points: Sequence[JudgedPoint], along: str, verdict: str) -> Iterator[str]:
    for found, run in groupby(points, lambda point: point.verdict):
        ends = [point.where.get(along, math.nan) for point in run]
        if found == verdict:
            yield _range(float(ends[0]), float(ends[-1]))


def _range(start: float, stop: float) -> str:
    return f"{start:.3g} to {stop:.3g}" if stop > start else f"{start:.3g}"


def _worst_lines(points: Sequence[JudgedPoint]) -> Iterator[str]:
    if found := worst(points):
        yield f"\nThe worst{f' {len(found)}' if len(found) > 1 else ''}:"
        yield from (f"  {point.quantity}, {point.place or 'everywhere'}: {point.shown}" for point in found)
        if found[0].verdict == DIFFER and (common := shared(found, points)):
            yield f"  They share: {common}."


def paragraph(model: str, tolerance: str, points: Sequence[JudgedPoint]) -> str:
    """Sentences that could stand in a paper."""
    version = metadata.version("mdr-validation")
    said = [f"The model {model!r} was compared with the references of mdr-validation {version} (95 % intervals)."]
    for quantity, some in groupby(groups_of(points), lambda group: group[0]):
        groups = list(some)
        # a property has the reference one, and is no result that a paper states
        ranges = bool(groups[0][2]) and len(groups) <= CURVES // 2 and all(len(group[3]) > 1 for group in groups)
        if ranges and not is_property(groups[0]):
            said.append(_everywhere(quantity, tolerance, groups))
    known = [point for point in points if point.verdict in (AGREE, DIFFER, UNDECIDED)]
    if known:
        differing = _count(known, DIFFER)
        said.append(f"Of {len(known)} points {_count(known, AGREE)} agree, {differing} differ and the others are open.")
    if (most := worst(known, 1)) and most[0].verdict == DIFFER:
        said.append(f"The largest difference is {in_unit(most[0].difference, most[0].unit, '+')} at {most[0].place}.")
    if lost := len(points) - len(known):
        said.append(f"It has no value at {lost} of {len(points)} points.")
    return " ".join(said)


def _everywhere(quantity: str, tolerance: str, groups: Sequence[Group]) -> str:
    """Where a quantity agrees in all of its curves."""
    along = groups[0][2]
    at = sorted({float(point.where[along]) for group in groups for point in group[3]})
    right = [
        all(point.verdict == AGREE for group in groups for point in group[3] if point.where[along] == x) for x in at
    ]
    ranges = [
        _range(some[0][1], some[-1][1])
        for agrees, run in groupby(zip(right, at, strict=True), lambda pair: pair[0])
        if agrees
        for some in [list(run)]
    ]
    others = ", ".join(groups[0][1])
    every = f" at every {others}" if others and len(groups) > 1 else ""
    if not ranges:
        return f"There is no {along} for which its {quantity} is within {tolerance}{every} for certain."
    return f"Its {quantity} is within {tolerance} for {along} = {' and '.join(ranges)}{every}."
