"""Sentences of a judgement, for a terminal and for a paper: a template for each pattern, over what its numbers say."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from enum import StrEnum
from importlib import metadata
from itertools import starmap
from typing import TYPE_CHECKING

from validation.advice.tolerance import Tolerance
from validation.analysis.evidence import OF_NUMBERS, Verdict, where_text
from validation.analysis.number_text import deviation_text, interval_text, place_value
from validation.analysis.ranges import VerdictRange
from validation.judging.judgement import (
    LEVEL,
    JudgedNumber,
    JudgedSeries,
    SolverTime,
    common_condition,
    counts_of,
    groups_of,
    largest_deviations,
    series_of,
    within_ranges,
)
from validation.judging.kinds import rolling, stiffness
from validation.judging.kinds.held_out_points import held_out
from validation.judging.kinds.laws import in_words, table_14_1
from validation.judging.kinds.own import MAIN
from validation.judging.kinds.properties import SWEPT
from validation.judging.solvers.properties import Symptom

if TYPE_CHECKING:
    from validation.judging.judge import Judgement

LINE, STRIPS, LISTED = 110, 24, 6
"""Characters of a line; series of a quantity that are printed; values of a condition that a paper lists."""
PAPER = "\nFor a paper:"
NO_SIGN = "rms of the difference over that of the fluctuation, which has no sign"
_OF_PUNCH = f"all at {stiffness.BAND} = {stiffness.WAVES}"
_OF_LEVELS = f"roughness of {rolling.about_roughness()}, wheel of {rolling.MAIN}"
_APART = [rolling.APART.format(name) for name in ("force", "approach")]
NOTES = (
    dict.fromkeys((stiffness.MEAN, stiffness.DEVIATION, stiffness.ROLLED_OFF), _OF_PUNCH)
    | dict.fromkeys((rolling.LEVEL, rolling.RMS, rolling.MEAN), _OF_LEVELS)
    | dict.fromkeys(_APART, f"{NO_SIGN}; {rolling.about_strip()}, wheel of {rolling.MAIN}")
    | dict.fromkeys(map(held_out, _APART), NO_SIGN)
)
"""Settings of a quantity that its conditions do not have."""


class Line(StrEnum):
    """Templates of lines on a reduced model. {0}: the judgement, a number of it, or a cost.

    strip: a sign a number; outcome: ranges of each verdict; warning: of the model, or that it has given none.
    """

    RESULT = "{0.model}: {counts} ({count} points, tolerance {0.tolerance}); {kind}, {0.seconds:.1f} s"
    QUANTITY = "\n{quantity}{along}{note}"
    STRIP = "  {conditions:32s} {strip}  {outcome}"
    LARGEST = "  {0.quantity}, {conditions}: {0.shown}"
    BROKEN = "  {0.quantity}, {place}: {0.shown}{warning}"
    COST = "  {0.model:32s}{error:>10s}{0.seconds:10.2g} s"


class Sentence(StrEnum):
    """Templates of the paragraph on a reduced model, in their order.

    limit: the tolerance in the unit of the quantity; every: other conditions under which it is met; settings: what was
    compared.
    """

    REFERENCE = "The model {model!r} was compared with {reference}, the references of mdr-validation {version}."
    TOLERANCE = "A number is within {tolerance} where its whole 95 % interval is, by the errors of both."
    POINTS_WITHIN = "Its {quantity} is within {limit} at {within} of {count} points{settings}."
    RANGES_WITHIN = "Its {quantity} is within {limit} for {along} = {ranges}{every}{settings}."
    NEVER_WITHIN = "For no {along} its {quantity} is within {limit}{every} for certain{settings}."
    COUNTS = "Of {count} points {counts}."
    CONTRADICTED = "It contradicts what is known in closed form: {quantities}."
    LARGEST = "The largest deviation, of its {0.quantity}, is {0.shown}{place}."
    LOST = "It has no value at {lost} of {count} points."


class SolverPattern(StrEnum):
    """Templates of the lines on a contact solver, and of the sentence on it."""

    RESULT = "{model}: contact solver, {result}{unserved}, {seconds:.1f} s"
    REASON = "  {reason}: {quantities}, in {problems}{more}"
    COVERED = "  the verdict covers {count} problems that the solver serves; {rest} it says nothing"
    OTHER = "  {place}: {reason}"
    TIME = "  {0.cells:.0f}²{0.seconds:12.3g} s{ratio:9.2g} times"
    GROWTH = "  its time grows as the number of cells to the power {power:.2g}, that of bem3d {of_bem3d:.2g}"
    PAPER = "  {model!r} {verb}{count} discrete problems{half_spaces} of mdr-validation {version}{accuracy}{limits}."


def summary_lines(judgement: "Judgement") -> Iterator[str]:
    """Of a reduced model."""
    numbers, quantities = judgement.numbers, series_of(judgement.numbers)
    counts = ", ".join(f"{count} {verdict}" for verdict, count in counts_of(numbers).items()) or "none"
    yield Line.RESULT.format(judgement, kind=judgement.kind.replace("_", " "), count=len(numbers), counts=counts)
    for remark in judgement.remarks:
        yield from textwrap.wrap(remark.sentence, LINE, initial_indent="! ", subsequent_indent="  ")
    yield f"strips: {', '.join(f'{verdict.sign} {verdict}' for verdict in Verdict)}"
    passed = [part for series in quantities for part in series if _is_passed(part)]
    shown = [[part for part in series if part not in passed] for series in quantities]
    for series in filter(None, shown):
        along = f", along {series[0].along}" if series[0].along and len(series[0].numbers) > 1 else ""
        note = f" ({note})" if (note := NOTES.get(series[0].quantity)) else ""
        yield Line.QUANTITY.format(quantity=series[0].quantity, along=along, note=note)
        yield from map(strip_line, series[:STRIPS])
        if len(series) > STRIPS:
            yield f"  and {len(series) - STRIPS} more, which --csv writes"
    yield from _largest_lines(numbers)
    yield from law_lines([part for series in quantities for part in series if part.is_closed_form])
    if judgement.costs:
        yield f"\nMedian error of the {MAIN[judgement.kind]}, and seconds of the call that took longest:"
    for cost in judgement.costs:
        yield Line.COST.format(cost, error=deviation_text(cost.error, cost.unit))
    yield PAPER
    yield from textwrap.wrap(paragraph(judgement), LINE, initial_indent="  ", subsequent_indent="  ")


def strip_line(series: JudgedSeries) -> str:
    """A sign a number, then the ranges: "within tolerance from 0.464 to 10; outside tolerance at 0.001"."""
    first, parts = series.numbers[0], series.verdict_ranges
    if len(series.numbers) == 1:
        outcome, where = f"{first.verdict}: {first.shown}", first.where
    else:
        ranges = {v: " and ".join(_range_text(part) for part in parts if part.verdict is v) for v in Verdict}
        outcome, where = "; ".join(f"{verdict} {text}" for verdict, text in ranges.items() if text), series.where
    strip = "".join(number.verdict.sign for number in series.numbers)
    return Line.STRIP.format(conditions=where_text(where) or "all", strip=strip, outcome=outcome)


def _range_text(part: VerdictRange) -> str:
    """ "from 0.464 to 10", "at 10"."""
    return f"{'from' if part.stop > part.start else 'at'} {interval_text(part.start, part.stop)}"


def _largest_lines(numbers: Sequence[JudgedNumber]) -> Iterator[str]:
    """The largest deviations of its scenes, and the condition that they share."""
    scenes = _of_scenes(numbers)
    if not (largest := largest_deviations(scenes)):
        return
    yield f"\nThe worst{f' {len(largest)}' if len(largest) > 1 else ''}:"
    for number in largest:
        yield Line.LARGEST.format(number, conditions=where_text(number.where) or "everywhere")
    if largest[0].verdict is Verdict.OUTSIDE and (common := common_condition(largest, scenes)):
        yield f"  They share: {common}."


def _of_scenes(numbers: Sequence[JudgedNumber]) -> list[JudgedNumber]:
    """Without those beyond the scenes of a judge."""
    return [number for number in numbers if number.quantity not in SWEPT]


def law_lines(closed_forms: Sequence[JudgedSeries]) -> Iterator[str]:
    """How many invariance tests and asymptotic limits are passed; the others, and whether the model has warned.

    A series is a test: of one quantity, under one set of conditions.
    """
    limits = [series for series in closed_forms if series.quantity in SWEPT]
    kinds = {"invariance tests": [series for series in closed_forms if series not in limits]}
    kinds["asymptotic limits"] = limits
    yield from [""] if closed_forms else ()
    for kind, tests in kinds.items():
        passed = sum(map(_is_passed, tests))
        open_tests = [series for series in tests if not _is_passed(series) and not any(_broken_parts(series))]
        rest = f"; inconclusive: {', '.join(dict.fromkeys(series.quantity for series in open_tests))}"
        yield from [f"{kind}: {passed} of {len(tests)} passed{rest if open_tests else ''}"] if tests else ()
    broken = [(series, part) for series in closed_forms for part in _broken_parts(series)]
    if broken:
        yield "\nTests not passed:"
        yield from starmap(_broken_line, broken)


def _is_passed(series: JudgedSeries) -> bool:
    """Whether it is a closed form, or a limit, and all of its numbers are within tolerance."""
    return series.is_closed_form and all(number.verdict is Verdict.WITHIN for number in series.numbers)


def _broken_parts(series: JudgedSeries) -> list[VerdictRange]:
    """The ranges of a closed form that are neither within tolerance nor inconclusive."""
    return [part for part in series.verdict_ranges if part.verdict not in (Verdict.WITHIN, Verdict.INCONCLUSIVE)]


def _broken_line(series: JudgedSeries, part: VerdictRange) -> str:
    """The largest deviation of a range."""
    numbers = part.items(series.numbers)
    silent = ", without a warning" if series.quantity in SWEPT else ""
    warning = next((f", {number.reason}" for number in numbers if number.reason), silent)
    largest = max(numbers, key=lambda number: abs(number.difference))
    place = f"{series.along} = {interval_text(part.start, part.stop)}" if series.along else where_text(series.where)
    return Line.BROKEN.format(largest, place=place, warning=warning if part.verdict is Verdict.OUTSIDE else "")


def paragraph(judgement: "Judgement") -> str:
    """Sentences that could stand in a paper: the reference, the tolerance, the conditions, and the results."""
    numbers, quantities = judgement.numbers, series_of(judgement.numbers)
    of_wheel = judgement.kind == "contact_law"
    reference = f"springs (MDR) under {in_words(table_14_1())}" if of_wheel else "boundary elements"
    sentences = [
        Sentence.REFERENCE.format(
            model=judgement.model, reference=reference, version=metadata.version("mdr-validation")
        ),
        Sentence.TOLERANCE.format(tolerance=judgement.tolerance),
        *(remark.sentence for remark in judgement.remarks),
        *(
            quantity_sentence(judgement.tolerance, series)
            for series in quantities
            if not series[0].is_closed_form and any(part.has_a_number for part in series)
        ),
    ]
    counts = {verdict: count for verdict, count in counts_of(numbers).items() if verdict in OF_NUMBERS}
    count = sum(counts.values())
    if counts:
        first, *rest = counts
        verb = "is" if counts[first] == 1 else "are"
        texts = [f"{counts[first]} {verb} {first}", *(f"{counts[verdict]} {verdict}" for verdict in rest)]
        sentences.append(Sentence.COUNTS.format(count=count, counts=", ".join(texts)))
    closed_forms = [
        number for series in quantities for part in series if part.is_closed_form for number in part.numbers
    ]
    if broken := dict.fromkeys(number.quantity for number in closed_forms if number.verdict is Verdict.OUTSIDE):
        sentences.append(Sentence.CONTRADICTED.format(quantities=", ".join(broken)))
    largest = largest_deviations(_of_scenes(numbers), 1)
    if largest and largest[0].verdict is Verdict.OUTSIDE:
        place = f" at {text}" if (text := where_text(largest[0].where)) else ""
        sentences.append(Sentence.LARGEST.format(largest[0], place=place))
    if lost := len(numbers) - count:
        sentences.append(Sentence.LOST.format(lost=lost, count=len(numbers)))
    return " ".join(sentences)


def quantity_sentence(tolerance: Tolerance, series: Sequence[JudgedSeries]) -> str:
    """The ranges that are within tolerance in all series of a quantity, or in those that share a condition.

    Without a parameter the count of numbers within tolerance.
    """
    first, numbers = series[0], [number for part in series for number in part.numbers]
    names = dict.fromkeys(name for number in numbers for name in number.where)
    settings = "; ".join(filter(None, (*(_setting(name, numbers) for name in names), NOTES.get(first.quantity))))
    fields: dict[str, object] = {
        "quantity": first.quantity,
        "along": first.along,
        "limit": Tolerance(tolerance.relative, in_decibels=True) if numbers[0].unit == LEVEL else tolerance,
        "settings": f" (compared: {settings})" if settings else "",
    }
    if not first.along or max(len(part.numbers) for part in series) == 1:
        within = sum(number.verdict is Verdict.WITHIN for number in numbers)
        return Sentence.POINTS_WITHIN.format(within=within, count=len(numbers), **fields)
    found = within_ranges(series)
    every = " and ".join(f"every {name}{'' if name in found.numeric else ' compared there'}" for name in found.every)
    fields["every"] = f"{',' if found.by and found.values else ''} at {every}" if every else ""
    if not found.values:
        return Sentence.NEVER_WITHIN.format(**fields)
    places = []
    for ranges, values in found.values.items():
        texts = [place_value(value) if isinstance(value, float) else value for value in values]
        at = f" at {found.by} = {', '.join(texts)}" if found.by else ""
        places.append(" and ".join(interval_text(*ends) for ends in ranges) + at)
    return Sentence.RANGES_WITHIN.format(ranges="; ".join(places), **fields)


def _setting(name: str, numbers: Sequence[JudgedNumber]) -> str:
    """Of a condition: all values, or their ends, or how many there are."""
    values = list(dict.fromkeys(number.where[name] for number in numbers if name in number.where))
    floats = sorted(value for value in values if isinstance(value, float))
    if len(floats) < len(values):
        return ", ".join(map(str, values)) if len(values) <= LISTED else f"{len(values)} values of {name}"
    few = ", ".join(map(place_value, floats)) if len(floats) <= LISTED else ""
    return f"{name} = {few or interval_text(floats[0], floats[-1])}"


SHOWN = 5
"""Reasons, and problems of each."""
CHECKS = ("complementarity", "penetration", "force balance", "approach", "force", "pressure")
NO_ROW = (*CHECKS, "tension", "answer", "conditions")


def solver_lines(
    model: str, numbers: Sequence[JudgedNumber], times: Sequence[SolverTime], seconds: float
) -> Iterator[str]:
    """Of a contact solver."""
    checks = [number for number in numbers if number.decides]
    others = [number for number in numbers if not number.decides]
    unserved = [number for number in others if number.verdict is Verdict.NOT_SERVED]
    wrong = [number for number in checks if number.verdict is not Verdict.WITHIN]
    result = f"wrong in {len(wrong)} of {len(checks)} checks" if wrong else f"right in all {len(checks)} checks"
    yield SolverPattern.RESULT.format(
        model=model,
        result=result if checks else "without an answer",
        unserved=f", {len(unserved)} not served" if unserved else "",
        seconds=seconds,
    )
    yield from reason_lines(wrong)
    yield from unserved_lines(unserved, checks)
    for number in others:
        if number.verdict is not Verdict.NOT_SERVED:
            place = ", ".join(filter(None, [number.quantity, where_text(number.where)]))
            yield SolverPattern.OTHER.format(place=place, reason=number.reason)
    yield from ["", *problem_lines(checks)]
    if times:
        yield "\nseconds, and relative to bem3d: same grid and residual, one thread, each with its set-up:"
    yield from (SolverPattern.TIME.format(time, ratio=time.seconds / time.bem3d) for time in times)
    if len(times) > 1:
        power, of_bem3d = (growth(times, name) for name in ("seconds", "bem3d"))
        yield SolverPattern.GROWTH.format(power=power, of_bem3d=of_bem3d)
    yield from [PAPER, solver_sentence(model, wrong, checks, unserved)]


def solver_sentence(
    model: str, wrong: Sequence[JudgedNumber], checks: Sequence[JudgedNumber], unserved: Sequence[JudgedNumber]
) -> str:
    """For a paper: a result that goes no further than the problems that were solved."""
    solved, failed = set(map(_problem, checks)), set(map(_problem, wrong))
    count, others = len(solved), set(map(_problem, unserved)) - solved
    periodic = {"periodic" in name for name in solved}
    return SolverPattern.PAPER.format(
        model=model,
        verb=f"is wrong on {len(failed)} of the" if wrong else "solves the" if count else "solves none of the",
        count=f" {count}" if count else "",
        half_spaces=f" of {'periodic' if True in periodic else 'free'} half-spaces" if len(periodic) == 1 else "",
        version=metadata.version("mdr-validation"),
        accuracy="" if wrong or not count else " to its residual, by an operator that is not its own",
        limits=f"; {len(others)} others it does not serve" if unserved else "",
    )


def unserved_lines(unserved: Sequence[JudgedNumber], checks: Sequence[JudgedNumber]) -> Iterator[str]:
    """The problems that a solver declares not to serve, and those that the verdict covers then."""
    if not unserved:
        return
    lost, solved = set(map(_problem, unserved)), set(map(_problem, checks))
    counts = {"of {} others": len(lost - solved), "of {} in part": len(lost & solved)}
    rest = ", and ".join(words.format(count) for words, count in counts.items() if count)
    yield SolverPattern.COVERED.format(count=len(solved), rest=rest)
    yield from reason_lines(unserved)


def _problem(number: JudgedNumber) -> str:
    """Its name."""
    return str(number.where["problem"])


def reason_lines(numbers: Sequence[JudgedNumber]) -> Iterator[str]:
    """Causes before symptoms, that of most problems first, each with its quantities and problems."""
    groups = groups_of(numbers, lambda number: number.reason)
    order = sorted(groups, key=lambda reason: (reason in {*Symptom}, -len(set(map(_problem, groups[reason])))))
    for reason in order[:SHOWN]:
        names = list(dict.fromkeys(map(_problem, groups[reason])))
        yield SolverPattern.REASON.format(
            reason=reason,
            quantities=", ".join(dict.fromkeys(number.quantity for number in groups[reason])),
            problems="; ".join(names[:SHOWN]),
            more=f" and {len(names) - SHOWN} more" if len(names) > SHOWN else "",
        )
    if len(order) > SHOWN:
        yield f"  and {len(order) - SHOWN} other reasons"


def problem_lines(checks: Sequence[JudgedNumber]) -> Iterator[str]:
    """A table of relative deviations, a row a problem; then the properties of every half-space."""
    quantities = [name for name in CHECKS if any(number.quantity == name for number in checks)]
    yield f"{'relative deviation':40s}" + "".join(f"{name:>16s}" for name in quantities)
    for problem, numbers in groups_of(checks, _problem).items():
        if row := {number.quantity: number for number in numbers if number.quantity in quantities}:
            yield f"  {problem:38s}" + "".join(f"{_deviation_cell(row.get(name)):>16s}" for name in quantities)
    properties = (number for number in checks if number.quantity not in NO_ROW)
    for name, numbers in groups_of(properties, lambda number: number.quantity).items():
        is_within = all(number.verdict is Verdict.WITHIN for number in numbers)
        yield f"  {name:38s}{'passed' if is_within else 'not passed':>16s}"


def _deviation_cell(number: JudgedNumber | None) -> str:
    """ "1.2e-05", with " !" outside of the tolerance."""
    return f"{abs(number.difference):.1e}{'' if number.verdict is Verdict.WITHIN else ' !'}" if number else ""


def growth(times: Sequence[SolverTime], name: str) -> float:
    """Power of the number of cells, between the two finest grids."""
    before, after = times[-2:]
    ratio = getattr(after, name) / getattr(before, name)
    return math.log(ratio) / math.log(after.cells / before.cells) / 2
