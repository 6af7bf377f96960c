"""Tables of cases that stand on the front page, too: seconds at equal error, and filters of a rail."""

from collections.abc import Mapping, Sequence
from typing import Any

from validation.analysis.claims import listed
from validation.analysis.evidence import Evidence, Table, Verdict, VerdictCell
from validation.benchmarks.work_precision.faster import FASTER
from validation.benchmarks.work_precision.problem import SPRINGS
from validation.cases.rail.across_study import LOUDER
from validation.report.answers.seconds import ENOUGH
from validation.report.section import Section

GROUNDS = ("ridges", "alpha = 1", "isotropic ground")
"""Of what lies across a rail, that the front page shows."""
OF_A3 = "A3 over that of boundary elements"
WORST, FILTERED = "worst band over", "contact filters beside boundary elements"


def times_faster(sections: Sequence[Section]) -> list[dict[str, Any]]:
    """A row a quantity and reduced model, by the columns of `faster`, and whether it is "enough": its error, with the
    interval, is within `ENOUGH`. None where nothing was timed.
    """
    evidence = _evidence("precision", sections)
    if evidence is None or not evidence.has_table(FASTER):
        return []
    table = evidence.table(FASTER)
    rows = [dict(zip(table.columns, row, strict=True)) for row in zip(*table.columns.values(), strict=True)]
    return [row | {"enough": float(row["error"]) <= ENOUGH[str(row["unit"])]} for row in rows]


def times_faster_said(rows: Sequence[Mapping[str, Any]]) -> str:
    """Of springs over all quantities for which they are enough, the least and the most."""
    found = [float(row["times faster"]) for row in rows if row["model"] in SPRINGS and row["enough"]]
    if not found:
        return ""
    least, most = (f"{float(f'{times:.2g}'):g}" for times in (min(found), max(found)))
    within = " or ".join(f"{error:g} {unit}" for unit, error in ENOUGH.items())
    return f"Where springs are within {within}, they are {least} to {most} times faster than boundary elements"


def rail_filters(sections: Sequence[Section]) -> Table | None:
    """A row a filter: its worst band [dB] over some grounds, and what it makes of the rms force [dB(A)]."""
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
            **{f"rms force over {name} [dB(A)]": [loud.columns[name][row] for row in rows] for name in grounds},
        },
    )


def right_filters(table: Table) -> str:
    """Filters that agree in the worst band of all these grounds, by name."""
    judged = [name for name in table.columns if name.startswith(WORST)]
    rows = zip(table.columns["filter"], *(table.columns[name] for name in judged), strict=True)
    names = [str(name) for name, *cells in rows if all(_agrees(cell) for cell in cells)] if judged else []
    return listed(names) if names else ""


def _agrees(cell: object) -> bool:
    return isinstance(cell, VerdictCell) and cell.verdict is Verdict.AGREE


def _evidence(name: str, sections: Sequence[Section]) -> Evidence | None:
    return next((section.evidence for section in sections if section.name == name), None)
