"""Settings that the cases of rolling over isotropic roughness share: surfaces, grids, realisations, bands."""

import math
from dataclasses import dataclass

from validation.analysis.spectra import Bands
from validation.simulation.rolling_strip import Strip, Tracks
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw


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

    @property
    def bands(self) -> Bands:
        """One-third octaves from the lowest to the last, one of them around the first zero of sin(q a)."""
        return Bands.around(math.pi, self.lowest, self.last).on(self.length)

    def strip(
        self, spectrum: PiecewisePowerLaw, height: float, realisation: int, cells: int, tolerance: float
    ) -> Strip:
        """One realisation of boundary elements."""
        return Strip(
            spectrum=spectrum,
            height=height,
            realisation=realisation,
            length=self.length,
            width=self.width,
            cells=cells,
            tolerance=tolerance,
            seed=self.seed,
        )

    def tracks_on(self, spectrum: PiecewisePowerLaw, height: float, rule: InputSpectrum) -> Tracks:
        """All realisations on springs."""
        return Tracks(
            spectrum=spectrum,
            input_spectrum=rule,
            height=height,
            realisations=self.tracks,
            length=self.length,
            springs=self.springs,
            bands=self.bands,
            seed=self.seed,
        )
