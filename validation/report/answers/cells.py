"""Whether a model is enough, place by place of the range that decides, by the verdicts of all its numbers there."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import groupby

from validation.analysis.evidence import Evidence, Number, Place, Verdict
from validation.analysis.wording import joint_verdict

DECIBELS = "dB "
"""An axis that begins with its unit follows its numbers."""


class Enough(StrEnum):
    """What a cell says: yes where all numbers agree, no where one differs, else open."""

    YES = "yes"
    NO = "no"
    OPEN = "open"


@dataclass(frozen=True)
class RangeCell:
    """A place on the axis and the numbers there; lacking: how many series that other places have are missing here."""

    place: Place
    numbers: tuple[Number, ...]
    lacking: int = 0

    @property
    def enough(self) -> Enough:
        """One counterexample is enough for no; one that is undecided, and one that lacks, leaves it open."""
        verdict = joint_verdict(self.numbers)
        if verdict is Verdict.DIFFER:
            return Enough.NO
        return Enough.YES if verdict is Verdict.AGREE and not self.lacking else Enough.OPEN


@dataclass(frozen=True, kw_only=True)
class NumberSource:
    """Where the numbers of a model stand.

    case, quantities, model: of their keys; axis: the condition that decides; series: conditions with numbers of their
    own at each place; place: of a number on the axis, where its conditions do not have it; keep: which of the numbers.
    """

    case: str
    quantities: tuple[str, ...]
    model: str
    axis: str
    series: tuple[str, ...] = ()
    place: Callable[[Evidence, Number], Place] | None = field(default=None)
    keep: Callable[[Number], bool] = field(default=lambda number: True)

    def numbers(self, evidence: Evidence) -> list[Number]:
        return [
            number
            for quantity in self.quantities
            for number in evidence.numbers
            if number.matches(quantity, self.model) and self.axis in number.where and self.keep(number)
        ]

    def cells(self, evidence: Evidence) -> list[RangeCell]:
        """In the order of the axis; names in the order of the numbers."""
        found: dict[Place, list[Number]] = {}
        for number in self.numbers(evidence):
            place = self.place(evidence, number) if self.place else number.where[self.axis]
            found.setdefault(place, []).append(number)
        every = {self._series(number) for numbers in found.values() for number in numbers}
        if not any(isinstance(place, str) for place in found):
            found = _apart(found)
        return [
            RangeCell(place, tuple(numbers), len(every - {self._series(number) for number in numbers}))
            for place, numbers in found.items()
        ]

    def _series(self, number: Number) -> tuple[object, ...]:
        return (number.quantity, *(number.where.get(name) for name in self.series))


def _apart(found: Mapping[Place, list[Number]]) -> dict[Place, list[Number]]:
    """In the order of the axis; ranges that overlap, as where one quantity was measured less far, are one place."""
    joined: list[tuple[Place, list[Number]]] = []
    for place in sorted(found, key=ends):
        low, high = ends(place)
        if joined and low < ends(joined[-1][0])[1]:
            before, numbers = joined.pop()
            joined.append(((ends(before)[0], max(high, ends(before)[1])), [*numbers, *found[place]]))
        else:
            joined.append((place, found[place]))
    return dict(joined)


def ends(place: Place) -> tuple[float, float]:
    """Of a range, or twice the value."""
    if isinstance(place, str):
        raise ValueError(f"place must be a value or a range, got {place!r}")
    return place if isinstance(place, tuple) else (place, place)


def runs(cells: Sequence[RangeCell], enough: Enough) -> list[list[RangeCell]]:
    """Neighbouring cells that say it."""
    groups = groupby(cells, key=lambda cell: cell.enough)
    return [list(group) for found, group in groups if found is enough]


def span(cells: Sequence[RangeCell], axis: str) -> str:
    """ "from Fbar = 0.1 to 10", "at h' a/d = 0.3", "from -10 to 10 dB over the curve", or names."""
    places = [cell.place for cell in cells]
    if any(isinstance(place, str) for place in places):
        return f"in {', '.join(map(str, places))}"
    low, high = ends(places[0])[0], ends(places[-1])[1]
    if axis.startswith(DECIBELS):
        return f"at {low:.2g} {axis}" if low == high else f"from {low:.2g} to {high:.2g} {axis}"
    return f"at {axis} = {low:.2g}" if low == high else f"from {axis} = {low:.2g} to {high:.2g}"
