"""Speed against accuracy: error and cost of every method on all problems, timed one after the other, alone."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

from validation.analysis.evidence import Number, Role, Table, Whose, grouped, table_of
from validation.analysis.number_text import in_seconds, interval_text, plus_minus, short, times_source
from validation.analysis.series import Margin, single
from validation.analysis.statistics import Interval
from validation.benchmarks.peers import all_methods
from validation.benchmarks.timing import FAILED, FINISHED, TimedProblem
from validation.benchmarks.work_precision import pareto
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS, HOURS, FigureCost, figure_cost
from validation.benchmarks.work_precision.pareto import (
    FACTOR,
    SHOWN,
    TOLERANCES,
    Point,
    cheapest,
    cheapest_settings,
    front,
    points,
    time_over,
)
from validation.benchmarks.work_precision.problem import (
    ELEMENTS,
    PUNCH_GRIDS,
    SPHERE_GRIDS,
    SPRINGS,
    ChartProblem,
    Grids,
    PunchProblem,
    RolledOffPunchProblem,
    RollingProblem,
    RoughPunchProblem,
    SphereProblem,
    measure,
)
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Engine, Outcomes, Quantity, Series, Study


@dataclass(frozen=True, kw_only=True)
class Precision:
    """Everything that is timed.

    sphere, punch, fractal, rolled_off, rolling: the problems; cost: of Fig. 14.4; slow: a solve of the same problem
    that takes longer is timed once [s]; enough: after so many seconds five runs are enough; seed: of all roughness,
    zero or positive.
    """

    sphere: SphereProblem = field(default_factory=SphereProblem)
    punch: PunchProblem = field(default_factory=PunchProblem)
    fractal: RoughPunchProblem = field(default_factory=RoughPunchProblem)
    rolled_off: RolledOffPunchProblem = field(default_factory=RolledOffPunchProblem)
    rolling: RollingProblem = field(default_factory=RollingProblem)
    cost: FigureCost = field(default_factory=FigureCost)
    slow: float = 0.2
    enough: float = 0.02
    seed: int = 150

    def problems(self) -> tuple[ChartProblem, ...]:
        """First those with a closed form, then those without."""
        rough = (replace(problem, seed=self.seed) for problem in (self.fractal, self.rolled_off, self.rolling))
        return (self.sphere, self.punch, *rough)


QUICK = Precision(
    fractal=RoughPunchProblem(realisations=8, profiles=60),
    rolled_off=RolledOffPunchProblem(realisations=8, profiles=60),
    rolling=RollingProblem(
        length=16,
        tracks=10,
        grids=Grids(cells=(3, 4, 8), fixed=4, tolerances=(1e-2,), per="to a radius"),
    ),
    cost=FigureCost(steps=20),
)

FULL = Precision(
    sphere=SphereProblem(
        grids=replace(SPHERE_GRIDS, cells=(4, 8, 16, 32, 64)),
        springs=(2.4, 4.4, 8.4, 16.4, 32.4, 64.4, 128.4, 256.4),
    ),
    punch=PunchProblem(grids=replace(PUNCH_GRIDS, cells=(8, 16, 32, 64, 128, 256), fixed=64)),
    fractal=RoughPunchProblem(
        realisations=100,
        profiles=500,
        grids=Grids(cells=(96, 128, 192, 256, 512), fixed=128),
        springs=(96, 128, 256, 512, 1024),
    ),
    rolled_off=RolledOffPunchProblem(
        realisations=100,
        profiles=500,
        grids=Grids(cells=(24, 32, 48, 64, 128, 256), fixed=32),
        springs=(24, 32, 64, 128, 256, 512),
    ),
    rolling=RollingProblem(
        length=32,
        realisations=8,
        tracks=60,
        grids=Grids(cells=(3, 4, 6, 8, 12, 16, 32), fixed=4, per="to a radius"),
    ),
    cost=FigureCost(steps=900),
    slow=1.0,
    enough=0.2,
)


def run(case: Precision, engine: Engine = SERIAL) -> Outcomes:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    problems, settings = case.problems(), {"slow": case.slow, "enough": case.enough}
    with engine.timed() as alone:
        timed = [TimedProblem(problem=each, methods=all_methods(), **settings) for each in problems]
        outcomes = alone.map(measure, timed)
        cost = figure_cost(case.cost, alone)
    charted = [point for pair in zip(problems, outcomes, strict=True) for point in points(*pair)]
    return Outcomes(case, {"charts": charts_of(charted), "cost": cost}, unconverged=failure_messages(charted))


def charts_of(charted: Sequence[Point]) -> list[list[Point]]:
    """Group the points by scene and quantity, a chart each, in their order."""
    return [pareto.monotone_envelope(list(chart)) for _, chart in groupby(charted, key=lambda p: (p.scene, p.quantity))]


def failure_messages(charted: Sequence[Point]) -> tuple[str, ...]:
    """Return a message for each configuration that failed, once for all its quantities."""
    failures = (p for p in charted if p.status.startswith(FAILED))
    return tuple(dict.fromkeys(f"{p.scene}: {p.method}, {p.setting}: {p.status}" for p in failures))


COST = Quantity("time_of_Fig._14.4_on_one_core")
AGREEMENT = "10 %, or 1 dB: tolerance of agreement"
TIME = Quantity("time_over_that_of_the_cheapest_other_method_within_the_tolerance")
UP_TO, FROM = "springs", "boundary elements"
CHEAPEST = Margin(1.0, "above one another method is cheaper")
A_DAY = "a day on one core is not too costly"


def series(result: Outcomes) -> list[Series]:
    """What is left of models; times, none right or wrong."""
    numbers = [series for chart in result["charts"] for series in (*_model_errors(chart), *times(chart))]
    hours, low, high = (float(result["cost"][name][1]) for name in HOURS)
    at, time = {"a/dx": float(result["cost"]["a/dx"][1])}, Interval(hours, max(high - hours, hours - low))
    cost = single(COST, FROM, time, 24.0, "no cost", A_DAY, 0.0, at, role=Role.FINDING, unit="h")
    return [*numbers, cost]


def _model_errors(chart: Sequence[Point]) -> Iterator[Series]:
    """Yield the error of each model at its finest setting, where the chart has no closed form."""
    if any(point.is_reference for point in chart):
        return
    margin = Margin(0.0, AGREEMENT, source="boundary elements, extrapolated")
    for method, last in {point.method: point for point in chart if point.is_model and point.finished}.items():
        kind, scale, within = ("rms", 1.0, 1.0) if last.unit == "dB" else ("relative", 100.0, 10.0)
        yield Series(
            f"{kind} error of the {last.quantity}",
            method,
            (Interval(scale * last.error, scale * last.half_width),),
            where={"scene": last.scene, "setting": last.setting},
            unit=last.unit,
            grid=scale * last.band,
            margin=replace(margin, tolerance=within),
        )


def times(chart: Sequence[Point]) -> Iterator[Series]:
    """Yield times of springs within the tolerances that they reach, and of boundary elements within the others.

    Each over that of the cheapest other method within the same tolerance.
    """
    candidates = [point for point in chart if point.finished and not point.is_reference]
    springs = [point for point in candidates if point.method in SPRINGS]
    elements = [point for point in candidates if point.method in ELEMENTS]
    rivals = [point for point in candidates if point.method not in SPRINGS]
    reached: list[Pair] = []
    beyond: list[Pair] = []
    for tolerance in TOLERANCES[chart[0].unit]:
        if point := cheapest(springs, tolerance):
            reached.append((tolerance, point, cheapest(rivals, tolerance)))
        elif springs and (point := cheapest(elements, tolerance)):
            beyond.append((tolerance, point, cheapest(candidates, tolerance)))
    if reached:
        yield _time_series(UP_TO, reached)
    if beyond:
        yield _time_series(FROM, beyond)


Pair = tuple[float, Point, Point | None]
"""A tolerance in the unit of errors, the cheapest setting of a method, and that of another method, if any."""


def _time_series(model: str, pairs: Sequence[Pair]) -> Series:
    """Return ratios of times within the same tolerances; the ratio is zero where no other method is within."""
    first = pairs[0][1]
    along, at = f"tolerance [{first.unit}]", [SHOWN[first.unit] * tolerance for tolerance, _, _ in pairs]
    where = {"scene": first.scene, "quantity": first.quantity}
    ratios = [_time_ratio(point, other) for _, point, other in pairs]
    series = Series(TIME, model, ratios, where=where, along=along, at=at, margin=CHEAPEST)
    (worst,) = series.numbers
    _, _, other = pairs[[place == worst.where["worst at"] for place in at].index(True)]
    return replace(series, margin=replace(CHEAPEST, source=other.method if other else "no other method is within"))


def _time_ratio(numerator: Point, denominator: Point | None) -> Interval:
    """Return the ratio of median times, zero without a denominator."""
    return time_over(numerator, denominator) if denominator else Interval(0.0, 0.0)


POINTS = "points"
WITHIN = Quantity(
    "the_cheapest_setting_within_a_tolerance_of_each_method",
    "the cheapest setting within a tolerance, of each method: error, time of one realisation, times faster than BEM",
)
WITHOUT = Quantity("failed_or_out_of_range")
COLUMNS = {
    **{name: name for name in ("scene", "quantity", "unit", "method", "setting", "value", "status", "error")},
    **{"± sample": "half_width", "band": "band", "over the reference": "over", "runs": "runs"},
    **{"set-up [s]": "setup", "reference itself": "is_reference"},
}
"""Of points, and what a point calls them."""
QUARTILES = ("lower quartile [s]", "median [s]", "upper quartile [s]")


def tables(result: Outcomes) -> tuple[Table, ...]:
    charts = result["charts"]
    point_table = table_of(POINTS, [row for chart in charts for row in _point_rows(chart)])
    unfinished, by = point_table.rows(point_table["status"] != FINISHED), ("scene", "method", "setting", "status")
    without = grouped(WITHOUT, unfinished, by, {"quantities": lambda group: ", ".join(group["quantity"])})
    settings = cheapest_settings(charts)
    rows = [dict(zip(settings.columns, row, strict=True)) for row in zip(*settings.columns.values(), strict=True)]
    loosest = {unit: SHOWN[unit] * max(tolerances) for unit, tolerances in TOLERANCES.items()}
    shown = [row for row in rows if row["a setting within"] or row["tolerance"] == loosest[row["unit"]]]
    within = table_of(WITHIN, [_row_as_text(row) for row in shown])
    return point_table, settings, within, without, result["cost"]


def _point_rows(chart: Sequence[Point]) -> Iterator[dict[str, object]]:
    """Yield a row of the table for each point, with whether the point lies on the Pareto front."""
    by_time = front(chart)
    for p in chart:
        row = {name: getattr(p, attribute) for name, attribute in COLUMNS.items()} | dict(
            zip(QUARTILES, p.seconds, strict=True)
        )
        yield row | {"front": p in by_time}


def _row_as_text(row: Mapping[str, Any]) -> dict[str, object]:
    """Return a row of `cheapest_settings` as a person reads it; without a setting, the least error of the method."""
    meets, unit = row["a setting within"], row["unit"]
    error = f"{plus_minus(row['error'], row['± sample'] + row['± reference'])} {unit}"
    factor, low, high = (float(row[name]) for name in (FACTOR, "factor from", "factor to"))
    return {
        **{name: row[name] for name in ("scene", "quantity")},
        **{"tolerance": f"{row['tolerance']:g} {unit}", "method": row["method"]},
        **{"setting": row["setting"] if meets else f"none, the closest: {row['setting']}"},
        **{"error": error, "verdict": row["verdict"]},
        **{"time": time_text(row["time [s]"], row["time from [s]"], row["time to [s]"])},
        **{"times faster": f"{short(factor)} ({interval_text(low, high)})" if math.isfinite(factor) else "–"},
    }


def time_text(seconds: float, low: float, high: float) -> str:
    """A median time with its 95 % interval, "54 ms (50 ms to 58 ms)"."""
    return f"{in_seconds(seconds)} ({in_seconds(low)} to {in_seconds(high)})"


MARKS = (
    "Dotted lines: tolerances. Numbers at the marks: the setting, as cells, springs or residual. Grey: the uncertainty "
    "of the reference, or, for closed forms, below the smallest error; marks at its edge, pointing down, lie within "
    "it. Thick line: the Pareto front, by errors. Bars: 95 % intervals of errors, quartiles of times. Crosses along "
    "the top: no result, for the reason in the table."
)


def hours(number: Number) -> str:
    return f"Fig. 14.4 takes {number.value:.2g} h on one core"


STUDY = Study(
    title="Speed against accuracy: the error and the cost of every method",
    method=(
        "Each method is a curve along a parameter: cells, springs, residual. Error: relative to closed forms where "
        "there are any; elsewhere to the two finest grids of boundary elements on the same surfaces, extrapolated to "
        "zero cell size. The last step of this extrapolation is the uncertainty of the reference, and errors below it "
        "are treated as equal to it. A setting is chosen by its error, that of a finer setting where this is larger; "
        "the 95 % interval (sample and reference) gives its verdict. Tolerances: 10, 3 and 1 %, or 3 and 1 dB. Within "
        "each, the cheapest setting of a method is compared with the cheapest of boundary elements, whether coarser, "
        "looser or extrapolated. Errors of the two finest grids are steps of their own extrapolation. Spectra: root "
        "mean square, over octaves, of level differences. Springs have roughness of their own, {c.fractal.profiles} "
        "profiles, {c.rolling.tracks} tracks; boundary elements {c.fractal.realisations} surfaces, "
        "{c.rolling.realisations} strips, whose linear force takes most of their scatter away; these are periodic, "
        "which closed forms are not. Cost: seconds of one realisation, methods in turns, one thread, median and "
        "quartiles; claims compare medians with their 95 % intervals at the worst tolerance of a chart; set-up "
        "(operators, plans, a first drawing) is timed apart. Extrapolated boundary elements cost both grids. Fig. "
        "14.4: {c.cost.wheels} wheels over {c.cost.scene.distance:g} m, on springs or with boundary elements at each "
        "time step."
    ),
    series=series,
    tables=tables,
    printed=(WITHIN, WITHOUT, COST_OF_STEPS),
    claims=(
        Claim(quantity=TIME, printed=times_source).saying(
            "Springs are the cheapest method within each tolerance that they reach, boundary elements elsewhere.",
            short="Springs are the cheapest method within the tolerances that they reach, boundary elements elsewhere",
            key="cheapest",
        ),
        Claim(quantity=COST, differ=True, whose=Whose.BOOK, printed=hours).saying(
            "The rolling contact of a rough wheel in three dimensions is too costly for boundary elements.",
            key="too-costly",
        ),
    ),
    charts=(
        Chart("precision", claims=(0,)).of(f"Error against seconds, punch of Fig. 14.1 and rolling wheel. {MARKS}"),
        Chart("precision-interface").of(f"Error against seconds, punches with a roll-off. {MARKS}"),
        Chart("precision-others").of(f"Error against seconds, a chart a quantity with a closed form. {MARKS}"),
    ),
)
CASE = Case(
    name="precision",
    chapter=Chapter.SPEED,
    place=1,
    answers="Speed against accuracy: error against cost of every method, and the cheapest within each error",
    quick=QUICK,
    full=FULL,
    run=run,
    study=STUDY,
    needs="scene by scene",
    timed=True,
)
