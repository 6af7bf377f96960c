"""Sweeps through the limits of time stepping: small versions of the solves of the case `wheel_stability`."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import mdr
from validation.cases.limits.sweep import Limit, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.free_vibration import SCHEMES, WHEEL, Vibrations, vibrate
from validation.simulation.integrators import EXPLICIT_EULER, RUNGE_KUTTA, VELOCITY_VERLET, Integrator
from validation.simulation.motion import simulate
from validation.simulation.spring_tracks import LiftOff, RoughTrack, lift_off

STEP = Limit(
    name="step",
    method="velocity Verlet",
    title="long time step",
    knob="ω_eigen dt",
    error="growth of a step, less one",
    against="the bounded motion",
    condition="|λ| = 1 up to ω dt = 2, exp(2 arccosh(ω dt / 2)) above",
    failing="above",
    tolerance=1e-3,
    factor=1.01,
    derived=True,
    warned=True,
)
EULER = Limit(
    name="Euler",
    method="explicit Euler",
    title="energy gained",
    knob="ω_eigen dt",
    error="energy gained in a turn",
    against="the energy it began with",
    condition="ω dt = ln(1 + tolerance) / 2π: the energy grows by 1 + (ω dt)² a step",
    failing="above",
    tolerance=0.1,
    factor=1.5,
    derived=True,
)
KUTTA = Limit(
    name="Runge-Kutta",
    method="Runge-Kutta",
    title="energy lost",
    knob="ω_eigen dt",
    error="energy lost in a turn",
    against="the energy it began with",
    condition="(ω dt)⁵ = -72 ln(1 - tolerance) / 2π: it falls by 1 - (ω dt)⁶ / 72 a step",
    failing="above",
    tolerance=0.1,
    factor=1.25,
    derived=True,
)
LIFT = Limit(
    name="lift-off",
    method="linear contact",
    title="lift-off",
    knob="height h_rms / d_N",
    error="part of the time airborne",
    against="one-sided springs, dynamic",
    condition="the deepest pull of (14.11) is the load, from the lowest track",
    failing="above",
    tolerance=1e-4,
    factor=2.5,
)
LIMITS = (STEP, EULER, KUTTA, LIFT)


@dataclass(frozen=True, kw_only=True)
class TimeSteps:
    """Free linear vibration by three schemes, omega_eigen dt of each."""

    verlet: tuple[float, ...]
    euler: tuple[float, ...]
    kutta: tuple[float, ...]
    turns: int


@dataclass(frozen=True, kw_only=True)
class Hops:
    """Wheels of Table 14.1 over rough tracks, h_rms / d_N."""

    heights: tuple[float, ...]
    wheels: int
    waves: int
    seed: int


def step_out(problem: TimeSteps) -> Outcome:
    """Growth of a step, or the change of the energy in a turn; what is said as a motion is begun with that step."""
    verlet = _vibrated(VELOCITY_VERLET, problem.verlet, problem.turns)
    growth = np.maximum(verlet["growth"] - 1, 0.0)
    gained, lost = (
        _vibrated(scheme, steps, problem.turns)["change"]
        for scheme, steps in ((EXPLICIT_EULER, problem.euler), (RUNGE_KUTTA, problem.kutta))
    )
    gain = math.log1p(EULER.tolerance) / (2 * math.pi)
    loss = (-72 * math.log1p(-KUTTA.tolerance) / (2 * math.pi)) ** 0.2
    return {
        **swept("step", problem.verlet, growth, 2.0, _begun(VELOCITY_VERLET, problem.verlet)),
        **swept("Euler", problem.euler, gained, gain, _begun(EXPLICIT_EULER, problem.euler)),
        **swept("Runge-Kutta", problem.kutta, lost, loss, _begun(RUNGE_KUTTA, problem.kutta)),
    }


def _vibrated(scheme: Integrator, steps: tuple[float, ...], turns: int) -> Outcome:
    assert SCHEMES[scheme.name] is scheme
    return vibrate(Vibrations(scheme=scheme.name, steps=steps, turns=turns))


def _begun(scheme: Integrator, steps: tuple[float, ...]) -> list[str]:
    """What is said of a step of each length: of one cell, of which the scheme may take more."""
    law = HertzLaw(WHEEL)
    return [
        call_and_record_warnings(
            partial(
                simulate,
                WHEEL,
                law,
                time_step=x / WHEEL.eigenfrequency / scheme.cells,
                steps=1,
                integrator=scheme,
            )
        )[1]
        for x in steps
    ]


def hop(problem: Hops) -> Outcome:
    """Part of the time in the air; imbalance: largest error of the balance of momentum, over F_N T."""
    airborne, imbalance, pulls, said = [], [], [], []
    for height in problem.heights:
        track = RoughTrack(rms=height * WHEEL.approach, seed=problem.seed, waves=problem.waves)
        motion = LiftOff(sweep="height", load=WHEEL.load, track=track, wheels=problem.wheels, rounds=1)
        found = lift_off(motion)
        # a linear contact in motion has its force from the filter, which is where a user is told
        _, words = call_and_record_warnings(partial(_filtered, track))
        airborne.append(float(found["airborne"].mean()))
        imbalance.append(float(np.abs(found["mean"] - 1 + found["momentum"]).max()))
        pulls.append(float(found["pull"].max()))
        said.append(words)
    return {
        **swept("lift-off", problem.heights, airborne, problem.heights[0] / pulls[0], said),
        "imbalance": np.array(imbalance),
    }


def _filtered(track: RoughTrack) -> mdr.RollingTrack:
    """The linear force along the first of the tracks."""
    return mdr.roll(
        track.heights(1)[:, 0],
        spacing=track.spacing,
        radius=WHEEL.radius,
        modulus=WHEEL.modulus,
        approach=WHEEL.approach,
        contact="linear",
    )
