"""A periodic surface without short waves, on a finer grid: the sum of the same waves."""

import numpy as np
import scipy
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def refined(height: FloatArray, cells: int) -> FloatArray:
    """Heights at the centres of cells x cells of a periodic surface that is known at those of fewer.

    h(x) = sum_q c_q exp(i q x) over the waves longer than two cells of the coarse grid, whose c_q follow from its
    heights; waves of just two cells are lost.

    height: shape (n, n), of the period of the fine grid; cells: n or more. Returns shape (cells, cells).
    Raises ValueError where the height is not square, or has more cells.
    """
    coarse = len(height)
    if height.shape != (coarse, coarse) or coarse > cells:
        raise ValueError(f"height must have shape (n, n) with n up to cells = {cells}, got {height.shape}")
    if coarse == cells:
        return height
    most = (coarse - 1) // 2
    along, across = np.arange(-most, most + 1), np.arange(most + 1)
    # from the centre of a coarse cell to that of a fine one, both half a cell off their corner
    shift = np.pi / cells - np.pi / coarse
    waves = scipy.fft.rfft2(height, norm="forward")[along[:, np.newaxis], across]
    waves *= np.exp(1j * shift * along)[:, np.newaxis] * np.exp(1j * shift * across)
    fine = np.zeros((cells, cells // 2 + 1), dtype=np.complex128)
    fine[along[:, np.newaxis], across] = waves
    return np.asarray(scipy.fft.irfft2(fine, (cells, cells), norm="forward"))
