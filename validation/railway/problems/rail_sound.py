"""The force of a wheel that rolls over a rough strip at a constant height, by each model, as samples in time.

Nothing moves but the place: no inertia, no resonance, no radiation. f = v / lambda.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np
import scipy

import mdr
from validation.engine.engine import FloatArray, Outcome
from validation.railway.problems.equivalent_displacement import geike_track, linear_displacement, roll_boundary_elements
from validation.railway.problems.rail_strip import LENGTH, RailStrip, StatedAcross, strip_of
from validation.railway.scenes.rail import RailScene
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ

GEIKE = "springs of Geike's spectrum"
ISOTROPIC: Literal["isotropic"] = "isotropic"
MOST_CELLS = 12_000_000
"""Of a strip: 100 MB of heights, and several times as much while it is drawn."""
WIDER = 1.5
"""Half of what springs are given of the surface, over the semi-axis across."""
SPRINGS_TO_A_CELL = 4
"""Springs cost next to nothing; few of them are noisy."""


def sounding_strip(
    scene: RailScene, *, across: StatedAcross, samples: int, rate: int, cells: int, seed: int
) -> RailStrip:
    """A periodic strip that takes so many samples to roll over; the same surface on every grid.

    rate: of the samples [1/s]; cells: to the smaller semi-axis, at least. Raises ValueError for a scene without a
    speed, a strip of fewer than 60 larger semi-axes, and one that is too large.
    """
    if scene.speed is None:
        raise ValueError('a sound needs wheel.speed, as speed = "80 km/h" under [wheel], got a scene without it')
    short = strip_of(scene, across, cells, 0, seed)
    length, contact = samples / rate * scene.speed, scene.contact
    least = LENGTH * max(contact.along, contact.across) / scene.speed
    if samples / rate < least:
        raise ValueError(f"seconds must be at least {least:.2g} at this speed, got {samples / rate:g}")
    widths = math.floor(length / short.width)
    width = length / widths
    columns = 2 * math.ceil(width / short.spacing / 2)
    if widths * columns**2 > MOST_CELLS:
        most = samples / rate * MOST_CELLS / (widths * columns**2)
        raise ValueError(f"seconds must be at most {most:.2g} at this speed, got {samples / rate:g}")
    return replace(short, length=length, width=width, spacing=width / columns)


@dataclass(frozen=True, kw_only=True)
class HeldWheel:
    """A wheel that rolls at the approach of its smooth contact, over the rows `first` to `last` of a strip.

    model: of `FORCES`; tolerance: residual of boundary elements.
    """

    strip: RailStrip
    model: str
    first: int
    last: int
    tolerance: float

    def __post_init__(self) -> None:
        if self.model not in FORCES:
            raise ValueError(f"model must be one of {', '.join(FORCES)}, got {self.model!r}")


def roll_held_wheel(problem: HeldWheel) -> Outcome:
    """force: on each row [N], NaN where boundary elements have not converged; failed: how many have not."""
    force = FORCES[problem.model](problem)
    return {"force": force, "failed": np.array(float(np.isnan(force).sum()))}


def _linear(problem: HeldWheel) -> FloatArray:
    """F_N + k (H * h): linear theory of the half-space."""
    contact, lifted = problem.strip.contact, linear_displacement(problem.strip, LINEAR)
    return (contact.force + contact.stiffness * lifted)[problem.first : problem.last]


def _boundary_elements(problem: HeldWheel) -> FloatArray:
    strip, positions = problem.strip, problem.last - problem.first
    roll = partial(roll_boundary_elements, strip, problem.tolerance, first=problem.first, positions=positions)
    return roll(approach=strip.contact.approach).force.copy()


def _springs_that_read(problem: HeldWheel) -> FloatArray:
    """Of the surface they read no more than the smooth contact is wide."""
    strip, middle = problem.strip, problem.strip.shape[1] // 2
    reach = math.ceil(WIDER * strip.contact.across / strip.spacing)
    return _on_springs(problem, mdr.roll_surface, strip.surface[:, middle - reach : middle + reach], strip.spacing)


def _on_springs(
    problem: HeldWheel, roll: Callable[..., mdr.RollingTrack], height: FloatArray, *across: float
) -> FloatArray:
    """Of several springs to a cell, between which the heights are interpolated by their waves. across: dy."""
    strip, dx = problem.strip, problem.strip.spacing / SPRINGS_TO_A_CELL
    finer = scipy.signal.resample(height, SPRINGS_TO_A_CELL * len(height), axis=0)
    wheel = {"radius": strip.radii, "modulus": strip.modulus, "approach": strip.contact.approach}
    rolled = roll(finer, spacing=(dx, *across) if across else dx, **wheel)
    return rolled.force[::SPRINGS_TO_A_CELL][problem.first : problem.last].copy()


FORCES: dict[str, Callable[[HeldWheel], FloatArray]] = {
    BEM: _boundary_elements,
    LINEAR: _linear,
    SPRINGS_THAT_READ: _springs_that_read,
    GEIKE: lambda problem: _on_springs(problem, mdr.roll, geike_track(problem.strip)),
}


def samples_of(force: FloatArray, samples: int) -> FloatArray:
    """A periodic force less its mean, at so many instants of its period: all its waves that they can carry [N]."""
    resampled = np.asarray(scipy.signal.resample(force, samples), dtype=np.float64)
    return np.asarray(resampled - resampled.mean())
