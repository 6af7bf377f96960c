"""A wheel over an isotropic surface with boundary elements inside the time loop, and the linear contact beside it."""

import math
import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.engine.engine import Outcome, random_generator
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.roughness import Roughness
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import BoundaryElementsLaw, Linear
from validation.simulation.motion import Motion, simulate
from validation.theory.rolling import linear_force

FloatArray = NDArray[np.float64]

STRIPS = 4
"""The spawn key of surfaces."""


@dataclass(frozen=True, kw_only=True)
class WheelStrip:
    """One wheel over one surface, periodic, as long as some turns of the resonance and a half.

    scene, whose rail alone is rough; realisation; turns: whole, of the resonance, to which a half is added; width: of
    the surface over the longest wave; cells: to a contact radius, a multiple of `shared`; shared: cells to a contact
    radius of which sides are whole multiples, so that other grids are as long; tolerance: residual of contacts; seed.
    """

    scene: WheelScene
    realisation: int
    turns: int
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
        """a / cells [m]."""
        return self.scene.contact_radius / self.cells

    @property
    def shape(self) -> tuple[int, int]:
        """Cells along and across the whole surface."""
        scene, refined = self.scene, self.cells // self.shared
        unit = scene.contact_radius / self.shared
        turn = 2 * math.pi * scene.speed / scene.eigenfrequency
        along = round((self.turns + 0.5) * turn / unit)
        return refined * along, refined * math.ceil(self.width * self.roughness.longest / unit)

    @property
    def roughness(self) -> Roughness:
        """Of the rail."""
        assert self.scene.rail is not None  # as checked
        return self.scene.rail

    def surface(self) -> FloatArray:
        """Heights at the centres of the cells [m]; the same surface on every grid."""
        with warnings.catch_warnings():
            # what few cells to a wave cost is measured
            warnings.simplefilter("ignore", bem3d.ResolutionWarning)
            return bem3d.rough_surface(
                self.roughness.spectrum.c2d,
                shape=self.shape,
                spacing=self.spacing,
                rng=random_generator(self.seed, STRIPS, self.realisation),
                rms=self.roughness.rms,
            )


def roll_strip(strip: WheelStrip) -> Outcome:
    """z'' of a wheel on boundary elements and on the linear contact, over one round of the same surface [m/s^2].

    Both begin on the motion of the linear contact that repeats itself with the track, boundary elements at the force
    that it has there. applications: of the operator, a step; lowest, highest: approach over d; failed: one if a contact
    did not converge.
    """
    scene = strip.scene
    wheel = scene.body
    surface, time_step = strip.surface(), strip.spacing / scene.speed
    linear = linear_contact(strip, surface)
    approach, velocity = linear.steady(time_step)
    steps = len(surface)
    contact = BoundaryElementsLaw(
        wheel, [narrowed(surface, strip.spacing, wheel)], strip.spacing, tolerance=strip.tolerance
    )
    beside = simulate(wheel, linear, time_step=time_step, steps=steps, approach=approach, velocity=velocity)
    try:
        motion = by_boundary_elements(contact, linear, time_step, steps)
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


def linear_contact(strip: WheelStrip, surface: FloatArray) -> Linear:
    """A contact that keeps its radius, with the force of linear theory along this surface."""
    wheel = strip.scene.body
    smooth = {"spacing": strip.spacing, "radius": wheel.radius, "modulus": wheel.modulus, "approach": wheel.approach}
    return Linear(wheel, (linear_force(surface, **smooth) - wheel.load)[:, np.newaxis])


def by_boundary_elements(contact: BoundaryElementsLaw, linear: Linear, time_step: float, steps: int) -> Motion:
    """A wheel that begins as the linear one that repeats its motion, at the force that this has there."""
    approach, velocity = linear.steady(time_step)
    start = contact.at_rest(0) + approach - linear.at_rest(0)
    return simulate(contact.wheel, contact, time_step=time_step, steps=steps, approach=start, velocity=velocity)


def narrowed(surface: FloatArray, spacing: float, wheel: Wheel) -> FloatArray:
    """The middle of a surface: no wider than cells that overlap with the wheel, a quarter deeper than at rest."""
    reach = math.sqrt(2 * wheel.radius * (1.25 * wheel.approach + max(float(surface.max()), 0.0)))
    side = min(math.ceil(reach / spacing) + 1, surface.shape[1] // 2)
    middle = surface.shape[1] // 2
    return np.ascontiguousarray(surface[:, middle - side : surface.shape[1] - middle + side])
