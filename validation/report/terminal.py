"""Lines for the terminal on a finished case."""

from validation.analysis.evidence import Verdict
from validation.benchmarks.solvers.rows import rows_of
from validation.report.contents import TIMED
from validation.report.section import Section


def lines_of(section: Section, *, unsteady: bool = False) -> list[str]:
    """A line for the case, and one for each missed criterion and failed solve; unsteady: its scene has no level."""
    met = f"criteria met {section.criteria - len(section.missed)} of {section.criteria}"
    found = ", ".join(f"{section.findings(v)} {v}" for v in Verdict if section.findings(v))
    if unsteady:
        met, found = "no steady answer, the results hold for this distance alone", ""
    details = [f"missed: {number.sentence}" for number in section.missed]
    details += [f"not converged: {solve}" for solve in section.unconverged]
    if section.name in TIMED and section.evidence:
        details += rows_of(section.evidence) if section.name == "race" else []
        details += section.evidence.conclusions
    head = f"{section.name:15s} {'no result' if section.failure else met}" + (f"; findings: {found}" if found else "")
    return [head, *(f"    {line}" for line in details)]
