"""The table of times within the same tolerance on the front page, and where boundary elements fail."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from validation.analysis.evidence import Evidence, Table, Verdict, numbers_with, placed, verdict_of
from validation.analysis.number_text import short
from validation.analysis.series import worst
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS, HOUR, HOURS
from validation.benchmarks.work_precision.pareto import CHEAPEST_SETTING, FACTOR, SHOWN, TOLERANCES
from validation.benchmarks.work_precision.problem import (
    BEM_METHOD,
    FILTER_3D,
    SPRINGS,
    RolledOffPunchProblem,
    RollingProblem,
    RoughPunchProblem,
)
from validation.cases.limits.limits import SUMMARY
from validation.cases.punch.ensembles import FORCE
from validation.cases.punch.interface import CONTACT
from validation.cases.rolling.force_spectrum import SLOPE
from validation.cases.wheel import half_space
from validation.cases.wheel.ensembles import LEVEL
from validation.report.answers.question import BEM, TIMES
from validation.report.section import Section
from validation.scenes.description import slope_ratio
from validation.simulation.track_spectrum import PiecewisePowerLaw

Row = dict[str, Any]


def times_faster(sections: Sequence[Section]) -> list[Row]:
    """Rows of the cheapest settings of reduced models beside those of boundary elements, scene by scene.

    A row a question, tolerance and model: columns of `cheapest_settings`, "elements" as the same row of boundary
    elements, and "place", where on the axis of the answers the scene is. A model without a setting within its loosest
    tolerance has a single row, without a factor. The dynamic wheel of Fig. 14.4 comes last. None where nothing was
    timed.
    """
    section = next((section for section in sections if section.name == TIMES), None)
    if section is None or section.evidence is None or not section.evidence.has_table(CHEAPEST_SETTING):
        return []
    rows = rows_of(section.evidence.table(CHEAPEST_SETTING))
    elements = {_key(row): row for row in rows if row["method"] == BEM_METHOD and row["a setting within"]}
    loosest = {unit: SHOWN[unit] * max(tolerances) for unit, tolerances in TOLERANCES.items()}
    shown = [
        row | {"place": _place_on_axis(row, section), "elements": elements.get(_key(row))}
        for row in rows
        if row["scene"] in ASKED and row["method"] != BEM_METHOD
        if row["a setting within"] or (row["method"] in REDUCED and row["tolerance"] == loosest[row["unit"]])
    ]
    return [*shown, *_dynamic_wheel(section.evidence, sections)]


def rows_of(table: Table) -> list[Row]:
    """The rows of a table by the names of its columns."""
    return [dict(zip(table.columns, row, strict=True)) for row in zip(*table.columns.values(), strict=True)]


def _key(row: Row) -> tuple[object, ...]:
    return row["scene"], row["quantity"], row["tolerance"]


def _dynamic_wheel(timed: Evidence, sections: Sequence[Section]) -> Iterator[Row]:
    """Yield the row of Fig. 14.4: its times, and the error of springs in their worst band, where that is computed."""
    wheel = next((section.evidence for section in sections if section.name == "wheel_3d"), None)
    errors = numbers_with(wheel.numbers, LEVEL, half_space.OVER_BEM[half_space.GEIKE]) if wheel else []
    if not (errors and timed.has_table(COST_OF_STEPS)):
        return
    error, tolerance = worst(errors), TOLERANCES["dB"][0]
    springs, elements = rows_of(timed.table(COST_OF_STEPS))
    times, times_of_elements = ([row[name] for name in HOURS] for row in (springs, elements))
    # each of both medians lies between the ends of its interval
    factor = times_of_elements[0] / times[0], times_of_elements[1] / times[2], times_of_elements[2] / times[1]
    common = {"scene": "dynamic wheel", "place": "Fig. 14.4", "unit": "dB", "tolerance": tolerance}
    yield {
        **common,
        **{"quantity": "acceleration, worst band", "method": SPRINGS[0], "setting": f"{springs['a/dx']:g} to a radius"},
        **{"error": error.difference, "± sample": error.sample, "± reference": error.grid},
        **{"verdict": verdict_of(error.difference, error.uncertainty, tolerance), "a setting within": False},
        **dict(zip(TIME_COLUMNS, (HOUR * time for time in times), strict=True)),
        **dict(zip((FACTOR, "factor from", "factor to"), factor, strict=True)),
        "elements": {
            "setting": f"{elements['a/dx']:g} cells to a radius",
            **dict(zip(TIME_COLUMNS, (HOUR * time for time in times_of_elements), strict=True)),
        },
    }


TIME_COLUMNS = ("time [s]", "time from [s]", "time to [s]")


def _place_on_axis(row: Mapping[str, Any], section: Section) -> str:
    """On the axis of the answers: the load, or the slope, with which the scene of a chart is rough."""
    settings: Mapping[str, Any] = section.settings
    if row["scene"] == RoughPunchProblem.name:
        return placed(FORCE, f"{settings['fractal']['force']:g}")
    if row["scene"] == RolledOffPunchProblem.name:
        return placed(CONTACT, f"{100 * persson_contact(**settings['rolled_off']):.2g}")
    settings_of_scene = {name: settings["rolling"][name] for name in ("hurst", "height", "last")}
    scene = RollingProblem(**settings_of_scene).scene
    slope = slope_ratio(scene.ground.slope_along, scene) if scene.ground else 0.0
    return placed(SLOPE, f"{slope:.2g}")


def persson_contact(*, hurst: float, waves: int, roll_off: int, force: float, **_: object) -> float:
    """Relative contact area predicted by Persson's theory: erf(sqrt(2) Fbar / (g / h)), g = rms abs(grad h)."""
    edges = tuple(2 * math.pi * n for n in (1, roll_off, waves))
    law = PiecewisePowerLaw(edges=edges, exponents=(0.0, 2 * hurst + 2))
    return math.erf(math.sqrt(2) * force / law.gradient)


ASKED = (RoughPunchProblem.name, RolledOffPunchProblem.name, RollingProblem.name)
"""Scenes of the answers; others have closed forms."""
REDUCED = (*SPRINGS, FILTER_3D)
"""Models that have a row wherever they have the quantity, within tolerance or not."""


def times_faster_said(rows: Sequence[Mapping[str, Any]]) -> str:
    """The least and the most of springs, where they and boundary elements are within the same tolerance."""
    factors = [
        float(row[FACTOR])
        for row in rows
        if row["method"] in SPRINGS and row["a setting within"] and row["elements"]
        if row["verdict"] == row["elements"]["verdict"] == Verdict.WITHIN
    ]
    if not factors:
        return ""
    ends = dict.fromkeys(map(short, (min(factors), max(factors))))
    within = f"{listed_tolerances('%')} % ({listed_tolerances('dB')} dB)"
    return f"Within {within} springs are {' to '.join(ends)} times faster than boundary elements"


def listed_tolerances(unit: str) -> str:
    """ "10, 3 or 1" of the unit "%"."""
    *first, last = (f"{SHOWN[unit] * tolerance:g}" for tolerance in TOLERANCES[unit])
    return f"{', '.join(first)} or {last}"


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
