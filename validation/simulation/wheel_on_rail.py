"""A wheel with a mass on a rough rail: its contact in each time step, and what the roughness lifts it by."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

import bem3d
import mdr
from mdr.elliptic_wheel import spring_wheel
from mdr.rolling_surface import weights_across
from validation.engine.engine import FloatArray, Outcome
from validation.scenes.damping import DampedWheel
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import BoundaryElementsLaw, ContactLaw, LinearLaw
from validation.simulation.equivalent_displacement import linear_displacement, roll_boundary_elements, roll_springs
from validation.simulation.model_names import LINE, LINEAR, SPRINGS_THAT_READ
from validation.simulation.motion import simulate_from_linear_motion
from validation.simulation.rail_strip import RailStrip

BEM, SPRINGS = "bem3d", SPRINGS_THAT_READ
DEEPER = 2.0
"""Largest approach of the springs in motion, over that of the smooth wheel."""


@dataclass(frozen=True, kw_only=True)
class WheelOnRail:
    """A wheel of a mass that rolls along a periodic strip at a speed, once round.

    strip: with the static load; mass [kg]; speed [m/s]; damping: ratio zeta; model: of the contact; tolerance: residual
    of each contact.
    """

    strip: RailStrip
    mass: float
    speed: float
    model: str
    tolerance: float
    damping: float = 0.0

    @cached_property
    def wheel(self) -> DampedWheel:
        """A sphere with the load curve and the contact length of the ellipse."""
        springs = spring_wheel(self.strip.radii, self.strip.modulus)
        moving = {"mass": self.mass, "load": self.strip.force, "damping": self.damping}
        return DampedWheel(radius=springs.radius, modulus=springs.modulus, **moving)

    @property
    def time_step(self) -> float:
        """One cell of the track [s]."""
        return self.strip.spacing / self.speed

    @cached_property
    def linear(self) -> LinearLaw:
        """The ellipse that keeps its size, by the half-space filter on the same surface."""
        lifted = linear_displacement(self.strip, LINEAR)
        return LinearLaw(self.wheel, self.wheel.stiffness * lifted[:, np.newaxis])

    def law(self) -> ContactLaw:
        if self.model == BEM:
            return EllipseLaw(self.wheel, self.strip, self.tolerance)
        return SurfaceSpringsLaw(self.wheel, self.strip)


class EllipseLaw(BoundaryElementsLaw):
    """Boundary elements under a wheel with two radii."""

    def __init__(self, wheel: Wheel, strip: RailStrip, tolerance: float):
        self.wheel = wheel
        track = bem3d.Track(height=strip.surface, spacing=strip.spacing, radius=strip.radii, modulus=strip.modulus)
        self.contacts = [bem3d.RollingContact(track, tolerance=tolerance)]
        self.operator_applications = 0


class SurfaceSpringsLaw:
    """F = E_1 dx sum_j max(d - x_j^2 / R_1 + H_j(x + x_j), 0) of `mdr.roll_surface`, at an approach of each step."""

    def __init__(self, wheel: Wheel, strip: RailStrip):
        surface, dx = strip.surface, strip.spacing
        (points, across), aspect = surface.shape, strip.contact.across / strip.contact.along
        reach = math.ceil(math.sqrt(wheel.radius * (DEEPER * wheel.approach + float(np.ptp(surface)))) / dx)
        inside, offsets = int(wheel.contact_radius / dx), np.arange(-reach, reach + 1)
        chords = np.maximum(wheel.contact_radius**2 - (dx * np.arange(inside + 2)) ** 2, 0.0)
        read = surface @ weights_across(aspect * np.sqrt(chords), across, dx)
        rows = (np.arange(points)[:, np.newaxis] + offsets) % points
        self.wheel, self.strip, self.spring = wheel, strip, wheel.modulus * dx
        self.level = read[rows, np.minimum(np.abs(offsets), inside + 1)] - (dx * offsets) ** 2 / wheel.radius

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        level = self.level[place % len(self.level)]
        return np.asarray(self.spring * np.maximum(approach[:, np.newaxis] + level, 0.0).sum(axis=1))

    def at_rest(self, place: int) -> FloatArray:
        return roll_springs(self.strip, self.strip.surface, mdr.roll_surface).approach[place : place + 1].copy()


def roll_and_move(case: WheelOnRail) -> Outcome:
    """What lifts the wheel at constant load and in motion, and the force in motion.

    failed: whether a contact has not converged, without which all three are NaN. Motion begins in the steady state of
    linear theory.
    """
    failed = 0.0
    try:
        still = at_constant_load(case)
        approach, force = in_motion(case)
    except bem3d.ConvergenceError:
        failed = 1.0
        still, approach, force = np.full((3, case.strip.shape[0]), np.nan)
    return {
        "constant": still,
        "moving": lift(case.wheel, force, approach),
        "force": force,
        "linear": case.linear.change[:, 0] / case.wheel.stiffness,
        "line": linear_displacement(case.strip, LINE),
        "failed": np.array(failed),
    }


def lift(wheel: Wheel, force: FloatArray, approach: FloatArray) -> FloatArray:
    """r = d_Hertz(F) - d: the approach of the smooth wheel under that force, less the true one [m].

    A wheel that vibrates on a smooth rail has r = 0, however far it moves; under its load r is -(d - d_N).
    """
    return np.asarray(wheel.approach * (np.maximum(force, 0.0) / wheel.load) ** (2 / 3) - approach)


def at_constant_load(case: WheelOnRail) -> FloatArray:
    """d_N - d."""
    if case.model == BEM:
        approach = roll_boundary_elements(case.strip, case.tolerance, raise_on_failure=True).approach
    else:
        approach = roll_springs(case.strip, case.strip.surface, mdr.roll_surface).approach
    return np.asarray(case.wheel.approach - approach)


def in_motion(case: WheelOnRail) -> tuple[FloatArray, FloatArray]:
    """Approach and force at the beginning of each step of one round."""
    motion = simulate_from_linear_motion(case.law(), case.linear, case.time_step, case.strip.shape[0], path=True)
    assert motion.path is not None
    assert motion.force is not None
    return motion.path[:, 0], motion.force[:, 0]
