"""The chapter of the book, claim by claim: what tests each statement of `chapter.toml`, and the answer of a report.

Status and answer come from the claims and numbers of the evidence; the file holds neither.
"""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from validation.analysis.answers import answered
from validation.analysis.evidence import (
    ClaimStatus,
    Evidence,
    JudgedClaim,
    Number,
    Role,
    Verdict,
    numbers_with,
    with_reference,
)
from validation.report.section import Section, answer_of

BOOK = Path(__file__).with_suffix(".toml")
FEW = 3
"""Numbers that an answer prints one by one."""


@dataclass(frozen=True, kw_only=True)
class ChapterTest:
    """What tests a statement: numbers of a case by quantity, model and where, or a claim of the case.

    claim: words that the claim has and no other, by default its first; confirmed_by: the verdict of the numbers that
    confirms the statement.
    """

    case: str
    claim: str = ""
    quantity: str | None = None
    model: str | None = None
    where: Mapping[str, Any] | None = None
    confirmed_by: Verdict = Verdict.AGREE

    def __post_init__(self) -> None:
        if self.quantity is not None and self.claim:
            raise ValueError(f"a test of {BOOK.name} must name a quantity or a claim, got both: {self}")

    def judged(self, statement: str, evidence: Evidence) -> JudgedClaim | None:
        """The claim of this evidence, or the statement with its numbers; None where it has none, or no such claim."""
        if self.quantity is None:
            claims = [claim for claim in evidence.claims if self.claim in claim.claim]
            return claims[0] if len(claims) == 1 or (claims and not self.claim) else None
        found = numbers_with(evidence.numbers, self.quantity, self.model, **(self.where or {}))
        numbers = tuple(number for number in found if number.role is not Role.IDENTITY)
        if not numbers:
            return None
        return answered(statement, numbers, _answer(numbers), confirmed_by=self.confirmed_by)


@dataclass(frozen=True, kw_only=True)
class ChapterEntry:
    """An equation, figure, table or statement of the chapter. place: its number; untested: why nothing tests it."""

    place: str
    statement: str
    tests: tuple[ChapterTest, ...] = ()
    untested: str = ""

    def __post_init__(self) -> None:
        if bool(self.tests) == bool(self.untested):
            raise ValueError(f"{self.place} of {BOOK.name} must have tests, or say why it is untested")


@dataclass(frozen=True, kw_only=True)
class Erratum:
    """What is printed in the chapter, and what it should be. why: how one sees it."""

    place: str
    printed: str
    correct: str
    why: str


@dataclass(frozen=True)
class ChapterAnswer:
    """The answer of a case; without status where this run has no number for it."""

    case: str
    status: ClaimStatus | None
    answer: str


def _read() -> tuple[tuple[ChapterEntry, ...], tuple[Erratum, ...]]:
    book = tomllib.loads(BOOK.read_text(encoding="utf-8"))
    entries = (
        ChapterEntry(**{**entry, "tests": tuple(_test(test) for test in entry.get("tests", ()))})
        for entry in book["entry"]
    )
    return tuple(entries), tuple(Erratum(**erratum) for erratum in book["erratum"])


def _test(test: dict[str, Any]) -> ChapterTest:
    # a range is a list in TOML and a pair in a number
    where = {name: tuple(at) if isinstance(at, list) else at for name, at in test.get("where", {}).items()}
    return ChapterTest(**test | {"where": where, "confirmed_by": Verdict(test.get("confirmed_by", Verdict.AGREE))})


ENTRIES, ERRATA = _read()


def answers(entry: ChapterEntry, sections: Sequence[Section]) -> list[ChapterAnswer]:
    """One for each of its tests whose case is in the report."""
    named = {section.name: section for section in sections}
    return [_answered(entry, test, named[test.case]) for test in entry.tests if test.case in named]


def _answered(entry: ChapterEntry, test: ChapterTest, section: Section) -> ChapterAnswer:
    judged = test.judged(entry.statement, section.evidence) if section.evidence else None
    if judged is None:
        return ChapterAnswer(section.name, None, "This run has no number for it.")
    tested = "" if judged.claim == entry.statement else f"Tested as “{judged.claim}” "
    return ChapterAnswer(section.name, judged.status, tested + answer_of(judged))


def chapter_of(sections: Sequence[Section]) -> list[tuple[ChapterEntry, list[ChapterAnswer]]]:
    """Each entry that this report answers, with its answers; what nothing tests, too, beside any answer."""
    rows = [(entry, answers(entry, sections)) for entry in ENTRIES]
    any_answer = any(found for _, found in rows)
    return [(entry, found) for entry, found in rows if found or (any_answer and entry.untested)]


def chapter_results(sections: Sequence[Section]) -> list[dict[str, object]]:
    """The same as plain values."""
    return [
        {
            "place": entry.place,
            "statement": entry.statement,
            "untested": entry.untested,
            "answers": [vars(answer) for answer in found],
        }
        for entry, found in chapter_of(sections)
    ]


def _answer(numbers: Sequence[Number]) -> str:
    """Few numbers each with its reference; of more, counts, the farthest, and the nearest of several that differ."""
    if len(numbers) <= FEW:
        return "; ".join(map(_printed, numbers)) + "."
    counts = {verdict: sum(number.verdict is verdict for number in numbers) for verdict in Verdict}
    found = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
    farthest = max(numbers, key=_distance)
    differing = [number for number in numbers if number.verdict is Verdict.DIFFER]
    nearest = f"; nearest that differs: {_printed(min(differing, key=_distance))}" if len(differing) > 1 else ""
    return f"{len(numbers)} numbers: {found}; farthest from its reference: {_printed(farthest)}{nearest}."


def _distance(number: Number) -> float:
    """The far end of its interval, in tolerances."""
    return (abs(number.difference) + number.uncertainty) / number.tolerance if number.tolerance else 0.0


def _printed(number: Number) -> str:
    return f"{number.label}: {with_reference(number)}"
