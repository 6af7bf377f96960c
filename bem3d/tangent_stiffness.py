"""The frozen contact: a known set of cells pressed as a flat punch. A linear problem, solved by conjugate gradients."""

from dataclasses import dataclass

import numpy as np

from bem3d.checks import BoolArray, FloatArray, count, field, fraction
from bem3d.convergence import ConvergenceError
from bem3d.halfspace import HalfSpace
from bem3d.read_only import ReadOnly
from bem3d.window import Candidates, dot, smallest_box


@dataclass(frozen=True, eq=False, kw_only=True)
class FixedContactArea(ReadOnly):
    """Pressure under a unit approach of a fixed contact set [Pa/m], its stiffness [N/m] and how it was reached.

    history: relative residual |1 - K p| / |1| over the contact, before and after each iteration.
    """

    pressure: FloatArray
    stiffness: float
    history: tuple[float, ...]
    operator_applications: int
    converged: bool

    @property
    def residual(self) -> float:
        """The last entry of the history."""
        return self.history[-1]

    @property
    def iterations(self) -> int:
        """Iterations taken."""
        return len(self.history) - 1


def solve_fixed_area(
    half_space: HalfSpace,
    contact: BoolArray,
    *,
    start: FloatArray | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 500,
    raise_on_failure: bool = True,
) -> FixedContactArea:
    """Press a fixed set of cells by a unit approach: K p = 1 on the contact, p = 0 elsewhere; k = dF/dd.

    For the discrete frictionless problem this is the incremental stiffness exactly, as long as no cell is about to
    enter or leave the contact. k = (2 sum(p) - sum(p K p)) dx dy, the energy that p gains, whose relative error is ten
    to some tens of times the residual squared (measured), growing slowly with the grid.

    contact: boolean, shape of the half-space; start: a pressure to begin with, same shape, of which the contact's part
    is used [Pa/m]; tolerance: relative residual; max_iterations: of preconditioned conjugate gradients, one operator
    application each, on the smallest window that holds the contact;
    raise_on_failure: False returns an unconverged result, which says so.
    Empty contact: zero stiffness. Full contact of a periodic half-space: infinite stiffness, since its mean plane
    cannot yield.
    Raises ValueError for a contact of another shape or type, ConvergenceError with the history if not converged.
    """
    contact = np.asarray(contact)
    if contact.dtype != np.bool_ or contact.shape != half_space.shape:
        raise ValueError(
            f"contact must be a boolean array of shape {half_space.shape}, got {contact.dtype} {contact.shape}"
        )
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    if start is not None:
        start = field("start", start, half_space.shape)
    if not contact.any() or (half_space.periodic and contact.all()):
        return FixedContactArea(
            pressure=np.zeros(half_space.shape),
            stiffness=np.inf if contact.any() else 0.0,
            history=(0.0,),
            operator_applications=0,
            converged=True,
        )
    result = _conjugate_gradients(half_space, contact, start, tolerance, max_iterations)
    if raise_on_failure and not result.converged:
        raise ConvergenceError(
            f"frozen-contact residual {result.residual:.3g} after {result.iterations} iterations, "
            f"asked for {tolerance:g}",
            result.history,
            result,
        )
    return result


def _conjugate_gradients(
    half_space: HalfSpace, contact: BoolArray, start: FloatArray | None, tolerance: float, max_iterations: int
) -> FixedContactArea:
    """Preconditioned by the approximate inverse, on vectors over the cells of the contact."""
    box = smallest_box(half_space, contact)
    inside = contact[box]
    cells = Candidates(half_space.like(shape=(inside.shape[0], inside.shape[1])), inside)
    remainder = np.ones(np.count_nonzero(inside))
    pressure = np.zeros(remainder.size) if start is None else cells.compress(start[box])
    applications = 0
    if pressure.any():
        remainder -= cells.displacement(pressure)
        applications = 1
    direction, along_before = np.zeros(remainder.size), 1.0
    history = [_length(remainder)]
    while history[-1] > tolerance and len(history) <= max_iterations:
        preconditioned = cells.inverse(remainder)
        along = dot(remainder, preconditioned)
        direction = preconditioned + along / along_before * direction
        yielding = cells.displacement(direction)
        step = along / dot(direction, yielding)
        pressure = pressure + step * direction
        remainder = remainder - step * yielding
        along_before = along
        history.append(_length(remainder))
    whole = np.zeros(half_space.shape)
    whole[box] = cells.spread(pressure)
    return FixedContactArea(
        pressure=whole,
        stiffness=float(pressure.sum() + dot(pressure, remainder)) * half_space.cell_area,
        history=tuple(history),
        operator_applications=applications + len(history) - 1,
        converged=history[-1] <= tolerance,
    )


def _length(remainder: FloatArray) -> float:
    """|1 - K p| / |1|."""
    return float(np.sqrt(np.mean(remainder**2)))
