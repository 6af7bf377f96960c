"""What speed against accuracy shows: every point, who is the cheapest, break-even in words, orders, equal answers."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, table_of
from validation.benchmarks.work_precision.case import Precision, PrecisionResult, run
from validation.benchmarks.work_precision.dynamic_wheel import WheelProblem
from validation.benchmarks.work_precision.errors import points
from validation.benchmarks.work_precision.exact_problems import PunchProblem, SphereProblem, WaveProblem
from validation.benchmarks.work_precision.measurement import (
    BEM,
    CLOSED,
    FAILED,
    FED,
    FILTER_1D,
    FINISHED,
    LOOSE,
    MDR,
    PLAIN,
)
from validation.benchmarks.work_precision.pareto import (
    TOLERANCES,
    Point,
    break_even,
    cheapest,
    front,
    said,
    seconds,
    visits,
    why_nobody,
    without_luck,
)
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import Fractal

MODELS = (CLOSED, FILTER_1D, MDR, FED)
"""Whose error no setting of a knob brings to zero, where the surface is rough."""
SOLVED = (MDR, FED, BEM, LOOSE)
"""What has to finish, or to refuse; of the textbook's iteration and of peers a failure is a row."""
TEN, ONE = 0.1, 1.0
"""Relative, and in dB: within which a model is said to agree."""


@dataclass(frozen=True)
class Charts:
    """Points of all scenes, a group a quantity."""

    result: PrecisionResult

    @cached_property
    def points(self) -> list[Point]:
        """All of them."""
        scenes = zip(self.result.case.scenes(), self.result.outcomes, strict=True)
        return [point for scene, outcome in scenes for point in points(scene, outcome)]

    @cached_property
    def groups(self) -> list[list[Point]]:
        """One a chart, in the order of the scenes."""
        found: dict[tuple[str, str], list[Point]] = {}
        for point in self.points:
            found.setdefault((point.scene, point.quantity), []).append(point)
        return [without_luck(group) for group in found.values()]

    def of(self, scene: str, quantity: str, line: str) -> list[Point]:
        """A line of a chart, as far as it has finished."""
        return [p for p in self.points if (p.scene, p.quantity, p.line) == (scene, quantity, line) and p.finished]


def evidence(result: PrecisionResult) -> Evidence:
    """Criteria where something is predicted exactly; the times are tables and conclusions, none right or wrong."""
    charts = Charts(result)
    return Evidence(
        title="Speed against accuracy: which method is enough, and what it costs",
        method=_method(result),
        numbers=(*_orders(charts), *_equal(charts), *_models(charts)),
        tables=(_table(charts), _summary(charts)),
        page_tables=(_cheapest(charts), _without(charts)),
        conclusions=tuple(break_even(group) for group in charts.groups),
        captions=_captions(),
        unconverged=_unconverged(charts),
    )


def _method(result: PrecisionResult) -> str:
    case = result.case
    return (
        "Each method is a line, its knob turned along it: cells, springs, residual. Error: beside closed forms where "
        "there are any; elsewhere beside the two finest grids of boundary elements on the same surfaces, extrapolated "
        "to cells of no size, of which the last step is left open as a band; nothing is ranked below that, and each "
        "method by the upper end of its 95 % interval, or of a finer setting's, where that is larger: luck is no "
        "accuracy. Errors of those two grids are steps of their own extrapolation. Spectra: root mean square, over "
        "one-third octaves, of level differences. "
        f"Springs have roughness of their own, {case.fractal.profiles} profiles, {case.rolling.tracks} "
        f"tracks, {case.wheel.wheels} wheels; boundary elements {case.fractal.surfaces} surfaces, "
        f"{case.rolling.strips} and {case.wheel.strips} strips, whose linear force takes most of their scatter away; "
        "these are periodic, of which closed forms know nothing. "
        "Cost: seconds of one realisation, methods in turns, one thread, median and quartiles; set-up "
        "(operators, plans, a first drawing) is timed apart. Beside it what no machine changes: cells times operator "
        "applications, as if on the whole grid (rolling: on a square around the smooth contact), springs looked at, "
        "points filtered, nodes of a quadrature. Extrapolated boundary elements cost both grids. Who prescribes a "
        "force where an approach is given is carried over along the closed form."
    )


def _captions() -> dict[str, str]:
    marks = (
        "Grey: the uncertainty of the reference, or, of closed forms, what is better than all others; marks at its "
        "edge, pointing down, lie within it. Thick line: the Pareto front, by upper ends of errors. Bars: 95 % of the "
        "sample, quartiles of times. Crosses along the top: failed or refused, for the reason in the table."
    )
    return {
        "precision-summary": (
            "The cheapest method within each tolerance, closed forms left out where they are the reference; levels "
            "within 20 lg (1 + tolerance) dB. Seconds of one realisation, one thread; costs within a factor 1.5 share "
            "a mark."
        ),
        "precision": f"Error against seconds, a chart a quantity. {marks}",
        "precision-visits": (
            "The same against what no machine changes: cells times operator applications, springs looked at, points "
            f"filtered. {marks}"
        ),
    }


def _table(charts: Charts) -> Table:
    rows: list[dict[str, object]] = []
    for group in charts.groups:
        ahead = {cost: front([p for p in group if not p.referee], cost) for cost in (seconds, visits)}
        for point in group:
            low, median, high = point.seconds
            rows.append(
                {
                    "scene": point.scene,
                    "quantity": point.quantity,
                    "unit": point.unit,
                    "method": point.line,
                    "setting": point.setting,
                    "knob": point.value,
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
                    "visits": point.visits,
                    "reference itself": point.referee,
                    "front": point in ahead[seconds],
                    "front by visits": point in ahead[visits],
                }
            )
    return table_of("points", rows)


def _summary(charts: Charts) -> Table:
    rows: list[dict[str, object]] = []
    for group in charts.groups:
        others = [point for point in group if not point.referee]
        for tolerance in TOLERANCES:
            best = cheapest(others, tolerance)
            rows.append(
                {
                    "scene": group[0].scene,
                    "quantity": group[0].quantity,
                    "tolerance": tolerance,
                    "method": best.line if best else why_nobody(group, tolerance),
                    "setting": best.setting if best else "",
                    "median [s]": seconds(best) if best else float("nan"),
                }
            )
    return table_of("summary", rows)


def _cheapest(charts: Charts) -> Table:
    rows: list[dict[str, object]] = []
    for group in charts.groups:
        others = [point for point in group if not point.referee]
        row: dict[str, object] = {"scene": group[0].scene, "quantity": group[0].quantity}
        for tolerance in TOLERANCES:
            best = cheapest(others, tolerance)
            row[f"within {100 * tolerance:g} %"] = (
                f"{best.line}, {best.setting}: {said(seconds(best))}" if best else why_nobody(group, tolerance)
            )
        rows.append(row)
    return table_of("the cheapest method within a tolerance, seconds of one realisation", rows)


def _without(charts: Charts) -> Table:
    rows: dict[tuple[str, str, str, str], list[str]] = {}
    for point in charts.points:
        if point.status != FINISHED:
            rows.setdefault((point.scene, point.line, point.setting, point.status), []).append(point.quantity)
    return Table(
        "failed or refused",
        {
            **{name: [key[i] for key in rows] for i, name in enumerate(("scene", "method", "setting"))},
            "quantities": [", ".join(quantities) for quantities in rows.values()],
            "reason": [key[3] for key in rows],
        },
    )


def _unconverged(charts: Charts) -> tuple[str, ...]:
    lost = (p for p in charts.points if p.line in SOLVED and p.status.startswith(FAILED))
    return tuple(dict.fromkeys(f"{p.scene}: {p.line}, {p.setting}: {p.status}" for p in lost))


def _orders(charts: Charts) -> list[Number]:
    """Of errors that fall by a power which theory has."""
    found = []
    for scene, quantity, line, order, tolerance, reason in (
        ("sphere", "force", BEM, 2.0, 0.5, "second order; the staircase edge scatters the error from grid to grid"),
        ("sphere", "force", MDR, 2.0, 0.1, "second order: the contact ends at the same part of a spring on each"),
        ("square punch", "stiffness", BEM, 1.0, 0.15, "the pressure is singular at the edge: first order"),
    ):
        points = charts.of(scene, quantity, line)
        if len(points) > 2:
            found.append(
                Number(
                    quantity=f"{scene}, {quantity}, {line}: order of the error",
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
    """Plain and fast boundary elements at the same residual on the same grids have the same answer."""
    found = []
    for scene, quantity in (("sphere", "force"), ("square punch", "stiffness"), ("Westergaard's wave", "approach")):
        fast = {p.value: p.over for p in charts.of(scene, quantity, BEM)}
        pairs = [(p.over, fast[p.value]) for p in charts.of(scene, quantity, PLAIN) if p.value in fast]
        if pairs:
            found.append(
                Number(
                    quantity=f"{scene}, {quantity}: plain over fast boundary elements, farthest of {len(pairs)} grids",
                    value=max((plain / other for plain, other in pairs), key=lambda ratio: abs(ratio - 1)),
                    reference=1.0,
                    source="the same discrete problem has one solution",
                    tolerance=1e-6,
                    reason="a hundred times the residual of both",
                )
            )
    return found


def _models(charts: Charts) -> list[Number]:
    """What is left of the error of each model where its knob has done what it can: findings."""
    found = []
    for group in charts.groups:
        if any(point.referee for point in group):
            continue
        for line in MODELS:
            mine = [point for point in group if point.line == line and point.finished]
            if not mine:
                continue
            last = mine[-1]
            decibel = last.unit == "dB"
            found.append(
                Number(
                    quantity=f"{last.scene}, {last.quantity}: error of {line} with {last.setting}",
                    value=last.error if decibel else 100 * last.error,
                    reference=0.0,
                    source="boundary elements, extrapolated",
                    tolerance=ONE if decibel else 100 * TEN,
                    reason="a model is said to agree within 10 %, or 1 dB",
                    unit=last.unit,
                    grid=last.band if decibel else 100 * last.band,
                    sample=last.half_width if decibel else 100 * last.half_width,
                    role=Role.FINDING,
                )
            )
    return found


CASE = Case(
    name="precision",
    chapter=Chapter.SPEED,
    place=1,
    claim="Springs are the cheapest up to some error, boundary elements beyond; scene by scene the chart says which.",
    answers="Speed against accuracy: error against cost of every method, who is the cheapest within which error",
    quick=Precision(),
    full=Precision(
        sphere=SphereProblem(
            cells=(4, 8, 16, 32, 64),
            plain=(4, 8, 16, 32),
            peers=(4, 8, 16, 32),
            springs=(2.4, 4.4, 8.4, 16.4, 32.4, 64.4, 128.4, 256.4),
        ),
        punch=PunchProblem(cells=(8, 16, 32, 64, 128, 256), plain=(8, 16, 32, 64), peers=(8, 16), fixed=64),
        wave=WaveProblem(
            cells=(16, 32, 64, 128, 256, 512, 1024), plain=(16, 64, 256, 1024), peers=(16, 64, 256, 1024), fixed=256
        ),
        fractal=Fractal(
            surfaces=100,
            profiles=500,
            cells=(24, 32, 64, 128, 256),
            plain=(32, 64, 128),
            springs=(24, 32, 64, 128, 256, 512, 1024),
            fixed=128,
        ),
        rolling=RollingProblem(length=32, strips=8, tracks=60, cells=(3, 4, 6, 8, 12, 16, 32), plain=(4, 6), fixed=12),
        wheel=WheelProblem(strips=8, wheels=60, cells=(6, 9, 12, 15, 30), springs=(12, 25, 50, 100), fixed=12),
        slow=1.0,
        enough=0.2,
    ),
    run=run,
    evidence=evidence,
    needs="scene by scene",
    timed=True,
)
