"""Whether two models that were solved can both be right, and which of them is taken where they cannot."""

import math

import numpy as np

from validation.advice.scene_model import Answer

ALIKE = 2.0
"""Ratio of two errors that a sample may feign: the scatter of eight surfaces, the fewest, is known within this factor
(7 / chi², the 2.5 % quantile of seven degrees of freedom being 1.69: sqrt(7 / 1.69) = 2.04)."""


def bias(answer: Answer) -> tuple[float, float]:
    """By which models whose errors are alike are ordered: what the model leaves, and of equal ones all that is left."""
    return answer.model, answer.error


def contradict(one: Answer, other: Answer, tolerance: float) -> bool:
    """Whether the 95 % intervals of two answers lie apart, and their values by more than the tolerance (relative).

    Of numbers with errors in each band in any band in which the tolerance counts, else by the root mean square of the
    logarithms. An unknown error contradicts nothing.
    """
    apart = np.abs(np.log(one.value / other.value))
    if one.band_errors and other.band_errors:
        both = (one.error_in_bands + other.error_in_bands) * math.log(10) / 20
        counts = np.array(one.counts or [True] * apart.size) & np.array(other.counts or [True] * apart.size)
    else:
        apart = np.sqrt(np.mean(apart**2, keepdims=True))
        both, counts = np.array([math.log1p(one.error) + math.log1p(other.error)]), np.array([True])
    return bool((counts & (apart > both) & (apart > math.log1p(tolerance))).any())


def distance_of(one: Answer, other: Answer) -> float:
    """Relative, the largest of the bands in which the tolerance counts, else the root mean square."""
    apart = np.abs(np.log(one.value / other.value))
    if one.band_errors and other.band_errors and one.counts:
        return math.expm1(float(apart[np.array(one.counts)].max(initial=0.0)))
    return math.expm1(float(np.sqrt(np.mean(apart**2))))
