"""What this house has on the front page: the contact filters beside boundary elements."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from validation.analysis.claim_text import listed
from validation.analysis.evidence import Evidence, Table, Verdict, VerdictCell
from validation.railway.cases.across_study import LOUDER
from validation.railway.cases.rolled_filters import OVER_BEM
from validation.report.section import Section

TEMPLATES, TEMPLATE = Path(__file__).parent / "templates", "rail_filters.html"
LINK = "filters", "Contact filters"
"""Address and title of its part of the page."""
GROUNDS = ("ridges", "alpha = 1", "isotropic ground")
"""Of what lies across a rail, that the front page shows."""
OF_A3 = OVER_BEM
WORST, FILTERED = "worst band over", "contact filters beside boundary elements"


def globals_of(sections: Sequence[Section]) -> dict[str, Any]:
    """What its template shows."""
    filters = rail_filters(sections)
    return {"rail_filters": filters, "right_filters": right_filters(filters) if filters else ""}


def rail_filters(sections: Sequence[Section]) -> Table | None:
    """A row a filter: its worst band [dB] over some grounds, and what it makes of the sound power [dB(A)]."""
    evidence = _evidence("across", sections)
    tables = {table.name: table for table in evidence.page_tables} if evidence else {}
    worst = next((table for name, table in tables.items() if name.startswith(OF_A3)), None)
    if worst is None or LOUDER not in tables:
        return None
    loud = tables[LOUDER]
    rows = [list(loud.columns["model"]).index(model) for model in worst.columns["model"]]
    grounds = [name for name in GROUNDS if name in worst.columns]
    wheel = worst.name.removeprefix(f"{OF_A3}, ")
    return Table(
        f"{FILTERED}: {wheel}",
        {
            "filter": worst.columns["model"],
            **{f"{WORST} {name}": worst.columns[name] for name in grounds},
            **{f"sound power, {name} [dB(A)]": [loud.columns[name][row] for row in rows] for name in grounds},
        },
    )


def right_filters(table: Table) -> str:
    """Filters that agree in the worst band of all these grounds, by name."""
    judged = [name for name in table.columns if name.startswith(WORST)]
    rows = zip(table.columns["filter"], *(table.columns[name] for name in judged), strict=True)
    names = [str(name) for name, *cells in rows if all(_agrees(cell) for cell in cells)] if judged else []
    return listed(names) if names else ""


def _agrees(cell: object) -> bool:
    return isinstance(cell, VerdictCell) and cell.verdict is Verdict.WITHIN


def _evidence(name: str, sections: Sequence[Section]) -> Evidence | None:
    return next((section.evidence for section in sections if section.name == name), None)
