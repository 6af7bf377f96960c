"""The rows of the solver comparison, as a terminal shows them."""

import math

from validation.analysis.evidence import Evidence

COLUMNS = (
    "problem",
    "area",
    "contestant",
    "status",
    "median [s]",
    "fastest [s]",
    "slowest [s]",
    "residual",
    "operator applications",
    "pressure difference to ours, L2",
)


def rows_of(evidence: Evidence) -> list[str]:
    """A line a solver and problem, under a head of two lines."""
    heats = evidence.table("heats")
    header = ("median", "fastest", "slowest", "residual", "appl.", "dp")
    lines = [
        "times in seconds; appl.: operator applications on the finest grid; dp: difference of the pressure, L2",
        f"{'problem':38s}  area {'contestant':17s}" + "".join(f"{name:>10s}" for name in header),
    ]
    for problem, area, name, status, *values in zip(*(heats[name] for name in COLUMNS), strict=True):
        median, fastest, slowest, residual, applications, difference = values
        count = "?" if math.isnan(applications) else f"{applications:.0f}"
        result = (
            f"{median:10.4f}{fastest:10.4f}{slowest:10.4f}{residual:10.1e}{count:>10s}{difference:10.1e}"
            if status == "finished"
            else f"  {status}"
        )
        lines.append(f"{problem:38s} {area:5.1%} {name:17s}{result}")
    return lines
