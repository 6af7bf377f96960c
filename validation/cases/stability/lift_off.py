"""Wheels that lift off: time airborne, forces and momentum, and where linear theory pulls."""

import numpy as np
from scipy import stats

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.features import FEATURES
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.engine.engine import Outcome
from validation.simulation.spring_tracks import HEIGHT, LiftOff, RoughTrack


def lift_table(result: WheelStabilityResult) -> Table:
    """Of each load and height, over all wheels, with linear theory on the same tracks, and Gauss."""
    return table_of("lift-off", [_lift_row(problem, found) for problem, found in result.lift])


def _lift_row(problem: LiftOff, found: Outcome) -> Row:
    rms = float(np.sqrt(np.mean(found["rms"] ** 2)))
    return {
        "sweep": problem.sweep,
        "load [N]": problem.load,
        "height [d_N]": problem.track.rms / problem.wheel.approach,
        "time airborne": float(found["airborne"].mean()),
        "time airborne, linear": float(found["negative"].mean()),
        "time airborne, Gaussian": float(stats.norm.cdf(-1 / rms)),
        "rms of linear force [F_N]": rms,
        "deepest linear pull [F_N]": float(found["pull"].max()),
        "highest force [F_N]": float(found["highest"].max()),
        "highest force, median [F_N]": float(np.median(found["highest"])),
        "lowest force [F_N]": float(found["lowest"].min()),
        "largest error of the mean force": float(np.abs(found["mean"] - 1).max()),
        "balance of momentum": float(np.abs(found["mean"] - 1 + found["momentum"]).max()),
        "hop [d_N]": float(found["hop"].max() / problem.wheel.approach),
    }


def lift_numbers(result: WheelStabilityResult, table: Table) -> list[Number]:
    """What must hold in the air as on the ground, and from where on wheels lift off."""
    steps = result.case.lift_laps * RoughTrack(rms=HEIGHT, seed=0).points
    highest, rounding = float(table["highest force [F_N]"].max()), float(np.finfo(float).eps)
    sweeps = {sweep: table.where(sweep=sweep) for sweep in ("height", "load")}
    return [
        Number(
            quantity="lowest force over F_N, if negative",
            model="springs",
            value=float(np.minimum(table["lowest force [F_N]"], 0.0).min()),
            reference=0.0,
            source="springs carry no tension",
            tolerance=4 * rounding,
            reason="rounding of g - F / M",
            role=Role.IDENTITY,
        ),
        Number(
            quantity="imbalance of impulse and momentum over F_N T, largest of all loads and heights",
            model="springs",
            value=float(table["balance of momentum"].max()),
            reference=0.0,
            source="momentum: F T - F_N T = M (v_0 - v_end); Verlet counts the first and the last acceleration half",
            tolerance=rounding * highest * steps,
            reason="rounding: one unit in the last place of the highest force in each step",
            role=Role.IDENTITY,
        ),
        *(
            _threshold_number(rows, sweep, seen)
            for sweep, rows in sweeps.items()
            if (seen := first_lift(rows)) is not None
        ),
    ]


def _threshold_number(rows: Table, sweep: str, seen: float) -> Number:
    """From which h / d linear theory pulls and a wheel is first airborne."""
    below = rows["height [d_N]"][rows["height [d_N]"] < seen]
    pull = pulls_from(rows)
    return FEATURES["lift-off"].number(
        seen,
        pull,
        "(14.11): the largest tension exceeds F_N, on the same tracks",
        model="springs",
        where={"sweep": f"sweep of the {sweep}"},
        grid=seen - float(below.max()) if below.size else 0.0,
    )


def first_lift(rows: Table) -> float | None:
    """The lowest h / d at which a wheel was in the air."""
    found = rows["height [d_N]"][rows["time airborne"] > 0]
    return float(found.min()) if found.size else None


def pulls_from(rows: Table) -> float:
    """h / d at which the deepest linear pull is F_N: interpolated, both logarithmic, where the load changes too."""
    order = np.argsort(rows["height [d_N]"])
    height, pull = (np.log(rows[name][order]) for name in ("height [d_N]", "deepest linear pull [F_N]"))
    slope = (height[-1] - height[0]) / (pull[-1] - pull[0])
    if pull[0] <= 0 <= pull[-1]:
        return float(np.exp(np.interp(0.0, pull, height)))
    return float(np.exp(height[0] - slope * pull[0]))
