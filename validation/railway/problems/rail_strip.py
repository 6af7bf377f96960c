"""A rough rail under a wheel: its ground by a line spectrum and what lies across, strips of it, and lines along them.

Units: metres, newtons, pascals; wavenumbers in rad/m, x along the track.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import NominalBands
from validation.engine.engine import FloatArray
from validation.engine.realisations import random_generator
from validation.railway.scenes.rail import RailScene
from validation.railway.theory.transverse_structure import (
    BandedStructure,
    IsotropicGround,
    LineSpectrum,
    Ridges,
    TransverseStructure,
    WaveBand,
)
from validation.simulation.surface import draw_surface
from validation.theory.half_space import EllipticContact, elliptic_contact

ComplexArray = NDArray[np.complex128]
Transfer = Callable[[FloatArray, FloatArray], FloatArray]
"""H(k_x, k_y), from the height of a wave to that of the result."""

OneAcross = Literal["ridges", "isotropic"] | float


@dataclass(frozen=True)
class LateralBands:
    """Another lateral structure in each band, as it was measured. edges: ascending, (bands + 1,) [rad/m]; across."""

    edges: tuple[float, ...]
    across: tuple[OneAcross, ...]


StatedAcross = OneAcross | LateralBands

LONGEST, SHORTEST = 10.0, 0.45
"""Wavelengths over a_x between which strips are rough: longer waves lift the wheel as a whole, shorter ones need cells
of a tenth of a_x and less."""
LENGTH, WIDTH = 60, 12
"""Of a strip, in larger semi-axes at the least."""
STRIPS = 5
"""Key of the random numbers."""


def structure_of(across: StatedAcross, line: LineSpectrum) -> TransverseStructure:
    """Raises ValueError where no isotropic surface has such a line."""
    if isinstance(across, LateralBands):
        own = {name: structure_of(name, line) for name in set(across.across)}
        return BandedStructure(across.edges, tuple(own[name] for name in across.across))
    if across == "ridges":
        return Ridges()
    return IsotropicGround(line) if across == "isotropic" else WaveBand(float(across))


def uniform_parts(across: StatedAcross, edges: FloatArray) -> list[tuple[OneAcross, FloatArray]]:
    """Edges of bands that have one lateral structure: all together, or a band each as it was measured."""
    if not isinstance(across, LateralBands):
        return [(across, edges)]
    numbers = np.clip(np.searchsorted(across.edges, edges[:-1] * (1 + 1e-9), side="right") - 1, 0, None)
    return [(across.across[n], edges[i : i + 2]) for i, n in enumerate(np.minimum(numbers, len(across.across) - 1))]


def line_of(scene: RailScene) -> LineSpectrum:
    """C_line of the levels of a scene; where its ground may be isotropic, the nearest that isotropic ground has."""
    return scene.isotropic.line if scene.isotropic is not None else scene.levels.c_line


@dataclass(frozen=True, kw_only=True)
class RailGround:
    """Waves of a line spectrum between two wavenumbers along and in all directions.

    line: of isotropic ground or of a band of waves; with_peaks: with what stands out of isotropic ground, as ridges;
    None for the line itself.
    """

    line: LineSpectrum
    across: StatedAcross
    first: float
    last: float
    with_peaks: LineSpectrum | None = None

    @property
    def parts(self) -> list["RailGround"]:
        """Grounds of one lateral structure, a band each where these differ."""
        if not isinstance(self.across, LateralBands):
            return [self]
        bands = zip(self.across.across, pairwise(self.across.edges), strict=True)
        inside = [(own, max(a, self.first), min(b, self.last)) for own, (a, b) in bands]
        return [replace(self, across=own, first=a, last=b) for own, a, b in inside if a < b]

    @property
    def highest(self) -> float:
        """Of oblique waves too."""
        if isinstance(self.across, LateralBands):
            return max(part.highest for part in self.parts)
        return self.last if isinstance(self.across, str) else self.last * math.hypot(1, self.across)

    def variance(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        """Mean square of waves in cells of sides (dk_x, dk_y) [m^2]."""
        if isinstance(self.across, LateralBands):
            return self._variance_of_parts(along, across, steps)
        k_x, k_y = np.broadcast_arrays(np.abs(along), np.abs(across))
        k, (dx, dy) = np.hypot(k_x, k_y), steps
        inside = (k_x >= self.first) & (k_x <= self.last)
        wave = np.where(inside, k_x, self.last)
        on_ridges = np.where(k_y == 0, (self.with_peaks or self.line)(wave) * dx, 0.0)
        if self.across == "isotropic":
            round_about = (k >= self.first) & (k <= self.last)
            density = IsotropicGround(self.line).c2d(np.where(round_about, k, self.last)) * dx * dy
            more = np.where(inside & (k_y == 0), np.maximum(on_ridges - self.line(wave) * dx, 0.0), 0.0)
            return np.asarray(np.where(round_about, density, 0.0) + more)
        if self.across == "ridges":
            density = on_ridges
        else:
            density = WaveBand(float(self.across)).density(wave, k_y, self.line) * dx * dy
        return np.asarray(np.where(inside, density, 0.0))

    def _variance_of_parts(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        """By the band of k_x; isotropic ground has all of its waves there."""
        k_x, k_y = np.broadcast_arrays(np.abs(along), np.abs(across))
        total = np.zeros(k_x.shape)
        for part in self.parts:
            inside = (k_x >= part.first) & ((k_x < part.last) | (part.last == self.last))
            own = replace(part, first=self.first, last=self.last)
            total[inside] = own.variance(k_x[inside], k_y[inside], steps)
        return total


@dataclass(frozen=True, kw_only=True)
class RailStrip:
    """One realisation of a rough strip, and the wheel that rolls along its middle under a constant force.

    ground: its waves; radii: along and across, both bodies together [m]; force [N]; modulus: E* [Pa]; length, width: of
    the periodic strip, whole numbers of cells [m]; spacing: side of a cell [m]; realisation, seed: zero or positive.
    """

    ground: RailGround
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
        rng = random_generator(self.seed, STRIPS, self.realisation)
        draw = partial(draw_surface, shape=self.shape, spacing=self.spacing, rng=rng)
        white = draw(lambda q: np.where(q <= highest, 1.0, 0.0))
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


def wavenumbers(shape: tuple[int, int], spacing: float) -> tuple[FloatArray, FloatArray]:
    """k_x (nx, 1) and k_y (1, ny) of the waves of a grid."""
    along, across = (np.asarray(2 * np.pi * np.fft.fftfreq(n, spacing)) for n in shape)
    return along[:, np.newaxis], across[np.newaxis, :]


def strip_bands(scene: RailScene) -> NominalBands:
    """The bands of its levels that a strip has."""
    a_x = scene.contact.along
    return scene.levels.bands.within(LONGEST * a_x, SHORTEST * a_x)


def positions_along(scene: RailScene, cells: int) -> int:
    """Of a strip with so many cells to the smaller semi-axis."""
    return cells * _sides_of_strip(scene)[0]


def _sides_of_strip(scene: RailScene) -> tuple[int, int]:
    """Length and width over the smaller semi-axis."""
    smaller, larger = sorted(scene.contact.semi_axes)
    return math.ceil(LENGTH * larger / smaller), math.ceil(WIDTH * larger / smaller)


def strip_of(scene: RailScene, across: StatedAcross, cells: int, realisation: int, seed: int) -> RailStrip:
    """One realisation with so many cells to the smaller semi-axis; the same surface on every grid."""
    first, last = strip_bands(scene).edges[[0, -1]].tolist()
    with_peaks = None if scene.isotropic is None else scene.isotropic.with_peaks
    unit = min(scene.contact.semi_axes)
    length, width = (sides * unit for sides in _sides_of_strip(scene))
    return RailStrip(
        ground=RailGround(line=line_of(scene), with_peaks=with_peaks, across=across, first=first, last=last),
        radii=scene.radii,
        force=scene.load,
        modulus=scene.modulus,
        length=length,
        width=width,
        spacing=unit / cells,
        realisation=realisation,
        seed=seed,
    )


def lost_contact_number(scene: RailScene) -> float:
    """h' a_x / d [-], h' the rms slope along the track of the waves that a strip has, `strip_bands`."""
    as_given = scene.levels.c_line
    slope_along = strip_bands(scene).slope_of_spectrum(as_given)
    return slope_along * scene.contact.along / scene.contact.approach


def lines_across(count: int, spacing: float) -> tuple[float, ...]:
    """Their places about the middle [m]."""
    return tuple((i - (count - 1) / 2) * spacing for i in range(count))


def mean_of_lines(places: tuple[float, ...]) -> Transfer:
    """H = mean of cos(k_y y_j) over lines that lie symmetrically about the middle: of their heights."""
    return lambda along, across: np.mean([np.cos(across * place) for place in places], axis=0) + 0 * along
