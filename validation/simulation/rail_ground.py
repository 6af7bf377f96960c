"""The ground of a wheel on a rail: a line spectrum with what lies across it, and strips of it to roll over."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from validation.analysis.nominal_bands import NominalBands
from validation.scenes.rail import RailScene
from validation.simulation.rail_strip import RailStrip
from validation.theory.line_spectrum import LineSpectrum
from validation.theory.transverse_structure import IsotropicGround, Ridges, TransverseStructure, WaveBand

FloatArray = NDArray[np.float64]
StatedAcross = Literal["ridges", "isotropic"] | float

LONGEST, SHORTEST = 10.0, 0.45
"""Wavelengths over a_x between which strips are rough: longer waves lift the wheel as a whole, shorter ones need cells
of a tenth of a_x and less."""
LENGTH, WIDTH = 60, 12
"""Of a strip, in larger semi-axes at the least."""


def structure_of(across: StatedAcross, line: LineSpectrum) -> TransverseStructure:
    """Raises ValueError where no isotropic surface has such a line."""
    if across == "ridges":
        return Ridges()
    return IsotropicGround(line) if across == "isotropic" else WaveBand(float(across))


def line_of(scene: RailScene) -> LineSpectrum:
    """C_line of the levels of a scene; where its ground may be isotropic, the nearest that isotropic ground has."""
    return scene.isotropic.line if scene.isotropic is not None else LineSpectrum.through(*scene.levels.nodes)


@dataclass(frozen=True, kw_only=True)
class RailGround:
    """Waves of a line spectrum between two wavenumbers along and in all directions; a `Ground` of a `RailStrip`.

    line: of isotropic ground or of a band of waves; whole: with what stands out of isotropic ground, as ridges, None
    for the line itself.
    """

    line: LineSpectrum
    across: StatedAcross
    first: float
    last: float
    whole: LineSpectrum | None = None

    @property
    def highest(self) -> float:
        """Of oblique waves too."""
        return self.last if isinstance(self.across, str) else self.last * math.hypot(1, self.across)

    def variance(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        """Mean square of waves in cells of sides (dk_x, dk_y) [m^2]."""
        k_x, k_y = np.broadcast_arrays(np.abs(along), np.abs(across))
        k, (dx, dy) = np.hypot(k_x, k_y), steps
        inside = (k_x >= self.first) & (k_x <= self.last)
        wave = np.where(inside, k_x, self.last)
        on_ridges = np.where(k_y == 0, (self.whole or self.line)(wave) * dx, 0.0)
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


def strip_bands(scene: RailScene) -> NominalBands:
    """The bands of its levels that a strip has."""
    a_x = scene.contact.along
    return scene.levels.bands.within(LONGEST * a_x, SHORTEST * a_x)


def positions_along(scene: RailScene, cells: int) -> int:
    """Of a strip with so many cells to the smaller semi-axis."""
    return cells * _sides_of_strip(scene)[0]


def _sides_of_strip(scene: RailScene) -> tuple[int, int]:
    """Length and width over the smaller semi-axis."""
    smaller, larger = sorted((scene.contact.along, scene.contact.across))
    return math.ceil(LENGTH * larger / smaller), math.ceil(WIDTH * larger / smaller)


def strip_of(scene: RailScene, across: StatedAcross, cells: int, realisation: int, seed: int) -> RailStrip:
    """One realisation with so many cells to the smaller semi-axis; the same surface on every grid."""
    contact, edges = scene.contact, strip_bands(scene).edges
    unit = min(contact.along, contact.across)
    length, width = (sides * unit for sides in _sides_of_strip(scene))
    return RailStrip(
        ground=RailGround(
            line=line_of(scene),
            whole=None if scene.isotropic is None else scene.isotropic.whole,
            across=across,
            first=float(edges[0]),
            last=float(edges[-1]),
        ),
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
    as_given = LineSpectrum.through(*scene.levels.nodes)
    slope_along = strip_bands(scene).slope_of_spectrum(as_given)
    return slope_along * scene.contact.along / scene.contact.approach
