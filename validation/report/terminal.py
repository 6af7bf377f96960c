"""Lines for the terminal on a finished case."""

from validation.analysis.evidence import Table
from validation.report.contents import TIMED
from validation.report.formats import format_counts
from validation.report.section import Section, answer_of


def lines_of(section: Section, *, unsteady: bool = False) -> list[str]:
    """A line for the case, each claim, conclusion, missed criterion and failed solve; unsteady: it has no level."""
    met = f"criteria met {section.criteria - len(section.missed)} of {section.criteria}"
    if unsteady:
        met = "no steady answer, the results hold for this distance alone"
    details = [
        f"{claim.status}: {claim.claim} {answer_of(claim)} ({format_counts(claim)})"
        for claim in section.claims
        if not unsteady
    ]
    details += section.evidence.conclusions if section.evidence and not unsteady else ()
    details += [f"missed: {number.sentence}" for number in section.missed]
    details += [f"not converged: {solve}" for solve in section.unconverged]
    if section.name in TIMED and section.evidence:
        details += [line for table in section.evidence.page_tables for line in _rows(table)]
    head = f"{section.name:15s} {'no result' if section.failure else met}"
    return [head, *(f"    {line}" for line in details)]


def _rows(table: Table) -> list[str]:
    """A line a row, under the name of the table."""
    rows = zip(*table.columns.values(), strict=True)
    pairs = ([pair for pair in zip(table.columns, row, strict=True) if pair[1] != ""] for row in rows)
    return [f"{table.name}:", *(f"  {'; '.join(f'{name}: {_said(cell)}' for name, cell in some)}" for some in pairs)]


def _said(cell: object) -> str:
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)
