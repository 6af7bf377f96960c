"""The rows of the solver comparison, as a terminal shows them."""

import math

from validation.analysis.evidence import Evidence

COLUMNS = (
    "problem",
    "area",
    "solver",
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
        f"{'problem':38s}  area {'solver':21s}" + "".join(f"{name:>10s}" for name in header),
    ]
    for problem, area, name, status, *values in zip(*(heats[name] for name in COLUMNS), strict=True):
        median, fastest, slowest, residual, applications, difference = values
        count = "?" if math.isnan(applications) else f"{applications:.0f}"
        result = (
            f"{median:10.4f}{fastest:10.4f}{slowest:10.4f}{_short(residual)}{count:>10s}{_short(difference)}"
            if status == "finished"
            else f"  {status}"
        )
        lines.append(f"{problem:38s} {area:5.1%} {name:21s}{result}")
    return lines


def _short(value: float) -> str:
    """A question mark where there is none."""
    return f"{'?':>10s}" if math.isnan(value) else f"{value:10.1e}"
