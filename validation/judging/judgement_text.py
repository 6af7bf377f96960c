"""The text of a judgement: strips and ranges of equal verdict, the largest deviations, and a paragraph for a paper."""

import math
import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib import metadata
from typing import TYPE_CHECKING

from validation.advice.tolerance import Tolerance, decibels
from validation.analysis.number_text import deviation_text, interval_text
from validation.analysis.ranges import VerdictRange, verdict_ranges
from validation.analysis.verdict import Verdict
from validation.judging.judgement import (
    LEVEL,
    JudgedNumber,
    JudgedSeries,
    common_condition,
    conditions_text,
    largest_deviations,
    series_of,
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
    from validation.judging.solvers.checks import SolverTime

COMPARED = (Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE)
"""Verdicts of rows that have a number."""
LINE, STRIPS, LISTED = 110, 24, 6
"""Characters of a line; series of a quantity that are printed; values of a condition that a paper lists."""
NO_SIGN = "rms of the difference over that of the fluctuation, which has no sign"
NOTES = (
    dict.fromkeys((MEAN, DEVIATION, ROLLED_OFF), f"all at {BAND} = {WAVES}")
    | dict.fromkeys((FORCE_LEVEL, RMS, MEAN_FORCE), f"roughness of {about_roughness()}, wheel of {WHEEL}")
    | {APART.format(name): f"{NO_SIGN}; {about_strip()}, wheel of {WHEEL}" for name in ("force", "approach")}
    | {held_out(APART.format(name)): NO_SIGN for name in ("force", "approach")}
)
"""Settings of a quantity that its conditions do not have."""


def summary_lines(judgement: "Judgement") -> Iterator[str]:
    """Of a reduced model."""
    numbers = judgement.numbers
    count = Counter(number.verdict for number in numbers)
    counts = ", ".join(f"{count[verdict]} {verdict}" for verdict in Verdict if count[verdict]) or "none"
    kind, duration = judgement.kind.replace("_", " "), f"{len(numbers)} points in {judgement.seconds:.1f} s"
    yield f"{judgement.model}: {kind}, tolerance {judgement.tolerance}, {duration}: {counts}"
    for remark in judgement.remarks:
        yield from textwrap.wrap(remark.sentence, LINE, initial_indent="! ", subsequent_indent="  ")
    yield f"strips: {', '.join(f'{verdict.sign} {verdict}' for verdict in Verdict)}"
    for series in series_of(numbers):
        along = series[0].along if len(series[0].numbers) > 1 else ""
        note = NOTES.get(series[0].quantity, "")
        yield f"\n{series[0].quantity}{f', along {along}' if along else ''}{f' ({note})' if note else ''}"
        yield from map(strip_line, series[:STRIPS])
        if len(series) > STRIPS:
            yield f"  and {len(series) - STRIPS} more, which --csv writes"
    scenes = [number for number in numbers if number.quantity not in SWEPT]
    if largest := largest_deviations(scenes):
        yield f"\nThe worst{f' {len(largest)}' if len(largest) > 1 else ''}:"
        for number in largest:
            yield f"  {number.quantity}, {conditions_text(number.where) or 'everywhere'}: {number.shown}"
        if largest[0].verdict is Verdict.OUTSIDE and (common := common_condition(largest, scenes)):
            yield f"  They share: {common}."
    yield from closed_form_lines(numbers)
    if judgement.costs:
        yield f"\nMedian error of the {MAIN[judgement.kind]}, and seconds of the call that took longest:"
        for cost in judgement.costs:
            yield f"  {cost.model:32s}{deviation_text(cost.error, cost.unit):>10s}{cost.seconds:10.2g} s"
    yield "\nFor a paper:"
    yield from textwrap.wrap(paragraph(judgement), LINE, initial_indent="  ", subsequent_indent="  ")


def strip_line(series: JudgedSeries) -> str:
    """A sign a number, then the ranges: "within tolerance from 0.464 to 10; outside tolerance at 0.001"."""
    strip, first = "".join(number.verdict.sign for number in series.numbers), series.numbers[0]
    if len(series.numbers) == 1:
        return f"  {conditions_text(first.where) or 'all':32s} {strip}  {first.verdict}: {first.shown}"
    ranges = series.ranges
    parts = {v: " and ".join(_from_to(r.start, r.stop) for r in ranges if r.verdict is v) for v in Verdict}
    sentence = "; ".join(f"{verdict} {part}" for verdict, part in parts.items() if part)
    return f"  {conditions_text(series.where) or 'all':32s} {strip}  {sentence}"


def _from_to(start: float, stop: float) -> str:
    """ "from 0.464 to 10", "at 10"."""
    return f"from {start:.3g} to {stop:.3g}" if stop > start else f"at {start:.3g}"


def closed_form_lines(numbers: Sequence[JudgedNumber]) -> Iterator[str]:
    """Closed forms and asymptotic limits that the model does not follow, and whether it has warned of that.

    Where it follows all, the limits beyond the scenes of its judge.
    """
    closed_forms = [series for group in series_of(numbers) for series in group if series.is_closed_form]
    breaks = [_break_line(series, part) for series in closed_forms for part in series.verdict_ranges]
    limits = [series for series in closed_forms if series.quantity in SWEPT]
    if lines := list(filter(None, breaks)):
        yield "\nWhere it breaks:"
        yield from lines
    elif limits:
        yield "\nBeyond these scenes:"
        for series in limits:
            is_within = all(number.verdict is Verdict.WITHIN for number in series.numbers)
            yield f"  {series.quantity}: {Verdict.WITHIN if is_within else Verdict.INCONCLUSIVE}"


def _break_line(series: JudgedSeries, part: VerdictRange) -> str:
    """The largest deviation of a range; empty where the range is within tolerance or inconclusive."""
    if part.verdict in (Verdict.WITHIN, Verdict.INCONCLUSIVE):
        return ""
    numbers = part.items(series.numbers)
    where = (
        f"{series.along} = {interval_text(part.start, part.stop)}" if series.along else conditions_text(series.where)
    )
    shown = max(numbers, key=lambda number: abs(number.difference)).shown
    silent = ", without a warning" if series.quantity in SWEPT else ""
    warning = next((f", {number.reason}" for number in numbers if number.reason), silent)
    return f"  {series.quantity}, {where}: {shown}{warning if part.verdict is Verdict.OUTSIDE else ''}"


def paragraph(judgement: "Judgement") -> str:
    """Sentences that could stand in a paper: the reference, the tolerance, the conditions, and the results."""
    numbers, tolerance = judgement.numbers, judgement.tolerance
    groups = series_of(numbers)
    of_wheel, version = judgement.kind == "contact_law", metadata.version("mdr-validation")
    reference = f"springs (MDR) under {in_words(table_14_1())}" if of_wheel else "boundary elements"
    sentences = [
        f"The model {judgement.model!r} was compared with {reference}, the references of mdr-validation {version}.",
        f"A number is within {tolerance} where its whole 95 % interval is, by the errors of both.",
    ]
    sentences += [remark.sentence for remark in judgement.remarks]
    sentences += [
        quantity_sentence(tolerance, series)
        for series in groups
        if not series[0].is_closed_form and any(part.has_a_number for part in series)
    ]
    count = Counter(number.verdict for number in numbers)
    total = sum(count[verdict] for verdict in COMPARED)
    if verdicts := [verdict for verdict in COMPARED if count[verdict]]:
        first, *rest = verdicts
        counts = [f"{count[first]} {'is' if count[first] == 1 else 'are'} {first}", *(f"{count[v]} {v}" for v in rest)]
        sentences.append(f"Of {total} points {', '.join(counts)}.")
    closed_forms = [series for group in groups for series in group if series.is_closed_form]
    if broken := [s.quantity for s in closed_forms if any(n.verdict is Verdict.OUTSIDE for n in s.numbers)]:
        sentences.append(f"It contradicts what is known in closed form: {', '.join(dict.fromkeys(broken))}.")
    largest = largest_deviations([number for number in numbers if number.quantity not in SWEPT], 1)
    if largest and largest[0].verdict is Verdict.OUTSIDE:
        where = f" at {text}" if (text := conditions_text(largest[0].where)) else ""
        sentences.append(f"The largest deviation, of its {largest[0].quantity}, is {largest[0].shown}{where}.")
    if lost := len(numbers) - total:
        sentences.append(f"It has no value at {lost} of {len(numbers)} points.")
    return " ".join(sentences)


def quantity_sentence(tolerance: Tolerance, series: Sequence[JudgedSeries]) -> str:
    """The range that is within tolerance in all series of a quantity, or in those that share a condition.

    Without a parameter the count of numbers within tolerance.
    """
    first, numbers = series[0], [number for part in series for number in part.numbers]
    names = dict.fromkeys(name for number in numbers for name in number.where)
    settings = "; ".join(filter(None, (*(_condition_text(name, numbers) for name in names), NOTES.get(first.quantity))))
    settings = f" (compared: {settings})" if settings else ""
    limit = f"{decibels(tolerance.relative):.2g} dB" if numbers[0].unit == LEVEL else str(tolerance)
    if not first.along or max(len(part.numbers) for part in series) == 1:
        within = sum(number.verdict is Verdict.WITHIN for number in numbers)
        return f"Its {first.quantity} is within {limit} at {within} of {len(numbers)} points{settings}."
    varied = [name for name in first.where if len({part.where[name] for part in series}) > 1]
    numeric = [name for name in varied if any(isinstance(part.where[name], float) for part in series)]
    groups, by = {"": list(series)}, ""
    if numeric and not _range_within(series, numeric):
        by = numeric.pop()
        varied.remove(by)
        values = dict.fromkeys(part.where[by] for part in series)
        groups = {_value_text(value): [part for part in series if part.where[by] == value] for value in values}
    values_of_range: dict[str, list[str]] = {}
    for value, group in groups.items():
        if ranges := _range_within(group, numeric):
            values_of_range.setdefault(ranges, []).append(value)
    each = " and ".join(f"every {name}{'' if name in numeric else ' compared there'}" for name in varied)
    each = f" at {each}" if each else ""
    if not values_of_range:
        return f"For no {first.along} its {first.quantity} is within {limit}{each} for certain{settings}."
    each = f",{each}" if by and each else each
    at = f" at {by} = " if by else ""
    places = "; ".join(f"{ranges}{at}{', '.join(values)}" for ranges, values in values_of_range.items())
    return f"Its {first.quantity} is within {limit} for {first.along} = {places}{each}{settings}."


def _range_within(series: Sequence[JudgedSeries], numeric: Sequence[str]) -> str:
    """Ranges that are within tolerance in all of these series.

    A range ends where the series of a value of the numeric conditions have no reference.
    """
    places: dict[tuple[float | str, ...], set[float]] = {}
    lost: set[float] = set()
    for part in series:
        places.setdefault(tuple(part.where[name] for name in numeric), set()).update(part.at)
        pairs = zip(part.at, part.numbers, strict=True)
        lost |= {place for place, number in pairs if number.verdict is not Verdict.WITHIN}
    within = set.intersection(*places.values()) - lost
    ordered = sorted(set().union(*places.values()))
    verdicts = [Verdict.WITHIN if place in within else Verdict.INCONCLUSIVE for place in ordered]
    ranges = [part for part in verdict_ranges(ordered, verdicts) if part.verdict is Verdict.WITHIN]
    return " and ".join(interval_text(part.start, part.stop) for part in ranges)


def _value_text(value: float | str) -> str:
    """Of a condition, to three digits."""
    return f"{value:.3g}" if isinstance(value, float) else value


def _condition_text(name: str, numbers: Sequence[JudgedNumber]) -> str:
    """Of a condition: all values, or their ends, or how many there are."""
    values = list(dict.fromkeys(number.where[name] for number in numbers if name in number.where))
    floats = sorted(value for value in values if isinstance(value, float))
    if len(floats) < len(values):
        return ", ".join(map(str, values)) if len(values) <= LISTED else f"{len(values)} values of {name}"
    texts = ", ".join(f"{x:.0f}" if x.is_integer() else f"{x:.3g}" for x in floats)
    return f"{name} = {texts if len(floats) <= LISTED else interval_text(floats[0], floats[-1])}"


SHOWN = 5
"""Reasons, and problems of each."""
CHECKS = ("complementarity", "penetration", "force balance", "approach", "force", "pressure")
NO_ROW = (*CHECKS, "tension", "answer", "conditions")
UNEXPLAINED = dict.fromkeys(
    (
        "above the residual that it names",
        "a deviation above what its residual allows",
        "force not held",
        "the pressure is another one",
        "the contact shrinks under more load",
        "it falls under more load",
        "the error does not fall with the cell size",
    ),
    1,
)
"""Reasons that name what is measured, and no cause."""


def solver_lines(
    model: str, numbers: Sequence[JudgedNumber], times: Sequence["SolverTime"], seconds: float
) -> Iterator[str]:
    """Of a contact solver."""
    checks = [number for number in numbers if number.decides]
    unserved = [number for number in numbers if not number.decides and number.verdict is Verdict.NOT_SERVED]
    remaining = [n for n in numbers if not n.decides and n.verdict is not Verdict.NOT_SERVED]
    wrong = [number for number in checks if number.verdict is not Verdict.WITHIN]
    result = f"wrong in {len(wrong)} of {len(checks)} checks" if wrong else f"right in all {len(checks)} checks"
    result = result if checks else "without an answer"
    unserved_count = f", {len(unserved)} not served" if unserved else ""
    yield f"{model}: contact solver, {result}{unserved_count}, {seconds:.1f} s"
    yield from reason_lines(wrong)
    yield from unserved_lines(unserved, checks)
    for number in remaining:
        yield f"  {', '.join(filter(None, [number.quantity, conditions_text(number.where)]))}: {number.reason}"
    yield from ["", *problem_lines(checks)]
    if times:
        yield "\nseconds, and relative to bem3d: same grid and residual, one thread, each with its set-up:"
        yield from (f"  {t.cells:.0f}²{t.seconds:12.3g} s{t.seconds / t.bem3d:9.2g} times" for t in times)
    if len(times) > 1:
        power, power_of_bem3d = (growth(times, name) for name in ("seconds", "bem3d"))
        yield f"  its time grows as the number of cells to the power {power:.2g}, that of bem3d {power_of_bem3d:.2g}"
    yield from ["\nFor a paper:", f"  {solver_sentence(model, wrong, checks, unserved)}"]


def solver_sentence(
    model: str,
    wrong: Sequence[JudgedNumber],
    checks: Sequence[JudgedNumber],
    unserved: Sequence[JudgedNumber],
) -> str:
    """For a paper: a result that goes no further than the problems that were solved."""
    failed, count = len(_problems(wrong)), len(_problems(checks))
    verb = f"is wrong on {failed} of the {count}" if wrong else f"solves the {count}" if count else "solves none of the"
    accuracy = "" if wrong or not count else " to its residual, by an operator that is not its own"
    unserved_count = len(_problems(unserved) - _problems(checks))
    limits = f"; {unserved_count} others it does not serve" if unserved else ""
    periodic = {"periodic" in name for name in _problems(checks)}
    half_spaces = "periodic" if True in periodic else "free"
    kind = f" of {half_spaces} half-spaces" if len(periodic) == 1 else ""
    version = metadata.version("mdr-validation")
    return f"{model!r} {verb} discrete problems{kind} of mdr-validation {version}{accuracy}{limits}."


def unserved_lines(unserved: Sequence[JudgedNumber], checks: Sequence[JudgedNumber]) -> Iterator[str]:
    """The problems that a solver declares not to serve, and those that the verdict covers then."""
    if not unserved:
        return
    lost, solved = _problems(unserved), _problems(checks)
    counts = {"of {} others": len(lost - solved), "of {} in part": len(lost & solved)}
    silent = ", and ".join(words.format(count) for words, count in counts.items() if count)
    yield f"  the verdict covers {len(solved)} problems that the solver serves; {silent} it says nothing"
    yield from reason_lines(unserved)


def _problems(numbers: Sequence[JudgedNumber]) -> set[str]:
    """Names of the problems of these numbers."""
    return {str(number.where["problem"]) for number in numbers}


def reason_lines(numbers: Sequence[JudgedNumber]) -> Iterator[str]:
    """Causes before reasons that are none, that of most problems first, each with its quantities and problems."""
    groups: dict[str, list[JudgedNumber]] = {}
    for number in numbers:
        groups.setdefault(number.reason, []).append(number)
    order = sorted(groups, key=lambda reason: (UNEXPLAINED.get(reason, 0), -len(_problems(groups[reason]))))
    for reason in order[:SHOWN]:
        quantities = ", ".join(dict.fromkeys(number.quantity for number in groups[reason]))
        names = list(dict.fromkeys(str(number.where["problem"]) for number in groups[reason]))
        more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
        yield f"  {reason}: {quantities}, in {'; '.join(names[:SHOWN])}{more}"
    if len(order) > SHOWN:
        yield f"  and {len(order) - SHOWN} other reasons"


def problem_lines(checks: Sequence[JudgedNumber]) -> Iterator[str]:
    """A table of relative deviations, a row a problem; then the properties of every half-space."""
    quantities = [name for name in CHECKS if any(number.quantity == name for number in checks)]
    yield f"{'relative deviation':40s}" + "".join(f"{name:>16s}" for name in quantities)
    for problem in dict.fromkeys(str(number.where["problem"]) for number in checks):
        row = {n.quantity: n for n in checks if n.where["problem"] == problem and n.quantity in quantities}
        if row:
            yield f"  {problem:38s}" + "".join(f"{_deviation_cell(row.get(name)):>16s}" for name in quantities)
    properties: dict[str, list[JudgedNumber]] = {}
    for number in checks:
        if number.quantity not in NO_ROW:
            properties.setdefault(number.quantity, []).append(number)
    for name, numbers in properties.items():
        is_within = all(number.verdict is Verdict.WITHIN for number in numbers)
        yield f"  {name:38s}{'holds' if is_within else 'does not hold':>16s}"


def _deviation_cell(number: JudgedNumber | None) -> str:
    """ "1.2e-05", with " !" outside of the tolerance."""
    return f"{abs(number.difference):.1e}{'' if number.verdict is Verdict.WITHIN else ' !'}" if number else ""


def growth(times: Sequence["SolverTime"], name: str) -> float:
    """Power of the number of cells, between the two finest grids."""
    before, after = times[-2:]
    ratio = getattr(after, name) / getattr(before, name)
    return math.log(ratio) / math.log(after.cells / before.cells) / 2
