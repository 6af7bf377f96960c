"""Ranges of equal verdict along a parameter, and the conditions on which a verdict depends."""

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TypeVar

from validation.analysis.evidence import Number, Place, Verdict

Item = TypeVar("Item")
WORST_AT = "worst at"
"""Among the conditions of a number, and none itself: the place in a range where it is the worst."""


@dataclass(frozen=True)
class VerdictRange:
    """Neighbouring places of one verdict along a parameter.

    places: in their order; first: position of the first of them among all; split: the value of what else keeps
    neighbours apart, as a condition that alone has the verdict.
    """

    verdict: Verdict
    places: tuple[Place, ...]
    first: int
    split: Hashable = None

    @property
    def start(self) -> float:
        """Lower end of the first place. Raises TypeError for a region by its name."""
        return ends_of(self.places[0])[0]

    @property
    def stop(self) -> float:
        """Upper end of the last place. Raises TypeError for a region by its name."""
        return ends_of(self.places[-1])[1]

    def items(self, items: Sequence[Item]) -> Sequence[Item]:
        """Those at its places. items: one for each place along the parameter."""
        return items[self.first : self.first + len(self.places)]


def ends_of(place: Place) -> tuple[float, float]:
    """Both ends of a range; of a value, twice the value. Raises TypeError for a region by its name."""
    if isinstance(place, str):
        raise TypeError(f"place must be a value or a range, got {place!r}")
    return place if isinstance(place, tuple) else (place, place)


def verdict_ranges(
    places: Sequence[Place], verdicts: Sequence[Verdict], split: Sequence[Hashable] | None = None
) -> list[VerdictRange]:
    """Ranges of equal verdict, in the order of the places.

    split: a value each, by which neighbours of one verdict stay apart where it differs. Raises ValueError where the
    lengths differ.
    """
    rows = list(zip(places, verdicts, split if split is not None else [None] * len(places), strict=True))
    ranges: list[VerdictRange] = []
    for (verdict, value), group in groupby(rows, lambda row: (row[1], row[2])):
        first = ranges[-1].first + len(ranges[-1].places) if ranges else 0
        ranges.append(VerdictRange(verdict, tuple(row[0] for row in group), first, value))
    return ranges


def common_verdict(numbers: Iterable[Number]) -> Verdict:
    """Outside tolerance by a single number that is so, within tolerance only if all are."""
    verdicts = {number.verdict for number in numbers}
    if Verdict.OUTSIDE in verdicts:
        return Verdict.OUTSIDE
    return Verdict.WITHIN if verdicts == {Verdict.WITHIN} else Verdict.INCONCLUSIVE


def by_place(numbers: Iterable[Number], name: str) -> dict[Place, list[Number]]:
    """Numbers under each value of a condition, without those that do not have it.

    Values and ranges ascend; where regions are among them all stand in the order of the numbers.
    """
    groups: dict[Place, list[Number]] = {}
    for number in numbers:
        if name in number.where:
            groups.setdefault(number.where[name], []).append(number)
    return groups if are_regions(groups) else {place: groups[place] for place in sorted(groups, key=ends_of)}


def are_regions(places: Iterable[Place]) -> bool:
    """Whether one of them is a region by its name, so that they have no order of their own."""
    return any(isinstance(place, str) for place in places)


def worst_place(number: Number) -> dict[str, Place]:
    """The conditions of a number, with its place in a range instead of the range over which it is the worst."""
    conditions = dict(number.where)
    if WORST_AT in conditions:
        name = next(name for name in reversed(list(conditions)) if isinstance(conditions[name], tuple))
        conditions[name] = conditions.pop(WORST_AT)
    return conditions


MANY, MOST = 3, 4
"""Neighbours that are a range, and values that still are a summary."""


@dataclass(frozen=True)
class SeparatingCondition:
    """A condition on which a verdict depends.

    values: under which alone numbers have the verdict, in their order; is_range: whether they are `MANY` neighbours or
    more.
    """

    name: str
    values: tuple[Place, ...]
    is_range: bool


def separating_conditions(
    numbers: Sequence[Number], verdict: Verdict, named: Iterable[str] = ()
) -> tuple[SeparatingCondition, ...]:
    """Conditions under some values of which alone these numbers have a verdict.

    numbers: of one place, those under one value of a condition judged by their worst; named: conditions that stand in
    the text anyway. One condition after the other, until all numbers under those that are named have the verdict. Empty
    where numbers under all values have it, or under none. The range over which a number is the worst is no condition.
    """
    conditions, remaining = list[SeparatingCondition](), list(numbers)
    names = dict.fromkeys(name for number in numbers for name in number.where)
    for name in (name for name in names if name not in {*named, WORST_AT}):
        groups = by_place(remaining, name)
        values = [value for value in groups if not isinstance(value, tuple)]
        ranges = verdict_ranges(values, [common_verdict(groups[value]) for value in values])
        separate = _separate(name, [part for part in ranges if part.verdict is verdict])
        if separate and len(separate.values) < len(values):
            conditions.append(separate)
            remaining = [number for value in separate.values for number in groups[value]]
        if all(number.verdict is verdict for number in remaining):
            break
    return tuple(conditions)


def _separate(name: str, ranges: Sequence[VerdictRange]) -> SeparatingCondition | None:
    """The values of ranges of one verdict; None where they are too many to be listed and no single range."""
    values = tuple(value for part in ranges for value in part.places)
    is_range = len(ranges) == 1 and len(values) >= MANY
    return SeparatingCondition(name, values, is_range) if values and (is_range or len(values) <= MOST) else None
