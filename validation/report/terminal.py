"""Lines for the terminal on a finished case."""

from validation.benchmarks.solvers.rows import rows_of
from validation.report.contents import TIMED
from validation.report.formats import format_counts
from validation.report.section import Section, answer_of


def lines_of(section: Section, *, unsteady: bool = False) -> list[str]:
    """A line for the case, and one for each claim, missed criterion and failed solve; unsteady: it has no level."""
    met = f"criteria met {section.criteria - len(section.missed)} of {section.criteria}"
    if unsteady:
        met = "no steady answer, the results hold for this distance alone"
    details = [
        f"{claim.status}: {claim.claim} {answer_of(claim)} ({format_counts(claim)})"
        for claim in section.claims
        if not unsteady
    ]
    details += [f"missed: {number.sentence}" for number in section.missed]
    details += [f"not converged: {solve}" for solve in section.unconverged]
    if section.name in TIMED and section.evidence:
        details += rows_of(section.evidence) if section.name == "race" else []
        details += section.evidence.conclusions
    head = f"{section.name:15s} {'no result' if section.failure else met}"
    return [head, *(f"    {line}" for line in details)]
