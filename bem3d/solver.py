"""The contact problem: approach or force in, Contact out.

Method: nested iteration (`nested`), on the smallest window that holds the contact (`window_solve`), by projected and
preconditioned conjugate directions (`projected_cg`), one operator application an iteration. Large grids have a second
level of the preconditioner (`far_field`). The published iteration of Polonsky and Keer, the baseline, is
`solve_polonsky_keer`. A modulus of exactly 1 is taken as the unit of pressure: its pressures are not checked for their
units.
"""

from __future__ import annotations

from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from bem3d.checks import FloatArray, count, field, fraction
from bem3d.contact import Contact, Level, Status
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import warn
from bem3d.halfspace import HalfSpace
from bem3d.nested import initial_guess_from_coarse_grids
from bem3d.problem import Problem
from bem3d.window_solve import InitialGuess, IterationState, solve_on_window


def solve(
    half_space: HalfSpace,
    gap: ArrayLike,
    *,
    approach: float | None = None,
    force: float | None = None,
    start: Contact | ArrayLike | None = None,
    indenter_ends_at_edge: bool = False,
    tolerance: float = 1e-6,
    max_iterations: int = 500,
    raise_on_failure: bool = True,
) -> Contact:
    """Press a rigid indenter onto an elastic half-space: p >= 0, w = gap + u - approach >= 0, p w = 0.

    Parameters
    ----------
    half_space : HalfSpace
        Operator u = K p and its grid.
    gap : array_like, shape of the half-space
        Undeformed separation; a bump makes it smaller [m].
    approach, force : float, optional
        Either the rigid approach, of any sign [m], or the normal force, zero or positive [N]. In free space the
        approach counts from where the gap is zero, periodic from the mean plane of the deformed surface.
    start : Contact or array_like, shape of the half-space, optional
        A previous contact, or a pressure, to begin with [Pa].
    indenter_ends_at_edge : bool, optional
        Whether the indenter is a punch that ends where its grid does. It is not warned of, and changes no result.
    tolerance, max_iterations
        `residual` to reach, in (0, 1), and limit of iterations on each grid, at least 1.
    raise_on_failure : bool, optional
        Whether to raise, or to return a contact whose ``status`` says that it is no solution.

    Returns
    -------
    Contact
        Pressure, approach, and how the solve went.

    Raises
    ------
    ValueError, TypeError, ConvergenceError
        If an argument is out of range, a periodic approach not below mean(gap), or the tolerance not reached.

    Warns
    -----
    ResolutionWarning, EdgeWarning, UnitsWarning
        If few cells touch, the edge of a free grid is reached, or pressures or slopes tell of units that do not fit.

    Examples
    --------
    >>> x = (np.arange(65) - 32) * 5e-5
    >>> body = bem3d.HalfSpace(shape=(65, 65), spacing=5e-5, modulus=1e11)
    >>> contact = bem3d.solve(body, (x[:, None] ** 2 + x**2) / (2 * 0.1), approach=5e-6)
    >>> print(f"{contact.force:.1f} N, by Hertz {4 / 3 * 1e11 * np.sqrt(0.1) * 5e-6**1.5:.1f} N")
    471.5 N, by Hertz 471.4 N
    """
    problem = _stated(half_space, gap, approach, force, indenter_ends_at_edge)
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    contact = solve_checked(problem, _start(start, problem), tolerance, max_iterations)
    warn(contact.diagnose())
    return raise_if_failed(contact) if raise_on_failure else contact


def _stated(half_space: HalfSpace, gap: ArrayLike, approach: float | None, force: float | None, ends: bool) -> Problem:
    """The problem, checked."""
    heights = cast(FloatArray, gap)
    return Problem(half_space=half_space, gap=heights, approach=approach, force=force, indenter_ends_at_edge=ends)


def solve_checked(problem: Problem, start: InitialGuess | None, tolerance: float, max_iterations: int) -> Contact:
    """`solve` for a problem and numbers that are known to be in order: a contact, converged or not."""
    contact = trivial_solution(problem, tolerance)
    if contact is not None:
        return contact
    # numbers that overflow end as a residual that is none, and that is a status
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        begin, levels = (start, ()) if start else initial_guess_from_coarse_grids(problem, max_iterations)
        attempt = solve_on_window(problem, begin, tolerance, max_iterations)
    return contact_of(problem, tolerance, attempt, levels)


def trivial_solution(problem: Problem, tolerance: float) -> Contact | None:
    """What needs no iteration: no contact, or a uniform pressure; None otherwise."""
    if problem.touching and not problem.uniform:
        return None
    mean = (problem.total or 0.0) / problem.gap.size
    d = problem.first_touch if problem.approach is None else problem.approach
    return Contact(
        problem=problem,
        tolerance=tolerance,
        pressure=np.full(problem.half_space.shape, mean),
        approach=d,
        history=(0.0,),
        operator_applications=0,
        status=Status.CONVERGED,
    )


def raise_if_failed(contact: Contact) -> Contact:
    """The contact, if it is a solution; ConvergenceError otherwise."""
    if contact.converged:
        return contact
    problem, count = contact.problem, contact.iterations
    load = f"force {problem.force:g} N" if problem.approach is None else f"approach {problem.approach:g} m"
    raise ConvergenceError(
        f"residual {contact.residual:.3g} after {count} iteration{'s' * (count != 1)} ({contact.status}), "
        f"asked for {contact.tolerance:g}, at {load} on {' x '.join(map(str, problem.half_space.shape))} cells",
        contact.history,
        contact,
    )


def contact_of(problem: Problem, tolerance: float, attempt: IterationState, levels: tuple[Level, ...] = ()) -> Contact:
    """The contact at the end of an iteration."""
    return Contact(
        problem=problem,
        tolerance=tolerance,
        pressure=attempt.pressure,
        approach=problem.first_touch + attempt.overlap if problem.approach is None else problem.approach,
        history=tuple(attempt.history),
        operator_applications=attempt.operator_applications,
        status=attempt.status or Status.BREAKDOWN,
        coarse_applications=levels,
    )


def _start(start: Contact | ArrayLike | None, problem: Problem) -> InitialGuess | None:
    """A given pressure to begin with; None where there is no contact in it."""
    if start is None:
        return None
    pressure = field("start", start.pressure if isinstance(start, Contact) else start, problem.half_space.shape)
    if (pressure < 0).any():
        raise ValueError(f"start must be zero or positive everywhere, got {pressure.min()}")
    if not pressure.any():
        return None
    overlap = start.approach - problem.first_touch if isinstance(start, Contact) else 0.0
    return InitialGuess(pressure.copy(), overlap if overlap > 0 else None)
