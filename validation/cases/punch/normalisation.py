"""Fixed or Gaussian amplitudes, the rms height of each draw or of the ensemble: three ways to draw rough punches."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import BEM, MDR, PunchRoughness

FIXED, EACH, ENSEMBLE = "fixed amplitudes", "Gaussian, rms of each draw", "Gaussian, rms of the ensemble"
VARIANTS: dict[str, tuple[Literal["fixed", "gaussian"], Literal["each", "ensemble"]]] = {
    FIXED: ("fixed", "each"),
    EACH: ("gaussian", "each"),
    ENSEMBLE: ("gaussian", "ensemble"),
}


@dataclass(frozen=True, kw_only=True)
class Normalisation(PunchEnsembles):
    """The punches of Fig. 14.1 drawn in three ways, for each of `hursts`."""

    hursts: tuple[float, ...] = (0.4, 0.7, 1.0)
    cells: int = 64
    surfaces: int = 30
    profiles: int = 300
    per_decade: int = 2
    points: int = 1024
    seed: int = 141

    def roughness(self, hurst: float, variant: str) -> PunchRoughness:
        amplitudes, normalised = VARIANTS[variant]
        return replace(self.band(hurst), amplitudes=amplitudes, normalised=normalised)


@dataclass(frozen=True)
class NormalisationResult:
    """Outcomes by Hurst exponent, variant and method: rows of their arrays are realisations, columns are forces."""

    case: Normalisation
    outcomes: dict[tuple[float, str, str], Outcome]
    unconverged: tuple[str, ...]


def run(case: Normalisation, engine: Engine = SERIAL) -> NormalisationResult:
    """Press all of them with both methods."""
    ways = {(hurst, variant): case.roughness(hurst, variant) for hurst in case.hursts for variant in VARIANTS}
    surfaces = {
        way: [case.surface_of(roughness, i, case.cells, case.forces) for i in range(case.surfaces)]
        for way, roughness in ways.items()
    }
    profiles = {way: case.profiles_of(roughness, case.points) for way, roughness in ways.items()}
    bem, mdr, unconverged = press(engine, surfaces, profiles)
    outcomes = {(*way, method): found[way] for way in ways for method, found in ((BEM, bem), (MDR, mdr))}
    return NormalisationResult(case, outcomes, unconverged)


def scatter(case: Normalisation, hurst: float, method: str) -> float:
    """Relative standard deviation of the mean square height of Gaussian draws: sqrt(sum w^2) / sum w.

    w: the mean square of each independent wave, whose power is distributed exponentially; the few longest carry it.
    """
    last = case.cells // 4
    if method == MDR:
        power = np.arange(1, last + 1.0) ** (-2 * hurst - 1)
    else:
        i, j = np.meshgrid(np.arange(-last, last + 1.0), np.arange(0, last + 1.0), indexing="ij")
        waves = np.hypot(i, j)
        # of a wave and its mirror image, one
        independent = (waves > 0) & (waves <= last) & ((j > 0) | (i > 0))
        power = waves[independent] ** (-2 * hurst - 2)
    return float(np.sqrt((power**2).sum()) / power.sum())
