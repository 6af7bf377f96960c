"""Fig. 14.1 decade by decade of force: one method beside the other, the errors of sample and grid apart."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Place
from validation.analysis.statistics import (
    DECIBEL,
    FIVE_PER_CENT,
    THREE_PER_CENT,
    Estimate,
    Sample,
    Statistic,
    difference_of_halves,
    mean_of,
    paired_samples,
    sample,
)
from validation.cases.punch.decade_statistics import deviation_over, exponent_over, mean_over
from validation.cases.punch.fractal_punch import LONG, Ensemble, FractalPunch
from validation.engine.engine import random_generator
from validation.simulation.rough_punch import BEM, BOOTSTRAP, MDR


@dataclass(frozen=True)
class DecadeQuantity:
    """A statistic over a decade of force, of one 1D model beside the boundary elements, and how near is near.

    over: the statistic, from the forces of the levels and the first force of the decade.
    """

    method: str
    over: Callable[[Sequence[float], float], Statistic]
    tolerance: float
    unit: str
    reason: str

    @property
    def scale(self) -> float:
        """From the natural logarithm to the unit."""
        return DECIBEL if self.unit == "dB" else 1.0


FIGURE = "3 %: the standard error of a deviation from the 500 profiles of the book, whose figure cannot show less"
LEVEL = "5 %: 0.4 dB, finer than one-third octave levels are measured"
DIGITS = "the published exponents have two digits"
QUANTITIES = {
    "relative deviation": DecadeQuantity(MDR, deviation_over, THREE_PER_CENT, "dB", FIGURE),
    "relative deviation, L_1D = 1.1523 L": DecadeQuantity(LONG, deviation_over, THREE_PER_CENT, "dB", FIGURE),
    "mean stiffness": DecadeQuantity(MDR, mean_over, FIVE_PER_CENT, "dB", LEVEL),
    "mean stiffness, L_1D = 1.1523 L": DecadeQuantity(LONG, mean_over, FIVE_PER_CENT, "dB", LEVEL),
    "exponent": DecadeQuantity(MDR, exponent_over, 0.02, "-", DIGITS),
}


@dataclass(frozen=True)
class DecadeComparison:
    """One quantity at one Hurst exponent in one decade of force, in natural logarithms, its three errors apart.

    hurst: None for the mean over all of them; first: force of the decade; springs, bem: with the error of the sample,
    bem on the grid of all surfaces; coarser, finer, refined_springs: what came of halving the cells of the coarsest
    grid, those of the middle one, and the springs.
    """

    name: str
    hurst: float | None
    first: float
    springs: Estimate
    bem: Estimate
    coarser: Estimate
    finer: Estimate
    refined_springs: Estimate

    @property
    def quantity(self) -> DecadeQuantity:
        return QUANTITIES[self.name]

    @property
    def correction(self) -> float:
        """To cells of zero size, to first order: twice the change by halving them once."""
        return 2 * self.finer.value

    @property
    def extrapolated(self) -> Estimate:
        """Boundary elements on cells of zero size, with the error of the sample."""
        return Estimate(self.bem.value + self.correction, self.bem.error, self.bem.samples)

    @property
    def grid(self) -> float:
        """How far the extrapolations of two pairs of grids lie apart; what few surfaces leave open; the springs."""
        apart = abs(self.correction - self.coarser.value)
        return apart + 2 * self.finer.half_width + abs(self.refined_springs.value)

    @property
    def where(self) -> dict[str, Place]:
        return {"H": "mean over H" if self.hurst is None else self.hurst, "Fbar": (self.first, 10 * self.first)}

    @property
    def number(self) -> Number | None:
        """What is left between the two is the model's; None where one of them has no such statistic."""
        quantity, springs, bem = self.quantity, self.springs, self.extrapolated
        if not np.isfinite([springs.value, springs.error, bem.value, bem.error, self.grid]).all():
            return None
        return difference(
            springs,
            bem,
            quantity=self.name,
            model="mdr over bem3d" if quantity.unit == "dB" else "mdr less bem3d",
            where=self.where,
            source="bem3d, extrapolated",
            tolerance=quantity.tolerance,
            reason=quantity.reason,
            unit=quantity.unit,
            scale=quantity.scale,
            grid=self.grid,
        )


@dataclass(frozen=True)
class EnsembleSamples:
    """The ensembles of one Hurst exponent, resampled: by method; and pairs of grids and of springs, coarse and fine."""

    methods: dict[str, Sample]
    coarser: Sample
    finer: Sample
    springs: Sample


def resampled(case: FractalPunch, h: int, ensemble: Ensemble) -> EnsembleSamples:
    """All of one Hurst exponent, the h-th of the case."""
    coarser, finer = ensemble.coarser["stiffness"], ensemble.finer["stiffness"]
    middle = ensemble.bem["stiffness"][: len(finer), np.isin(case.forces, case.refined_forces)]

    def draws(key: int) -> np.random.Generator:
        return random_generator(case.seed, BOOTSTRAP, h, key)

    return EnsembleSamples(
        {
            method: sample(outcome["stiffness"], draws(key))
            for key, (method, outcome) in enumerate(ensemble.by_method.items())
        },
        coarser=paired_samples(coarser, middle, draws(3)),
        finer=paired_samples(middle, finer, draws(4)),
        springs=paired_samples(ensemble.coarse["stiffness"], ensemble.mdr["stiffness"], draws(5)),
    )


def compare(case: FractalPunch, hurst: float, samples: EnsembleSamples, name: str, first: float) -> DecadeComparison:
    quantity = QUANTITIES[name]
    everywhere, refined = quantity.over(case.forces, first), quantity.over(case.refined_forces, first)
    return DecadeComparison(
        name,
        hurst,
        first,
        springs=samples.methods[quantity.method].estimate(everywhere),
        bem=samples.methods[BEM].estimate(everywhere),
        coarser=samples.coarser.estimate(difference_of_halves(refined)),
        finer=samples.finer.estimate(difference_of_halves(refined)),
        refined_springs=samples.springs.estimate(difference_of_halves(everywhere)),
    )


def mean_over_hursts(comparisons: Sequence[DecadeComparison]) -> DecadeComparison:
    """Of one quantity in one decade; the samples are independent of each other."""
    estimates = ("springs", "bem", "coarser", "finer", "refined_springs")
    means: dict[str, Any] = {name: mean_of([getattr(c, name) for c in comparisons]) for name in estimates}
    return replace(comparisons[0], hurst=None, **means)


def comparisons_of(case: FractalPunch, samples: Sequence[EnsembleSamples]) -> list[DecadeComparison]:
    """Of every quantity: by Hurst exponent and then by decade, the means over the exponents last."""
    comparisons = []
    for name in QUANTITIES:
        by_decade = [
            [compare(case, hurst, mine, name, first) for hurst, mine in zip(case.hursts, samples, strict=True)]
            for first in case.first_forces
        ]
        comparisons += [by_hurst[h] for h in range(len(case.hursts)) for by_hurst in by_decade]
        if len(case.hursts) > 1:
            comparisons += map(mean_over_hursts, by_decade)
    return comparisons


def numbers_of(comparisons: Iterable[DecadeComparison]) -> list[Number]:
    return [number for comparison in comparisons if (number := comparison.number) is not None]


def data_row(comparison: DecadeComparison) -> dict[str, object]:
    """In the data: what stands behind a verdict; H is NaN for the mean over all."""
    number, quantity = comparison.number, comparison.quantity
    value = math.exp if quantity.unit == "dB" else float
    return {
        "quantity": comparison.name,
        "H": math.nan if comparison.hurst is None else comparison.hurst,
        "Fbar from": comparison.first,
        "Fbar to": 10 * comparison.first,
        "mdr": value(comparison.springs.value),
        "bem3d": value(comparison.bem.value),
        "bem3d extrapolated": value(comparison.extrapolated.value),
        "unit of the difference": quantity.unit,
        "difference": math.nan if number is None else number.value,
        "± sample": math.nan if number is None else number.sample,
        "± grid": math.nan if number is None else number.grid,
        "verdict": "" if number is None else str(number.verdict),
        "times the sample that would decide": math.nan if number is None else number.sample_needed,
    }
