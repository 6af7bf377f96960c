"""Convolution with a real, even kernel by planned FFTs, on buffers that are made once and reused."""

import threading
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bem3d.checks import FloatArray, IndexArray
from bem3d.fftw import import_pyfftw

Planning = Literal["estimate", "measure"]
Shape = tuple[int, int]
ComplexArray = NDArray[np.complex128]
PLANNER = threading.Lock()
"""FFTW has one planner, and one memory of what it has measured, in a process."""


class Convolution(ABC):
    """Circular convolution with an even kernel on a padded grid, read back on the part that was filled.

    shape: the filled part; padded: the grid. Calls from several threads wait for each other, since the buffers are
    shared. planning: "estimate" plans give the same bits in every process, "measure" plans are somewhat faster and do
    not.
    """

    def __init__(self, shape: Shape, padded: Shape):
        self.shape, self.padded = shape, padded

    @abstractmethod
    def __call__(self, field: FloatArray) -> FloatArray:
        """The convolution, same shape as the field."""

    def places(self, cells: IndexArray) -> IndexArray:
        """Where the cells, rising flat indices of the filled part, lie in the padded rows; for `at`."""
        return cells // self.shape[1] * self.padded[1] + cells % self.shape[1]

    @abstractmethod
    def at(self, places: IndexArray, values: FloatArray, out: FloatArray | None = None) -> FloatArray:
        """The convolution of a field that is zero but at these places, read back there alone, into `out` if given."""


class SmallConvolution(Convolution):
    """All rows in one buffer, in one thread."""

    def __init__(self, shape: Shape, padded: Shape):
        super().__init__(shape, padded)
        self._lock = threading.Lock()
        # the padding along the first axis is not stored
        self._rows = aligned((shape[0], padded[1]), np.float64)
        self._flat = self._rows.reshape(-1)

    @abstractmethod
    def _convolve(self) -> None:
        """Convolve the rows in place."""

    def __call__(self, field: FloatArray) -> FloatArray:
        filled = np.s_[:, : self.shape[1]]
        with self._lock:
            self._rows[filled] = field
            self._rows[:, self.shape[1] :] = 0.0
            self._convolve()
            return np.array(self._rows[filled])

    def at(self, places: IndexArray, values: FloatArray, out: FloatArray | None = None) -> FloatArray:
        with self._lock:
            flat = self._flat
            flat.fill(0.0)
            flat[places] = values
            self._convolve()
            # "clip" takes straight into `out`; all places are inside
            return np.asarray(flat.take(places, out=out, mode="clip"))


class PlainConvolution(SmallConvolution):
    """Without padding: two transforms in two dimensions.

    symbol: quadrant of the real Fourier transform of the kernel, shape (shape[0] // 2 + 1, shape[1] // 2 + 1).
    """

    def __init__(self, symbol: FloatArray, *, shape: Shape, planning: Planning):
        super().__init__(shape, shape)
        half = _halfplane(symbol, shape)
        spectrum = aligned(half.shape, np.complex128)
        self._parts, self._symbols = parts(spectrum), np.repeat(half, 2, axis=1)
        self._forward, self._inverse = planned(self._rows, spectrum, (0, 1), planning)

    def _convolve(self) -> None:
        self._forward()
        self._parts *= self._symbols
        self._inverse()


class CachedConvolution(SmallConvolution):
    """With padding, on a grid so small that its spectrum stays in the cache; no row that is zero is transformed.

    symbol: quadrant of the real Fourier transform of the kernel, shape (padded[0] // 2 + 1, padded[1] // 2 + 1).
    """

    def __init__(self, symbol: FloatArray, *, shape: Shape, padded: Shape, planning: Planning):
        super().__init__(shape, padded)
        half = _halfplane(symbol, padded)
        spectrum = aligned(half.shape, np.complex128)
        filled, self._below = spectrum[: shape[0]], spectrum[shape[0] :]
        self._parts, self._symbols = parts(spectrum), np.repeat(half, 2, axis=1)
        self._forward, self._inverse = planned(self._rows, filled, (1,), planning)
        self._down, self._up = planned(spectrum, spectrum, (0,), planning)

    def _convolve(self) -> None:
        self._forward()
        self._below.fill(0.0)
        self._down()
        self._parts *= self._symbols
        self._up()
        self._inverse()


def planned(
    there: FloatArray | ComplexArray, back: FloatArray | ComplexArray, axes: tuple[int, ...], planning: Planning
) -> tuple[Callable[[], None], Callable[[], None]]:
    """The transforms from one array to the other and back; the way back may destroy its input."""
    pyfftw = import_pyfftw()
    flags = (f"FFTW_{planning.upper()}",)
    with PLANNER:
        # what is measured here would change the estimates of others in this process
        known = pyfftw.export_wisdom() if planning == "measure" else None
        forward = pyfftw.FFTW(there, back, axes=axes, flags=flags, threads=1)
        destroying = flags if there is back else (*flags, "FFTW_DESTROY_INPUT")
        inverse = pyfftw.FFTW(back, there, axes=axes, flags=destroying, threads=1, direction="FFTW_BACKWARD")
        if known is not None:
            pyfftw.forget_wisdom()
            pyfftw.import_wisdom(known)
    return forward.execute, inverse.execute


def aligned(shape: Shape, dtype: type[np.float64] | type[np.complex128]) -> NDArray[Any]:
    """Numbers where FFTW is fastest. Its package is imported here alone: that takes longer than all others."""
    return np.asarray(import_pyfftw().empty_aligned(shape, dtype=dtype))


def parts(spectrum: ComplexArray) -> FloatArray:
    """Real and imaginary parts, side by side along the last axis: a product of reals takes a third of the time."""
    return spectrum.view(np.float64)


def _halfplane(quadrant: FloatArray, padded: Shape) -> FloatArray:
    """The symbol of all rows, since it is even, over the points: FFTW's transforms there and back multiply by them."""
    return np.concatenate([quadrant, quadrant[(padded[0] - 1) // 2 : 0 : -1]]) / (padded[0] * padded[1])
