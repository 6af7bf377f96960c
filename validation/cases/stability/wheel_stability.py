"""Where time stepping and springs fail: limits of four schemes, very long runs, coarse springs, lift-off."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from validation.analysis.evidence import Role
from validation.analysis.margins import MARGINS
from validation.analysis.series import Estimates, Series, Where, single
from validation.analysis.statistics import POWER_DECIBEL, Estimate, mean_estimate
from validation.analysis.study import Outcomes
from validation.engine.engine import SERIAL, Engine, FloatArray, Outcome
from validation.simulation import free_vibration as free
from validation.simulation import spring_tracks as springs
from validation.simulation.free_vibration import LIFT_OFF, SCHEMES, TENTHS, WHEEL
from validation.simulation.spring_tracks import FINE, STRIDES, RoughTrack
from validation.theory import wheel as wheel_theory

EULER, SYMPLECTIC, VERLET, KUTTA = "explicit Euler", "symplectic Euler", "velocity Verlet", "Runge-Kutta"
ORDERS = {EULER: (2.0, 1.0), SYMPLECTIC: (2.0, 1.0), VERLET: (2.0, 2.0), KUTTA: (4.0, 5.0)}
"""Of the period and of the energy."""
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
    turns: of it; hertz_steps: omega_eigen dt on a Hertz contact, ascending; hertz_turns: of it; highest: approaches of
    release over d_N; long_steps: of a very long run with dt = a / 100 / v_0; long_highest: as highest; laps: over the
    rough track, a multiple of ten; heights: h_rms / d_N at the load of Table 14.1; loads: over that load, at the height
    of Table 14.1; lift_laps: over these tracks; wheels: each on a track of its own; spacing_heights: h_rms / d_N of
    coarser springs, the first where linear theory must hold; spacing_tracks: of these; seed: zero or positive.
    """

    steps: tuple[float, ...] = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 1.9, 1.99, 2.01, 2.1, 2.5, 2.8, 2.86, 3.2)
    turns: int = 6
    hertz_steps: tuple[float, ...] = (0.02, 0.04, 0.08, 0.16, 0.32)
    hertz_turns: int = 4
    highest: tuple[float, ...] = (1.1, 1.5, 2.0, 3.0)
    long_steps: int = 30_000
    long_highest: tuple[float, ...] = (1 + springs.HEIGHT / WHEEL.approach, 1.5, 3.0)
    laps: int = 10
    heights: tuple[float, ...] = (0.1, 0.3, 1.0, 3.0)
    loads: tuple[float, ...] = (0.01, 0.05)
    lift_laps: int = 1
    wheels: int = 8
    spacing_heights: tuple[float, ...] = (1e-3, 0.064)
    spacing_tracks: int = 1
    seed: int = 144


def run(case: WheelStability, engine: Engine = SERIAL) -> Outcomes:
    """Solve all problems, the longest first, and try what must be refused."""
    track, lift = RoughTrack(rms=springs.HEIGHT, seed=case.seed), _lift_problems(case)
    long = [free.LongRun(scheme=name, highest=case.long_highest, steps=case.long_steps) for name in COMPARED]
    laps = [springs.Laps(scheme=name, track=track, wheels=case.wheels, laps=case.laps) for name in COMPARED]
    linear = [free.Vibrations(scheme=name, steps=case.steps, natural_periods=case.turns) for name in SCHEMES]
    hertz = {
        name: [
            free.HertzVibrations(scheme=name, step=step, highest=case.highest, natural_periods=case.hertz_turns)
            for step in case.hertz_steps
        ]
        for name in SCHEMES
    }
    found: dict[str, Any] = {
        "long": dict(zip(COMPARED, engine.map(free.long_run, long), strict=True)),
        "laps": dict(zip(COMPARED, engine.map(springs.run_laps, laps), strict=True)),
        "lift": list(zip(lift, engine.map(springs.lift_off, lift), strict=True)),
        "spacing": engine.map_groups(springs.coarsen, {h: spacing_problems(case, h) for h in case.spacing_heights}),
        "linear": dict(zip(SCHEMES, engine.map(free.vibrate, linear), strict=True)),
        "hertz": engine.map_groups(free.vibrate_hertz, hertz),
        "refusals": springs.refusals(),
    }
    failed = tuple(f"{p.sweep}, load {p.load:g} N" for p, o in found["lift"] if o["failed"])
    return Outcomes(case, found, failed)


def _lift_problems(case: WheelStability) -> list[springs.LiftOff]:
    def rolled(sweep: str, load: float, rms: float) -> springs.LiftOff:
        track = RoughTrack(rms=rms, seed=case.seed)
        return springs.LiftOff(sweep=sweep, load=load, track=track, wheels=case.wheels, laps=case.lift_laps)

    heights = [rolled("height", WHEEL.load, height * WHEEL.approach) for height in case.heights]
    return heights + [rolled("load", part * WHEEL.load, springs.HEIGHT) for part in case.loads]


def spacing_problems(case: WheelStability, height: float) -> list[RoughTrack]:
    """Tracks of a height h_rms / d_N under springs of many spacings."""
    rms = height * WHEEL.approach
    return [
        RoughTrack(rms=rms, seed=case.seed, realisation=i, waves=9, per_wave=FINE) for i in range(case.spacing_tracks)
    ]


OMEGA_DT, RELEASE, HEIGHT, WIDTH = "omega dt", "released at [d_N]", "height [d_N]", "q_max dx"
PERIOD, CHANGE, STEP = "error of the period", "change in a turn", "growth of a step"
GROWTH = "largest error of ln(growth in one step), on both sides of the limit"
LINEAR, HERTZ = "linear contact", "Hertz contact"
LIMIT = "period over 2 pi / omega, extrapolated to dt = 0"
HALVES = "largest change of energy, second half over first half"
SUM = "level of the last one-third octave over the sum over springs, at the least likely spacing"
EULERS, LOWEST = "ln(growth of the energy) over n ln(1 + (omega dt)^2)", "lowest force over F_N, if negative"
IMBALANCE = "imbalance of impulse and momentum over F_N T, largest of all loads and heights"
ON_HERTZ, LONG = "error of the period on a Hertz contact", "change of energy in long runs"
DRIFT, SQUARE, FREE = "drift of the conserved energy", "mean square acceleration", "energy of the free vibration"
LAPS, GROWN = "ln(growth of the {}), last tenth over first", "tenth of the laps over the first one"
ANGLE = "largest relative error of the phase angle of one step, below the limit"
OCTAVE, SPACED = "error of the last one-third octave", "error of force over its fluctuation"
AIRBORNE, HIGHEST, LIFTED = "share of the time in the air", "highest force over the load", "h / d of the first lift-off"
REFUSED = (
    "share of invalid calls that raise an error: a step past the limit, or a track with too few points for its waves"
)
THEORY = "linear theory"


def series(result: Outcomes) -> list[Series]:
    """Schemes against what is known of them, energy of long runs, springs too far apart, forces at lift-off."""
    case, refused = result.case, float(np.mean([bool(told) for told in result["refusals"].values()]))
    source = "an error for every call whose motion would grow without bound or whose track would be another one"
    return [
        *(s for name, found in result["linear"].items() for s in linear_vibration(name, np.array(case.steps), found)),
        *hertz_vibration(case, result["hertz"]),
        *long_runs(case, result["long"]),
        *laps_over_tracks(case, result["laps"]),
        *coarse_springs(result["spacing"]),
        *lift_off(case, result["lift"]),
        single(REFUSED, "", refused, 0.0, source, "exact: every call counts", 1.0),
    ]


def linear_vibration(name: str, x: FloatArray, found: Outcome) -> Iterator[Series]:
    """Growth and angle of every step; orders of the period and of the energy, and the energy itself, of small ones."""
    exact, by_theory = free.amplification(name, x), free.first_period(name, np.minimum(x, 1.99))
    below, limited = x < (SCHEMES[name].limit or x[-1]), x < (SCHEMES[name].limit or 2.0)
    turned = np.abs(found["angle"] / np.angle(exact) - 1)
    period = np.abs(x / np.where(found["angle"], found["angle"], x / 2) - 1)
    # rounding hides smaller differences
    of_theory = np.abs(x / np.angle(exact) - 1)
    for quantity, steps, theory, kept in (
        (PERIOD, period, np.where(of_theory > 1e-8, of_theory, math.nan), limited),
        (CHANGE, found["change"], by_theory, limited & (x < 1.9)),
        (STEP, found["growth"], np.abs(exact), x > 0),
    ):
        yield Series(quantity, name, steps[kept], along=OMEGA_DT, at=x[kept])
        yield Series(quantity, f"theory of {name}", theory[kept], along=OMEGA_DT, at=x[kept])
    one = partial(single, model=name, where={"contact": LINEAR})
    growth, source = np.abs(np.log(found["growth"] / np.abs(exact))).max(), "eigenvalue of one step of y'' = -omega^2 y"
    for quantity, largest in ((GROWTH, growth), (ANGLE, turned[below].max())):
        yield one(quantity, value=largest, within=ROUNDING, of=source, reason="both are exact; rounding remains")
    for quantity, error, order in zip((PERIOD, CHANGE), (period, found["change"]), ORDERS[name], strict=True):
        slope = math.log(error[1] / error[0]) / math.log(x[1] / x[0])
        within, source = 10 * x[1] + 2 * ROUNDING, "leading term in omega dt of the eigenvalue of one step"
        reason = "higher terms, and a period that is no whole number of steps: both of the order of omega dt"
        yield one(f"order of the {quantity}", value=slope, within=within, of=source, reason=reason, reference=order)
    within, source = max(10 * x[0] ** 2, 1e-4 * (name == KUTTA)), "the conserved quantity of the scheme, or |lambda|^2"
    reason = (
        "the extremes may lie between steps, (omega dt)^2; for Runge-Kutta the change is so small that rounding shows"
    )
    over, where = found["change"][0] / by_theory[0], {"contact": LINEAR, OMEGA_DT: x[0]}
    yield single("change of the energy in one period, over theory", name, over, within, source, reason, 1.0, where)


def hertz_vibration(case: WheelStability, found: Mapping[str, Sequence[Outcome]]) -> Iterator[Series]:
    """The period of every release; energy and orders where contact stays: where it opens, they are irregular."""
    x, step = np.array(case.hertz_steps), case.hertz_steps[2]
    reason = (
        f"twice the largest of three steps, omega dt = {step:g}: the next term is smaller by that factor, since "
        "Runge-Kutta loses a part of order (omega dt)^5 of its energy in one period"
    )
    for i, highest in enumerate(case.highest):
        exact, smooth = wheel_theory.hertz_period(highest), highest < LIFT_OFF
        where: Where = {"contact": HERTZ, RELEASE: highest}
        periods = {name: np.array([float(o["period"][i]) for o in outcomes]) for name, outcomes in found.items()}
        for name, period in periods.items():
            error = np.abs(period / exact - 1)
            yield Series(ON_HERTZ, name, error, where={RELEASE: highest}, along=OMEGA_DT, at=x)
            if smooth and name in (VERLET, KUTTA):
                order, (expected, _) = float(np.polyfit(np.log(x[:3]), np.log(error[:3]), 1)[0]), ORDERS[name]
                source, quantity = "order of the scheme", f"order of the {PERIOD}"
                yield single(quantity, name, order, 2 * step, source, reason, expected, where=where)
        (one, two), (first, second) = x[:2] ** 2, periods[VERLET][:2]
        limit, part = float((two * first - one * second) / (two - one)), 0.1 if smooth else 0.5
        within, source = float(part * abs(limit - first)), "integral of the energy between the turning points"
        after = f"terms after dt^2, less than {part:g} of the correction; that part is larger where the contact opens"
        yield single(LIMIT, VERLET, limit, within, source, after, exact, where)
        if smooth:
            late, early = (float(found[VERLET][0][half][i]) for half in ("late", "early"))
            source = "no drift: a symplectic scheme conserves a quantity close to the energy"
            shows = "extremes lie between steps; a drift by a twentieth of the oscillation of the energy would show"
            yield single(HALVES, VERLET, late / early, 0.05, source, shows, 1.0, where)


def long_runs(case: WheelStability, found: Mapping[str, Outcome]) -> Iterator[Series]:
    """Energy in tenths of the run, over that of the beginning: its drift where contact stays, its growth by Euler.

    Each step rounds the approach by `uniform` last places, which does the work of the force on the way.
    """
    steps, uniform = case.long_steps, math.sqrt(1 / 12)
    x = free.LongRun(scheme="", highest=(), steps=steps).omega_dt
    at = np.asarray((np.arange(TENTHS) + 0.5) * (steps // TENTHS))
    growth = at * math.log1p(x**2)
    yield Series(LONG, THEORY, np.expm1(growth), where={RELEASE: case.long_highest[0]}, along="steps", at=at)
    for i, highest in enumerate(case.long_highest):
        kept, energy = found[VERLET]["kept"][:, i] - 1, found[EULER]["energy"][:, i] - 1
        for name, change in ((VERLET, kept), (EULER, energy)):
            yield Series(LONG, name, np.abs(change), where={RELEASE: highest}, along="steps", at=at)
        if highest < LIFT_OFF:
            walk = math.sqrt(2 * steps) * uniform * EPSILON * highest / (highest - 1)
            source = "H + (omega dt)^2 (v^2 V'' / 12 - V'^2 / 24)"
            reason = "four standard deviations of a random walk of rounding errors, and the terms of order (omega dt)^4"
            where: Where = {"contact": HERTZ, "steps": steps, RELEASE: highest}
            yield single(DRIFT, VERLET, free.fit_drift(kept), 4 * walk + x**4, source, reason, where=where)
    highest, gained = case.long_highest[0], np.log1p(found[EULER]["energy"][:, 0] - 1)
    amplitude, source = (highest - 1) * math.exp(growth[-1] / 2), "|lambda|^2 = 1 + (omega dt)^2"
    reason = "square of the largest amplitude over d_N: to that order a Hertz contact is not linear"
    over, where = float((gained[-1] - gained[0]) / (growth[-1] - growth[0])), {"contact": HERTZ, RELEASE: highest}
    yield single(EULERS, EULER, over, amplitude**2, source, reason, 1.0, where)


def laps_over_tracks(case: WheelStability, found: Mapping[str, Outcome]) -> Iterator[Series]:
    """Means over the wheels, each tenth of the laps over the first one; and what is left of growth in the last one.

    Within the scatter of the wheels and what a Hertz contact adds, u'' = 1 - u - (u - 1)^2 / 4 + ..., at an amplitude
    A: the square of A, of the theory; the second harmonic, A / 24 of the first, which n turns tell from it but for
    1 / (2 n): A / (24 n) of the energy of a tenth.
    """
    problem = springs.Laps(scheme="", track=RoughTrack(rms=springs.HEIGHT, seed=0), wheels=1, laps=case.laps)
    steps, at = problem.track.points, np.asarray((np.arange(TENTHS) + 0.5) * case.laps / TENTHS)
    gain = steps * math.log1p(problem.omega_dt**2)
    turns = case.laps / TENTHS * steps * problem.omega_dt / (2 * math.pi)
    yield Series(GROWN, THEORY, case.laps * np.arange(TENTHS) / TENTHS * gain, along="laps", at=at, shown=math.exp)
    for name, (energy, key) in product(COMPARED, {SQUARE: "square", FREE: "free"}.items()):
        tenths = found[name][key]
        grown = Estimates(mean_estimate(np.log(tenth / tenths[0])) for tenth in tenths)
        yield Series(GROWN, name, grown, where={"of": energy}, along="laps", at=at, shown=math.exp)
        if (name, energy) == (EULER, SQUARE):
            continue
        last, theory = grown[-1], float((1 - 1 / TENTHS) * case.laps * gain) if name == EULER else 0.0
        amplitude = (problem.lift + springs.HEIGHT / WHEEL.approach) * math.exp(theory / 2)
        within = last.half_width_among(50) + last.half_width + amplitude / (12 * turns) + theory * amplitude**2
        none = "no growth: a periodic track gives the wheel no energy in the mean"
        source = "n log(1 + (omega dt)^2)" if name == EULER else none
        reason = (
            f"the 99.9 % interval of {last.samples} wheels; of the largest amplitude over d_N the square, of the "
            f"theory, and the second harmonic, which {turns:.3g} turns of a tenth mix with the first"
        )
        where: Where = {"contact": "springs", "laps": case.laps}
        yield single(LAPS.format(energy), name, last, within, source, reason, theory, where)


def coarse_springs(spacing: Mapping[float, Sequence[Outcome]]) -> Iterator[Series]:
    """Means over the tracks; no level where the springs cannot carry the last band. Judged on the lowest roughness."""
    strides = np.array(STRIDES)
    for height, found in spacing.items():
        level, linear, spread = (np.mean([o[key] for o in found], axis=0) for key in ("level", "linear", "spread"))
        carried = level > 0
        of = partial(Series, where={HEIGHT: height}, along=WIDTH, at=2 * math.pi * strides / FINE)
        decibels, by_theory, left = (
            POWER_DECIBEL * np.log(np.where(carried, x, math.nan))
            for x in (level, linear, 1 + spread / math.sqrt(len(found)))
        )
        left_open = [Estimate(*pair, CERTAIN) for pair in zip(decibels.tolist(), left.tolist(), strict=True)]
        yield of(OCTAVE + " [dB]", "springs", found=left_open)
        yield of(OCTAVE + " [dB]", THEORY, found=by_theory)
        yield of(SPACED, "springs", found=np.sqrt(np.mean([o["error"] ** 2 for o in found], axis=0)))
        if height > min(spacing):
            continue
        off = decibels - by_theory
        worst = int(np.nanargmax(np.abs(off) / left))
        there, at_a_quarter = (
            {"h/d": height, "dx over the shortest wave": strides[i] / FINE} for i in (worst, QUARTER)
        )
        source = "dx sin(q (m + 1/2) dx) / sin(q dx / 2) in place of 2 sin(q a) / q"
        reason = (
            "five standard deviations of the part of the waves that the moving ends of the contact make on a track; "
            "each spring there has the weight phi(gap / h_rms)"
        )
        yield single(SUM, "springs", off[worst], 5 * left[worst], source, reason, where=there, unit="dB")
        last, source = left_open[QUARTER], "the condition dx < lambda / 4"
        reason = "1 dB: z / sin(z) with z = pi / 4 is 0.91 dB at the shortest wave alone"
        yield single(OCTAVE, "springs", last, 1.0, source, reason, where=at_a_quarter, role=Role.FINDING, unit="dB")


def lift_off(case: WheelStability, found: Sequence[tuple[springs.LiftOff, Outcome]]) -> Iterator[Series]:
    """What must hold in the air as on the ground, and from which h / d on wheels lift off; linear theory beside it."""
    steps = case.lift_laps * RoughTrack(rms=springs.HEIGHT, seed=0).points
    highest = max(float(o["highest"].max()) for _, o in found)
    lowest = min(float(np.minimum(o["lowest"], 0.0).min()) for _, o in found)
    balance = max(float(np.abs(o["mean"] - 1 + o["momentum"]).max()) for _, o in found)
    source, reason = "springs carry no tension", "rounding of g - F / M"
    yield single(LOWEST, "springs", lowest, 4 * EPSILON, source, reason, role=Role.IDENTITY)
    source = "momentum: F T - F_N T = M (v_0 - v_end); Verlet counts the first and the last acceleration half"
    reason = "rounding: one unit in the last place of the highest force in each step"
    yield single(IMBALANCE, "springs", balance, EPSILON * highest * steps, source, reason, role=Role.IDENTITY)
    pulled = replace(MARGINS["lift-off"], source="(14.11): the largest tension exceeds F_N, on the same tracks")
    for sweep in ("height", "load"):
        mine = [(p.track.rms / p.wheel.approach, o) for p, o in found if p.sweep == sweep]
        height = np.array([h for h, _ in mine])
        pull, force = (np.array([float(o[name].max()) for _, o in mine]) for name in ("pull", "highest"))
        in_the_air, linear = (np.array([float(o[name].mean()) for _, o in mine]) for name in ("airborne", "negative"))
        for quantity, seen, by_theory in ((AIRBORNE, in_the_air, linear), (HIGHEST, force, 1 + pull)):
            for model, values in (("springs", seen), (THEORY, by_theory)):
                yield Series(quantity, model, values, where={"sweep": sweep}, along=HEIGHT, at=height)
        if in_the_air.any():
            first = float(height[in_the_air > 0].min())
            step = first - height[height < first].max() if (height < first).any() else 0.0
            where: Where = {"sweep": f"sweep of the {sweep}"}
            of = partial(Series, LIFTED, "springs", (first,), where=where, margin=pulled)
            yield of(reference=springs.pulls_from(height, pull), grid=float(step))
