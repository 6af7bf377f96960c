"""A load path on few cells: the same iteration on the matrix of their influence coefficients, without a transform.

Under a light load few cells of a fine grid touch, far apart: a window that holds them is nearly the grid. Only cells
that overlap geometrically can touch, since u >= 0 for p >= 0, and among so few K is a small dense matrix.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bem3d import kernel
from bem3d.checks import BoolArray, FloatArray, IndexArray, Loads, count, field, finite_row, fraction
from bem3d.contact import residual
from bem3d.convergence import ConvergenceError
from bem3d.halfspace import HalfSpace
from bem3d.projected_cg import Load, projected_cg
from bem3d.results import ReadOnly, line, span
from bem3d.window import dots

CellArray = NDArray[np.int32]
BEGIN = 64
"""Cells, those of the smallest gap, that are looked at first."""
GROWTH = 4
"""How many times as many at most are looked at next: on too few cells the overlap is far too large."""
STIFFNESS_TOLERANCE = 1e-6
"""Relative residual of the fixed contact area: its stiffness is good to its square times the condition of K."""
MOST_STEPS = 10
"""Of the iteration for it, times the cells."""
CHECKS = 30
"""Times that the residual is taken anew on all cells that overlap, before an iteration is given up."""


class TooManyCellsError(ValueError):
    """A contact that may have more cells than are allowed; ``bem3d.indent`` takes any number.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(64, 64), spacing=1e-4, modulus=1e11)
    >>> try:
    ...     next(bem3d.indent_few_cells(body, np.zeros((64, 64)), forces=[1.0], max_cells=100))
    ... except bem3d.TooManyCellsError as error:
    ...     print(error)
    forces[0] = 1 N overlaps on more cells than max_cells = 100
    """


@dataclass(frozen=True, eq=False, kw_only=True)
class FewCellsContact(ReadOnly):
    """A contact as the cells that touch. Made by `indent_few_cells`.

    Attributes
    ----------
    cells : ndarray of int, shape (n, 2)
        Row and column of each cell that touches.
    pressure : ndarray, shape (n,)
        Pressure on them, above zero [Pa].
    force, area, approach, stiffness : float
        F [N], n dx dy [m^2], rigid approach [m], k = dF/dd at a constant contact area [N/m].
    history : tuple of float
        Residual, on all cells that overlap, each time that it was taken anew.
    products, stiffness_products : int
        Influence coefficients multiplied, by a pressure each, to find the contact and to find its stiffness.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(64, 64), spacing=1e-4, modulus=1e11)
    >>> gap = np.where(np.arange(64 * 64) % 999, 1e-6, 0.0).reshape(64, 64)
    >>> contact, = bem3d.indent_few_cells(body, gap, forces=[0.1])
    >>> contact
    FewCellsContact(cells=5, force=0.1 N, approach=2.309e-9 m, stiffness=4.331e7 N/m)
    """

    cells: CellArray
    pressure: FloatArray
    force: float
    area: float
    approach: float
    stiffness: float
    history: tuple[float, ...]
    products: int
    stiffness_products: int

    def __repr__(self) -> str:
        load = f"force={span(self.force, 'N')}, approach={span(self.approach, 'm')}"
        return line(f"FewCellsContact(cells={len(self.cells)}, {load}, stiffness={span(self.stiffness, 'N/m')})")

    @property
    def residual(self) -> float:
        """The last entry of the history."""
        return self.history[-1]


def indent_few_cells(
    half_space: HalfSpace,
    gap: ArrayLike,
    *,
    forces: Loads,
    max_cells: int = 4000,
    tolerance: float = 1e-6,
    max_iterations: int = 500,
) -> Iterator[FewCellsContact]:
    """Press along a path of ascending forces that few cells carry; the solutions are those of `indent`.

    Parameters
    ----------
    half_space : HalfSpace
        Operator u = K p and its grid, in free space.
    gap : array_like, shape of the half-space
        Undeformed separation; a bump makes it smaller [m].
    forces : sequence of float
        Normal forces, positive and ascending [N].
    max_cells : int, optional
        Most cells that may overlap geometrically, three times those that touch or more. Memory and time go with the
        square.
    tolerance, max_iterations
        `residual` to reach, in (0, 1), and limit of iterations between two fresh residuals, at least 1.

    Yields
    ------
    FewCellsContact
        The contact at each force, with its stiffness. No warning is given: its number of cells tells of few.

    Raises
    ------
    ValueError, TypeError, TooManyCellsError, ConvergenceError
        If an argument is out of range; more than ``max_cells`` overlap, where earlier contacts are good; or a contact
        does not reach the tolerance.

    Notes
    -----
    u_i = sum_j K_ij p_j over the cells that may touch, K_ij by Love as in `HalfSpace`. A cell that does not overlap
    geometrically cannot touch, so that the residual on those that do is that of the whole grid.

    Examples
    --------
    >>> def c2d(q):
    ...     return np.where(q < 32 * 2 * np.pi, q**-3.6, 0.0)
    >>> height = bem3d.rough_surface(c2d, shape=(128, 128), spacing=1 / 128, rng=np.random.default_rng(1), rms=1e-3)
    >>> body = bem3d.HalfSpace(shape=(128, 128), spacing=1 / 128, modulus=1.0)
    >>> [len(contact.cells) for contact in bem3d.indent_few_cells(body, -height, forces=[1e-6, 1e-5])]
    [5, 26]
    """
    if half_space.periodic:
        raise ValueError("half_space must be in free space, got a periodic one, whose mean displacement is unknown")
    loads = finite_row("forces", forces, np.size(forces)).tolist()
    if not loads or not loads[0] > 0 or sorted(set(loads)) != loads:
        raise ValueError(f"forces must be positive and ascending, one at least, got {loads}")
    max_cells, max_iterations = count("max_cells", max_cells), count("max_iterations", max_iterations)
    tolerance = fraction("tolerance", tolerance)
    return _path(half_space, field("gap", gap, half_space.shape), loads, max_cells, tolerance, max_iterations)


@dataclass(frozen=True, eq=False)
class _Summits:
    """The cells of the smallest gap, ascending, and the influence of each on each.

    gap: above the smallest [m], with that of the next cell at the end, or infinity; table: influence by the distance
    along both axes [m/Pa].
    """

    row: CellArray
    column: CellArray
    gap: FloatArray
    table: FloatArray

    @classmethod
    def of(cls, half_space: HalfSpace, gap: FloatArray, most: int) -> _Summits:
        flat = gap.ravel()
        # the whole grid is partitioned and not sorted: few of its cells ever overlap
        if flat.size > most + 1:
            lowest = np.argpartition(flat, most)[: most + 1]
            lowest = lowest[np.argsort(flat[lowest], kind="stable")]
        else:
            lowest = np.argsort(flat, kind="stable")
        # from the first touch: a gap far from zero would cost digits
        ascending = flat[lowest] - flat[lowest[0]]
        row, column = np.divmod(lowest[:most].astype(np.int32), gap.shape[1])
        # the gap of the next cell tells a contact that ends among the known ones from one that may go on
        return cls(row, column, np.append(ascending, np.inf)[: row.size + 1], _influence(half_space))

    def below(self, overlap: float) -> int:
        """How many cells overlap, or one more than are known."""
        return int(np.searchsorted(self.gap, overlap))

    def matrix(self, to: IndexArray, of: IndexArray) -> FloatArray:
        """K_ij of the displacement of cells by the pressure of others."""
        # K_ij depends on the distance alone; indices of 32 bits are half as large as the matrix
        away = np.abs(self.row[to, np.newaxis] - self.row[of]) * np.int32(self.table.shape[1])
        away += np.abs(self.column[to, np.newaxis] - self.column[of])
        return np.asarray(self.table.ravel().take(away))


class _Dense:
    """K among some cells, as a matrix, with its diagonal as the approximate inverse."""

    def __init__(self, matrix: FloatArray) -> None:
        self.matrix, self.products = matrix, 0

    @property
    def stiffness(self) -> float:
        return 1 / float(self.matrix[0, 0])

    def displacement(self, pressure: FloatArray, out: FloatArray | None = None) -> FloatArray:
        self.products += self.matrix.size
        return dots(self.matrix, pressure, out)

    def inverse(self, displacement: FloatArray, free: BoolArray, out: FloatArray) -> FloatArray:
        # cells far apart are moved mostly by their own pressure, so that the diagonal is near enough
        return np.multiply(displacement, self.stiffness, out=out)

    def cut(self, pressure: FloatArray) -> None:
        np.maximum(pressure, 0.0, out=pressure)


@lru_cache(maxsize=1)
def _influence(half_space: HalfSpace) -> FloatArray:
    """Displacement by a unit pressure on a cell, so many cells away along both axes [m/Pa]; of the last grid kept."""
    dx, dy = half_space.steps
    return kernel.love_table(half_space.shape, dy / dx) * (dx / (np.pi * half_space.modulus))


@dataclass(eq=False)
class _Search:
    """Pressure on the first so many summits, the overlap that it has, and what has led there."""

    pressure: FloatArray
    overlap: float = 0.0
    history: list[float] = dataclasses.field(default_factory=list)
    products: int = 0


def _path(
    half_space: HalfSpace, gap: FloatArray, forces: list[float], max_cells: int, tolerance: float, max_iterations: int
) -> Iterator[FewCellsContact]:
    summits = _Summits.of(half_space, gap, max_cells)
    pressure = np.ones(max(min(BEGIN, summits.row.size) // 8, 1))
    looked_at = BEGIN
    for i, force in enumerate(forces):
        load, state = Load(total=force / half_space.cell_area), _Search(pressure)
        # 1. solve on the lowest cells alone, as many as are looked at
        while looked_at > state.pressure.size:
            looked_at = min(looked_at, summits.row.size)
            state.pressure = load.scaled(np.append(state.pressure, np.zeros(looked_at - state.pressure.size)))
            converged = _press(summits, load, state, tolerance, max_iterations)
            # 2. fewer cells are pressed deeper by the same force: what lies above this overlap cannot touch,
            # and once it holds no more than are looked at, the contact is that of the whole grid
            overlapping = summits.below(state.overlap)
            if overlapping > looked_at == summits.row.size:
                raise TooManyCellsError(
                    f"forces[{i}] = {force:g} N overlaps on more cells than max_cells = {max_cells}"
                )
            # 3. otherwise look farther, step by step
            looked_at = min(overlapping, GROWTH * looked_at)
        # made before an error is raised, which carries how far it has come
        contact = _contact(half_space, summits, state, force, float(gap.min()))
        if not converged:
            raise ConvergenceError(
                f"residual {contact.residual:.3g} after {CHECKS} checks, asked for {tolerance:g}, at force {force:g} N",
                contact.history,
                contact,
            )
        yield contact
        pressure = state.pressure
        if i + 1 < len(forces):
            # cells that overlap go with the force, nearly
            looked_at = max(int(state.pressure.size * forces[i + 1] / force), state.pressure.size + 1)


def _press(summits: _Summits, load: Load, state: _Search, tolerance: float, max_iterations: int) -> bool:
    """Iterate on cells that may touch until a residual taken anew on all that are looked at confirms it."""
    everywhere = np.arange(state.pressure.size)
    # cells are only added: what comes and goes from check to check would never settle
    marked = np.zeros(everywhere.size, dtype=np.bool_)
    for _ in range(CHECKS):
        pressed = np.flatnonzero(state.pressure)
        # afresh, on all cells: the image that the iteration sums up has rounding, and knows no unmarked cell
        separation = summits.gap[everywhere] + dots(summits.matrix(everywhere, pressed), state.pressure[pressed])
        state.products += everywhere.size * pressed.size
        state.overlap = load.overlap_of(state.pressure, separation)
        w = separation - state.overlap
        state.history.append(residual(state.pressure, w, state.overlap))
        if state.history[-1] <= tolerance:
            return True
        marked = marked | (state.pressure > 0) | (w < 0)
        cells = np.flatnonzero(marked)
        operator = _Dense(summits.matrix(cells, cells))
        found = _iterate(operator, state.pressure[cells], separation[cells], load, tolerance, max_iterations)
        state.products += operator.products
        state.pressure = np.zeros(everywhere.size)
        state.pressure[cells] = found
        state.pressure = load.scaled(state.pressure)
    return False


def _iterate(
    operator: _Dense, pressure: FloatArray, separation: FloatArray, load: Load, tolerance: float, max_iterations: int
) -> FloatArray:
    """The pressure at which the running residual is small enough, or nothing more is gained."""
    for state in islice(projected_cg(operator, pressure, separation, load), max_iterations):
        # half is left to what the fresh residual adds
        if state.residual <= tolerance / 2:
            break
    return state.pressure


def _contact(
    half_space: HalfSpace, summits: _Summits, state: _Search, force: float, first_touch: float
) -> FewCellsContact:
    """The cells that touch, and their stiffness."""
    # at a constant area each of these cells follows the approach one to one: K x = 1 on them
    touching = np.flatnonzero(state.pressure)
    operator = _Dense(summits.matrix(touching, touching))
    return FewCellsContact(
        cells=np.stack([summits.row[touching], summits.column[touching]], axis=1),
        pressure=state.pressure[touching],
        force=force,
        area=touching.size * half_space.cell_area,
        approach=first_touch + state.overlap,
        stiffness=_sum_of_unit_pressure(operator) * half_space.cell_area,
        history=tuple(state.history),
        products=state.products,
        stiffness_products=operator.products,
    )


def _sum_of_unit_pressure(operator: _Dense) -> float:
    """1.x with K x = 1, by conjugate gradients from x = 0; NaN where these do not converge.

    Each step adds its energy alpha r.r to 1.x. The sum of x itself would be off by the residual, since that does not
    stay at a right angle to x.
    """
    cells = len(operator.matrix)
    left, found = np.ones(cells), 0.0
    direction, square = left, float(cells)
    for _ in range(MOST_STEPS * cells):
        # the first residual is one on each cell, so that the number of cells is its square
        if square <= STIFFNESS_TOLERANCE**2 * cells:
            return found
        displacement = operator.displacement(direction)
        step = square / float((direction * displacement).sum())
        found += step * square
        left = left - step * displacement
        before, square = square, float((left**2).sum())
        direction = left + square / before * direction
    return math.nan
