"""The solution of a contact problem, with the problem, and its residual."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from bem3d.checks import FloatArray, count
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import ContactWarning, diagnose_pressure, diagnose_units
from bem3d.problem import Problem
from bem3d.results import ReadOnly, kept, line, map_of, span
from bem3d.tangent_stiffness import FixedContactArea, solve_fixed_area

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Level = tuple[tuple[int, int], int]
"""Shape of a coarser grid, and the operator applications on it."""
PERIMETER = (math.pi - 1 + math.log(2)) / 24
"""Part of a cell that the contact area on a grid is too large by, for each side of a cell between contact and gap."""


class Status(StrEnum):
    """How a solve ended: only CONVERGED is a solution.

    Examples
    --------
    >>> [str(status) for status in bem3d.Status]
    ['converged', 'iteration limit', 'stagnation', 'breakdown']
    """

    CONVERGED = "converged"
    ITERATION_LIMIT = "iteration limit"
    STAGNATION = "stagnation"
    BREAKDOWN = "breakdown"


@dataclass(frozen=True, eq=False, kw_only=True)
class Contact(ReadOnly):
    """Solution of a contact problem, with the problem. Made by `solve`, `indent` and `solve_polonsky_keer`.

    Attributes
    ----------
    problem : Problem
        What was solved.
    tolerance : float
        Residual that was asked for.
    pressure : ndarray, shape of the half-space
        Pressure on each cell, nowhere negative [Pa].
    approach : float
        Rigid approach [m].
    history : tuple of float
        Residual at the start and after each iteration. The first and the last are of a fresh operator application.
    operator_applications : int
        Applications of u = K p on this grid or a window of it, the start included.
    status : Status
        How the solve ended.
    coarse_applications : tuple of ((int, int), int)
        Shape of each coarser grid that gave the start, and the applications on it.
    frozen : FixedContactArea or None
        Contact area pressed as a flat punch, where `indent` was asked for the stiffness.

    Examples
    --------
    >>> x = (np.arange(65) - 32) * 5e-5
    >>> gap = (x[:, None] ** 2 + x**2) / (2 * 0.1)
    >>> contact = bem3d.solve(bem3d.HalfSpace(shape=(65, 65), spacing=5e-5, modulus=1e11), gap, approach=5e-6)
    >>> print(f"F = {contact.force:.1f} N, k = {contact.stiffness():.3g} N/m, {contact.status}")
    F = 471.5 N, k = 1.42e+08 N/m, converged
    """

    problem: Problem
    tolerance: float
    pressure: FloatArray
    approach: float
    history: tuple[float, ...]
    operator_applications: int
    status: Status
    coarse_applications: tuple[Level, ...] = ()
    frozen: FixedContactArea | None = None

    def __repr__(self) -> str:
        load = f"force={span(self.force, 'N')}, approach={span(self.approach, 'm')}, area={span(self.area, 'm^2')}"
        return line(f"Contact({load}, {self.status}, iterations={self.iterations})")

    @property
    def force(self) -> float:
        """F = sum(p) dx dy [N]."""
        return float(self.pressure.sum()) * self.problem.half_space.cell_area

    @property
    def area(self) -> float:
        """Cells under pressure times dx dy [m^2]."""
        return int(np.count_nonzero(self.pressure)) * self.problem.half_space.cell_area

    @cached_property
    def corrected_area(self) -> float:
        """Contact area less what the grid adds along its boundary, an estimate at zero cell size [m^2].

        A' = A - (pi - 1 + ln 2) / 24 S, S the number of sides between a cell under pressure and one without, times
        dx dy: the area of a cell counts as a whole where a part of it is in contact. Sides along the end of a free
        grid do not count, a periodic grid has none. On 8 cells to a contact radius a sphere's area is within 1 %.
        Range: contacts of some cells; a single one keeps half of its area.
        Source: Yastrebov, Anciaux and Molinari, Tribol. Int. 114, 161 (2017).
        """
        under = self.pressure > 0
        sides = sum(int(np.count_nonzero(np.diff(under, axis=axis))) for axis in (0, 1))
        if self.problem.half_space.periodic:
            ends = (under[0] != under[-1], under[:, 0] != under[:, -1])
            sides += sum(int(np.count_nonzero(end)) for end in ends)
        return self.area - PERIMETER * sides * self.problem.half_space.cell_area

    @cached_property
    def displacement(self) -> FloatArray:
        """u = K p at the centres of the cells, into the half-space, read-only [m].

        One operator application, at the first use. Of a periodic half-space its mean is zero.
        """
        return kept(self.problem.half_space.apply(self.pressure))

    @cached_property
    def gap(self) -> FloatArray:
        """Separation of the deformed surfaces, gap of the problem + u - approach, read-only [m].

        Zero where there is pressure, and nowhere negative, within the residual times the overlap.
        """
        return kept(self.problem.gap + self.displacement - self.approach)

    @cached_property
    def mean_gap(self) -> float:
        """Mean of `gap` over the cells [m].

        Of a periodic half-space the distance of the mean planes, mean(gap of the problem) - approach, without an
        operator application. In free space the mean over the grid: that of a punch that ends with it; of a body that
        curves away it depends on the size of the grid.
        """
        if self.problem.half_space.periodic:
            return float(self.problem.gap.mean()) - self.approach
        return float(self.gap.mean())

    def pressure_histogram(self, bins: int = 50) -> tuple[FloatArray, FloatArray]:
        """Distribution of the pressure over the contact area.

        Parameters
        ----------
        bins : int, optional
            Intervals of equal width from zero to the largest pressure, at least 1.

        Returns
        -------
        density : ndarray, shape (bins,)
            P(p) [1/Pa] over the contact, sum(density * diff(edges)) = 1, zero without contact. Over the nominal area it
            is times ``area`` over that.
        edges : ndarray, shape (bins + 1,)
            Ends of the intervals [Pa], zero without contact.

        Raises
        ------
        TypeError, ValueError
            If ``bins`` is no whole number of at least 1.
        """
        bins, under = count("bins", bins, least=1), self.pressure[self.pressure > 0]
        if not under.size:
            return np.zeros(bins), np.zeros(bins + 1)
        density, edges = np.histogram(under, bins, (0.0, float(under.max())), density=True)
        return density, edges

    def plot(self, ax: Axes | None = None, *, quantity: Literal["pressure", "gap"] = "pressure") -> Axes:
        """Draw a map of the pressure or of the gap, with a scale.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on, by default those of a new figure.
        quantity : {"pressure", "gap"}, optional
            Pressure [Pa] of the cells in contact, or the separation of the deformed surfaces [m] of the others, which
            takes one operator application. Those left out stay empty.

        Returns
        -------
        matplotlib.axes.Axes
            The axes: first axis of the arrays along x, both from the corner of the grid [m].

        Raises
        ------
        ValueError, TypeError
            If ``quantity`` is another text, or ``ax`` is no Axes.
        """
        if quantity not in ("pressure", "gap"):
            raise ValueError(f'quantity must be "pressure" or "gap", got {quantity!r}')
        values, unit = (self.pressure, "Pa") if quantity == "pressure" else (self.gap, "m")
        is_shown = (self.pressure > 0) == (quantity == "pressure")
        share = np.count_nonzero(self.pressure) / self.pressure.size
        title = f"contact on {100 * share:.3g} % of the cells, F = {span(self.force, 'N')}"
        return map_of(np.where(is_shown, values, np.nan), self.problem.half_space.steps, quantity, unit, title, ax)

    @property
    def residual(self) -> float:
        """The last entry of the history, dimensionless."""
        return self.history[-1]

    @property
    def iterations(self) -> int:
        """Iterations taken."""
        return len(self.history) - 1

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is warned of, with its numbers, if this contact has converged."""
        return tuple(warning.detail for warning in self.diagnose())

    @property
    def diagnostics(self) -> tuple[tuple[type[ContactWarning], str], ...]:
        """Category and sentence of each of the `warnings`."""
        return tuple((type(warning), warning.detail) for warning in self.diagnose())

    doubts = diagnostics  # name of 0.1, for one release

    def diagnose(self) -> tuple[ContactWarning, ...]:
        """The warnings that `solve` gives."""
        half_space, cells = self.problem.half_space, int(np.count_nonzero(self.pressure))
        units = diagnose_units(
            pressure=float(self.pressure.sum()) / max(cells, 1),
            modulus=half_space.modulus,
            approach=self.approach - self.problem.first_touch if cells else 0.0,
            side=max(n * step for n, step in zip(half_space.shape, half_space.steps, strict=True)),
            slope=self.problem.slope if half_space.modulus != 1 else 0.0,
        )
        edge = not (half_space.periodic or self.problem.indenter_ends_at_edge)
        return (*diagnose_pressure(self.pressure, edge=edge), *units)

    @property
    def converged(self) -> bool:
        """Whether this is a solution."""
        return self.status is Status.CONVERGED

    def stiffness(self, *, tolerance: float | None = None) -> float:
        """Incremental stiffness k = dF/dd of the discrete problem, at a constant contact area.

        Parameters
        ----------
        tolerance : float, optional
            Relative residual of the linear solve; the relative error of k is some tens of times its square. By
            default the stiffness that `indent` has stored, or else the default of `solve_fixed_area`. A stored
            stiffness is also used where its residual is within the tolerance; any other is solved for at each call.

        Returns
        -------
        float
            k [N/m]. Zero without contact, infinite for the full contact of a periodic half-space.

        Raises
        ------
        ConvergenceError
            If this contact is no solution, or the linear solve fails.
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
    """Residual of a pressure in the contact problem, dimensionless.

    Parameters
    ----------
    pressure : ndarray
        Pressure on each cell, nowhere negative [Pa].
    w : ndarray, shape of ``pressure``
        gap + u - approach, with u of a fresh operator application on that pressure [m].
    overlap : float
        s = approach - min(gap), the deepest geometric overlap [m].

    Returns
    -------
    float
        The larger of sum(p abs(w)) / (s sum(p)), a gap under pressure, and max(-w) / s, a penetration. Without
        overlap, s <= 0, it is 0 for p = 0 and infinite otherwise. It is NaN where a pressure is not finite.

    Notes
    -----
    One high spike makes s large, and the residual of all other cells small: ask for a smaller tolerance there.

    Examples
    --------
    >>> bem3d.residual(np.array([2.0, 0.0]), np.array([1e-9, 3e-9]), 1e-6)
    0.001
    """
    total = float(pressure.sum())
    if not math.isfinite(total):
        return math.nan
    product = np.abs(w)
    product *= pressure
    return relative_error(total, float(product.sum()), -float(w.min()), overlap)


def relative_error(total: float, moved: float, penetration: float, overlap: float) -> float:
    """`residual` from the sums of p and of p abs(w), and max(-w)."""
    if overlap <= 0:
        return 0.0 if total == 0 else math.inf
    open_under_pressure = moved / total if total != 0 else 0.0
    # the built-in max loses a NaN
    if math.isnan(open_under_pressure) or math.isnan(penetration):
        return math.nan
    return max(open_under_pressure, penetration, 0.0) / overlap
