"""Flat punches: the stiffness of a square and of a circle, and what length the 1D model should have."""

from dataclasses import dataclass
from functools import partial

import numpy as np

import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.evidence import Role
from validation.analysis.series import Series, single
from validation.analysis.study import Outcomes, Study
from validation.cases.exact.refinement import first_order_limit
from validation.engine.engine import SERIAL, Engine
from validation.selection import model_needed
from validation.simulation.exact_contacts import FlatPunches, press_flat_punches
from validation.theory import closed_forms


@dataclass(frozen=True, kw_only=True)
class SquarePunch:
    """A rigid flat punch of side L (or diameter L) on finer and finer grids that just hold it.

    side: L [m]; modulus: E* [Pa]; cells: on a side, each twice the one before; tolerance: of the linear solve.
    """

    side: float = 1e-2
    modulus: float = 1e9
    cells: tuple[int, ...] = (16, 32, 64, 128)
    tolerance: float = 1e-10


def run(case: SquarePunch, engine: Engine = SERIAL) -> Outcomes:
    """Press the punches by boundary elements; springs are pressed at once."""
    punches = [FlatPunches(side=case.side, modulus=case.modulus, cells=n, tolerance=case.tolerance) for n in case.cells]
    return Outcomes(case, dict(zip(case.cells, engine.map(press_flat_punches, punches), strict=True)))


SQUARE, CIRCLE, FULL = "k / (E* L) of the square", "k / (2 E* a) of the circle", "k / (E* L) in full contact"
LIMIT = SQUARE + ", extrapolated"
QUOTED = "often quoted factor 1.012 * 2 / sqrt(pi), against the extrapolated k / (E* L)"
ORDER, PRESSURE, CELLS = "order of k of the square in the cell size", "p / mean p", "cells per side"
LENGTHS, EXTRAPOLATED = ("L_1D = L", "L_1D = 1.1523 L"), "bem3d, extrapolated"
FIVE_UNITS, NUMERICAL = 5e-4, "capacitance of the square, numerical"
DIGITS = "five units of the last digit of the reference, 1.1523"
FIRST_ORDER = "first order, since the pressure is singular at the edge; the next term, of order 1.5, changes it"
HALF_A_CELL = "half a cell at the edge; a is the radius of a circle with the area of the cells; 2 dx / L"


def series(result: Outcomes) -> list[Series]:
    """Stiffness, extrapolated to cells of zero size, and of both 1D lengths, beside the closed forms."""
    n, last = result.case.cells, result[result.case.cells[-1]]
    square, circle = (np.array([float(result[cells][name]) for cells in n]) for name in ("square", "circle"))
    limit, exact = first_order_limit(square), closed_forms.square_punch_stiffness(side=1.0, modulus=1.0)
    step, by_cells = np.abs(np.diff(square)), partial(Series, along=CELLS, at=n)
    quoted, as_limit = 1.012 * 2 / np.sqrt(np.pi), "as for the extrapolated k / (E* L) of the square"
    left, rate = abs(limit - first_order_limit(square[:-1])), float(np.log2(step[-2] / step[-1]))
    springs = [
        mdr.load_curve(np.zeros(n[0]), length=length, modulus=1.0).at_approach(1e-3).stiffness
        for length in (1.0, closed_forms.SQUARE_PUNCH)
    ]
    digits = partial(single, within=FIVE_UNITS, of=NUMERICAL, reason=DIGITS, reference=exact)
    return [
        by_cells(SQUARE, "bem3d", square),
        *(by_cells(SQUARE, name, np.full(len(n), k)) for name, k in zip(LENGTHS, springs, strict=True)),
        by_cells(SQUARE, "capacitance", np.full(len(n), exact)),
        Series(SQUARE, EXTRAPOLATED, 2 * square[1:] - square[:-1], along=CELLS, at=n[1:]),
        by_cells(CIRCLE, "bem3d, on each grid", circle),
        Series(PRESSURE, "bem3d", last["pressure"], along="x / L", at=last["x"]),
        digits(LIMIT, "bem3d", limit, grid=left),
        single(ORDER, "bem3d", rate, 0.1, "error model", FIRST_ORDER, 1.0),
        single(CIRCLE, "bem3d", float(circle[-1]), 2 / n[-1], "Boussinesq", HALF_A_CELL, 1.0),
        digits(FULL, "mdr", springs[0], where={"length": LENGTHS[0]}, role=Role.FINDING),
        single(QUOTED, "", quoted, FIVE_UNITS, "bem3d", as_limit, limit, role=Role.FINDING),
    ]


STUDY = Study(
    title="Flat punches",
    method=(
        "A flat square of side L and a flat circle of diameter L, pressed by boundary elements on grids of {c.cells} "
        "cells a side that cover the square; a flat profile on springs, of length L and of 1.1523 L."
    ),
    series=series,
    claims=(
        Claim(quantity=(LIMIT, ORDER, CIRCLE)).saying(
            "A flat square punch on the half-space has the stiffness 1.1523 E* L, and a circular one 2 E* a.",
            short="Boundary elements beside the closed forms of flat punches",
        ),
        Claim(quantity=FULL).saying(
            "A 1D model as long as the side has the stiffness of the square in full contact.",
            short="a 1D model of length L",
        ),
        Claim(says="The factor of the square is 1.012 * 2 / sqrt(pi), as it is often quoted.", quantity=QUOTED),
    ),
    charts=(
        Chart("square_punch", claims=(0, 1)).of(
            "(a) Stiffness of the square over E* L against the cells, with the closed form and both 1D lengths. (b) "
            "Pressure under the square along its middle over its mean, finest grid: singular at the edges.",
            Panel(CELLS, "k / (E* L); circle k / (2 E* a)", ticked=True).of(
                Curve(SQUARE, "capacitance", "thick", "square, numerical capacitance"),
                Curve(SQUARE, LENGTHS[0], "mdr line", "MDR, L_1D = L"),
                Curve(SQUARE, LENGTHS[1], "other", "MDR, L_1D = 1.1523 L"),
                Curve(SQUARE, EXTRAPOLATED, "guide", "first-order extrapolation"),
                Curve(SQUARE, "bem3d", "bem", "boundary elements, square"),
                Curve(CIRCLE, "bem3d, on each grid", "crosses", "boundary elements, circle"),
            ),
            Panel("x / L", PRESSURE, log="y").of(Curve(PRESSURE, style="bem", label="_")),
        ),
    ),
)
CASE = Case(
    name="square_punch",
    chapter=Chapter.EXACT,
    place=2,
    answers="Flat punches: the stiffness at which every load curve ends, and the length of the 1D model",
    quick=SquarePunch(),
    full=SquarePunch(cells=(16, 32, 64, 128, 256)),
    run=run,
    study=STUDY,
    needs=model_needed.square_punch,
)
