"""What this house has on the front page: its questions, and the contact filters beside boundary elements."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from validation.analysis.evidence import Evidence, Table, Verdict, VerdictCell
from validation.analysis.number_text import enumeration, level_in_decibels
from validation.cases.rolling.reduced_models import READ
from validation.railway.cases import across, filters, rail_dynamic
from validation.railway.cases.across_study import LOUDER
from validation.railway.cases.rolled_filters import OVER_BEM
from validation.report.answers.question import BEM, INTEGRAL, Alternative, Question
from validation.report.answers.strip import Source
from validation.report.section import Section

of_rail = partial(
    Source,
    case="across",
    quantity=OVER_BEM,
    where={filters.OFFSET: 0.0},
    axis=across.GROUND,
    printed="what lies across",
    series=(across.WHEEL,),
)
MOVING = Source(
    case="rail_dynamic",
    quantity=rail_dynamic.RMS + rail_dynamic.BESIDE,
    model=rail_dynamic.SPRINGS_OVER_BEM,
    where={rail_dynamic.RAIL: rail_dynamic.BEAM},
    axis=filters.OFFSET,
)
QUESTIONS = (
    Question(
        "contact-filter",
        "Contact filter of a wheel on a rail, ensemble mean",
        of_rail(model=across.LINES[0]),
        level_in_decibels,
        (
            Alternative(across.MODELS[0], of_rail(model=across.MODELS[0]), INTEGRAL),
            Alternative(filters.BED_WIDER, of_rail(model=filters.BED_WIDER), INTEGRAL),
            Alternative(BEM),
        ),
        "springs on one measured line",
    ),
)
ALTERNATIVES = {
    "dynamic-wheel": Alternative(f"on a rail, {READ} in the time loop", MOVING, by="rms over bands"),
}
"""To MDR in questions of the core, by their names."""


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
    return enumeration(names) if names else ""


def _agrees(cell: object) -> bool:
    return isinstance(cell, VerdictCell) and cell.verdict is Verdict.WITHIN


def _evidence(name: str, sections: Sequence[Section]) -> Evidence | None:
    return next((section.evidence for section in sections if section.name == name), None)
