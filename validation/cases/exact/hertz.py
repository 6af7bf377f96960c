"""Contacts that have a closed form: a sphere and an ellipse of Hertz, flat punches, and a wave of Westergaard."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

import mdr
from validation.analysis.evidence import Number, Role
from validation.analysis.number_text import off_by
from validation.analysis.series import Margin, single
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.engine.engine import Outcome
from validation.engine.realisations import NotConvergedError
from validation.simulation import exact_contacts as contacts
from validation.simulation import model_needed
from validation.simulation.exact_contacts import CosineWave, FlatPunches, PublishedContact, SmoothSphere
from validation.theory import closed_forms

BEM, MDR = "boundary elements", "springs"
CAPACITANCE = closed_forms.square_punch_stiffness(side=1.0, modulus=1.0)
"""k / (E* L) of the square."""


@dataclass(frozen=True, kw_only=True)
class Hertz:
    """Smooth contacts on finer and finer grids: the wheel of Table 14.1, flat punches, a wave, an ellipse.

    radius [m], modulus E* [Pa], approach [m]: of the wheel; cells_per_radius: of its Hertz contact, on a grid four
    times as wide; load_steps: of a load curve on the second grid; punch_cells: on a side, each twice the one before;
    wave_cells: in a wavelength; loads: of the wave, mean pressure over that of full contact; ellipse_cells: to the
    semi-axis along; tolerance: residual of the solver.
    """

    radius: float = 0.5
    modulus: float = 236.25e9
    approach: float = 7.856e-6
    cells_per_radius: tuple[int, ...] = (8, 16, 32, 64)
    load_steps: int = 8
    punch_cells: tuple[int, ...] = (16, 32, 64, 128)
    wave_cells: tuple[int, ...] = (64, 128, 256, 512)
    loads: tuple[float, ...] = (0.1, 0.3, 0.5, 0.8)
    ellipse_cells: tuple[int, ...] = (16, 32, 64)
    tolerance: float = 1e-8

    def __post_init__(self) -> None:
        if 0.5 not in self.loads:
            raise ValueError(f"loads must contain 0.5, where the rate is measured, got {self.loads}")

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

    def wave(self, load: float, cells: int) -> CosineWave:
        return CosineWave(load=load, cells=cells, tolerance=self.tolerance)


def run(case: Hertz, engine: Engine = SERIAL) -> Outcomes:
    """The sphere by both methods on all grids, and with all loads on the second one; the others by boundary elements.

    Raises NotConvergedError where an ellipse does not converge.
    """
    spheres = {
        "grids": [case.sphere(n, case.approach) for n in case.cells_per_radius],
        "loads": [case.sphere(case.cells_per_radius[1], approach) for approach in case.approaches],
    }
    solves = ((BEM, contacts.press_sphere_by_bem), (MDR, contacts.press_sphere_by_springs))
    sphere_outcomes = {
        (model, group): outcomes
        for model, solve in solves
        for group, outcomes in engine.map_groups(solve, spheres).items()
    }
    punches = [FlatPunches(cells=n, tolerance=case.tolerance) for n in case.punch_cells]
    waves = {load: [case.wave(load, n) for n in case.wave_cells] for load in case.loads}
    ellipses = [PublishedContact(cells=n, tolerance=case.tolerance) for n in case.ellipse_cells]
    of_ellipse = list(engine.map(contacts.press_ellipse, ellipses))
    if lost := [
        f"{n} cells to the semi-axis" for n, o in zip(case.ellipse_cells, of_ellipse, strict=True) if o["failed"]
    ]:
        raise NotConvergedError("a grid of the ellipse has no contact", lost)
    of_punch = list(engine.map(contacts.press_flat_punches, punches))
    return Outcomes(
        case, {**sphere_outcomes, PUNCH: of_punch, **engine.map_groups(contacts.press_wave, waves), ELLIPSE: of_ellipse}
    )


SPHERE, PUNCH, WAVE, ELLIPSE = "sphere", "flat punches", "wave", "ellipse"
# tolerance of the force in units of (dx/a)^2, and why
FORCE_ERROR = {
    BEM: (
        0.25,
        "second order: the discrete pressure minimises the energy, so the error of the force is quadratic in that of "
        "the pressure; (dx/a)^2 / 4 includes the staircase edge of the contact, which scatters it",
    ),
    MDR: (
        0.5,
        "second order: midpoint rule, (dx/a)^2 / 8 inside and at most 3/8 from the two ends of the contact, which lie "
        "anywhere between two springs",
    ),
}
ONE_CELL = "one cell in the radius; for springs it is the stiffness again, both being their number in contact"
FIRST = "first order in the cell size: the pressure falls as a square root at the edge of the contact"
RADIUS = "k is proportional to the radius of the discrete contact: one cell in the radius"
EDGE = "an error in both edge cells as large as the pressure one cell inside the edge"
HALF_A_CELL = "half a cell at the edge; a is the radius of a circle with the area of the cells; 2 dx / L"
SINGULAR = "first order, since the pressure is singular at the edge; the next term, of order 1.5, changes it"
HALF_LOAD = "p ~ dx^(1/2) at the edge, which at half load lies between cells on every grid"
FORCE, PRESSURE, ERROR = "force F [N]", Quantity("pressure_p_MPa", "pressure p [MPa]"), "relative error"
APPROACH, DISTANCE, CELLS = "approach d [µm]", "distance from the centre [mm]", "cells"
SQUARE = Quantity("k_E_L_of_the_square", "k / (E* L) of the square")
LIMIT = Quantity("k_E_L_of_the_square_extrapolated", "k / (E* L) of the square, extrapolated")
CIRCLE = Quantity("k_2_E_a_of_the_circle", "k / (2 E* a) of the circle")
LOAD, PLACE, WAVE_PRESSURE = "mean p / p*", "x / wavelength", Quantity("pressure_p_p", "pressure p / p*")
ORDER = Quantity("order_of_the_error_in_the_cell_size")
PRESSURE_ERROR = Quantity("L2_error_of_the_pressure")
WIDTH = Quantity("half-width_of_the_wave")
FULL, LENGTHS = Quantity("stiffness_of_springs_in_full_contact"), ("L_1D = L", "L_1D = 1.1523 L")
CONTACT = {contacts.APPROACH: (0.08190, "mm"), contacts.PRESSURE: (770.6, "MPa")}
"""Published example output of the program CONTACT for 100 kN, G = 82 GPa, nu = 0.28 on both bodies."""
DIGITS = Margin(
    2e-4,
    "2e-4: the fourth digit of what is published",
    relative=True,
    source="CONTACT, published example output, four digits",
    role=Role.CRITERION,
)


def series(result: Outcomes) -> list[Series]:
    return [number for part in (_curves, _sphere, _punches, _waves, _ellipse) for number in part(result)]


def order(cells: Sequence[int], errors: ArrayLike) -> float:
    """Slope of ln |error| against ln of the cell size, by least squares."""
    return float(-np.polynomial.polynomial.polyfit(np.log(cells), np.log(np.abs(errors)), 1)[1])


def first_order_limit(values: NDArray[np.floating]) -> float:
    """Limit of a first-order sequence on doubled grids, from its last two members (Richardson)."""
    return float(2 * values[-1] - values[-2])


def _column(outcomes: Sequence[Outcome], name: str) -> NDArray[np.float64]:
    return np.array([float(outcome[name]) for outcome in outcomes])


def _fall(
    what: str, cells: Sequence[int], errors: ArrayLike, power: float, within: float, why: str
) -> Iterator[Series]:
    """Errors grid by grid, and the order at which they fall."""
    yield Series(ERROR, what, np.abs(errors), along=CELLS, at=cells)
    yield single(ORDER, what, order(cells, errors), within, "error model", why, float(power))


def _curves(result: Outcomes) -> Iterator[Series]:
    """Load curves and pressure of the sphere on the second grid."""
    case, second = result.case, result[BEM, "grids"][1]
    x = np.linspace(0, 2 * case.contact_radius, 401)
    exact = closed_forms.hertz_pressure(x, approach=case.approach, radius=case.radius, modulus=case.modulus)
    by_load = partial(Series, FORCE, along=APPROACH, at=1e6 * np.array(case.approaches))
    yield by_load("Hertz", np.array([case.sphere(1, d).force for d in case.approaches]))
    for model in (BEM, MDR):
        yield by_load(model, _column(result[model, "loads"], "force"))
    yield Series(PRESSURE, "Hertz", 1e-6 * exact, along=DISTANCE, at=1e3 * x)
    yield Series(PRESSURE, BEM, 1e-6 * second["pressure"], along=DISTANCE, at=1e3 * second["x"])


def _sphere(result: Outcomes) -> Iterator[Series]:
    """Force, approach, stiffness, radius and pressure on the finest grid over those of Hertz; order of the force."""
    case, cell = result.case, 1 / result.case.cells_per_radius[-1]
    punch = closed_forms.circular_punch_stiffness(radius=case.contact_radius, modulus=case.modulus)
    for model, (quadratic, why) in FORCE_ERROR.items():
        outcomes, last = result[model, "grids"], result[model, "grids"][-1]
        over = partial(single, model=f"{SPHERE}, {model}", reference=1.0)
        near, power = quadratic * cell**2, "two thirds of the tolerance of the force, since d ~ F^(2/3)"
        yield over("force over Hertz", value=float(last["force"]) / case.force, within=near, of="Hertz", reason=why)
        approach = float(last["approach_at_force"]) / case.approach
        yield over("approach over Hertz", value=approach, within=2 / 3 * near, of="Hertz", reason=power)
        stiffness = float(last["stiffness"]) / punch
        yield over("stiffness over 2 E* a", value=stiffness, within=cell, of="Boussinesq", reason=RADIUS)
        yield from _fall(
            f"{SPHERE}, {model}", case.cells_per_radius, _column(outcomes, "force") / case.force - 1, 2, 0.5, why
        )
    last, model = result[BEM, "grids"][-1], f"{SPHERE}, {BEM}"
    radius = float(last["radius"]) / case.contact_radius
    yield single("contact radius over Hertz", model, radius, cell, "Hertz", ONE_CELL, 1.0)
    yield single(PRESSURE_ERROR, model, float(last["pressure_error"]), cell, "Hertz", FIRST)


def _punches(result: Outcomes) -> Iterator[Series]:
    """Stiffness of the square on cells of zero size, of the circle, and of springs on both lengths."""
    n = result.case.punch_cells
    square, circle = (_column(result[PUNCH], name) for name in ("square", "circle"))
    limit, by_cells = first_order_limit(square), partial(Series, SQUARE, along=CELLS, at=n)
    left = abs(limit - first_order_limit(square[:-1]))
    why, numerical = "five units of the last digit of the reference, 1.1523", "capacitance of the square, numerical"
    yield by_cells(BEM, square)
    yield by_cells("closed form", np.full(len(n), CAPACITANCE))
    yield single(LIMIT, PUNCH, limit, 5e-4, numerical, why, CAPACITANCE, grid=left)
    yield single(CIRCLE, PUNCH, float(circle[-1]), 2 / n[-1], "Boussinesq", HALF_A_CELL, 1.0)
    yield from _fall(PUNCH, n, square / CAPACITANCE - 1, 1, 0.1, SINGULAR)
    for name, length in zip(LENGTHS, (1.0, CAPACITANCE), strict=True):
        k = mdr.load_curve(np.zeros(n[0]), length=length, modulus=1.0).at_approach(1e-3).stiffness
        yield by_cells(name, np.full(len(n), k))
        role = Role.FINDING if name == LENGTHS[0] else Role.IDENTITY
        near = "10 %: the margin of the mean stiffness of rough punches"
        yield single(FULL, name, 100 * (k / CAPACITANCE - 1), 10.0, numerical, near, unit="%", role=role)


def _waves(result: Outcomes) -> Iterator[Series]:
    """Pressure and width on the finest grid at each load, and how the error of the pressure falls at half load."""
    case = result.case
    for load in case.loads:
        wave, finest = case.wave(load, case.wave_cells[-1]), result[load][-1]
        at_load = partial(single, model=WAVE, of="Westergaard", where={LOAD: load})
        by_place = partial(Series, WAVE_PRESSURE, where={LOAD: load}, along=PLACE, at=finest["x"] / wave.wavelength)
        yield by_place(BEM, finest["pressure"] / wave.full_pressure)
        yield by_place("Westergaard", finest["exact_pressure"] / wave.full_pressure)
        a = closed_forms.westergaard_half_width(**wave.scene)
        at_edge = closed_forms.westergaard_pressure(a - wave.spacing, **wave.scene)
        near = float(at_edge * np.sqrt(2 / np.sum(finest["exact_pressure"] ** 2)))
        yield at_load(PRESSURE_ERROR, value=float(finest["error"]), within=near, reason=EDGE)
        width = float(finest["half_width"]) / a
        yield at_load(WIDTH, value=width, within=wave.spacing / a, reason="one cell at each edge", reference=1.0)
    yield from _fall(WAVE, case.wave_cells, _column(result[0.5], "error"), 1, 0.1, HALF_LOAD)


def _ellipse(result: Outcomes) -> Iterator[Series]:
    """Closed form and the finest grid beside CONTACT; what the grid leaves is what the next coarser one is off."""
    smooth = PublishedContact(cells=1, tolerance=1e-8).closed
    closed = {contacts.APPROACH: 1e3 * smooth.approach, contacts.PRESSURE: 1e-6 * smooth.pressure}
    coarse, fine = result[ELLIPSE][-2:]
    for quantity, (reference, unit) in CONTACT.items():
        finest = float(fine[quantity])
        grid = abs(finest - float(coarse[quantity])) / 3
        for model, value, left in (("closed form", closed[quantity], 0.0), (BEM, finest, grid)):
            yield Series(quantity, model, (value,), reference=reference, grid=left, unit=unit, margin=DIGITS)


def in_per_cent(number: Number) -> str:
    return f"{abs(number.value):.1f} % {'softer' if number.value < 0 else 'stiffer'}"


EXACT = (
    *("force over Hertz", "approach over Hertz", "stiffness over 2 E* a", "contact radius over Hertz"),
    *(PRESSURE_ERROR, LIMIT, CIRCLE, WIDTH),
)
OF_BOTH = (Curve(FORCE, BEM, "marks"), Curve(FORCE, MDR, "around"))
STUDY = Study(
    title="Contacts with closed forms",
    method=(
        "Sphere: R = {c.radius:g} m on a half-space of E* = {c.modulus:SI}Pa, pressed by {c.approach:SI}m (Hertz: "
        "{c.force:.1f} N, a = {c.contact_radius:SI}m), by boundary elements and on springs with the parabola x²/R; "
        "{c.cells_per_radius} cells in the contact radius (whole numbers, which favours the springs). Flat punches: a "
        "square of side L and a circle of diameter L, {c.punch_cells} cells a side. Wave: a rigid cosine in line "
        "contact at mean pressures of {c.loads} of that of full contact, periodic, {c.wave_cells} cells a wavelength; "
        "springs have no equivalent of it. Ellipse: the example that the program CONTACT publishes, {c.ellipse_cells} "
        "cells to the semi-axis along. Residual {c.tolerance:g}. A flat model of springs as long as the side, L_1D = "
        "L, is softer than the square in full contact. One of 1.1523 L is as stiff there by construction, and stiffer "
        "at light loads: by 1.1523^(H/(1+H)) where k ~ F^(1/(1+H)), "
        f"{100 * (CAPACITANCE ** (0.4 / 1.4) - 1):.0f} to {100 * (CAPACITANCE**0.5 - 1):.0f} % for H = 0.4 to 1."
    ),
    series=series,
    claims=(
        Claim(quantity=EXACT, printed=off_by).saying(
            "Boundary elements give the contacts of Hertz, of flat punches and of Westergaard, springs that of Hertz.",
            short="Boundary elements and springs agree with closed forms",
            key="closed-forms",
        ),
        Claim(quantity=tuple(CONTACT)).saying(
            "The closed form of an ellipse and boundary elements give the contact that the program CONTACT publishes.",
            short="Closed form and boundary elements agree with CONTACT",
            key="contact-program",
        ),
        Claim(quantity=FULL, differ=True, printed=in_per_cent).saying(
            "Springs on the length L_1D = L lack the stiffness of a square punch of side L in full contact.",
            short="Springs on L_1D = L lack the stiffness of the square punch in full contact",
            key="square-punch",
        ),
    ),
    charts=(
        Chart("hertz", claims=(0, 2)).of(
            "Sphere: (a) load curve, {c.cells_per_radius[1]} cells in the largest contact radius; (b) pressure along a "
            "row of cells next to the centre. (c) Wave: pressure at each mean pressure, finest grid; lines: "
            "Westergaard. (d) Square punch: stiffness against the cells on a side, with the closed form and both "
            "lengths of a 1D model. (e) Relative error of the force of the sphere, of the stiffness of the square and "
            "of the pressure of the wave at half load, against cells in the radius, on the side and in the wavelength.",
            Panel(APPROACH, FORCE, log="").of(Curve(FORCE, "Hertz", label="closed form"), *OF_BOTH),
            Panel(DISTANCE, PRESSURE, log="").of(
                Curve(PRESSURE, "Hertz", label="closed form"), Curve(PRESSURE, BEM, "marks")
            ),
            Panel(PLACE, WAVE_PRESSURE, log="").of(
                Curve(WAVE_PRESSURE, "Westergaard", "lines", "_", by=(LOAD,)),
                Curve(WAVE_PRESSURE, BEM, "open marks", by=(LOAD,), marker_spacing=0.02),
            ),
            Panel(CELLS, SQUARE, ticked=True).of(
                Curve(SQUARE, "closed form", label="closed form"),
                Curve(SQUARE, LENGTHS[0], "lines", "springs, L_1D = L"),
                Curve(SQUARE, LENGTHS[1], "lines", "springs, L_1D = 1.1523 L"),
                Curve(SQUARE, BEM, "marks"),
            ),
            Panel(CELLS, ERROR, log="xy").of(
                Curve(ERROR, f"{SPHERE}, {BEM}", label="sphere, boundary elements"),
                Curve(ERROR, f"{SPHERE}, {MDR}", label="sphere, springs"),
                Curve(ERROR, PUNCH, label="square punch, boundary elements"),
                Curve(ERROR, WAVE, label="wave, boundary elements"),
            ),
        ),
    ),
)
CASE = Case(
    name="hertz",
    chapter=Chapter.EXACT,
    place=1,
    answers="Contacts with closed forms: a sphere, an ellipse, flat punches, a wave; the length of the 1D model",
    quick=Hertz(),
    full=Hertz(
        cells_per_radius=(8, 16, 32, 64, 128),
        punch_cells=(16, 32, 64, 128, 256),
        wave_cells=(64, 128, 256, 512, 1024),
        ellipse_cells=(16, 32, 64, 128),
    ),
    run=run,
    study=STUDY,
    needs=model_needed.sphere,
)
