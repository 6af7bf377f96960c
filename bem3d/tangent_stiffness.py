"""Incremental stiffness: a known set of cells pressed as a flat punch, a linear problem, by conjugate gradients."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bem3d.checks import BoolArray, FloatArray, count, field, fraction
from bem3d.convergence import ConvergenceError
from bem3d.halfspace import HalfSpace
from bem3d.results import ReadOnly, span
from bem3d.window import Candidates, dot, smallest_box


@dataclass(frozen=True, eq=False, kw_only=True)
class FixedContactArea(ReadOnly):
    """Fixed contact area under a unit approach. Made by `solve_fixed_area`; ``bem3d.FrozenContact`` in 0.1.

    Attributes
    ----------
    pressure : ndarray, shape of the half-space
        Pressure under a unit approach [Pa/m].
    stiffness : float
        k = dF/dd [N/m].
    history : tuple of float
        Relative residual of the linear solve, before and after each iteration.
    operator_applications : int
        Applications of u = K p.
    converged : bool
        Whether the tolerance is reached.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(8, 8), spacing=1e-4, modulus=1e11)
    >>> area = bem3d.solve_fixed_area(body, np.zeros((8, 8), dtype=bool))
    >>> area.stiffness, area.iterations
    (0.0, 0)
    """

    pressure: FloatArray
    stiffness: float
    history: tuple[float, ...]
    operator_applications: int
    converged: bool

    def __repr__(self) -> str:
        ended = "converged" if self.converged else "not converged"
        return f"FixedContactArea(stiffness={span(self.stiffness, 'N/m')}, {ended}, iterations={self.iterations})"

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
    """Press a fixed set of cells by a unit approach: K p = 1 on the contact, p = 0 elsewhere.

    Parameters
    ----------
    half_space : HalfSpace
        Operator u = K p and its grid.
    contact : ndarray of bool, shape of the half-space
        The cells in contact.
    start : ndarray, shape of the half-space, optional
        Pressure to begin with [Pa/m]; only its values on the contact count.
    tolerance, max_iterations, raise_on_failure
        As in `solve`; the residual is the relative one of the linear solve by preconditioned conjugate gradients.

    Returns
    -------
    FixedContactArea
        The incremental stiffness, exact for the discrete problem while no cell enters or leaves the contact. Zero for
        an empty contact, infinite for the full contact of a periodic half-space.

    Raises
    ------
    ValueError, ConvergenceError
        If the contact has another shape or type, or the tolerance is not reached.

    Notes
    -----
    k = (2 sum(p) - sum(p K p)) dx dy, the energy that p gains. Its relative error is ten to some tens of times the
    squared residual, and grows slowly with the grid. ``bem3d.press_frozen`` in 0.1.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(32, 32), spacing=1e-3 / 32, modulus=1e11)
    >>> k = bem3d.solve_fixed_area(body, np.ones(body.shape, dtype=bool)).stiffness
    >>> print(f"{k / (1e11 * 1e-3):.3f} E* L for a square punch")
    1.140 E* L for a square punch
    """
    contact = _checked(contact, half_space)
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    if start is not None:
        start = field("start", start, half_space.shape)
    if not contact.any() or (half_space.periodic and contact.all()):
        return _at_once(half_space, np.inf if contact.any() else 0.0)
    result = _conjugate_gradients(half_space, contact, start, tolerance, max_iterations)
    if raise_on_failure and not result.converged:
        raise ConvergenceError(
            f"frozen-contact residual {result.residual:.3g} after {result.iterations} iterations, "
            f"asked for {tolerance:g}",
            result.history,
            result,
        )
    return result


def _checked(contact: BoolArray, half_space: HalfSpace) -> BoolArray:
    contact = np.asarray(contact)
    if contact.dtype != np.bool_ or contact.shape != half_space.shape:
        raise ValueError(
            f"contact must be a boolean array of shape {half_space.shape}, got {contact.dtype} {contact.shape}"
        )
    return contact


def _at_once(half_space: HalfSpace, stiffness: float) -> FixedContactArea:
    """What needs no iteration: no contact, or the full contact of a periodic half-space."""
    return FixedContactArea(
        pressure=np.zeros(half_space.shape),
        stiffness=stiffness,
        history=(0.0,),
        operator_applications=0,
        converged=True,
    )


def _conjugate_gradients(
    half_space: HalfSpace, contact: BoolArray, start: FloatArray | None, tolerance: float, max_iterations: int
) -> FixedContactArea:
    """Preconditioned by the approximate inverse, on vectors over the cells of the contact."""
    box = smallest_box(half_space, contact)
    inside = contact[box]
    cells = Candidates(half_space.like(shape=(inside.shape[0], inside.shape[1])), inside)
    remainder, everywhere = np.ones(np.count_nonzero(inside)), np.ones(np.count_nonzero(inside), dtype=np.bool_)
    pressure = np.zeros(remainder.size) if start is None else cells.compress(start[box])
    applications = 0
    if pressure.any():
        remainder -= cells.displacement(pressure)
        applications = 1
    # the first takes the place of M r, then of a change of the pressure or of r
    change, direction, yielding = np.empty(remainder.size), np.zeros(remainder.size), np.empty(remainder.size)
    along_before = 1.0
    history = [_length(remainder)]
    while history[-1] > tolerance and len(history) <= max_iterations:
        cells.inverse(remainder, everywhere, out=change)
        along = dot(remainder, change)
        direction *= along / along_before
        direction += change
        cells.displacement(direction, out=yielding)
        step = along / dot(direction, yielding)
        pressure += np.multiply(direction, step, out=change)
        remainder -= np.multiply(yielding, step, out=change)
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
    return math.sqrt(dot(remainder, remainder) / remainder.size)
