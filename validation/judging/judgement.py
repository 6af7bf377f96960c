"""Numbers of a model relative to their references, the verdict of each, and what they say together, as fields."""

import math
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from operator import attrgetter
from typing import NamedTuple, TypeVar

from validation.advice.tolerance import decibels
from validation.analysis.contents import conditions_in_json
from validation.analysis.escapes import one_line
from validation.analysis.evidence import Number, Role, Verdict, verdict_of, where_text
from validation.analysis.number_text import deviation_text, interval_text
from validation.analysis.ranges import VerdictRange, verdict_ranges

RATIO, LEVEL, DEVIATION = "-", "dB", "over the mean"
"""Units, by which a number is compared with its reference."""
AGAIN = "the same problem again"
"""Quantity of the number that says whether a model has one answer to one problem."""
UNTRUSTED = "one problem has more than one answer"
SMALL = 0.01
"""A reference deviation below it is judged by the absolute difference, in parts of it."""
WITHOUT_NUMBER = (Verdict.NOT_SERVED, Verdict.NO_RESULT)
ROUNDING = 1e-9
"""Relative to the tolerance: a level that a closed form gives differs in its last digits."""
Conditions = Mapping[str, float | str]
Item = TypeVar("Item")
Key = TypeVar("Key", bound=Hashable)


@dataclass(frozen=True)
class JudgedNumber:
    """One number of a model beside its reference.

    Attributes
    ----------
    quantity : str
        What was computed.
    where : Mapping
        The conditions, by name.
    value, reference : float
        Of the model and of the reference, in one unit; NaN where there is none.
    difference : float
        The relative deviation value / reference - 1; of levels value - reference [dB].
    error : float
        Half-width of the 95 % interval of the difference, in the same unit: by sample and grid of the reference and by
        the sample of the model.
    verdict : Verdict
        By `verdict_of`; without a number NOT_SERVED or NO_RESULT.
    reason : str
        Why there is no number, or how it is judged.
    unit : str
        Of the difference: "-" for a ratio, "dB" for a level.
    decides : bool
        Whether a solver is wrong whose number is not within tolerance.
    tolerance : float
        In the unit of the difference; NaN where no tolerance has given the verdict.
    grid : float
        The part of the error that is the discretisation error, which is added linearly.

    Examples
    --------
    >>> @validation.stiffness_model("flat punch")
    ... def flat(side, modulus):
    ...     return 1.1523 * modulus * side
    >>> first = validation.judge(flat).numbers[0]
    >>> first.quantity, str(first.verdict)
    ('mean stiffness', 'outside tolerance')
    """

    quantity: str
    where: Conditions
    value: float
    reference: float
    difference: float
    error: float
    verdict: Verdict
    reason: str = ""
    unit: str = RATIO
    decides: bool = False
    tolerance: float = math.nan
    grid: float = 0.0

    def __repr__(self) -> str:
        where = f" at {where_text(self.where)}" if self.where else ""
        return one_line(f"JudgedNumber({str(self.quantity)!r}{where}: {self.shown}, {self.verdict})")

    @property
    def conditions(self) -> dict[str, float | str]:
        """`where` by the names of JSON and CSV, as wavelength_mm."""
        return conditions_in_json(self.where)

    @property
    def outcome(self) -> str:
        """The verdict as a text, as JSON and CSV have it."""
        return str(self.verdict)

    @property
    def shown(self) -> str:
        """The difference with its half-width: "+12 ± 3 %", or the reason."""
        if not math.isfinite(self.difference):
            return self.reason
        if not math.isfinite(self.error):
            return f"{deviation_text(self.difference, self.unit, sign='+')}, of unknown error: {self.reason}"
        return f"{deviation_text(self.difference, self.unit, sign='+')} ± {deviation_text(self.error, self.unit)}"

    @property
    def number(self) -> Number | None:
        """The difference as a number of a report, whose reference is zero; None where a part of it is not finite."""
        if not all(map(math.isfinite, (self.difference, self.error, self.tolerance, self.grid))):
            return None
        return Number(
            quantity=self.quantity,
            where=self.where,
            value=self.difference,
            reference=0.0,
            source="reference of the judges",
            tolerance=self.tolerance,
            reason=self.reason or "tolerance of the judgement",
            unit=self.unit,
            grid=self.grid,
            sample=max(self.error - self.grid, 0.0),
            role=Role.CRITERION if self.decides else Role.FINDING,
        )


def judged_number(
    quantity: str,
    where: Conditions,
    value: float,
    reference: float,
    half_width: float,
    tolerance: float,
    *,
    unit: str = RATIO,
    reason: str = "",
    grid: float = 0.0,
) -> JudgedNumber:
    """By the ratio; by the difference of levels, of which a tolerance t is 20 lg(1 + t) dB; and deviations by the ratio
    from 1 % on, below by their absolute difference, as a part of 1 %.

    half_width: of the 95 % interval, over the value, or in dB, of both together; grid: the part of it that the grid
    leaves.
    """
    difference, error_of_half_width = value / reference - 1, abs(value / reference)
    if unit == LEVEL:
        difference, error_of_half_width, tolerance = value - reference, 1.0, decibels(tolerance)
    elif unit == DEVIATION and reference < SMALL:
        difference, error_of_half_width = (value - reference) / SMALL, max(value, reference) / SMALL
        reason = reason or "below 1 %: the absolute difference, in parts of 1 %"
    error = error_of_half_width * half_width
    return JudgedNumber(
        quantity,
        where,
        value,
        reference,
        difference,
        error,
        verdict_of(difference, error, tolerance, rounding=ROUNDING),
        reason,
        LEVEL if unit == LEVEL else RATIO,
        tolerance=tolerance,
        grid=error_of_half_width * grid,
    )


def missing_number(
    quantity: str,
    where: Conditions,
    verdict: Verdict,
    reason: str,
    *,
    reference: float = math.nan,
    unit: str = RATIO,
    decides: bool = False,
) -> JudgedNumber:
    """A row without a number of the model. verdict: NOT_SERVED or NO_RESULT, else ValueError."""
    if verdict not in WITHOUT_NUMBER:
        raise ValueError(f"verdict of a row without a number must be {' or '.join(WITHOUT_NUMBER)}, got {verdict}")
    return JudgedNumber(quantity, where, math.nan, reference, math.nan, math.nan, verdict, reason, unit, decides)


def trusted_numbers(numbers: Sequence[JudgedNumber]) -> list[JudgedNumber]:
    """The same numbers; INCONCLUSIVE, where a model has more than one answer to one problem."""
    if all(number.verdict is Verdict.WITHIN for number in numbers if number.quantity == AGAIN):
        return list(numbers)
    return [
        replace(number, verdict=Verdict.INCONCLUSIVE, reason=UNTRUSTED, tolerance=math.nan)
        if number.quantity != AGAIN and number.verdict in (Verdict.WITHIN, Verdict.OUTSIDE)
        else number
        for number in numbers
    ]


class SolverTime(NamedTuple):
    """Seconds of a solver and of `bem3d` on one grid, of so many cells on a side: neither right nor wrong."""

    cells: float
    seconds: float
    bem3d: float


@dataclass(frozen=True)
class JudgedRange:
    """Neighbouring numbers of one verdict.

    Attributes
    ----------
    quantity : str
        What was computed.
    where : Mapping
        The conditions but for the parameter, by name.
    along : str
        The parameter, empty where there is none.
    start, stop : float
        Its values at the first and the last number, ascending, in its own unit; NaN without a parameter.
    verdict : Verdict
        Of each of the numbers.

    Examples
    --------
    >>> @validation.stiffness_model("flat punch")
    ... def flat(side, modulus):
    ...     return 1.1523 * modulus * side
    >>> validation.judge(flat).ranges[0]
    JudgedRange('mean stiffness' at H = 0.4, Fbar = 0.001 to 2.15: outside tolerance)
    """

    quantity: str
    where: Conditions
    along: str
    start: float
    stop: float
    verdict: Verdict

    def __repr__(self) -> str:
        along = f"{self.along} = {interval_text(self.start, self.stop)}" if self.along else "all"
        where = f" at {where_text(self.where)}" if self.where else ""
        return one_line(f"JudgedRange({str(self.quantity)!r}{where}, {along}: {self.verdict})")

    @property
    def conditions(self) -> dict[str, float | str]:
        """`where` by the names of JSON and CSV."""
        return conditions_in_json(self.where)

    @property
    def outcome(self) -> str:
        """The verdict as a text."""
        return str(self.verdict)


@dataclass(frozen=True)
class JudgedSeries:
    """Numbers of a quantity under equal conditions, ascending along the condition that has most values."""

    quantity: str
    where: Conditions
    along: str
    numbers: Sequence[JudgedNumber]

    @property
    def at(self) -> list[float]:
        """Values of the parameter, NaN without one."""
        return [float(number.where.get(self.along, math.nan)) for number in self.numbers]

    @property
    def is_closed_form(self) -> bool:
        """Whether every model must follow it, as its references say, which are one; no result that a paper states."""
        return all(number.reference == 1 for number in self.numbers)

    @property
    def has_a_number(self) -> bool:
        """False where the model serves none of it, or fails everywhere."""
        return any(math.isfinite(number.difference) for number in self.numbers)

    @property
    def verdict_ranges(self) -> list[VerdictRange]:
        """Neighbouring values of the parameter of one verdict."""
        return verdict_ranges(self.at, [number.verdict for number in self.numbers])


def groups_of(items: Iterable[Item], key: Callable[[Item], Key]) -> dict[Key, list[Item]]:
    """Items under each key, both in their order."""
    groups: dict[Key, list[Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def series_of(numbers: Iterable[JudgedNumber]) -> list[list[JudgedSeries]]:
    """A list a quantity, in the order of the numbers."""
    groups = groups_of(numbers, lambda number: (number.quantity, *sorted(number.where)))
    series = [part for group in groups.values() for part in _series(group)]
    return [list(of_quantity) for _, of_quantity in groupby(series, attrgetter("quantity"))]


def _series(numbers: Sequence[JudgedNumber]) -> Iterator[JudgedSeries]:
    """Numbers of one quantity with the same names of conditions: the one with most values is the parameter."""
    names = [name for name, value in numbers[0].where.items() if not isinstance(value, str)]
    along = max(names, key=lambda name: len({number.where[name] for number in numbers}), default="")

    def rest_of(number: JudgedNumber) -> Conditions:
        return {name: value for name, value in number.where.items() if name != along}

    for group in groups_of(numbers, lambda number: where_text(rest_of(number))).values():
        ordered = sorted(group, key=lambda number: float(number.where.get(along, 0.0)))
        yield JudgedSeries(numbers[0].quantity, rest_of(ordered[0]), along, ordered)


def ranges_of(numbers: Iterable[JudgedNumber]) -> list[JudgedRange]:
    """Of all series of these numbers."""
    return [
        JudgedRange(series.quantity, series.where, series.along, part.start, part.stop, part.verdict)
        for of_quantity in series_of(numbers)
        for series in of_quantity
        for part in series.verdict_ranges
    ]


def counts_of(numbers: Sequence[JudgedNumber]) -> dict[Verdict, int]:
    """Of each verdict that there is, how many numbers have it."""
    counts = {verdict: sum(number.verdict is verdict for number in numbers) for verdict in Verdict}
    return {verdict: count for verdict, count in counts.items() if count}


Ranges = tuple[tuple[float, float], ...]
"""Both ends of each."""


@dataclass(frozen=True)
class WithinRanges:
    """Where a quantity is within tolerance in all of its series.

    values: the ranges of the parameter, each with the values of `by` that have it; by: a numeric condition, empty where
    all series have the same ranges; every: other conditions, under each of whose values they hold; numeric: of these.
    """

    values: Mapping[Ranges, Sequence[float | str]]
    by: str
    every: Sequence[str]
    numeric: Sequence[str]


def within_ranges(series: Sequence[JudgedSeries]) -> WithinRanges:
    """Of all series; where these have no range in common, by the last numeric condition in which they differ."""
    varied = [name for name in series[0].where if len({part.where[name] for part in series}) > 1]
    numeric = [name for name in varied if any(isinstance(part.where[name], float) for part in series)]
    if (ranges := _common_ranges(series, numeric)) or not numeric:
        return WithinRanges({ranges: ()} if ranges else {}, "", varied, numeric)
    *numeric, by = numeric
    groups = groups_of(series, lambda part: part.where[by])
    ranges_of_value = {value: _common_ranges(group, numeric) for value, group in groups.items()}
    values = groups_of((value for value, ranges in ranges_of_value.items() if ranges), ranges_of_value.__getitem__)
    return WithinRanges(values, by, [name for name in varied if name != by], numeric)


def _common_ranges(series: Sequence[JudgedSeries], numeric: Sequence[str]) -> Ranges:
    """Those that are within tolerance in all of these series.

    A range ends where the series of a value of the numeric conditions have no reference.
    """
    pairs = [pair for part in series for pair in zip(part.at, part.numbers, strict=True)]
    groups = groups_of(series, lambda part: tuple(part.where[name] for name in numeric)).values()
    within = set.intersection(*({place for part in group for place in part.at} for group in groups))
    within -= {place for place, number in pairs if number.verdict is not Verdict.WITHIN}
    places = sorted({place for place, _ in pairs})
    parts = verdict_ranges(places, [Verdict.WITHIN if x in within else Verdict.INCONCLUSIVE for x in places])
    return tuple((part.start, part.stop) for part in parts if part.verdict is Verdict.WITHIN)


def largest_deviations(numbers: Iterable[JudgedNumber], count: int = 5) -> list[JudgedNumber]:
    """Numbers outside of the tolerance, the farthest first, then rows without a number.

    By the logarithm of the ratio that the interval excludes least: |difference| - error, a level as 10^(L/20).
    """

    def distance(number: JudgedNumber) -> float:
        certain = math.copysign(max(abs(number.difference) - number.error, 0.0), number.difference)
        factor = 10 ** (abs(certain) / 20) if number.unit == LEVEL else 1 + certain
        return abs(math.log(max(factor, 1e-12)))

    numbers = list(numbers)
    outside = sorted((number for number in numbers if number.verdict is Verdict.OUTSIDE), key=distance, reverse=True)
    return [*outside, *(number for number in numbers if number.verdict in WITHOUT_NUMBER)][:count]


def common_condition(part: Sequence[JudgedNumber], numbers: Sequence[JudgedNumber]) -> str:
    """The condition that a part of the numbers has in common and not all have; empty where there is none."""
    texts = []
    for name in part[0].where if len(part) > 1 else ():
        of_part = [number.where.get(name) for number in part]
        of_all = [number.where[name] for number in numbers if name in number.where]
        if len(set(of_part)) == 1 and len(set(of_all)) > 1:
            texts.append(where_text({name: part[0].where[name]}))
        elif all(isinstance(value, float) for value in (*of_part, *of_all)):
            values, ordered = [float(value) for value in of_part if value is not None], sorted(map(float, of_all))
            if max(values) < ordered[len(ordered) // 2]:
                texts.append(f"{name} up to {max(values):g}")
            elif min(values) > ordered[len(ordered) // 2]:
                texts.append(f"{name} from {min(values):g} on")
    return ", ".join(texts)
