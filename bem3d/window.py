"""The smallest window that holds a contact, and vectors over the cells that may touch."""

import numpy as np

from bem3d.checks import BoolArray, FloatArray
from bem3d.far_field import FarField
from bem3d.halfspace import HalfSpace

Box = tuple[slice, slice]
SIDES = (*range(1, 9), 10, 12, 14, 16, 20, *(m * 2**k for k in range(12) for m in (25, 28, 30, 32, 35, 40)))
"""Sides of windows, in cells: those whose doubles transform fastest, measured; few, so that few windows serve many
contacts."""


def smallest_box(half_space: HalfSpace, marked: BoolArray) -> Box:
    """Rows and columns that hold all marked cells, widened to a length that transforms fast.

    A periodic half-space has images all around and no smaller window than its period.
    """
    if half_space.periodic or not marked.any():
        return slice(0, marked.shape[0]), slice(0, marked.shape[1])
    rows, columns = (_widened(np.flatnonzero(marked.any(axis=axis)), marked.shape[1 - axis]) for axis in (1, 0))
    return rows, columns


def _widened(marked: np.ndarray, points: int) -> slice:
    """A slice over the marked indices whose length transforms fast."""
    length = int(marked[-1] - marked[0]) + 1
    wide = fast_side(length, points)
    first = min(max(int(marked[0]) - (wide - length) // 2, 0), points - wide)
    return slice(first, first + wide)


def fast_side(length: int, most: int) -> int:
    """The shortest of `SIDES` that is long enough, as far as there are cells."""
    return min(next((side for side in SIDES if side >= length), most), most)


class Candidates:
    """The cells of a window that may touch: K and its approximate inverse on vectors over these cells alone.

    marked: boolean, shape of the half-space; vectors hold the marked cells in the order of the grid.
    """

    def __init__(self, half_space: HalfSpace, marked: BoolArray):
        self._half_space = half_space
        self._marked, self._cells = marked, np.flatnonzero(marked)
        self._direct, self._inverse = half_space.convolution, half_space.inverse
        self._in_direct = self._direct.places(self._cells)
        self._in_inverse = self._inverse.places(self._cells)
        self._far = FarField(half_space, self._cells, self._near) if half_space.has_far_field else None

    @property
    def stiffness(self) -> float:
        """Pressure on a cell alone that moves it by a unit [Pa/m]."""
        return 1 / self._half_space.self_compliance

    def displacement(self, pressure: FloatArray, out: FloatArray | None = None) -> FloatArray:
        """u = K p."""
        return self._direct.at(self._in_direct, pressure, out)

    def inverse(self, displacement: FloatArray, free: BoolArray, out: FloatArray | None = None) -> FloatArray:
        """Nearly the pressure on the free cells that makes this displacement."""
        if self._far is None:
            return self._near(displacement, out)
        return self._far(displacement, free, out)

    def cut(self, pressure: FloatArray) -> None:
        """Make what is negative zero, in place; on large grids the force on each block of cells stays."""
        if self._far is None:
            np.maximum(pressure, 0.0, out=pressure)
        else:
            self._far.cut(pressure)

    def _near(self, displacement: FloatArray, out: FloatArray | None = None) -> FloatArray:
        return self._inverse.at(self._in_inverse, displacement, out)

    def compress(self, field: FloatArray) -> FloatArray:
        """The vector of a field."""
        return np.asarray(field.ravel()[self._cells])

    def spread(self, vector: FloatArray) -> FloatArray:
        """The field of a vector, zero elsewhere."""
        field = np.zeros(self._marked.shape)
        field[self._marked] = vector
        return field


def dot(a: FloatArray, b: FloatArray) -> float:
    """Inner product of two vectors, without BLAS, whose last bits depend on the number of threads."""
    return float(np.einsum("i,i", a, b))


def dots(rows: FloatArray, b: FloatArray, out: FloatArray | None = None) -> FloatArray:
    """Inner products of each row with a vector, alike."""
    return np.asarray(np.einsum("ij,j->i", rows, b, out=out))
