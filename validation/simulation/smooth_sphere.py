"""A smooth sphere pressed against the half-space on one grid, beside Hertz."""

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.engine.engine import Outcome
from validation.theory import closed_forms


@dataclass(frozen=True, kw_only=True)
class SmoothSphere:
    """radius, approach [m]; modulus: E* [Pa]; cells: on a side, or springs; spacing: from one to the next [m];
    tolerance: residual of the solver."""

    radius: float
    modulus: float
    approach: float
    cells: int
    spacing: float
    tolerance: float

    @property
    def x(self) -> NDArray[np.float64]:
        """Centres of cells [m]."""
        return np.asarray((np.arange(self.cells) - (self.cells - 1) / 2) * self.spacing)

    @property
    def force(self) -> float:
        """Of Hertz [N]."""
        return closed_forms.hertz_force(approach=self.approach, radius=self.radius, modulus=self.modulus)


def press_sphere_by_bem(sphere: SmoothSphere) -> Outcome:
    """Boundary elements: by approach, and by the force of Hertz."""
    x, middle = sphere.x, sphere.cells // 2
    r = np.hypot(x[:, np.newaxis], x)
    half_space = bem3d.HalfSpace(shape=r.shape, spacing=sphere.spacing, modulus=sphere.modulus)
    gap = r**2 / (2 * sphere.radius)
    contact = bem3d.solve(half_space, gap, approach=sphere.approach, tolerance=sphere.tolerance)
    by_force = bem3d.solve(half_space, gap, force=sphere.force, start=contact, tolerance=sphere.tolerance)
    exact = closed_forms.hertz_pressure(r, approach=sphere.approach, radius=sphere.radius, modulus=sphere.modulus)
    return {
        "force": np.array(contact.force),
        "radius": np.sqrt(contact.area / np.pi),
        "stiffness": np.array(contact.stiffness()),
        "approach_at_force": np.array(by_force.approach),
        "pressure_error": np.sqrt(np.sum((contact.pressure - exact) ** 2) / np.sum(exact**2)),
        "x": x[middle:],
        "pressure": contact.pressure[middle, middle:],
    }


def press_sphere_by_springs(sphere: SmoothSphere) -> Outcome:
    """MDR: the parabola on springs as wide as the cells."""
    height = -mdr.sphere_profile(sphere.x, radius=sphere.radius)
    curve = mdr.load_curve(height, length=sphere.cells * sphere.spacing, modulus=sphere.modulus)
    with warnings.catch_warnings():
        # the error that few springs make is measured here
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        point, by_force = curve.at_approach(sphere.approach), curve.at_force(sphere.force)
    return {
        "force": np.array(point.force),
        "stiffness": np.array(point.stiffness),
        "approach_at_force": np.array(by_force.approach),
    }
