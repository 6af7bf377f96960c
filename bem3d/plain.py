"""The textbook solver as it stands in the literature: the baseline of every speed chart."""

import math
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from bem3d.border import FloatArray, count, fraction
from bem3d.contact import Contact
from bem3d.halfspace import HalfSpace
from bem3d.polonsky_keer import polonsky_keer
from bem3d.press import Attempt
from bem3d.problem import Problem
from bem3d.solver import checked, contact_of, known_at_once


def solve_plain(
    half_space: HalfSpace,
    gap: ArrayLike,
    *,
    approach: float | None = None,
    force: float | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 2000,
    raise_on_failure: bool = True,
) -> Contact:
    """`solve` by the constrained conjugate gradient of Polonsky and Keer: two operator applications an iteration.

    Cold start on the whole grid, no preconditioner. Arguments and errors as those of `solve`, without `start`; no
    warnings; every entry of the
    history is from a fresh operator application. Its iterations grow with the grid, and at a prescribed force it can
    cycle on a spike over a plateau of equal heights.
    Source: Polonsky and Keer, Wear 231 (1999) 206.
    """
    problem = Problem(half_space=half_space, gap=cast(FloatArray, gap), approach=approach, force=force)
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    contact = known_at_once(problem, tolerance)
    if contact is None:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            attempt = _iterate(problem, tolerance, max_iterations)
        contact = contact_of(problem, tolerance, attempt)
    return checked(contact) if raise_on_failure else contact


def _iterate(problem: Problem, tolerance: float, max_iterations: int) -> Attempt:
    attempt = Attempt(np.empty(problem.half_space.shape), math.nan)
    iterates = polonsky_keer(problem)
    while attempt.status is None:
        iterate = next(iterates)
        attempt.judge(iterate.residual, tolerance, max_iterations)
    attempt.pressure, attempt.overlap = iterate.pressure, iterate.approach - problem.first_touch
    attempt.operator_applications = iterate.operator_applications
    return attempt
