"""The chapter of the book, claim by claim: what tests each statement of `chapter.toml`, and the answer of a report.

Status and answer come from the claims and numbers of the evidence; the file holds neither.
"""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from validation.analysis.claims import Claim
from validation.analysis.evidence import ClaimStatus, Evidence, JudgedClaim
from validation.report.section import Section, answer_of

BOOK = Path(__file__).with_suffix(".toml")


@dataclass(frozen=True, kw_only=True)
class ChapterTest:
    """What tests a statement: numbers of a case by quantity and model, or a claim of the case.

    claim: words that the claim has and no other, by default its first.
    """

    case: str
    claim: str = ""
    quantity: str = ""
    model: str = ""

    def __post_init__(self) -> None:
        if self.quantity and self.claim:
            raise ValueError(f"a test of {BOOK.name} must name a quantity or a claim, got both: {self}")

    def judged(self, statement: str, evidence: Evidence) -> JudgedClaim | None:
        """The claim of this evidence, or the statement with its numbers; None where it has none, or no such claim."""
        if self.quantity:
            claim = Claim(says=statement, quantity=self.quantity, model=self.model)
            return claim.judged(evidence.numbers) if claim.numbers(evidence.numbers) else None
        claims = [claim for claim in evidence.claims if self.claim in claim.claim]
        return claims[0] if len(claims) == 1 or (claims and not self.claim) else None


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
        ChapterEntry(**{**entry, "tests": tuple(ChapterTest(**test) for test in entry.get("tests", ()))})
        for entry in book["entry"]
    )
    return tuple(entries), tuple(Erratum(**erratum) for erratum in book["erratum"])


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
