"""The elastic half-space on a regular grid: pressure in, displacement out."""

from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from bem3d import kernel
from bem3d.border import FloatArray, field, grid_shape, grid_spacing, positive
from bem3d.convolution import Convolution, Planning


@dataclass(frozen=True, kw_only=True)
class HalfSpace:
    """Frictionless elastic half-space under piecewise-constant pressure: u = K p.

    Free space: Love kernel, convolved on a grid of at least 2n - 1 points a side. Periodic: symbol 2 / (E* q), with
    the mean displacement set to zero, so that u is measured from the mean plane.

    shape: cells (nx, ny); spacing: of the cells, one number or (dx, dy) [m]; modulus: E* [Pa];
    planning: "estimate" (equal bits in every process) or "measure" (faster transforms).
    Immutable, comparable, may be pickled; FFT plans are made at the first use and kept.
    Raises ValueError naming the argument that is out of range.
    """

    shape: tuple[int, int]
    spacing: float | tuple[float, float]
    modulus: float
    periodic: bool = False
    planning: Planning = "estimate"

    def __post_init__(self) -> None:
        object.__setattr__(self, "shape", grid_shape(self.shape))
        object.__setattr__(self, "spacing", grid_spacing(self.spacing))
        object.__setattr__(self, "modulus", positive("modulus", self.modulus))
        if not isinstance(self.periodic, (bool, np.bool_)):
            raise TypeError(f"periodic must be True or False, got {self.periodic!r}")
        if self.planning not in ("estimate", "measure"):
            raise ValueError(f'planning must be "estimate" or "measure", got {self.planning!r}')

    def displacement(self, pressure: ArrayLike) -> FloatArray:
        """u = K p, one operator application.

        pressure: shape of the half-space, of any sign [Pa]. Returns the displacement into the half-space at the
        cell centres, same shape [m]. Raises ValueError for a wrong shape, NaN or infinities.
        """
        return self.apply(field("pressure", pressure, self.shape))

    def apply(self, pressure: FloatArray) -> FloatArray:
        """`displacement` of a pressure that is known to be in order: the operator of the solvers."""
        return self._convolve(pressure)

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
            return float(fft.irfft2(kernel.periodic_symbol(self.shape, self.steps, self.modulus), self.shape)[0, 0])
        return float(kernel.love(0.0, 0.0, *self.steps)) / (np.pi * self.modulus)

    @cached_property
    def _convolve(self) -> Convolution:
        if self.periodic:
            symbol, padded = kernel.periodic_symbol(self.shape, self.steps, self.modulus), self.shape
        else:
            padded = (_doubled(self.shape[0]), _doubled(self.shape[1]))
            symbol = kernel.free_space_symbol(padded, self.steps, self.modulus)
        return Convolution(symbol, shape=self.shape, padded=padded, planning=self.planning)

    def __reduce__(self) -> tuple[Any, ...]:
        # plans and buffers belong to one process
        settings = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return partial(HalfSpace, **settings), ()


def _doubled(points: int) -> int:
    """The smallest fast FFT length without images: at least 2n - 1."""
    return int(fft.next_fast_len(2 * points - 1, real=True))
