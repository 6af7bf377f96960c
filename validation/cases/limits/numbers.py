"""The numbers of the limits: thresholds, warnings, exponents of iterations, the residual as an estimate."""

import math

import numpy as np
from scipy import stats

from validation.analysis.evidence import Number, Role, Table
from validation.analysis.statistics import student
from validation.cases.limits.limits import LimitsResult
from validation.cases.limits.sweep import Sweep

ROUNDING = 1e-8
"""Errors below it are those of the reference solution."""
EXPECTED_EXPONENTS = {
    "solve": (0.0, "a number of iterations that does not grow with n"),
    "solve_polonsky_keer": (0.5, "square root of the condition number, which grows as n"),
}


def threshold_number(sweep: Sweep) -> Number:
    """Where the error passes its tolerance, over the predicted threshold, in octaves; positive where it fails later."""
    limit = sweep.limit
    sign = 1 if limit.failing_side == "above" else -1
    crossing = sweep.crossing
    if crossing is None:
        fails = bool(sweep.error[0 if sign > 0 else -1] > limit.tolerance)
        crossing = float(sweep.values[0 if fails == (sign > 0) else -1]), 0.0
    return Number(
        quantity="observed threshold over the predicted one, octaves",
        model=limit.method,
        where={"limit": limit.title, "parameter": limit.parameter},
        value=sign * math.log2(crossing[0] / sweep.predicted_threshold),
        reference=0.0,
        source=limit.condition,
        tolerance=math.log2(limit.factor),
        reason=f"within a factor {limit.factor:g}, in octaves",
        grid=crossing[1],
        role=Role.CRITERION if limit.derived else Role.FINDING,
    )


def warnings_number(sweep: Sweep) -> Number:
    """Whether the software warns or refuses past the threshold, and nowhere before it."""
    return Number(
        quantity="share of sweep points where warnings are correct (issued past the threshold, absent before it)",
        model=sweep.limit.method,
        where={"limit": sweep.limit.title},
        value=sweep.share_of_correct_warnings,
        reference=1.0,
        source="warnings or errors past the threshold, none before it",
        tolerance=0.0,
        reason="exact: every value of the sweep counts that is farther from the threshold than the stated factor",
        role=Role.CRITERION if sweep.limit.warned else Role.FINDING,
    )


def momentum_number(result: LimitsResult) -> Number:
    """The balance of momentum of wheels that lift off."""
    return Number(
        quantity="imbalance of impulse and momentum over F_N T, largest",
        model="springs",
        where={"motion": "wheels that lift off"},
        value=float(np.max(result.found["imbalance"])),
        reference=0.0,
        source="momentum: F T - F_N T = M (v_0 - v_end), in contact and in the air",
        tolerance=1e-10,
        reason="rounding: one unit in the last place of the highest force in each step",
        role=Role.IDENTITY,
    )


def exponent_number(iterations: Table, scene: str, solver: str) -> Number:
    """Of the iterations, as a power of the cells on a side."""
    rows = iterations.where(scene=scene, solver=solver)
    line = stats.linregress(np.log(rows["cells"]), np.log(rows["iterations"]))
    degrees = rows["cells"].size - 2
    reference, source = EXPECTED_EXPONENTS[solver]
    return Number(
        quantity="exponent p of the iterations, which grow as n^p with n cells on a side",
        model=solver,
        where={"scene": scene},
        value=float(line.slope),
        reference=reference,
        source=source,
        tolerance=0.15,
        reason="0.15: 11 % more iterations for twice the cells on a side",
        # equal counts lie on their line, and their error comes as 0 / 0
        sample=float(student(degrees) * np.nan_to_num(line.stderr)),
        role=Role.FINDING,
    )


def residual_number(residuals: Table, measure: str) -> Number:
    """The largest error over its residual."""
    return Number(
        quantity="largest ratio of the true error to the residual",
        model="both solvers",
        where={"measure": measure},
        value=float(errors_over_residuals(residuals, measure).max()),
        reference=0.0,
        source="a residual that bounds the error",
        tolerance=10.0,
        reason="a factor 10: one digit",
        role=Role.FINDING,
    )


def errors_over_residuals(residuals: Table, measure: str, **where: object) -> np.ndarray:
    """Of the rows where the error is known and more than rounding."""
    rows = residuals.where(**where) if where else residuals
    error = rows[f"error of the {measure}"]
    known = np.isfinite(error) & (error > ROUNDING)
    return np.asarray(error[known] / rows["residual"][known])
