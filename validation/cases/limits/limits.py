"""Where each method fails: a sweep through each limit, the threshold that is predicted, what the software says."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
from scipy import stats

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.series import Series, Where, single
from validation.analysis.statistics import Estimate, FloatArray
from validation.analysis.study import Outcomes, Study
from validation.cases.limits.sweeps import HALF_SPACE, LIMITS, SPRINGS, Limit, Sweep
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.limit_sweeps import sweep
from validation.simulation.limits_of_half_space import MEASURES, SCENES, SOLVERS, Grid, press_grid, without_an_answer


@dataclass(frozen=True, kw_only=True)
class Limits:
    """How finely each limit is swept.

    cells: on a side of rough punches; surfaces, profiles: realisations; length: of a rolled strip, over a, at
    strip_cells to a contact radius; track: length of a track on springs, over a; resolved: surfaces on grids of
    different cells; grids: cells on a side, for iterations; judged: cells of the grid on which the residual is judged;
    tolerances: of that, falling; wheels: that lift off; seed: zero or positive.
    """

    cells: int = 64
    surfaces: int = 4
    profiles: int = 100
    length: float = 16.0
    strip_cells: int = 8
    track: float = 256.0
    resolved: int = 2
    grids: tuple[int, ...] = (32, 64, 128, 256)
    judged: int = 64
    tolerances: tuple[float, ...] = tuple(10.0**-i for i in range(1, 11))
    wheels: int = 4
    seed: int = 147

    def on_grids(self) -> dict[str, list[Grid]]:
        """Each scene by each solver: on finer and finer grids to one residual; on one grid to each residual."""
        pairs = [partial(Grid, scene=scene, solver=solver, seed=self.seed) for scene in SCENES for solver in SOLVERS]
        return {
            "iterated": [grid(cells=n, tolerances=(1e-8,)) for grid in pairs for n in self.grids],
            "judged": [grid(cells=self.judged, tolerances=self.tolerances, true=True) for grid in pairs],
        }


def run(case: Limits, engine: Engine = SERIAL) -> Outcomes:
    """Sweep through every limit, solve every grid, and try input without an answer."""
    problems = list(dict.fromkeys(limit.problem(case) for limit in LIMITS))
    swept = dict(zip(problems, engine.map(sweep, problems), strict=True))
    grids = case.on_grids()
    solved = {n: list(zip(grids[n], o, strict=True)) for n, o in engine.map_groups(press_grid, grids).items()}
    found = {
        "sweeps": [Sweep.of(limit, swept[limit.problem(case)]) for limit in LIMITS],
        "tracks": next(outcome for outcome in swept.values() if "imbalance" in outcome),
        **solved,
        "unanswered": without_an_answer(),
    }
    unconverged = (
        *(f"{p.probe.replace('_', ' ')}: {o['failed']:g}" for p, o in swept.items() if np.any(o.get("failed", 0.0))),
        *(
            f"{grid.scene}, {grid.cells}² cells, {grid.solver} to {tolerance:g}"
            for grid, outcome in (*solved["iterated"], *solved["judged"])
            for tolerance, lost in zip(grid.tolerances, outcome["failed"], strict=True)
            if lost
        ),
    )
    return Outcomes(case, found, unconverged)


ROUNDING = 1e-8
"""Errors below it are those of the reference solution."""
EXPECTED_EXPONENTS = {
    "solve": (0.0, "a number of iterations that does not grow with n"),
    "solve_polonsky_keer": (0.5, "square root of the condition number, which grows as n"),
}
THRESHOLD = "observed threshold over the predicted one, octaves"
WARNED = "share of sweep points where warnings are correct (issued past the threshold, absent before it)"
IMBALANCE = "imbalance of impulse and momentum over F_N T, largest"
SUMMARY, UNANSWERED = "where each method fails, and its messages", "input without an answer"
ITERATIONS, APPLICATIONS, CELLS = "iterations", "applications", "cells on a side"
ERROR, EXPONENT = "true error: ", "exponent p of the iterations, which grow as n^p with n cells on a side"
RATIO, RESIDUAL = "largest ratio of the true error to the residual", "residual"


def series(result: Outcomes) -> list[Series]:
    """Each threshold against its condition, warnings, iterations on finer grids, the residual against the truth."""
    imbalance = float(np.max(result["tracks"]["imbalance"]))
    source = "momentum: F T - F_N T = M (v_0 - v_end), in contact and in the air"
    reason = "rounding: one unit in the last place of the highest force in each step"
    where: Where = {"motion": "wheels that lift off"}
    return [
        *map(threshold, result["sweeps"]),
        *map(warnings, result["sweeps"]),
        single(IMBALANCE, "springs", imbalance, 1e-10, source, reason, where=where, role=Role.IDENTITY),
        *work_on_grids(result["iterated"]),
        *errors_of_residuals(result["judged"]),
        *(one for sweep in result["sweeps"] for one in shown(sweep)),
    ]


def threshold(sweep: Sweep) -> Series:
    """Where the error passes its tolerance, over the predicted threshold, in octaves; positive where it fails later."""
    (method, title, parameter), (factor, derived, _) = sweep.limit.named, sweep.limit.judged
    above, (at, half) = sweep.limit.fails.side == "above", sweep.crossing or (math.nan, 0.0)
    if sweep.crossing is None:
        fails = bool(sweep.error[0 if above else -1] > sweep.limit.fails.tolerance)
        at = float(sweep.values[0 if fails == above else -1])
    octaves = (1 if above else -1) * math.log2(at / sweep.predicted_threshold)
    within, reason = math.log2(factor), f"within a factor {factor:g}, in octaves"
    where: Where = {"limit": title, "parameter": parameter}
    role = Role.CRITERION if derived else Role.FINDING
    return single(THRESHOLD, method, octaves, within, sweep.limit.condition, reason, where=where, role=role, grid=half)


def warnings(sweep: Sweep) -> Series:
    """Whether the software warns or refuses past the threshold, and nowhere before it."""
    source = "warnings or errors past the threshold, none before it"
    reason = "exact: every value of the sweep counts that is farther from the threshold than the stated factor"
    (method, title, _), share = sweep.limit.named, sweep.share_of_correct_warnings
    role = Role.CRITERION if sweep.limit.judged.warned else Role.FINDING
    return single(WARNED, method, share, 0.0, source, reason, 1.0, {"limit": title}, role=role)


def shown(sweep: Sweep) -> Iterator[Series]:
    """For the panel of a limit: the error, no less than a hundredth of its tolerance, where a message was given, and
    where the tolerance must be passed."""
    limit, x, tolerance = sweep.limit, sweep.predicted_threshold, sweep.limit.fails.tolerance
    answered, factor = np.isfinite(sweep.error), sweep.limit.judged.factor
    error = np.where(answered, np.maximum(sweep.error, tolerance / 100), math.nan)
    top = max(float(np.nanmax(error)), 4 * tolerance)
    for model, at, values in (
        ("factor", np.array([x / factor, x * factor]), np.full(2, tolerance)),
        ("threshold", np.array([x, x]), np.array([tolerance / 100, top])),
        ("error", sweep.values, error),
        ("message", sweep.values, np.where(sweep.warned, error, math.nan)),
        ("no answer", sweep.values, np.where(answered, math.nan, top)),
    ):
        yield Series(limit.name, model, values, along=limit.named.parameter, at=at)


def work_on_grids(solved: Sequence[tuple[Grid, Outcome]]) -> Iterator[Series]:
    """Iterations of every scene and solver, and the power of the cells on a side with which they grow."""
    reason = "0.15: 11 % more iterations for twice the cells on a side"
    for (solver, (expected, source)), scene in product(EXPECTED_EXPONENTS.items(), SCENES):
        mine = [(grid.cells, found) for grid, found in solved if (grid.scene, grid.solver) == (scene, solver)]
        n, where = np.array([float(cells) for cells, _ in mine]), {"scene": scene}
        for quantity in (ITERATIONS, APPLICATIONS):
            counts = np.array([float(found[quantity][0]) for _, found in mine])
            yield Series(quantity, solver, counts, where=where, along=CELLS, at=n)
            # two points leave a straight line no error
            if quantity == ITERATIONS and n.size > 2:
                p, role = fit_exponent(n, counts), Role.FINDING
                yield single(EXPONENT, solver, p, 0.15, source, reason, expected, where, role=role)


def fit_exponent(n: FloatArray, counts: FloatArray) -> Estimate:
    """p of counts that grow as n^p. Equal counts lie on their line, and their error comes as 0 / 0."""
    line = stats.linregress(np.log(n), np.log(counts))
    return Estimate(float(line.slope), float(np.nan_to_num(line.stderr)), n.size - 1)


def errors_of_residuals(solved: Sequence[tuple[Grid, Outcome]]) -> Iterator[Series]:
    """True errors by the residual, and the largest of them over it, where it is more than rounding."""
    for measure in MEASURES:
        error, residual = (np.concatenate([found[name] for _, found in solved]) for name in (measure, RESIDUAL))
        ends = np.array([residual[error > 0].min(), residual[error > 0].max()])
        yield Series(ERROR + measure, "error = residual", ends, along=RESIDUAL, at=ends)
        for grid, found in solved:
            one = partial(Series, ERROR + measure, grid.solver, found[measure], where={"scene": grid.scene})
            yield one(along=RESIDUAL, at=found[RESIDUAL])
        known = np.isfinite(error) & (error > ROUNDING)
        largest, source = float((error[known] / residual[known]).max()), "a residual that bounds the error"
        ratio = partial(single, RATIO, "both solvers", where={"measure": measure}, role=Role.FINDING)
        yield ratio(largest, 10.0, source, "a factor 10: one digit")


def tables(result: Outcomes) -> list[Table]:
    """On the page: of each limit its condition and the message; input without an answer. All points of all sweeps."""
    points = [
        {"limit": s.limit.name, "value": float(x), "error": float(e), "message": m}
        for s in result["sweeps"]
        for x, e, m in zip(s.values, s.error, s.messages, strict=True)
    ]
    unanswered = [{"call": call, "answer": answer} for call, answer in result["unanswered"].items()]
    summary = [summarised(sweep) for sweep in result["sweeps"]]
    return [table_of(SUMMARY, summary), table_of(UNANSWERED, unanswered), table_of("sweeps", points)]


def summarised(sweep: Sweep) -> dict[str, object]:
    """Of a limit: its condition, its error, where it fails, and what the software says there."""
    limit, (side, error, reference, tolerance) = sweep.limit, sweep.limit.fails
    sign, seen = ">" if side == "above" else "<", "as predicted" if sweep.predicted else "elsewhere"
    return {
        "limit": limit.name,
        "fails where": f"{limit.named.parameter} {sign} {sweep.predicted_threshold:.3g}: {limit.condition}",
        "error": f"{error} above {tolerance:g}; reference: {reference}",
        "fails at": f"{sweep.crossing[0]:.3g}, {seen}" if sweep.crossing else "nowhere",
        "within": f"a factor {limit.judged.factor:g}, by {'theory' if limit.judged.derived else 'an estimate'}",
        "message of the software": textwrap.shorten(sweep.first_message, 190, placeholder=" …") or "none",
        "values with the right message, or with none": f"{100 * sweep.share_of_correct_warnings:.0f} %",
    }


def said(number: Number) -> str:
    if number.quantity == THRESHOLD:
        side = "past" if number.value > 0 else "before"
        return f"fails a factor {2 ** abs(number.value):.2g} {side} the predicted threshold"
    return f"{100 * number.value:.0f} % of its values"


def panel(limit: Limit) -> Panel:
    curves = (
        Curve(limit.name, "threshold", "other", "predicted threshold"),
        Curve(limit.name, "factor", "thick", "its factor, at the tolerance"),
        Curve(limit.name, "error", label="error, no message"),
        Curve(limit.name, "message", "open marks", "warning or error message"),
        Curve(limit.name, "no answer", "crosses", "no answer"),
    )
    title = f"{limit.named.method}:\n{limit.named.title} {'→' if limit.fails.side == 'above' else '←'}"
    log = "xy" if max(limit.probe.values) > 4 * min(limit.probe.values) else "y"
    y, tolerance = textwrap.fill(limit.fails.error, 30), limit.fails.tolerance
    return Panel(limit.named.parameter, y, title=title, log=log, lines=(tolerance,)).of(*curves)


def of_solvers(quantity: str) -> tuple[Curve, ...]:
    solve = partial(Curve, quantity, by=("scene",))
    return solve("solve"), solve("solve_polonsky_keer", "open", "_")


LOG = partial(Panel, log="xy")
ALL = (
    " One panel a limit: the error against the parameter. Arrow: the side on which it must pass its tolerance, the "
    "line, within the factor of the predicted threshold. Open: a message of the software; crosses: no answer. Marks "
    "below: an error of a hundredth of the tolerance or less."
)
AGAINST_CELLS = LOG(CELLS, ITERATIONS, of_solvers(ITERATIONS), "to a residual of 1e-8", legend="upper left")
AGAINST_RESIDUAL = tuple(
    LOG(RESIDUAL, "relative error", (Curve(error, "error = residual", "guide", "_"), *of_solvers(error)), error)
    for error in (ERROR + measure for measure in MEASURES)
)
SOLVER = (
    "(a) Iterations to a residual of 1e-8 against cells on a side: filled, solve; open, Polonsky-Keer. (b), (c), (d) "
    "True error against residual, of the load (force at an approach, approach at a force), of the stiffness (none "
    "where the contact is the same cell by cell), of the pressure in L2; dotted: error = residual."
)
counted = partial(Claim, printed=said)
figure = partial(Chart, claims=(1, 2), columns=4, width=13.0)
STUDY = Study(
    title="Where each method fails, and whether the software warns",
    method=(
        f"{len(LIMITS)} limits of springs, time stepping and boundary elements. A sweep through each limit measures "
        "the error against a better method and records the warnings, or the refusal, of each call. A condition "
        "predicts the threshold of the failure. The threshold counts as predicted if the error exceeds its tolerance "
        "everywhere past it and nowhere before it, but for the factor stated. A user counts as warned if every call "
        "past the threshold warns or raises an error, and no call before it does. Rough punches have {c.cells}² cells, "
        "{c.surfaces} surfaces and {c.profiles} profiles. The case wheel_stability shows time stepping and the spacing "
        "of springs at length, rolling shows rolling in three dimensions, mdr_limits shows contact area and gap."
    ),
    series=series,
    claims=(
        counted(
            says="Each limit of each method is predicted, and the software warns past it.", quantity=(THRESHOLD, WARNED)
        ),
        counted(
            says="Each method fails where its condition says.",
            short="Limits that lie where predicted",
            quantity=THRESHOLD,
        ),
        counted(
            says="The software warns past each limit, and never before it.",
            short="limits past which, and only there, the software warns",
            quantity=WARNED,
        ),
    ),
    charts=(
        figure("limits", "Springs and time stepping." + ALL, tuple(map(panel, SPRINGS)), height=9.6),
        figure("limits-bem", "Boundary elements." + ALL, tuple(map(panel, HALF_SPACE)), height=6.6),
        Chart("limits-solver", claims=(), columns=2, width=9.0, height=6.6).of(
            SOLVER, AGAINST_CELLS, *AGAINST_RESIDUAL
        ),
    ),
    tables=tables,
    printed=(SUMMARY, UNANSWERED),
)
CASE = Case(
    name="limits",
    chapter=Chapter.LIMITS,
    place=2,
    answers="Where each method fails: a sweep through every limit, its predicted threshold, the software's warnings",
    quick=Limits(),
    full=Limits(
        cells=128,
        surfaces=12,
        profiles=400,
        length=64.0,
        strip_cells=12,
        track=1024.0,
        resolved=6,
        grids=(32, 64, 128, 256, 512),
        judged=128,
        wheels=8,
    ),
    run=run,
    study=STUDY,
    needs="not applicable: the case tests every model at its limit",
)
