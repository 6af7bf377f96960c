"""A smooth sphere on the half-space: both methods against Hertz."""

import warnings
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

import bem3d
import mdr
from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, columns
from validation.analysis.wording import by_status
from validation.cases.exact.refinement import order
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.selection import model_needed
from validation.theory import closed_forms

# tolerance of the force in units of (dx/a)^2, and why; what scatters its error from grid to grid
FORCE_ERROR = {
    "bem3d": (
        0.25,
        "second order: the discrete pressure minimises the energy, so the error of the force is quadratic in that of "
        "the pressure; (dx/a)^2 / 4 includes the staircase edge of the contact",
        "the staircase edge of the contact scatters the error",
    ),
    "mdr": (
        0.5,
        "second order: midpoint rule, (dx/a)^2 / 8 inside and at most 3/8 from the two ends of the contact",
        "the error depends on where the ends of the contact lie between two springs",
    ),
}


CLAIM = "Both methods give the contact of Hertz."


@dataclass(frozen=True, kw_only=True)
class Hertz:
    """The wheel of Table 14.1, smooth, under its own weight; solved on finer and finer grids.

    radius [m], modulus E* [Pa], approach [m]; cells_per_radius: of the Hertz contact, on a grid four times as wide;
    load_steps: of a load curve on the second grid; tolerance: residual of the solver.
    """

    radius: float = 0.5
    modulus: float = 236.25e9
    approach: float = 7.856e-6
    cells_per_radius: tuple[int, ...] = (8, 16, 32, 64)
    load_steps: int = 8
    tolerance: float = 1e-8

    @property
    def contact_radius(self) -> float:
        """Of Hertz [m]."""
        return closed_forms.hertz_contact_radius(radius=self.radius, approach=self.approach)

    @property
    def approaches(self) -> list[float]:
        """Of the load curve [m]."""
        return [float(s * self.approach) for s in np.linspace(0, 1, self.load_steps + 1)[1:]]

    @property
    def force(self) -> float:
        """Of Hertz [N]."""
        return closed_forms.hertz_force(approach=self.approach, **self.sphere)

    @property
    def sphere(self) -> dict[str, float]:
        """Arguments of the closed forms."""
        return {"radius": self.radius, "modulus": self.modulus}


@dataclass(frozen=True, kw_only=True)
class Sphere:
    """One sphere on one grid: cells of side a / resolution, where a is the contact radius of the case."""

    case: Hertz
    resolution: int
    approach: float

    @property
    def spacing(self) -> float:
        """Side of a cell [m]."""
        return self.case.contact_radius / self.resolution


@dataclass(frozen=True)
class HertzResult:
    """Outcomes of each method: of all "grids" at the approach of the case, of all "loads" on the second grid."""

    case: Hertz
    bem: dict[str, list[Outcome]]
    mdr: dict[str, list[Outcome]]


def run(case: Hertz, engine: Engine = SERIAL) -> HertzResult:
    """Press the sphere with both methods."""
    second = case.cells_per_radius[1]
    spheres = {
        "grids": [Sphere(case=case, resolution=n, approach=case.approach) for n in case.cells_per_radius],
        "loads": [Sphere(case=case, resolution=second, approach=d) for d in case.approaches],
    }
    return HertzResult(case, engine.map_groups(press_by_bem, spheres), engine.map_groups(press_by_springs, spheres))


def press_by_bem(sphere: Sphere) -> Outcome:
    """Boundary elements: by approach, and by the force of Hertz."""
    case, cells = sphere.case, 4 * sphere.resolution
    x = (np.arange(cells) - (cells - 1) / 2) * sphere.spacing
    r = np.hypot(x[:, np.newaxis], x)
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=sphere.spacing, modulus=case.modulus)
    gap = r**2 / (2 * case.radius)
    contact = bem3d.solve(half_space, gap, approach=sphere.approach, tolerance=case.tolerance)
    force = closed_forms.hertz_force(approach=sphere.approach, **case.sphere)
    by_force = bem3d.solve(half_space, gap, force=force, start=contact, tolerance=case.tolerance)
    exact = closed_forms.hertz_pressure(r, approach=sphere.approach, **case.sphere)
    middle = cells // 2
    return {
        "force": np.array(contact.force),
        "radius": np.sqrt(contact.area / np.pi),
        "stiffness": np.array(contact.stiffness()),
        "approach_at_force": np.array(by_force.approach),
        "pressure_error": np.sqrt(np.sum((contact.pressure - exact) ** 2) / np.sum(exact**2)),
        "x": x[middle:],
        "pressure": contact.pressure[middle, middle:],
    }


def press_by_springs(sphere: Sphere) -> Outcome:
    """MDR: the parabola on springs as wide as the cells."""
    case, cells = sphere.case, 4 * sphere.resolution
    x = (np.arange(cells) - (cells - 1) / 2) * sphere.spacing
    height = -mdr.sphere_profile(x, radius=case.radius)
    curve = mdr.load_curve(height, length=cells * sphere.spacing, modulus=case.modulus)
    force = closed_forms.hertz_force(approach=sphere.approach, **case.sphere)
    with warnings.catch_warnings():
        # the error that few springs make is measured here
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        point, by_force = curve.at_approach(sphere.approach), curve.at_force(force)
    return {
        "force": np.array(point.force),
        "stiffness": np.array(point.stiffness),
        "approach_at_force": np.array(by_force.approach),
    }


def evidence(result: HertzResult) -> Evidence:
    """Force, approach, contact radius, stiffness and pressure over Hertz on the finest grid; order of the force."""
    case, n, finest = result.case, result.case.cells_per_radius, result.bem["grids"][-1]
    numbers = (
        *_over_hertz(case, "bem3d", result.bem["grids"]),
        *_over_hertz(case, "mdr", result.mdr["grids"]),
        Number(
            quantity="contact radius over Hertz",
            model="bem3d",
            value=float(finest["radius"]) / case.contact_radius,
            reference=1.0,
            source="Hertz",
            tolerance=1 / n[-1],
            reason="one cell in the radius; for springs it is the stiffness again, both being their number in contact",
        ),
        Number(
            quantity="relative L2 error of the pressure",
            model="bem3d",
            value=float(finest["pressure_error"]),
            reference=0.0,
            source="Hertz",
            tolerance=1 / n[-1],
            reason="first order in the cell size: the pressure falls as a square root at the edge of the contact",
        ),
        Number(
            quantity="force at the given approach",
            model="mdr over bem3d",
            value=float(result.mdr["grids"][-1]["force"] / finest["force"]),
            reference=1.0,
            source="the other method",
            tolerance=0.75 / n[-1] ** 2,
            reason="sum of both discretisation errors",
        ),
    )
    claim = answered(CLAIM, numbers, _answer(case, numbers))
    return Evidence(
        title="Smooth sphere",
        method=(
            f"A rigid sphere, R = {case.radius:g} m, on a half-space of E* = {case.modulus / 1e9:g} GPa, pressed by "
            f"{case.approach * 1e6:g} µm (Hertz: {case.force:.1f} N, a = {case.contact_radius * 1e3:.4f} mm). "
            f"MDR: the parabola x²/R on springs. Boundary elements: (x² + y²)/2R on cells of the same width. "
            f"{n[0]} to {n[-1]} cells in the contact radius (whole numbers, which favours the springs), "
            f"residual {case.tolerance:g}."
        ),
        numbers=numbers,
        tables=tuple(Table(name, columns(**data)) for name, data in _data(result).items()),
        claims=(claim,),
        finding=f"{headline(claim)}.",
        headlines={"hertz": headline(claim)},
        conclusions=(),
        captions={
            "hertz": (
                f"(a) Load curve, {n[1]} cells in the largest contact radius. (b) Pressure along a row of cells next "
                f"to the centre, {n[1]} cells in the contact radius. (c) Relative error of the force at a given "
                "approach against cells in the contact radius. Dotted: second order."
            )
        },
    )


def headline(claim: JudgedClaim) -> str:
    return by_status(
        claim,
        holds="Springs and boundary elements give the contact of Hertz",
        fails="Springs and boundary elements do not both give the contact of Hertz",
        undecided="Whether springs and boundary elements give the contact of Hertz is open",
    )


def _answer(case: Hertz, numbers: tuple[Number, ...]) -> str:
    """How far the worst of each kind is off."""

    def off(*quantities: str) -> str:
        return f"{max(abs(n.difference) for n in numbers if n.quantity.startswith(quantities)):.1e}"

    return (
        f"with {case.cells_per_radius[-1]} cells in the contact radius the relative error of force and approach is at "
        f"most {off('force', 'approach')}, that of contact radius and stiffness {off('contact radius', 'stiffness')}, "
        f"and the relative L2 error of the pressure {off('relative L2')}."
    )


def _over_hertz(case: Hertz, model: str, outcomes: list[Outcome]) -> tuple[Number, ...]:
    """Force, approach and stiffness on the finest grid over those of Hertz, and the order of the force."""
    cell, last = 1 / case.cells_per_radius[-1], outcomes[-1]
    quadratic, why, scatter = FORCE_ERROR[model]
    stiffness = closed_forms.circular_punch_stiffness(radius=case.contact_radius, modulus=case.modulus)
    over = partial(Number, model=model, reference=1.0, source="Hertz")
    return (
        over(
            quantity="force at the given approach over Hertz",
            value=float(last["force"]) / case.force,
            tolerance=quadratic * cell**2,
            reason=why,
        ),
        over(
            quantity="approach at the given force over Hertz",
            value=float(last["approach_at_force"]) / case.approach,
            tolerance=2 / 3 * quadratic * cell**2,
            reason="two thirds of the tolerance of the force, since d ~ F^(2/3)",
        ),
        over(
            quantity="stiffness over 2 E* a",
            value=float(last["stiffness"]) / stiffness,
            source="Boussinesq",
            tolerance=cell,
            reason="k is proportional to the radius of the discrete contact: one cell in the radius",
        ),
        over(
            quantity="order of the force error in the cell size",
            value=order(case.cells_per_radius, [float(o["force"]) / case.force - 1 for o in outcomes]),
            reference=2.0,
            source="error model",
            tolerance=0.5,
            reason=f"second order; {scatter}",
        ),
    )


def _data(result: HertzResult) -> dict[str, dict[str, ArrayLike]]:
    case, bem, springs = result.case, result.bem, result.mdr
    x = np.linspace(0, 2 * case.contact_radius, 401)
    return {
        "load": {
            "approach [m]": case.approaches,
            "hertz force [N]": [closed_forms.hertz_force(approach=d, **case.sphere) for d in case.approaches],
            "bem3d force [N]": [o["force"] for o in bem["loads"]],
            "mdr force [N]": [o["force"] for o in springs["loads"]],
        },
        "pressure": {"x [m]": bem["grids"][1]["x"], "bem3d pressure [Pa]": bem["grids"][1]["pressure"]},
        "exact-pressure": {
            "x [m]": x,
            "hertz pressure [Pa]": closed_forms.hertz_pressure(x, approach=case.approach, **case.sphere),
        },
        "refinement": {
            "cells per contact radius": case.cells_per_radius,
            "bem3d force error": [o["force"] / case.force - 1 for o in bem["grids"]],
            "mdr force error": [o["force"] / case.force - 1 for o in springs["grids"]],
            "bem3d pressure error": [o["pressure_error"] for o in bem["grids"]],
        },
    }


CASE = Case(
    name="hertz",
    chapter=Chapter.EXACT,
    place=1,
    claim=CLAIM,
    answers="Smooth sphere: both methods against Hertz",
    quick=Hertz(),
    full=Hertz(cells_per_radius=(8, 16, 32, 64, 128)),
    run=run,
    evidence=evidence,
    needs=model_needed.sphere,
)
