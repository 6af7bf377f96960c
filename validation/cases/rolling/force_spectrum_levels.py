"""Levels of all models in one-third octaves, with the errors of sample and grid; a = d = E* = 1."""

import math
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, Estimate, extrapolated, log_ratio_of_means
from validation.cases.rolling.force_spectrum import ForceSpectrum, RollingResult
from validation.engine.engine import Outcome
from validation.simulation.rolling_strip import HERTZ
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
    def slope(self) -> float:
        """h' a / d, along the track, of all waves."""
        return self.height * self.case.spectrum.slope_along

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

    def bands_in(self, region: Region) -> list[int]:
        """Indices of the one-third octaves that lie in a region."""
        edges = np.array(self.case.bands.edges)
        inside = (edges[:-1] > region[0] * (1 - 1e-9)) & (edges[1:] < region[1] * (1 + 1e-9))
        return np.flatnonzero(inside).tolist()

    def weights(self, region: Region) -> FloatArray:
        """Of the mean over the bands in a region."""
        return np.asarray(self.single_bands[self.bands_in(region)].mean(axis=0))

    @property
    def single_bands(self) -> FloatArray:
        """Weights of each band alone, a row a band."""
        return np.eye(len(self.case.bands.centres))

    def bem_level(self, weights: FloatArray, among: int = 1) -> tuple[Estimate, float]:
        """Boundary elements on cells of no size, and the half-width that the grid leaves; among: see `extrapolated`."""
        coarse, fine = self.bem["level"], self.result.refined[self.height]["level"]
        over_linear = log_ratio_of_means(coarse, self.bem["linear level"], weights)
        return extrapolated(over_linear, log_ratio_of_means(fine, coarse[: len(fine)], weights), among)

    def model_level(self, model: str, weights: FloatArray) -> Estimate:
        exact = self.linear[LINEAR_3D]
        if model in RULES:
            return log_ratio_of_means(self.result.mdr[RULES[model], self.height]["level"], exact, weights)
        used = weights > 0
        with np.errstate(divide="ignore"):
            over_exact = np.log(self.linear[model][used] / exact[used])
        return Estimate(float(weights[used] @ over_exact), 0.0, EXACT)

    def springs_over_linear(self, weights: FloatArray) -> Estimate:
        """Springs over the linear filter on the same tracks."""
        return log_ratio_of_means(self.springs["level"], np.maximum(self.springs["linear level"], ROUNDING), weights)

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
    return over_bands(lambda q: force_spectrum_1d(q, c1d, contact_radius=1.0, modulus=1.0), bands) / HERTZ**2


@cache
def level_3d(spectrum: PiecewisePowerLaw, bands: Bands) -> FloatArray:
    """The same of the half-space."""
    return over_bands(lambda q: force_3d(q, spectrum), bands) / HERTZ**2


def force_3d(q: FloatArray, spectrum: PiecewisePowerLaw) -> FloatArray:
    return force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)


def over_bands(spectrum: Spectrum, bands: Bands) -> FloatArray:
    """int C dq over each band, by the midpoint rule."""
    edges = np.array(bands.edges)
    q = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * ((np.arange(POINTS) + 0.5) / POINTS)
    return np.asarray(spectrum(q).mean(axis=1) * np.diff(edges))
