"""What cases of a wheel over isotropic roughness share: their settings and names.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1.
"""

import math
from dataclasses import dataclass

import numpy as np

from validation.analysis.series import Series
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, jackknifed
from validation.engine.convergence import require_realisations
from validation.simulation.rolling_strip import RoughStrip, Tracks
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine

HEIGHT, SLOPE, Q = "h/d", "h' a/d", "q a"
SLOPE_COUNTS = "h' is the rms slope along the track, in one direction, of all waves"


@dataclass(frozen=True, kw_only=True)
class RollingSettings:
    """A wheel at the approach d over isotropic roughness, contact radius a.

    heights: h_rms / d, ascending; last: q a of the end of the roughness; lowest: q a of the first one-third octave;
    length, width: of the periodic surfaces over a; cells: to a contact radius; strips: realisations of boundary
    elements; tracks: realisations on springs; springs: to a radius; seed: zero or more.
    """

    heights: tuple[float, ...]
    last: float = 10.0
    lowest: float = 0.4
    length: float = 64.0
    width: float = 16.0
    cells: int = 8
    strips: int
    tracks: int
    springs: int = 32
    seed: int = 144

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips)

    @property
    def bands(self) -> Bands:
        """One-third octaves from the lowest to the last, one of them around the first zero of sin(q a)."""
        return Bands.around(math.pi, self.lowest, self.last).on(self.length)

    def rough_strip(self, spectrum: PiecewisePowerLaw, height: float) -> RoughStrip:
        return RoughStrip(spectrum=spectrum, height=height, length=self.length, width=self.width, seed=self.seed)

    def tracks_on(self, scene: RoughStrip, rule: InputSpectrum) -> Tracks:
        return Tracks(
            scene=scene, input_spectrum=rule, realisations=self.tracks, springs=self.springs, bands=self.bands
        )


@dataclass(frozen=True, kw_only=True)
class SelfAffineSettings(RollingSettings):
    """The same over self-affine roughness of that Hurst exponent, q a from first to last."""

    hurst: float = 0.7
    first: float = 1.0

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, self.first, self.last)

    @property
    def slopes(self) -> FloatArray:
        """h' a/d at each height, along the track, of all waves."""
        return self.spectrum.slope_along * np.array(self.heights)


def slopes_of(case: SelfAffineSettings) -> Series:
    """Beside h/d, for those who ask by the slope."""
    return Series(SLOPE, "surface", case.slopes, along=HEIGHT, at=case.heights)


def decibels(pairs: FloatArray) -> FloatArray:
    """Mean level of a model over that of another on the same strips: pairs (strips, 2, bands)."""
    mine, other = pairs.mean(axis=0)
    return np.asarray(POWER_DECIBEL * np.log(mine / other))


def rms_decibels(pairs: FloatArray) -> Estimate:
    """Their root mean square over the bands, with its jackknife."""
    return jackknifed(lambda some: np.asarray(np.sqrt(np.mean(decibels(some) ** 2))), pairs)[0]
