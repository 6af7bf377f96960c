"""Contact area, mean gap, stiffness and its fluctuation at each roll-off, resampled: MDR over boundary elements."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role
from validation.analysis.statistics import (
    DECIBEL,
    FIVE_PER_CENT,
    Estimate,
    FloatArray,
    Sample,
    Statistic,
    at_level,
    decade_weights,
    difference_of_halves,
    extrapolated,
    log_mean,
    log_relative_deviation,
    paired_samples,
    sample,
)
from validation.cases.punch.area_gap_rolloff import MdrLimits, MdrLimitsResult
from validation.cases.punch.decade_statistics import deviation_over, exponent_over, local_exponent, mean_over
from validation.cases.punch.ensembles import Row, cells_in_contact, interval_columns
from validation.cases.punch.rough_interface import Layer
from validation.engine.engine import random_generator
from validation.simulation.rough_punch import BEM, BOOTSTRAP, MDR, METHODS
from validation.theory import closed_forms

STIFFNESS, AREA, GAP, DEVIATION = "stiffness", "contact fraction", "mean gap", "relative deviation"
EXPONENT = "exponent of the stiffness of the interface"
MEASURED = {"stiffness": STIFFNESS, "area": AREA, "gap": GAP}
"""Names of what an outcome holds."""
ROLL_OFF = "q_r L / 2π"
MIN_ROLL_OFF = 4
"""From here on the stiffness of the interface is proportional to the load in theory."""
ZERO_GAP = 1e-12
"""A mean gap over L that counts as none."""


@dataclass(frozen=True)
class RollOffSamples:
    """What was measured at one roll-off, resampled: by method and quantity; and by quantity, pairs of grids."""

    roll_off: int
    by_method: dict[tuple[str, str], Sample]
    grids: dict[str, Sample]

    def has_gap(self, weights: FloatArray) -> bool:
        """Whether MDR has a gap at all of these levels: none is left in full contact."""
        mean, _ = self.by_method[MDR, "gap"].moments
        return bool((mean[weights > 0] > ZERO_GAP).all())

    def extrapolated(self, measured: str, statistic: Statistic) -> tuple[Estimate, float]:
        """Boundary elements on cells of zero size, and what that leaves open."""
        bem = self.by_method[BEM, measured].estimate(statistic)
        return extrapolated(bem, self.grids[measured].estimate(difference_of_halves(statistic)))

    def where(self, first: float) -> dict[str, float | tuple[float, float]]:
        """Conditions of a number over the decade of force from `first`."""
        return {ROLL_OFF: self.roll_off, "Fbar": (first, 10 * first)}

    def over_bem(self, quantity: str, measured: str, statistic: Statistic, first: float) -> Number:
        """MDR over boundary elements in decibels, over the decade of force from `first`."""
        bem, grid = self.extrapolated(measured, statistic)
        return difference(
            self.by_method[MDR, measured].estimate(statistic),
            bem,
            quantity=quantity,
            model="mdr over bem3d",
            where=self.where(first),
            source="bem3d, extrapolated",
            tolerance=FIVE_PER_CENT,
            reason="5 %: 0.4 dB, finer than one-third octave levels are measured",
            scale=DECIBEL,
            grid=grid,
        )


def resampled(result: MdrLimitsResult, roll_off: int) -> RollOffSamples:
    case = result.case
    outcomes = {BEM: result.bem[roll_off], MDR: result.mdr[roll_off]}
    by_method, grids = {}, {}
    for i, measured in enumerate(MEASURED):
        for j, (method, outcome) in enumerate(outcomes.items()):
            # the gap of full contact is rounding
            values = np.maximum(outcome[measured], ZERO_GAP)
            by_method[method, measured] = sample(values, random_generator(case.seed, BOOTSTRAP, roll_off, i, j))
        coarse, fine = outcomes[BEM][measured][: case.refined], result.refined[roll_off][measured]
        grids[measured] = paired_samples(coarse, fine, random_generator(case.seed, BOOTSTRAP, roll_off, i, 2))
    return RollOffSamples(roll_off, by_method, grids)


def numbers_over(case: MdrLimits, mine: RollOffSamples, layers: Mapping[str, Layer], first: float) -> list[Number]:
    numbers = [
        mine.over_bem(name, measured, mean_over(case.forces, first), first)
        for measured, name in MEASURED.items()
        if name != GAP or mine.has_gap(decade_weights(case.forces, first))
    ]
    numbers.append(mine.over_bem(DEVIATION, "stiffness", deviation_over(case.forces, first), first))
    if mine.roll_off < MIN_ROLL_OFF:
        return numbers
    exponents = (_exponent(case, mine, layers[method], method, first) for method in METHODS)
    return numbers + [number for number in exponents if number is not None]


def _exponent(case: MdrLimits, mine: RollOffSamples, layer: Layer, method: str, first: float) -> Number | None:
    """d ln kappa / d ln F over a decade; None where the punch is as stiff as the flat one."""
    slope = exponent_over(case.forces, first, layer.statistic)
    found, grid = mine.by_method[method, "stiffness"].estimate(slope), 0.0
    if method == BEM:
        found, grid = mine.extrapolated("stiffness", slope)
    if not np.isfinite([found.value, found.error, grid]).all():
        return None
    return Number(
        quantity=EXPONENT,
        model=method,
        where=mine.where(first),
        value=found.value,
        reference=1.0,
        source="stiffness proportional to load: Pastewka et al. (2013), for q_r L / 2π >> 1",
        tolerance=0.115,
        reason="half of the distance to 0.77, the largest exponent published for roughness without a roll-off",
        grid=grid,
        sample=found.half_width,
        role=Role.FINDING,
    )


def curve(result: MdrLimitsResult, mine: RollOffSamples, layers: Mapping[str, Layer]) -> list[Row]:
    return [_row(result, mine, layers, level) for level in range(len(result.case.forces))]


def _row(result: MdrLimitsResult, mine: RollOffSamples, layers: Mapping[str, Layer], level: int) -> Row:
    case = result.case
    row = {ROLL_OFF: float(mine.roll_off), "Fbar": case.forces[level]}
    for method in METHODS:
        for measured, name in MEASURED.items():
            found = mine.by_method[method, measured].estimate(at_level(level, log_mean))
            row |= interval_columns(f"{method} {name}", found, value_of(case, measured))
        stiffness, interface = mine.by_method[method, "stiffness"], layers[method].statistic
        deviation = stiffness.estimate(at_level(level, log_relative_deviation))
        row |= interval_columns(f"{method} {DEVIATION}", deviation, math.exp)
        row |= interval_columns(f"{method} interface", stiffness.estimate(at_level(level, interface)), math.exp)
        slope = local_exponent(case.forces, level, interface)
        row[f"{method} exponent of the interface"] = stiffness.estimate(slope).value
    row["Persson contact fraction"] = persson(result, mine.roll_off, level)
    return row | cells_in_contact(row[f"{BEM} {AREA}"], case.cells)


def value_of(case: MdrLimits, measured: str) -> Callable[[float], float]:
    """What a natural logarithm of it stands for: a gap is over h, all else in units of L = E* = 1."""
    return lambda log: math.exp(log) / (case.height if measured == "gap" else 1.0)


def persson(result: MdrLimitsResult, roll_off: int, level: int) -> float:
    """Persson's contact fraction for the rms slope of the surfaces."""
    case = result.case
    slope = float(result.bem[roll_off]["gradient"].mean())
    return closed_forms.persson_contact_fraction(case.height * case.forces[level], gradient=slope)
