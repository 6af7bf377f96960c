"""Where time stepping and springs fail: limits of four schemes, very long runs, coarse springs, lift-off."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.free_vibration import (
    SCHEMES,
    WHEEL,
    HertzVibrations,
    LongRun,
    Vibrations,
    long_run,
    vibrate,
    vibrate_hertz,
)
from validation.simulation.integrators import EXPLICIT_EULER, INTEGRATORS, VELOCITY_VERLET
from validation.simulation.motion import simulate
from validation.simulation.spring_tracks import (
    FINE,
    HEIGHT,
    Laps,
    LiftOff,
    RoughTrack,
    coarsen,
    lift_off,
    run_laps,
)

Row = dict[str, object]

COMPARED = (VELOCITY_VERLET.name, EXPLICIT_EULER.name)
"""Schemes of the long runs: the first should hold its energy, the second should not."""


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
    long_highest: tuple[float, ...] = (1 + HEIGHT / WHEEL.approach, 1.5, 3.0)
    laps: int = 10
    heights: tuple[float, ...] = (0.1, 0.3, 1.0, 3.0)
    loads: tuple[float, ...] = (0.01, 0.05)
    lift_laps: int = 1
    wheels: int = 8
    spacing_heights: tuple[float, ...] = (1e-3, 0.064)
    spacing_tracks: int = 1
    seed: int = 144


@dataclass(frozen=True)
class WheelStabilityResult:
    """Outcomes by scheme, by height, or with their problem; what is refused, with the messages."""

    case: WheelStability
    linear: dict[str, Outcome]
    hertz: list[tuple[HertzVibrations, Outcome]]
    long: dict[str, Outcome]
    laps: dict[str, Outcome]
    lift: list[tuple[LiftOff, Outcome]]
    spacing: dict[float, list[Outcome]]
    refusals: list[Row]


def run(case: WheelStability, engine: Engine = SERIAL) -> WheelStabilityResult:
    """Solve all problems, the longest first, and try what must be refused."""
    track, lift = RoughTrack(rms=HEIGHT, seed=case.seed), _lift_problems(case)
    long = [LongRun(scheme=name, highest=case.long_highest, steps=case.long_steps) for name in COMPARED]
    laps = [Laps(scheme=name, track=track, wheels=case.wheels, laps=case.laps) for name in COMPARED]
    linear = [Vibrations(scheme=name, steps=case.steps, natural_periods=case.turns) for name in SCHEMES]
    hertz = [
        HertzVibrations(scheme=name, step=step, highest=case.highest, natural_periods=case.hertz_turns)
        for name in SCHEMES
        for step in case.hertz_steps
    ]
    return WheelStabilityResult(
        case=case,
        long=dict(zip(COMPARED, engine.map(long_run, long), strict=True)),
        laps=dict(zip(COMPARED, engine.map(run_laps, laps), strict=True)),
        lift=list(zip(lift, engine.map(lift_off, lift), strict=True)),
        spacing=engine.map_groups(coarsen, {height: spacing_problems(case, height) for height in case.spacing_heights}),
        linear=dict(zip(SCHEMES, engine.map(vibrate, linear), strict=True)),
        hertz=list(zip(hertz, engine.map(vibrate_hertz, hertz), strict=True)),
        refusals=refusals(),
    )


def _lift_problems(case: WheelStability) -> list[LiftOff]:
    def rolled(sweep: str, load: float, rms: float) -> LiftOff:
        track = RoughTrack(rms=rms, seed=case.seed)
        return LiftOff(sweep=sweep, load=load, track=track, wheels=case.wheels, laps=case.lift_laps)

    heights = [rolled("height", WHEEL.load, height * WHEEL.approach) for height in case.heights]
    return heights + [rolled("load", part * WHEEL.load, HEIGHT) for part in case.loads]


def spacing_problems(case: WheelStability, height: float) -> list[RoughTrack]:
    """Tracks of a height h_rms / d_N under springs of many spacings."""
    rms = height * WHEEL.approach
    return [
        RoughTrack(rms=rms, seed=case.seed, realisation=i, waves=9, per_wave=FINE) for i in range(case.spacing_tracks)
    ]


def refusals() -> list[Row]:
    """Calls that must be refused: time steps past the limit of each scheme, and too few points to a wave."""
    calls: dict[str, Callable[[], object]] = {}
    for scheme in INTEGRATORS:
        step = 1.001 * max(scheme.limit, 2.0) / WHEEL.eigenfrequency / scheme.cells
        calls[f"simulate, {scheme.name}, a step just past its limit"] = partial(
            simulate, WHEEL, HertzLaw(WHEEL), time_step=step, steps=1, integrator=scheme
        )
    coarse = RoughTrack(rms=HEIGHT, seed=0, per_wave=1)
    calls["rough_profile, one point to the shortest wave"] = partial(coarse.heights, 1)
    return [refusal(name, call) for name, call in calls.items()]


def refusal(name: str, call: Callable[[], object]) -> Row:
    """A row of the table: the call, whether it was refused, and the message."""
    try:
        call()
    except ValueError as error:
        return {"call": name, "refused": 1.0, "answer": str(error)}
    return {"call": name, "refused": 0.0, "answer": "none: the call succeeded"}
