"""A wheel over an isotropic surface with boundary elements inside the time loop, and the linear contact beside it."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import bem3d
from mdr import SelfAffine
from validation.engine.engine import FloatArray, Outcome
from validation.engine.random_numbers import random_generator
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.roughness import Roughness
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import BoundaryElementsLaw, LinearLaw, SpringsLaw
from validation.simulation.motion import simulate, simulate_from_linear_motion
from validation.simulation.surface import draw_surface, middle_of, surface_on_grid
from validation.simulation.wheel_on_springs import WheelEnsemble
from validation.theory.rolling import linear_force

STRIPS = 4
"""Key of the random numbers of surfaces."""


@dataclass(frozen=True, kw_only=True)
class WheelStrip:
    """One wheel over one periodic surface, which lasts a whole number of natural periods and a half.

    scene: only its rail is rough; realisation; natural_periods: whole, before the half; width: of the surface over the
    longest wave; cells: to a contact radius, a multiple of `shared`; shared: divisor of `cells` on all grids, so that
    their surfaces are equally long; tolerance: residual of contacts; seed.
    """

    scene: WheelScene
    realisation: int
    natural_periods: int
    width: int
    cells: int
    shared: int
    tolerance: float
    seed: int

    def __post_init__(self) -> None:
        if self.cells % self.shared:
            raise ValueError(f"cells must be a multiple of shared, got {self.cells} and {self.shared}")
        if self.scene.rail is None or self.scene.wheel is not None:
            raise ValueError("scene must have a rough rail and a smooth wheel")

    @property
    def spacing(self) -> float:
        return self.scene.contact_radius / self.cells

    @property
    def shape(self) -> tuple[int, int]:
        """Cells along and across the whole surface."""
        scene, refined = self.scene, self.cells // self.shared
        unit = scene.contact_radius / self.shared
        along = round((self.natural_periods + 0.5) * scene.period_length / unit)
        return refined * along, refined * math.ceil(self.width * self.roughness.longest / unit)

    @property
    def roughness(self) -> Roughness:
        assert self.scene.rail is not None  # as checked
        return self.scene.rail

    def surface(self) -> FloatArray:
        """Heights at the centres of the cells [m]; the same surface on every grid."""
        rng = random_generator(self.seed, STRIPS, self.realisation)
        return surface_on_grid(self.roughness, shape=self.shape, spacing=self.spacing, rng=rng)


def simulate_strip(strip: WheelStrip) -> Outcome:
    """z'' of a wheel on boundary elements and on the linear contact, over one round of the same surface [m/s^2].

    Both begin in the steady state of the linear contact, boundary elements at its force there. applications: of the
    operator, a step; lowest, highest: approach over d; failed: one if a contact did not converge.
    """
    scene = strip.scene
    wheel = scene.body
    surface, time_step = strip.surface(), strip.spacing / scene.speed
    linear = linear_law_3d(wheel, surface, strip.spacing)
    approach, velocity = linear.steady_state(time_step)
    steps = len(surface)
    contact = BoundaryElementsLaw(
        wheel, [crop_to_reach(surface, strip.spacing, wheel)], strip.spacing, tolerance=strip.tolerance
    )
    beside = simulate(wheel, linear, time_step=time_step, steps=steps, approach=approach, velocity=velocity)
    try:
        motion = simulate_from_linear_motion(contact, linear, time_step, steps)
    except bem3d.ConvergenceError:
        motion = None
    found = motion.acceleration[:, 0] if motion else np.full(steps, np.nan)
    return {
        "bem": found,
        "linear": beside.acceleration[:, 0],
        "time step": np.array(time_step),
        "applications": np.array(contact.operator_applications / steps),
        "lowest": np.array(motion.lowest[0] / wheel.approach if motion else np.nan),
        "highest": np.array(motion.highest[0] / wheel.approach if motion else np.nan),
        "failed": np.array(float(motion is None)),
    }


def linear_law_3d(wheel: Wheel, surface: FloatArray, spacing: float) -> LinearLaw:
    """A contact that keeps its radius, with the force of linear theory along the middle of this surface."""
    return LinearLaw(wheel, (linear_force(surface, spacing=spacing, **wheel.smooth) - wheel.load)[:, np.newaxis])


def crop_to_reach(surface: FloatArray, spacing: float, wheel: Wheel) -> FloatArray:
    """The middle of a surface: cells that can touch the wheel where it is a quarter deeper than at rest."""
    reach = math.sqrt(2 * wheel.radius * (1.25 * wheel.approach + max(float(surface.max()), 0.0)))
    return np.ascontiguousarray(middle_of(surface, reach, spacing))


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
