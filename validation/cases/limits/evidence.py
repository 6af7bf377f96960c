"""What the sweeps through the limits show: predicted or not, told or not."""

import math
from collections.abc import Sequence

import numpy as np
from scipy import stats

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, if_confirmed, table_of
from validation.cases.limits import boundary_elements as limits_bem
from validation.cases.limits.limits import Limits, LimitsResult, run
from validation.cases.limits.solver import MEASURES, SCENES, SOLVERS
from validation.cases.limits.sweep import Sweep

Row = dict[str, object]

LONGEST = 190
"""Characters of a sentence in the table."""
ROUNDING = 1e-8
"""Errors below it are those of what stands for the truth."""
EXPECTED = {"solve": (0.0, "iterations that do not grow"), "solve_plain": (0.5, "the root of a condition number ~ n")}


def evidence(result: LimitsResult) -> Evidence:
    """Each border against its condition, who was told; iterations on finer grids; the residual against the truth."""
    iterations, residuals = _iterations(result), _residuals(result)
    borders = [_border(sweep) for sweep in result.sweeps]
    told = [_told(sweep) for sweep in result.sweeps]
    # two points leave a straight line no error
    pairs = [(scene, solver) for scene in SCENES for solver in SOLVERS if len(result.case.grids) > 2]
    exponents = [_exponent(iterations, *pair) for pair in pairs]
    honest = [_honest(residuals, measure) for measure in MEASURES]
    survived = _survived(result)
    return Evidence(
        title="Where each method fails, and whether it says so",
        method=_method(result),
        numbers=(*borders, *told, survived, *exponents, *honest),
        tables=(_limits(result), _sweeps(result), iterations, residuals),
        conclusions=(
            _of_borders(result, [n for n in borders if n.role is Role.CRITERION]),
            _of_words(result, [n for n in told if n.role is Role.CRITERION]),
            _of_what_else(result, survived),
            *([_of_iterations(exponents)] if exponents else []),
            _of_residuals(residuals, honest),
        ),
        captions=_captions(),
        unconverged=result.unconverged,
        page_tables=(_summary(result), table_of("input without an answer", result.unanswered)),
    )


def _method(result: LimitsResult) -> str:
    case = result.case
    return (
        f"{len(result.sweeps)} limits of springs, time stepping and boundary elements, each swept through: the error "
        "against something better, a border that a condition predicts, and what the software says when a user goes "
        "there, in the warnings of the very call or the words of its refusal. Predicted: past the tolerance everywhere "
        "beyond the border, within it everywhere on the good side, but for the factor stated. Told: a warning or a "
        "refusal everywhere beyond it, and silence on the good side. "
        f"Rough punches of {case.cells}² cells, {case.surfaces} surfaces and {case.profiles} profiles. Time stepping "
        "and the spacing of springs are shown at length in the case wheel_stability, rolling in three dimensions in "
        "rolling, contact area and gap in mdr_limits."
    )


def _border(sweep: Sweep) -> Number:
    """Where the error passes its tolerance, over the predicted border, in octaves; positive where it fails later."""
    limit = sweep.limit
    sign = 1 if limit.failing == "above" else -1
    crossing = sweep.crossing
    if crossing is None:
        fails = bool(sweep.error[0 if sign > 0 else -1] > limit.tolerance)
        crossing = float(sweep.knob[0 if fails == (sign > 0) else -1]), 0.0
    return Number(
        quantity=f"{limit.method}, {limit.title}: where it fails over where it must, octaves of {limit.knob}",
        value=sign * math.log2(crossing[0] / sweep.border),
        reference=0.0,
        source=limit.condition,
        tolerance=math.log2(limit.factor),
        reason=f"a factor {limit.factor:g}",
        grid=crossing[1],
        role=Role.CRITERION if limit.derived else Role.FINDING,
    )


def _told(sweep: Sweep) -> Number:
    limit = sweep.limit
    return Number(
        quantity=f"{limit.method}, {limit.title}: told beyond the border and left in peace on "
        f"the good side, part of both",
        value=sweep.told,
        reference=1.0,
        source="the software speaks where it fails, and only there",
        tolerance=0.0,
        reason="each value of the sweep further from the border than its factor",
        role=Role.CRITERION if limit.warned else Role.FINDING,
    )


def _survived(result: LimitsResult) -> Number:
    imbalance = float(np.max(result.more["imbalance"]))
    return Number(
        quantity="lift-off: F T - F_N T = M (v_0 - v_end), largest difference over F_N T",
        value=imbalance,
        reference=0.0,
        source="momentum, on the ground and in the air",
        tolerance=1e-10,
        reason="rounding, a last place of the highest force each step",
    )


def _exponent(iterations: Table, scene: str, solver: str) -> Number:
    """Of the iterations, as a power of the cells on a side."""
    rows = iterations.where(scene=scene, solver=solver)
    line = stats.linregress(np.log(rows["cells"]), np.log(rows["iterations"]))
    degrees = rows["cells"].size - 2
    reference, source = EXPECTED[solver]
    return Number(
        quantity=f"{solver}, {scene}: iterations ~ cells on a side to the power of",
        value=float(line.slope),
        reference=reference,
        source=source,
        tolerance=0.15,
        reason="a tenth more work from one grid to the next",
        # equal counts lie on their line, and their error comes as 0 / 0
        sample=float(stats.t.ppf(0.975, degrees) * np.nan_to_num(line.stderr)),
        role=Role.FINDING,
    )


def _honest(residuals: Table, measure: str) -> Number:
    """The largest error over its residual."""
    return Number(
        quantity=f"error of the {measure} <= c residual: c",
        value=float(_ratios(residuals, measure).max()),
        reference=0.0,
        source="an honest estimate: the error is no more than the residual says",
        tolerance=10.0,
        reason="a digit",
        role=Role.FINDING,
    )


def _ratios(residuals: Table, measure: str, **where: object) -> np.ndarray:
    rows = residuals.where(**where) if where else residuals
    error = rows[f"error of the {measure}"]
    known = np.isfinite(error) & (error > ROUNDING)
    return np.asarray(error[known] / rows["residual"][known])


def _limits(result: LimitsResult) -> Table:
    """One row a limit: what the panels of the figures are made of."""
    return table_of(
        "limits",
        [
            {
                "limit": s.limit.name,
                "figure": "limits-bem" if s.limit in limits_bem.LIMITS else "limits",
                "method": s.limit.method,
                "title": s.limit.title,
                "knob": s.limit.knob,
                "error": s.limit.error,
                "against": s.limit.against,
                "condition": s.limit.condition,
                "border": s.border,
                "fails": s.limit.failing,
                "tolerance": s.limit.tolerance,
                "factor": s.limit.factor,
                "predicted": float(s.predicted),
                "told": s.verdict,
            }
            for s in result.sweeps
        ],
    )


def _sweeps(result: LimitsResult) -> Table:
    """One row a value of each knob."""
    return table_of(
        "sweeps",
        [
            {"limit": s.limit.name, "value": float(x), "error": float(e), "spoke": float(bool(w)), "said": w}
            for s in result.sweeps
            for x, e, w in zip(s.knob, s.error, s.said, strict=True)
        ],
    )


def _iterations(result: LimitsResult) -> Table:
    return table_of(
        "iterations",
        [
            {
                "scene": grid.scene,
                "solver": grid.solver,
                "cells": grid.cells,
                "iterations": float(found["iterations"][0]),
                "applications": float(found["applications"][0]),
            }
            for grid, found in result.iterated
        ],
    )


def _residuals(result: LimitsResult) -> Table:
    return table_of(
        "residual",
        [
            {
                "scene": grid.scene,
                "solver": grid.solver,
                "asked for": tolerance,
                "residual": float(found["residual"][i]),
                **{f"error of the {measure}": float(found[measure][i]) for measure in MEASURES},
            }
            for grid, found in result.judged
            for i, tolerance in enumerate(grid.tolerances)
        ],
    )


def _summary(result: LimitsResult) -> Table:
    """For the page: limit, condition, errors on both sides, what was said, verdicts."""
    return table_of("where each method fails, and what it says", [_summary_row(sweep) for sweep in result.sweeps])


def _summary_row(sweep: Sweep) -> Row:
    limit, (good, failed) = sweep.limit, sweep.at_the_ends()
    side = "<" if limit.failing == "below" else ">"
    words = sweep.sentence
    shortened = words if len(words) <= LONGEST else words[: LONGEST - 1].rsplit(" ", 1)[0] + " …"
    return {
        "limit": f"{limit.method}: {limit.title}",
        "fails where": f"{limit.knob} {side} {sweep.border:.3g}: {limit.condition}",
        "error": f"{limit.error}, beside {limit.against}",
        "on the good side, at most": f"{good:.2g}",
        "beyond, at least": f"{failed:.2g}" if math.isfinite(failed) else "no answer",
        "tolerance": f"{limit.tolerance:g}",
        "the software said": shortened or "nothing",
        "fails at": f"{sweep.crossing[0]:.3g}" if sweep.crossing else "nowhere",
        "predicted": f"{_foreseen(sweep)}, within a factor {limit.factor:g}, "
        + ("by theory" if limit.derived else "by an estimate"),
        "told": sweep.verdict,
    }


def _foreseen(sweep: Sweep) -> str:
    if sweep.refused:
        return "refused there, no error to see"
    return "yes" if sweep.predicted else "no"


def _named(sweeps: Sequence[Sweep]) -> str:
    return ", ".join(f"{s.limit.title} ({s.limit.method})" for s in sweeps) or "none"


def _of_borders(result: LimitsResult, criteria: Sequence[Number]) -> str:
    refused = [s for s in result.sweeps if s.refused]
    seen = [s for s in result.sweeps if not s.refused]
    missed = [s for s in seen if not s.predicted]
    return if_confirmed(
        f"{len(seen) - len(missed)} of {len(seen)} limits lie where their condition says, within the factor stated for "
        f"each, {sum(s.limit.derived for s in seen)} of them by theory alone and the others by an estimate; not "
        f"predicted: {_named(missed)}. At {len(refused)} more no answer is given, so that no error is seen, and only "
        f"the place of the refusal is judged: {_named(refused)}.",
        criteria,
    )


def _of_words(result: LimitsResult, criteria: Sequence[Number]) -> str:
    told = [s for s in result.sweeps if s.verdict == "told"]
    silent = [s for s in result.sweeps if s.verdict == "not told"]
    partly = [s for s in result.sweeps if s not in told and s not in silent]
    return if_confirmed(
        f"A user who goes too far is told at {len(told)} of {len(result.sweeps)} limits: {_named(told)}. Told in part: "
        + ("; ".join(f"{s.limit.title} ({s.limit.method}), {s.verdict}" for s in partly) or "none")
        + f". Not told at {len(silent)}: {_named(silent)}.",
        criteria,
    )


def _of_what_else(result: LimitsResult, survived: Number) -> str:
    more = result.more
    loads, work = more["full contact knob"], more["full contact, iterations"]
    error, fed = more["full contact, L2"], more["level, fed for rolling"]
    level = next(s for s in result.sweeps if s.limit.name == "level").at_the_ends()[0]
    return if_confirmed(
        f"Under a force instead of an approach full contact is no limit: from {loads[0]:g} to {loads[-1]:g} p* the "
        f"pressure is within {error.max():.2g} of Westergaard in L2 after {work.min():.0f} to {work.max():.0f} "
        "iterations. "
        f"The level along the track is already {level:.2g} dB off for waves much longer than the contact: it is the "
        "tolerance that says where it fails. "
        f"Springs that are fed for rolling, not by Geike's rule, are at most {fed.max():.2g} dB from the half-space in "
        f"any octave. Wheels that lift off come back: momentum balances to {survived.value:.1g}.",
        [survived],
    )


def _of_iterations(exponents: Sequence[Number]) -> str:
    found = "; ".join(
        f"{n.label.removesuffix(': iterations ~ cells on a side to the power of')} {n.value:.2f} ± {n.sample:.2f}"
        for n in exponents
    )
    return f"Iterations to a residual of 1e-8 grow with the cells on a side to the power of: {found}."


def _of_residuals(residuals: Table, honest: Sequence[Number]) -> str:
    worst = ", ".join(f"{measure} {n.value:.2g}" for measure, n in zip(MEASURES, honest, strict=True))
    fast = ", ".join(f"{measure} {_ratios(residuals, measure, solver='solve').max():.2g}" for measure in MEASURES)
    return (
        f"The residual as an estimate: error <= c residual, with c = {worst} over all scenes, residuals and both "
        f"solvers; of solve alone {fast}."
    )


def _captions() -> dict[str, str]:
    panel = (
        "Dashed: the border that its condition predicts, with the factor claimed for it; shaded: where it must fail; "
        "dotted: the tolerance. Open marks: the software warned or refused; filled: it was silent; crosses at the "
        "upper edge: no answer; marks at the lower edge: that or less."
    )
    return {
        "limits": f"Limits of springs and of time stepping: error against knob. {panel}",
        "limits-bem": f"Limits of boundary elements. {panel}",
        "limits-solver": (
            "(a) Iterations to a residual of 1e-8 against cells on a side: filled, solve; open, the textbook's. (b), "
            "(c), (d) True error against residual, of the load (force at an approach, approach at a force), of the "
            "stiffness (none where the contact is the same cell by cell), of the pressure in L2; dotted: error = "
            "residual."
        ),
    }


CASE = Case(
    name="limits",
    chapter=Chapter.LIMITS,
    place=2,
    claim="Each limit of each method is predicted, and the software tells who crosses it.",
    answers="Where each method fails: every limit swept through, the border predicted, and what the software says",
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
    evidence=evidence,
    needs="none: all of them at their limits",
)
