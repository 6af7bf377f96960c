"""Intervals on populations with a known answer: the share that holds the truth, and what that share must be."""

import math

from scipy import stats

TRIALS = 600
"""Of which 95 % are known to 0.9 %."""


def binomial(trials, share=0.95):
    """Four standard deviations of a share."""
    return 4 * math.sqrt(share * (1 - share) / trials)


def covered(draw, truth, *, trials=TRIALS):
    """The share of intervals (value, half-width) that hold the truth."""
    return sum(abs(value - truth) <= half for value, half in (draw() for _ in range(trials))) / trials


def holds(share, *, trials=TRIALS, short=0.0, wide=0.0):
    """95 % within the scatter of a count; short, wide: what an approximate interval may lack, or have too much."""
    return 0.95 - binomial(trials) - short <= share <= min(0.95 + binomial(trials) + wide, 1.0)


def ends(estimate):
    return estimate.value, estimate.half_width


def t(samples):
    return stats.t.ppf(0.975, samples - 1)
