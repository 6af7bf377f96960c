"""Factors by which a number is off everywhere, and what each is commonly forgotten for."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from validation.analysis.statistics import FloatArray

NEAR, SPARE = 0.006, 0.01
"""Relative: of a factor that is known by a name; of each point, beside its error."""
LEAST, MOST_OF, OFF = 5, 0.95, 0.02
"""Points that have a factor in common, the part of them that keep to it, and the least that a factor is off one."""
OF_VALUES: Mapping[str, float] = {
    "E for E*, at nu = 0.3": 1 - 0.3**2,
    "E* divided by 1 - nu^2 once more, at nu = 0.3": 1 / (1 - 0.3**2),
    "E for E*, at nu = 1/3": 8 / 9,
    "E* divided by 1 - nu^2 once more, at nu = 1/3": 9 / 8,
    "E for E*, at nu = 0.5": 3 / 4,
    "4/3: E* divided by 1 - nu^2 once more at nu = 0.5, or the factor of Hertz": 4 / 3,
    "a factor 2: a diameter for a radius, or one-sided for two-sided": 2.0,
    "a factor 1/2: a radius for a diameter, or E* of two equal bodies for that of one": 0.5,
    "a factor 4": 4.0,
    "a factor 1/4": 0.25,
    "a factor pi": math.pi,
    "a factor 1/pi": 1 / math.pi,
    "a factor 2 pi: per radian for per cycle": 2 * math.pi,
    "a factor 1/(2 pi): per cycle for per radian": 1 / (2 * math.pi),
    "a factor sqrt(2): an amplitude for an rms value, or a gradient for a slope": math.sqrt(2),
    "a factor 1/sqrt(2): an rms value for an amplitude, or a slope for a gradient": 1 / math.sqrt(2),
    "1.1523, the factor of a square punch": 1.1523,
    "1/1.1523, without the factor of a square punch": 1 / 1.1523,
    "2/sqrt(pi), a circular punch of equal area": 2 / math.sqrt(math.pi),
    "sqrt(pi)": math.sqrt(math.pi),
    "1/sqrt(pi)": 1 / math.sqrt(math.pi),
}
"""Ratios of values, or of amplitudes."""
OF_POWERS: Mapping[str, float] = {
    "one-sided for two-sided": 2.0,
    "two-sided counted as one-sided": 0.5,
    "a factor pi": math.pi,
    "a factor 1/pi": 1 / math.pi,
    "a factor 2 pi: per radian for per cycle": 2 * math.pi,
    "a factor 1/(2 pi): per cycle for per radian": 1 / (2 * math.pi),
    "a factor 2 of the amplitude": 4.0,
    "a factor 1/2 of the amplitude": 0.25,
    "E for E*, at nu = 0.3": 0.91**2,
    "E* divided by 1 - nu^2 once more, at nu = 0.3": 0.91**-2,
    "E for E*, at nu = 1/3": (8 / 9) ** 2,
    "E* divided by 1 - nu^2 once more, at nu = 1/3": (9 / 8) ** 2,
    "a factor 4 pi: per cycle and one-sided": 4 * math.pi,
    "a factor 1/(4 pi)": 1 / (4 * math.pi),
}
"""Ratios of powers, of which a level is 10 lg."""


class CommonFactor(NamedTuple):
    """factor: by which values are off; half: of its 95 % interval, relative; kept: how many points keep to it."""

    factor: float
    half: float
    kept: int


def common_factor(ratios: Sequence[float] | FloatArray, halves: Sequence[float] | FloatArray) -> CommonFactor | None:
    """The factor that nearly all ratios have within their errors, if it is not one; None where they have none.

    ratios: positive, of values over their references; halves: of their 95 % intervals, relative.
    """
    logs, errors = np.log(np.asarray(ratios, dtype=float)), np.asarray(halves, dtype=float)
    known = np.isfinite(logs) & np.isfinite(errors)
    logs, errors = logs[known], errors[known]
    if logs.size < LEAST:
        return None
    weights = 1 / (errors**2 + SPARE**2)
    mean = float(_median(logs, weights))
    kept = np.abs(logs - mean) <= errors + SPARE
    mean = float((weights * logs)[kept].sum() / weights[kept].sum())
    kept = np.abs(logs - mean) <= errors + SPARE
    half = 1 / math.sqrt(float(weights[kept].sum()))
    # most points must show by themselves that they are off
    shown = np.abs(logs) > errors + SPARE
    if kept.mean() < MOST_OF or shown.mean() < 0.5 or abs(mean) < max(OFF, half):
        return None
    return CommonFactor(math.exp(mean), half, int(kept.sum()))


def _median(values: FloatArray, weights: FloatArray) -> float:
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][int(np.searchsorted(total, total[-1] / 2))])


def named(factor: float, half: float, names: Mapping[str, float]) -> str:
    """What a factor may come from, the nearest first; nothing where it is none of these."""
    apart = {name: abs(math.log(factor / known)) for name, known in names.items()}
    near = sorted((name for name in apart if apart[name] <= NEAR + half), key=lambda one: apart[one])
    return "; or ".join(near[:2])
