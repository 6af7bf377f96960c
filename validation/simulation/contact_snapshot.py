"""One wheel in motion, seen at one place: its contact on springs, and on the half-space."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

import bem3d
from mdr import SelfAffine
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator
from validation.scenes.dynamic_wheel import WheelScene
from validation.simulation.contact_laws import BoundaryElementsLaw, SpringsLaw
from validation.simulation.motion import simulate
from validation.simulation.surface import draw_surface
from validation.simulation.wheel_on_springs import WheelEnsemble

FloatArray = NDArray[np.float64]

STRIP = 3
"""Key of the random numbers of the surface."""


@dataclass(frozen=True, kw_only=True)
class Snapshot:
    """One wheel after some steps of a / cells; on springs after four times as many of its own."""

    scene: WheelScene
    cells: int
    steps: int
    seed: int


def contact_snapshot(snapshot: Snapshot) -> Outcome:
    """The contact as the simulation has it.

    springs: x from the middle, profile of the wheel at its approach, height of the track, compression, over a and d;
    x, y: over a; pressure: over the largest of Hertz, in the frame that moves along, (x, y).
    """
    scene = snapshot.scene
    contact = _rolled_contact(snapshot)
    x, y, pressure = contact.pressure()
    greatest = 2 * scene.modulus / math.pi * math.sqrt(scene.approach / scene.radius)
    a = scene.contact_radius
    return {"springs": _springs(snapshot), "x": x / a, "y": y / a, "pressure": pressure / greatest}


def _springs(snapshot: Snapshot) -> FloatArray:
    scene, wheel, steps = snapshot.scene, snapshot.scene.body, 4 * snapshot.steps
    a, d = scene.contact_radius, scene.approach
    heights = WheelEnsemble(scene=scene, seed=snapshot.seed).heights()
    law = SpringsLaw(wheel, heights, scene.spacing)
    motion = simulate(wheel, law, time_step=scene.time_step, steps=steps)
    j = np.arange(-round(1.4 * scene.springs), round(1.4 * scene.springs) + 1)
    profile = (j * scene.spacing) ** 2 / scene.radius - motion.approach[0]
    height = heights[:, 0].take(j + steps, mode="wrap")
    return np.stack([j * scene.spacing / a, profile / d, height / d, np.maximum(height - profile, 0) / d])


def _rolled_contact(snapshot: Snapshot) -> bem3d.RollingContact:
    """By boundary elements on an isotropic surface of the scene's spectrum, with the waves that the cells resolve."""
    scene, wheel, cells = snapshot.scene, snapshot.scene.body, snapshot.cells
    spacing = scene.contact_radius / cells
    surface = np.zeros((12 * cells, 6 * cells))
    for i, rough in enumerate((scene.rail, scene.wheel)):
        if rough is not None:
            c2d = partial(_cut_off, rough.spectrum, math.pi / (2 * spacing))
            rng = random_generator(snapshot.seed, STRIP, i)
            surface += draw_surface(c2d, shape=surface.shape, spacing=spacing, rng=rng)
    law = BoundaryElementsLaw(wheel, [surface], spacing)
    simulate(wheel, law, time_step=spacing / scene.speed, steps=snapshot.steps)
    return law.contacts[0]


def _cut_off(spectrum: SelfAffine, last: float, q: FloatArray) -> FloatArray:
    """C_2D up to a wavenumber."""
    return np.where(q <= last, spectrum.c2d(q), 0.0)
