"""Mean stiffness and its relative deviation by bandwidth, level by level of force, as natural logarithms.

Boundary elements of a wide band are those of the narrowest, on many surfaces, and the changes from band to band, on few
that have the same long waves. The sum is unbiased, and what these waves scatter drops out of each change.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import accumulate, pairwise

import numpy as np

from validation.analysis.statistics import ROUNDING, Estimate, FloatArray, jackknifed
from validation.cases.punch.bandwidth import BandwidthResult

MEAN, DEVIATION = "mean stiffness", "relative deviation"
Estimates = list[Estimate]
"""One a level of force."""


def log_mean(stiffness: FloatArray) -> FloatArray:
    """ln of the mean of realisations."""
    return np.asarray(np.log(stiffness.mean(axis=0)))


def log_deviation(stiffness: FloatArray) -> FloatArray:
    """ln of the relative standard deviation; minus infinity where realisations differ by rounding alone."""
    relative = stiffness.std(axis=0, ddof=1) / stiffness.mean(axis=0)
    return np.asarray(np.log(np.where(relative > ROUNDING, relative, 0.0)))


STATISTICS: dict[str, Callable[[FloatArray], FloatArray]] = {MEAN: log_mean, DEVIATION: log_deviation}


def change(statistic: Callable[[FloatArray], FloatArray], before: FloatArray, after: FloatArray) -> Estimates:
    """From one to another of the same realisations."""
    count = min(len(before), len(after))
    pairs = np.stack([before[:count], after[:count]], axis=1)
    return jackknifed(lambda rows: statistic(rows[:, 1]) - statistic(rows[:, 0]), pairs)


def plus(one: Estimates, other: Estimates) -> Estimates:
    """Of independent estimates."""
    return [a.plus(b) for a, b in zip(one, other, strict=True)]


def minus(one: Estimates, other: Estimates) -> Estimates:
    """Of independent estimates."""
    return [a.minus(b) for a, b in zip(one, other, strict=True)]


@dataclass(frozen=True)
class BandwidthLevels:
    """One quantity: bem, springs: of each bandwidth; bem_changes, springs_changes: from each to the next; with a
    roll-off; grid: what twice as many cells a side change in the narrowest band."""

    bem: list[Estimates]
    springs: list[Estimates]
    bem_changes: list[Estimates]
    springs_changes: list[Estimates]
    bem_rolled_off: Estimates
    springs_rolled_off: Estimates
    grid: Estimates

    @property
    def over_bem(self) -> list[Estimates]:
        """MDR over boundary elements, of each bandwidth."""
        return [minus(springs, bem) for springs, bem in zip(self.springs, self.bem, strict=True)]

    @property
    def over_bem_changes(self) -> list[Estimates]:
        """How that changes from each bandwidth to the next."""
        return [minus(springs, bem) for springs, bem in zip(self.springs_changes, self.bem_changes, strict=True)]

    @property
    def over_bem_rolled_off(self) -> Estimates:
        return minus(self.springs_rolled_off, self.bem_rolled_off)


def levels(result: BandwidthResult, quantity: str) -> BandwidthLevels:
    statistic = STATISTICS[quantity]
    narrow = result.narrow["stiffness"]
    springs = [outcome["stiffness"] for outcome in result.springs]
    bem_changes = [change(statistic, before["stiffness"], wider["stiffness"]) for before, wider in result.pairs]
    return BandwidthLevels(
        bem=list(accumulate(bem_changes, plus, initial=jackknifed(statistic, narrow))),
        springs=[jackknifed(statistic, one) for one in springs],
        bem_changes=bem_changes,
        springs_changes=[change(statistic, *pair) for pair in pairwise(springs)],
        bem_rolled_off=jackknifed(statistic, result.rolled_off["stiffness"]),
        springs_rolled_off=jackknifed(statistic, result.springs_rolled_off["stiffness"]),
        grid=change(statistic, narrow, result.refined["stiffness"]),
    )
