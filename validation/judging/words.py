"""What a person reads of a judgement: strips by range, the worst points, and a paragraph for a paper."""

import math
import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib import metadata
from itertools import groupby
from typing import TYPE_CHECKING

from validation.advice.tolerance import Tolerance, decibels
from validation.judging.judgement import (
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
from validation.judging.kinds.held_out_solves import held_out
from validation.judging.kinds.laws import in_words, table_14_1
from validation.judging.kinds.own import MAIN
from validation.judging.kinds.rolling import APART, RMS, about_roughness, about_strip
from validation.judging.kinds.rolling import LEVEL as FORCE_LEVEL
from validation.judging.kinds.rolling import MAIN as WHEEL
from validation.judging.kinds.rolling import MEAN as MEAN_FORCE
from validation.judging.kinds.stiffness import BAND, DEVIATION, MEAN, ROLLED_OFF, WAVES
from validation.judging.kinds.sweeps import SWEPT

if TYPE_CHECKING:
    from validation.judging.judge import Judgement

SIGN = {AGREE: "=", DIFFER: "#", UNDECIDED: "?", REFUSED: "r", FAILED: "x"}
WORD = {AGREE: "yes", DIFFER: "no", UNDECIDED: "open", REFUSED: "refused", FAILED: "failed"}
POINTS = {AGREE: "agree", DIFFER: "differ", UNDECIDED: "left open"}
COLUMNS, CURVES, LISTED = 110, 24, 6
"""Of a line; groups of a quantity that are shown; values of a condition that a paper lists."""
NO_SIGN = "rms of the difference over that of the fluctuation, which has no sign"
NOTES = (
    dict.fromkeys((MEAN, DEVIATION, ROLLED_OFF), f"all at {BAND} = {WAVES}")
    | dict.fromkeys((FORCE_LEVEL, RMS, MEAN_FORCE), f"roughness of {about_roughness()}, wheel of {WHEEL}")
    | {APART.format(name): f"{NO_SIGN}; {about_strip()}, wheel of {WHEEL}" for name in ("force", "approach")}
    | {held_out(APART.format(name)): NO_SIGN for name in ("force", "approach")}
)
"""What is asked of a quantity that its conditions do not say."""


def summary_lines(judgement: "Judgement") -> Iterator[str]:
    """Of one model."""
    points = judgement.verdicts
    count = Counter(point.verdict for point in points)
    counted = ", ".join(f"{count[verdict]} {verdict}" for verdict in VERDICTS if count[verdict]) or "none"
    what, took = judgement.kind.replace("_", " "), f"{len(points)} points in {judgement.seconds:.1f} s"
    yield f"{judgement.model}: {what}, tolerance {judgement.tolerance}, {took}: {counted}"
    for remark in judgement.remarks:
        yield from textwrap.wrap(remark.sentence, COLUMNS, initial_indent="! ", subsequent_indent="  ")
    yield f"strips: {', '.join(f'{SIGN[verdict]} {WORD[verdict]}' for verdict in VERDICTS)}"
    for curves in curves_of(points):
        along = curves[0].along if len(curves[0].points) > 1 else ""
        note = NOTES.get(curves[0].quantity, "")
        yield f"\n{curves[0].quantity}{f', along {along}' if along else ''}{f' ({note})' if note else ''}"
        yield from (_strip(curve) for curve in curves[:CURVES])
        if len(curves) > CURVES:
            yield f"  and {len(curves) - CURVES} more, which --csv writes"
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
    if found := list(filter(None, (_broken(curve, *zip(*run, strict=True)) for curve in curves for run in curve.runs))):
        yield "\nWhere it breaks:"
        yield from found
    elif asked := [curve for curve in curves if curve.quantity in SWEPT]:
        yield "\nBeyond these scenes:"
        agrees = [all(point.verdict == AGREE for point in curve.points) for curve in asked]
        yield from (f"  {'agrees' if a else 'open'} {curve.quantity}" for a, curve in zip(agrees, asked, strict=True))


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
    quantities = [some for some in curves_of(points) if not some[0].is_rule and any(map(_has_a_number, some))]
    of_wheel, version = judgement.kind == "contact_law", metadata.version("mdr-validation")
    beside = f"springs (MDR) under {in_words(table_14_1())}" if of_wheel else "boundary elements"
    said = [
        f"The model {judgement.model!r} was compared with {beside}, the references of mdr-validation {version}.",
        f"A number is within {tolerance} where its whole 95 % interval is, by the errors of both.",
    ]
    said += [remark.sentence for remark in judgement.remarks]
    said += [_of_quantity(tolerance, curves) for curves in quantities]
    count = Counter(point.verdict for point in points)
    if known := count[AGREE] + count[DIFFER] + count[UNDECIDED]:
        parts = (f"{count[verdict]} {word}" for verdict, word in POINTS.items() if count[verdict])
        said.append(f"Of {known} points {', '.join(parts)}.")
    rules = (curve for some in curves_of(points) for curve in some if curve.is_rule)
    if broken := dict.fromkeys(curve.quantity for curve in rules if any(p.verdict == DIFFER for p in curve.points)):
        said.append(f"It does not keep to what is known in closed form: {', '.join(broken)}.")
    if (most := worst([point for point in points if point.quantity not in SWEPT], 1)) and most[0].verdict == DIFFER:
        where = placed(most[0].where)
        said.append(
            f"The largest difference, of its {most[0].quantity}, is {most[0].shown}{f' at {where}' if where else ''}."
        )
    if lost := len(points) - known:
        said.append(f"It has no value at {lost} of {len(points)} points.")
    return " ".join(said)


def _has_a_number(curve: JudgedCurve) -> bool:
    return any(math.isfinite(point.difference) for point in curve.points)


def _of_quantity(tolerance: Tolerance, curves: Sequence[JudgedCurve]) -> str:
    """Where it agrees in all of its curves, or in those that share a condition; of points apart, at how many."""
    first, points = curves[0], [point for curve in curves for point in curve.points]
    compared = "; ".join(_values(name, points) for name in dict.fromkeys(name for p in points for name in p.where))
    compared = "; ".join(filter(None, (compared, NOTES.get(first.quantity))))
    compared = f" (compared: {compared})" if compared else ""
    within = f"{decibels(tolerance.relative):.2g} dB" if points[0].unit == LEVEL else str(tolerance)
    if not first.along or max(len(curve.points) for curve in curves) == 1:
        agree = sum(point.verdict == AGREE for point in points)
        return f"Its {first.quantity} is within {within} at {agree} of {len(points)} points{compared}."
    others = [name for name in first.where if len({curve.where[name] for curve in curves}) > 1]
    numbers = [name for name in others if any(isinstance(curve.where[name], float) for curve in curves)]
    groups, by = {"": list(curves)}, ""
    if numbers and not _right(curves, numbers):
        by = numbers.pop()
        others.remove(by)
        groups = {
            _value(x): [c for c in curves if c.where[by] == x] for x in dict.fromkeys(c.where[by] for c in curves)
        }
    found: dict[str, list[str]] = {}
    for value, some in groups.items():
        if ranges := _right(some, numbers):
            found.setdefault(ranges, []).append(value)
    each = " and ".join(f"every {name}{'' if name in numbers else ' compared there'}" for name in others)
    each = f" at {each}" if each else ""
    if not found:
        return f"For no {first.along} its {first.quantity} is within {within}{each} for certain{compared}."
    each = f",{each}" if by and each else each
    at = "; ".join(f"{ranges}{f' at {by} = ' if by else ''}{', '.join(values)}" for ranges, values in found.items())
    return f"Its {first.quantity} is within {within} for {first.along} = {at}{each}{compared}."


def _right(curves: Sequence[JudgedCurve], numbers: Sequence[str]) -> str:
    """Ranges in which all of these agree; one ends where there is no reference for a value of these conditions."""
    known: dict[tuple[float | str, ...], set[float]] = {}
    for curve in curves:
        known.setdefault(tuple(curve.where[name] for name in numbers), set()).update(curve.at)
    wrong = {x for curve in curves for x, point in zip(curve.at, curve.points, strict=True) if point.verdict != AGREE}
    at, right = sorted(set().union(*known.values())), set.intersection(*known.values()) - wrong
    runs = [list(run) for is_right, run in groupby(at, lambda x: x in right) if is_right]
    return " and ".join(_range(run[0], run[-1]) for run in runs)


def _value(x: float | str) -> str:
    return f"{x:.3g}" if isinstance(x, float) else x


def _values(name: str, points: Sequence[JudgedPoint]) -> str:
    """Of a condition: all of them, or their ends, or how many there are."""
    found = list(dict.fromkeys(point.where[name] for point in points if name in point.where))
    numbers = sorted(value for value in found if isinstance(value, float))
    if len(numbers) < len(found):
        return ", ".join(map(str, found)) if len(found) <= LISTED else f"{len(found)} values of {name}"
    listed = ", ".join(f"{x:.0f}" if x.is_integer() else f"{x:.3g}" for x in numbers)
    return f"{name} = {listed if len(numbers) <= LISTED else _range(numbers[0], numbers[-1])}"


if TYPE_CHECKING:
    from validation.judging.solvers.judged import SolverTime

SHOWN = 5
"""Reasons, and problems of each."""
CHECKS = ("complementarity", "penetration", "force balance", "approach", "force", "pressure")
NO_ROW = (*CHECKS, "tension", "answer", "conditions")
UNEXPLAINED = dict.fromkeys(
    (
        "more than the residual that it names",
        "off by more than the residual that it names allows",
        "force not held",
        "the pressure is another one",
        "the contact shrinks under more load",
        "it falls under more load",
        "the error does not fall with the cell size",
    ),
    1,
)
"""Reasons that are no cause: what is measured."""


def solver_lines(
    model: str, points: Sequence[JudgedPoint], times: Sequence["SolverTime"], seconds: float
) -> Iterator[str]:
    """Of one solver."""
    rest, checks = [point for point in points if not point.decides], [point for point in points if point.decides]
    unserved = [point for point in rest if point.verdict == REFUSED]
    wrong = [point for point in checks if point.verdict != AGREE]
    said = f"wrong in {len(wrong)} of {len(checks)} checks" if wrong else f"right in all {len(checks)} checks"
    said = said if checks else "without an answer"
    more = f", {len(unserved)} not served" if unserved else ""
    yield f"{model}: contact solver, {said}{more}, {seconds:.1f} s"
    yield from reasons(wrong)
    yield from not_served(unserved, checks)
    yield from (
        f"  {', '.join(filter(None, [p.quantity, placed(p.where)]))}: {p.reason}" for p in rest if p not in unserved
    )
    yield from ["", *table_of_problems(checks)]
    if times:
        yield "\nseconds beside bem3d, same grid and residual, one thread and its set-up each:"
        yield from (f"  {t.cells:.0f}²{t.seconds:12.3g} s{t.seconds / t.bem3d:9.2g} times" for t in times)
    if len(times) > 1:
        mine, ours = (growth(times, name) for name in ("seconds", "bem3d"))
        yield f"  its time grows as the number of cells to the power {mine:.2g}, that of bem3d {ours:.2g}"
    yield from ["\nFor a paper:", f"  {for_a_paper(model, wrong, checks, unserved)}"]


def for_a_paper(
    model: str, wrong: Sequence[JudgedPoint], checks: Sequence[JudgedPoint], unserved: Sequence[JudgedPoint]
) -> str:
    """A sentence that goes no further than what was asked."""
    failed, asked = len(_problems(wrong)), len(_problems(checks))
    what = f"is wrong on {failed} of the {asked}" if wrong else f"solves the {asked}" if asked else "solves none of the"
    how = "" if wrong or not asked else " to its residual, by an operator that is not its own"
    left = f"; {len(_problems(unserved) - _problems(checks))} others it does not serve" if unserved else ""
    periodic = {"periodic" in name for name in _problems(checks)}
    of = "" if len(periodic) != 1 else " of periodic half-spaces" if True in periodic else " of free half-spaces"
    return f"{model!r} {what} discrete problems{of} of mdr-validation {metadata.version('mdr-validation')}{how}{left}."


def not_served(unserved: Sequence[JudgedPoint], checks: Sequence[JudgedPoint]) -> Iterator[str]:
    """What a solver declares that it does not serve, and what the verdict covers then."""
    if not unserved:
        return
    lost, asked = _problems(unserved), _problems(checks)
    left = {"of {} others": len(lost - asked), "of {} in part": len(lost & asked)}
    silent = ", and ".join(words.format(count) for words, count in left.items() if count)
    yield f"  the verdict covers {len(asked)} problems that the solver serves; {silent} it says nothing"
    yield from reasons(unserved)


def _reasons(points: Sequence[JudgedPoint]) -> list[str]:
    return list(dict.fromkeys(point.reason for point in points))


def _problems(points: Sequence[JudgedPoint]) -> set[str]:
    return {str(point.where["problem"]) for point in points}


def reasons(wrong: Sequence[JudgedPoint]) -> Iterator[str]:
    """Causes before what is shown without one, that of most problems first, each with what shows it and where."""
    problems = {reason: {p.where["problem"] for p in wrong if p.reason == reason} for reason in _reasons(wrong)}
    known = sorted(problems, key=lambda reason: (UNEXPLAINED.get(reason, 0), -len(problems[reason])))
    for reason in known[:SHOWN]:
        mine = [point for point in wrong if point.reason == reason]
        quantities = ", ".join(dict.fromkeys(point.quantity for point in mine))
        places = list(dict.fromkeys(str(point.where["problem"]) for point in mine))
        more = f" and {len(places) - SHOWN} more" if len(places) > SHOWN else ""
        yield f"  {reason}: {quantities}, in {'; '.join(places[:SHOWN])}{more}"
    if len(known) > SHOWN:
        yield f"  and {len(known) - SHOWN} other reasons"


def table_of_problems(checks: Sequence[JudgedPoint]) -> Iterator[str]:
    """A row a problem: how far off each number is; then the properties."""
    there = [name for name in CHECKS if any(point.quantity == name for point in checks)]
    yield f"{'off by':40s}" + "".join(f"{name:>16s}" for name in there)
    for problem in dict.fromkeys(str(point.where["problem"]) for point in checks):
        mine = {p.quantity: p for p in checks if p.where["problem"] == problem and p.quantity in there}
        if mine:
            yield f"  {problem:38s}" + "".join(f"{_off(mine.get(name)):>16s}" for name in there)
    others = [point for point in checks if point.quantity not in NO_ROW]
    for name in dict.fromkeys(point.quantity for point in others):
        held = all(point.verdict == AGREE for point in others if point.quantity == name)
        yield f"  {name:38s}{'holds' if held else 'does not hold':>16s}"


def _off(point: JudgedPoint | None) -> str:
    return f"{abs(point.difference):.1e}{'' if point.verdict == AGREE else ' !'}" if point else ""


def growth(times: Sequence["SolverTime"], what: str) -> float:
    """Power of the number of cells, between the two finest grids."""
    before, after = times[-2:]
    ratio = getattr(after, what) / getattr(before, what)
    return math.log(ratio) / math.log(after.cells / before.cells) / 2
