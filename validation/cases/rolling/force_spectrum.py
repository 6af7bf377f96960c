"""Rolling over isotropic roughness: the force along the track by boundary elements, springs and linear theory."""

import math
from dataclasses import dataclass

from validation.analysis.spectra import Bands
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rolling_strip import Strip, Tracks, roll_strips, roll_tracks, strip_levels
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine

INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "rolling")
ROUGH = 0.3
"""h/d from which on linear theory on the same surface no longer removes the scatter."""


@dataclass(frozen=True, kw_only=True)
class ForceSpectrum:
    """A wheel at the approach d over self-affine roughness, contact radius a, q a from first to last.

    hurst; heights: h_rms / d, ascending; first, last: q a of the band; lowest: q a of the first one-third octave;
    length, width: of the periodic surfaces over a; cells: to a contact radius; strips: realisations, rough_strips of
    them where h/d is ROUGH or more; refined: how many are rolled again on cells half as wide; tracks: realisations on
    springs; springs: to a radius; seed: zero or more.
    """

    hurst: float = 0.7
    heights: tuple[float, ...] = (0.01, 0.1, 1.0)
    first: float = 1.0
    last: float = 10.0
    lowest: float = 0.4
    length: float = 64.0
    width: float = 16.0
    cells: int = 8
    strips: int = 6
    rough_strips: int = 6
    refined: int = 3
    tracks: int = 60
    springs: int = 32
    seed: int = 144

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        """C_2D of the surfaces."""
        return self_affine(self.hurst, self.first, self.last)

    @property
    def bands(self) -> Bands:
        """One-third octaves from the lowest to the end of the band, one of them around the first zero of sin(q a)."""
        return Bands.around(math.pi, self.lowest, self.last).on(self.length)

    def strips_at(self, height: float) -> int:
        """Realisations of boundary elements."""
        return self.rough_strips if height >= ROUGH else self.strips

    def strip(self, height: float, realisation: int, cells: int) -> Strip:
        """The lower the roughness, the less the force fluctuates and the smaller the tolerance."""
        return Strip(
            spectrum=self.spectrum,
            height=height,
            realisation=realisation,
            length=self.length,
            width=self.width,
            cells=cells,
            tolerance=1e-4 * height,
            seed=self.seed,
        )

    def tracks_of(self, height: float, rule: InputSpectrum) -> Tracks:
        """All realisations of MDR at one height."""
        return Tracks(
            spectrum=self.spectrum,
            input_spectrum=rule,
            height=height,
            realisations=self.tracks,
            length=self.length,
            springs=self.springs,
            bands=self.bands,
            seed=self.seed,
        )


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
    """Roll all strips and tracks. Raises NotConvergedError where fewer than three strips at a height are whole."""
    groups = {
        (height, cells): [
            case.strip(height, i, cells) for i in range(case.strips_at(height) if cells == case.cells else case.refined)
        ]
        for height in case.heights
        for cells in (case.cells, 2 * case.cells)
    }
    strips, unconverged = roll_strips(groups, engine)
    tracks = {(rule, height): case.tracks_of(height, rule) for height in case.heights for rule in INPUT_SPECTRA}
    return RollingResult(
        case,
        {h: strip_levels(strips[h, case.cells], 1 / case.cells, case.bands) for h in case.heights},
        {h: strip_levels(strips[h, 2 * case.cells], 0.5 / case.cells, case.bands) for h in case.heights},
        dict(zip(tracks, engine.map(roll_tracks, list(tracks.values())), strict=True)),
        {h: strips[h, case.cells][0] for h in case.heights},
        unconverged,
    )
