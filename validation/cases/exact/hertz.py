"""A smooth sphere on the half-space: both methods against Hertz."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, off_by
from validation.analysis.series import Series, single
from validation.analysis.study import Outcomes, Study
from validation.cases.exact.refinement import order
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.selection import model_needed
from validation.simulation.exact_contacts import SmoothSphere, press_sphere_by_bem, press_sphere_by_springs
from validation.theory import closed_forms

BEM, MDR, OVER, HERTZ, SECOND = "bem3d", "mdr", "mdr over bem3d", "Hertz", "second order"


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
    def force(self) -> float:
        """Of Hertz [N]."""
        return self.sphere(1, self.approach).force

    @property
    def approaches(self) -> list[float]:
        """Of the load curve [m]."""
        return [float(s * self.approach) for s in np.linspace(0, 1, self.load_steps + 1)[1:]]

    def sphere(self, resolution: int, approach: float) -> SmoothSphere:
        """On cells of side a / resolution, where a is the contact radius of the case."""
        same = partial(SmoothSphere, radius=self.radius, modulus=self.modulus, tolerance=self.tolerance)
        return same(approach=approach, cells=4 * resolution, spacing=self.contact_radius / resolution)


def run(case: Hertz, engine: Engine = SERIAL) -> Outcomes:
    """Press the sphere with both methods, on all "grids" at one approach, and with all "loads" on the second grid."""
    spheres = {
        "grids": [case.sphere(n, case.approach) for n in case.cells_per_radius],
        "loads": [case.sphere(case.cells_per_radius[1], approach) for approach in case.approaches],
    }
    solves = ((BEM, press_sphere_by_bem), (MDR, press_sphere_by_springs))
    found = {(model, group): one for model, solve in solves for group, one in engine.map_groups(solve, spheres).items()}
    return Outcomes(case, found)


# tolerance of the force in units of (dx/a)^2, and why; what scatters its error from grid to grid
FORCE_ERROR = {
    BEM: (
        0.25,
        "second order: the discrete pressure minimises the energy, so the error of the force is quadratic in that of "
        "the pressure; (dx/a)^2 / 4 includes the staircase edge of the contact",
        "the staircase edge of the contact scatters the error",
    ),
    MDR: (
        0.5,
        "second order: midpoint rule, (dx/a)^2 / 8 inside and at most 3/8 from the two ends of the contact",
        "the error depends on where the ends of the contact lie between two springs",
    ),
}
ONE_CELL = "one cell in the radius; for springs it is the stiffness again, both being their number in contact"
FIRST = "first order in the cell size: the pressure falls as a square root at the edge of the contact"
RADIUS = "k is proportional to the radius of the discrete contact: one cell in the radius"
FORCE, PRESSURE, ERROR = "force F [N]", "pressure p [MPa]", "|F / F(Hertz) - 1|"
APPROACH, DISTANCE, CELLS = "approach d [µm]", "distance from the centre [mm]", "cells per contact radius"
PRESSURE_ERROR = "relative L2 error of the pressure"


def series(result: Outcomes) -> list[Series]:
    """Force, approach, contact radius, stiffness and pressure over Hertz on the finest grid; order of the force."""
    case, bem, springs = result.case, result[BEM, "grids"], result[MDR, "grids"]
    cell, finest = 1 / case.cells_per_radius[-1], bem[-1]
    over_bem, radius = float(springs[-1]["force"] / finest["force"]), float(finest["radius"]) / case.contact_radius
    both = "sum of both discretisation errors"
    return [
        *_shown(result),
        *_over_hertz(case, BEM, bem),
        *_over_hertz(case, MDR, springs),
        single("contact radius over Hertz", BEM, radius, cell, HERTZ, ONE_CELL, 1.0),
        single(PRESSURE_ERROR, BEM, float(finest["pressure_error"]), cell, HERTZ, FIRST),
        single("force at the given approach", OVER, over_bem, 0.75 * cell**2, "the other method", both, 1.0),
    ]


def _shown(result: Outcomes) -> Iterator[Series]:
    """Load curves and pressure on the second grid, and errors on all."""
    case, second = result.case, result[BEM, "grids"][1]
    n, x = case.cells_per_radius, np.linspace(0, 2 * case.contact_radius, 401)
    exact = closed_forms.hertz_pressure(x, approach=case.approach, radius=case.radius, modulus=case.modulus)
    by_load = partial(Series, FORCE, along=APPROACH, at=1e6 * np.array(case.approaches))
    yield by_load(HERTZ, np.array([case.sphere(1, d).force for d in case.approaches]))
    yield Series(PRESSURE, HERTZ, 1e-6 * exact, along=DISTANCE, at=1e3 * x)
    yield Series(PRESSURE, BEM, 1e-6 * second["pressure"], along=DISTANCE, at=1e3 * second["x"])
    for model in (BEM, MDR):
        yield by_load(model, np.array([float(o["force"]) for o in result[model, "loads"]]))
        yield Series(ERROR, model, np.abs(_errors(case, result[model, "grids"])), along=CELLS, at=n)
    first = abs(_errors(case, result[BEM, "grids"])[0])
    yield Series(ERROR, SECOND, first * (np.array(n) / n[0]) ** -2.0, along=CELLS, at=n)
    errors = np.array([float(o["pressure_error"]) for o in result[BEM, "grids"]])
    yield Series(PRESSURE_ERROR + " on each grid", BEM, errors, along=CELLS, at=n)


def _errors(case: Hertz, outcomes: list[Outcome]) -> list[float]:
    """Of the force, relative."""
    return [float(o["force"]) / case.force - 1 for o in outcomes]


def _over_hertz(case: Hertz, model: str, outcomes: list[Outcome]) -> Iterator[Series]:
    """Force, approach and stiffness on the finest grid over those of Hertz, and the order of the force."""
    cell, last = 1 / case.cells_per_radius[-1], outcomes[-1]
    quadratic, why, scatter = FORCE_ERROR[model]
    punch = closed_forms.circular_punch_stiffness(radius=case.contact_radius, modulus=case.modulus)
    force, approach = float(last["force"]) / case.force, float(last["approach_at_force"]) / case.approach
    near, power = quadratic * cell**2, "two thirds of the tolerance of the force, since d ~ F^(2/3)"
    rate, second = order(case.cells_per_radius, _errors(case, outcomes)), f"second order; {scatter}"
    yield single("force at the given approach over Hertz", model, force, near, HERTZ, why, 1.0)
    yield single("approach at the given force over Hertz", model, approach, 2 / 3 * near, HERTZ, power, 1.0)
    yield single("stiffness over 2 E* a", model, float(last["stiffness"]) / punch, cell, "Boussinesq", RADIUS, 1.0)
    yield single("order of the force error in the cell size", model, rate, 0.5, "error model", second, 2.0)


def _curves(quantity: str, *models: str) -> tuple[Curve, ...]:
    looks = {BEM: ("bem", "boundary elements"), MDR: ("mdr around", "MDR")}
    looks |= {HERTZ: ("exact", HERTZ), SECOND: ("guide", SECOND)}
    return tuple(Curve(quantity, model, *looks[model]) for model in models)


STUDY = Study(
    title="Smooth sphere",
    method=(
        "A rigid sphere, R = {c.radius:g} m, on a half-space of E* = {c.modulus:SI}Pa, pressed by {c.approach:SI}m "
        "(Hertz: {c.force:.1f} N, a = {c.contact_radius:SI}m). MDR: the parabola x²/R on springs. Boundary elements: "
        "(x² + y²)/2R on cells of the same width. {c.cells_per_radius} cells in the contact radius (whole numbers, "
        "which favours the springs), residual {c.tolerance:g}."
    ),
    series=series,
    claims=(
        Claim(printed=off_by).saying(
            "Both methods give the contact of Hertz.", short="Springs and boundary elements beside the contact of Hertz"
        ),
    ),
    charts=(
        Chart("hertz").of(
            "(a) Load curve, {c.cells_per_radius[1]} cells in the largest contact radius. (b) Pressure along a row of "
            "cells next to the centre, {c.cells_per_radius[1]} cells in the contact radius. (c) Relative error of the "
            "force at a given approach against cells in the contact radius. Dotted: second order.",
            Panel(APPROACH, FORCE, log="").of(*_curves(FORCE, HERTZ, BEM, MDR)),
            Panel(DISTANCE, PRESSURE, log="").of(*_curves(PRESSURE, HERTZ, BEM)),
            Panel(CELLS, ERROR, log="xy", ticked=True).of(*_curves(ERROR, BEM, MDR, SECOND)),
        ),
    ),
)
CASE = Case(
    name="hertz",
    chapter=Chapter.EXACT,
    place=1,
    answers="Smooth sphere: both methods against Hertz",
    quick=Hertz(),
    full=Hertz(cells_per_radius=(8, 16, 32, 64, 128)),
    run=run,
    study=STUDY,
    needs=model_needed.sphere,
)
