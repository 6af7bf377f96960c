"""A wheel in units of its contact, rough tracks and laws of contact for it."""

import math

import numpy as np

from validation.scenes.wheel_body import Wheel
from validation.simulation import integrators
from validation.simulation.contact_laws import HertzLaw, LinearLaw, SpringsLaw
from validation.simulation.integrators import SYMPLECTIC_EULER, VELOCITY_VERLET

WHEEL = Wheel(radius=1.0, mass=2.0, modulus=1.0, load=4 / 3)
"""d_N = a = 1, k = 2 and omega_eigen = 1, gravity 2/3."""
GRAVITY = 2 / 3
ULP = 2.0**-53
SCHEMES = {scheme.name: scheme for scheme in integrators.INTEGRATORS}
SYMPLECTIC = (SYMPLECTIC_EULER.name, VELOCITY_VERLET.name)


def quantum(springs):
    """Of approach, in the force of springs: 32 * 2 a / dx * 2^-53."""
    return 32 * 2 * springs * ULP


def drift(steps, time_step, each):
    """How far a wheel gets by errors of its approach, seen by the force: n kicks of omega^2 dt each, all alike."""
    return (steps * time_step + 2) * each


def track(points, wheels, rms, *, seed=0, longest=1, shortest=8):
    """Some waves of a periodic track, of which each wheel has its own."""
    rng = np.random.default_rng(seed)
    x = 2 * np.pi * np.arange(points)[:, np.newaxis, np.newaxis] / points
    number = np.arange(longest, shortest + 1)
    phase = rng.uniform(0, 2 * np.pi, (wheels, number.size))
    return rms * math.sqrt(2 / number.size) * np.cos(number * x + phase).sum(axis=2)


def springs_law(height, springs):
    return SpringsLaw(WHEEL, height, 1 / springs)


class Counted:
    """A law that counts how often it is asked, and where."""

    def __init__(self, law):
        self.law, self.places = law, []

    def force(self, place, approach):
        self.places.append(place)
        return self.law.force(place, approach)

    def at_rest(self, place):
        self.places.append(place)
        return self.law.at_rest(place)


def laws(points=200):
    height = track(points, 3, 0.2)
    return {"springs": springs_law(height, 12.5), "linear": LinearLaw(WHEEL, height), "Hertz": HertzLaw(WHEEL, 3)}
