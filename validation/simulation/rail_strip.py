"""A rough strip of rail under a wheel of constant load: one realisation, its waves, and its line roughness.

Units: metres, newtons, pascals; wavenumbers in rad/m, x along the track.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands
from validation.engine.random_numbers import random_generator
from validation.simulation.surface import draw_surface
from validation.theory.elliptic_contact import EllipticContact, elliptic_contact

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Transfer = Callable[[FloatArray, FloatArray], FloatArray]
"""H(k_x, k_y), from the height of a wave to that of the result."""

STRIPS = 5
"""Key of the random numbers."""


class Ground(Protocol):
    """The waves of a rough rail; a frozen dataclass of plain values."""

    def variance(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        """Mean square of the waves in a cell of sides (dk_x, dk_y) around (k_x, k_y), of the whole plane [m^2]."""

    @property
    def highest(self) -> float:
        """Wavenumber |k| beyond which there is no wave."""


@dataclass(frozen=True, kw_only=True)
class RailStrip:
    """One realisation of a rough strip, and the wheel that rolls along its middle under a constant force.

    ground: its waves; radii: along and across, both bodies together [m]; force [N]; modulus: E* [Pa]; length, width: of
    the periodic strip, whole numbers of cells [m]; spacing: side of a cell [m]; realisation, seed: zero or positive.
    """

    ground: Ground
    radii: tuple[float, float]
    force: float
    modulus: float
    length: float
    width: float
    spacing: float
    realisation: int
    seed: int

    def __post_init__(self) -> None:
        for name in ("length", "width"):
            cells = getattr(self, name) / self.spacing
            if abs(cells - round(cells)) > 1e-6:
                raise ValueError(f"{name} must be a whole number of cells, got {cells:g}")

    @cached_property
    def contact(self) -> EllipticContact:
        """Of the smooth wheel."""
        return elliptic_contact(self.radii, modulus=self.modulus, force=self.force)

    @property
    def shape(self) -> tuple[int, int]:
        return round(self.length / self.spacing), round(self.width / self.spacing)

    @cached_property
    def variance(self) -> FloatArray:
        """Mean square of each wave of `wavenumbers` [m^2]."""
        steps = 2 * math.pi / self.length, 2 * math.pi / self.width
        return self.ground.variance(*wavenumbers(self.shape, self.spacing), steps)

    @cached_property
    def surface(self) -> FloatArray:
        """Heights at the centres of the cells; the same surface on every grid.

        Waves of equal power and random phases, each times the root of its variance.
        """
        highest = self.ground.highest * (1 + 1e-9)
        white = draw_surface(
            lambda q: np.where(q <= highest, 1.0, 0.0),
            shape=self.shape,
            spacing=self.spacing,
            rng=random_generator(self.seed, STRIPS, self.realisation),
        )
        amplitude = np.sqrt(self.variance * self.length * self.width) / (2 * math.pi)
        return np.asarray(np.fft.ifft2(amplitude * np.fft.fft2(white)).real)

    @cached_property
    def _waves(self) -> ComplexArray:
        return np.fft.fft2(self.surface)

    def along_middle(self, transfer: Transfer) -> FloatArray:
        """The surface filtered by H(k_x, k_y), along the middle of axis 1, less its mean [m]."""
        along, across = wavenumbers(self.shape, self.spacing)
        ny = self.shape[1]
        filtered = transfer(along, across) * self._waves
        track = np.fft.ifft(filtered @ np.exp(0.5j * (ny - 1) * self.spacing * across[0]) / ny).real
        return np.asarray(track - track.mean())

    def expected_power(self, transfer: Transfer, bands: Bands) -> FloatArray:
        """Band powers of `along_middle` in the mean of all realisations [m^2].

        Of positive k_x alone, as `analysis.spectra.levels`.
        """
        along, across = wavenumbers(self.shape, self.spacing)
        power = np.sum(transfer(along, across) ** 2 * self.variance, axis=1)
        return np.asarray(bands.sums(along[:, 0], power).real)


def wavenumbers(shape: tuple[int, int], spacing: float) -> tuple[FloatArray, FloatArray]:
    """k_x (nx, 1) and k_y (1, ny) of the waves of a grid."""
    along, across = (np.asarray(2 * np.pi * np.fft.fftfreq(n, spacing)) for n in shape)
    return along[:, np.newaxis], across[np.newaxis, :]
