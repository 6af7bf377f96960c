"""Ridges across the track, where one dimension is exact in three: errors of both methods over (14.11)."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.evidence import Role, Whose
from validation.analysis.number_text import share
from validation.analysis.series import Margin
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.engine.engine import FloatArray
from validation.simulation.model_names import BEM, FILTER_1D
from validation.simulation.rolling_strip import BEM as SOLVER
from validation.simulation.rolling_strip import FILTER, FULL, SPRINGS, RidgesTrack, SuperposedRidges, roll_over
from validation.theory.rolling import response

EDGE = 0.4
"""How far the edge of a contact on a grid is out of place at most, in cells, measured on circles of 8 to 32 cells."""
JUDGED = 16
"""Points to a contact radius from which a grid tests the claim; coarser ones show how errors fall."""
FAR = 5.0
"""q a up to which the response is also judged by itself."""


@dataclass(frozen=True, kw_only=True)
class RollingOverRidges:
    """A wheel, a = d = E* = 1, over many ridges at once, so low that only the first power of their height counts.

    length: of the track over a, the longest wave; shortest: q a of the last; cells: to a contact radius, of boundary
    elements, ascending; springs: to a contact radius, half-integers, so that the outermost springs end at the radius;
    height: rms, over d; tolerance: residual of the solver; seed: zero or positive.
    """

    length: int = 64
    shortest: float = 20.0
    cells: tuple[int, ...] = (8, 16)
    springs: tuple[float, ...] = (8.5, 16.5, 32.5)
    height: float = 1e-5
    tolerance: float = 1e-10
    seed: int = 143

    @property
    def ridges(self) -> SuperposedRidges:
        return SuperposedRidges(length=self.length, shortest=self.shortest, height=self.height, seed=self.seed)


def run(case: RollingOverRidges, engine: Engine = SERIAL) -> Outcomes:
    """Roll by every method on every grid; on the coarsest grid of boundary elements under a force too."""
    keys = [
        (BEM, float(case.cells[0]), "force"),
        *((BEM, float(n), "approach") for n in case.cells[::-1]),
        *((method, n, "approach") for method in (FILTER, FULL, SPRINGS) for n in case.springs[::-1]),
    ]
    tracks = [
        RidgesTrack(
            ridges=case.ridges,
            method=SOLVER if method == BEM else method,
            cells=n,
            prescribed=prescribed,
            tolerance=case.tolerance,
        )
        for method, n, prescribed in keys
    ]
    outcomes = engine.map(roll_over, tracks)
    unconverged = tuple(
        f"{method}, {n:g} cells to a radius: {int(o['failed'])} positions"
        for (method, n, _), o in zip(keys, outcomes, strict=True)
        if o["failed"]
    )
    responses = [o["response"][0] + 1j * o["response"][1] for o in outcomes]
    return Outcomes(case, dict(zip(keys, responses, strict=True)), unconverged)


RESPONSE = Quantity("response_of_the_force_times_q_a")
IMAGINARY = Quantity("imaginary_part_of_the_response_times_q_a")
ERROR = Quantity("error_over_the_envelope")
BOUND = Quantity("bound_of_the_error")
LARGEST = Quantity("largest_error_over_the_envelope")
NEAREST = Quantity(
    "error_of_the_force_over_the_envelope_nearest_to_its_bound",
    "error of the force over the envelope, nearest to its bound",
)
ORDER = Quantity("order_of_the_error")
STIFFNESS = Quantity("k_dd_+_dF_at_a_prescribed_force")
CELLS, Q, EXACT = "radius [points]", "q a", "sin(q a), (14.11)"
FIRST_ORDER = Margin(
    0.7,
    "the place of the edge within its cell changes irregularly from grid to grid",
    source="first order: the edge of the contact lies anywhere within a cell",
)
SECOND_ORDER = Margin(
    1e-3,
    "second-order terms, at heights of 1e-5 of the approach, and the residual are far smaller",
    source="the definition of the stiffness: dF at a prescribed approach is -k dd at a prescribed force",
    role=Role.CRITERION,
)


def series(result: Outcomes) -> list[Series]:
    """Errors over the envelope of |sin(q a) / (q a)|, which is defined at its zeros too; the finest grid first."""
    q = result.case.ridges.wavenumbers
    exact, envelope = response(q, contact_radius=1.0, modulus=1.0) / 2, np.minimum(1.0, 1 / q)
    along_q = partial(Series, along=Q, at=q)
    numbers = [along_q(RESPONSE, EXACT, exact * q)]
    largest: dict[tuple[str, float], float] = {}
    for method, n, prescribed in result.by_key:
        if prescribed == "force":
            continue
        of_method, where = result[method, n, prescribed], {CELLS: n}
        error, (bound, reason) = np.abs(of_method - exact) / envelope, bound_of(method, n, q)
        worst, largest[method, n] = int(np.argmax(error / bound)), float(error[q <= FAR].max())
        role = Role.IDENTITY if method == FILTER else Role.CRITERION  # the filter is (14.11) itself
        source = "(14.11), which is exact for ridges in 1D and in 3D"
        margin = Margin(float(bound[worst]), reason, source=source, role=role)
        numbers += [
            Series(NEAREST, method, error[[worst]], where={**where, Q: float(q[worst])}, margin=margin),
            Series(LARGEST, method, (largest[method, n], error.max()), where=where, along=Q, at=(FAR, q[-1])),
        ]
        if method in (BEM, SPRINGS):
            numbers += [
                along_q(ERROR, method, error, where=where),
                along_q(BOUND, method, bound, where=where),
                along_q(RESPONSE, method, of_method.real * q, where=where),
                along_q(IMAGINARY, method, of_method.imag * q, where=where),
            ]
    coarsest, finest = float(result.case.cells[0]), float(result.case.cells[-1])
    order = math.log(largest[BEM, coarsest] / largest[BEM, finest]) / math.log(finest / coarsest)
    force, approach = (result[BEM, coarsest, prescribed] for prescribed in ("approach", "force"))
    # a prescribed force turns the response of the force into one of the approach, through the stiffness alone
    stiffness = -float(np.sum((force * approach.conj()).real) / np.sum(np.abs(approach) ** 2))
    left = float((np.abs(stiffness * approach + force) / envelope).max())
    return [
        *numbers,
        Series(ORDER, BEM, (order,), where={Q: (float(q[0]), FAR)}, reference=1.0, margin=FIRST_ORDER),
        Series(STIFFNESS, BEM, (left,), where={CELLS: coarsest}, margin=SECOND_ORDER),
    ]


def bound_of(method: str, cells: float, q: FloatArray) -> tuple[FloatArray, str]:
    if method == BEM:
        off = EDGE * np.maximum(1.0, q) / cells
        return off, f"an edge {EDGE:g} dx out of place: that error of the radius, and {EDGE:g} q dx of phase"
    if method == FILTER:
        return np.full(q.shape, 1e-7), "rounding of forces, divided by heights of 1e-5 of the approach"
    half = q / cells / 2
    return 1.01 * (half / np.sin(half) - 1) + 1e-6, "a sum over springs, not an integral: z / sin(z) - 1, z = q dx / 2"


BY_CELLS, FINEST = ("model", CELLS), {CELLS: "first"}
STUDY = Study(
    title="Ridges across the track: springs, boundary elements and (14.11)",
    method=(
        "{c.ridges.wavenumbers.size} ridges at once, q a up to {c.shortest:g}, with a sum of heights of {c.height:g} "
        "d, so that each acts independently. The response of the force to the height of each ridge has an amplitude "
        "and a phase, over 2 E* a. Boundary elements have {c.cells} cells to a contact radius, springs {c.springs:g}. "
        "Errors are over the envelope of |sin(q a) / (q a)|, the smaller of 1 and 1/(q a), and so are defined at the "
        "zeros too."
    ),
    series=series,
    claims=(
        Claim(
            whose=Whose.BOOK,
            quantity=NEAREST,
            model=(BEM, FULL, SPRINGS),
            where={CELLS: lambda points: points >= JUDGED},
            printed=share,
        ).saying(
            "Over ridges across the track the one-dimensional model is exact in three dimensions, (14.11), but for "
            "what the grids leave.",
            short="Over ridges, springs and boundary elements agree with (14.11)",
            key="exact",
        ),
    ),
    charts=(
        Chart("ridges").of(
            "(a) Response of the force to ridges, finest grids. Line: (14.11); circles: boundary elements; open: "
            f"one-sided springs. (b) Errors over the envelope; dotted: an edge {EDGE:g} of a cell out of place.",
            Panel(Q, f"{RESPONSE}, over 2 E* a", title="amplitude and sign", log="", ylim=(-1.2, 1.6)).of(
                Curve(RESPONSE, EXACT),
                Curve(RESPONSE, BEM, "marks", of=FINEST, marker_spacing=0.03),
                Curve(RESPONSE, SPRINGS, "around", "springs", of=FINEST, marker_spacing=0.03),
            ),
            Panel(Q, ERROR, title="errors", log="xy", ylim=(1e-7, 1)).of(
                Curve(ERROR, BEM, "marks", by=BY_CELLS, marker_spacing=0.03),
                Curve(BOUND, BEM, "dotted", "_", by=BY_CELLS),
                Curve(ERROR, SPRINGS, "lines", by=BY_CELLS),
            ),
        ),
    ),
)
CASE = Case(
    name="ridges",
    chapter=Chapter.ROLLING,
    place=1,
    answers="Ridges across the track: rolling force where the 1D model is exact in 3D, (14.11)",
    quick=RollingOverRidges(),
    full=RollingOverRidges(cells=(8, 16, 32), springs=(8.5, 16.5, 32.5, 64.5)),
    run=run,
    study=STUDY,
    needs=FILTER_1D,
)
