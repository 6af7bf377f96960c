"""Estimates from a sample of realisations, with the error that the size of the sample leaves."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

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
        """Half of the interval that covers this point and the others of its range at once with 95 %, by Bonferroni."""
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
    finite_rows = rows[np.isfinite(rows).all(axis=tuple(range(1, rows.ndim)))]
    groups = np.array_split(np.arange(len(finite_rows)), min(len(finite_rows), JACKKNIFE_GROUPS))
    with np.errstate(divide="ignore", invalid="ignore"):
        values = np.atleast_1d(value(finite_rows))
        errors = jackknife_error(np.array([np.atleast_1d(value(np.delete(finite_rows, group, 0))) for group in groups]))
    return [Estimate(float(v), float(e), len(groups)) for v, e in zip(values, errors, strict=True)]


def mean_estimate(values: FloatArray) -> Estimate:
    """The mean of a sample, two values at least, NaN for what is lost."""
    finite = values[np.isfinite(values)]
    return Estimate(float(finite.mean()), float(finite.std(ddof=1)) / math.sqrt(finite.size), finite.size)


def ratio_of_means(values: FloatArray, references: FloatArray) -> Estimate:
    """Mean of x over mean of y, with the error by the spread of x - (ratio) y: what both share drops out.

    values, references: x, y, realisation by realisation, two at least; NaN among the values for what is lost.
    """
    finite = np.isfinite(values)
    x, y = values[finite], references[finite]
    ratio = float(x.mean() / y.mean())
    residuals = x - ratio * y
    error = float(residuals.std(ddof=1)) / math.sqrt(residuals.size) / abs(float(y.mean()))
    return Estimate(ratio, error, residuals.size)


def log_ratio_of_means(values: FloatArray, references: FloatArray, weights: FloatArray) -> Estimate:
    """Sum over columns of a weight times ln of the mean of x over the mean of y, with its jackknife error.

    values, references: x, y, one row a realisation, two at least, NaN in rows of x that are lost; or y one row, which
    is exact; columns without weight need not be positive.
    """
    used, finite = weights != 0, np.isfinite(values).all(axis=1)
    pairs = np.stack([values, np.broadcast_to(references, values.shape)])[:, finite][:, :, used]
    count = pairs.shape[1]
    total = pairs.sum(axis=1, keepdims=True)
    mean, without = total / count, (total - pairs) / (count - 1)
    log_ratio, rest = ((np.log(x) - np.log(y)) @ weights[used] for x, y in (mean, without))
    return Estimate(float(log_ratio[0]), float(jackknife_error(rest)), count)


def extrapolated(coarse: Estimate, finer: Estimate, among: int = 1) -> tuple[Estimate, float]:
    """Extrapolate to zero cell size to first order; the grid error is half of that change, and its interval.

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


NEIGHBOURS, FLOOR, TAPER, CHANCE = 51, 1e-11, 0.1, 0.15
"""Waves over which a spectrum is averaged to whiten it; power below this part of the largest is none; share of a record
that is tapered at each end, so that no step leaks; correlation that independent records have by chance at one lag."""


def independent_records(records: FloatArray) -> float:
    """n^2 / sum over pairs of r_ij^2, with r_ij the largest correlation of two whitened records at any lag.

    The variance of a mean of n spectra is that of so many independent ones, since two periodograms correlate as the
    square of what their records share. A record that is shifted, scaled, upside down or backwards is the same.
    records: one a row, two at least.
    """
    count, points = records.shape
    rise = np.minimum((np.arange(points) + 0.5) / (TAPER * points), 1.0)
    taper = np.sin(np.pi / 2 * np.minimum(rise, rise[::-1])) ** 2
    spectra = np.fft.rfft(taper * (records - records.mean(axis=1, keepdims=True)), 2 * points)
    power = np.abs(spectra) ** 2
    kernel = np.full(neighbours := min(NEIGHBOURS, points), 1 / neighbours)
    smooth = np.array([np.convolve(line, kernel, mode="same") for line in power])
    white = np.where(power > FLOOR * power.max(axis=1, keepdims=True), spectra, 0.0)
    white /= np.sqrt(np.maximum(smooth, np.finfo(float).tiny))
    size = np.sqrt((np.abs(white) ** 2).sum(axis=1))
    white /= np.where(size > 0, size, 1.0)[:, np.newaxis]
    total = float(count)
    for first, second in combinations(white, 2):
        # twice as many lags as places: a shift by half a place is one of them
        lags = [np.fft.irfft(first * partner, 4 * points) for partner in (np.conj(second), second)]
        shared = min(max(float(np.abs(lag).max()) for lag in lags) * 2 * points, 1.0)
        total += 2 * shared**2 if shared > CHANCE else 0.0
    return float(count**2 / total)


def half_width(estimate: Estimate, records: float, among: int = 1) -> float:
    """Half of the 95 % interval of a mean over n records of which so many are independent; infinite for one record.

    Equal records hide their scatter: sum (x - mean)^2 / n is on average the variance times 1 - 1 / records, and the
    variance of the mean is the variance over the records. Student's quantile is that of them; among: how many intervals
    hold together, by Bonferroni.
    """
    count = estimate.samples
    if records >= count:
        return estimate.half_width_among(among)
    if records <= 1 + 1e-9:
        return math.inf
    quantile = student(records - 1, 1 - 0.05 / among)
    return quantile * math.sqrt((count - 1) / (records - 1)) * estimate.error


@dataclass(frozen=True, eq=False)
class Linearised:
    """A value, and how far each realisation shifts it; realisations are independent of each other.

    Sums and differences are of values from the same realisations, so that what both share drops out.
    """

    value: float
    influence: FloatArray

    def __add__(self, other: "Linearised") -> "Linearised":
        return Linearised(self.value + other.value, self.influence + other.influence)

    def __sub__(self, other: "Linearised") -> "Linearised":
        return self + -1.0 * other

    def __rmul__(self, factor: float) -> "Linearised":
        return Linearised(factor * self.value, factor * self.influence)

    def minus_independent(self, other: "Linearised") -> "Linearised":
        """The difference to a value from other, independent realisations."""
        return Linearised(self.value - other.value, np.concatenate([self.influence, -other.influence]))

    @property
    def error(self) -> float:
        """The standard error: the root of the sum of squares of the influences."""
        return float(np.sqrt((self.influence**2).sum()))

    @property
    def freedom(self) -> float:
        """Degrees of freedom of the error, 2 <e^2>^2 / var(e^2), by the fourth moment of what realisations contribute.

        Few realisations that contribute most leave few of them (Satterthwaite 1946); n leave n - 1 at most.
        """
        squares = self.influence[self.influence != 0] ** 2
        spread = (squares**2).sum() - squares.sum() ** 2 / max(squares.size, 1)
        most = float(max(squares.size - 1, 1))
        return min(2 * float(squares.sum()) ** 2 / float(spread), most) if spread > 0 else most

    def half_width_among(self, points: float) -> float:
        """Half of the interval that covers this point and the others of its range at once with 95 %, by Bonferroni."""
        return student(self.freedom, 1 - 0.05 / points) * self.error if self.error > 0 else 0.0

    @property
    def half_width(self) -> float:
        """Half of the 95 % interval."""
        return self.half_width_among(1)


def weighted_sum(weights: Sequence[float] | FloatArray, parts: Sequence[Linearised]) -> Linearised:
    """sum_i w_i x_i of values from the same realisations; NaN of infinities that oppose each other."""
    with np.errstate(invalid="ignore"):
        value = float(np.dot(weights, [part.value for part in parts]))
    return Linearised(value, np.tensordot(weights, [part.influence for part in parts], (0, 0)))


@dataclass(frozen=True, eq=False)
class Resolved:
    """A value from several grids, and the half-width that they leave open, in the unit of the value."""

    value: Linearised
    grid: float

    def minus_independent(self, other: "Resolved") -> "Resolved":
        """The difference to a value from other realisations; grid errors add up as if they went the same way."""
        return Resolved(self.value.minus_independent(other.value), self.grid + other.grid)

    def widened(self, left: float) -> "Resolved":
        """With an independent error beside that of the grids, in quadrature."""
        return Resolved(self.value, math.hypot(self.grid, left))


def extrapolate_to_zero(grids: Sequence[Linearised]) -> Resolved:
    """2 f(h) - f(2h): the two finest grids extrapolated to zero cell size, of first order.

    grids: at least three, from coarse to fine, each with cells half as long. Grid error: the change from the same
    extrapolation on the two before.
    """
    coarse, middle, fine = grids[-3:]
    grid_error = abs(2 * (fine.value - middle.value) - (middle.value - coarse.value))
    return Resolved(2.0 * fine - middle, grid_error)


def on_finest(grids: Sequence[Linearised]) -> Resolved:
    """The value on the finest grid, not extrapolated; grid error: the change from the grid before."""
    coarse, fine = grids[-2:]
    return Resolved(fine, abs(fine.value - coarse.value) if math.isfinite(fine.value) else 0.0)


def combined(weights: Sequence[float] | FloatArray, parts: Sequence[Resolved]) -> Resolved:
    """sum_i w_i x_i; grid errors add up as if they went the same way."""
    grid = float(np.dot(np.abs(weights), [part.grid for part in parts]))
    return Resolved(weighted_sum(weights, [part.value for part in parts]), grid)


@dataclass(frozen=True, eq=False)
class Moments:
    """Mean and variance of one quantity on one grid."""

    mean: Linearised
    variance: Linearised

    def with_step(self, fine: "Moments", coarse: "Moments") -> "Moments":
        """Add the change of both moments from the coarse grid to the fine one, on the same realisations."""
        return Moments(self.mean + fine.mean - coarse.mean, self.variance + fine.variance - coarse.variance)

    @property
    def log_mean(self) -> Linearised:
        """The logarithm of the mean, ln m."""
        return log(self.mean)

    @property
    def log_relative_deviation(self) -> Linearised:
        """The logarithm of the coefficient of variation, ln(sqrt(V) / m)."""
        return 0.5 * log(self.variance) - log(self.mean)


def log(x: Linearised) -> Linearised:
    """ln x without its bias -var(x) / 2 x^2; minus infinity at zero, NaN below, where unlike grids may lead."""
    if x.value == 0:
        return Linearised(-math.inf, np.zeros_like(x.influence))
    if not x.value > 0:
        return Linearised(math.nan, np.full_like(x.influence, math.nan))
    influence = x.influence / x.value
    return Linearised(math.log(x.value) + math.log1p(float((influence**2).sum())) / 2, influence)


def moments(values: FloatArray, used: NDArray[np.bool_]) -> Moments:
    """Sample mean and sample variance of the realisations that are used, two at least; zero if rounding alone."""
    sample = values[used]
    n = sample.size
    deviations = sample - sample.mean()
    # equal values differ by rounding, which must not pass for a variance
    if np.abs(deviations).max() < ROUNDING * abs(sample.mean()):
        deviations = np.zeros(n)
    variance = float((deviations**2).sum()) / (n - 1)
    # a place for every realisation, zero where it is not used: in sums over grids the influences of one
    # realisation add up before they are squared, and with them the covariance of nested samples
    to_mean, to_variance = np.zeros((2, values.size))
    # sum of squares: s^2 / n, and the variance of s^2 to the order 1 / n^2
    to_mean[used] = deviations / math.sqrt(n * (n - 1))
    to_variance[used] = (deviations**2 * n / (n - 1) - variance) / math.sqrt(n * (n - 1))
    return Moments(Linearised(float(sample.mean()), to_mean), Linearised(variance, to_variance))


COEFFICIENT = 3
"""Fewer realisations than this times the coefficients of a regression have no use for it."""


def regression_mean(values: FloatArray, controls: FloatArray) -> Linearised:
    """Mean of y by regression on statistics x of the same realisations, known of more of them: a control variate.

    m = mean_n(y) - beta . (mean_n(x) - mean_N(x)) over the n realisations that have y, with the mean of x over all N,
    and beta by least squares on the n. Its variance is s^2 (1 / n + d . (X'X)^-1 d) + beta . C beta / N, with s^2 the
    sum of squares of the residuals over n - 1 - p degrees of freedom, p the rank of x, d the difference of the means of
    x, X the centred x of the n, and C the covariance of x over the N. Unbiased where y is linear in x, else to order
    1 / n. x is of the realisation alone, and whatever it is, the mean that is estimated is that of y.

    Parameters
    ----------
    values : ndarray, shape (n or more,)
        y, NaN where it is not known: the first realisations are those of ``controls``, others are not used.
    controls : ndarray, shape (N, p)
        x of each realisation, finite, one column a statistic.

    Returns
    -------
    Linearised
        Of all realisations; the plain mean where fewer than 3 (p + 1) of the N have y.

    Notes
    -----
    Cochran, *Sampling Techniques* (1977), sections 7.2 to 7.4 and 12.6; Lavenberg and Welch, Manage. Sci. 27 (1981).

    Examples
    --------
    >>> from validation.analysis.statistics import regression_mean
    >>> x = np.linspace(-1, 1, 200)
    >>> mean = regression_mean(3 + 2 * x[:50], x[:, np.newaxis])
    >>> f"{mean.value:.3f} +- {mean.error:.3f}"
    '3.000 +- 0.082'
    """
    total, statistics = controls.shape
    places = max(len(values), total)
    y_of, used = np.full(places, np.nan), np.zeros(places, dtype=np.bool_)
    y_of[: len(values)] = values
    used[:total] = np.isfinite(y_of[:total])
    y, x = y_of[used], controls[used[:total]]
    if y.size < COEFFICIENT * (statistics + 1):
        return moments(y_of, np.isfinite(y_of)).mean
    centred, all_centred = x - x.mean(axis=0), controls - controls.mean(axis=0)
    inverse = np.linalg.pinv(centred)
    slope = inverse @ (y - y.mean())
    residuals = y - y.mean() - centred @ slope
    freedom = y.size - 1 - int(np.linalg.matrix_rank(centred))
    away = controls.mean(axis=0) - x.mean(axis=0)
    spread = 1 / y.size + float(((away @ inverse) ** 2).sum())
    # residuals are at right angles to x, so that the squares of both parts add up
    influence = np.zeros(places)
    influence[:total] = all_centred @ slope / math.sqrt(total * (total - 1))
    influence[used] += residuals * math.sqrt(spread / freedom)
    return Linearised(float(y.mean() + away @ slope), influence)


def multilevel_moments(grids: Sequence[FloatArray]) -> list[Moments]:
    """Moments on each grid, coarse to fine; each uses all realisations of its own grid and of coarser ones.

    grids: one row a realisation, the same ones in each; NaN where a realisation was not solved.
    """
    levels: list[Moments] = []
    for i, fine in enumerate(grids):
        if i == 0:
            # the coarsest grid is the cheapest: its large sample averages most of the scatter out
            levels.append(moments(fine, np.isfinite(fine)))
        else:
            # the step to a finer grid on the realisations of both: what they share drops out, so that few will do.
            # All rows of the coarser one would be more of a sample, and would not cancel
            in_both = np.isfinite(fine) & np.isfinite(grids[i - 1])
            levels.append(levels[-1].with_step(moments(fine, in_both), moments(grids[i - 1], in_both)))
    return levels
