"""Sentences of a claim: the fields of its outcome, and a template for each pattern of answer and of headline."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from validation.analysis.evidence import ClaimStatus, Number, Place, Verdict, VerdictCell, placed
from validation.analysis.number_text import Printer, enumeration, place_text, tolerance_text
from validation.analysis.ranges import WORST_AT, SeparatingCondition, are_regions, worst_place

QUANTITY = "quantity"
"""The condition of a claim that holds for some quantities."""


class Direction(StrEnum):
    """Where a value lies relative to its reference, as a verb and a comparative."""

    ABOVE = "above"
    BELOW = "below"
    EQUAL = "equal"


@dataclass(frozen=True, kw_only=True)
class ClaimOutcome:
    """What the numbers of a claim say, as fields.

    Attributes
    ----------
    status : ClaimStatus
        By the verdicts of all numbers.
    number : Number
        The worst of those that have the last word on the status.
    is_single, has_one_tolerance : bool
        Whether it is the only number, and whether all have its tolerance.
    labels : tuple of str
        Its quantity and its model, where not all numbers have these.
    conditions : tuple of SeparatingCondition
        Under which alone numbers at its place have its verdict.
    differ : bool
        Whether the claim is that two things differ.
    along, descending : str, bool
        The condition up to which the claim may hold, or from which on.
    limits, inside : tuple
        Places where the claim holds within limits, and the numbers there.
    only_within : tuple of Place
        Places within tolerance where a claim has no limits.
    inconclusive, inconclusive_conditions : tuple
        Places next to these that are not outside tolerance, where some farther ones are; the conditions under which
        alone they are inconclusive.
    """

    status: ClaimStatus
    number: Number
    is_single: bool
    has_one_tolerance: bool
    labels: tuple[str, ...] = ()
    conditions: tuple[SeparatingCondition, ...] = ()
    differ: bool = False
    along: str = ""
    descending: bool = False
    limits: tuple[Place, ...] = ()
    inside: tuple[Number, ...] = ()
    only_within: tuple[Place, ...] = ()
    inconclusive: tuple[Place, ...] = ()
    inconclusive_conditions: tuple[SeparatingCondition, ...] = ()

    @property
    def size(self) -> float:
        """Distance of the number from its reference, in its unit."""
        return abs(self.number.difference)

    @property
    def half_width(self) -> float:
        return self.number.uncertainty

    @property
    def tolerance(self) -> float:
        return self.number.tolerance

    @property
    def direction(self) -> Direction:
        if not self.size:
            return Direction.EQUAL
        return Direction.ABOVE if self.number.difference > 0 else Direction.BELOW

    @property
    def worst_place(self) -> dict[str, Place]:
        """Conditions of the number, with its place in the range over which it is the worst."""
        return worst_place(self.number)

    @property
    def range(self) -> tuple[float, float] | None:
        """Over which the number is the worst; None of a number at a point."""
        ranges = [place for place in self.number.where.values() if isinstance(place, tuple)]
        return ranges[-1] if WORST_AT in self.number.where else None


REFUTED = "Refuted"
NOT_THIS_CURVE = "We do not get this curve"
THREE_D_DIFFER = "We get this curve, and three dimensions differ"
"""Words of a statement of the book that is refuted: which of the two it is."""


class AnswerPattern(StrEnum):
    """Templates of an answer: the size, where it is worst, and the limit.

    worst: the number that decides, with its place and conditions; rank: "at worst" or "the nearest is", of several;
    ranges: where a claim is within tolerance only, and where inconclusive; rest: of the range beyond the limits.
    """

    SUPPORTED = "Supported, within {tolerance}: {rank}{worst}."
    SUPPORTED_BY_TOLERANCES = "Supported: at worst {worst}, within {tolerance}."
    SUPPORTED_DIFFERENCE = "Supported, by more than {tolerance}: {rank}{worst}."
    LIMITED = "Supported {limits}, within {tolerance}{ranges}; {rest} {worst}."
    LIMITED_INCONCLUSIVE = "Supported {limits}, within {tolerance}{ranges}; inconclusive {rest}: {worst}."
    INCONCLUSIVE = "Inconclusive within {tolerance}: {worst}{ranges}."
    REFUTED = "{refuted}: {worst}, tolerance {tolerance}{ranges}."
    REFUTED_DIFFERENCE = "{refuted}: {worst}, within {tolerance}{ranges}."


class HeadlinePattern(StrEnum):
    """Templates of a headline: subject, verb and object in a clause, with the tolerance or the number that decides."""

    SUPPORTED = "{clause}: {rank}{number}"
    SUPPORTED_AGREEMENT = "{clause} within {tolerance}"
    LIMITED = "{clause} {limits}"
    LIMITED_AGREEMENT = "{clause} within {tolerance} {limits}"
    REFUTED = "Not so that {inner_clause}: {number}"
    REFUTED_AGREEMENT = "{denial}: {number}"
    INCONCLUSIVE = "Inconclusive whether {inner_clause}: {number}"
    INCONCLUSIVE_AGREEMENT = "Inconclusive whether {inner_clause} within {tolerance}: {number}"


def answer_pattern(outcome: ClaimOutcome) -> AnswerPattern:
    match outcome.status:
        case ClaimStatus.SUPPORTED if outcome.differ:
            return AnswerPattern.SUPPORTED_DIFFERENCE
        case ClaimStatus.SUPPORTED:
            return AnswerPattern.SUPPORTED if outcome.has_one_tolerance else AnswerPattern.SUPPORTED_BY_TOLERANCES
        case ClaimStatus.LIMITED:
            is_open = outcome.number.verdict is Verdict.INCONCLUSIVE
            return AnswerPattern.LIMITED_INCONCLUSIVE if is_open else AnswerPattern.LIMITED
        case ClaimStatus.INCONCLUSIVE:
            return AnswerPattern.INCONCLUSIVE
    return AnswerPattern.REFUTED_DIFFERENCE if outcome.differ else AnswerPattern.REFUTED


def headline_pattern(outcome: ClaimOutcome, clause: str) -> HeadlinePattern:
    """An agreement is denied by its verb, and has its tolerance where there is one."""
    is_agreement = AGREE.search(clause) is not None and not outcome.differ
    if outcome.status is ClaimStatus.REFUTED:
        return HeadlinePattern.REFUTED_AGREEMENT if is_agreement else HeadlinePattern.REFUTED
    name = {ClaimStatus.SUPPORTED: "SUPPORTED", ClaimStatus.LIMITED: "LIMITED"}.get(outcome.status, "INCONCLUSIVE")
    return HeadlinePattern[f"{name}_AGREEMENT" if is_agreement and outcome.has_one_tolerance else name]


def answer_text(outcome: ClaimOutcome, printer: Printer, refuted: str = REFUTED) -> str:
    """One sentence. refuted: the words before a number that refutes it."""
    labels = f" ({', '.join(outcome.labels)})" if outcome.labels else ""
    return answer_pattern(outcome).format(
        worst=f"{_number_text(outcome, printer)}{labels}{_in_brackets(outcome.conditions)}",
        tolerance=tolerance_text(outcome.number, printer),
        rank=_rank(outcome),
        limits=limits_text(outcome),
        ranges=_ranges_text(outcome),
        rest=_rest_text(outcome),
        refuted=refuted,
    )


def headline_text(outcome: ClaimOutcome, printer: Printer, clause: str) -> str:
    return headline_pattern(outcome, clause).format(
        clause=clause,
        inner_clause=in_sentence(clause),
        denial=AGREE.sub(lambda verb: f"differ{verb[1]} from", clause),
        number=_number_text(outcome, printer),
        tolerance=tolerance_text(outcome.number, printer),
        rank=_rank(outcome),
        limits=limits_text(outcome),
    )


AGREE = re.compile(r"\bagree(s?) with\b")
"""The verb of a clause, in the singular or not."""


def in_sentence(clause: str) -> str:
    """The clause with a small first letter; a name that begins with two capitals, as BEM, keeps them."""
    return clause if clause[:2].isalpha() and clause[:2].isupper() else clause[:1].lower() + clause[1:]


def _rank(outcome: ClaimOutcome) -> str:
    if outcome.is_single:
        return ""
    return "the nearest is " if outcome.differ else "at worst "


def _number_text(outcome: ClaimOutcome, printer: Printer) -> str:
    """The number that decides, and where: "+3.00 ± 0.10 dB at h/d = 1, q a = 2"."""
    conditions = outcome.worst_place
    texts = [place if isinstance(place, str) else placed(name, place_text(place)) for name, place in conditions.items()]
    preposition = ", " if conditions and isinstance(next(iter(conditions.values())), str) else " at "
    return f"{printer(outcome.number)}{preposition}{', '.join(texts)}" if texts else printer(outcome.number)


def limits_text(outcome: ClaimOutcome) -> str:
    """ "up to h/d = 1", "from q a = 2 on", "in gradient and curvature", "from ridges to alpha = 1"; else empty."""
    if not outcome.limits:
        return ""
    first, last = outcome.limits[0], outcome.limits[-1]
    if _is_span(outcome):
        return f"from {place_text(first)} to {place_text(last)}"
    if are_regions(outcome.limits):
        return _names_text(outcome, outcome.limits)
    end = last[0 if outcome.descending else 1] if isinstance(last, tuple) else last
    text = placed(outcome.along, place_text(end))
    return f"from {text} on" if outcome.descending else f"up to {text}"


def _rest_text(outcome: ClaimOutcome) -> str:
    """The places beyond the limits: "beyond that", "below that", "elsewhere"."""
    if are_regions(outcome.limits) and not _is_span(outcome):
        return "elsewhere"
    return "below that" if outcome.descending else "beyond that"


def _is_span(outcome: ClaimOutcome) -> bool:
    """Whether limits of regions are named by the first and the last of them."""
    return are_regions(outcome.limits) and outcome.along != QUANTITY and len(outcome.limits) > 2


def _names_text(outcome: ClaimOutcome, places: Sequence[Place]) -> str:
    return f"{'in' if outcome.along == QUANTITY else 'for'} {enumeration(list(map(place_text, places)))}"


def _places_text(outcome: ClaimOutcome, places: Sequence[Place]) -> str:
    """ "at h/d = 0.1", "at -5 to 0 dB over ISO 3095", "for ridges and alpha = 0.25"."""
    if are_regions(places):
        return _names_text(outcome, places)
    ends = [end for place in places for end in np.atleast_1d(place).tolist()]
    return f"at {placed(outcome.along, place_text((min(ends), max(ends)) if len(set(ends)) > 1 else ends[0]))}"


def _ranges_text(outcome: ClaimOutcome) -> str:
    """Where a claim without limits is within tolerance, and where the range next to that is inconclusive."""
    text = ""
    if outcome.only_within:
        text += f"; within tolerance only {_places_text(outcome, outcome.only_within)}"
    if outcome.inconclusive:
        text += f"; inconclusive {_places_text(outcome, outcome.inconclusive)}"
    return text + _in_brackets(outcome.inconclusive_conditions)


def conditions_text(conditions: Sequence[SeparatingCondition]) -> str:
    """ "H = 1", "H = 0.4 and 0.55", "H = 0.4 to 0.85", of several "H = 1, q = 2"; empty without conditions."""
    return ", ".join(map(_condition_text, conditions))


def alone_text(conditions: Sequence[SeparatingCondition]) -> str:
    """The same, "H = 1 alone" where each condition has a single value."""
    is_alone = conditions and all(len(condition.values) == 1 for condition in conditions)
    return f"{conditions_text(conditions)}{' alone' if is_alone else ''}"


def _in_brackets(conditions: Sequence[SeparatingCondition]) -> str:
    return f" ({alone_text(conditions)})" if conditions else ""


def _condition_text(condition: SeparatingCondition) -> str:
    *before, last = [value if isinstance(value, str) else f"{value:g}" for value in condition.values]
    if condition.is_range:
        text = f"{before[0]} to {last}"
    else:
        separator = "; " if any(", " in value for value in (*before, last)) else ", "
        text = f"{separator.join(before)} and {last}" if before else last
    return text if isinstance(condition.values[0], str) else placed(condition.name, text)


MAX_SAMPLE = 100.0
"""Times the sample: a verdict that needs more is practically undecidable."""


def cell_of(number: Number, printer: Printer) -> VerdictCell:
    """A cell of a table: the number, the place of the worst, and how many times the sample would decide it."""
    place = f" at {place_text(number.where[WORST_AT])}" if WORST_AT in number.where else ""
    needed = number.sample_needed if number.verdict is Verdict.INCONCLUSIVE else 0.0
    after = f"needs {needed:.1f} times the sample" if 0 < needed < MAX_SAMPLE else ""
    return VerdictCell(printer(number) + place, number.verdict, after)
