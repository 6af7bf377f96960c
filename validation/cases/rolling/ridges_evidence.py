"""What ridges across the track show: errors of both methods over (14.11), through its zeros."""

import math

import numpy as np
from numpy.typing import NDArray

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, columns
from validation.analysis.wording import by_status
from validation.cases.rolling.ridges import BEM, FILTER, SPRINGS, RidgesResult, RollingOverRidges, run
from validation.theory import rolling as rolling_theory

FloatArray = NDArray[np.float64]

EDGE = 0.4
"""How far the edge of a contact on a grid is out of place at most, in cells, measured on circles of 8 to 32 cells."""
CLAIM = "Over ridges across the track the one-dimensional model is exact in three dimensions, (14.11)."
FAR = 5.0
"""q a up to which the response is also judged by itself."""
ERROR, ORDER, STIFFNESS = "error nearest to its bound", "order of the error", "k dd + dF at a prescribed force"


def evidence(result: RidgesResult) -> Evidence:
    """Largest errors of each method on each grid, over the envelope of the response; what a force changes."""
    case, q = result.case, result.case.wavenumbers
    errors = [_error(result, method, cells) for method, cells, given in result.responses if given == "approach"]
    numbers = (*errors, _order(result), _under_force(result))
    claim = answered(CLAIM, [n for n in errors if n.role is not Role.IDENTITY], _answer(result))
    return Evidence(
        title="Ridges across the track: springs, boundary elements and (14.11)",
        method=(
            f"{q.size} ridges at once, {_named(q)}, with a sum of heights of {case.height:g} d, so that each acts "
            "independently. The response of the force to the height of each ridge has an amplitude and a phase, over "
            f"2 E* a. Boundary elements have {', '.join(map(str, case.cells))} cells to a contact radius, springs "
            f"{', '.join(f'{n:g}' for n in case.springs)}. Errors are over the envelope of |sin(q a) / (q a)|, the "
            "smaller of 1 and 1/(q a), and so are defined at the zeros too."
        ),
        numbers=numbers,
        tables=(_curves(result), _table_of_errors(result)),
        conclusions=(),
        claims=(claim,),
        finding=f"{headline(claim)}.",
        headlines={"ridges": headline(claim)},
        captions={
            "ridges": (
                "(a) Response of the force to ridges. Line: (14.11); circles: boundary elements, "
                f"{case.cells[-1]} cells to a radius; squares: one-sided springs, {case.springs[-1]:g} to a radius. "
                f"(b) Errors over the envelope; dotted: an edge {EDGE:g} of a cell out of place."
            )
        },
        unconverged=result.unconverged,
    )


def _named(q: FloatArray) -> str:
    return f"q a = {q[0]:.2g} to {q[-1]:.3g}"


def _answer(result: RidgesResult) -> str:
    q, cells, springs = result.case.wavenumbers, result.case.cells[-1], result.case.springs[-1]
    return (
        f"for {_named(q)}, through the zeros and with the change of sign there, boundary elements with {cells} cells "
        f"to a radius are off (14.11) by at most {_largest(result, BEM, cells, FAR):.2g} of the envelope up to q a = "
        f"{FAR:g} and {_largest(result, BEM, cells):.2g} beyond, less than an edge {EDGE:g} of a cell out of place "
        f"explains, and {springs:g} springs by {_largest(result, SPRINGS, springs):.2g}."
    )


def headline(claim: JudgedClaim) -> str:
    exact_in = "Over ridges springs and boundary elements"
    return by_status(
        claim,
        holds=f"{exact_in} follow (14.11) through its zeros, within their grids",
        fails=f"{exact_in} do not both follow (14.11) within their grids",
        undecided=f"{exact_in}: whether both follow (14.11) is open",
    )


def exact(q: FloatArray) -> FloatArray:
    """sin(q a) / (q a), over 2 E* a."""
    return np.asarray(rolling_theory.response(q, contact_radius=1.0, modulus=1.0) / 2)


def _envelope(case: RollingOverRidges) -> FloatArray:
    return np.asarray(np.minimum(1.0, 1 / case.wavenumbers))


def _off(result: RidgesResult, method: str, cells: float) -> FloatArray:
    """|R - sin(q a) / (q a)| over its envelope."""
    case = result.case
    return np.abs(result.responses[method, cells, "approach"] - exact(case.wavenumbers)) / _envelope(case)


def _largest(result: RidgesResult, method: str, cells: float, far: float = math.inf) -> float:
    return float(_off(result, method, cells)[result.case.wavenumbers <= far].max())


def _bound(method: str, cells: float, q: FloatArray) -> tuple[FloatArray, str]:
    """How large the error over the envelope may be, and why."""
    if method == BEM:
        off = EDGE * np.maximum(1.0, q) / cells
        return off, f"an edge {EDGE:g} dx out of place: that error of the radius, and {EDGE:g} q dx of phase"
    if method == FILTER:
        return np.full(q.shape, 1e-7), "rounding of forces, divided by heights of 1e-5 of the approach"
    half = q / cells / 2
    return 1.01 * (half / np.sin(half) - 1) + 1e-6, "a sum over springs, not an integral: z / sin(z) - 1, z = q dx / 2"


def _error(result: RidgesResult, method: str, cells: float) -> Number:
    q = result.case.wavenumbers
    off, (bound, reason) = _off(result, method, cells), _bound(method, cells, q)
    worst = int(np.argmax(off / bound))
    return Number(
        quantity=ERROR,
        model=method,
        where={"to a radius": cells, "q a": float(q[worst])},
        value=float(off[worst]),
        reference=0.0,
        source="(14.11), which is exact for ridges in 1D and in 3D",
        tolerance=float(bound[worst]),
        reason=reason,
        # the filter is (14.11) itself
        role=Role.IDENTITY if method == FILTER else Role.CRITERION,
    )


def _order(result: RidgesResult) -> Number:
    coarsest, finest = result.case.cells[0], result.case.cells[-1]
    ratio = _largest(result, BEM, coarsest, FAR) / _largest(result, BEM, finest, FAR)
    return Number(
        quantity=ORDER,
        model=BEM,
        where={"q a": (float(result.case.wavenumbers[0]), FAR)},
        value=math.log(ratio) / math.log(finest / coarsest),
        reference=1.0,
        source="first order: the edge of the contact lies anywhere within a cell",
        tolerance=0.7,
        reason="the place of the edge within its cell changes irregularly from grid to grid",
        role=Role.FINDING,
    )


def _under_force(result: RidgesResult) -> Number:
    """A prescribed force turns the response of the force into one of the approach, through the stiffness alone."""
    case, cells = result.case, result.case.cells[0]
    force, approach = (result.responses[BEM, cells, given] for given in ("approach", "force"))
    stiffness = -float(np.sum((force * approach.conj()).real) / np.sum(np.abs(approach) ** 2))
    return Number(
        quantity=STIFFNESS,
        model=BEM,
        where={"to a radius": float(cells)},
        value=float((np.abs(stiffness * approach + force) / _envelope(case)).max()),
        reference=0.0,
        source="the definition of the stiffness: dF at a prescribed approach is -k dd at a prescribed force",
        tolerance=1e-3,
        reason="second-order terms, at heights of 1e-5 of the approach, and the residual are far smaller",
    )


def _curves(result: RidgesResult) -> Table:
    q, found = result.case.wavenumbers, {}
    for (method, cells, given), response in result.responses.items():
        if given == "approach" and method in (BEM, SPRINGS):
            found[f"{method}, {cells:g}, real"] = response.real
            found[f"{method}, {cells:g}, imaginary"] = response.imag
            found[f"{method}, {cells:g}, error"] = _off(result, method, cells)
    bounds = {f"bound, {n}": _bound(BEM, n, q)[0] for n in result.case.cells}
    return Table("responses", columns(**{"q a": q, "sin(qa)/(qa)": exact(q), **found, **bounds}))


def _table_of_errors(result: RidgesResult) -> Table:
    keys = [(method, cells) for method, cells, given in result.responses if given == "approach"]
    return Table(
        "errors",
        {
            "method": [method for method, _ in keys],
            "to a radius": [cells for _, cells in keys],
            f"largest error up to q a = {FAR:g}": [_largest(result, *key, FAR) for key in keys],
            "largest error": [_largest(result, *key) for key in keys],
        },
    )


CASE = Case(
    name="ridges",
    chapter=Chapter.ROLLING,
    place=1,
    claim=CLAIM,
    answers="Ridges across the track: rolling force where the 1D model is exact in 3D, (14.11)",
    quick=RollingOverRidges(),
    full=RollingOverRidges(cells=(8, 16, 32), springs=(8.5, 16.5, 32.5, 64.5)),
    run=run,
    evidence=evidence,
    needs="linear filter, 1D",
)
