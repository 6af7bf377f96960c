"""A section of the report: one case with its evidence, and its part of results.json."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from validation.analysis.case import Case, Profile
from validation.analysis.contents import conditions_in_json, plain_name
from validation.analysis.evidence import (
    OF_NUMBERS,
    ClaimStatus,
    Evidence,
    JudgedClaim,
    Number,
    Role,
    Table,
    VerdictCell,
    Whose,
)
from validation.engine.former_names import with_former_keys

PREDICTED = "predicted before a solve, for a single surface and not for ensemble means"
STATED = "stated by the case"
"""What the model is that a case needs, by the a-priori error estimates or by itself: no answer of the page."""
SCHEMA = 2
"""Of results.json: keys of schema 1 stay for one release."""
FORMER_KEYS = {name.replace(" ", "_"): name for name in ("model needed", "model needed is", "page tables")}
"""Of a case in results.json of schema 1, which schema 2 has beside today's for one release."""
FIRST_WORDS = 10
"""Of a claim without a key, by which it is found."""


@dataclass(frozen=True)
class Section:
    """A case in the report: the model it needs, its settings, its evidence or the reasons why there is none.

    files: the data behind its figures and its sounds, by their places in the report folder.
    """

    name: str
    entry: Case
    needed: str
    settings: dict[str, object]
    evidence: Evidence | None
    failure: tuple[str, ...] = ()
    files: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def numbers(self) -> tuple[Number, ...]:
        """All of its evidence, none where the case failed."""
        return self.evidence.numbers if self.evidence else ()

    @property
    def claims(self) -> tuple[JudgedClaim, ...]:
        """With their numbers, none where the case failed."""
        return self.evidence.claims if self.evidence else ()

    @property
    def unconverged(self) -> tuple[str, ...]:
        return self.evidence.unconverged if self.evidence else self.failure

    def not_steady(self, reason: str) -> "Section":
        """The same where the scene has no steady answer: nothing is claimed or concluded, no verdict is shown."""
        if self.evidence is None:
            return self
        tables = tuple(map(_without_verdicts, self.evidence.page_tables))
        nothing: dict[str, Any] = {"claims": (), "conclusions": (), "finding": "", "headlines": {}}
        unconverged = (f"no steady answer: {reason}", *self.evidence.unconverged)
        return replace(self, evidence=replace(self.evidence, **nothing, page_tables=tables, unconverged=unconverged))

    @property
    def page(self) -> str:
        """Of its chapter."""
        return f"{self.entry.chapter.name.lower()}.html"

    @property
    def place(self) -> str:
        return f"{self.page}#{self.name}"

    def address_of(self, claim: JudgedClaim) -> str:
        """On its page: by its first words, so that it lasts when others come or go."""
        words = " ".join(claim.claim.split()[:FIRST_WORDS])
        return f"claim-{self.name}-{claim.key or plain_name(words)}"

    @property
    def missed(self) -> tuple[Number, ...]:
        return tuple(number for number in self.numbers if not number.met)

    @property
    def criteria(self) -> int:
        return sum(number.role is Role.CRITERION for number in self.numbers)


def _without_verdicts(table: Table) -> Table:
    texts = {n: [c.text if isinstance(c, VerdictCell) else c for c in cells] for n, cells in table.columns.items()}
    return Table(table.name, texts)


def numbers_table(numbers: Sequence[Number]) -> Table:
    """All that is known of each."""
    named = "quantity model conditions verdict value reference unit difference grid sample tolerance reason source role"
    return Table("numbers", {name: [_json_cell(getattr(number, name)) for number in numbers] for name in named.split()})


def claims_of_others(sections: Sequence[Section]) -> list[tuple[Section, JudgedClaim]]:
    """Statements of the book and of the literature, in the order of their sections."""
    return [(s, claim) for s in sections for claim in s.claims if claim.whose is not Whose.HYPOTHESIS]


def total_of(sections: Sequence[Section]) -> str:
    """How many claims have each status."""
    statuses = [claim.status for section in sections for claim in section.claims]
    return "claims: " + ", ".join(f"{status} {statuses.count(status)}" for status in ClaimStatus if status in statuses)


def results_of(sections: Sequence[Section], profile: Profile) -> dict[str, object]:
    """What results.json holds."""
    return {
        "schema_version": SCHEMA,
        "profile": profile,
        "cases": {section.name: case_results(section) for section in sections},
    }


def case_results(section: Section) -> dict[str, object]:
    """Everything that the page says of a case, as plain values; its tables are in files of their own."""
    results = {
        **(_results_of_evidence(section.evidence) if section.evidence else {}),
        "claim": section.entry.claim,
        "claims": [
            {
                **{name: getattr(claim, name) for name in ("key", "claim", "answer", "limits")},
                "whose": claim.whose.earlier,
                "stated_by": claim.whose,
                "status": claim.status.earlier,
                "outcome": claim.status,
                "verdicts": {verdict.earlier: claim.count(verdict) for verdict in OF_NUMBERS},
                "numbers": [number.label for number in claim.numbers],
                "confirmed by": claim.confirmed_by.earlier,
                "confirmed_by": claim.confirmed_by,
                "inside": [number.label for number in claim.inside],
            }
            for claim in section.claims
        ],
        "answers": section.entry.answers,
        "model_needed": section.needed,
        "model_needed_is": PREDICTED if callable(section.entry.needs) else STATED,
        "settings": section.settings,
        "numbers": [
            {
                "label": number.label,
                **asdict(number),
                "conditions": conditions_in_json(number.where),
                "difference": number.difference,
                "verdict": number.verdict.earlier,
                "outcome": number.verdict,
                "met": None if number.role is Role.FINDING else number.met,
            }
            for number in section.numbers
        ],
        "conclusions": section.evidence.conclusions if section.evidence else (),
        "unconverged": section.unconverged,
    }
    return with_former_keys(results, FORMER_KEYS)


WORDS = ("title", "finding", "method", "captions", "headlines")
"""Of evidence, that are in its results as they are."""


def _results_of_evidence(evidence: Evidence) -> dict[str, object]:
    """What it says beside its numbers and claims."""
    return {
        **{name: getattr(evidence, name) for name in WORDS},
        "tables": [table.name for table in written_tables(evidence)],
        "page_tables": [
            {
                "name": table.name,
                "columns": {name: list(map(_json_cell, cells)) for name, cells in table.columns.items()},
            }
            for table in evidence.page_tables
        ],
        "sounds": asdict(evidence.sounds) if evidence.sounds else None,
    }


def written_tables(evidence: Evidence) -> list[Table]:
    """Each a CSV file: all but the one that is played, which WAV files hold."""
    return [table for table in evidence.tables if not evidence.sounds or table.name != evidence.sounds.table]


def _json_cell(cell: object) -> object:
    """A cell as strict JSON can hold it, printed the same."""
    if isinstance(cell, VerdictCell):
        return {**asdict(cell), "verdict": cell.verdict.earlier, "outcome": cell.verdict}
    return str(cell) if isinstance(cell, float) and not math.isfinite(cell) else cell
