"""Estimates from a sample of realisations, with the error that the size of the sample leaves."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
import scipy.special
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Statistic = Callable[[FloatArray, FloatArray], FloatArray]
"""Of mean and standard deviation, both with one row a level."""

DECIBEL = 20 / math.log(10)
"""From a natural logarithm."""
POWER_DECIBEL = 10 / math.log(10)
"""The same, of a ratio of powers."""
JACKKNIFE_GROUPS = 100
ROUNDING = 1e-12


def student(degrees: float, confidence: float = 0.95) -> float:
    """Student's quantile: the half-width of an interval over the standard error, with so many degrees of freedom."""
    # what scipy.stats.t.ppf calls, which takes a quarter of a second to import
    return float(scipy.special.stdtrit(degrees, (1 + confidence) / 2))


@dataclass(frozen=True)
class Estimate:
    """A value, its standard error and the number of realisations behind it."""

    value: float
    error: float
    samples: int

    @property
    def half_width(self) -> float:
        """Half of the 95 % interval: Student's quantile times the standard error."""
        return self.half_width_among(1)

    def half_width_among(self, points: float) -> float:
        """Of an interval that holds at 95 % together with those of the other points of a range, by Bonferroni."""
        return student(self.samples - 1, 1 - 0.05 / points) * self.error

    def minus(self, other: "Estimate") -> "Estimate":
        """The difference to an independent estimate; degrees of freedom by Welch and Satterthwaite."""
        return _sum_of_independent(self.value - other.value, (self, other))

    def plus(self, other: "Estimate") -> "Estimate":
        """The sum with an independent estimate."""
        return _sum_of_independent(self.value + other.value, (self, other))


@dataclass(frozen=True)
class Interval:
    """A value with the half-width of its own 95 % interval, as a share or a quantile of resampled scenes has one."""

    value: float
    half_width: float

    def half_width_among(self, points: float) -> float:
        """The same among any number of points: nothing else is known of it."""
        return self.half_width


def _sum_of_independent(value: float, estimates: Sequence[Estimate]) -> Estimate:
    """A sum or difference of independent estimates; degrees of freedom by Welch and Satterthwaite."""
    squares = [e.error**2 for e in estimates]
    error = math.sqrt(sum(squares))
    if not math.isfinite(error):
        return Estimate(value, error, min(e.samples for e in estimates))
    spread = sum(square**2 / (e.samples - 1) for square, e in zip(squares, estimates, strict=True))
    freedom = sum(squares) ** 2 / spread if spread > 0 else math.inf
    return Estimate(value, error, 1 + int(min(freedom * (1 + ROUNDING), 1e9)))


def jackknife_error(without: NDArray[np.floating] | Sequence[float]) -> FloatArray:
    """Standard error of a value from those without one of n realisations, or groups, after the other, along axis 0.

    sqrt((n - 1) / n sum (x_i - mean)^2), the jackknife.
    """
    return np.asarray(np.sqrt((len(without) - 1) * np.var(without, axis=0)))


def jackknifed(value: Callable[[FloatArray], FloatArray], rows: FloatArray) -> list[Estimate]:
    """Each element of value(rows), with its error by the jackknife over realisations, for few of them too.

    rows: realisations along axis 0, pairs of them perhaps; those with a value that is not finite are left out, and more
    than a hundred are taken in as many groups.
    """
    known = rows[np.isfinite(rows).all(axis=tuple(range(1, rows.ndim)))]
    groups = np.array_split(np.arange(len(known)), min(len(known), JACKKNIFE_GROUPS))
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.atleast_1d(value(known))
        errors = jackknife_error(np.array([np.atleast_1d(value(np.delete(known, group, 0))) for group in groups]))
    return [Estimate(float(v), float(e), len(groups)) for v, e in zip(found, errors, strict=True)]


def mean_estimate(values: FloatArray) -> Estimate:
    """The mean of a sample, two values at least, NaN for what is lost."""
    known = values[np.isfinite(values)]
    return Estimate(float(known.mean()), float(known.std(ddof=1)) / math.sqrt(known.size), known.size)


def ratio_of_means(values: FloatArray, references: FloatArray) -> Estimate:
    """Mean of x over mean of y, with the error by the spread of x - (ratio) y: what both share drops out.

    values, references: x, y, realisation by realisation, two at least; NaN among the values for what is lost.
    """
    known = np.isfinite(values)
    mine, other = values[known], references[known]
    ratio = float(mine.mean() / other.mean())
    left = mine - ratio * other
    error = float(left.std(ddof=1)) / math.sqrt(left.size) / abs(float(other.mean()))
    return Estimate(ratio, error, left.size)


def log_ratio_of_means(values: FloatArray, references: FloatArray, weights: FloatArray) -> Estimate:
    """Sum over columns of a weight times ln of the mean of x over the mean of y, with its jackknife error.

    values, references: x, y, one row a realisation, two at least, NaN in rows of x that are lost; or y one row, which
    is exact; columns without weight need not be positive.
    """
    used, known = weights != 0, np.isfinite(values).all(axis=1)
    pairs = np.stack([values, np.broadcast_to(references, values.shape)])[:, known][:, :, used]
    count = pairs.shape[1]
    total = pairs.sum(axis=1, keepdims=True)
    mean, without = total / count, (total - pairs) / (count - 1)
    whole, rest = ((np.log(x) - np.log(y)) @ weights[used] for x, y in (mean, without))
    return Estimate(float(whole[0]), float(jackknife_error(rest)), count)


def extrapolated(coarse: Estimate, finer: Estimate, among: int = 1) -> tuple[Estimate, float]:
    """To cells of no size, to first order, and what that leaves open: half of the way there, and its interval.

    finer: the change from these cells to half as long ones, on the same realisations; among: how many points of a range
    have intervals that hold at once.
    """
    value = Estimate(coarse.value + 2 * finer.value, coarse.error, coarse.samples)
    return value, abs(finer.value) + 2 * finer.half_width_among(among)


def log_mean(mean: FloatArray, deviation: FloatArray) -> FloatArray:
    """ln of the mean, level by level."""
    return np.asarray(np.log(mean))


def nearest(forces: Sequence[float], force: float) -> int:
    """The level that is nearest to a force, by their ratio."""
    return int(np.argmin(np.abs(np.log(np.array(forces) / force))))
