"""The punches of Fig. 14.1 at several bandwidths, and with a roll-off, by both methods."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.analysis.statistics import FloatArray
from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import Profiles, PunchRoughness, Surface


@dataclass(frozen=True, kw_only=True)
class PlateauSpectrum(mdr.SelfAffine):
    """Self-affine beyond a roll-off, constant from q_min to there; its level is that of the draw, which has an rms."""

    q_roll_off: float

    def c2d(self, q: ArrayLike) -> FloatArray:
        """C_2D(max(q, q_r)) in the band [m^4]."""
        q = np.abs(np.asarray(q, dtype=np.float64))
        return np.asarray(np.where(super().c2d(q) > 0, super().c2d(np.maximum(q, self.q_roll_off)), 0.0))


@dataclass(frozen=True, kw_only=True)
class RolledOffRoughness(PunchRoughness):
    """With a plateau from the first wave of the band to the roll-off, as many waves on a side."""

    roll_off: int

    @property
    def spectrum(self) -> PlateauSpectrum:
        band = PunchRoughness(hurst=self.hurst, waves=self.waves, height=self.height, seed=self.seed).spectrum
        q_roll_off = 2 * np.pi * self.roll_off
        return PlateauSpectrum(
            hurst=band.hurst, q_min=band.q_min, q_max=band.q_max, rms=band.rms, q_roll_off=q_roll_off
        )


@dataclass(frozen=True, kw_only=True)
class Bandwidth(PunchEnsembles):
    """Punches whose longest wave is the side, of several bandwidths, and with a roll-off.

    cells: on a side in the narrowest band, four to its shortest wave, as in all others; wider: how many times wider the
    other bands are; pairs: surfaces pressed in such a band and in the one before, the same long waves in both;
    refined: surfaces of the narrowest band pressed on twice as many cells; roll_off: q_r L / 2 pi of surfaces that have
    a plateau below, and the narrowest band above; rolled_off: as many surfaces.
    """

    hurst: float = 0.7
    cells: int = 32
    wider: tuple[int, ...] = (2, 4)
    surfaces: int = 120
    pairs: tuple[int, ...] = (20, 12)
    refined: int = 30
    roll_off: int = 4
    rolled_off: int = 20
    profiles: int = 200
    decades: tuple[int, int] = (-2, 1)
    per_decade: int = 2
    points: int = 1024
    seed: int = 143

    def __post_init__(self) -> None:
        if not len(self.pairs) == len(self.wider) or min(self.surfaces, self.refined, self.rolled_off, *self.pairs) < 3:
            raise ValueError(f"pairs must be three at least for each wider band, got {self.pairs} for {self.wider}")

    @property
    def bandwidths(self) -> tuple[int, ...]:
        """q_max / q_min without a roll-off, ascending."""
        return tuple(self.cells // 4 * width for width in (1, *self.wider))

    def roughness(self, bandwidth: int) -> PunchRoughness:
        """From one wave on a side."""
        return PunchRoughness(hurst=self.hurst, waves=(1, bandwidth), height=self.height, seed=self.seed)

    @property
    def rolled_off_roughness(self) -> PunchRoughness:
        """From one wave on a side too, and as wide a band as the narrowest beyond the roll-off."""
        waves = (1, self.roll_off * self.bandwidths[0])
        return RolledOffRoughness(
            hurst=self.hurst, waves=waves, height=self.height, seed=self.seed, roll_off=self.roll_off
        )

    def pressed(self, roughness: PunchRoughness, first: int, count: int, finer: int = 1) -> list[Surface]:
        """Realisations from the first on, four cells to the shortest wave, or so many times more."""
        cells = 4 * roughness.waves[1] * finer
        return [self.surface_of(roughness, first + i, cells, self.forces) for i in range(count)]


@dataclass(frozen=True)
class BandwidthResult:
    """Outcomes, rows are realisations, columns forces.

    narrow: of the narrowest band; refined: its first realisations on finer cells; pairs: of each wider band, and of the
    band before on the same realisations, which no other pair has; springs: of each band, narrowest first.
    """

    case: Bandwidth
    narrow: Outcome
    refined: Outcome
    pairs: list[tuple[Outcome, Outcome]]
    rolled_off: Outcome
    springs: list[Outcome]
    springs_rolled_off: Outcome
    unconverged: tuple[str, ...]


def run(case: Bandwidth, engine: Engine = SERIAL) -> BandwidthResult:
    """Press surfaces of each band, and profiles of all."""
    bands = [case.roughness(bandwidth) for bandwidth in case.bandwidths]
    starts = np.cumsum([case.surfaces, *case.pairs]).tolist()
    surfaces: dict[tuple[str, int], list[Surface]] = {
        ("narrow", 0): case.pressed(bands[0], 0, case.surfaces),
        ("refined", 0): case.pressed(bands[0], 0, case.refined, finer=2),
        ("rolled off", 0): case.pressed(case.rolled_off_roughness, 0, case.rolled_off),
    }
    for i, (first, count) in enumerate(zip(starts, case.pairs, strict=False)):
        surfaces |= {("before", i): case.pressed(bands[i], first, count)}
        surfaces |= {("wider", i): case.pressed(bands[i + 1], first, count)}
    profiles: dict[int, Profiles] = {i: case.profiles_of(band, case.points) for i, band in enumerate(bands)}
    profiles[-1] = case.profiles_of(case.rolled_off_roughness, case.points)
    bem, springs, unconverged = press(engine, surfaces, profiles)
    return BandwidthResult(
        case=case,
        narrow=bem["narrow", 0],
        refined=bem["refined", 0],
        pairs=[(bem["before", i], bem["wider", i]) for i in range(len(case.pairs))],
        rolled_off=bem["rolled off", 0],
        springs=[springs[i] for i in range(len(bands))],
        springs_rolled_off=springs[-1],
        unconverged=unconverged,
    )
