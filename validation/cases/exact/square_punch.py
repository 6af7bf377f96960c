"""Flat punches: the stiffness of a square and of a circle, and what length the 1D model should have."""

from dataclasses import dataclass

import numpy as np

import bem3d
import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, columns
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.selection import model_needed
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


@dataclass(frozen=True, kw_only=True)
class Punch:
    """One punch on one grid."""

    case: SquarePunch
    cells: int


@dataclass(frozen=True)
class SquarePunchResult:
    """Stiffness of square and circle, one outcome a grid; of the 1D model with both lengths."""

    case: SquarePunch
    punches: list[Outcome]
    springs: tuple[float, float]


def run(case: SquarePunch, engine: Engine = SERIAL) -> SquarePunchResult:
    """Press the punches with both methods."""
    punches = engine.map(press_by_bem, [Punch(case=case, cells=n) for n in case.cells])
    lengths = (case.side, closed_forms.SQUARE_PUNCH * case.side)
    return SquarePunchResult(case, punches, (_springs(case, lengths[0]), _springs(case, lengths[1])))


def press_by_bem(punch: Punch) -> Outcome:
    """Both punches pressed by a unit approach, every cell in contact."""
    case, cells = punch.case, punch.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=case.side / cells, modulus=case.modulus)
    x = (np.arange(cells) + 0.5) / cells - 0.5
    square = bem3d.solve_fixed_area(half_space, np.ones((cells, cells), dtype=bool), tolerance=case.tolerance)
    disc = np.hypot(x[:, np.newaxis], x) < 0.5
    circle = bem3d.solve_fixed_area(half_space, disc, tolerance=case.tolerance)
    equivalent = np.sqrt(np.count_nonzero(disc) / np.pi) / cells * case.side
    return {
        "square": np.array(square.stiffness),
        "circle": np.array(circle.stiffness),
        "circle_radius": np.array(equivalent),
        "x": x * case.side,
        "pressure": square.pressure[cells // 2],
    }


def _springs(case: SquarePunch, length: float) -> float:
    """Stiffness of the flat 1D punch of that length, all springs in contact."""
    curve = mdr.load_curve(np.zeros(case.cells[0]), length=length, modulus=case.modulus)
    return curve.at_approach(1e-3 * case.side).stiffness


def evidence(result: SquarePunchResult) -> Evidence:
    """Stiffness, extrapolated to cells of no size, against the closed forms; the 1D lengths against the square."""
    case = result.case
    n = np.array(case.cells)
    square = np.array([float(o["square"]) for o in result.punches]) / (case.modulus * case.side)
    circle = np.array([float(o["circle"] / o["circle_radius"]) for o in result.punches]) / (2 * case.modulus)
    short, long = (k / (case.modulus * case.side) for k in result.springs)
    limit = _extrapolated(square)
    exact = closed_forms.square_punch_stiffness(side=case.side, modulus=case.modulus) / (case.modulus * case.side)
    steps = np.abs(np.diff(square))
    numbers = (
        Number(
            quantity="bem3d: square punch, k / (E* L), extrapolated",
            value=limit,
            reference=exact,
            source="capacitance of the square, numerical",
            tolerance=5e-4,
            grid=abs(limit - _extrapolated(square[:-1])),
            reason="five units of the last digit of the reference, 1.1523",
        ),
        Number(
            quantity="bem3d: square punch, order in the cell size",
            value=float(np.log2(steps[-2] / steps[-1])),
            reference=1.0,
            source="error model",
            tolerance=0.1,
            reason="the pressure is singular at the edge: first order; the next term, of order 1.5, bends it",
        ),
        Number(
            quantity="bem3d: circular punch, k / (2 E* a)",
            value=circle[-1],
            reference=1.0,
            source="Boussinesq",
            tolerance=2 / n[-1],
            reason="half a cell at the edge, a being the radius of a circle of as many cells; 2 dx / L",
        ),
        _length("L", short, exact),
        _length("1.1523 L", long, exact),
        Number(
            quantity="often quoted 1.012 * 2 / sqrt(pi), beside the extrapolated bem3d",
            value=1.012 * 2 / np.sqrt(np.pi),
            reference=limit,
            source="bem3d",
            tolerance=5e-4,
            reason="as for the extrapolation itself",
            role=Role.FINDING,
        ),
    )
    last = result.punches[-1]
    mean = float(last["square"]) / case.side**2
    return Evidence(
        title="Flat punches",
        compared=(
            f"A flat square of side L and a flat circle of diameter L, pressed by boundary elements on {n[0]}² to "
            f"{n[-1]}² cells that just hold the square; a flat profile on springs, of length L and of 1.1523 L."
        ),
        numbers=numbers,
        tables=(
            Table(
                "refinement",
                {
                    "cells per side": list(case.cells),
                    "square k / (E* L)": square.tolist(),
                    "circle k / (2 E* a)": circle.tolist(),
                },
            ),
            Table(
                "levels",
                {
                    "level": ["capacitance", "extrapolated", "mdr L", "mdr 1.1523 L"],
                    "k / (E* L)": [exact, limit, short, long],
                },
            ),
            Table("pressure", columns(**{"x / L": last["x"] / case.side, "p / mean p": last["pressure"] / mean})),
        ),
        conclusions=(
            f"By boundary elements the stiffness of the square tends to {limit:.5f} E* L; on n cells a side it is low "
            f"by a fraction of {(limit / square[-1] - 1) * n[-1]:.3f} / n.",
            f"A 1D model of length L saturates {100 * (1 - short / exact):.1f} % too soft; "
            "with 1.1523 L it saturates alike, by choice of the length.",
        ),
        captions={
            "square_punch": (
                "(a) Stiffness against the cell size: the square over E* L, with the extrapolation and both 1D "
                "lengths; the circle over 2 E* a. (b) Pressure under the square along its middle, finest grid, over "
                "its mean: singular at the edges."
            )
        },
    )


def _length(name: str, stiffness: float, exact: float) -> Number:
    return Number(
        quantity=f"mdr: full contact with L_1D = {name}, k / (E* L)",
        value=stiffness,
        reference=exact,
        source="capacitance of the square, numerical",
        tolerance=5e-4,
        reason="as for boundary elements",
        role=Role.FINDING,
    )


def _extrapolated(stiffness: np.ndarray) -> float:
    """Limit of a first-order sequence on doubled grids, from its last two members (Richardson)."""
    return float(2 * stiffness[-1] - stiffness[-2])


CASE = Case(
    name="square_punch",
    chapter=Chapter.EXACT,
    place=2,
    claim="Every load curve ends at the stiffness of the flat punch.",
    answers="Flat punches: the stiffness at which every load curve ends, and the length of the 1D model",
    quick=SquarePunch(),
    full=SquarePunch(cells=(16, 32, 64, 128, 256)),
    run=run,
    evidence=evidence,
    needs=model_needed.square_punch,
)
