"""The Love solution: how a half-space yields under a uniformly pressed cell; free-space and periodic symbols."""

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from bem3d.border import FloatArray


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


def free_space_symbol(padded: tuple[int, int], spacing: tuple[float, float], modulus: float) -> FloatArray:
    """Real Fourier transform of the Love kernel on the padded grid [m/Pa].

    The padded grid has at least 2n - 1 points a side, so that no cell meets the image of another.
    Returns shape (padded[0], padded[1] // 2 + 1). The kernel is even, so its transform is real.
    """
    # in units of dx, so that a change of scale changes nothing but the factor in front
    aspect = spacing[1] / spacing[0]
    x = np.arange(padded[0] // 2 + 1.0)[:, np.newaxis]
    y = aspect * np.arange(padded[1] // 2 + 1.0)[np.newaxis, :]
    quadrant = spacing[0] / (np.pi * modulus) * love(x, y, 1.0, aspect)
    kernel = quadrant[np.ix_(_mirrored(padded[0]), _mirrored(padded[1]))]
    return np.ascontiguousarray(fft.rfft2(kernel).real)


def periodic_symbol(shape: tuple[int, int], spacing: tuple[float, float], modulus: float) -> FloatArray:
    """2 / (E* |q|) at the waves of a periodic grid, zero at q = 0 [m/Pa].

    The zero mode is free in a periodic half-space: the mean displacement is unbounded. Set to zero it makes every
    displacement, and with it every approach, relative to the mean plane of the deformed surface.
    Returns shape (shape[0], shape[1] // 2 + 1).
    """
    qx = 2 * np.pi * fft.fftfreq(shape[0], spacing[0])
    qy = 2 * np.pi * fft.rfftfreq(shape[1], spacing[1])
    q = np.hypot(qx[:, np.newaxis], qy[np.newaxis, :])
    q[0, 0] = np.inf
    return np.asarray(2 / (modulus * q))


def _half(x: FloatArray, y: FloatArray) -> FloatArray:
    """x asinh(y/|x|), continued by its limit 0 at x = 0."""
    return x * np.arcsinh(y / np.where(x == 0, 1.0, np.abs(x)))


def _mirrored(points: int) -> np.ndarray:
    """Distance of each point of a ring from point 0, in points."""
    index = np.arange(points)
    return np.minimum(index, points - index)
