"""The contact problem: approach or force in, Contact out."""

import math
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from bem3d.border import FloatArray, count, field, fraction
from bem3d.contact import Contact, Status
from bem3d.convergence import ConvergenceError
from bem3d.halfspace import HalfSpace
from bem3d.polonsky_keer import Iterate, polonsky_keer
from bem3d.problem import Problem


def solve(
    half_space: HalfSpace,
    gap: ArrayLike,
    *,
    approach: float | None = None,
    force: float | None = None,
    start: Contact | ArrayLike | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 2000,
    raise_on_failure: bool = True,
) -> Contact:
    """Press a rigid indenter on the half-space: p >= 0, w = gap + u - approach >= 0, p w = 0.

    half_space, gap [m], approach [m] or force [N]: the problem, see `Problem`;
    start: a previous contact, or a pressure, zero or positive, shape of the half-space [Pa];
    tolerance: the residual to reach, see `contact.residual`, in (0, 1); max_iterations: at least 1;
    raise_on_failure: False returns an unconverged Contact, whose status says so.

    An approach at or below min(gap), or zero force, is no contact: zero pressure, zero stiffness.
    Raises ValueError or TypeError for input out of range, ConvergenceError with the history if not converged.
    Method: Polonsky and Keer, two operator applications an iteration.
    """
    problem = Problem(half_space=half_space, gap=cast(FloatArray, gap), approach=approach, force=force)
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    pressure = _start(start, half_space)
    known = _known_at_once(problem)
    if known is not None:
        return _contact(problem, tolerance, known, [known.residual], Status.CONVERGED)
    history: list[float] = []
    # numbers that overflow end as a residual that is none, and that is a status
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for iterate in polonsky_keer(problem, pressure):
            history.append(iterate.residual)
            status = _status(history, tolerance, max_iterations)
            if status is not None:
                break
    result = _contact(problem, tolerance, iterate, history, status or Status.BREAKDOWN)
    if raise_on_failure and not result.converged:
        raise ConvergenceError(
            f"residual {result.residual:.3g} after {result.iterations} iterations ({result.status}), "
            f"asked for {tolerance:g}",
            result.history,
            result,
        )
    return result


def _known_at_once(problem: Problem) -> Iterate | None:
    """No contact; or a flat gap on a periodic half-space, whose uniform pressure leaves no overlap to scale by."""
    flat = problem.half_space.periodic and float(problem.gap.max()) == problem.first_touch
    if problem.touching and not flat:
        return None
    mean = (problem.force or 0.0) / (problem.gap.size * problem.half_space.cell_area)
    d = problem.first_touch if problem.approach is None else problem.approach
    return Iterate(np.full(problem.half_space.shape, mean), d, 0.0, 0)


def _status(history: list[float], tolerance: float, max_iterations: int) -> Status | None:
    """How the iteration has ended, None while it goes on."""
    if history[-1] <= tolerance:
        return Status.CONVERGED
    if math.isnan(history[-1]):
        return Status.BREAKDOWN
    return Status.ITERATION_LIMIT if len(history) > max_iterations else None


def _contact(problem: Problem, tolerance: float, last: Iterate, history: list[float], status: Status) -> Contact:
    last.pressure.flags.writeable = False
    return Contact(
        problem=problem,
        tolerance=tolerance,
        pressure=last.pressure,
        approach=last.approach,
        history=tuple(history),
        operator_applications=last.operator_applications,
        status=status,
    )


def _start(start: Contact | ArrayLike | None, half_space: HalfSpace) -> FloatArray | None:
    """A given pressure to begin with; None where there is no contact in it."""
    if start is None:
        return None
    pressure = field("start", start.pressure if isinstance(start, Contact) else start, half_space.shape)
    if (pressure < 0).any():
        raise ValueError(f"start must be zero or positive everywhere, got {pressure.min()}")
    return pressure.copy() if pressure.any() else None
