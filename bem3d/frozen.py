"""The frozen contact: a known set of cells pressed as a flat punch. A linear problem, solved by conjugate gradients."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bem3d.border import FloatArray, count, fraction
from bem3d.convergence import ConvergenceError
from bem3d.halfspace import HalfSpace


@dataclass(frozen=True, eq=False, kw_only=True)
class FrozenContact:
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


def press_frozen(
    half_space: HalfSpace,
    contact: NDArray[np.bool_],
    *,
    tolerance: float = 1e-8,
    max_iterations: int = 2000,
    raise_on_failure: bool = True,
) -> FrozenContact:
    """Press a fixed set of cells by a unit approach: K p = 1 on the contact, p = 0 elsewhere; k = sum(p) dx dy.

    For the discrete frictionless problem this is the incremental stiffness dF/dd exactly, as long as no cell is
    about to enter or leave the contact.

    contact: boolean, shape of the half-space; tolerance: relative residual; max_iterations: of conjugate gradients;
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
    pressure = np.zeros(half_space.shape)
    if not contact.any() or (half_space.periodic and contact.all()):
        stiffness = np.inf if contact.any() else 0.0
        return FrozenContact(
            pressure=pressure, stiffness=stiffness, history=(0.0,), operator_applications=0, converged=True
        )
    remainder = np.where(contact, 1.0, 0.0)
    direction = remainder.copy()
    square = start = float((remainder**2).sum())
    history = [1.0]
    while history[-1] > tolerance and len(history) <= max_iterations:
        yielding = np.where(contact, half_space.apply(direction), 0.0)
        step = square / float((direction * yielding).sum())
        pressure += step * direction
        remainder -= step * yielding
        before, square = square, float((remainder**2).sum())
        direction = remainder + square / before * direction
        history.append(float(np.sqrt(square / start)))
    result = FrozenContact(
        pressure=pressure,
        stiffness=float(pressure.sum()) * half_space.cell_area,
        history=tuple(history),
        operator_applications=len(history) - 1,
        converged=history[-1] <= tolerance,
    )
    if raise_on_failure and not result.converged:
        raise ConvergenceError(
            f"frozen-contact residual {result.residual:.3g} after {result.iterations} iterations, "
            f"asked for {tolerance:g}",
            result.history,
            result,
        )
    return result
