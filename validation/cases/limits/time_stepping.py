"""Limits of time stepping: small versions of the solves of the case `wheel_stability`."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.features import FEATURES
from validation.cases.limits.sweep import Limit, Point, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.free_vibration import SCHEMES, WHEEL, Vibrations, vibrate
from validation.simulation.integrators import EXPLICIT_EULER, RUNGE_KUTTA, VELOCITY_VERLET, Integrator
from validation.simulation.motion import simulate
from validation.simulation.spring_tracks import LiftOff, RoughTrack, filtered, lift_off

STEP = Limit(
    name="step",
    method="velocity Verlet",
    title="long time step",
    parameter="ω_eigen dt",
    error="growth in one step, less one",
    reference="the bounded motion",
    condition="|λ| = 1 up to ω dt = 2, exp(2 arccosh(ω dt / 2)) above",
    failing_side="above",
    tolerance=1e-3,
    factor=1.01,
    derived=True,
    warned=True,
)
EULER = Limit(
    name="Euler",
    method="explicit Euler",
    title="energy gained",
    parameter="ω_eigen dt",
    error="energy gained in one period",
    reference="the initial energy",
    condition="ω dt = ln(1 + tolerance) / 2π: each step multiplies the energy by 1 + (ω dt)²",
    failing_side="above",
    tolerance=0.1,
    factor=1.5,
    derived=True,
)
KUTTA = Limit(
    name="Runge-Kutta",
    method="Runge-Kutta",
    title="energy lost",
    parameter="ω_eigen dt",
    error="energy lost in one period",
    reference="the initial energy",
    condition="(ω dt)⁵ = -72 ln(1 - tolerance) / 2π: each step multiplies the energy by 1 - (ω dt)⁶ / 72",
    failing_side="above",
    tolerance=0.1,
    factor=1.25,
    derived=True,
)
LIFT = Limit(
    name="lift-off",
    method="linear contact",
    title="lift-off",
    parameter="height h_rms / d_N",
    error="share of the time in the air",
    reference="one-sided springs, dynamic",
    condition="the largest tension of (14.11) reaches the load, on one of the tracks",
    failing_side="above",
    tolerance=1e-4,
    factor=1 + FEATURES["lift-off"].tolerance,
)


@dataclass(frozen=True, kw_only=True)
class TimeSteps:
    """Free linear vibration by three schemes, omega_eigen dt of each."""

    verlet: tuple[float, ...] = (1.5, 1.9, 1.99, 2.01, 2.1, 2.5, 3.0)
    euler: tuple[float, ...] = (0.004, 0.006, 0.009, 0.013, 0.018, 0.03, 0.1, 0.5, 1.5, 2.1)
    kutta: tuple[float, ...] = (0.3, 0.6, 0.9, 1.1, 1.4, 2.0, 2.6, 2.9)
    turns: int = 3

    def sweep(self) -> Outcome:
        """Growth of a step, or the change of the energy in a turn; messages are those of beginning a motion."""
        gain = math.log1p(EULER.tolerance) / (2 * math.pi)
        loss = (-72 * math.log1p(-KUTTA.tolerance) / (2 * math.pi)) ** 0.2
        sweeps = (
            (STEP, VELOCITY_VERLET, self.verlet, 2.0),
            (EULER, EXPLICIT_EULER, self.euler, gain),
            (KUTTA, RUNGE_KUTTA, self.kutta, loss),
        )
        outcome: Outcome = {}
        for limit, scheme, steps, threshold in sweeps:
            assert SCHEMES[scheme.name] is scheme
            found = vibrate(Vibrations(scheme=scheme.name, steps=steps, natural_periods=self.turns))
            error = np.maximum(found["growth"] - 1, 0.0) if limit is STEP else found["change"]
            points = [(float(e), _message_of_step(scheme, x)) for e, x in zip(error, steps, strict=True)]
            outcome |= swept(limit, steps, points, threshold)
        return outcome


@dataclass(frozen=True, kw_only=True)
class HigherTracks:
    """Wheels of Table 14.1 over rough tracks, h_rms / d_N."""

    wheels: int
    seed: int
    heights: tuple[float, ...] = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.3, 1.8)
    waves: int = 6

    def sweep(self) -> Outcome:
        """Part of the time in the air; imbalance: largest error of the balance of momentum, over F_N T."""
        points: list[Point] = []
        imbalance, pulls = [], []
        for height in self.heights:
            track = RoughTrack(rms=height * WHEEL.approach, seed=self.seed, waves=self.waves)
            found = lift_off(LiftOff(sweep="height", load=WHEEL.load, track=track, wheels=self.wheels, laps=1))
            # a linear contact in motion has its force from the filter, which is what warns
            _, message = call_and_record_warnings(partial(filtered, WHEEL, track, track.heights(1)[:, 0]))
            points.append((float(found["airborne"].mean()), message))
            imbalance.append(float(np.abs(found["mean"] - 1 + found["momentum"]).max()))
            pulls.append(float(found["pull"].max()))
        threshold = self.heights[0] / pulls[0]
        return {**swept(LIFT, self.heights, points, threshold), "imbalance": np.array(imbalance)}


def _message_of_step(scheme: Integrator, x: float) -> str:
    """Of a motion in steps of x = omega_eigen dt; a scheme may take several cells of the track in a step."""
    time_step = x / WHEEL.eigenfrequency / scheme.cells
    begin = partial(simulate, WHEEL, HertzLaw(WHEEL), time_step=time_step, steps=1, integrator=scheme)
    return call_and_record_warnings(begin)[1]
