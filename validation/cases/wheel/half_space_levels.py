"""Levels of the wheel in three dimensions, band by band: boundary elements, linear theory and springs."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import RecordSpectra, band_levels, one_third_octaves, record_spectra
from validation.analysis.statistics import Estimate, log_ratio_of_means
from validation.cases.wheel.features import linear_force_3d, linear_spectrum, resonator
from validation.cases.wheel.half_space import COARSER, FINEST, LOOSE, TIGHT, Result3D
from validation.engine.engine import Outcome
from validation.simulation.wheel_on_springs import InputSpectrum
from validation.theory import wheel as wheel_theory

FloatArray = NDArray[np.float64]

LINEAR_3D, LINEAR_1D = "linear, 3D", "linear, 1D (14.12)"
GEIKE, ROLLING = "springs, Geike spectrum", "springs, rolling spectrum"
MODELS = (LINEAR_3D, LINEAR_1D, GEIKE, ROLLING)
ON_SPRINGS: dict[str, InputSpectrum] = {GEIKE: "geike", ROLLING: "rolling"}
POINTS = 40
"""Of a quadrature over a band."""


@dataclass(frozen=True)
class WheelLevels:
    """Levels of the acceleration in one-third octaves: int A df of positive frequencies, natural logarithms."""

    result: Result3D

    @cached_property
    def converged(self) -> list[Outcome]:
        return [strip for strip in self.result.strips[FINEST] if not strip["failed"]]

    @cached_property
    def edges(self) -> FloatArray:
        """Of bands that hold two lines of a strip and end with the roughness."""
        scene, strip = self.result.case.scene, self.result.strips[FINEST][0]
        line = 2 * math.pi / (strip["bem"].size * float(strip["time step"]))
        return one_third_octaves(max(2.0 * scene.eigenfrequency, 2 * line / (2 ** (1 / 3) - 1)), scene.cutoff)

    @property
    def centres(self) -> FloatArray:
        return np.asarray(np.sqrt(self.edges[1:] * self.edges[:-1]))

    @property
    def ranges(self) -> dict[str, NDArray[np.bool_]]:
        """Bands of the plateau, and of region 3 in two parts."""
        scene, edges = self.result.case.scene, self.edges
        middle = math.sqrt(scene.jump * scene.cutoff)
        low, high = edges[:-1] * (1 + 1e-9), edges[1:] * (1 - 1e-9)
        return {
            "region 2": high < 0.95 * scene.jump,
            "region 3, lower half": (low > 0.99 * scene.jump) & (high <= middle),
            "region 3, upper half": (low > middle * 0.8) & (high > middle),
        }

    def of_strips(self, strips: list[Outcome], contact: str, edges: FloatArray | None = None) -> FloatArray:
        """Levels of each strip, (strips, bands), with Hann's window; contact: "bem" or "linear"."""
        records = (hann_spectra([strip], contact) for strip in strips)
        bands = self.edges if edges is None else edges
        return np.array([band_levels(record.omega, record.density, bands)[:, 0] for record in records])

    def spectra(self, contact: str) -> tuple[FloatArray, FloatArray]:
        """omega, and A with Hann's window, (strips, frequencies), of the strips that converged."""
        record = hann_spectra(self.converged, contact)
        return record.omega, record.density.T

    @cached_property
    def ratio(self) -> list[Estimate]:
        """ln of boundary elements over the linear contact on the same strips, band by band."""
        return [self._ratio_over(band) for band in np.eye(self.centres.size)]

    def _ratio_over(self, weights: FloatArray) -> Estimate:
        """Its mean over bands."""
        bem, linear = (self.of_strips(self.converged, contact) for contact in ("bem", "linear"))
        return log_ratio_of_means(bem, linear, weights)

    @cached_property
    def grid(self) -> FloatArray:
        """Error of the grid in that: to first order in the cells, three times the change from 3/4 as many."""
        case, strips = self.result.case, self.result.strips
        pairs = zip(strips[FINEST], strips[COARSER], strict=False)
        grids = zip(*((fine, coarse) for fine, coarse in pairs if not fine["failed"]), strict=True)
        fine, coarse = (
            _log_mean(self.of_strips(list(grid), "bem")) - _log_mean(self.of_strips(list(grid), "linear"))
            for grid in grids
        )
        return np.asarray(np.abs(fine - coarse) / (case.cells / case.coarse - 1))

    @cached_property
    def solver(self) -> FloatArray:
        """Change of the level of a short strip with a tighter residual; NaN where that has no line."""
        loose, tight = (self.of_strips(self.result.strips[name], "bem")[0] for name in (LOOSE, TIGHT))
        return np.asarray(np.abs(np.log(loose / tight)))

    @cached_property
    def exact(self) -> dict[str, FloatArray]:
        """ln of linear theory in three dimensions and in one; minus infinity where it has nothing."""
        scene, bands = self.result.case.scene, list(zip(self.edges, self.edges[1:], strict=False))
        in_3d = [_integral(self._density_3d, *band, POINTS) for band in bands]
        in_1d = [_integral(partial(linear_spectrum, scene), *band, 50 * POINTS) for band in bands]
        with np.errstate(divide="ignore"):
            return {LINEAR_3D: np.log(in_3d), LINEAR_1D: np.log(in_1d)}

    def _density_3d(self, omega: FloatArray) -> FloatArray:
        scene = self.result.case.scene
        force = linear_force_3d(scene, omega / scene.speed)
        return wheel_theory.over_frequency(force, speed=scene.speed) * resonator(scene, omega)

    @cached_property
    def bem(self) -> FloatArray:
        """ln of the level of boundary elements: that of linear theory, and their ratio on the strips."""
        return np.asarray(self.exact[LINEAR_3D] + np.array([estimate.value for estimate in self.ratio]))

    @cached_property
    def springs(self) -> dict[str, FloatArray]:
        """ln of the mean level of springs, (groups, bands)."""
        return {model: self._of_springs(self.result.springs[name]) for model, name in ON_SPRINGS.items()}

    def _of_springs(self, batches: list[Outcome]) -> FloatArray:
        groups = np.concatenate([batch["hann"] for batch in batches])
        return np.asarray(np.log(band_levels(batches[0]["omega"], groups.T, self.edges)).T)

    def over_bem(self, model: str) -> FloatArray:
        """ln of a model's level over boundary elements, band by band."""
        value = self.exact[model] if model in self.exact else np.log(np.exp(self.springs[model]).mean(axis=0))
        return np.asarray(value - self.bem)

    def mean_over_bem(self, model: str, where: NDArray[np.bool_]) -> tuple[Estimate, float]:
        """Mean of that over some bands, with the error of both samples; the error of grid and solver."""
        weights = where / where.sum()
        error = self._ratio_over(weights).error
        if model in self.springs:
            springs = np.exp(self.springs[model])
            error = math.hypot(error, log_ratio_of_means(springs, np.ones(where.size), weights).error)
        value = float(self.over_bem(model)[where].mean())
        solver = self.solver[where][np.isfinite(self.solver[where])]
        grid = float(self.grid[where].mean() + (solver.mean() if solver.size else 0.0))
        return Estimate(value, error, len(self.converged)), grid


def _integral(density: Callable[[FloatArray], FloatArray], low: float, high: float, points: int) -> float:
    omega = np.linspace(low, high, points)
    return float(np.trapezoid(density(omega), omega)) / (2 * math.pi)


def hann_spectra(strips: list[Outcome], contact: str) -> RecordSpectra:
    """Of the acceleration on each strip, with Hann's window."""
    series = np.stack([strip[contact] for strip in strips], axis=1)
    return record_spectra(series, time_step=float(strips[0]["time step"]), window="hann")


def _log_mean(levels: FloatArray) -> FloatArray:
    return np.asarray(np.log(levels.mean(axis=0)))
