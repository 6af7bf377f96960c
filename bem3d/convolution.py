"""Convolution with a real, even kernel by planned FFTs, on buffers that are made once and reused."""

import math
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bem3d.checks import FloatArray, IndexArray

Planning = Literal["estimate", "measure"]
ComplexArray = NDArray[np.complex128]
PLANNER = threading.Lock()
"""FFTW has one planner, and one memory of what it has measured, in a process."""
COLUMNS_AT_ONCE = 28
"""Columns transformed at a time, at the most: few enough to stay in the cache, forwards, times the symbol, and back.
Rows of 16 or 32 numbers, a power of two apart, would displace each other from the cache; measured."""
CACHED_NUMBERS = 2**16
"""A spectrum of no more numbers stays in the cache as a whole: `CachedConvolution`."""


class Convolution(ABC):
    """Circular convolution with an even kernel on a padded grid, read back on the part that was filled.

    shape: the filled part; padded: the grid; planning: "estimate" plans give the same bits in every process, "measure"
    plans are somewhat faster and do not. One FFT thread. Calls from several threads wait for each other, since the
    buffers are shared.
    """

    def __init__(self, shape: tuple[int, int], padded: tuple[int, int], planning: Planning):
        self.shape, self.padded, self._planning = shape, padded, planning
        self._lock = threading.Lock()
        # the padding along the first axis need not be stored, see PaddedConvolution
        self._rows = _aligned((shape[0], padded[1]), dtype=np.float64)

    def _plan(
        self, there: FloatArray | ComplexArray, back: FloatArray | ComplexArray, axes: tuple[int, ...]
    ) -> tuple[Callable[[], None], Callable[[], None]]:
        """The transforms from one array to the other and back; the way back may destroy its input."""
        import pyfftw

        common = {"axes": axes, "threads": 1}
        flags = (f"FFTW_{self._planning.upper()}",)
        with PLANNER:
            # what is measured here would change the estimates of others in this process
            known = pyfftw.export_wisdom() if self._planning == "measure" else None
            forward = pyfftw.FFTW(there, back, flags=flags, **common)
            destroying = flags if there is back else (*flags, "FFTW_DESTROY_INPUT")
            inverse = pyfftw.FFTW(back, there, flags=destroying, direction="FFTW_BACKWARD", **common)
            if known is not None:
                pyfftw.forget_wisdom()
                pyfftw.import_wisdom(known)
        return forward.execute, inverse.execute

    @abstractmethod
    def _convolve(self) -> None:
        """Convolve the rows in place."""

    def __call__(self, field: FloatArray) -> FloatArray:
        """The convolution, same shape as the field."""
        filled = np.s_[:, : self.shape[1]]
        with self._lock:
            self._rows[filled] = field
            self._rows[:, self.shape[1] :] = 0.0
            self._convolve()
            return np.array(self._rows[filled])

    def places(self, cells: IndexArray) -> IndexArray:
        """Where the cells, flat indices of the filled part, lie in the rows; for `at`."""
        return cells // self.shape[1] * self.padded[1] + cells % self.shape[1]

    def at(self, places: IndexArray, values: FloatArray) -> FloatArray:
        """The convolution of a field that is zero but at these places, read back there alone."""
        with self._lock:
            flat = self._rows.ravel()
            flat[:] = 0.0
            flat[places] = values
            self._convolve()
            return np.asarray(flat[places])


class PlainConvolution(Convolution):
    """Without padding: two transforms in two dimensions.

    symbol: quadrant of the real Fourier transform of the kernel, shape (shape[0] // 2 + 1, shape[1] // 2 + 1).
    """

    def __init__(self, symbol: FloatArray, *, shape: tuple[int, int], planning: Planning):
        super().__init__(shape, shape, planning)
        self._symbol = _halfplane(symbol, shape)
        self._spectrum = _aligned(self._symbol.shape, dtype=np.complex128)
        self._forward, self._inverse = self._plan(self._rows, self._spectrum, (0, 1))

    def _convolve(self) -> None:
        self._forward()
        self._spectrum *= self._symbol
        self._inverse()


class PaddedConvolution(Convolution):
    """With padding: transforms in one dimension, which leave out rows that are zero or not asked for.

    The spectrum of the padded grid never exists as a whole: its columns go forwards, times the symbol, and back, a few
    at a time.

    symbol: quadrant of the real Fourier transform of the kernel, shape (padded[0] // 2 + 1, padded[1] // 2 + 1).
    """

    def __init__(self, symbol: FloatArray, *, shape: tuple[int, int], padded: tuple[int, int], planning: Planning):
        super().__init__(shape, padded, planning)
        whole, columns = _halfplane(symbol, padded), symbol.shape[1]
        at_once = math.ceil(columns / math.ceil(columns / COLUMNS_AT_ONCE))
        blocks = (slice(first, first + at_once) for first in range(0, columns, at_once))
        self._symbols = [(block, np.ascontiguousarray(whole[:, block])) for block in blocks]
        self._spectrum = _aligned((shape[0], columns), dtype=np.complex128)
        self._columns = _aligned((padded[0], at_once), dtype=np.complex128)
        self._forward, self._inverse = self._plan(self._rows, self._spectrum, (1,))
        self._down, self._up = self._plan(self._columns, self._columns, (0,))

    def _convolve(self) -> None:
        self._forward()
        filled = self.shape[0]
        for block, symbol in self._symbols:
            spectrum, columns = self._spectrum[:, block], self._columns[:, : symbol.shape[1]]
            columns[:filled] = spectrum
            columns[filled:] = 0.0
            self._down()
            columns *= symbol
            self._up()
            spectrum[:] = columns[:filled]
        self._inverse()


class CachedConvolution(Convolution):
    """With padding, on a grid so small that its spectrum stays in the cache; no row that is zero is transformed.

    symbol: quadrant of the real Fourier transform of the kernel, shape (padded[0] // 2 + 1, padded[1] // 2 + 1).
    """

    def __init__(self, symbol: FloatArray, *, shape: tuple[int, int], padded: tuple[int, int], planning: Planning):
        super().__init__(shape, padded, planning)
        self._symbol = _halfplane(symbol, padded)
        self._spectrum = _aligned(self._symbol.shape, dtype=np.complex128)
        filled = self._spectrum[: shape[0]]
        self._forward, self._inverse = self._plan(self._rows, filled, (1,))
        self._down, self._up = self._plan(self._spectrum, self._spectrum, (0,))

    def _convolve(self) -> None:
        self._forward()
        self._spectrum[self.shape[0] :] = 0.0
        self._down()
        np.multiply(self._spectrum, self._symbol, out=self._spectrum)
        self._up()
        self._inverse()


def _aligned(shape: tuple[int, int], dtype: type[np.float64] | type[np.complex128]) -> NDArray[Any]:
    """Numbers where FFTW is fastest. Its package is imported here alone: that takes longer than all others."""
    import pyfftw

    return np.asarray(pyfftw.empty_aligned(shape, dtype=dtype))


def _halfplane(quadrant: FloatArray, padded: tuple[int, int]) -> FloatArray:
    """The symbol of all rows, since it is even, over the points: FFTW's transforms there and back multiply by them."""
    return np.concatenate([quadrant, quadrant[(padded[0] - 1) // 2 : 0 : -1]]) / (padded[0] * padded[1])


def padded_convolution(
    symbol: FloatArray, *, shape: tuple[int, int], padded: tuple[int, int], planning: Planning
) -> Convolution:
    """The faster of the two for this grid."""
    small = padded[0] * (padded[1] // 2 + 1) <= CACHED_NUMBERS
    return (CachedConvolution if small else PaddedConvolution)(symbol, shape=shape, padded=padded, planning=planning)
