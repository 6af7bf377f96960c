"""Contact area, mean gap, stiffness and its fluctuation at each roll-off: MDR over boundary elements."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role
from validation.analysis.over_range import worst
from validation.analysis.statistics import (
    DECIBEL,
    FIVE_PER_CENT,
    Estimate,
    FloatArray,
    Sample,
    Statistic,
    at_level,
    decade_slope,
    extrapolated,
    jackknifed,
    local_slope,
    log_mean,
    log_relative_deviation,
    sample,
    weighted_mean,
)
from validation.cases.punch.area_gap_rolloff import MdrLimits, MdrLimitsResult
from validation.cases.punch.ensembles import Row, cells_in_contact, interval_columns
from validation.cases.punch.rough_interface import Layer
from validation.engine.random_numbers import random_generator
from validation.simulation.rough_punch import BEM, BOOTSTRAP, MDR, METHODS
from validation.theory import closed_forms

STIFFNESS, AREA, GAP, DEVIATION = "stiffness", "contact fraction", "mean gap", "relative deviation"
EXPONENT = "exponent of the stiffness of the interface"
MEASURED = {"stiffness": STIFFNESS, "area": AREA, "gap": GAP}
"""Names of what an outcome holds."""
ROLL_OFF, FORCE = "q_r L / 2π", "Fbar"
EDGE = 1e-9
"""By which a force may miss the ends of its decade."""
MIN_ROLL_OFF = 4
"""From here on the stiffness of the interface is proportional to the load in theory."""
ZERO_GAP = 1e-12
"""A mean gap over L that counts as none."""


@dataclass(frozen=True)
class RollOffSamples:
    """What was measured at one roll-off, resampled, by method and quantity.

    grids: by quantity, on cells and on cells half as wide, shape (surfaces, 2, levels).
    """

    roll_off: int
    by_method: dict[tuple[str, str], Sample]
    grids: dict[str, FloatArray]

    def finer(self, measured: str, statistic: Statistic) -> Estimate:
        """The change to cells half as wide; by the jackknife, since the surfaces are few."""

        def of_grid(pairs: FloatArray, grid: int) -> FloatArray:
            return statistic(pairs[:, grid].mean(axis=0), pairs[:, grid].std(axis=0, ddof=1))

        (found,) = jackknifed(lambda pairs: of_grid(pairs, 1) - of_grid(pairs, 0), self.grids[measured])
        return found

    def extrapolated(self, measured: str, statistic: Statistic) -> tuple[Estimate, float]:
        """Boundary elements on cells of zero size, and what that leaves open."""
        return extrapolated(self.by_method[BEM, measured].estimate(statistic), self.finer(measured, statistic))

    def over_bem(self, quantity: str, measured: str, statistic: Statistic, force: float, among: int) -> Number:
        """MDR over boundary elements in decibels, at a force, which is one `among` so many of a range."""
        bem, grid = self.extrapolated(measured, statistic)
        return difference(
            self.by_method[MDR, measured].estimate(statistic),
            bem,
            quantity=quantity,
            model="mdr over bem3d",
            where={ROLL_OFF: self.roll_off, FORCE: force},
            source="bem3d, extrapolated",
            tolerance=FIVE_PER_CENT,
            reason="5 %: 0.4 dB, finer than one-third octave levels are measured",
            scale=DECIBEL,
            grid=grid,
            among=among,
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
        grids[measured] = np.stack([np.maximum(coarse, ZERO_GAP), np.maximum(fine, ZERO_GAP)], axis=1)
    return RollOffSamples(roll_off, by_method, grids)


def numbers_over(case: MdrLimits, mine: RollOffSamples, layers: Mapping[str, Layer], first: float) -> list[Number]:
    """At the worst force of a decade, and exponents over it."""
    levels = [i for i, force in enumerate(case.forces) if first * (1 - EDGE) <= force <= 10 * first * (1 + EDGE)]
    judged = [(name, measured, log_mean) for measured, name in MEASURED.items()]
    judged.append((DEVIATION, "stiffness", log_relative_deviation))
    numbers = [n for one in judged for n in _worst(case, mine, levels, *one)]
    if mine.roll_off < MIN_ROLL_OFF:
        return numbers
    exponents = (_exponent(case, mine, layers[method], method, first) for method in METHODS)
    return numbers + [number for number in exponents if number is not None]


def _worst(
    case: MdrLimits, mine: RollOffSamples, levels: Sequence[int], quantity: str, measured: str, statistic: Statistic
) -> list[Number]:
    """Of the forces at which springs have it: in full contact they have neither gap nor fluctuation."""
    mean, _ = mine.by_method[MDR, measured].moments
    springs = {i: mine.by_method[MDR, measured].estimate(at_level(i, statistic)) for i in levels}
    kept = [i for i in levels if mean[i] > ZERO_GAP and math.isfinite(springs[i].value + springs[i].error)]
    among = len(kept) * _cells(case)
    points = [mine.over_bem(quantity, measured, at_level(i, statistic), case.forces[i], among) for i in kept]
    return [worst(points, FORCE)] if len(points) > 1 else []


def _cells(case: MdrLimits) -> int:
    """Numbers of a claim, whose intervals hold at once: decades and roll-offs, of area and gap."""
    return 2 * len(case.first_forces) * len(case.roll_offs)


def _exponent(case: MdrLimits, mine: RollOffSamples, layer: Layer, method: str, first: float) -> Number | None:
    """d ln kappa / d ln F over a decade; None where the punch is as stiff as the flat one."""
    slope = weighted_mean(decade_slope(case.forces, first), layer.statistic)
    found, grid = mine.by_method[method, "stiffness"].estimate(slope), 0.0
    if method == BEM:
        found, grid = mine.extrapolated("stiffness", slope)
    if not np.isfinite([found.value, found.error, grid]).all():
        return None
    return Number(
        quantity=EXPONENT,
        model=method,
        where={ROLL_OFF: mine.roll_off, FORCE: (first, 10 * first)},
        value=found.value,
        reference=1.0,
        source="stiffness proportional to load: Pastewka et al. (2013), for q_r L / 2π >> 1",
        tolerance=0.115,
        reason="half of the distance to 0.77, the largest exponent published for roughness without a roll-off",
        grid=grid,
        sample=found.half_width_among(_cells(case)),
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
        slope = stiffness.estimate(weighted_mean(local_slope(case.forces, level), interface))
        row[f"{method} exponent of the interface"] = slope.value
    row["Persson contact fraction"] = persson(result, mine.roll_off, level)
    return row | cells_in_contact(row[f"{BEM} {AREA}"], case.cells)


def value_of(case: MdrLimits, measured: str) -> Callable[[float], float]:
    """What a natural logarithm of it stands for: a gap is over h, all else in units of L = E* = 1."""
    return lambda log: math.exp(log) / (case.height if measured == "gap" else 1.0)


def persson(result: MdrLimitsResult, roll_off: int, level: int) -> float:
    """Persson's contact fraction for the rms gradient of the surfaces."""
    case = result.case
    gradient = float(result.bem[roll_off]["gradient"].mean())
    return closed_forms.persson_contact_fraction(case.height * case.forces[level], gradient=gradient)
