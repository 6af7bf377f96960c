"""A wheel over an isotropic surface with boundary elements inside the time loop, and the linear contact beside it."""

import math
from dataclasses import dataclass

import numpy as np

import bem3d
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import BoundaryElementsLaw, LinearLaw
from validation.simulation.motion import simulate, simulate_from_linear_motion
from validation.simulation.surface import middle_of, surface_on_grid
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

    scene: RollingScene
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
        if not self.scene.rail_alone_is_rough:
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
    surface, time_step = strip.surface(), strip.spacing / scene.rolling_speed
    linear = linear_law_3d(wheel, surface, strip.spacing)
    approach, velocity = linear.steady_state(time_step)
    steps = len(surface)
    contact = BoundaryElementsLaw(
        wheel, [crop_to_reach(surface, strip.spacing, wheel)], strip.spacing, tolerance=strip.tolerance
    )
    linear_motion = simulate(wheel, linear, time_step=time_step, steps=steps, approach=approach, velocity=velocity)
    try:
        motion = simulate_from_linear_motion(contact, linear, time_step, steps)
    except bem3d.ConvergenceError:
        motion = None
    acceleration = motion.acceleration[:, 0] if motion else np.full(steps, np.nan)
    return {
        "bem": acceleration,
        "linear": linear_motion.acceleration[:, 0],
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
