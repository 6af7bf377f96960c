"""The elastic half-space on a regular grid: pressure in, displacement out."""

from __future__ import annotations

import dataclasses
import threading
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike

from bem3d import kernel
from bem3d.blocked_convolution import BlockedConvolution, SpectrumMemory
from bem3d.checks import FloatArray, OneOrTwo, boolean, count, field, grid_shape, grid_spacing, positive
from bem3d.convolution import CachedConvolution, Convolution, PlainConvolution, Planning
from bem3d.results import pair, span
from bem3d.threads import cores

KEEPING = threading.Lock()
ONE_LEVEL = 512 * 512
"""Cells up to which the preconditioner has no second level."""
BLOCK = 16
"""Cells along a side of the blocks of the second level; the near field reaches half as far."""
GRIDS_KEPT = 4
"""Windows and coarser grids that a half-space keeps ready."""
CACHED_NUMBERS = 2**16
"""A padded spectrum of no more numbers stays in the cache as a whole: `CachedConvolution`."""
CACHED_CELLS = 2**18
"""A grid without padding of no more cells is transformed as a whole: `PlainConvolution`."""


@dataclass(frozen=True, kw_only=True)
class HalfSpace:
    """Frictionless elastic half-space on a regular grid: the operator u = K p.

    Parameters
    ----------
    shape : tuple of int
        Cells (nx, ny).
    spacing : float or tuple of float
        Sides of a cell, one number or (dx, dy) [m].
    modulus : float
        Contact modulus E* [Pa].
    periodic : bool, optional
        Whether the surface repeats beyond the grid. By default it is free space.
    planning : {"estimate", "measure"}, optional
        Plans of the FFT: equal bits in every process, or faster transforms.
    threads : int or "all", optional
        Threads that share out the transforms of large grids, at the most; "all" is one for each core that this process
        may use. They change no bit of an estimated plan.

    Raises
    ------
    ValueError, TypeError
        If an argument is out of range; the message names it.

    Notes
    -----
    The pressure is constant on each cell. Free space: u(x, y) = p / (pi E*) int dA' / r for each cell, by Love [1]_,
    convolved on a grid of at least 2n - 1 points a side. Periodic: u(q) = 2 p(q) / (E* q), with a mean displacement
    of zero, so that u counts from the mean plane. A half-space is immutable, comparable and may be pickled; plans are
    made at the first use and kept.

    References
    ----------
    .. [1] Love, Phil. Trans. R. Soc. A 228 (1929); Johnson, Contact Mechanics, chapter 3.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(64, 64), spacing=1e-5, modulus=1e11)
    >>> u = body.displacement(np.full(body.shape, 1e6))
    >>> print(f"{u.max():.3g} m in the middle, {u.min():.3g} m at a corner")
    7.18e-09 m in the middle, 3.8e-09 m at a corner
    """

    shape: tuple[int, int]
    spacing: OneOrTwo
    modulus: float
    periodic: bool = False
    planning: Planning = "estimate"
    threads: int | Literal["all"] = dataclasses.field(default=1, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "shape", grid_shape(self.shape))
        object.__setattr__(self, "spacing", grid_spacing(self.spacing))
        object.__setattr__(self, "modulus", positive("modulus", self.modulus))
        boolean("periodic", self.periodic)
        if self.planning not in ("estimate", "measure"):
            raise ValueError(f'planning must be "estimate" or "measure", got {self.planning!r}')
        if self.threads != "all":
            object.__setattr__(self, "threads", count('threads, unless "all",', self.threads))

    def __repr__(self) -> str:
        cells, planning = (
            " x ".join(map(str, self.shape)),
            f", planning={self.planning!r}" * (self.planning != "estimate"),
        )
        more = ", periodic" * self.periodic + planning + f", threads={self.threads}" * (self.threads != 1)
        return f"HalfSpace({cells} cells of {pair('m', *self.steps)}, modulus={span(self.modulus, 'Pa')}{more})"

    def displacement(self, pressure: ArrayLike) -> FloatArray:
        """Displacement under a pressure: one application of the operator.

        Parameters
        ----------
        pressure : array_like, shape of the half-space
            Pressure on each cell, of any sign [Pa].

        Returns
        -------
        ndarray, shape of the half-space
            Displacement into the half-space at the centres of the cells [m].

        Raises
        ------
        ValueError, TypeError
            If the pressure has another shape, or is not finite.
        """
        return self.apply(field("pressure", pressure, self.shape))

    def apply(self, pressure: FloatArray) -> FloatArray:
        """`displacement` of a pressure that is known to be valid: the operator of the solvers."""
        return self.convolution(pressure)

    @property
    def steps(self) -> tuple[float, float]:
        """Spacing along both axes (dx, dy) [m]."""
        dx, dy = self.spacing  # type: ignore[misc]
        return dx, dy

    @property
    def cell_area(self) -> float:
        """dx dy [m^2]."""
        return self.steps[0] * self.steps[1]

    @cached_property
    def self_compliance(self) -> float:
        """Displacement at the centre of a cell under unit pressure on it alone [m/Pa]."""
        if self.periodic:
            lone = np.zeros(self.shape)
            lone[0, 0] = 1.0
            return float(self.apply(lone)[0, 0])
        return float(kernel.love(0.0, 0.0, *self.steps)) / (np.pi * self.modulus)

    @cached_property
    def convolution(self) -> Convolution:
        """Pressure to displacement, u = K p."""
        if self.periodic:
            symbol = kernel.periodic_symbol(self.shape, self.steps, self.modulus)
            return self._convolution(symbol, self.shape, self.shape)
        padded = _doubled(self.shape[0]), _doubled(self.shape[1])
        table = kernel.love_table((padded[0] // 2 + 1, padded[1] // 2 + 1), self.steps[1] / self.steps[0])
        symbol = kernel.free_space_symbol(table, self.steps, self.modulus)
        return self._convolution(symbol, self.shape, padded)

    @cached_property
    def inverse(self) -> Convolution:
        """Displacement to pressure, nearly: the preconditioner of the solvers, without padding."""
        symbol = kernel.inverse_symbol(self.shape, self.steps, self.modulus, self.near_wave)
        return self._convolution(symbol, self.shape, self.shape)

    def _convolution(self, symbol: FloatArray, shape: tuple[int, int], padded: tuple[int, int]) -> Convolution:
        """The fastest for this grid."""
        if padded == shape and padded[0] * padded[1] <= CACHED_CELLS:
            return PlainConvolution(symbol, shape=shape, planning=self.planning)
        if padded != shape and padded[0] * (padded[1] // 2 + 1) <= CACHED_NUMBERS:
            return CachedConvolution(symbol, shape=shape, padded=padded, planning=self.planning)
        threads = cores() if self.threads == "all" else self.threads
        return BlockedConvolution(
            symbol, shape=shape, padded=padded, planning=self.planning, threads=threads, memory=self._memory
        )

    @property
    def has_far_field(self) -> bool:
        """Whether the preconditioner has a second level: on grids that are large enough to gain by it."""
        return self.shape[0] * self.shape[1] > ONE_LEVEL

    @property
    def near_wave(self) -> float:
        """q_c, below which the preconditioner leaves waves to the far field; without one q_0 [rad/m]."""
        if self.has_far_field:
            return 2 / (BLOCK * max(self.steps))
        sides = (n * step for n, step in zip(self.shape, self.steps, strict=True))
        return kernel.WAVE_OF_UNIFORM_PRESSURE * 2 * np.pi / max(sides)

    @cached_property
    def far(self) -> Convolution:
        """Sums of pressure over blocks of cells to the far field of the displacement, on the blocks."""
        blocks = -(-self.shape[0] // BLOCK), -(-self.shape[1] // BLOCK)
        steps = self.shape[0] / blocks[0] * self.steps[0], self.shape[1] / blocks[1] * self.steps[1]
        if self.periodic:
            symbol = kernel.far_periodic_symbol(blocks, steps, self.modulus, self.near_wave)
            symbol *= self.cell_area / (steps[0] * steps[1])
            return self._convolution(symbol, blocks, blocks)
        padded = _doubled(blocks[0]), _doubled(blocks[1])
        table = kernel.far_table((padded[0] // 2 + 1, padded[1] // 2 + 1), steps, self.near_wave)
        symbol = kernel.free_space_symbol(table, (self.cell_area, 0.0), self.modulus)
        return self._convolution(symbol, blocks, padded)

    def like(self, *, shape: tuple[int, int], spacing: OneOrTwo | None = None) -> HalfSpace:
        """Half-space of the same material on another grid. The last few are kept, with their plans."""
        grid = shape, self.steps if spacing is None else spacing
        if grid == (self.shape, self.steps):
            return self
        with KEEPING:
            kept = self._relatives.pop(grid, None) or replace(self, shape=shape, spacing=grid[1])
            self._relatives[grid] = kept
            while len(self._relatives) > GRIDS_KEPT:
                del self._relatives[next(iter(self._relatives))]
        return kept

    def release(self, relative: HalfSpace) -> None:
        """Keep a relative no longer, if it is so large that its plans cost less than their memory."""
        if relative.shape[0] * relative.shape[1] > CACHED_CELLS:
            with KEEPING:
                self._relatives.pop((relative.shape, relative.spacing), None)

    @cached_property
    def _memory(self) -> SpectrumMemory:
        return SpectrumMemory()

    @cached_property
    def _relatives(self) -> dict[tuple[tuple[int, int], OneOrTwo], HalfSpace]:
        return {}

    def __reduce__(self) -> tuple[Any, ...]:
        # plans and buffers belong to one process
        settings = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return partial(HalfSpace, **settings), ()


def _doubled(points: int) -> int:
    """An even and fast FFT length without images: at least 2n - 1."""
    return 2 * int(scipy.fft.next_fast_len(points))
