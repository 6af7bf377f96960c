"""Ridges across the track: where one dimension is exact in three. Both methods against (14.11), through its zeros."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, columns, if_confirmed
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.theory import rolling as rolling_theory

FloatArray = NDArray[np.float64]

BEM, FILTER, FULL, SPRINGS = "bem3d", "(14.11)", "springs, full contact", "springs, one-sided"
EDGE = 0.4
"""So many cells the edge of a contact on a grid is out of place at most, measured on circles of 8 to 32 cells."""
FAR = 5.0
"""The q a up to which the response is looked at on its own."""


@dataclass(frozen=True, kw_only=True)
class Ridges:
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

    @cached_property
    def wavenumbers(self) -> FloatArray:
        """q a of all waves of the track, up to the shortest."""
        count = int(self.shortest * self.length / (2 * np.pi))
        return np.asarray(2 * np.pi / self.length * np.arange(1, count + 1))

    def ridges(self, points: int) -> FloatArray:
        """Heights at so many points of the track: amplitudes as 1/q, so that the force is as large by every wave."""
        q = self.wavenumbers
        x = self.length / points * np.arange(points)
        phase = 2 * np.pi * random_generator(self.seed).random(q.size)
        unit = np.cos(np.outer(x, q) + phase) @ (1 / q)
        return np.asarray(self.height * unit / math.sqrt(np.sum(0.5 / q**2)))

    def response(self, up: FloatArray, down: FloatArray, height: FloatArray) -> NDArray[np.complex128]:
        """From height to a force, wave by wave; what is even in the height drops out between up and down."""
        waves = slice(1, self.wavenumbers.size + 1)
        return np.asarray(np.fft.rfft((up - down) / 2)[waves] / np.fft.rfft(height)[waves])


@dataclass(frozen=True, kw_only=True)
class RidgesTrack:
    """One track, rolled by one method, at the prescribed approach or at the force that belongs to it."""

    case: Ridges
    method: str
    cells: float
    prescribed: str = "approach"


@dataclass(frozen=True)
class RidgesResult:
    """Responses over 2 E* a, by method, cells and what was prescribed."""

    case: Ridges
    responses: dict[tuple[str, float, str], NDArray[np.complex128]]
    unconverged: tuple[str, ...]


def roll_over(rolled: RidgesTrack) -> Outcome:
    """Response to each wave over 2 E* a, real and imaginary part, of the force, or of the approach under a force."""
    case = rolled.case
    points = round(case.length * rolled.cells)
    height = case.ridges(points)
    prescribed = {"approach": 1.0} if rolled.prescribed == "approach" else {"force": 4 / 3}
    found = [
        _rolled(rolled.method, sign * height, case.length / points, case.tolerance, prescribed) for sign in (1, -1)
    ]
    up, down = (getattr(one, "force" if rolled.prescribed == "approach" else "approach") for one in found)
    response = case.response(up, down, height) / 2
    failed = sum(np.count_nonzero(~one.converged) for one in found if isinstance(one, bem3d.Rolling))
    return {"response": np.stack([response.real, response.imag]), "failed": np.array(float(failed))}


def _rolled(
    method: str, height: FloatArray, spacing: float, tolerance: float, prescribed: dict[str, float]
) -> bem3d.Rolling | mdr.RollingTrack:
    d, force = prescribed.get("approach"), prescribed.get("force")
    if method == BEM:
        width = 2 * math.ceil(1.45 / spacing)
        strip = np.repeat(height[:, np.newaxis], width, axis=1)
        return bem3d.roll(
            strip,
            spacing=spacing,
            radius=1.0,
            modulus=1.0,
            approach=d,
            force=force,
            tolerance=tolerance,
            raise_on_failure=False,
        )
    contact = {FILTER: "linear", FULL: "full", SPRINGS: "one-sided"}[method]
    return mdr.roll(
        height,
        spacing=spacing,
        radius=1.0,
        modulus=1.0,
        approach=d,
        force=force,
        contact=contact,  # type: ignore[arg-type]
    )


def run(case: Ridges, engine: Engine = SERIAL) -> RidgesResult:
    """Roll by every method on every grid; on the coarsest grid of boundary elements under a force too."""
    tracks = [RidgesTrack(case=case, method=BEM, cells=n) for n in case.cells]
    tracks.append(RidgesTrack(case=case, method=BEM, cells=case.cells[0], prescribed="force"))
    tracks += [
        RidgesTrack(case=case, method=method, cells=n) for method in (FILTER, FULL, SPRINGS) for n in case.springs
    ]
    outcomes = engine.map(roll_over, tracks)
    responses = {
        (t.method, t.cells, t.prescribed): o["response"][0] + 1j * o["response"][1]
        for t, o in zip(tracks, outcomes, strict=True)
    }
    lost = tuple(
        f"{t.method}, {t.cells} cells to a radius: {int(o['failed'])} positions"
        for t, o in zip(tracks, outcomes, strict=True)
        if o["failed"]
    )
    return RidgesResult(case, responses, lost)


def evidence(result: RidgesResult) -> Evidence:
    """Largest errors of each method on each grid, over the envelope of the response; what a force changes."""
    case, q = result.case, result.case.wavenumbers
    numbers = [number for key in result.responses if key[2] == "approach" for number in _errors(result, *key[:2])]
    finest, coarsest = case.cells[-1], case.cells[0]
    order = math.log(_largest(result, BEM, coarsest, q <= FAR) / _largest(result, BEM, finest, q <= FAR)) / math.log(
        finest / coarsest
    )
    numbers += [
        Number(
            quantity=f"bem3d: order of the error, q a up to {FAR:g}",
            value=order,
            reference=1.0,
            source="the edge of the contact falls somewhere in a cell",
            tolerance=0.7,
            reason="where in the cell changes irregularly from grid to grid",
            role=Role.FINDING,
        ),
        _under_force(result),
    ]
    label = f"q a = {q[0]:.2g} to {q[-1]:.3g}"
    close = [n for n in numbers if n.role is Role.CRITERION]
    return Evidence(
        title="Ridges across the track: springs, boundary elements and (14.11)",
        method=(
            f"{q.size} ridges at once, {label}, {case.height:g} d high in all, so that each answers for itself; the "
            "response of the force to the height of each, amplitude and phase, over 2 E* a. Boundary elements with "
            f"{', '.join(map(str, case.cells))} cells to a contact radius, springs with "
            f"{', '.join(f'{n:g}' for n in case.springs)}. Errors are over the envelope of |sin(q a) / (q a)|, the "
            "smaller of 1 and 1/(q a), and so go through the zeros."
        ),
        numbers=tuple(numbers),
        tables=(_curves(result), _table_of_errors(result)),
        conclusions=(
            if_confirmed(
                f"Over ridges the force on the half-space is that of (14.11) for {label}, through the zeros and with "
                "the sign that changes there: what boundary elements lack is less than the place of the edge of "
                "their contact, some tenths of a cell, explains.",
                close,
            ),
            f"With {finest} cells to a radius boundary elements err by "
            f"{_largest(result, BEM, finest, q <= FAR):.2g} of the envelope up to q a = {FAR:g} and by "
            f"{_largest(result, BEM, finest, q > 0):.2g} up to {q[-1]:.3g}; springs in full contact, "
            f"{case.springs[-1]:g} to a radius, by {_largest(result, FULL, case.springs[-1], q > 0):.2g}; (14.11) "
            f"itself on the same track by {_largest(result, FILTER, case.springs[-1], q > 0):.1g}. The phase is right: "
            f"the part of the response out of phase is at most {_out_of_phase(result, finest):.1g} of the envelope.",
        ),
        captions={
            "ridges": (
                "(a) Response of the force to ridges, line: (14.11), exact in one dimension and in three; circles: "
                f"boundary elements with {finest} cells to a radius; squares: one-sided springs, "
                f"{case.springs[-1]:g} to a radius; every fourth wave. (b) Errors over the envelope; dotted: what "
                f"{EDGE:g} of a cell at the edge of the contact makes, on each grid of boundary elements."
            )
        },
        unconverged=result.unconverged,
    )


def exact(q: FloatArray) -> FloatArray:
    """sin(q a) / (q a), over 2 E* a."""
    return np.asarray(rolling_theory.response(q, contact_radius=1.0, modulus=1.0) / 2)


def _off(result: RidgesResult, method: str, cells: float) -> FloatArray:
    """|R - sin(q a) / (q a)| over its envelope."""
    q = result.case.wavenumbers
    return np.abs(result.responses[method, cells, "approach"] - exact(q)) / np.minimum(1.0, 1 / q)


def _largest(result: RidgesResult, method: str, cells: float, where: NDArray[np.bool_]) -> float:
    return float(_off(result, method, cells)[where].max())


def _out_of_phase(result: RidgesResult, cells: int) -> float:
    """The largest imaginary part of boundary elements over the envelope."""
    response = result.responses[BEM, cells, "approach"]
    return float(np.abs(response.imag / np.minimum(1.0, 1 / result.case.wavenumbers)).max())


def _bound(method: str, cells: float, q: FloatArray) -> tuple[FloatArray, str]:
    """How large the error over the envelope may be, and why."""
    if method == BEM:
        off = EDGE * np.maximum(1.0, q) / cells
        return off, f"the edge of the contact may lie {EDGE:g} dx off: so much of the radius, {EDGE:g} q dx of phase"
    if method == FILTER:
        return np.full(q.shape, 1e-7), "rounding of forces, over heights that are 1e-5 of the approach"
    half = q / cells / 2
    return 1.01 * (half / np.sin(half) - 1) + 1e-6, "a sum over springs for the integral: z / sin(z) - 1, z = q dx / 2"


def _errors(result: RidgesResult, method: str, cells: float) -> list[Number]:
    q = result.case.wavenumbers
    off = _off(result, method, cells)
    bound, reason = _bound(method, cells, q)
    worst = int(np.argmax(off / bound))
    return [
        Number(
            quantity=f"{method}, {cells:g} to a radius: error where it comes nearest to its bound, q "
            f"a = {q[worst]:.3g}",
            value=float(off[worst]),
            reference=0.0,
            source="(14.11), which is exact for ridges in 1D and in 3D",
            tolerance=float(bound[worst]),
            reason=reason,
        )
    ]


def _under_force(result: RidgesResult) -> Number:
    """A prescribed force turns the response of the force into one of the approach, through the stiffness alone."""
    case, q = result.case, result.case.wavenumbers
    force = result.responses[BEM, case.cells[0], "approach"]
    approach = result.responses[BEM, case.cells[0], "force"]
    stiffness = -float(np.sum((force * approach.conj()).real) / np.sum(np.abs(approach) ** 2))
    off = np.abs(stiffness * approach + force) / np.minimum(1.0, 1 / q)
    return Number(
        quantity=f"bem3d, {case.cells[0]} to a radius: k dd = -dF between a prescribed force and a prescribed approach",
        value=float(off.max()),
        reference=0.0,
        source="the definition of the stiffness, dF = k dd",
        tolerance=1e-3,
        reason="heights 1e-5 of the approach: second order and the residual are far below",
    )


def _curves(result: RidgesResult) -> Table:
    case, q = result.case, result.case.wavenumbers
    found = {}
    for (method, cells, prescribed), response in result.responses.items():
        if prescribed == "approach" and method in (BEM, SPRINGS):
            found[f"{method}, {cells:g}, real"] = response.real
            found[f"{method}, {cells:g}, imaginary"] = response.imag
            found[f"{method}, {cells:g}, error"] = _off(result, method, cells)
    bounds = {f"bound, {n}": _bound(BEM, n, q)[0] for n in case.cells}
    return Table("responses", columns(**{"q a": q, "sin(qa)/(qa)": exact(q), **found, **bounds}))


def _table_of_errors(result: RidgesResult) -> Table:
    q = result.case.wavenumbers
    keys = [key[:2] for key in result.responses if key[2] == "approach"]
    return Table(
        "errors",
        {
            "method": [method for method, _ in keys],
            "to a radius": [float(cells) for _, cells in keys],
            f"largest error up to q a = {FAR:g}": [_largest(result, m, n, q <= FAR) for m, n in keys],
            "largest error": [_largest(result, m, n, q > 0) for m, n in keys],
        },
    )


CASE = Case(
    name="ridges",
    chapter=Chapter.ROLLING,
    place=1,
    claim="Over ridges across the track one dimension is exact in three, (14.11).",
    answers="Ridges across the track: rolling force where one dimension is exact in three, (14.11)",
    quick=Ridges(),
    full=Ridges(cells=(8, 16, 32), springs=(8.5, 16.5, 32.5, 64.5)),
    run=run,
    evidence=evidence,
    needs="linear filter, 1D",
)
