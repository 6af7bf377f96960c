"""Multilevel estimates of a mean and a deviation: many realisations on coarse grids, few of the steps to finer ones.

    m = mean(k_0) + sum_l mean(k_l - k_(l-1)),    V = var(k_0) + sum_l [var(k_l) - var(k_(l-1))]

Each term is taken over the realisations that its grids share, so m and V are unbiased for any numbers of realisations
and any correlation of the grids (Giles, Acta Numerica 24 (2015); variances have n - 1). The error of a function of both
follows from what each realisation contributes to it: the infinitesimal jackknife (Efron and Stein, Ann. Stat. 9, 1981).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import ROUNDING, FloatArray, student


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

    def beside(self, other: "Linearised") -> "Linearised":
        """The difference to a value from other, independent realisations."""
        return Linearised(self.value - other.value, np.concatenate([self.influence, -other.influence]))

    @property
    def error(self) -> float:
        """Standard error."""
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
        """Of an interval that holds at 95 % together with those of the other points of a range, by Bonferroni."""
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
    """A value on cells of no size; grid: half-width that the grids leave open."""

    value: Linearised
    grid: float

    def beside(self, other: "Resolved") -> "Resolved":
        """The difference to a value from other realisations; grid errors add up as if they went the same way."""
        return Resolved(self.value.beside(other.value), self.grid + other.grid)


def on_no_size(grids: Sequence[Linearised]) -> Resolved:
    """To first order from the two finest grids; how far that is from the next two."""
    coarse, middle, fine = grids[-3:]
    apart = abs(2 * (fine.value - middle.value) - (middle.value - coarse.value))
    return Resolved(2.0 * fine - middle, apart)


def on_finest(grids: Sequence[Linearised]) -> Resolved:
    """As it is on the finest grid; by how much that changed it."""
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
        """From the coarse grid to the fine one."""
        return Moments(self.mean + fine.mean - coarse.mean, self.variance + fine.variance - coarse.variance)

    @property
    def log_mean(self) -> Linearised:
        """ln m."""
        return log(self.mean)

    @property
    def log_relative_deviation(self) -> Linearised:
        """ln(sqrt(V) / m)."""
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
    mine = values[used]
    n = mine.size
    left = mine - mine.mean()
    if np.abs(left).max() < ROUNDING * abs(mine.mean()):
        left = np.zeros(n)
    variance = float((left**2).sum()) / (n - 1)
    to_mean, to_variance = np.zeros((2, values.size))
    # sum of squares: s^2 / n, and the variance of s^2 to the order 1 / n^2
    to_mean[used] = left / math.sqrt(n * (n - 1))
    to_variance[used] = (left**2 * n / (n - 1) - variance) / math.sqrt(n * (n - 1))
    return Moments(Linearised(float(mine.mean()), to_mean), Linearised(variance, to_variance))


def multilevel_moments(grids: Sequence[FloatArray]) -> list[Moments]:
    """Moments on each grid, coarse to fine; each uses all realisations of its own grid and of coarser ones.

    grids: one row a realisation, the same ones in each; NaN where a realisation was not solved.
    """
    found: list[Moments] = []
    for i, fine in enumerate(grids):
        if i == 0:
            found.append(moments(fine, np.isfinite(fine)))
        else:
            both = np.isfinite(fine) & np.isfinite(grids[i - 1])
            found.append(found[-1].with_step(moments(fine, both), moments(grids[i - 1], both)))
    return found
