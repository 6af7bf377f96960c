"""Fig. 14.1 force by force and decade by decade: one method beside the other, the errors of sample and grid apart."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from validation.analysis.evidence import Number, Place, Role
from validation.analysis.multilevel import Linearised, Moments, multilevel_moments, weighted_sum
from validation.analysis.over_range import worst
from validation.analysis.statistics import DECIBEL, LOG10_TOLERANCE, FloatArray
from validation.cases.punch.fractal_punch import LONG, Ensemble, FractalPunch, FractalPunchResult
from validation.simulation.rough_punch import BEM, MDR

MARGINS = {f"{percent} %": DECIBEL * math.log(1 + percent / 100) for percent in (3, 5, 10)} | {"3 dB": 3.0}
"""How near is near: verdicts within each of them stand side by side, in decibels."""
MARGIN = "10 %"
FIGURE = "10 %: three standard errors of a deviation from the 500 profiles of the book, whose figure cannot show less"
LEVEL = "10 %: 0.8 dB, finer than one-third octave levels of rolling are known"
DIGITS = "the published exponents have two digits"
NOTHING_LEFT = math.log(0.01)
"""A deviation below 1 % of the other one counts as 1 % of it: springs all in contact have none."""


@dataclass(frozen=True)
class DecadeQuantity:
    """A statistic of one 1D model beside the boundary elements, and how near is near."""

    method: str
    statistic: str
    tolerance: float
    unit: str
    reason: str

    @property
    def scale(self) -> float:
        """From the natural logarithm to the unit."""
        return DECIBEL if self.unit == "dB" else 1.0


MEAN, DEVIATION, EXPONENT = "mean stiffness", "relative deviation", "exponent"
QUANTITIES = {
    DEVIATION: DecadeQuantity(MDR, DEVIATION, MARGINS[MARGIN], "dB", FIGURE),
    f"{DEVIATION}, L_1D = 1.1523 L": DecadeQuantity(LONG, DEVIATION, MARGINS[MARGIN], "dB", FIGURE),
    MEAN: DecadeQuantity(MDR, MEAN, MARGINS[MARGIN], "dB", LEVEL),
    f"{MEAN}, L_1D = 1.1523 L": DecadeQuantity(LONG, MEAN, MARGINS[MARGIN], "dB", LEVEL),
    EXPONENT: DecadeQuantity(MDR, EXPONENT, 0.02, "-", DIGITS),
}


@dataclass(frozen=True, eq=False)
class Resolved:
    """A statistic on cells, or springs, of no size, in natural logarithms.

    grid: half-width that the grids leave open; on: its value on each grid, coarse to fine.
    """

    value: Linearised
    grid: float
    on: Mapping[int, float]


def extrapolated(steps: Mapping[int, Linearised]) -> Resolved:
    """To cells of no size, to first order from the two finest grids; how far that is from the next two."""
    coarse, middle, fine = list(steps.values())[-3:]
    apart = abs(2 * (fine.value - middle.value) - (middle.value - coarse.value))
    return Resolved(2.0 * fine - middle, apart, _values(steps))


def on_finest(steps: Mapping[int, Linearised]) -> Resolved:
    """As it is on the finest grid; by how much that changed it."""
    *_, coarse, fine = steps.values()
    change = abs(fine.value - coarse.value) if math.isfinite(fine.value) else 0.0
    return Resolved(fine, change, _values(steps))


def _values(steps: Mapping[int, Linearised]) -> dict[int, float]:
    return {cells: step.value for cells, step in steps.items()}


def combined(weights: Sequence[float] | FloatArray, parts: Sequence[Resolved]) -> Resolved:
    """sum_i w_i x_i; grid errors add up as if they went the same way."""
    grid = float(np.dot(np.abs(weights), [part.grid for part in parts]))
    return Resolved(weighted_sum(weights, [part.value for part in parts]), grid, {})


@dataclass(frozen=True)
class PunchStatistics:
    """Statistics of all ensembles, at each force; None for the mean over Hurst exponents, whose phases are common."""

    result: FractalPunchResult

    @property
    def case(self) -> FractalPunch:
        return self.result.case

    @cached_property
    def _moments(self) -> dict[tuple[float, str, int], dict[int, Moments]]:
        """By Hurst exponent, method and level of force: on each grid."""
        return {
            (ensemble.hurst, method, level): dict(zip(pressed, multilevel_moments(list(pressed.values())), strict=True))
            for ensemble in self.result.ensembles
            for method in ensemble.outcomes
            for level in range(len(self.case.forces))
            for pressed in [stiffness_on_grids(ensemble, method, level)]
        }

    def at(self, hurst: float | None, method: str, statistic: str, level: int) -> Resolved:
        """ln of the mean stiffness, or of the relative deviation, under one force."""
        if hurst is None:
            hursts = self.case.hursts
            every = [self.at(h, method, statistic, level) for h in hursts]
            return combined([1 / len(hursts)] * len(hursts), every)
        steps = {
            cells: mine.log_mean if statistic == MEAN else mine.log_relative_deviation
            for cells, mine in self._moments[hurst, method, level].items()
        }
        return extrapolated(steps) if method == BEM else on_finest(steps)

    def exponent(self, hurst: float | None, method: str, before: int, after: int) -> Resolved:
        """d ln k / d ln F of the mean stiffness from one level of force to another."""
        slope = 1 / math.log(self.case.forces[after] / self.case.forces[before])
        ends = [self.at(hurst, method, MEAN, level) for level in (before, after)]
        return combined([-slope, slope], ends)

    def trend(self, method: str, level: int) -> Resolved:
        """d ln deviation / d H by least squares over the Hurst exponents: positive if the deviation rises with H."""
        apart = np.array(self.case.hursts) - np.mean(self.case.hursts)
        return combined(apart / (apart**2).sum(), [self.at(h, method, DEVIATION, level) for h in self.case.hursts])


def stiffness_on_grids(ensemble: Ensemble, method: str, level: int) -> dict[int, FloatArray]:
    """Of every realisation under one force, on each grid where some were pressed; NaN for the others."""
    columns = {cells: outcome["stiffness"][:, level] for cells, outcome in ensemble.outcomes[method].items()}
    most = max(column.size for column in columns.values())
    return {
        cells: np.pad(column, (0, most - column.size), constant_values=np.nan)
        for cells, column in columns.items()
        if np.isfinite(column).any()
    }


@dataclass(frozen=True, eq=False)
class PointComparison:
    """One quantity at one Hurst exponent, at one force or over a range, and among how many points it is judged."""

    name: str
    hurst: float | None
    force: Place
    springs: Resolved
    bem: Resolved
    among: int

    @property
    def quantity(self) -> DecadeQuantity:
        return QUANTITIES[self.name]

    @property
    def ratio(self) -> Linearised:
        """Springs over boundary elements; surfaces and profiles are independent."""
        ratio = self.springs.value.beside(self.bem.value)
        if ratio.value < NOTHING_LEFT and self.quantity.statistic == DEVIATION:
            return Linearised(NOTHING_LEFT, np.zeros(1))
        return ratio

    @property
    def grid(self) -> float:
        return self.springs.grid + self.bem.grid

    @property
    def number(self) -> Number | None:
        """What is left between the two is the model's; None where one of them has no such statistic."""
        quantity, ratio = self.quantity, self.ratio
        if not np.isfinite([ratio.value, ratio.error, self.grid]).all():
            return None
        return Number(
            quantity=self.name,
            model="mdr over bem3d" if quantity.unit == "dB" else "mdr less bem3d",
            where={"H": "mean over H" if self.hurst is None else self.hurst, "Fbar": self.force},
            value=quantity.scale * ratio.value,
            reference=0.0,
            source="bem3d, extrapolated",
            tolerance=quantity.tolerance,
            reason=quantity.reason,
            unit=quantity.unit,
            grid=quantity.scale * self.grid,
            sample=quantity.scale * ratio.half_width_among(self.among),
            role=Role.FINDING,
        )


@dataclass(frozen=True, eq=False)
class DecadeComparison:
    """One quantity at one Hurst exponent in one decade of force; hurst: None for the mean over all of them."""

    name: str
    hurst: float | None
    first: float
    points: tuple[PointComparison, ...]

    @cached_property
    def numbers(self) -> list[Number]:
        """At each force; their intervals hold at once."""
        return [number for point in self.points if (number := point.number) is not None]

    @property
    def signed_mean(self) -> float:
        """Of MDR / boundary elements - 1: what no verdict is taken from."""
        return float(np.mean(np.exp([point.ratio.value for point in self.points]))) - 1

    @property
    def number(self) -> Number | None:
        """The worst point, whose verdict is that of the decade; None where a force has no such statistic."""
        return self.within(QUANTITIES[self.name].tolerance)

    def within(self, tolerance: float) -> Number | None:
        """The same within another tolerance."""
        if len(self.numbers) < len(self.points):
            return None
        numbers = [replace(number, tolerance=tolerance) for number in self.numbers]
        return numbers[0] if len(numbers) == 1 else worst(numbers, "Fbar")


def comparisons_of(found: PunchStatistics) -> list[DecadeComparison]:
    """Of every quantity: by Hurst exponent and then by decade, the means over the exponents last."""
    case = found.case
    hursts: list[float | None] = [*case.hursts, *([None] if len(case.hursts) > 1 else [])]
    return [
        _compare(found, name, hurst, first) for name in QUANTITIES for hurst in hursts for first in case.first_forces
    ]


def _compare(found: PunchStatistics, name: str, hurst: float | None, first: float) -> DecadeComparison:
    quantity, forces = QUANTITIES[name], found.case.forces
    away = np.log10(np.array(forces) / first)
    levels = np.flatnonzero((away > -LOG10_TOLERANCE) & (away < 1 + LOG10_TOLERANCE)).tolist()
    if quantity.statistic == EXPONENT:
        springs, bem = (found.exponent(hurst, method, levels[0], levels[-1]) for method in (quantity.method, BEM))
        points = [PointComparison(name, hurst, (first, 10 * first), springs, bem, among=1)]
    else:
        points = []
        for level in levels:
            springs, bem = (found.at(hurst, method, quantity.statistic, level) for method in (quantity.method, BEM))
            points.append(PointComparison(name, hurst, forces[level], springs, bem, among=len(levels)))
    return DecadeComparison(name, hurst, first, tuple(points))


def numbers_of(comparisons: Iterable[DecadeComparison]) -> list[Number]:
    return [number for comparison in comparisons if (number := comparison.number) is not None]
