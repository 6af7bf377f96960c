"""Contacts that have a closed form, by boundary elements and on springs: a sphere, a wave, flat punches, an ellipse."""

import math
import warnings
from dataclasses import dataclass

import numpy as np

import bem3d
import mdr
from validation.engine.engine import FloatArray, Outcome
from validation.theory import closed_forms
from validation.theory.half_space import EllipticContact, elliptic_contact


def off(values: FloatArray, true: FloatArray) -> float:
    """Relative difference from the true values in L2 [-]."""
    return float(np.sqrt(np.sum((values - true) ** 2) / np.sum(true**2)))


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
    def x(self) -> FloatArray:
        """The coordinates of the cell centres, (cells,), zero in the middle [m]."""
        return np.asarray((np.arange(self.cells) - (self.cells - 1) / 2) * self.spacing)

    @property
    def force(self) -> float:
        """Force of Hertz at the approach [N]."""
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
        "pressure_error": np.array(off(contact.pressure, exact)),
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


@dataclass(frozen=True, kw_only=True)
class CosineWave:
    """wavelength, amplitude [m]; modulus: E* [Pa]; load: mean pressure over that of full contact; cells: in a
    wavelength; tolerance: residual of the solver."""

    wavelength: float = 1e-3
    amplitude: float = 1e-6
    modulus: float = 1e9
    load: float
    cells: int
    tolerance: float

    @property
    def unloaded(self) -> dict[str, float]:
        return {name: getattr(self, name) for name in ("amplitude", "wavelength", "modulus")}

    @property
    def full_pressure(self) -> float:
        """p* = pi E* h / lambda [Pa]."""
        return closed_forms.westergaard_full_pressure(**self.unloaded)

    @property
    def scene(self) -> dict[str, float]:
        """Arguments of the closed forms."""
        return {"mean_pressure": self.load * self.full_pressure, **self.unloaded}

    @property
    def spacing(self) -> float:
        """Side of a cell [m]."""
        return self.wavelength / self.cells


def press_wave(wave: CosineWave) -> Outcome:
    """One row of cells along one wavelength: a third dimension would add nothing."""
    x = (np.arange(wave.cells) + 0.5) * wave.spacing - wave.wavelength / 2
    half_space = bem3d.HalfSpace(shape=(wave.cells, 1), spacing=wave.spacing, modulus=wave.modulus, periodic=True)
    gap = 2 * wave.amplitude * np.sin(np.pi * x / wave.wavelength) ** 2
    force = wave.scene["mean_pressure"] * wave.wavelength * wave.spacing
    with warnings.catch_warnings():
        # the contact is a line: one row of cells resolves it
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        contact = bem3d.solve(half_space, gap[:, np.newaxis], force=force, tolerance=wave.tolerance)
    exact = closed_forms.westergaard_pressure(x, **wave.scene)
    return {
        "x": x,
        "pressure": contact.pressure[:, 0],
        "exact_pressure": exact,
        "error": np.array(off(contact.pressure[:, 0], exact)),
        "half_width": np.array(contact.area / (2 * wave.spacing)),
    }


@dataclass(frozen=True, kw_only=True)
class FlatPunches:
    """Flat punches of side or diameter L, E* = L = 1. cells: on a side; tolerance: of the linear solve."""

    cells: int
    tolerance: float


def press_flat_punches(punches: FlatPunches) -> Outcome:
    """Both pressed by a unit approach: k / (E* L), and k / (2 E* a) with the area of the cells."""
    cells = punches.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    x = (np.arange(cells) + 0.5) / cells - 0.5
    disc = np.hypot(x[:, np.newaxis], x) < 0.5
    square = bem3d.solve_fixed_area(half_space, np.ones((cells, cells), dtype=bool), tolerance=punches.tolerance)
    circle = bem3d.solve_fixed_area(half_space, disc, tolerance=punches.tolerance)
    radius = np.sqrt(np.count_nonzero(disc) / np.pi) / cells
    return {"square": np.array(square.stiffness), "circle": np.array(circle.stiffness / radius / 2)}


APPROACH, PRESSURE = "approach", "largest pressure"
FORCE, RADII = 100e3, (1e-3 / (2 * 0.001015), 1e-3 / (2 * 0.0004215))
"""[N]; 1 / (2 A) along and 1 / (2 B) across of its gap A x^2 + B y^2 [m]."""
STRIP = 2.6
"""Length and width of the flat strip over those of the contact."""


@dataclass(frozen=True, kw_only=True)
class PublishedContact:
    """cells: of the grid, to the semi-axis along; tolerance: residual of boundary elements."""

    cells: int
    tolerance: float

    @property
    def modulus(self) -> float:
        """E* = G / (1 - nu) of two equal bodies [Pa]."""
        return 82e9 / (1 - 0.28)

    @property
    def closed(self) -> EllipticContact:
        return elliptic_contact(RADII, modulus=self.modulus, force=FORCE)


def press_ellipse(problem: PublishedContact) -> Outcome:
    """Press an ellipsoid onto a flat strip, a cell under its deepest point. Approach [mm], highest pressure [MPa]."""
    smooth = problem.closed
    spacing = smooth.along / problem.cells
    shape = tuple(2 * round(STRIP / 2 * axis / spacing) + 1 for axis in (2 * smooth.along, 2 * smooth.across))
    track = bem3d.Track(height=np.zeros(shape), spacing=spacing, radius=RADII, modulus=problem.modulus)
    wheel = bem3d.RollingContact(track, tolerance=problem.tolerance)
    contact = wheel.carry(0, FORCE)
    return {
        APPROACH: np.array(1e3 * contact.approach),
        PRESSURE: np.array(1e-6 * wheel.pressure()[2].max() if contact.converged else math.nan),
        "failed": np.array(float(not contact.converged)),
    }
