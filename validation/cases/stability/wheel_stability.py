"""Where time stepping and springs fail: limits of four schemes, the energy of a very long run, coarse springs."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from validation.analysis.evidence import Number, Role, Table
from validation.analysis.series import FIELD, Where, single
from validation.analysis.statistics import POWER_DECIBEL, Estimate
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.engine.engine import FloatArray, Outcome
from validation.simulation import free_vibration as free
from validation.simulation import spring_tracks as springs
from validation.simulation.free_vibration import LIFT_OFF, SCHEMES, TENTHS, WHEEL
from validation.simulation.spring_tracks import FINE, STRIDES, RoughTrack

EULER, SYMPLECTIC, VERLET, KUTTA = "explicit Euler", "symplectic Euler", "velocity Verlet", "Runge-Kutta"
SCHEMES_SHOWN = (EULER, SYMPLECTIC, VERLET, KUTTA)
COMPARED = (VERLET, EULER)
"""Schemes of the long runs: the first should hold its energy, the second should not."""
QUARTER = STRIDES.index(25)
"""Springs a quarter of the shortest wave apart."""
ROUNDING, EPSILON = 1e-9, float(np.finfo(float).eps)
CERTAIN = 2**62
"""Realisations behind a standard error that theory gives."""


@dataclass(frozen=True, kw_only=True)
class WheelStability:
    """A wheel of Table 14.1 at the edge of what its methods can do.

    steps: omega_eigen dt of free linear vibration, ascending, from the first small ones past every limit;
    turns: of it; long_steps: of a very long run on a Hertz contact with dt = a / 100 / v_0; highest: approaches of its
    releases over d_N; heights: h_rms / d_N under coarser springs, the first where linear theory must hold; tracks: of
    these; seed: zero or positive.
    """

    steps: tuple[float, ...] = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 1.9, 1.99, 2.01, 2.1, 2.5, 2.8, 2.86, 3.2)
    turns: int = 6
    long_steps: int = 30_000
    highest: tuple[float, ...] = (1 + springs.HEIGHT / WHEEL.approach, 1.5, 3.0)
    heights: tuple[float, ...] = (1e-3, 0.064)
    tracks: int = 1
    seed: int = 144


def run(case: WheelStability, engine: Engine = SERIAL) -> Outcomes:
    """Solve all problems, the longest first, and try what must be refused."""
    long = [free.LongRun(scheme=name, highest=case.highest, steps=case.long_steps) for name in COMPARED]
    linear = [free.Vibrations(scheme=name, steps=case.steps, natural_periods=case.turns) for name in SCHEMES]
    outcomes: dict[str, Any] = {
        "long": dict(zip(COMPARED, engine.map(free.long_run, long), strict=True)),
        "spacing": engine.map_groups(springs.coarsen, {height: coarser(case, height) for height in case.heights}),
        "linear": dict(zip(SCHEMES, engine.map(free.vibrate, linear), strict=True)),
        "refusals": springs.refusals(),
    }
    return Outcomes(case, outcomes)


def coarser(case: WheelStability, height: float) -> list[RoughTrack]:
    """Tracks of a height h_rms / d_N under springs of many spacings."""
    rough = partial(RoughTrack, rms=height * WHEEL.approach, seed=case.seed, waves=9, per_wave=FINE)
    return [rough(realisation=i) for i in range(case.tracks)]


OMEGA_DT, RELEASE, HEIGHT, WIDTH = "omega dt", "released at [d_N]", "height [d_N]", "q_max dx"
PERIOD = Quantity("error_of_the_period")
CHANGE = Quantity("change_in_a_turn")
STEP = Quantity("growth_of_a_step")
LONG = Quantity("change_of_energy")
GROWTH = Quantity(
    "error_of_ln_growth_in_one_step_on_both_sides_of_the_limit",
    "error of ln(growth in one step), on both sides of the limit",
)
REFUSED = Quantity(
    "calls_that_are_taken_a_step_past_the_limit_or_a_track_with_too_few_points_for_its_waves",
    "calls that are taken: a step past the limit, or a track with too few points for its waves",
)
SUM = Quantity(
    "level_of_the_last_one-third_octave_over_the_sum_over_springs_at_the_least_likely_spacing",
    "level of the last one-third octave over the sum over springs, at the least likely spacing",
)
OCTAVE = Quantity("error_of_the_last_one-third_octave")
DRIFT = Quantity("drift_of_the_conserved_energy")
THEORY = "linear theory"


def series(result: Outcomes) -> list[Series]:
    """Schemes against what is known of them, energy of long runs, springs too far apart."""
    case, taken = result.case, sum(not message for message in result["refusals"].values())
    source = "an error for every call whose motion would grow without bound or whose track would be another one"
    return [
        *(
            s
            for name, vibration in result["linear"].items()
            for s in linear_vibration(name, np.array(case.steps), vibration)
        ),
        *long_runs(case, result["long"]),
        *coarse_springs(result["spacing"]),
        single(REFUSED, "", float(taken), 0.5, source, "half a call: every call counts"),
    ]


def linear_vibration(name: str, x: FloatArray, vibration: Outcome) -> Iterator[Series]:
    """Growth of every step beside its eigenvalue; period and energy beside theory up to the limit."""
    exact, by_theory = free.amplification(name, x), free.first_period(name, np.minimum(x, 1.99))
    limited = x < (SCHEMES[name].limit or 2.0)
    # none where a step turns by no angle
    period = np.abs(x / np.where(vibration["angle"], vibration["angle"], math.nan) - 1)
    # rounding hides smaller differences
    of_theory = np.abs(x / np.angle(exact) - 1)
    for quantity, steps, theory, kept in (
        (PERIOD, period, np.where(of_theory > 1e-8, of_theory, math.nan), limited),
        (CHANGE, vibration["change"], by_theory, limited & (x < 1.9)),
        (STEP, vibration["growth"], np.abs(exact), x > 0),
    ):
        yield Series(quantity, name, steps[kept], along=OMEGA_DT, at=x[kept])
        yield Series(quantity, f"theory of {name}", theory[kept], along=OMEGA_DT, at=x[kept])
    growth, source = (
        np.abs(np.log(vibration["growth"] / np.abs(exact))).max(),
        "eigenvalue of one step of y'' = -omega^2 y",
    )
    yield single(GROWTH, name, growth, ROUNDING, source, "both are exact; rounding remains")


def long_runs(case: WheelStability, runs: Mapping[str, Outcome]) -> Iterator[Series]:
    """Energy in tenths of the run, over that of the beginning; its drift by Verlet where contact stays.

    Each step rounds the approach by `uniform` last places, which does the work of the force on the way.
    """
    steps, uniform = case.long_steps, math.sqrt(1 / 12)
    x = free.LongRun(scheme="", highest=(), steps=steps).omega_dt
    at = np.asarray((np.arange(TENTHS) + 0.5) * (steps // TENTHS))
    growth = np.expm1(at * math.log1p(x**2))
    yield Series(LONG, THEORY, growth, where={RELEASE: case.highest[0]}, along="steps", at=at)
    for i, highest in enumerate(case.highest):
        kept, energy = runs[VERLET]["kept"][:, i] - 1, runs[EULER]["energy"][:, i] - 1
        for name, change in ((VERLET, kept), (EULER, energy)):
            yield Series(LONG, name, np.abs(change), where={RELEASE: highest}, along="steps", at=at)
        if highest < LIFT_OFF:
            walk = math.sqrt(2 * steps) * uniform * EPSILON * highest / (highest - 1)
            source = "H + (omega dt)^2 (v^2 V'' / 12 - V'^2 / 24)"
            reason = "four standard deviations of a random walk of rounding errors, and the terms of order (omega dt)^4"
            where: Where = {"steps": steps, RELEASE: highest}
            yield single(DRIFT, VERLET, free.fit_drift(kept), 4 * walk + x**4, source, reason, where=where)


def coarse_springs(spacing: Mapping[float, Sequence[Outcome]]) -> Iterator[Series]:
    """Means over the tracks; no level where the springs cannot carry the last band. Judged on the lowest roughness."""
    strides = np.array(STRIDES)
    for height, outcomes in spacing.items():
        level, linear, spread = (np.mean([o[key] for o in outcomes], axis=0) for key in ("level", "linear", "spread"))
        carried = level > 0
        of = partial(Series, OCTAVE + " [dB]", where={HEIGHT: height}, along=WIDTH, at=2 * math.pi * strides / FINE)
        decibels, by_theory, left = (
            POWER_DECIBEL * np.log(np.where(carried, x, math.nan))
            for x in (level, linear, 1 + spread / math.sqrt(len(outcomes)))
        )
        left_open = [Estimate(*pair, CERTAIN) for pair in zip(decibels.tolist(), left.tolist(), strict=True)]
        yield of("springs", values=left_open)
        yield of(THEORY, values=by_theory)
        if height > min(spacing):
            continue
        off = decibels - by_theory
        worst = int(np.nanargmax(np.abs(off) / left))
        at_worst, at_a_quarter = (
            {"h/d": height, "dx over the shortest wave": strides[i] / FINE} for i in (worst, QUARTER)
        )
        source = "dx sin(q (m + 1/2) dx) / sin(q dx / 2) in place of 2 sin(q a) / q"
        reason = (
            "five standard deviations of the part of the waves that the moving ends of the contact make on a track; "
            "each spring there has the weight phi(gap / h_rms)"
        )
        yield single(SUM, "springs", off[worst], 5 * left[worst], source, reason, where=at_worst, unit="dB")
        last, source, within = left_open[QUARTER], "the condition dx < lambda / 4", FIELD.tolerance
        reason = f"{FIELD.reason}; z / sin(z) with z = pi / 4 is 0.91 dB at the shortest wave alone"
        yield single(OCTAVE, "springs", last, within, source, reason, where=at_a_quarter, role=Role.FINDING, unit="dB")


def refused(result: Outcomes) -> tuple[Table]:
    calls, answers = zip(*result["refusals"].items(), strict=True)
    return (Table("refusals", {"call": calls, "answer": [a or "none: the call succeeded" for a in answers]}),)


def of_all_schemes(quantity: str) -> tuple[Curve, ...]:
    """Theory, and each scheme."""
    theory = Curve(quantity, tuple(f"theory of {name}" for name in SCHEMES_SHOWN), "", "_", by=("model",))
    return theory, Curve(quantity, SCHEMES_SHOWN, "marks", by=("model",))


def printed(number: Number) -> str:
    return f"{number.value:.2g}{number.behind}"


LOG = partial(Panel, log="xy")
OF_EACH, OF_HEIGHTS = partial(Curve, LONG, by=(RELEASE,)), partial(Curve, OCTAVE + " [dB]", by=(HEIGHT,))
PANELS = (
    LOG(OMEGA_DT, "relative error", of_all_schemes(PERIOD), "period, linear"),
    LOG(OMEGA_DT, "relative change", of_all_schemes(CHANGE), "energy in one period"),
    Panel(
        OMEGA_DT,
        "growth in one step",
        title="near the limits",
        log="y",
        xlim=(0.4, 3.3),
        ylim=(0.2, 10),
        at=(2.0, math.sqrt(8)),
    ).of(*of_all_schemes(STEP)),
    Panel("steps", "|change of energy|", title="very long runs", log="y", ylim=(1e-15, 1e4)).of(
        Curve(LONG, THEORY, "thick"), OF_EACH(VERLET), OF_EACH(EULER, "open", "_")
    ),
    Panel(WIDTH, "error [dB]", title="last one-third octave", at=(math.pi / 2, math.pi)).of(
        OF_HEIGHTS("springs"), OF_HEIGHTS(THEORY, "dotted", "_")
    ),
)
STUDY = Study(
    title="Where time stepping and springs fail",
    method=(
        "The wheel of Table 14.1. Four schemes integrate its free vibration with omega_eigen dt from {c.steps[0]:g} to "
        "past the limit of each on a linear contact. Long runs take {c.long_steps} steps of a / 100 on a Hertz "
        f"contact, released at {{c.highest:.3g}} d_N; above {LIFT_OFF:.3g} d_N the contact opens. Springs of many "
        "spacings roll on one track."
    ),
    series=series,
    claims=(
        Claim(quantity=GROWTH, printed=printed).saying(
            "Time stepping becomes unstable where theory says.",
            short="The growth of a step agrees with theory on both sides of its limit",
            key="instability",
        ),
        Claim(quantity=OCTAVE).saying(
            "On low roughness springs a quarter of the shortest wave apart have the last one-third octave within 1 dB.",
            short="The last one-third octave of springs a quarter wave apart agrees with that of the finest",
            key="last-octave",
        ),
    ),
    charts=(
        Chart("wheel_stability", claims=(0, 1)).of(
            "Free vibration on a linear contact; thin lines: theory. (a) Error of the period, each scheme up to its "
            "limit. (b) Largest change of the energy within one period. (c) Growth in one step near the limits, "
            "dotted. (d) Change of the energy on a Hertz contact over {c.long_steps} steps: full, velocity Verlet; "
            "dotted, explicit Euler; thick: linear theory. (e) Error of the last one-third octave by the spacing of "
            "springs; upright: a quarter of the shortest wave, and the largest spacing that represents it; dotted: "
            "linear theory.",
            *PANELS,
        ),
    ),
    tables=refused,
    printed=("refusals",),
)
CASE = Case(
    name="wheel_stability",
    chapter=Chapter.LIMITS,
    place=1,
    answers="Where time stepping and springs fail: steps up to and past the limit, a very long run, spacing of springs",
    quick=WheelStability(),
    full=WheelStability(turns=20, long_steps=1_000_000, heights=(0.001, 0.064, 1.0), tracks=4),
    run=run,
    study=STUDY,
    needs="closed form",
)
