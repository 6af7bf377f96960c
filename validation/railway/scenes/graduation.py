"""A smooth series through values that scatter, some of which stand out, and what the scatter leaves of its slopes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from validation.analysis.statistics import FloatArray, student

STIFFNESS = 10.0
"""Of the graduation: half of a wave of 11 values is left, a decade of one-third octaves."""
FEWEST = 5
"""Values that tell scatter from a shape."""
OF_MEDIAN, EFFICIENCY = 1.4826, 0.37
"""Standard deviation of a Gaussian over its median deviation, and share of the values that this is worth."""
ROBUST, REDESCENDING, LONE = 10, 20, 3.0
"""Steps with Huber's weights and with Tukey's, and deviations beyond which a value has no weight at all."""


@dataclass(frozen=True, eq=False)
class Graduation:
    """values: smooth, shape (n,); hat: (n, n), from the series to them; scatter: of a value of weight one.

    A straight line is its own graduation. of_values: weights of the series, as given.
    """

    values: FloatArray
    hat: FloatArray
    scatter: float
    of_values: FloatArray

    @cached_property
    def quantile(self) -> float:
        """Of 95 %: Student's, of the degrees of freedom that a median deviation has."""
        free = EFFICIENCY * max(len(self.values) - float(np.trace(self.hat)), 1.0)
        return student(free)

    def slope_error(self, reach: int) -> FloatArray:
        """95 % half-width of the mean slope from each value to the one `reach` later, or to the last, shape (n,)."""
        last = len(self.values) - 1
        starts = np.minimum(np.arange(last + 1), last - 1)
        ends = np.minimum(starts + reach, last)
        spread = (self.hat[ends] - self.hat[starts]) / np.sqrt(self.of_values) / (ends - starts)[:, np.newaxis]
        return np.asarray(self.quantile * self.scatter * np.sqrt((spread**2).sum(axis=1)))


def graduated(series: ArrayLike, weights: ArrayLike, *, least: float) -> Graduation:
    """Whittaker's graduation: the least sum w (y - z)^2 + stiffness (second differences of z)^2, by robust weights.

    series: evenly spaced, shape (n,); weights: of its values, positive, as 1 / variance but for a factor; least: of the
    scatter of a value of weight one, positive: the less, the more a bend stands out. A value that stands out loses its
    weight, by Tukey's rule, from a start by Huber's. Fewer than `FEWEST` are left as they are, without scatter.
    Source: Whittaker, Proc. Edinburgh Math. Soc. 41 (1923) 63; Huber, Robust Statistics.
    """
    y, prior = np.asarray(series, dtype=np.float64), np.asarray(weights, dtype=np.float64)
    if len(y) < FEWEST:
        return Graduation(y, np.eye(len(y)), 0.0, prior)
    bent = np.diff(np.eye(len(y)), 2, axis=0)
    weight = prior
    for step in range(ROBUST + REDESCENDING + 1):
        hat = np.asarray(
            np.linalg.solve(np.diag(weight) + STIFFNESS * bent.T @ bent, np.diag(weight)), dtype=np.float64
        )
        deviation = np.sqrt(prior) * (y - hat @ y)
        free = max(len(y) - float(np.trace(hat)), 1.0)
        scatter = max(OF_MEDIAN * float(np.median(np.abs(deviation))) * np.sqrt(len(y) / free), least)
        off = np.abs(deviation) / scatter
        left = 1 / np.maximum(off, 1) if step < ROBUST else np.clip(1 - (off / LONE) ** 2, 1e-6, None) ** 2
        weight = prior * left
    return Graduation(hat @ y, hat, float(scatter), prior)


def scatter_of(series: ArrayLike) -> float:
    """Standard deviation of a series about any smooth one, by the median of its second differences."""
    y = np.asarray(series, dtype=np.float64)
    return OF_MEDIAN * float(np.median(np.abs(np.diff(y, 2)))) / 6**0.5 if len(y) > 2 else 0.0
