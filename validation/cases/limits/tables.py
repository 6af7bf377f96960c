"""The tables of the limits: what the panels of the figures are made of, and the summary on the page."""

import math
from dataclasses import asdict

from validation.analysis.evidence import Table, table_of
from validation.cases.limits.limits import HALF_SPACE_LIMITS, LimitsResult
from validation.cases.limits.solver import MEASURES, Row
from validation.cases.limits.sweep import Sweep

LONGEST = 190
"""Characters of a message in the summary."""


def limits_table(result: LimitsResult) -> Table:
    return table_of(
        "limits",
        [
            {
                "figure": "limits-bem" if s.limit in HALF_SPACE_LIMITS else "limits",
                "predicted threshold": s.predicted_threshold,
                **asdict(s.limit),
                "predicted": float(s.predicted),
                "warning": s.verdict,
            }
            for s in result.sweeps
        ],
    )


def sweeps_table(result: LimitsResult) -> Table:
    return table_of(
        "sweeps",
        [
            {"limit": s.limit.name, "value": float(x), "error": float(e), "warned": float(bool(m)), "message": m}
            for s in result.sweeps
            for x, e, m in zip(s.values, s.error, s.messages, strict=True)
        ],
    )


def iterations_table(result: LimitsResult) -> Table:
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


def residuals_table(result: LimitsResult) -> Table:
    return table_of(
        "residual",
        [
            {
                "scene": grid.scene,
                "solver": grid.solver,
                "tolerance": tolerance,
                "residual": float(found["residual"][i]),
                **{f"error of the {measure}": float(found[measure][i]) for measure in MEASURES},
            }
            for grid, found in result.judged
            for i, tolerance in enumerate(grid.tolerances)
        ],
    )


def summary_table(result: LimitsResult) -> Table:
    """Of each limit its condition, the errors on both sides, the message and the verdicts."""
    return table_of("where each method fails, and its messages", [_summary_row(sweep) for sweep in result.sweeps])


def _summary_row(sweep: Sweep) -> Row:
    limit, (good, failed) = sweep.limit, sweep.extreme_errors
    side = "<" if limit.failing_side == "below" else ">"
    message = sweep.first_message
    shortened = message if len(message) <= LONGEST else message[: LONGEST - 1].rsplit(" ", 1)[0] + " …"
    seen = "error message there, no result to compare" if sweep.refused else "yes" if sweep.predicted else "no"
    return {
        "limit": f"{limit.method}: {limit.title}",
        "fails where": f"{limit.parameter} {side} {sweep.predicted_threshold:.3g}: {limit.condition}",
        "error": f"{limit.error}; reference: {limit.reference}",
        "before the threshold, at most": f"{good:.2g}",
        "past the threshold, at least": f"{failed:.2g}" if math.isfinite(failed) else "no answer",
        "tolerance": f"{limit.tolerance:g}",
        "message of the software": shortened or "none",
        "fails at": f"{sweep.crossing[0]:.3g}" if sweep.crossing else "nowhere",
        "predicted": f"{seen}, within a factor {limit.factor:g}, by {'theory' if limit.derived else 'an estimate'}",
        "user warned": sweep.verdict,
    }
