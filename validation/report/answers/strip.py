"""Whether a model is enough, place by place of the range that decides, by the verdicts of all its numbers there."""

from collections.abc import Sequence
from dataclasses import dataclass

from validation.analysis.claim_text import alone_text, conditions_text
from validation.analysis.claims import Choice
from validation.analysis.evidence import OF_NUMBERS, Evidence, Number, Place, Verdict, placed
from validation.analysis.number_text import enumeration, interval_text
from validation.analysis.ranges import SeparatingCondition, by_place, common_verdict, ends_of, separating_conditions

EARLIER_WORDS = {Verdict.WITHIN: "yes", Verdict.OUTSIDE: "no", Verdict.INCONCLUSIVE: "open"}
"""Of a place of a strip, in results.json of schema 1; schema 2 keeps them for one release."""


@dataclass(frozen=True)
class Cell:
    """A place on the axis and the numbers there; lacking: how many series that other places have are missing here.

    axis: the name of the condition that the place is of.
    """

    place: Place
    numbers: tuple[Number, ...]
    lacking: int = 0
    axis: str = ""

    @property
    def verdict(self) -> Verdict:
        """Outside tolerance by one counterexample; inconclusive by one number that is so, and by one that lacks."""
        verdict = common_verdict(self.numbers)
        return Verdict.INCONCLUSIVE if self.lacking and verdict is Verdict.WITHIN else verdict

    @property
    def alone(self) -> str:
        """Under which other conditions alone it has its verdict, as "H = 1 alone"; empty where under all."""
        return alone_text(self._conditions(self.verdict))

    @property
    def by_condition(self) -> str:
        """Each verdict with its conditions: "within tolerance at H = 0.4 to 0.7"; empty where all have one."""
        texts = {verdict: conditions_text(self._conditions(verdict)) for verdict in OF_NUMBERS}
        return "; ".join(f"{verdict} at {text}" for verdict, text in texts.items() if text)

    def _conditions(self, verdict: Verdict) -> tuple[SeparatingCondition, ...]:
        return separating_conditions(self.numbers, verdict, (self.axis,))


@dataclass(frozen=True, kw_only=True)
class Source(Choice):
    """Where the numbers of a model stand.

    case: whose; axis: the condition that decides; printed: its name, by default the same; series: conditions with
    numbers of their own at each place.
    """

    case: str
    axis: str
    printed: str = ""
    series: tuple[str, ...] = ()

    @property
    def over(self) -> str:
        return self.printed or self.axis

    def cells(self, evidence: Evidence) -> list[Cell]:
        """In the order of the axis; names in the order of the numbers."""
        numbers_by_place = by_place(self.chosen(evidence.numbers), self.axis)
        all_series = {self._series(number) for numbers in numbers_by_place.values() for number in numbers}
        return [
            Cell(place, tuple(numbers), len(all_series - {self._series(number) for number in numbers}), self.axis)
            for place, numbers in _joined_overlaps(numbers_by_place).items()
        ]

    def _series(self, number: Number) -> tuple[object, ...]:
        return (number.quantity, *(number.where.get(name) for name in self.series))


def _joined_overlaps(numbers_by_place: dict[Place, list[Number]]) -> dict[Place, list[Number]]:
    """In the order of the axis; ranges that overlap, as where one quantity was measured less far, are one place."""
    joined: dict[Place, list[Number]] = {}
    names = any(isinstance(place, str) for place in numbers_by_place)
    for place in numbers_by_place if names else sorted(numbers_by_place, key=ends_of):
        before = next(reversed(joined), "")
        if isinstance(before, str) or isinstance(place, str) or ends_of(place)[0] >= ends_of(before)[1]:
            joined[place] = numbers_by_place[place]
        else:
            joined_range = (ends_of(before)[0], max(ends_of(before)[1], ends_of(place)[1]))
            joined[joined_range] = [*joined.pop(before), *numbers_by_place[place]]
    return joined


def span(places: Sequence[Place], name: str = "") -> str:
    """ "Fbar = 0.1 to 10", "h' a/d = 0.3", "-10 to 10 dB over ISO 3095", "0.1 to 1", or names."""
    if isinstance(places[0], str):
        return enumeration(list(dict.fromkeys(places)))
    low, high = min(ends_of(place)[0] for place in places), max(ends_of(place)[1] for place in places)
    text = interval_text(low, high, 2)
    return placed(name, text) if name else text
