"""The ground of a wheel on a rail: a line spectrum with what lies across it, and strips of it to roll over."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from validation.analysis.nominal_bands import NominalBands
from validation.scenes.measured_lines import MeasuredLines
from validation.scenes.rail import RailScene
from validation.simulation.rail_strip import RailStrip
from validation.theory.line_spectrum import LineSpectrum
from validation.theory.transverse_structure import IsotropicGround, Ridges, TransverseStructure, WaveBand

FloatArray = NDArray[np.float64]
StatedAcross = Literal["ridges", "isotropic"] | float

LONGEST, SHORTEST = 10.0, 0.45
"""Wavelengths over a_x between which strips are rough: longer waves lift the wheel as a whole, shorter ones need cells
of a tenth of a_x and less."""
NEPER_OF_POWER = 10 / math.log(10)
"""Decibels of a natural logarithm of power."""
BAND = 10**0.05 - 10**-0.05
"""Width of a one-third octave over its centre."""
MOST_SMOOTHED, MOST_PASSES = 5 / NEPER_OF_POWER, 256
"""Rms of a line's scatter [Np of power], the same 5 dB as of a single line of four waves, and passes of a mean."""
LENGTH, WIDTH = 60, 12
"""Of a strip, in larger semi-axes at the least."""


def structure_of(across: StatedAcross, line: LineSpectrum) -> TransverseStructure:
    """Raises ValueError where no isotropic surface has such a line."""
    if across == "ridges":
        return Ridges()
    return IsotropicGround(line) if across == "isotropic" else WaveBand(float(across))


def line_of(scene: RailScene) -> LineSpectrum:
    """C_line of the levels of a scene; of measured lines smoothed as little as isotropic ground needs."""
    q, density = scene.levels.nodes
    line = LineSpectrum(tuple(q.tolist()), tuple(density.tolist()))
    scattered = isinstance(scene.roughness, MeasuredLines) and scene.across in ("isotropic", None)
    return smoothed_to_isotropic(line) if scattered else line


@lru_cache(maxsize=64)
def smoothed_to_isotropic(line: LineSpectrum) -> LineSpectrum:
    """The line that an isotropic surface can have, by running means of the level over three bands.

    Bands of a measured line scatter by decibels, and Abel's inverse takes their differences. The line itself where an
    isotropic surface has it, or where smoothing by an rms of `MOST_SMOOTHED` is not enough.
    """
    level, passes = np.log(line.densities), 1
    wanted = level
    while not _is_isotropic(found := LineSpectrum(line.wavenumbers, tuple(np.exp(level).tolist()))):
        for _ in range(passes):
            ends = np.concatenate([level[:1], level, level[-1:]])
            level = (ends[:-2] + 2 * level + ends[2:]) / 4
        passes *= 2
        if np.sqrt(np.mean((level - wanted) ** 2)) > MOST_SMOOTHED or passes > MOST_PASSES:
            return line
    return found


def smoothing(scene: RailScene) -> float:
    """Rms by which a line was smoothed for isotropic ground [dB]."""
    change = np.log(line_of(scene).densities) - np.log(scene.levels.nodes[1])
    return float(NEPER_OF_POWER * np.sqrt(np.mean(change**2)))


def smoothed_error(scene: RailScene) -> float:
    """95 % half-width of A3 that smoothing leaves [dB], zero of a line that needed none.

    Twice the scatter, 10 lg(e) / sqrt(m) dB, of a band of m waves of the lines, where waves are as long as half of the
    contact's circumference.
    """
    if not isinstance(scene.roughness, MeasuredLines) or not smoothing(scene):
        return 0.0
    points, lines = scene.roughness.height.shape
    waves = lines * points * scene.roughness.spacing * BAND / (math.pi * scene.contact.along)
    return 2 * NEPER_OF_POWER / math.sqrt(waves)


def _is_isotropic(line: LineSpectrum) -> bool:
    try:
        IsotropicGround(line)
    except ValueError:
        return False
    return True


@dataclass(frozen=True, kw_only=True)
class RailGround:
    """Waves of a line spectrum between two wavenumbers along and in all directions; a `Ground` of a `RailStrip`."""

    line: LineSpectrum
    across: StatedAcross
    first: float
    last: float

    @property
    def highest(self) -> float:
        """Of oblique waves too."""
        return self.last if isinstance(self.across, str) else self.last * math.hypot(1, self.across)

    def variance(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        """Mean square of waves in cells of sides (dk_x, dk_y) [m^2]."""
        k_x, k_y = np.broadcast_arrays(np.abs(along), np.abs(across))
        k, (dx, dy) = np.hypot(k_x, k_y), steps
        if self.across == "isotropic":
            inside = (k >= self.first) & (k <= self.last)
            density = IsotropicGround(self.line).c2d(np.where(inside, k, self.last)) * dx * dy
        else:
            inside = (k_x >= self.first) & (k_x <= self.last)
            wave = np.where(inside, k_x, self.last)
            if self.across == "ridges":
                density = np.where(k_y == 0, self.line(wave) * dx, 0.0)
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
        ground=RailGround(line=line_of(scene), across=across, first=float(edges[0]), last=float(edges[-1])),
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
    slope_along = strip_bands(scene).slope_of_spectrum(line_of(scene))
    return slope_along * scene.contact.along / scene.contact.approach
