"""One method of a scene: prepare(scene, resolution) gives solve(realisation), and that gives values and counted work.

Model selection adds an estimate of the error, the benchmarks add a clock.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from validation.analysis.statistics import student
from validation.engine.engine import FloatArray

Values = Mapping[str, FloatArray]
"""By name; where a solve has several realisations, they are along the first axis."""


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """size: cells or springs on a length of the scene; residual: of a solver, zero where there is none."""

    size: float = 1.0
    residual: float = 0.0


@dataclass(frozen=True, eq=False)
class Result:
    """Values of a solve, and its work, which is the same on every machine.

    work: cells times operator applications, springs evaluated, points filtered; NaN where it is not counted;
    count: realisations in this solve; failed: why its values are none, empty where they are.
    """

    values: Values
    work: float = math.nan
    count: int = 1
    failed: str = ""


@dataclass(frozen=True, eq=False)
class Solve:
    """One realisation, ready to be solved.

    run: the solve itself, which a clock may time; read: its Result, which is not timed; repeatable: whether a second
    run takes as long as the first.
    """

    run: Callable[[], Any]
    read: Callable[[Any], Result]
    repeatable: bool = True

    def __call__(self) -> Result:
        return self.read(self.run())


Prepared = Callable[[int], Solve]
"""From the number of a realisation to its solve, from a cold start."""


class Method(Protocol):
    """A frozen dataclass; what it needs to know of a scene, the scene gives."""

    @property
    def name(self) -> str:
        """The label of the method in tables and figures."""

    def prepare(self, scene: Any, resolution: Resolution) -> Prepared:
        """Set-up, once for all realisations. Raises ValueError where the scene is out of range."""


STUDENT = 2.0
"""Standard errors of a 95 % interval; samples here have eight realisations or more, or say so by a wider one."""
FEWEST = 8
"""Realisations of a sample, at the least: it is looked at after each, and ends where it happens to scatter little.
Of normal samples and of levels of a power, 0.7 to 0.9 % end with a mean off by more than twice its half-width where
they begin with four, 0.3 % with eight (tests/simulation/test_fewest_realisations.py)."""
SLOWEST = 0.8
"""Largest ratio of two changes that a sample may feign: four times the last change is then left."""
FEWEST_IN_CONTACT = 6
"""Cells or springs: an answer that stands on fewer is that of the grid, and none."""


def distance(value: FloatArray, other: FloatArray) -> float:
    """sqrt(mean(ln(x / y)^2)): how far two answers are apart, over all their numbers [-]."""
    return float(np.sqrt(np.mean(np.log(value / other) ** 2)))


def mean_error(ratios: FloatArray) -> float:
    """Half-width of 95 % that a sample leaves of the mean of logarithms, of all columns together.

    ratios: logarithms, shape (realisations, numbers), two realisations at least.
    """
    of_means = ratios.std(axis=0, ddof=1) / math.sqrt(len(ratios))
    return float(student(len(ratios) - 1) * np.sqrt(np.mean(of_means**2)))


def grid_error(earlier: FloatArray, last: FloatArray) -> float:
    """Half-width of 95 % that a grid leaves, of the changes of the logarithm by the last two refinements.

    earlier, last: one a realisation, the same ones on all grids. The mean of the last changes, and what the sample
    leaves of it, times r / (1 - r), the rest of a geometric series, where their ratio r is above a half; infinite where
    they do not shrink and that is not for want of a larger sample: such a sequence of grids has no limit to see.
    """
    before, after = (abs(float(change.mean())) for change in (earlier, last))
    noise_before, noise = (mean_error(change[:, np.newaxis]) for change in (earlier, last))
    if after <= noise:
        return after + noise
    if after >= before + noise_before:
        return math.inf
    ratio = after / before
    if after - noise <= SLOWEST * (before + noise_before):
        ratio = min(ratio, SLOWEST)
    return (after + noise) * max(1.0, ratio / (1 - ratio)) if ratio < 1 else math.inf


def realisations(deviation: float, error: float, *, least: int = FEWEST, most: int = 2000) -> int:
    """How many leave a mean within a relative error, 95 %: (2 s / e)^2, between two bounds.

    deviation: s, relative, of one realisation; error: e.
    """
    return int(np.clip(math.ceil((STUDENT * deviation / error) ** 2), least, most))


def too_few(count: float, what: str) -> str:
    """Why there is no answer where half of the contacts have fewer than six cells or springs; empty where they have."""
    if count >= FEWEST_IN_CONTACT:
        return ""
    return f"half of the contacts have {count:.2g} {what} or fewer: the answer would be that of the grid"
