"""Numbers of Fig. 14.1: criteria on load curves and stiffness, the largest differences, exponents beside a law."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from validation.analysis.evidence import Number, Role
from validation.analysis.statistics import nearest
from validation.cases.punch.fractal_punch import FractalPunch, FractalPunchResult
from validation.cases.punch.fractal_punch_decades import (
    DEVIATION,
    EXPONENT,
    MARGINS,
    MEAN,
    QUANTITIES,
    DecadeComparison,
    PointComparison,
    numbers_of,
)
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR
from validation.theory import closed_forms

CONVEX = "largest excess of the slope of the load curve over the stiffnesses at its two ends"
PUBLISHED = (0.51, 0.77)
"""Exponents of fractal dimensions 2 to 3; Pohrt and Popov, Phys. Rev. Lett. 108, 104301 (2012), abstract."""


def criteria(result: FractalPunchResult, comparisons: Sequence[DecadeComparison]) -> tuple[Number, ...]:
    """Conditions that a correct computation must meet."""
    resolved = numbers_of(c for c in comparisons if c.name == MEAN and _resolved(result, c.first))
    return (_convex(result, BEM), _convex(result, MDR), _bounded(result), _no_factor_lost(resolved))


def _convex(result: FractalPunchResult, method: str) -> Number:
    """F(d) is convex: between two forces its slope lies between the stiffnesses at both."""
    force = result.case.height * np.array(result.case.forces)
    excess = 1.0
    for outcome in (outcome for ensemble in result.ensembles for outcome in ensemble.outcomes[method].values()):
        slope = np.diff(force) / np.diff(outcome["approach"], axis=1)
        stiffness = outcome["stiffness"]
        for ratio in (stiffness[:, :-1] / slope, slope / stiffness[:, 1:]):
            excess = float(np.fmax.reduce(ratio, axis=None, initial=excess))
    return Number(
        quantity=CONVEX,
        model=method,
        value=excess - 1,
        reference=0.0,
        source="F(d) is convex",
        tolerance=100 * result.case.tolerance,
        reason="force, approach and stiffness of every realisation are consistent; residual of the solver, and two "
        "digits of cancellation in the difference of approaches",
    )


def _bounded(result: FractalPunchResult) -> Number:
    """No rough punch is stiffer than the flat one, and at the largest force it is nearly as stiff."""
    cells = result.case.cells
    largest = max(float(np.nanmax(ensemble.outcomes[BEM][cells]["stiffness"])) for ensemble in result.ensembles)
    deficit = 2 / cells
    return Number(
        quantity="largest stiffness of any surface over that of the flat punch",
        model=BEM,
        value=largest / closed_forms.SQUARE_PUNCH,
        reference=1.0 - deficit / 2,
        source="flat punch: all cells in contact",
        tolerance=deficit / 2,
        reason="never stiffer than all cells in contact; at the largest force at most two cells a side "
        f"({deficit:.2g}) softer",
    )


def _resolved(result: FractalPunchResult, first: float) -> bool:
    """Whether the lightest contacts of a decade have cells enough at every Hurst exponent; the last decade counts."""
    case = result.case
    level = nearest(case.forces, first)
    cells = [float(np.nanmean(e.outcomes[BEM][case.cells]["area"][:, level])) * case.cells**2 for e in result.ensembles]
    return min(cells) >= FEW_CELLS or first == case.first_forces[-1]


def _farthest(numbers: Sequence[Number]) -> Number:
    """The number that may differ most from its reference."""
    return max(numbers, key=lambda number: abs(number.value) + number.uncertainty)


def _no_factor_lost(numbers: Sequence[Number]) -> Number:
    """The two methods share no code: an error in one of them shows where they differ most."""
    return replace(
        _farthest(numbers),
        quantity="mean stiffness where the models may differ most, within 3 dB",
        tolerance=MARGINS["3 dB"],
        reason=(
            "3 dB: since k ~ F^(1/(1+H)), a wrong factor 2 in the force or the length changes k by 3 dB or more, H <= 1"
        ),
        role=Role.CRITERION,
    )


def claimed(comparisons: Sequence[DecadeComparison]) -> list[Number]:
    """The fluctuations where they may differ most, beside the agreement that is claimed for rolling."""
    deviations = numbers_of(c for c in comparisons if c.name == DEVIATION)
    if not deviations:
        return []
    farthest = replace(
        _farthest(deviations),
        quantity="relative deviation where it may differ most, within 3 dB",
        tolerance=MARGINS["3 dB"],
        reason="accuracy claimed for 1D models of rolling noise against 3D models: Ford and Thompson (2006)",
    )
    return [farthest]


def law_decade(case: FractalPunch) -> float:
    """First force of the decade where 1 / (1 + H) should hold best: off the last asperity and off saturation."""
    return min(case.first_forces, key=lambda force: abs(math.log(force / 0.01)))


def laws(case: FractalPunch, comparisons: Sequence[DecadeComparison]) -> list[Number]:
    """Exponents beside 1 / (1 + H), whose intervals hold at once for all H."""
    mine = [c for c in comparisons if c.name == EXPONENT and c.hurst is not None and c.first == law_decade(case)]
    return [_law(c.points[0], method, among=len(mine)) for c in mine for method in (BEM, MDR)]


def _law(point: PointComparison, method: str, among: int) -> Number:
    found = point.bem if method == BEM else point.springs
    assert point.hurst is not None
    return Number(
        quantity=EXPONENT,
        model=method,
        where={"H": point.hurst, "Fbar": point.force},
        value=found.value.value,
        reference=1 / (1 + point.hurst),
        source="1 / (1 + H)",
        tolerance=QUANTITIES[EXPONENT].tolerance,
        reason=QUANTITIES[EXPONENT].reason,
        grid=found.grid,
        sample=found.value.half_width_among(among),
        role=Role.FINDING,
    )
