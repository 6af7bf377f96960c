"""Fig. 14.1 decade by decade of force: one method beside the other, the errors of sample and grid apart."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from validation.analysis.evidence import Number, Role, Table, Verdict, VerdictCell
from validation.analysis.statistics import (
    DECIBEL,
    FIVE_PER_CENT,
    THREE_PER_CENT,
    Estimate,
    Sample,
    Statistic,
    decade_slope,
    decade_weights,
    difference_of_halves,
    log_deviation_over,
    log_mean,
    mean_of,
    paired_samples,
    sample,
    weighted_mean,
)
from validation.cases.punch.fractal_punch import Ensemble, FractalPunch
from validation.engine.engine import random_generator
from validation.simulation.rough_punch import BEM, BOOTSTRAP, MDR

Forces = tuple[float, ...]

LONG = "mdr 1.1523 L"
OUT_OF_REACH = 100.0
"""Times the sample; what would take more is as good as undecidable."""


@dataclass(frozen=True)
class DecadeQuantity:
    """A statistic over a decade of force, of one 1D model beside the boundary elements, and how near is near.

    over: the statistic, from the forces of the levels and the first force of the decade.
    """

    method: str
    over: Callable[[Forces, float], Statistic]
    tolerance: float
    unit: str
    reason: str

    @property
    def scale(self) -> float:
        """From the natural logarithm to the unit."""
        return DECIBEL if self.unit == "dB" else 1.0


def _mean(forces: Forces, first: float) -> Statistic:
    return weighted_mean(decade_weights(forces, first), log_mean)


def _deviation(forces: Forces, first: float) -> Statistic:
    return log_deviation_over(decade_weights(forces, first))


def _exponent(forces: Forces, first: float) -> Statistic:
    """d ln k / d ln F of the mean stiffness over the decade."""
    return weighted_mean(decade_slope(forces, first), log_mean)


FIGURE = "3 %: the standard error of a deviation from the 500 profiles of the book, whose figure cannot show less"
LEVEL = "5 %: 0.4 dB, less than a third-octave level resolves"
DIGITS = "the published exponents have two digits"
QUANTITIES = {
    "relative deviation": DecadeQuantity(MDR, _deviation, THREE_PER_CENT, "dB", FIGURE),
    "relative deviation, L_1D = 1.1523 L": DecadeQuantity(LONG, _deviation, THREE_PER_CENT, "dB", FIGURE),
    "mean stiffness": DecadeQuantity(MDR, _mean, FIVE_PER_CENT, "dB", LEVEL),
    "mean stiffness, L_1D = 1.1523 L": DecadeQuantity(LONG, _mean, FIVE_PER_CENT, "dB", LEVEL),
    "exponent": DecadeQuantity(MDR, _exponent, 0.02, "-", DIGITS),
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
        """What is compared."""
        return QUANTITIES[self.name]

    @property
    def correction(self) -> float:
        """To cells of no size, to first order: what halving them has changed, halving on and on will change again."""
        return 2 * self.finer.value

    @property
    def extrapolated(self) -> Estimate:
        """Boundary elements on cells of no size, with the error of the sample."""
        return Estimate(self.bem.value + self.correction, self.bem.error, self.bem.samples)

    @property
    def left(self) -> float:
        """How far the extrapolations of two pairs of grids lie apart; what few surfaces leave open; the springs."""
        apart = abs(self.correction - self.coarser.value)
        return apart + 2 * self.finer.half_width + abs(self.refined_springs.value)

    @property
    def number(self) -> Number | None:
        """What is left between the two is the model's; None where one of them has no such statistic."""
        quantity, apart = self.quantity, self.springs.minus(self.extrapolated)
        if not np.isfinite([apart.value, apart.error, self.left]).all():
            return None
        of = "mean over H" if self.hurst is None else f"H = {self.hurst:g}"
        methods = "mdr over bem3d" if quantity.unit == "dB" else "mdr less bem3d"
        return Number(
            quantity=f"{self.name} at {of}, Fbar = {self.first:g} to {10 * self.first:g}: {methods}",
            value=quantity.scale * apart.value,
            reference=0.0,
            source="bem3d, extrapolated",
            tolerance=quantity.tolerance,
            unit=quantity.unit,
            reason=quantity.reason,
            grid=quantity.scale * self.left,
            sample=quantity.scale * apart.half_width,
            role=Role.FINDING,
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
    realisations = (ensemble.bem, ensemble.mdr, ensemble.long)
    coarser, finer = ensemble.coarser["stiffness"], ensemble.finer["stiffness"]
    middle = ensemble.bem["stiffness"][: len(finer), np.isin(case.forces, case.refined_forces)]

    def draws(key: int) -> np.random.Generator:
        return random_generator(case.seed, BOOTSTRAP, h, key)

    return EnsembleSamples(
        {
            method: sample(outcome["stiffness"], draws(key))
            for key, (method, outcome) in enumerate(zip((BEM, MDR, LONG), realisations, strict=True))
        },
        coarser=paired_samples(coarser, middle, draws(3)),
        finer=paired_samples(middle, finer, draws(4)),
        springs=paired_samples(ensemble.coarse["stiffness"], ensemble.mdr["stiffness"], draws(5)),
    )


def compare(case: FractalPunch, hurst: float, samples: EnsembleSamples, name: str, first: float) -> DecadeComparison:
    """One quantity, one Hurst exponent, one decade."""
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
    return DecadeComparison(
        comparisons[0].name,
        None,
        comparisons[0].first,
        springs=mean_of([c.springs for c in comparisons]),
        bem=mean_of([c.bem for c in comparisons]),
        coarser=mean_of([c.coarser for c in comparisons]),
        finer=mean_of([c.finer for c in comparisons]),
        refined_springs=mean_of([c.refined_springs for c in comparisons]),
    )


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


def matrix(case: FractalPunch, name: str, comparisons: Sequence[DecadeComparison]) -> Table:
    """On the page: a row a Hurst exponent, a column a decade."""
    mine = [c for c in comparisons if c.name == name]
    hursts = list(dict.fromkeys("all" if c.hurst is None else f"{c.hurst:g}" for c in mine))
    decades: dict[str, list[object]] = {}
    for c in mine:
        decades.setdefault(f"Fbar {c.first:g} to {10 * c.first:g}", []).append(_verdict(case, c.number))
    what = "MDR over boundary elements" if QUANTITIES[name].unit == "dB" else "MDR less boundary elements"
    return Table(f"{name}: {what}, with the 95 % interval of sample and grid", {"H": hursts, **decades})


def _verdict(case: FractalPunch, number: Number | None) -> str | VerdictCell:
    """The difference in per cent, or as it stands, with its whole interval; what would decide it."""
    if number is None:
        return "no value"
    after = decided_by(case, number) if number.verdict is Verdict.UNDECIDED else ""
    return VerdictCell(_interval(number), number.verdict, after)


def _interval(number: Number) -> str:
    """Value and ends of the whole interval, decibels as per cent."""
    half = number.uncertainty
    middle, low, high = (
        _text(value, number.unit) for value in (number.value, number.value - half, number.value + half)
    )
    return f"{middle} ({low.removesuffix(' %')} to {high.removesuffix(' %')})"


def decided_by(case: FractalPunch, number: Number) -> str:
    """How many realisations would tell, if value and grid error stayed."""
    needed = number.sample_needed
    if math.isinf(needed):
        return "the grid must tell first"
    if needed > OUT_OF_REACH:
        return f"over {OUT_OF_REACH:.0f} times the sample would tell"
    return f"{math.ceil(needed * case.surfaces)} surfaces, {math.ceil(needed * case.profiles)} profiles would tell"


def summary(name: str, comparisons: Sequence[DecadeComparison]) -> str:
    """How many agree, differ, are open; the range; and what stands out when all Hurst exponents are taken together."""
    numbers = [n for c in comparisons if c.name == name and c.hurst is not None and (n := c.number) is not None]
    whole = [c for c in comparisons if c.name == name and c.hurst is None]
    together = [(c.first, n) for c in whole if (n := c.number) is not None]
    verdicts = [n.verdict for n in numbers]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in Verdict if v in verdicts)
    quantity = QUANTITIES[name]
    near = _text(quantity.tolerance, quantity.unit).lstrip("+")
    apart = [n.value for n in numbers]
    means = "; ".join(f"{_interval(n)} from Fbar = {first:g} to {10 * first:g}: {n.verdict}" for first, n in together)
    return (
        f"{name[0].upper()}{name[1:]}, MDR beside boundary elements within {near}. Mean over H: {means}. Of the single "
        f"comparisons {counts}; they lie from {_text(min(apart), quantity.unit)} to "
        f"{_text(max(apart), quantity.unit)}."
    )


def _text(value: float, unit: str) -> str:
    return f"{100 * math.expm1(value / DECIBEL):+.0f} %" if unit == "dB" else f"{value:+.3f}"
