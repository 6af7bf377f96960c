"""Rolling over isotropic roughness: the force along the track by boundary elements, springs and linear theory."""

import math
from dataclasses import dataclass

from validation.analysis.spectra import Bands
from validation.engine.convergence import require_realisations
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rolling_strip import RoughStrip, Strip, Tracks, roll_strips, roll_tracks, strip_levels
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine

INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "rolling")
ROUGH = 0.3
"""h/d from which on linear theory on the same surface no longer removes the scatter."""


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
class ForceSpectrum(RollingSettings):
    """Self-affine roughness, q a from first to last.

    hurst; rough_strips: realisations where h/d is ROUGH or more; refined: how many of them are rolled again on cells
    half as wide.
    """

    hurst: float = 0.7
    heights: tuple[float, ...] = (0.01, 0.1, 1.0)
    first: float = 1.0
    strips: int = 6
    rough_strips: int = 6
    refined: int = 6
    tracks: int = 60

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips, rough_strips=self.rough_strips, refined=self.refined)

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, self.first, self.last)

    def strips_of(self, height: float, cells: int) -> list[Strip]:
        """On one grid. The lower the roughness, the less the force fluctuates and the smaller the tolerance."""
        strips = self.rough_strips if height >= ROUGH else self.strips
        count = strips if cells == self.cells else min(self.refined, strips)
        return self.rough_strip(self.spectrum, height).strips(cells, 1e-4 * height, count)


@dataclass(frozen=True)
class RollingResult:
    """By height: levels of boundary elements, of those again on finer cells, and of springs by input spectrum.

    forces: outcome of the first strip at each height.
    """

    case: ForceSpectrum
    bem: dict[float, Outcome]
    refined: dict[float, Outcome]
    mdr: dict[tuple[InputSpectrum, float], Outcome]
    forces: dict[float, Outcome]
    unconverged: tuple[str, ...]


def run(case: ForceSpectrum, engine: Engine = SERIAL) -> RollingResult:
    """Roll all strips and tracks. Raises NotConvergedError where fewer than three strips at a height converge."""
    coarse, fine = case.cells, 2 * case.cells
    groups = {(height, cells): case.strips_of(height, cells) for height in case.heights for cells in (coarse, fine)}
    strips, unconverged = roll_strips(groups, engine)
    tracks = {
        (rule, h): case.tracks_on(case.rough_strip(case.spectrum, h), rule)
        for h in case.heights
        for rule in INPUT_SPECTRA
    }
    return RollingResult(
        case,
        {h: strip_levels(strips[h, coarse], 1 / coarse, case.bands) for h in case.heights},
        {h: strip_levels(strips[h, fine], 1 / fine, case.bands) for h in case.heights},
        dict(zip(tracks, engine.map(roll_tracks, list(tracks.values())), strict=True)),
        {h: strips[h, coarse][0] for h in case.heights},
        unconverged,
    )
