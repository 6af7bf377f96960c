"""Where time stepping and springs fail: limits of four schemes, very long runs, coarse springs, lift-off."""

from collections.abc import Callable
from dataclasses import dataclass

from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.free_vibration import (
    SCHEMES,
    WHEEL,
    Endurance,
    HertzVibrations,
    Vibrations,
    endure,
    vibrate,
    vibrate_hertz,
)
from validation.simulation.integrators import EXPLICIT_EULER, INTEGRATORS, VELOCITY_VERLET, Integrator
from validation.simulation.motion import simulate
from validation.simulation.spring_tracks import (
    FINE,
    HEIGHT,
    LiftOff,
    RoughTrack,
    Rounds,
    Spacings,
    coarsen,
    go_round,
    lift_off,
)

Row = dict[str, object]

COMPARED = (VELOCITY_VERLET.name, EXPLICIT_EULER.name)
"""In runs that are long: who should hold, and who should not."""


@dataclass(frozen=True, kw_only=True)
class WheelStability:
    """A wheel of Table 14.1 at the edge of what its methods can do.

    steps: omega_eigen dt of free linear vibration, ascending, from the first small ones past every limit;
    turns: of it; hertz_steps: omega_eigen dt on a Hertz contact, ascending; hertz_turns: of it; highest: approaches of
    release over d_N; long_steps: of a very long run with dt = a / 100 / v_0; long_highest: as highest; rounds: over the
    rough track, a multiple of ten; heights: h_rms / d_N at the load of Table 14.1; loads: over that load, at the height
    of Table 14.1; lift_rounds: of these; wheels: each on a track of its own; spacing_heights: h_rms / d_N where springs
    are made coarser, the first where linear theory must hold; spacing_tracks: of these; seed: zero or positive.
    """

    steps: tuple[float, ...] = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 1.9, 1.99, 2.01, 2.1, 2.5, 2.8, 2.86, 3.2)
    turns: int = 6
    hertz_steps: tuple[float, ...] = (0.02, 0.04, 0.08, 0.16, 0.32)
    hertz_turns: int = 4
    highest: tuple[float, ...] = (1.1, 1.5, 2.0, 3.0)
    long_steps: int = 30_000
    long_highest: tuple[float, ...] = (1 + HEIGHT / WHEEL.approach, 1.5, 3.0)
    rounds: int = 10
    heights: tuple[float, ...] = (0.1, 0.3, 1.0, 3.0)
    loads: tuple[float, ...] = (0.01, 0.05)
    lift_rounds: int = 1
    wheels: int = 8
    spacing_heights: tuple[float, ...] = (1e-3, 0.064)
    spacing_tracks: int = 1
    seed: int = 144


@dataclass(frozen=True)
class WheelStabilityResult:
    """What each solve found, beside its problem; sentences of refusal."""

    case: WheelStability
    linear: dict[str, Outcome]
    hertz: list[tuple[HertzVibrations, Outcome]]
    long: dict[str, Outcome]
    rounds: dict[str, Outcome]
    lift: list[tuple[LiftOff, Outcome]]
    spacing: list[tuple[Spacings, Outcome]]
    refusals: list[Row]


def run(case: WheelStability, engine: Engine = SERIAL) -> WheelStabilityResult:
    """The longest runs first; refusals are asked for here."""
    long, rounds, lift, spacing = _long(case), _rounds(case), _lift(case), _spacing(case)
    linear = {name: Vibrations(scheme=name, steps=case.steps, turns=case.turns) for name in SCHEMES}
    hertz = [
        HertzVibrations(scheme=name, step=step, highest=case.highest, turns=case.hertz_turns)
        for name in SCHEMES
        for step in case.hertz_steps
    ]
    endured, gone = engine.map(endure, list(long.values())), engine.map(go_round, list(rounds.values()))
    return WheelStabilityResult(
        case=case,
        long=dict(zip(long, endured, strict=True)),
        rounds=dict(zip(rounds, gone, strict=True)),
        lift=list(zip(lift, engine.map(lift_off, lift), strict=True)),
        spacing=list(zip(spacing, engine.map(coarsen, spacing), strict=True)),
        linear=dict(zip(linear, engine.map(vibrate, list(linear.values())), strict=True)),
        hertz=list(zip(hertz, engine.map(vibrate_hertz, hertz), strict=True)),
        refusals=refusals(),
    )


def _long(case: WheelStability) -> dict[str, Endurance]:
    return {name: Endurance(scheme=name, highest=case.long_highest, steps=case.long_steps) for name in COMPARED}


def _rounds(case: WheelStability) -> dict[str, Rounds]:
    track = RoughTrack(rms=HEIGHT, seed=case.seed)
    return {name: Rounds(scheme=name, track=track, wheels=case.wheels, rounds=case.rounds) for name in COMPARED}


def _lift(case: WheelStability) -> list[LiftOff]:
    def rolled(sweep: str, load: float, rms: float) -> LiftOff:
        track = RoughTrack(rms=rms, seed=case.seed)
        return LiftOff(sweep=sweep, load=load, track=track, wheels=case.wheels, rounds=case.lift_rounds)

    heights = [rolled("height", WHEEL.load, height * WHEEL.approach) for height in case.heights]
    return heights + [rolled("load", part * WHEEL.load, HEIGHT) for part in case.loads]


def _spacing(case: WheelStability) -> list[Spacings]:
    return [
        Spacings(track=RoughTrack(rms=h * WHEEL.approach, seed=case.seed, realisation=i, waves=9, per_wave=FINE))
        for h in case.spacing_heights
        for i in range(case.spacing_tracks)
    ]


def refusals() -> list[Row]:
    """What is refused, and in which words."""
    law, rows = HertzLaw(WHEEL), []
    for scheme in INTEGRATORS:
        step = 1.001 * max(scheme.limit, 2.0) / WHEEL.eigenfrequency / scheme.cells

        def past(scheme: Integrator = scheme, step: float = step) -> object:
            return simulate(WHEEL, law, time_step=step, steps=1, integrator=scheme)

        rows.append(_refusal(f"simulate, {scheme.name}, a step just past its limit", past))
    coarse = RoughTrack(rms=HEIGHT, seed=0, per_wave=1)
    return [*rows, _refusal("rough_profile, one point to the shortest wave", lambda: coarse.heights(1))]


def _refusal(asked: str, call: Callable[[], object]) -> Row:
    try:
        call()
    except ValueError as error:
        return {"asked": asked, "refused": 1.0, "answer": str(error)}
    return {"asked": asked, "refused": 0.0, "answer": "none: it was done"}
