"""One contact problem on one grid: window and candidate cells around the iteration, fresh residuals at its end."""

import math
from dataclasses import dataclass, field

import numpy as np

from bem3d.checks import BoolArray, FloatArray
from bem3d.contact import Status, residual
from bem3d.problem import Problem
from bem3d.projected_cg import Load, projected_cg
from bem3d.window import Candidates, smallest_box

WINDOW_MARGIN = 1.1
"""Under a prescribed force, a window is laid around the cells that overlap at so many times the expected overlap."""
CANDIDATE_MARGIN = 1.0
"""Cells no further from touching than so many times the error that the contact still has are candidates for it."""
PATIENCE = 100
"""Iterations in which the running residual has to halve; a fresh application then measures it."""


@dataclass(frozen=True, eq=False)
class InitialGuess:
    """A pressure to begin with, shape of the half-space, and the overlap that comes with it, if known.

    error: the residual that a start of this kind had on the next coarser grid.
    """

    pressure: FloatArray
    overlap: float | None = None
    error: float = 1.0


@dataclass(eq=False)
class IterationState:
    """A pressure on the whole grid, the overlap it has, and what has led there."""

    pressure: FloatArray
    overlap: float
    history: list[float] = field(default_factory=list)
    operator_applications: int = 0
    status: Status | None = None

    def record_residual(self, residual: float, tolerance: float, max_iterations: int) -> None:
        """Append the residual of a new pressure to the history, and set the status if it ends the iteration."""
        self.history.append(residual)
        if residual <= tolerance:
            self.status = Status.CONVERGED
        elif math.isnan(residual):
            self.status = Status.BREAKDOWN
        elif len(self.history) > max_iterations:
            self.status = Status.ITERATION_LIMIT


def solve_on_window(problem: Problem, start: InitialGuess, tolerance: float, max_iterations: int) -> IterationState:
    """Solve on the smallest window that can hold the contact, and on a larger one where that proves too small.

    In free space a cell can only touch where the undeformed bodies overlap, since u >= 0 for p >= 0.
    """
    gap, s = problem.gap - problem.first_touch, problem.depth
    attempt = IterationState(start.pressure, s or start.overlap or math.inf)
    reach = attempt.overlap if s is not None else WINDOW_MARGIN * attempt.overlap
    while True:
        attempt.status = None
        _press_window(problem, gap, gap < reach, attempt, tolerance, max_iterations)
        if problem.half_space.periodic or not attempt.overlap > reach:
            return attempt
        reach = WINDOW_MARGIN * attempt.overlap


def _press_window(
    problem: Problem, gap: FloatArray, within: BoolArray, attempt: IterationState, tolerance: float, max_iterations: int
) -> None:
    """Iterate on candidate cells until a fresh application confirms the residual on all cells of the window."""
    box = smallest_box(problem.half_space, within | (attempt.pressure > 0))
    near, load = gap[box], Load(problem.depth, problem.total)
    window = problem.half_space.like(shape=(near.shape[0], near.shape[1]))
    pressure = attempt.pressure[box]
    marked, confirmed = np.zeros(window.shape, dtype=np.bool_), math.inf
    while True:
        # the force is held to the last digit, which many small steps would lose
        pressure = load.scaled(pressure)
        separation = window.apply(pressure)
        separation += near
        attempt.operator_applications += 1
        attempt.overlap = load.overlap_of(pressure, separation)
        w = separation - attempt.overlap
        # a fresh residual takes the place of the running one of the same pressure
        attempt.history = attempt.history[:-1]
        attempt.record_residual(residual(pressure, w, attempt.overlap), tolerance, max_iterations)
        known, marked = marked, marked | contact_candidates(pressure, w)
        gained, confirmed = attempt.history[-1] < confirmed / 2, attempt.history[-1]
        if attempt.status is None and not gained and (marked == known).all():
            attempt.status = Status.STAGNATION
        if attempt.status is not None:
            break
        cells = Candidates(window, marked)
        start = cells.compress(pressure), cells.compress(separation)
        # fields of a large grid, which the iteration does not need
        del pressure, separation, w
        pressure = cells.spread(_iterate(cells, *start, load, attempt, tolerance, max_iterations))
    attempt.pressure = np.zeros(problem.half_space.shape)
    attempt.pressure[box] = pressure


def _iterate(
    cells: Candidates,
    pressure: FloatArray,
    separation: FloatArray,
    load: Load,
    attempt: IterationState,
    tolerance: float,
    max_iterations: int,
) -> FloatArray:
    """The pressure at which the running residual on the candidate cells is small enough, or nothing more is gained."""
    states = projected_cg(cells, pressure, separation, load)
    state = next(states)
    best, since = state.residual, 0
    for state in states:
        attempt.operator_applications += 1
        attempt.record_residual(state.residual, 0.0, max_iterations)
        best, since = (state.residual, 0) if state.residual < best / 2 else (best, since + 1)
        if state.residual <= tolerance or attempt.status is not None or since > PATIENCE:
            break
    # only a fresh application decides how it has ended
    attempt.status = None
    return state.pressure


def contact_candidates(pressure: FloatArray, w: FloatArray) -> BoolArray:
    """Cells in contact, and those that are no further from it than the error that the start still has."""
    touching = (pressure > 0) | (w < 0)
    error = float(np.abs(w[touching]).max(initial=0.0))
    return np.asarray(touching | (w < CANDIDATE_MARGIN * error))
