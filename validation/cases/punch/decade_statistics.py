"""Statistics of rough punches over a decade of force, and at one force, as natural logarithms."""

from collections.abc import Sequence

from validation.analysis.statistics import (
    Statistic,
    decade_slope,
    decade_weights,
    local_slope,
    log_deviation_over,
    log_mean,
    weighted_mean,
)


def deviation_over(forces: Sequence[float], first: float) -> Statistic:
    """ln of the root mean square of the relative deviation."""
    return log_deviation_over(decade_weights(forces, first))


def exponent_over(forces: Sequence[float], first: float, value: Statistic = log_mean) -> Statistic:
    """d ln k / d ln F of the mean stiffness; value: ln of another one."""
    return weighted_mean(decade_slope(forces, first), value)


def local_exponent(forces: Sequence[float], level: int, value: Statistic = log_mean) -> Statistic:
    """The same between the neighbours of a level."""
    return weighted_mean(local_slope(forces, level), value)
