"""Estimates from a sample of realisations, with the error that the size of the sample leaves."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

FloatArray = NDArray[np.float64]
Statistic = Callable[..., FloatArray]

RESAMPLES = 999
ROUNDING = 1e-12


@dataclass(frozen=True)
class Estimate:
    """A value, its standard error and the number of realisations behind it."""

    value: float
    error: float
    samples: int

    @property
    def half_width(self) -> float:
        """Half of the 95 % interval: Student's quantile times the standard error."""
        return float(stats.t.ppf(0.975, self.samples - 1)) * self.error

    def minus(self, other: "Estimate") -> "Estimate":
        """The difference to an independent estimate; degrees of freedom by Welch and Satterthwaite."""
        square, their_square = self.error**2, other.error**2
        error = math.sqrt(square + their_square)
        spread = square**2 / (self.samples - 1) + their_square**2 / (other.samples - 1)
        freedom = (square + their_square) ** 2 / spread if spread > 0 else math.inf
        samples = 1 + int(min(freedom, 1e9)) if math.isfinite(error) else min(self.samples, other.samples)
        return Estimate(self.value - other.value, error, samples)


def log_mean(samples: FloatArray, axis: int = -1) -> FloatArray:
    """ln of the mean."""
    return np.asarray(np.log(samples.mean(axis=axis)))


def log_relative_deviation(samples: FloatArray, axis: int = -1) -> FloatArray:
    """ln of the standard deviation (n - 1) over the mean; minus infinity where values differ by rounding alone."""
    relative = samples.std(axis=axis, ddof=1) / samples.mean(axis=axis)
    return np.asarray(np.log(np.where(relative > ROUNDING, relative, 0.0)))


def paired_change(fine: FloatArray, coarse: FloatArray, whole: FloatArray, statistic: Statistic) -> tuple[float, float]:
    """What a finer grid changed in a statistic, seen on some realisations, and the standard error of that.

    If ln(fine / coarse) scatters with standard deviation s, independent of the value, n pairs leave the change
    uncertain by s |d statistic / d ln x| sqrt(N / n), the gradient taken on the whole coarse sample of N.

    fine, coarse: positive values of the same realisations, at least 3; whole: the coarse value of every realisation.
    """
    if fine.shape != coarse.shape or fine.ndim != 1 or fine.size < 3:
        raise ValueError(f"fine and coarse must be pairs of at least 3, got shapes {fine.shape} and {coarse.shape}")
    scatter = float(np.std(np.log(fine / coarse), ddof=1))
    step = 1e-6
    moved = whole * np.exp(step * np.eye(whole.size))
    with np.errstate(divide="ignore", invalid="ignore"):
        change = float(statistic(fine) - statistic(coarse))
        gradient = (statistic(moved) - statistic(whole)) / step
    return change, scatter * float(np.linalg.norm(gradient)) * math.sqrt(whole.size / fine.size)


def estimate(samples: FloatArray, statistic: Statistic, rng: np.random.Generator) -> Estimate:
    """A statistic with its bootstrap standard error.

    samples: one positive value a realisation, at least 3; statistic: of the samples along an axis, see `log_mean`.
    Where most resamples have no finite value, as in saturation, the error is NaN.
    Student's quantile makes up for most of what the percentile interval misses in samples as small as 12.
    """
    if samples.ndim != 1 or samples.size < 3 or not (np.isfinite(samples) & (samples > 0)).all():
        raise ValueError(f"samples must be at least 3 finite positive values, got {samples}")
    resampled = stats.bootstrap(
        (samples,), statistic, vectorized=True, n_resamples=RESAMPLES, method="percentile", rng=rng
    )
    # a resample of equal values has no deviation to take the logarithm of
    finite = resampled.bootstrap_distribution[np.isfinite(resampled.bootstrap_distribution)]
    error = float(finite.std(ddof=1)) if finite.size > RESAMPLES // 2 else math.nan
    return Estimate(float(statistic(samples)), error, samples.size)
