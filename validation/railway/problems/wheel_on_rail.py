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
from validation.railway.problems.equivalent_displacement import (
    linear_displacement,
    roll_boundary_elements,
    roll_springs,
)
from validation.railway.problems.rail_strip import RailStrip
from validation.scenes.rail_impedance import RailImpedance
from validation.scenes.wheel_body import DampedWheel, Wheel
from validation.simulation.contact_laws import (
    BoundaryElementsLaw,
    ContactLaw,
    HertzLaw,
    LinearLaw,
    dynamic_mass,
    in_series,
)
from validation.simulation.model_names import BEM, LINE, LINEAR
from validation.simulation.motion import simulate_from_linear_motion

DEEPER = 6.0
"""Largest approach of the springs in motion, over that of the smooth wheel."""


@dataclass(frozen=True, kw_only=True)
class WheelOnRail:
    """A wheel of a mass that rolls along a periodic strip at a speed, some rounds.

    strip: with the static load; mass [kg]; speed [m/s]; damping: ratio zeta; rail: that gives way, None where rigid;
    model: of the contact; tolerance: residual of each contact; rounds: that are not kept, and that are.
    """

    strip: RailStrip
    mass: float
    speed: float
    model: str
    tolerance: float
    damping: float = 0.0
    rail: RailImpedance | None = None
    rounds: tuple[int, int] = (0, 1)

    @cached_property
    def wheel(self) -> DampedWheel:
        """A sphere with the load curve and the contact length of the ellipse."""
        springs = spring_wheel(self.strip.radii, self.strip.modulus)
        return DampedWheel(
            radius=springs.radius,
            modulus=springs.modulus,
            mass=self.mass,
            load=self.strip.force,
            damping=self.damping,
            rail=self.rail,
        )

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


class FilteredHertzLaw:
    """The smooth wheel over a filtered roughness, F = F_Hertz(d + r(x)): the filter of constant load holds exactly."""

    def __init__(self, wheel: Wheel, lift: FloatArray):
        self.hertz, self.lift = HertzLaw(wheel), lift

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        return self.hertz.force(place, approach + self.lift[place % self.lift.size])

    def at_rest(self, place: int) -> FloatArray:
        return np.asarray(self.hertz.at_rest(place) - self.lift[place % self.lift.size])


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
    """What lifts the wheel at constant load and in motion, and forces, about their means and through Hann's window.

    All have the length of the rounds that are kept. constant: -(approach - mean) at constant load; moving: of the
    motion, `while_in_contact`; force: of the motion; filtered: that of the smooth wheel over what lifts it at constant
    load; inferred: lift by the force in motion, `over_dynamic_stiffness`; linear, line: of linear theory at constant
    load, and the line itself; airborne, airborne_filtered: share of steps without contact of both motions;
    failed: whether a contact has not converged, without which only linear and line are numbers. Motion begins in the
    steady state of linear theory.
    """
    rounds, failed = case.rounds[1], 0.0
    try:
        still = at_constant_load(case)
        approach, force = in_motion(case, case.law())
        _, filtered = in_motion(case, FilteredHertzLaw(case.wheel, still))
    except bem3d.ConvergenceError:
        failed, steps = 1.0, case.strip.shape[0]
        still, (approach, force, filtered) = np.full(steps, np.nan), np.full((3, rounds * steps), np.nan)
    constant = np.tile(still, rounds)
    tracks = {
        "constant": constant,
        "moving": while_in_contact(lift(case.wheel, force, approach), constant),
        "force": force,
        "filtered": filtered,
        "linear": np.tile(case.linear.change[:, 0] / case.wheel.stiffness, rounds),
        "line": np.tile(linear_displacement(case.strip, LINE), rounds),
    }
    seen = {name: hann(track.size) * (track - track.mean()) for name, track in tracks.items()}
    return {
        **seen,
        "inferred": over_dynamic_stiffness(case, seen["force"]),
        "airborne": share_without_contact(force),
        "airborne_filtered": share_without_contact(filtered),
        "failed": np.array(failed),
    }


def share_without_contact(force: FloatArray) -> FloatArray:
    return np.asarray(np.mean(np.where(np.isnan(force), np.nan, force <= 0)))


def while_in_contact(moving: FloatArray, constant: FloatArray) -> FloatArray:
    """What lifts the wheel in motion, where nothing lifts it in flight: constant + (moving - constant) / share.

    moving: NaN in flight, where its difference to the lift at constant load is left out. share: of the steps in
    contact, so that a lift that is some factor of the constant one has this factor, however often the wheel flies.
    """
    contact = ~np.isnan(moving)
    if not contact.any():
        return moving
    difference = np.where(contact, moving - constant, 0.0)
    off = np.where(contact, difference - difference.sum() / contact.sum(), 0.0)
    return np.asarray(constant + off / contact.mean())


def hann(points: int) -> FloatArray:
    """Hann's window, of mean square one."""
    return np.asarray(np.sin(np.pi * (np.arange(points) + 0.5) / points) ** 2 * math.sqrt(8 / 3))


def over_dynamic_stiffness(case: WheelOnRail, force: FloatArray) -> FloatArray:
    """F (1/k + 1/D) in steps of velocity Verlet, D = -(M w^2 - i c w): what lifts a wheel on a linear contact.

    On a rail that gives way 1/D is the sum over the wheel and the rail.
    """
    wheel, omega = case.wheel, np.asarray(2 * math.pi * np.fft.rfftfreq(force.size, case.time_step)[1:])
    waves = np.fft.rfft(force)
    waves[0] = 0.0
    waves[1:] *= 1 / wheel.stiffness + 1 / in_series(dynamic_mass(wheel, omega, case.time_step))
    return np.fft.irfft(waves, force.size)


def lift(wheel: Wheel, force: FloatArray, approach: FloatArray) -> FloatArray:
    """r = d_Hertz(F) - d: the approach of the smooth wheel under that force, less the true one [m]; NaN in flight.

    A wheel that vibrates on a smooth rail has r = 0, however far it moves; under its load r is -(d - d_N). Without a
    force d is the height of the flight, which the roughness does not set.
    """
    hertz = wheel.approach * (np.maximum(force, 0.0) / wheel.load) ** (2 / 3)
    return np.asarray(np.where(force > 0, hertz - approach, np.nan))


def at_constant_load(case: WheelOnRail) -> FloatArray:
    """d_N - d."""
    if case.model == BEM:
        approach = roll_boundary_elements(case.strip, case.tolerance, raise_on_failure=True).approach
    else:
        approach = roll_springs(case.strip, case.strip.surface, mdr.roll_surface).approach
    return np.asarray(case.wheel.approach - approach)


def in_motion(case: WheelOnRail, law: ContactLaw) -> tuple[FloatArray, FloatArray]:
    """Approach and force at the beginning of each step of the rounds that are kept."""
    before, kept = (rounds * case.strip.shape[0] for rounds in case.rounds)
    motion = simulate_from_linear_motion(law, case.linear, case.time_step, before + kept, path=True)
    assert motion.path is not None
    assert motion.force is not None
    return motion.path[before:, 0], motion.force[before:, 0]
