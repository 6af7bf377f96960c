"""The constrained conjugate gradient of Polonsky and Keer, as published: the baseline of every speed chart.

Source: Polonsky and Keer, Wear 231 (1999) 206.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bem3d.checks import FloatArray, count, fraction
from bem3d.contact import Contact, residual
from bem3d.halfspace import HalfSpace
from bem3d.problem import Problem
from bem3d.solver import contact_of, raise_if_failed, trivial_solution
from bem3d.window_solve import IterationState

ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class Iterate:
    """Pressure [Pa], approach [m], residual from a fresh operator application, and all applications so far."""

    pressure: FloatArray
    approach: float
    residual: float
    operator_applications: int


def solve_polonsky_keer(
    half_space: HalfSpace,
    gap: ArrayLike,
    *,
    approach: float | None = None,
    force: float | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 2000,
    raise_on_failure: bool = True,
) -> Contact:
    """`solve` by the constrained conjugate gradient of Polonsky and Keer, as published.

    Parameters
    ----------
    half_space, gap, approach, force, tolerance, max_iterations, raise_on_failure
        As in `solve`.

    Returns
    -------
    Contact
        Every entry of its history is of a fresh operator application.

    Raises
    ------
    ValueError, TypeError
        If an argument is out of range.
    ConvergenceError
        If the tolerance is not reached.

    Notes
    -----
    Two operator applications an iteration, a cold start on the whole grid, no preconditioner, no warnings [1]_. The
    number of iterations grows with the grid. At a prescribed force the iteration can cycle on a spike over a plateau
    of equal heights. ``bem3d.solve_plain`` in 0.1.

    References
    ----------
    .. [1] Polonsky and Keer, Wear 231 (1999) 206.

    Examples
    --------
    >>> gap = 1e-8 * np.random.default_rng(1).standard_normal((32, 32))
    >>> body = bem3d.HalfSpace(shape=(32, 32), spacing=1e-5, modulus=1e9, periodic=True)
    >>> contact = bem3d.solve_polonsky_keer(body, gap, force=0.1)
    >>> bool(abs(contact.approach - bem3d.solve(body, gap, force=0.1).approach) < 1e-12)
    True
    """
    problem = Problem(half_space=half_space, gap=cast(FloatArray, gap), approach=approach, force=force)
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    contact = trivial_solution(problem, tolerance)
    if contact is None:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            attempt = _iterate(problem, tolerance, max_iterations)
        contact = contact_of(problem, tolerance, attempt)
    return raise_if_failed(contact) if raise_on_failure else contact


def _iterate(problem: Problem, tolerance: float, max_iterations: int) -> IterationState:
    attempt = IterationState(np.empty(problem.half_space.shape), math.nan)
    iterates = polonsky_keer(problem)
    while attempt.status is None:
        iterate = next(iterates)
        attempt.record_residual(iterate.residual, tolerance, max_iterations)
    attempt.pressure, attempt.overlap = iterate.pressure, iterate.approach - problem.first_touch
    attempt.operator_applications = iterate.operator_applications
    return attempt


def polonsky_keer(problem: Problem) -> Iterator[Iterate]:
    """Iterate towards p >= 0, w = gap + u - approach >= 0, p w = 0; the caller decides when to stop.

    Conjugate directions t on the current contact p > 0, exact line search, truncation at p = 0; cells that overlap
    without pressure join the contact, and the directions start anew. At prescribed force the approach is the mean of
    gap + u over the contact, and the pressure is scaled to its sum after each step.

    problem: a touching one. It begins with `first_pressure`.
    Source: Polonsky and Keer, Wear 231 (1999) 206.
    """
    half_space, force = problem.half_space, problem.force
    # heights count from the first touch: a gap far from zero would cost digits
    gap, depth = problem.gap - problem.first_touch, problem.depth
    pressure = first_pressure(problem)
    direction = np.zeros(half_space.shape)
    # infinite where there is nothing to be conjugate to
    square_before = math.inf
    applications = 0
    while True:
        separation = gap + half_space.apply(pressure)
        contact = pressure > 0
        s = mean_over(contact, separation) if depth is None else depth
        w = separation - s
        applications += 1
        yield Iterate(pressure, problem.first_touch + s, residual(pressure, w, s), applications)

        square = float((w[contact] ** 2).sum())
        direction = np.where(contact, w + square / square_before * direction, 0.0)
        yielding = half_space.apply(direction)
        applications += 1
        if force is not None:
            yielding -= mean_over(contact, yielding)
        along, curvature = float((w * direction).sum()), float((yielding * direction).sum())
        # no direction is left in a single cell, no curvature in a uniform pressure on a periodic half-space:
        # then a cell's own compliance sets the step
        stiff = half_space.self_compliance * float((direction**2).sum())
        step = along / curvature if curvature > ROUNDING * stiff else 1 / half_space.self_compliance
        pressure = np.maximum(pressure - step * direction, 0.0)
        overlapping = (pressure == 0) & (w < 0)
        pressure[overlapping] -= step * w[overlapping]
        if force is not None:
            pressure = _loaded(problem, pressure, force)
        square_before = math.inf if overlapping.any() or square == 0 else square


def mean_over(contact: NDArray[np.bool_], values: FloatArray) -> float:
    """Mean over the contact; NaN where there is none left, which ends the iteration."""
    return float(values[contact].mean()) if contact.any() else float("nan")


def first_pressure(problem: Problem) -> FloatArray:
    """A pressure to begin with: uniform at prescribed force, proportional to the geometric overlap otherwise."""
    if problem.force is not None:
        return _loaded(problem, np.ones(problem.half_space.shape), problem.force)
    overlap = np.maximum(cast(float, problem.approach) - problem.gap, 0.0)
    return np.asarray(overlap / (problem.half_space.self_compliance * np.sqrt(overlap.size)))


def _loaded(problem: Problem, pressure: FloatArray, force: float) -> FloatArray:
    """The pressure, scaled to a force."""
    return pressure * (force / (float(pressure.sum()) * problem.half_space.cell_area))
