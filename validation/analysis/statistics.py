"""Estimates from a sample of realisations, with the error that the size of the sample leaves."""

import math
import warnings
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
THREE_PER_CENT, FIVE_PER_CENT = DECIBEL * math.log(1.03), DECIBEL * math.log(1.05)

RESAMPLES = 999
BATCH = 100
JACKKNIFE_GROUPS = 100
ROUNDING = 1e-12
LOG10_TOLERANCE = 1e-9


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


@dataclass(frozen=True)
class Sample:
    """Realisations, each at all levels, and as many resamples of them as an error bar takes.

    moments: mean and standard deviation (n - 1) of each level, shape (2, levels); resampled: those of each resample,
    (2, levels, resamples); size: realisations at the level that has fewest.
    """

    moments: FloatArray
    resampled: FloatArray
    size: int

    def estimate(self, statistic: Statistic) -> Estimate:
        """One number with its bootstrap standard error, which is NaN where most resamples have no finite value.

        A resample of n has the variance of the sample itself, (n - 1) / n of what that of the population is estimated
        to be: sqrt(n / (n - 1)) makes up for it. Student's quantile makes up for most of what the percentile interval
        misses in samples as small as 12.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            value, resampled = float(statistic(*self.moments)), statistic(*self.resampled)
        finite = resampled[np.isfinite(resampled)]
        whole = math.sqrt(self.size / (self.size - 1))
        error = whole * float(finite.std(ddof=1)) if finite.size > RESAMPLES // 2 else math.nan
        return Estimate(value, error, self.size)

    def by_level(self, statistic: Statistic) -> list[Estimate]:
        """A number at each level."""
        return [self.estimate(at_level(level, statistic)) for level in range(self.moments.shape[1])]


def sample(realisations: FloatArray, rng: np.random.Generator) -> Sample:
    """Bootstrap over realisations: what is drawn again is a realisation at all of its levels.

    realisations: positive, shape (realisations, levels), NaN for what is lost; at least 3 at every level.
    """
    known = np.isfinite(realisations) & (realisations > 0)
    if realisations.ndim != 2 or not (known | np.isnan(realisations)).all() or known.sum(axis=0).min() < 3:
        raise ValueError(f"realisations must be at least 3 finite positive values a level, got {realisations}")
    rows = realisations.T
    with warnings.catch_warnings():
        # where a level has few realisations, a resample may have none of them, and no moments
        warnings.simplefilter("ignore", RuntimeWarning)
        resampled = scipy.stats.bootstrap(
            (rows,),
            _moments,
            vectorized=True,
            n_resamples=RESAMPLES,
            batch=BATCH,
            method="percentile",
            axis=-1,
            rng=rng,
        )
    return Sample(_moments(rows), resampled.bootstrap_distribution, int(known.sum(axis=0).min()))


def paired_samples(coarse: FloatArray, fine: FloatArray, rng: np.random.Generator) -> Sample:
    """The same realisations on two grids, side by side for `change`; what one of them lacks counts in neither."""
    both = np.where(np.isfinite(coarse) & np.isfinite(fine), 1.0, np.nan)
    return sample(np.concatenate([both * coarse, both * fine], axis=1), rng)


def _moments(rows: FloatArray, axis: int = -1) -> FloatArray:
    return np.stack([np.nanmean(rows, axis=axis), np.nanstd(rows, axis=axis, ddof=1)])


def log_mean(mean: FloatArray, deviation: FloatArray) -> FloatArray:
    """ln of the mean, level by level."""
    return np.asarray(np.log(mean))


def log_relative_deviation(mean: FloatArray, deviation: FloatArray) -> FloatArray:
    """ln of deviation over mean, level by level; minus infinity where values differ by rounding alone."""
    return np.asarray(np.log(_relative(mean, deviation)))


def at_level(level: int, statistic: Statistic) -> Statistic:
    """A statistic at one level."""
    return lambda mean, deviation: statistic(mean[level], deviation[level])


def weighted_mean(weights: FloatArray, statistic: Statistic) -> Statistic:
    """sum_l w_l s_l of a statistic s of each level: with weights that sum to one, its mean over levels.

    A level without weight need not have the statistic.
    """
    used = weights != 0
    return lambda mean, deviation: np.asarray(
        np.tensordot(weights[used], statistic(mean[used], deviation[used]), (0, 0))
    )


def decade_weights(forces: Sequence[float], first: float) -> FloatArray:
    """The trapezoidal rule over ln F from F = first to 10 first: the weights of a mean over that decade of levels."""
    levels = np.log10(np.array(forces) / first)
    inside = (levels > -LOG10_TOLERANCE) & (levels < 1 + LOG10_TOLERANCE)
    ends = (np.abs(levels) < LOG10_TOLERANCE) | (np.abs(levels - 1) < LOG10_TOLERANCE)
    weights = np.where(inside, np.where(ends, 0.5, 1.0), 0.0)
    return np.asarray(weights / weights.sum())


def slope_weights(forces: Sequence[float], before: int, after: int) -> FloatArray:
    """The weights of d ln k / d ln F from one level to another."""
    weights = np.zeros(len(forces))
    weights[after], weights[before] = 1.0, -1.0
    return np.asarray(weights / math.log(forces[after] / forces[before]))


def decade_slope(forces: Sequence[float], first: float) -> FloatArray:
    """Those from F = first to 10 first, both among the levels."""
    return slope_weights(forces, nearest(forces, first), nearest(forces, 10 * first))


def nearest(forces: Sequence[float], force: float) -> int:
    """The level that is nearest to a force, by their ratio."""
    return int(np.argmin(np.abs(np.log(np.array(forces) / force))))


def log_deviation_over(weights: FloatArray) -> Statistic:
    """ln of the root mean square over levels of the relative deviation, which may vanish at some of them."""
    return lambda mean, deviation: np.asarray(
        np.log(np.tensordot(weights, _relative(mean, deviation) ** 2, (0, 0))) / 2
    )


def difference_of_halves(statistic: Statistic) -> Statistic:
    """What a statistic is of the second half of the levels, less what it is of the first: pairs, resampled together."""

    def of_halves(mean: FloatArray, deviation: FloatArray) -> FloatArray:
        half = len(mean) // 2
        return np.asarray(statistic(mean[half:], deviation[half:]) - statistic(mean[:half], deviation[:half]))

    return of_halves


def _relative(mean: FloatArray, deviation: FloatArray) -> FloatArray:
    relative = deviation / mean
    return np.asarray(np.where(relative > ROUNDING, relative, 0.0))
