"""Levels of all models in one-third octaves, with the errors of sample and grid; a = d = E* = 1."""

import math
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands
from validation.analysis.statistics import (
    POWER_DECIBEL,
    Estimate,
    Sample,
    difference_of_halves,
    extrapolated,
    log_mean,
    paired_samples,
    sample,
    weighted_mean,
)
from validation.cases.rolling.force_spectrum import ForceSpectrum, RollingResult
from validation.engine.engine import Outcome, random_generator
from validation.simulation.rolling_strip import BOOTSTRAP, HERTZ
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, TrackSpectrum
from validation.theory.rolling import Spectrum, force_spectrum_1d, force_spectrum_3d

FloatArray = NDArray[np.float64]
Region = tuple[float, float]
"""q a of both ends."""

LINEAR_1D, SPRINGS, LINEAR_3D, ROLLING_SPRINGS = "linear 1D", "springs", "linear 3D", "rolling-equivalent springs"
MODELS = (LINEAR_1D, SPRINGS, LINEAR_3D, ROLLING_SPRINGS)
RULES: dict[str, InputSpectrum] = {SPRINGS: "geike", ROLLING_SPRINGS: "rolling"}
EXACT = 10**6
"""Realisations behind a value without scatter."""
POINTS = 48
"""Of the midpoint rule in each band."""
ROUNDING = 1e-300
"""Where (14.12) is zero, its level is rounding's, which is no reference."""


@dataclass(frozen=True)
class LevelsAtHeight:
    """Natural logarithms of levels at one height, over linear theory in 3D; means over bands by their weights."""

    result: RollingResult
    height: float

    @property
    def case(self) -> ForceSpectrum:
        return self.result.case

    @property
    def bem(self) -> Outcome:
        return self.result.bem[self.height]

    @property
    def springs(self) -> Outcome:
        return self.result.mdr["geike", self.height]

    @cached_property
    def linear(self) -> dict[str, FloatArray]:
        spectrum, bands = self.case.spectrum, self.case.bands
        levels = {LINEAR_1D: level_1d(spectrum, "geike", bands), LINEAR_3D: level_3d(spectrum, bands)}
        return {model: self.height**2 * level for model, level in levels.items()}

    @cached_property
    def bem_over_linear(self) -> Sample:
        """Boundary elements and linear theory on the same surfaces, in pairs."""
        return paired_samples(self.bem["linear level"], self.bem["level"], self._rng(0))

    @cached_property
    def finer(self) -> Sample:
        finer = self.result.refined[self.height]["level"]
        return paired_samples(self.bem["level"][: self.case.refined], finer, self._rng(1))

    @cached_property
    def of_springs(self) -> dict[str, Sample]:
        return {
            model: sample(self.result.mdr[rule, self.height]["level"], self._rng(part))
            for part, (model, rule) in enumerate(RULES.items(), start=2)
        }

    @cached_property
    def springs_over_linear(self) -> Sample:
        """Springs and the linear filter on the same tracks, in pairs."""
        return paired_samples(np.maximum(self.springs["linear level"], ROUNDING), self.springs["level"], self._rng(4))

    def _rng(self, part: int) -> np.random.Generator:
        return random_generator(self.case.seed, BOOTSTRAP, self.case.heights.index(self.height), part)

    def weights(self, region: Region) -> FloatArray:
        """Of the mean over the bands in a region."""
        edges = np.array(self.case.bands.edges)
        inside = (edges[:-1] > region[0] * (1 - 1e-9)) & (edges[1:] < region[1] * (1 + 1e-9))
        return np.asarray(inside / inside.sum())

    @property
    def single_bands(self) -> FloatArray:
        """Weights of each band alone, a row a band."""
        return np.eye(len(self.case.bands.centres))

    def bem_level(self, weights: FloatArray) -> tuple[Estimate, float]:
        """Boundary elements on cells of no size, and the half-width that the grid leaves."""
        return extrapolated(ratio_of_pairs(self.bem_over_linear, weights), ratio_of_pairs(self.finer, weights))

    def model_level(self, model: str, weights: FloatArray) -> Estimate:
        exact = self.linear[LINEAR_3D]
        if model not in self.linear:
            return over_exact(self.of_springs[model], exact, weights)
        used = weights > 0
        with np.errstate(divide="ignore"):
            model_, reference = (float(weights[used] @ np.log(one[used])) for one in (self.linear[model], exact))
        return Estimate(model_ - reference, 0.0, EXACT)

    def decibels_over_bem(self, model: str, weights: FloatArray) -> float:
        return POWER_DECIBEL * (self.model_level(model, weights).value - self.bem_level(weights)[0].value)


def coherence(outcome: Outcome) -> FloatArray:
    """|<F F_lin*>|^2 / (<|F|^2> <|F_lin|^2>) in each band, over all waves and realisations."""
    cross = np.nansum(outcome["cross"][0] + 1j * outcome["cross"][1], axis=0)
    known = np.isfinite(outcome["level"])
    linear = np.where(known, outcome["linear level"], 0.0).sum(axis=0)
    return np.asarray(np.abs(cross) ** 2 / np.nansum(outcome["level"], axis=0) / np.maximum(linear, ROUNDING))


def correlation(outcome: Outcome) -> tuple[float, float]:
    """Correlation and slope of the force over linear theory, position by position, in all bands together."""
    cross = float(np.nansum(outcome["cross"][0]))
    known = np.isfinite(outcome["level"])
    linear, level = float(outcome["linear level"][known].sum()), float(outcome["level"][known].sum())
    return cross / math.sqrt(linear * level), cross / linear


@cache
def level_1d(spectrum: PiecewisePowerLaw, rule: InputSpectrum, bands: Bands) -> FloatArray:
    """int C_F dq / F_Hertz^2 over each band of springs with that input spectrum, (14.12), for h_rms = 1."""
    c1d = TrackSpectrum(spectrum, rule)
    return _over_bands(lambda q: force_spectrum_1d(q, c1d, contact_radius=1.0, modulus=1.0), bands)


@cache
def level_3d(spectrum: PiecewisePowerLaw, bands: Bands) -> FloatArray:
    """The same of the half-space."""
    return _over_bands(lambda q: force_3d(q, spectrum), bands)


def force_3d(q: FloatArray, spectrum: PiecewisePowerLaw) -> FloatArray:
    return force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)


def _over_bands(spectrum: Spectrum, bands: Bands) -> FloatArray:
    edges = np.array(bands.edges)
    q = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * ((np.arange(POINTS) + 0.5) / POINTS)
    return np.asarray(spectrum(q).mean(axis=1) * np.diff(edges) / HERTZ**2)


def over_exact(levels: Sample, exact: FloatArray, weights: FloatArray) -> Estimate:
    """ln of mean levels over exact ones, in the mean over bands."""
    used = weights > 0
    found = levels.estimate(weighted_mean(weights, log_mean))
    return Estimate(found.value - float(weights[used] @ np.log(exact[used])), found.error, found.samples)


def ratio_of_pairs(pairs: Sample, weights: FloatArray) -> Estimate:
    """ln of the second half of the levels over the first, realisation by realisation, in the mean over bands."""
    return pairs.estimate(difference_of_halves(weighted_mean(weights, log_mean)))
