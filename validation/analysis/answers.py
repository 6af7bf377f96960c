"""Answers to claims, which begin with their status, so that the first word changes sides with the numbers."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import takewhile

from validation.analysis.evidence import ClaimStatus, JudgedClaim, Number, Verdict

SHORT = {
    ClaimStatus.HOLDS: "Yes",
    ClaimStatus.LIMITED: "Within limits",
    ClaimStatus.CONTRADICTED: "No",
    ClaimStatus.OPEN: "Not decided",
}


def agreeing_from_the_first(groups: Iterable[Sequence[Number]]) -> tuple[Number, ...]:
    """Numbers of all groups before the first that has one which does not agree.

    groups: along a range, from the end where theory expects agreement: limits then are one piece of it, never a choice
    of what agrees.
    """
    agreeing = takewhile(lambda group: all(number.verdict is Verdict.AGREE for number in group), groups)
    return tuple(number for group in agreeing for number in group)


def answered(
    claim: str,
    numbers: Sequence[Number],
    answer: str,
    *,
    confirmed_by: Verdict = Verdict.AGREE,
    limits: str = "",
    inside: Sequence[Number] = (),
) -> JudgedClaim:
    """A claim whose answer begins with its status, and with its limits where it holds within these alone."""
    judged = JudgedClaim(
        claim=claim,
        answer=answer,
        numbers=tuple(numbers),
        confirmed_by=confirmed_by,
        limits=limits,
        inside=tuple(inside),
    )
    where = f" ({limits})" if judged.status is ClaimStatus.LIMITED else ""
    return replace(judged, answer=f"{SHORT[judged.status]}{where}: {answer}")
