"""The chapter of the book, claim by claim: what tests each statement of `chapter.toml`, and the answer of a report.

Status and answer come from the claims and numbers of the evidence; the file holds neither.
"""

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from validation.analysis.case import Settings
from validation.analysis.claim_text import REFUTED
from validation.analysis.claims import Claim
from validation.analysis.evidence import Evidence, JudgedClaim
from validation.analysis.quantity import quantity_with
from validation.analysis.statistics import POWER_DECIBEL
from validation.cases.exact.hertz import CAPACITANCE
from validation.report.section import Section
from validation.scenes.load import load_scene_with_track

BOOK = Path(__file__).with_suffix(".toml")
Answer = dict[str, str | None]
"""Its case, and status and answer there; no status where this run has no number for it."""


@dataclass(frozen=True, kw_only=True)
class ChapterTest:
    """What tests a statement: numbers of a case by the key of the quantity and the model, or a claim of the case.

    claim: its key, by default that of the first; where: conditions of the numbers; no: the words
    of a contradiction.
    """

    case: str
    claim: str = ""
    quantity: str = ""
    model: str = ""
    where: Mapping[str, str | float] = field(default_factory=dict)
    no: str = REFUTED

    def judged(self, statement: str, evidence: Evidence) -> JudgedClaim | None:
        """The claim of this evidence, or the statement with its numbers; None where it has none, or no such claim."""
        if self.quantity:
            claim = Claim(quantity=quantity_with(self.quantity), model=self.model, where=self.where, no=self.no).saying(
                statement
            )
            return claim.judged(evidence.numbers) if claim.numbers(evidence.numbers) else None
        return next((claim for claim in evidence.claims if self.claim in ("", claim.key)), None)


@dataclass(frozen=True, kw_only=True)
class ChapterEntry:
    """An equation, figure, table or statement of the chapter. place: its number; untested: why nothing tests it."""

    place: str
    statement: str
    tests: tuple[ChapterTest, ...] = ()
    untested: str = ""


@dataclass(frozen=True, kw_only=True)
class BookFigure:
    """A figure of the chapter. drawn: our figure; computed: what tests that it is got as printed; confirmed: that three
    dimensions have it, None where they have no part in it.
    """

    place: str
    shows: str
    drawn: str
    computed: ChapterTest
    confirmed: ChapterTest | None = None


def _entry(*, tests: Sequence[dict[str, Any]] = (), **texts: str) -> ChapterEntry:
    return ChapterEntry(**texts, tests=tuple(ChapterTest(**test) for test in tests))


def figures() -> dict[str, Any]:
    """What errata and remarks print, from closed forms and the scene of Table 14.1."""
    rigid = load_scene_with_track("table_14_1")
    rail, material = rigid.rail, rigid.material
    assert rail is not None
    assert material is not None
    of_steel = replace(material, counterface="same")
    steel = replace(rigid, material=of_steel, modulus=of_steel.modulus)
    quoted, jump = 1.012 * 2 / math.sqrt(math.pi), rigid.jump / rigid.eigenfrequency
    return {
        "rigid": rigid.body,
        "steel": steel.body,
        "turn": 2 * math.pi * rigid.radius,
        "hurst": rail.hurst,
        "excess": 100 * rail.hurst * rail.longest / rigid.track.distance,
        "near": -2 * POWER_DECIBEL * math.log(1 - 1 / 4),
        "far": -2 * POWER_DECIBEL * math.log(1 - 1 / jump**2),
        "below": POWER_DECIBEL * math.log(2 / (math.pi * (2 * rail.hurst + 1))),
        "square": CAPACITANCE,
        "quoted": quoted,
        "short": 100 * (1 - quoted / CAPACITANCE),
    }


_BOOK, _FIGURES = tomllib.loads(BOOK.read_text(encoding="utf-8")), figures()
ENTRIES = tuple(_entry(**entry) for entry in _BOOK["entry"])
BOOK_FIGURES = tuple(
    BookFigure(**{**row, **{name: ChapterTest(**row[name]) for name in ("computed", "confirmed") if name in row}})
    for row in _BOOK["figure"]
)
ERRATA, REMARKS = (
    tuple({name: Settings().format(text, **_FIGURES) for name, text in row.items()} for row in _BOOK[kind])
    for kind in ("erratum", "remark")
)
"""place; what is printed in the chapter, and what is correct, or under which condition; why: how one sees it."""


def answers(entry: ChapterEntry, sections: Sequence[Section]) -> list[Answer]:
    """One for each of its tests whose case is in the report."""
    named = {section.name: section for section in sections}
    return [_answered(entry, test, named[test.case]) for test in entry.tests if test.case in named]


def _answered(entry: ChapterEntry, test: ChapterTest, section: Section) -> Answer:
    judged = test.judged(entry.statement, section.evidence) if section.evidence else None
    if judged is None:
        return {"case": section.name, "status": None, "outcome": None, "answer": "This run has no number for it."}
    tested = "" if judged.claim == entry.statement else f"Tested as “{judged.claim}” "
    return {
        "case": section.name,
        "status": judged.status.earlier,
        "outcome": judged.status,
        "answer": tested + judged.answer,
    }


def book_figures(sections: Sequence[Section]) -> list[tuple[BookFigure, JudgedClaim | None, JudgedClaim | None]]:
    """Each figure whose case is in the report, with the claims on it: as printed, and in three dimensions."""
    evidence_by_case = {section.name: section.evidence for section in sections}

    def judged(test: ChapterTest | None) -> JudgedClaim | None:
        evidence = evidence_by_case.get(test.case) if test else None
        return test.judged("", evidence) if test and evidence else None

    return [
        (row, judged(row.computed), judged(row.confirmed))
        for row in BOOK_FIGURES
        if evidence_by_case.get(row.computed.case)
    ]


def chapter_of(sections: Sequence[Section]) -> list[tuple[ChapterEntry, list[Answer]]]:
    """Each entry that this report answers, with its answers; what nothing tests, too, beside any answer."""
    rows = [(entry, answers(entry, sections)) for entry in ENTRIES]
    any_answer = any(answers_to_it for _, answers_to_it in rows)
    return [(entry, answers_to_it) for entry, answers_to_it in rows if answers_to_it or (any_answer and entry.untested)]


def chapter_results(sections: Sequence[Section]) -> list[dict[str, object]]:
    """The same as plain values."""
    names = ("place", "statement", "untested")
    return [
        {**{name: getattr(entry, name) for name in names}, "answers": answers}
        for entry, answers in chapter_of(sections)
    ]
