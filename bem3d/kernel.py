"""The Love solution: how a half-space yields under a uniformly pressed cell; free-space and periodic symbols."""

import numpy as np
import scipy
from numpy.typing import ArrayLike

from bem3d.checks import FloatArray

WAVE_OF_UNIFORM_PRESSURE = 0.3
"""The wave, as a part of the longest, to whose pressure a contact yields about as to a uniform one."""
ROWS_AT_ONCE = 256
"""Rows of a table that are computed at a time."""


def corner(x: ArrayLike, y: ArrayLike) -> FloatArray:
    """int_0^y int_0^x ds dt / sqrt(s^2 + t^2) = x asinh(y/|x|) + y asinh(x/|y|).

    x, y: any reals, zero included [m]; returns their broadcast shape [m].
    """
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    return _half(x, y) + _half(y, x)


def love(x: ArrayLike, y: ArrayLike, dx: float, dy: float) -> FloatArray:
    """int dA' / r over a cell dx by dy centred at the origin, seen from (x, y) on the surface.

    u(x, y) = p love(x, y, dx, dy) / (pi E*) is the displacement by a uniform pressure p on the cell.

    x, y: broadcastable [m]; dx, dy: sides of the cell [m]; returns [m].
    Source: Love, Phil. Trans. R. Soc. A 228 (1929); Johnson, Contact Mechanics, chapter 3.
    """
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    left, right, down, up = x - dx / 2, x + dx / 2, y - dy / 2, y + dy / 2
    return corner(right, up) - corner(left, up) - corner(right, down) + corner(left, down)


def love_table(cells: tuple[int, int], aspect: float) -> FloatArray:
    """`love` at the centres (i, j) of the cells of a quadrant, in units of dx: neighbours share their corners.

    cells: how many along both axes; aspect: dy / dx. Returns shape (cells[0], cells[1]).
    """
    x = np.arange(cells[0] + 1)[:, np.newaxis] - 0.5
    y = aspect * (np.arange(cells[1] + 1)[np.newaxis, :] - 0.5)
    table = np.empty(cells)
    # a large table is not there several times at once
    for i in range(0, cells[0], ROWS_AT_ONCE):
        table[i : i + ROWS_AT_ONCE] = np.diff(np.diff(corner(x[i : i + ROWS_AT_ONCE + 1], y), axis=0), axis=1)
    return table


def free_space_symbol(table: FloatArray, spacing: tuple[float, float], modulus: float) -> FloatArray:
    """Real Fourier transform of the Love kernel on a padded grid, its quadrant [m/Pa].

    table: `love_table` of shape (m, n) for the padded grid of (2m - 2, 2n - 2) points. With at least 2n - 1 points
    a side, no cell meets the image of another. The kernel is even along both axes, so its transform is a cosine
    transform of one quadrant, of the same shape, in whose memory it stands afterwards.
    """
    symbol = np.asarray(scipy.fft.dctn(table, type=1, overwrite_x=True))
    symbol *= spacing[0] / (np.pi * modulus)
    return symbol


def periodic_symbol(shape: tuple[int, int], spacing: tuple[float, float], modulus: float) -> FloatArray:
    """2 / (E* |q|) at the waves of a periodic grid, zero at q = 0, its quadrant [m/Pa].

    The zero mode is free in a periodic half-space: the mean displacement is unbounded. Set to zero it makes every
    displacement, and with it every approach, relative to the mean plane of the deformed surface.
    Returns shape (shape[0] // 2 + 1, shape[1] // 2 + 1).
    """
    q = wavenumbers(shape, spacing)
    q[0, 0] = np.inf
    return np.asarray(2 / (modulus * q))


def far_table(blocks: tuple[int, int], spacing: tuple[float, float], wave: float) -> FloatArray:
    """(1 - exp(-q_c r)) / r at the centres of the blocks of a quadrant [1/m]: `love` over dA without its near field."""
    r = np.hypot(spacing[0] * np.arange(blocks[0])[:, np.newaxis], spacing[1] * np.arange(blocks[1]))
    r[0, 0] = np.inf
    table = -np.expm1(-wave * r) / r
    table[0, 0] = wave
    return np.asarray(table)


def far_periodic_symbol(
    shape: tuple[int, int], spacing: tuple[float, float], modulus: float, wave: float
) -> FloatArray:
    """2 / E* (1/|q| - 1 / sqrt(q^2 + q_c^2)), its quadrant [m/Pa]."""
    q = wavenumbers(shape, spacing)
    q[0, 0] = np.inf
    return np.asarray(2 / modulus * (1 / q - 1 / np.hypot(q, wave)))


def inverse_symbol(shape: tuple[int, int], spacing: tuple[float, float], modulus: float, wave: float) -> FloatArray:
    """E*/2 sqrt(q^2 + q_0^2), the quadrant of a symbol that nearly inverts the half-space [Pa/m].

    q_0 is a part of 2 pi over the longer side: a half-space in free space yields to a uniform pressure as if to a wave
    longer than the grid. Without padding its images touch, which a preconditioner may ignore.
    Source: the inverse of Stanley and Kato's symbol, as used by Vollebregt, J. Comput. Phys. 257 (2014) 269.
    """
    return np.asarray(modulus / 2 * np.hypot(wavenumbers(shape, spacing), wave))


def wavenumbers(shape: tuple[int, int], spacing: tuple[float, float]) -> FloatArray:
    """|q| on the quadrant of the spectrum of a grid [rad/m]."""
    qx = 2 * np.pi * scipy.fft.rfftfreq(shape[0], spacing[0])
    qy = 2 * np.pi * scipy.fft.rfftfreq(shape[1], spacing[1])
    return np.asarray(np.hypot(qx[:, np.newaxis], qy[np.newaxis, :]))


def _half(x: FloatArray, y: FloatArray) -> FloatArray:
    """x asinh(y/|x|), continued by its limit 0 at x = 0."""
    return x * np.arcsinh(y / np.where(x == 0, 1.0, np.abs(x)))
