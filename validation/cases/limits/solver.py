"""Iterations on finer and finer grids, the residual against the true error, and input that has no answer."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.cases.limits.periodic_waves import distance
from validation.cases.limits.spheres import sphere
from validation.cases.limits.sweep import call_and_record_warnings
from validation.engine.engine import Outcome
from validation.simulation.rough_punch import PunchRoughness

Row = dict[str, object]

SCENES = ("sphere", "rough punch", "rough, periodic")
SOLVERS: dict[str, Callable[..., bem3d.Contact]] = {
    "solve": bem3d.solve,
    "solve_polonsky_keer": bem3d.solve_polonsky_keer,
}
MEASURES = ("load", "stiffness", "pressure")
TRUE = 1e-11
"""The residual of what stands for the truth."""


@dataclass(frozen=True, kw_only=True)
class Grid:
    """One scene on so many cells a side, solved by one solver to each residual."""

    scene: str
    solver: str
    cells: int
    tolerances: tuple[float, ...]
    seed: int
    true: bool = False


def setup_problem(scene: str, cells: int, seed: int) -> tuple[bem3d.HalfSpace, np.ndarray, dict[str, Any]]:
    """Half-space, gap, and the prescribed force or approach; the same surface on every grid."""
    if scene == "sphere":
        body = bem3d.HalfSpace(shape=(cells, cells), spacing=3 / cells, modulus=1.0)
        return body, sphere(cells, 3 / cells), {"approach": 1.0}
    roughness = PunchRoughness(hurst=0.7, waves=(1, 8), seed=seed)
    periodic = scene == "rough, periodic"
    body = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0, periodic=periodic)
    force = (1.5 if periodic else 0.3) * roughness.height
    return body, -roughness.surface(cells, 0), {"force": force}


def press_grid(grid: Grid) -> Outcome:
    """Iterations and applications to each residual; and, with grid.true, the errors that are left.

    load: of the force at an approach, of the approach at a force, over the overlap; stiffness; pressure in L2.
    """
    body, gap, load = setup_problem(grid.scene, grid.cells, grid.seed)
    true = bem3d.solve(body, gap, **load, tolerance=TRUE, raise_on_failure=False) if grid.true else None
    rows = []
    for tolerance in grid.tolerances:
        contact = SOLVERS[grid.solver](body, gap, **load, tolerance=tolerance, raise_on_failure=False)
        errors = _errors(contact, true) if true else (math.nan,) * 3
        work = contact.iterations, contact.operator_applications
        rows.append((*work, contact.residual, float(not contact.converged), *errors))
    names = ("iterations", "applications", "residual", "failed", *MEASURES)
    return dict(zip(names, np.array(rows, dtype=np.float64).T, strict=True))


def _errors(contact: bem3d.Contact, true: bem3d.Contact) -> tuple[float, float, float]:
    if not contact.converged:
        return math.nan, math.nan, math.nan
    overlap = true.approach - true.problem.first_touch
    load = (contact.approach - true.approach) / overlap + (contact.force / true.force - 1)
    stiffness = contact.stiffness(tolerance=1e-7) / true.stiffness(tolerance=1e-7) - 1
    return abs(load), abs(stiffness), distance(contact.pressure, true.pressure)


def without_an_answer() -> list[Row]:
    """Input for which there is no contact problem, or no figure: the call, and its answer or message."""
    body, gap = bem3d.HalfSpace(shape=(24, 24), spacing=1 / 8, modulus=1.0), sphere(24, 1 / 8)
    wave = bem3d.HalfSpace(shape=(24, 24), spacing=1 / 8, modulus=1.0, periodic=True)
    broken, endless = gap.copy(), gap.copy()
    broken[3, 4], endless[3, 4] = np.nan, np.inf
    heights = np.sin(np.arange(64.0))
    curve = mdr.load_curve(heights, length=1.0, modulus=1.0)
    calls: dict[str, Callable[[], Any]] = {
        "bem3d.solve, zero force": partial(bem3d.solve, body, gap, force=0.0),
        "bem3d.solve, infinite force": partial(bem3d.solve, body, gap, force=math.inf),
        "bem3d.solve, one NaN cell": partial(bem3d.solve, body, broken, approach=1.0),
        "bem3d.solve, one infinite cell": partial(bem3d.solve, body, endless, approach=1.0),
        "bem3d.solve, periodic, approach of the mean gap": partial(bem3d.solve, wave, gap, approach=float(gap.mean())),
        "bem3d.solve, periodic, full contact under a force": partial(bem3d.solve, wave, gap, force=1e3),
        "mdr.load_curve, one NaN height": partial(mdr.load_curve, np.append(heights, np.nan), length=1.0, modulus=1.0),
        "mdr at_force, zero": partial(curve.at_force, 0.0),
        "mdr at_force, infinite": partial(curve.at_force, math.inf),
    }
    return [{"call": name, "answer": _answer_of(call)} for name, call in calls.items()]


def _answer_of(call: Callable[[], Any]) -> str:
    answer, message = call_and_record_warnings(call)
    if answer is None:
        return message
    stiffness = answer.stiffness() if isinstance(answer, bem3d.Contact) else answer.stiffness
    return f"force {answer.force:g}, stiffness {stiffness:g}" + (f"; {message}" if message else "")
