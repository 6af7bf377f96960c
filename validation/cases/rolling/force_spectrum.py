"""Rolling over isotropic roughness: the force along the track by boundary elements, springs and linear theory."""

from dataclasses import dataclass

from validation.cases.rolling.settings import RollingSettings
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rolling_strip import Strip, roll_strips, roll_tracks, strip_levels
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine

INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "rolling")
ROUGH = 0.3
"""h/d from which on linear theory on the same surface no longer removes the scatter."""


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
    refined: int = 3
    tracks: int = 60

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        """C_2D of the surfaces."""
        return self_affine(self.hurst, self.first, self.last)

    def strips_of(self, height: float, cells: int) -> list[Strip]:
        """On one grid. The lower the roughness, the less the force fluctuates and the smaller the tolerance."""
        strips = self.rough_strips if height >= ROUGH else self.strips
        count = strips if cells == self.cells else self.refined
        return [self.strip(self.spectrum, height, i, cells, 1e-4 * height) for i in range(count)]


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
    tracks = {(rule, h): case.tracks_on(case.spectrum, h, rule) for h in case.heights for rule in INPUT_SPECTRA}
    return RollingResult(
        case,
        {h: strip_levels(strips[h, coarse], 1 / coarse, case.bands) for h in case.heights},
        {h: strip_levels(strips[h, fine], 1 / fine, case.bands) for h in case.heights},
        dict(zip(tracks, engine.map(roll_tracks, list(tracks.values())), strict=True)),
        {h: strips[h, coarse][0] for h in case.heights},
        unconverged,
    )
