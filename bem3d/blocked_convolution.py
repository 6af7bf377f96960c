"""Convolution on grids that no cache holds: rows and columns go through it in blocks, which threads share out."""

import math
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from bem3d.checks import FloatArray, IndexArray
from bem3d.convolution import ComplexArray, Convolution, Planning, Shape, aligned, planned
from bem3d.threads import share

COLUMNS_AT_ONCE = 26
"""Columns transformed at a time, at the most: few enough to stay in the cache, forwards, times the symbol, and back.
Their rows must not lie a whole number of cache lines apart, or they displace each other: on estimated plans a column of
16384 takes 14 ns a number by 28 at a time, and 9 ns by 13, 14, 18, 22, 26, 27 or 30; with 16500 it takes 11 ns by any.
CPU time there and back, the least of 25 runs. So a power of two needs no other length in its place."""
LEAST_AT_ONCE = 2000
"""Numbers of these columns, at the least: a long and narrow grid would have many blocks of few numbers."""
NUMBERS_AT_ONCE = 2**16
"""Numbers of the padded rows that are transformed at a time, at the most."""

Part = tuple[Any, slice]
"""Where numbers of a block of rows stand in its buffer, and where among the values."""


class SpectrumMemory:
    """Complex numbers for the spectra of convolutions that wait for each other."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self._numbers = np.empty(0, dtype=np.complex128)

    def array(self, shape: tuple[int, int, int]) -> ComplexArray:
        """Numbers of this shape and any value."""
        size = math.prod(shape)
        if self._numbers.size < size:
            self._numbers = np.empty(size, dtype=np.complex128)
        return self._numbers[:size].reshape(shape)


class BlockedConvolution(Convolution):
    """Transforms in one dimension, which leave out rows of the padding; the padded grid never exists as a whole.

    The spectrum of the filled rows lies block of columns by block of columns. Each block goes forwards, times the
    symbol, and back in one buffer. The grid alone fixes the blocks, so that the bits are equal for any threads.

    symbol: quadrant of the real Fourier transform of the kernel, shape (padded[0] // 2 + 1, padded[1] // 2 + 1);
    threads: at the most; memory: of the spectrum, which other convolutions may share.
    """

    def __init__(
        self,
        symbol: FloatArray,
        *,
        shape: Shape,
        padded: Shape,
        planning: Planning,
        threads: int,
        memory: SpectrumMemory,
    ):
        super().__init__(shape, padded)
        self._row_blocks = blocks(shape[0], max(NUMBERS_AT_ONCE // padded[1], 1))
        column_blocks = blocks(symbol.shape[1], max(COLUMNS_AT_ONCE, LEAST_AT_ONCE // padded[0]))
        # the last block may have fewer columns: its others are zero
        self._symbols = np.zeros((len(column_blocks), symbol.shape[0], column_blocks[0].stop))
        for block, quadrant in zip(column_blocks, self._symbols, strict=True):
            np.divide(symbol[:, block], padded[0] * padded[1], out=quadrant[:, : symbol[:, block].shape[1]])
        count, _, width = self._symbols.shape
        self._memory, rows = memory, self._row_blocks[0].stop
        self._buffers = [_Buffers(padded, rows, count, width, planning) for _ in range(min(threads, count))]

    def __call__(self, field: FloatArray) -> FloatArray:
        return self._convolve(field, lambda block: (np.s_[: block.stop - block.start, : self.shape[1]], block))

    def at(self, places: IndexArray, values: FloatArray, out: FloatArray | None = None) -> FloatArray:
        def of(block: slice) -> Part:
            first, end = block.start * self.padded[1], block.stop * self.padded[1]
            part = slice(*np.searchsorted(places, (first, end)))
            return places[part] - first, part

        return self._convolve(values, of, out)

    def _convolve(self, values: FloatArray, of: Callable[[slice], Part], out: FloatArray | None = None) -> FloatArray:
        """Values of the whole field, or in one dimension of some cells; of: those of a block of rows."""
        result = np.empty(values.shape) if out is None else out
        count, _, width = self._symbols.shape
        view = (-1,) if values.ndim == 1 else self._buffers[0].rows.shape

        def forward(buffers: _Buffers, block: slice) -> None:
            inside, part = of(block)
            buffers.rows[:] = 0.0
            buffers.rows.reshape(view)[inside] = values[part]
            buffers.forward()
            spectrum[:, block] = buffers.by_columns[:, : block.stop - block.start]

        def back(buffers: _Buffers, block: slice) -> None:
            (inside, part), rows = of(block), block.stop - block.start
            buffers.by_columns[:, :rows] = spectrum[:, block]
            # what is transformed again and again would grow without bound
            buffers.by_columns[:, rows:] = 0.0
            buffers.back()
            result[part] = buffers.rows.reshape(view)[inside]

        with self._memory.lock:
            spectrum = self._memory.array((count, self.shape[0], width))
            share(forward, self._row_blocks, self._buffers)
            share(self._multiply, list(zip(spectrum, self._symbols, strict=True)), self._buffers)
            share(back, self._row_blocks, self._buffers)
        return result

    def _multiply(self, buffers: "_Buffers", block: tuple[ComplexArray, FloatArray]) -> None:
        """A block of columns forwards, times the symbol, and back."""
        columns, (spectrum, quadrant), filled = buffers.columns, block, self.shape[0]
        columns[:filled] = spectrum
        columns[filled:] = 0.0
        buffers.down()
        columns[: len(quadrant)] *= quadrant
        columns[len(quadrant) :] *= quadrant[(self.padded[0] - 1) // 2 : 0 : -1]
        buffers.up()
        spectrum[:] = columns[:filled]


class _Buffers:
    """What a thread transforms: rows and their spectrum, in place a block of columns."""

    def __init__(self, padded: Shape, rows: int, count: int, width: int, planning: Planning):
        self.rows = aligned((rows, padded[1]), np.float64)
        spectrum = aligned((rows, count * width), np.complex128)
        spectrum[:] = 0.0
        self.by_columns = spectrum.reshape(rows, count, width).swapaxes(0, 1)
        self.columns = aligned((padded[0], width), np.complex128)
        self.forward, self.back = planned(self.rows, spectrum[:, : padded[1] // 2 + 1], (1,), planning)
        self.down, self.up = planned(self.columns, self.columns, (0,), planning)


def blocks(length: int, most: int) -> list[slice]:
    """Equal parts, but for the last, of so many at the most."""
    part = math.ceil(length / math.ceil(length / most))
    return [slice(first, min(first + part, length)) for first in range(0, length, part)]
