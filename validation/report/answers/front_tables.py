"""The table of seconds at equal error on the front page."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from validation.analysis.evidence import Evidence, Verdict, placed
from validation.analysis.number_text import short
from validation.benchmarks.work_precision.case import POINTS
from validation.benchmarks.work_precision.pareto import FASTER
from validation.benchmarks.work_precision.problem import SPRINGS, RollingProblem, RoughPunchProblem
from validation.cases.limits.limits import SUMMARY
from validation.cases.punch.ensembles import FORCE
from validation.cases.rolling.force_spectrum import SLOPE
from validation.report.answers.question import BEM, ENOUGH, TIMES
from validation.report.section import Section
from validation.scenes.description import slope_ratio


def times_faster(sections: Sequence[Section]) -> list[dict[str, Any]]:
    """A row a quantity and reduced model, by the columns of `faster`; with the verdict on its error and `ENOUGH`, the
    error itself, and where on the axis of the answers it was measured. None where nothing was timed.
    """
    section = next((section for section in sections if section.name == TIMES), None)
    if section is None or section.evidence is None or not section.evidence.has_table(FASTER):
        return []
    table = section.evidence.table(FASTER)
    rows = [dict(zip(table.columns, row, strict=True)) for row in zip(*table.columns.values(), strict=True)]
    return [row | _verdict_on_error(row, section.evidence) | {"place": _place_on_axis(row, section)} for row in rows]


def _verdict_on_error(row: Mapping[str, Any], evidence: Evidence) -> dict[str, Any]:
    """Whether the interval of the error lies within what is enough, outside, or across; "error" of a row is its end."""
    enough, end = ENOUGH[str(row["unit"])], float(row["error"])
    points = evidence.table(POINTS).where(**{name: row[name] for name in ("scene", "quantity")}, method=row["model"])
    scale = 1.0 if row["unit"] == "dB" else 100.0
    timed = (i for i, seconds in enumerate(points["median [s]"]) if seconds == row["seconds"])
    errors = [tuple(scale * float(points[name][i]) for name in ("error", "± sample")) for i in timed]
    # of several that took as long, that whose interval ends there
    value, half = min(errors, key=lambda error: abs(sum(error) - end))
    verdict = Verdict.WITHIN if end <= enough else Verdict.OUTSIDE if value - half > enough else Verdict.INCONCLUSIVE
    return {"enough": verdict, "value": value, "half": half}


def _place_on_axis(row: Mapping[str, Any], section: Section) -> str:
    """On the axis of the answers: the load, or the slope, with which the scene of a chart is rough; else nothing."""
    settings: Mapping[str, Any] = section.settings
    if row["scene"] == RoughPunchProblem.name:
        return placed(FORCE, f"{settings['fractal']['force']:g}")
    if row["scene"] == RollingProblem.name:
        settings_of_scene = {name: settings["rolling"][name] for name in ("hurst", "height", "last")}
        scene = RollingProblem(**settings_of_scene).scene
        slope = slope_ratio(scene.ground.slope_along, scene) if scene.ground else 0.0
        return placed(SLOPE, f"{slope:.2g}")
    return ""


def times_faster_said(rows: Sequence[Mapping[str, Any]]) -> str:
    """Of springs over all quantities for which they are enough, the least and the most."""
    factors = [
        float(row["times faster"]) for row in rows if row["model"] in SPRINGS and row["enough"] == Verdict.WITHIN
    ]
    if not factors:
        return ""
    least, most = map(short, (min(factors), max(factors)))
    within = " or ".join(f"{error:g} {unit}" for unit, error in ENOUGH.items())
    return f"Where springs are within {within}, they are {least} to {most} times faster than boundary elements"


COLUMNS = {
    "limit": "limit",
    "they fail where": "fails where",
    "what is wrong there": "error",
    "message": "message of the software",
}
"""Of the front page, and of the case."""
REASON = re.compile("[:;] ")


def failures(sections: Sequence[Section]) -> list[dict[str, str]]:
    """A row a limit, without its reasons; none where the case was not run."""
    evidence = next((section.evidence for section in sections if section.name == "limits"), None)
    if not evidence or not evidence.has_table(SUMMARY):
        return []
    table = evidence.table(SUMMARY)
    rows = zip(*(table[name].tolist() for name in COLUMNS.values()), strict=True)
    shown = [
        (limit.removeprefix(BEM).lstrip(":, "), *(REASON.split(cell)[0] for cell in cells))
        for limit, *cells in rows
        if limit.startswith(BEM)
    ]
    return [dict(zip(COLUMNS, row, strict=True)) for row in shown]
