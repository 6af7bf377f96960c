"""Flat punches: the stiffness of a square and of a circle, and what length the 1D model should have."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

import bem3d
import mdr
from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, columns
from validation.analysis.wording import by_status
from validation.cases.exact.refinement import first_order_limit
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.selection import model_needed
from validation.theory import closed_forms

CLAIM = "A flat square punch on the half-space has the stiffness 1.1523 E* L, and a circular one 2 E* a."


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
    """Stiffness, extrapolated to cells of zero size, and of both 1D lengths, beside the closed forms."""
    case, n = result.case, result.case.cells
    square = _over_cells(result, "square") / (case.modulus * case.side)
    circle = _over_cells(result, "circle") / _over_cells(result, "circle_radius") / (2 * case.modulus)
    exact = closed_forms.square_punch_stiffness(side=case.side, modulus=case.modulus) / (case.modulus * case.side)
    short, long = (k / (case.modulus * case.side) for k in result.springs)
    limit = first_order_limit(square)
    levels = {"capacitance": exact, "extrapolated": limit, "mdr L": short, "mdr 1.1523 L": long}
    last, numbers = result.punches[-1], _numbers(case, square, circle, levels)
    claims = _claims(numbers, error_of_cells=(limit / square[-1] - 1) * n[-1])
    return Evidence(
        title="Flat punches",
        method=(
            f"A flat square of side L and a flat circle of diameter L, pressed by boundary elements on {n[0]}² to "
            f"{n[-1]}² cells that cover the square; a flat profile on springs, of length L and of 1.1523 L."
        ),
        numbers=numbers,
        claims=claims,
        finding=f"{headline(claims)}.",
        headlines={"square_punch": headline(claims)},
        tables=(
            Table(
                "refinement",
                columns(**{"cells per side": n, "square k / (E* L)": square, "circle k / (2 E* a)": circle}),
            ),
            Table("levels", {"level": list(levels), "k / (E* L)": list(levels.values())}),
            Table(
                "pressure",
                columns(
                    **{
                        "x / L": last["x"] / case.side,
                        "p / mean p": last["pressure"] / (float(last["square"]) / case.side**2),
                    }
                ),
            ),
        ),
        conclusions=(),
        captions={
            "square_punch": (
                "(a) Stiffness against the cell size: the square over E* L, with the extrapolation and both 1D "
                "lengths; the circle over 2 E* a. (b) Pressure under the square along its middle over its mean, "
                "finest grid: singular at the edges."
            )
        },
    )


def _claims(numbers: tuple[Number, ...], error_of_cells: float) -> tuple[JudgedClaim, ...]:
    square, _, circle, springs, quoted = numbers
    return (
        answered(
            CLAIM,
            numbers[:3],
            f"boundary elements tend to {square.value:.5f} ± {square.uncertainty:.5f} for the square (on n cells a "
            f"side they have a fraction of {error_of_cells:.3f} / n less), and have {circle.value:.4f} times the "
            "closed form for the circle.",
        ),
        answered(
            "A 1D model as long as the side has the stiffness of the square in full contact.",
            [springs],
            f"it is {_too_soft(springs)}.",
        ),
        answered(
            "The factor of the square is 1.012 * 2 / sqrt(pi), as it is often quoted.",
            [quoted],
            f"that is {quoted.value:.4f}, {100 * (quoted.value / quoted.reference - 1):+.1f} % off.",
        ),
    )


def _too_soft(number: Number) -> str:
    off = 100 * (number.value / number.reference - 1)
    return f"{abs(off):.1f} % too {'soft' if off < 0 else 'stiff'}"


def headline(claims: Sequence[JudgedClaim]) -> str:
    """Boundary elements, and springs as long as the side."""
    exact = by_status(
        claims[0],
        holds="Boundary elements have the stiffness of flat punches",
        fails="Boundary elements do not have the stiffness of flat punches",
        undecided="The stiffness of flat punches is open",
    )
    (springs,) = claims[1].numbers
    model = by_status(claims[1], holds="has it too", fails=f"is {_too_soft(springs)}", undecided="is open")
    return f"{exact}; a 1D model of length L {model}"


def _over_cells(result: SquarePunchResult, name: str) -> np.ndarray:
    return np.array([float(o[name]) for o in result.punches])


def _numbers(case: SquarePunch, square: np.ndarray, circle: np.ndarray, levels: dict[str, float]) -> tuple[Number, ...]:
    """Square, circle and the 1D model of length L beside the closed forms, and the order in the cell size."""
    limit, steps = levels["extrapolated"], np.abs(np.diff(square))
    beside_square = partial(
        Number, reference=levels["capacitance"], source="capacitance of the square, numerical", tolerance=5e-4
    )
    return (
        beside_square(
            quantity="k / (E* L) of the square, extrapolated",
            model="bem3d",
            value=limit,
            grid=abs(limit - first_order_limit(square[:-1])),
            reason="five units of the last digit of the reference, 1.1523",
        ),
        Number(
            quantity="order of k of the square in the cell size",
            model="bem3d",
            value=float(np.log2(steps[-2] / steps[-1])),
            reference=1.0,
            source="error model",
            tolerance=0.1,
            reason="first order, since the pressure is singular at the edge; the next term, of order 1.5, changes it",
        ),
        Number(
            quantity="k / (2 E* a) of the circle",
            model="bem3d",
            value=circle[-1],
            reference=1.0,
            source="Boussinesq",
            tolerance=2 / case.cells[-1],
            reason="half a cell at the edge; a is the radius of a circle with the area of the cells; 2 dx / L",
        ),
        beside_square(
            quantity="k / (E* L) in full contact",
            model="mdr",
            where={"length": "L_1D = L"},
            value=levels["mdr L"],
            reason="five units of the last digit of the reference, 1.1523",
            role=Role.FINDING,
        ),
        beside_square(
            quantity="often quoted factor 1.012 * 2 / sqrt(pi), against the extrapolated k / (E* L)",
            value=1.012 * 2 / np.sqrt(np.pi),
            reference=limit,
            source="bem3d",
            reason="as for the extrapolated k / (E* L) of the square",
            role=Role.FINDING,
        ),
    )


CASE = Case(
    name="square_punch",
    chapter=Chapter.EXACT,
    place=2,
    claim=CLAIM,
    answers="Flat punches: the stiffness at which every load curve ends, and the length of the 1D model",
    quick=SquarePunch(),
    full=SquarePunch(cells=(16, 32, 64, 128, 256)),
    run=run,
    evidence=evidence,
    needs=model_needed.square_punch,
)
