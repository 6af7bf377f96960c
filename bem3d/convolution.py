"""Convolution with a real, even kernel: two planned FFTs on buffers that are made once and reused."""

import threading
from typing import Literal

import numpy as np
import pyfftw

from bem3d.border import FloatArray

Planning = Literal["estimate", "measure"]


class Convolution:
    """Circular convolution on a padded grid, read back on the part that was filled.

    symbol: real Fourier transform of the kernel, shape (padded[0], padded[1] // 2 + 1).
    One FFT thread. "estimate" plans give the same bits in every process, "measure" plans are somewhat faster and
    do not. Calls from several threads wait for each other, since the buffers are shared.
    """

    def __init__(self, symbol: FloatArray, *, shape: tuple[int, int], padded: tuple[int, int], planning: Planning):
        self._filled = np.s_[: shape[0], : shape[1]]
        self._symbol = symbol / (padded[0] * padded[1])
        self._lock = threading.Lock()
        self._field = pyfftw.empty_aligned(padded, dtype=np.float64)
        self._spectrum = pyfftw.empty_aligned(symbol.shape, dtype=np.complex128)
        self._result = pyfftw.empty_aligned(padded, dtype=np.float64)
        flag = f"FFTW_{planning.upper()}"
        self._forward = pyfftw.FFTW(self._field, self._spectrum, axes=(0, 1), flags=(flag,), threads=1)
        # the inverse destroys its input, which the next forward transform writes anew
        self._inverse = pyfftw.FFTW(
            self._spectrum,
            self._result,
            axes=(0, 1),
            direction="FFTW_BACKWARD",
            flags=(flag, "FFTW_DESTROY_INPUT"),
            threads=1,
        )
        # planning overwrites its arrays: the padding is cleared only now, and stays clear
        self._field[:] = 0.0

    def __call__(self, field: FloatArray) -> FloatArray:
        """The convolution, same shape as the field."""
        with self._lock:
            self._field[self._filled] = field
            self._forward.execute()
            self._spectrum *= self._symbol
            self._inverse.execute()
            return np.array(self._result[self._filled])
