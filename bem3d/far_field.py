"""What contacts far apart do to each other, on a coarse grid: the second level of the approximate inverse."""

from collections.abc import Callable

import numpy as np

from bem3d.checks import BoolArray, FloatArray, IndexArray
from bem3d.halfspace import HalfSpace

ACCURACY = 1e-2
"""Relative residual of the system on the coarse grid; less accurate, it costs iterations on the fine one."""
MOST_STEPS = 50
"""Of conjugate gradients on the coarse grid."""
CHANGED = 0.1
"""Part of the free cells that may change before the stiffness of the contact is taken anew."""

Near = Callable[..., FloatArray]
"""Displacement to pressure, into an array if one is named."""


class FarField:
    """Approximate inverse on cells that may touch, with what they do to each other from afar.

    The operator is K = K_n + Z C Z^T. The near field K_n has the symbol 2 / (E* sqrt(q^2 + q_c^2)), whose inverse S is
    masked by the cells; the far field is smooth, C on blocks of cells, Z constant on each. By Woodbury's formula
    (K_n + Z C Z^T)^-1 = S - S Z (C^-1 + Z^T S Z)^-1 Z^T S, where S Z y = d Z y, nearly, with d = S 1: springs d between
    the surface and a half-space of blocks.

    cells: flat indices of the cells that may touch; near: S on vectors over them.
    Source: the split of Ewald; the two levels are ours.
    """

    def __init__(self, half_space: HalfSpace, cells: IndexArray, near: Near):
        self._near, self._far = near, half_space.far
        (nx, ny), (mx, my) = half_space.shape, self._far.shape
        row, column = np.divmod(cells, ny)
        self._block = row * mx // nx * my + column * my // ny
        self._free = np.zeros(cells.size, dtype=np.bool_)
        # no cell is free yet, so that the first call takes the springs
        self._springs = np.zeros(cells.size)

    def __call__(self, displacement: FloatArray, free: BoolArray, out: FloatArray | None = None) -> FloatArray:
        """Nearly the pressure that makes this displacement on the free cells, and none elsewhere."""
        # 1. springs S 1: an application of S, which is spared while the contact is nearly the same. Their error
        # costs iterations alone: steps are made conjugate by their images, whatever the preconditioner
        if np.count_nonzero(free != self._free) > CHANGED * np.count_nonzero(free):
            self._free, self._springs = free.copy(), np.maximum(self._near(free.astype(np.float64)), 0.0)
        springs = self._springs * free
        # 2. what the far field leaves on the blocks
        y = self._settled(self._sums(springs * displacement), self._sums(springs))
        # 3. near pressure without that which the far field takes over
        springs *= y.ravel().take(self._block)
        pressure = self._near(displacement, out)
        pressure -= springs
        return pressure

    def cut(self, pressure: FloatArray) -> None:
        """Make what is negative zero, in place, by a scale on each block that keeps its force if that presses.

        Where many cells leave the contact, what the cut adds is felt from afar, the more the larger the grid: balanced
        over the whole contact alone, it would spoil the steps of several iterations.
        """
        forces = self._sums(pressure)
        np.maximum(pressure, 0.0, out=pressure)
        raised = self._sums(pressure)
        scale = np.divide(np.maximum(forces, 0.0), raised, out=np.ones_like(raised), where=raised > 0)
        pressure *= scale.ravel().take(self._block)

    def _sums(self, vector: FloatArray) -> FloatArray:
        """Z^T v."""
        blocks = self._far.shape
        sums = np.bincount(self._block, vector, minlength=blocks[0] * blocks[1])
        return np.asarray(sums.reshape(blocks), dtype=np.float64)

    def _settled(self, pressed: FloatArray, stiffness: FloatArray) -> FloatArray:
        """y of (C^-1 + D) y = b: y = C g, where (1 + sqrt(D) C sqrt(D)) h = b / sqrt(D) and g = sqrt(D) h."""
        # the form with the roots is symmetric, needs no inverse of C, and drops blocks without a free cell
        root = np.sqrt(stiffness)
        left = np.divide(pressed, root, out=np.zeros_like(root), where=root > 0)
        found, direction = np.zeros_like(left), left
        square = first = float((left**2).sum())
        for _ in range(MOST_STEPS):
            # not "<=": NaN, and nothing to solve, end it too
            if not square > ACCURACY**2 * first:
                break
            image = direction + root * self._far(root * direction)
            step = square / float((direction * image).sum())
            found, left = found + step * direction, left - step * image
            before, square = square, float((left**2).sum())
            direction = left + square / before * direction
        return self._far(root * found)
