"""Contact forces under a wheel that rolls: Hertz, a linear filter, springs, boundary elements, with one interface."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.engine.engine import FloatArray
from validation.scenes.wheel_body import Wheel, moving_bodies

ComplexArray = NDArray[np.complex128]


class ContactLaw(Protocol):
    """The contact of several wheels, each on a track of its own, all at the same place."""

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        """The force on each wheel at approaches of any sign, (wheels,) [N]; a linear law alone pulls; place: a cell."""

    def at_rest(self, place: int) -> FloatArray:
        """The approach of each wheel at which it bears its load, shape (wheels,) [m]."""


@dataclass(frozen=True)
class HertzLaw:
    """F = 4/3 E* sqrt(R) max(d, 0)^(3/2): a smooth track. wheels: how many."""

    wheel: Wheel
    wheels: int = 1

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        d = np.maximum(approach, 0.0)
        return np.asarray(4 / 3 * self.wheel.modulus * math.sqrt(self.wheel.radius) * d * np.sqrt(d))

    def at_rest(self, place: int) -> FloatArray:
        return np.full(self.wheels, self.wheel.approach)


@dataclass(frozen=True)
class LinearLaw:
    """F = F_N + k (d - d_N) + dF(x): a contact that keeps its radius.

    change: dF of the roughness at the approach d_N, shape (places, wheels) [N]. It may pull.
    """

    wheel: Wheel
    change: FloatArray

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        linear = self.wheel.load + self.wheel.stiffness * (approach - self.wheel.approach)
        return np.asarray(linear + self.change[place % len(self.change)])

    def at_rest(self, place: int) -> FloatArray:
        """d_N - dF / k."""
        return np.asarray(self.wheel.approach - self.change[place % len(self.change)] / self.wheel.stiffness)

    def steady_state(self, time_step: float) -> tuple[FloatArray, FloatArray]:
        """Approach and velocity at place 0 of the motion that repeats itself with the track, exactly in leapfrog steps.

        d = d_N + sum_j y_j exp(i omega_j t), no free vibration; with s = 2 sin(omega_j dt / 2) / dt
        y_j = -dF_j / (k + D), D = -M s^2 + i c sin(omega_j dt) / dt; on a rail that gives way 1 / D is the sum over the
        wheel and each body of the rail. Velocities are shaped as in `Motion`.
        Raises ValueError for a track on which a wave resonates.
        """
        count = len(self.change)
        waves = np.fft.rfft(self.change, axis=0, norm="forward")
        omega = np.asarray(2 * np.pi * np.fft.rfftfreq(count, time_step))
        each = dynamic_mass(self.wheel, omega, time_step)[:, :, np.newaxis]
        body = in_series(each)
        dynamic = self.wheel.stiffness + body
        if np.abs(dynamic).min() < 1e-9 * self.wheel.stiffness:
            raise ValueError("the track must not have a wave at the resonance, whose motion does not repeat itself")
        # the velocity of leapfrog at whole steps is the central difference
        motion = np.fft.irfft(-waves / dynamic, count, axis=0, norm="forward")
        if len(each) == 1:
            velocity = (motion[1] - motion[-1]) / (2 * time_step)
            return np.asarray(self.wheel.approach + motion[0]), np.asarray(velocity)
        # each body takes its share of the approach, but of its mean, which is no motion
        share = np.divide(body, each, out=np.zeros_like(each), where=each != 0)
        share[:, 0] = 0.0
        each_moves = np.fft.irfft(-waves / dynamic * share, count, axis=1, norm="forward")
        velocities = (each_moves[:, 1] - each_moves[:, -1]) / (2 * time_step)
        return np.asarray(self.wheel.approach + motion[0]), np.asarray(velocities)


def dynamic_mass(wheel: Wheel, omega: FloatArray, time_step: float) -> ComplexArray:
    """-m s^2 + i c sin(omega dt) / dt in steps of leapfrog, force over displacement [N/m], (1 + bodies, frequencies).

    Of the wheel, and of each body of the rail under it; s = 2 sin(omega dt / 2) / dt.
    """
    stepped, speed = (2 * np.sin(omega * time_step / 2) / time_step) ** 2, np.sin(omega * time_step) / time_step
    return np.array([-body.mass * stepped + 1j * body.dashpot * speed for body in moving_bodies(wheel, time_step)])


def in_series(stiffness: ComplexArray) -> ComplexArray:
    """1 / sum of 1 / D over the first axis; zero where one of them is."""
    if len(stiffness) == 1:
        return np.asarray(stiffness[0])
    still = (stiffness == 0).any(axis=0)
    return np.asarray(np.where(still, 0.0, 1 / (1 / np.where(still, 1.0, stiffness)).sum(axis=0)))


class SpringsLaw:
    """One-sided springs, (14.15): height of tracks, shape (places, wheels), positive towards the wheel; spacing [m]."""

    def __init__(self, wheel: Wheel, height: FloatArray, spacing: float):
        self.wheel = wheel
        self.foundation = mdr.RollingEnsemble(
            height, spacing=spacing, radius=wheel.radius, modulus=wheel.modulus, force=wheel.load
        )

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        return self.foundation.force(place, approach)

    def at_rest(self, place: int) -> FloatArray:
        """The approach of each wheel under its load, by Newton's method on the springs [m]."""
        return self.foundation.approach(place, self.wheel.load)


class BoundaryElementsLaw:
    """Three-dimensional contact on rough strips of shape (places, width), one a wheel.

    tolerance: residual of each contact. Raises bem3d.ConvergenceError where one does not converge.
    """

    def __init__(self, wheel: Wheel, strips: Sequence[FloatArray], spacing: float, *, tolerance: float = 1e-5):
        self.wheel = wheel
        self.contacts = [
            bem3d.RollingContact(
                bem3d.Track(height=strip, spacing=spacing, radius=wheel.radius, modulus=wheel.modulus),
                tolerance=tolerance,
            )
            for strip in strips
        ]
        self.operator_applications = 0

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        """One contact problem a wheel, begun from those of the two places before."""
        pairs = zip(self.contacts, approach, strict=True)
        return np.array(
            [self._require_convergence(contact.press(place, float(d)), place).force for contact, d in pairs]
        )

    def at_rest(self, place: int) -> FloatArray:
        """The approach of each contact under the load, a solve a wheel [m]."""
        contacts = (
            self._require_convergence(contact.carry(place, self.wheel.load), place) for contact in self.contacts
        )
        return np.array([contact.approach for contact in contacts])

    def _require_convergence(self, contact: bem3d.WheelContact, place: int) -> bem3d.WheelContact:
        """The contact itself, its applications counted; ConvergenceError unless it has converged."""
        self.operator_applications += contact.operator_applications
        if not contact.converged:
            raise bem3d.ConvergenceError(
                f"residual {contact.residual:.3g} after {len(contact.history) - 1} iterations ({contact.status}) at "
                f"place {place}",
                contact.history,
                None,
            )
        return contact
