"""Rolling over isotropic roughness: the force along the track by boundary elements, springs and linear theory."""

import math
from dataclasses import dataclass

from validation.analysis.spectra import Bands
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rolling_strip import (
    Strip,
    Tracks,
    roll_strip,
    roll_tracks,
    strip_levels,
)
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine

INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "rolling")
ROUGH = 0.3


@dataclass(frozen=True, kw_only=True)
class ForceSpectrum:
    """A wheel at the approach d over self-affine roughness, contact radius a, q a from first to last.

    hurst; heights: h_rms / d, ascending; first, last: q a of the band; lowest: q a from which on there are bands;
    length, width: of the periodic surfaces over a; cells: to a contact radius; strips: realisations; rough_strips: of
    them where h/d is ROUGH or more, and linear theory on the same surface no longer takes the scatter away; refined:
    rolled again on cells half as wide; tracks, springs: realisations of MDR, springs to a radius; seed: zero or more.
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
        """Solved the more exactly the lower the roughness, whose waves make the force fluctuate the less."""
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
    """By height: levels of boundary elements, of those again on finer cells, and of springs by what they were fed.

    forces: of the first strip at each height, for a look; applications: of the operator at a position, on average.
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
    strips = [strip for group in groups.values() for strip in group]
    outcomes = engine.map(roll_strip, strips)
    rolled = iter(outcomes)
    by_group = {key: [next(rolled) for _ in group] for key, group in groups.items()}
    unconverged = tuple(
        f"strip {s.realisation}, h/d = {s.height:g}, {s.cells} cells to a radius: {int(o['failed'])} positions"
        for s, o in zip(strips, outcomes, strict=True)
        if o["failed"]
    )
    for (height, cells), found in by_group.items():
        whole = sum(not o["failed"] for o in found)
        if whole < 3:
            raise NotConvergedError(
                f"{whole} strips converged at h/d = {height:g} on {cells} cells, 3 are needed", unconverged
            )
    tracks = [case.tracks_of(height, rule) for height in case.heights for rule in INPUT_SPECTRA]
    on_springs = engine.map(roll_tracks, tracks)
    return RollingResult(
        case,
        {h: strip_levels(by_group[h, case.cells], 1 / case.cells, case.bands) for h in case.heights},
        {h: strip_levels(by_group[h, 2 * case.cells], 0.5 / case.cells, case.bands) for h in case.heights},
        {(t.input_spectrum, t.height): o for t, o in zip(tracks, on_springs, strict=True)},
        {h: by_group[h, case.cells][0] for h in case.heights},
        unconverged,
    )
