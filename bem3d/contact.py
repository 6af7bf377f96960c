"""The answer to a contact problem, with the problem it answers, and its residual."""

import math
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from bem3d.checks import FloatArray
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import Diagnostic, diagnose_pressure, diagnose_units
from bem3d.problem import Problem
from bem3d.read_only import ReadOnly
from bem3d.tangent_stiffness import FixedContactArea, solve_fixed_area

Level = tuple[tuple[int, int], int]
"""Shape of a coarser grid, and the operator applications on it."""


class Status(StrEnum):
    """How a solve ended. Only CONVERGED is a solution."""

    CONVERGED = "converged"
    ITERATION_LIMIT = "iteration limit"
    STAGNATION = "stagnation"
    BREAKDOWN = "breakdown"


@dataclass(frozen=True, eq=False, kw_only=True)
class Contact(ReadOnly):
    """Pressure between a rigid indenter and a half-space, with the problem it answers and the tolerance asked for.

    pressure: never negative, shape of the half-space [Pa]; approach: [m];
    history: residual at the start and after each iteration; the last, like the first, from a fresh operator
    application on the pressure as returned;
    operator_applications: all of them on this grid or a window of it, start included; coarse_applications: those on the
    coarser grids that gave the start, (shape, count) of each; status: see `Status`;
    frozen: this contact pressed as a flat punch, where `indent` was asked for the stiffness.
    """

    problem: Problem = field(repr=False)
    tolerance: float
    pressure: FloatArray = field(repr=False)
    approach: float
    history: tuple[float, ...] = field(repr=False)
    operator_applications: int
    status: Status
    coarse_applications: tuple[Level, ...] = field(default=(), repr=False)
    frozen: FixedContactArea | None = field(default=None, repr=False)

    @property
    def force(self) -> float:
        """F = sum(p) dx dy [N]."""
        return float(self.pressure.sum()) * self.problem.half_space.cell_area

    @property
    def area(self) -> float:
        """Cells under pressure times dx dy [m^2]."""
        return int(np.count_nonzero(self.pressure)) * self.problem.half_space.cell_area

    @property
    def residual(self) -> float:
        """The last entry of the history, dimensionless."""
        return self.history[-1]

    @property
    def iterations(self) -> int:
        """Iterations taken."""
        return len(self.history) - 1

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What a converged answer may still be wrong about, (category, sentence) of each."""
        half_space, cells = self.problem.half_space, int(np.count_nonzero(self.pressure))
        units = diagnose_units(
            pressure=float(self.pressure.sum()) / max(cells, 1),
            modulus=half_space.modulus,
            approach=self.approach - self.problem.first_touch if cells else 0.0,
            side=max(n * step for n, step in zip(half_space.shape, half_space.steps, strict=True)),
        )
        return (*diagnose_pressure(self.pressure, periodic=half_space.periodic), *units)

    doubts = diagnostics  # name of 0.1, for one release

    @property
    def converged(self) -> bool:
        """Whether this is a solution."""
        return self.status is Status.CONVERGED

    def stiffness(self, *, tolerance: float | None = None) -> float:
        """k = dF/dd of the discrete problem: the frozen contact pressed by a unit approach [N/m].

        tolerance: relative residual of the linear solve; the relative error of k is some tens of times its square, see
        `press_frozen`. None takes what `indent` has brought along, and where it has not, solves to the tolerance that
        `press_frozen` has of itself. A stiffness
        that was brought along with a residual below the tolerance is not solved for again, any other is, at each call.
        Zero where there is no contact; infinite for a periodic half-space in full contact.
        Raises ConvergenceError if this contact is no solution, or the linear solve fails.
        """
        if not self.converged:
            raise ConvergenceError(f"no stiffness of a contact that ended with: {self.status}", self.history, self)
        if self.frozen is not None and (tolerance is None or self.frozen.residual <= tolerance):
            return self.frozen.stiffness
        half_space, contact = self.problem.half_space, self.pressure > 0
        if tolerance is None:
            return solve_fixed_area(half_space, contact).stiffness
        return solve_fixed_area(half_space, contact, tolerance=tolerance).stiffness


def residual(pressure: FloatArray, w: FloatArray, overlap: float) -> float:
    """How far a pressure is from solving the contact problem, dimensionless.

    With s = approach - min(gap), the deepest geometric overlap: the larger of sum(p |w|) / (s sum(p)), a gap under
    pressure, and max(-w) / s, a penetration.
    One deep spike makes s large and this figure small for all the rest: ask for a finer tolerance there.
    Without overlap, s <= 0, only p = 0 is a solution (residual 0), anything else is none (infinite).

    pressure: [Pa]; overlap: s [m];
    w: gap + u - approach, with u from a fresh operator application on that pressure [m].
    """
    total = float(pressure.sum())
    if not math.isfinite(total):
        return math.nan
    if overlap <= 0:
        return 0.0 if total == 0 else math.inf
    open_under_pressure = float((pressure * np.abs(w)).sum()) / total if total > 0 else 0.0
    penetration = -float(w.min())
    # the built-in max loses a NaN
    if math.isnan(open_under_pressure) or math.isnan(penetration):
        return math.nan
    return max(open_under_pressure, penetration, 0.0) / overlap
