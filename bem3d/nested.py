"""Nested iteration: the same contact on half as many cells a side, to begin with."""

import numpy as np

from bem3d.checks import FloatArray
from bem3d.contact import Level
from bem3d.halfspace import HalfSpace
from bem3d.problem import Problem
from bem3d.window_solve import InitialGuess, solve_on_window

FEWEST_CELLS = 64
"""An axis of fewer cells is not coarsened: an iteration on 16 cells a side costs nearly as much time as one on 32."""
COARSE_TOLERANCE = 0.1
"""A coarser grid is solved to so much of the error that its own start had, which the finer one will have again. At 0.03
and at 0.3 there are as many operator applications, weighted by their cells, or a few per cent more; at 0.03, too, more
of them on coarse grids, where an iteration costs more than its applications. Measured on 64 to 256 cells a side."""


def initial_guess_from_coarse_grids(problem: Problem, max_iterations: int) -> tuple[InitialGuess, tuple[Level, ...]]:
    """A pressure for a touching problem, from the solution on coarser grids, and the applications it took there."""
    coarse = _coarser_problem(problem)
    if coarse is None or coarse.uniform or not coarse.touching:
        return first_pressure(problem), ()
    start, levels = initial_guess_from_coarse_grids(coarse, max_iterations)
    attempt = solve_on_window(coarse, start, COARSE_TOLERANCE * min(start.error, 1.0), max_iterations)
    levels = (*levels, (coarse.half_space.shape, attempt.operator_applications))
    problem.half_space.release(coarse.half_space)
    pressure = prolong(attempt.pressure, problem.half_space)
    overlap = attempt.overlap + coarse.first_touch - problem.first_touch
    if not np.isfinite(overlap) or not np.isfinite(pressure).all() or not pressure.any():
        return first_pressure(problem), levels
    return InitialGuess(pressure, overlap, attempt.history[0]), levels


def _coarser_problem(problem: Problem) -> Problem | None:
    half_space = coarser(problem.half_space)
    if half_space is None:
        return None
    gap = restrict(problem.gap)
    if half_space.periodic:
        # an odd axis counts its last cell twice, but a periodic approach is measured from the mean
        gap += problem.gap.mean() - gap.mean()
        if problem.approach is not None and problem.approach >= gap.mean():
            return None
    return Problem(half_space=half_space, gap=gap, approach=problem.approach, force=problem.force)


def first_pressure(problem: Problem) -> InitialGuess:
    """Uniform at a prescribed force; else proportional to the overlap, as large as lowers the energy most."""
    if problem.depth is None:
        return InitialGuess(np.ones(problem.half_space.shape))
    # in units of the deepest, whose square may not be a number that there is
    overlap = np.maximum(1 - (problem.gap - problem.first_touch) / problem.depth, 0.0)
    yielding = problem.half_space.apply(overlap)
    size = problem.depth * float((overlap**2).sum()) / float((overlap * yielding).sum())
    return InitialGuess(size * overlap, problem.depth)


def coarser(half_space: HalfSpace) -> HalfSpace | None:
    """The half-space with cells twice as long along every axis that can spare them; None if none can."""
    factors = _factors(half_space.shape)
    if factors == (1, 1):
        return None
    shape = tuple(-(-points // factor) for points, factor in zip(half_space.shape, factors, strict=True))
    if half_space.periodic:
        steps = tuple(n * dx / m for n, dx, m in zip(half_space.shape, half_space.steps, shape, strict=True))
    else:
        steps = tuple(dx * factor for dx, factor in zip(half_space.steps, factors, strict=True))
    return half_space.like(shape=(shape[0], shape[1]), spacing=(steps[0], steps[1]))


def restrict(values: FloatArray) -> FloatArray:
    """Means over the cells of the coarser grid."""
    for axis, factor in enumerate(_factors(values.shape)):
        if factor == 2:
            even = np.concatenate([values, values.take([-1], axis)], axis) if values.shape[axis] % 2 else values
            first, second = [slice(None)] * 2, [slice(None)] * 2
            first[axis], second[axis] = slice(0, None, 2), slice(1, None, 2)
            values = (even[tuple(first)] + even[tuple(second)]) / 2
    return values


def prolong(pressure: FloatArray, half_space: HalfSpace) -> FloatArray:
    """A pressure of the coarser grid, interpolated linearly to the cells of the half-space."""
    for axis, factor in enumerate(_factors(half_space.shape)):
        if factor == 2:
            ends = np.roll if half_space.periodic else _shifted
            before, after = ends(pressure, 1, axis), ends(pressure, -1, axis)
            pair = np.stack([0.75 * pressure + 0.25 * before, 0.75 * pressure + 0.25 * after], axis=axis + 1)
            shape = list(pressure.shape)
            shape[axis] *= 2
            pressure = pair.reshape(shape).take(range(half_space.shape[axis]), axis)
    return pressure


def _factors(shape: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(2 if points >= FEWEST_CELLS else 1 for points in shape)


def _shifted(values: FloatArray, by: int, axis: int) -> FloatArray:
    """`np.roll` that lets nothing in from the other end."""
    moved = np.roll(values, by, axis)
    edge: list[slice | int] = [slice(None)] * values.ndim
    edge[axis] = 0 if by > 0 else -1
    moved[tuple(edge)] = 0.0
    return moved
