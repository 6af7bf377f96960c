"""Levels of all models over roughness of one height, in one-third octaves, with the errors of sample and grid."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import POWER_DECIBEL, Estimate, Sample, extrapolated, paired_samples, sample
from validation.cases.rolling.force_spectrum import ForceSpectrum, RollingResult
from validation.cases.rolling.linear_levels import ROUNDING, level_1d, level_3d, over_exact, ratio_of_pairs
from validation.engine.engine import Outcome, random_generator
from validation.simulation.rolling_strip import BOOTSTRAP
from validation.simulation.track_spectrum import InputSpectrum

FloatArray = NDArray[np.float64]
Region = tuple[float, float]
"""q a of both ends."""

LINEAR_1D, SPRINGS, LINEAR_3D, ROLLING_SPRINGS = "linear 1D", "springs", "linear 3D", "rolling-equivalent springs"
MODELS = (LINEAR_1D, SPRINGS, LINEAR_3D, ROLLING_SPRINGS)
RULES: dict[str, InputSpectrum] = {SPRINGS: "geike", ROLLING_SPRINGS: "rolling"}
EXACT = 10**6
"""Realisations behind a value without scatter."""


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
        """Boundary elements, on the grid of all strips."""
        return self.result.bem[self.height]

    @property
    def springs(self) -> Outcome:
        """Springs with Geike's spectrum."""
        return self.result.mdr["geike", self.height]

    @cached_property
    def linear(self) -> dict[str, FloatArray]:
        """Levels of linear theory by quadrature."""
        spectrum, bands = self.case.spectrum, self.case.bands
        levels = {LINEAR_1D: level_1d(spectrum, "geike", bands), LINEAR_3D: level_3d(spectrum, bands)}
        return {model: self.height**2 * level for model, level in levels.items()}

    @cached_property
    def bem_over_linear(self) -> Sample:
        """Boundary elements and linear theory on the same surfaces, in pairs."""
        return paired_samples(self.bem["linear level"], self.bem["level"], self._rng(0))

    @cached_property
    def finer(self) -> Sample:
        """The same surfaces on two grids, in pairs."""
        finer = self.result.refined[self.height]["level"]
        return paired_samples(self.bem["level"][: self.case.refined], finer, self._rng(1))

    @cached_property
    def of_springs(self) -> dict[str, Sample]:
        """Springs by their input spectrum."""
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
        """Another model."""
        exact = self.linear[LINEAR_3D]
        if model not in self.linear:
            return over_exact(self.of_springs[model], exact, weights)
        used = weights > 0
        with np.errstate(divide="ignore"):
            model_, reference = (float(weights[used] @ np.log(one[used])) for one in (self.linear[model], exact))
        return Estimate(model_ - reference, 0.0, EXACT)

    def decibels_over_bem(self, model: str, weights: FloatArray) -> float:
        """A model over boundary elements [dB]."""
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
