"""What error against cost shows: every point, the cheapest methods, break-even in words, orders, equal values."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, table_of
from validation.analysis.wording import sentence
from validation.benchmarks.peers import SOLVERS
from validation.benchmarks.timing import FAILED, FINISHED
from validation.benchmarks.work_precision.case import FULL, QUICK, PrecisionResult, run
from validation.benchmarks.work_precision.claims import CLAIM, claims_of, headlines, time_numbers
from validation.benchmarks.work_precision.errors import points
from validation.benchmarks.work_precision.figure_cost import cost_answer, cost_number
from validation.benchmarks.work_precision.pareto import (
    TOLERANCES,
    Point,
    break_even,
    cheapest,
    format_seconds,
    front,
    monotone_envelope,
    reason_if_none,
    seconds,
    work,
)
from validation.benchmarks.work_precision.problem import BEM, MDR, POLONSKY_KEER

MAY_FAIL = (POLONSKY_KEER, *(solver.name for solver in SOLVERS))
"""Of the published iteration and of other solvers a failure is a row; all others must finish, or be out of range."""
TOO_COSTLY = "Contact in three dimensions is too costly for the dynamic simulation of Fig. 14.4."
COST_ON_PAGE = "the dynamic wheel of Fig. 14.4, seconds on one core"
TEN_PERCENT, ONE_DECIBEL = 0.1, 1.0
"""Within which a model is said to agree."""


@dataclass(frozen=True)
class Charts:
    result: PrecisionResult

    @cached_property
    def points(self) -> list[Point]:
        scenes = zip(self.result.case.problems(), self.result.outcomes, strict=True)
        return [point for scene, outcome in scenes for point in points(scene, outcome)]

    @cached_property
    def groups(self) -> list[list[Point]]:
        """One a chart, in the order of the scenes."""
        found: dict[tuple[str, str], list[Point]] = {}
        for point in self.points:
            found.setdefault((point.scene, point.quantity), []).append(point)
        return [monotone_envelope(group) for group in found.values()]

    def of(self, scene: str, quantity: str, method: str) -> list[Point]:
        """A method on a chart, as far as it has finished."""
        return [p for p in self.points if (p.scene, p.quantity, p.method) == (scene, quantity, method) and p.finished]


def evidence(result: PrecisionResult) -> Evidence:
    """Criteria where something is predicted exactly; the times are tables and conclusions, none right or wrong."""
    charts = Charts(result)
    summary, times = _summary(charts), time_numbers(charts.groups)
    cost = cost_number(result.cost)
    orders, equal, models = _orders(charts), _equal(charts), _models(charts)
    claims = (*claims_of(times, models, orders, equal), _too_costly(result, cost))
    return Evidence(
        title="Speed against accuracy: the error and the cost of every method",
        method=_method(result),
        numbers=(*orders, *equal, *models, *times, cost),
        claims=claims,
        finding=sentence(*headlines(times).values()),
        headlines=headlines(times) | {"precision-work": _by_work(charts.groups)},
        tables=(_table(charts), summary, result.cost),
        page_tables=(_cheapest(summary), _without(charts), replace(result.cost, name=COST_ON_PAGE)),
        conclusions=tuple(break_even(group) for group in charts.groups),
        captions=_captions(),
        unconverged=_unconverged(charts),
    )


def _by_work(groups: Sequence[Sequence[Point]]) -> str:
    """Whether counted work names the same method as the clock does."""
    charted = [[p for p in group if not p.is_reference] for group in groups]
    pairs = [
        (by_time, by_work)
        for group in charted
        for tolerance in TOLERANCES
        if (by_time := cheapest(group, tolerance)) and (by_work := cheapest(group, tolerance, work))
    ]
    same = sum(by_time.method == by_work.method for by_time, by_work in pairs)
    return (
        f"Counted work and the clock have the same cheapest method in {same} of {len(pairs)} cases, each a chart at "
        "one tolerance"
    )


def _too_costly(result: PrecisionResult, cost: Number) -> JudgedClaim:
    return answered(TOO_COSTLY, (cost,), cost_answer(result.cost, result.case.cost), confirmed_by=Verdict.DIFFER)


def _method(result: PrecisionResult) -> str:
    case = result.case
    return (
        "Each method is a curve along a parameter: cells, springs, residual. Error: beside closed forms where there "
        "are any; elsewhere beside the two finest grids of boundary elements on the same surfaces, extrapolated to "
        "cells of zero size. The last step of this extrapolation is the uncertainty of the reference, and errors below "
        "it are treated as equal to it. Methods are ranked by the upper 95 % bound; if a finer setting has a larger "
        "bound, that one is used. Errors of the two finest grids are steps of their own extrapolation. Spectra: root "
        "mean square, over one-third octaves, of level differences. "
        f"Springs have roughness of their own, {case.fractal.profiles} profiles, {case.rolling.tracks} "
        f"tracks, {case.wheel.wheels} wheels; boundary elements {case.fractal.realisations} surfaces, "
        f"{case.rolling.realisations} and {case.wheel.realisations} strips, whose linear force takes most of their "
        "scatter away; these are periodic, which closed forms are not. "
        "Cost: seconds of one realisation, methods in turns, one thread, median and quartiles; claims compare medians "
        "with their 95 % intervals at the worst error of a chart; set-up "
        "(operators, plans, a first drawing) is timed apart. Work, the same on every machine: cells times operator "
        "applications, as if on the whole grid (rolling: on a square around the smooth contact), springs evaluated, "
        "points filtered, nodes of a quadrature. Extrapolated boundary elements cost both grids. Results of "
        "force-controlled solvers are converted to the prescribed approach with the closed-form load curve."
    )


def _captions() -> dict[str, str]:
    marks = (
        "Grey: the uncertainty of the reference, or, for closed forms, below the smallest error; marks at its "
        "edge, pointing down, lie within it. Thick line: the Pareto front, by upper ends of errors. Bars: 95 % of the "
        "sample, quartiles of times. Crosses along the top: failed or out of range, for the reason in the table."
    )
    return {
        "precision-summary": (
            "The cheapest method within each tolerance, closed forms left out where they are the reference; levels "
            "within 20 lg (1 + tolerance) dB. Seconds of one realisation, one thread; costs within a factor 1.5 share "
            "a mark."
        ),
        "precision": f"Error against seconds, a chart a quantity. {marks}",
        "precision-work": (
            f"The same against work: cells times operator applications, springs evaluated, points filtered. {marks}"
        ),
    }


def _table(charts: Charts) -> Table:
    rows: list[dict[str, object]] = []
    for group in charts.groups:
        ahead = {cost: front([p for p in group if not p.is_reference], cost) for cost in (seconds, work)}
        for point in group:
            low, median, high = point.seconds
            rows.append(
                {
                    "scene": point.scene,
                    "quantity": point.quantity,
                    "unit": point.unit,
                    "method": point.method,
                    "setting": point.setting,
                    "value": point.value,
                    "status": point.status,
                    "error": point.error,
                    "± sample": point.half_width,
                    "band": point.band,
                    "over the reference": point.over,
                    "median [s]": median,
                    "lower quartile [s]": low,
                    "upper quartile [s]": high,
                    "runs": point.runs,
                    "set-up [s]": point.setup,
                    "work": point.work,
                    "reference itself": point.is_reference,
                    "front": point in ahead[seconds],
                    "front by work": point in ahead[work],
                }
            )
    return table_of("points", rows)


def _summary(charts: Charts) -> Table:
    return table_of("summary", [_best(group, tolerance) for group in charts.groups for tolerance in TOLERANCES])


def _best(group: Sequence[Point], tolerance: float) -> dict[str, object]:
    best = cheapest([point for point in group if not point.is_reference], tolerance)
    return {
        "scene": group[0].scene,
        "quantity": group[0].quantity,
        "tolerance": tolerance,
        "method": best.method if best else reason_if_none(group, tolerance),
        "setting": best.setting if best else "",
        "median [s]": seconds(best) if best else math.nan,
    }


def _cheapest(summary: Table) -> Table:
    """A column a tolerance."""
    rows: dict[tuple[str, str], dict[str, object]] = {}
    for scene, quantity, tolerance, method, setting, median in zip(*summary.columns.values(), strict=True):
        row = rows.setdefault((scene, quantity), {"scene": scene, "quantity": quantity})
        text = f"{method}, {setting}: {format_seconds(median)}" if setting else method
        row[f"within {100 * tolerance:g} %"] = text
    return table_of("the cheapest method within a tolerance, seconds of one realisation", list(rows.values()))


def _without(charts: Charts) -> Table:
    rows: dict[tuple[str, str, str, str], list[str]] = {}
    for point in charts.points:
        if point.status != FINISHED:
            rows.setdefault((point.scene, point.method, point.setting, point.status), []).append(point.quantity)
    return Table(
        "failed or out of range",
        {
            **{name: [key[i] for key in rows] for i, name in enumerate(("scene", "method", "setting"))},
            "quantities": [", ".join(quantities) for quantities in rows.values()],
            "reason": [key[3] for key in rows],
        },
    )


def _unconverged(charts: Charts) -> tuple[str, ...]:
    lost = (p for p in charts.points if p.method not in MAY_FAIL and p.status.startswith(FAILED))
    return tuple(dict.fromkeys(f"{p.scene}: {p.method}, {p.setting}: {p.status}" for p in lost))


def _orders(charts: Charts) -> list[Number]:
    """Of errors that fall by a power which theory has."""
    found = []
    for scene, quantity, line, order, tolerance, reason in (
        ("sphere", "force", BEM, 2.0, 0.5, "second order; the staircase edge scatters the error from grid to grid"),
        ("sphere", "force", MDR, 2.0, 0.1, "second order: the contact ends at the same part of a spring on each grid"),
        ("square punch", "stiffness", BEM, 1.0, 0.15, "the pressure is singular at the edge: first order"),
    ):
        points = charts.of(scene, quantity, line)
        if len(points) > 2:
            found.append(
                Number(
                    quantity=f"order of the error of the {quantity}",
                    model=line,
                    where={"scene": scene},
                    value=_order(points),
                    reference=order,
                    source="error model",
                    tolerance=tolerance,
                    reason=reason,
                )
            )
    return found


def _order(points: Sequence[Point]) -> float:
    """Slope of ln error against ln of the cell size."""
    n, off = np.array([p.value for p in points]), np.array([p.error for p in points])
    return float(-np.polynomial.polynomial.polyfit(np.log(n), np.log(off), 1)[1])


def _equal(charts: Charts) -> list[Number]:
    """The published iteration and ours at the same residual on the same grids have the same values."""
    found = []
    for scene, quantity in (("sphere", "force"), ("square punch", "stiffness"), ("Westergaard's wave", "approach")):
        fast = {p.value: p.over for p in charts.of(scene, quantity, BEM)}
        pairs = [(p.over, fast[p.value]) for p in charts.of(scene, quantity, POLONSKY_KEER) if p.value in fast]
        if pairs:
            found.append(
                Number(
                    quantity=f"{quantity}, over that of bem3d.solve",
                    model=POLONSKY_KEER,
                    where={"scene": scene, "grids": len(pairs)},
                    value=max((plain / other for plain, other in pairs), key=lambda ratio: abs(ratio - 1)),
                    reference=1.0,
                    source="the same discrete problem has one solution",
                    tolerance=1e-6,
                    reason="a hundred times the residual of both solvers",
                )
            )
    return found


def _models(charts: Charts) -> list[Number]:
    """What is left of the error of each model at its finest setting: findings."""
    found = []
    for group in charts.groups:
        if any(point.is_reference for point in group):
            continue
        finest = {point.method: point for point in group if point.is_model and point.finished}
        for method, last in finest.items():
            scale, tolerance = (1.0, ONE_DECIBEL) if last.unit == "dB" else (100.0, 100 * TEN_PERCENT)
            found.append(
                Number(
                    quantity=f"{'rms' if last.unit == 'dB' else 'relative'} error of the {last.quantity}",
                    model=method,
                    where={"scene": last.scene, "setting": last.setting},
                    value=scale * last.error,
                    reference=0.0,
                    source="boundary elements, extrapolated",
                    tolerance=tolerance,
                    reason="10 %, or 1 dB: tolerance of agreement",
                    unit=last.unit,
                    grid=scale * last.band,
                    sample=scale * last.half_width,
                    role=Role.FINDING,
                )
            )
    return found


CASE = Case(
    name="precision",
    chapter=Chapter.SPEED,
    place=1,
    claim=CLAIM,
    answers="Speed against accuracy: error against cost of every method, and the cheapest within each error",
    quick=QUICK,
    full=FULL,
    run=run,
    evidence=evidence,
    needs="scene by scene",
    timed=True,
)
