"""A sample that is looked at after each realisation ends where it happens to scatter little: it begins with eight."""

import numpy as np
import pytest
from scipy.special import digamma, polygamma

from validation.simulation.method import FEWEST, mean_error

SAMPLES, MOST, TOLERANCE, DEVIATION = 12000, 32, 0.07, 0.08


def far_off(fewest, draw):
    """The share of samples whose mean is off by more than twice the half-width with which they ended."""
    rng, far = np.random.default_rng(3), 0
    for _ in range(SAMPLES):
        rows = DEVIATION * draw(rng, (MOST, 1))
        count = next(n for n in range(fewest, MOST + 1) if n == MOST or mean_error(rows[:n]) <= TOLERANCE)
        far += abs(rows[:count].mean()) > 2 * mean_error(rows[:count])
    return far / SAMPLES


def normal(rng, shape):
    return rng.standard_normal(shape)


def skewed(rng, shape):
    """The level of a power of six degrees of freedom, of mean zero and variance one."""
    return (np.log(rng.gamma(3.0, size=shape)) - digamma(3.0)) / np.sqrt(polygamma(1, 3.0))


@pytest.mark.slow
@pytest.mark.parametrize("draw", [normal, skewed])
def test_samples_that_begin_with_eight_are_seldom_far_off(draw):
    assert FEWEST == 8
    assert far_off(FEWEST, draw) < 0.005 < far_off(4, draw)
