"""What MDR does not model, beside boundary elements: numbers, tables and sentences."""

from collections.abc import Callable, Sequence

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Verdict, numbers_with, table_of
from validation.analysis.statistics import Estimate, Statistic, at_level, log_mean, log_relative_deviation, nearest
from validation.cases.punch.area_gap_rolloff import MdrLimits, MdrLimitsResult, run
from validation.cases.punch.area_gap_rolloff_numbers import (
    AREA,
    EXPONENT,
    GAP,
    ROLL_OFF,
    RollOffSamples,
    curve,
    numbers_over,
    persson,
    resampled,
    value_of,
)
from validation.cases.punch.rough_interface import SPRINGS, layer_on_half_space
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR, METHODS, require_converged


def evidence(result: MdrLimitsResult) -> Evidence:
    """Area, gap, stiffness and its fluctuation, MDR over boundary elements; the exponents of the interface alone.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    require_converged((*result.bem.values(), *result.refined.values()), result.unconverged)
    samples = {roll_off: resampled(result, roll_off) for roll_off in case.roll_offs}
    layers = {BEM: layer_on_half_space(case.cells), MDR: SPRINGS}
    numbers = [
        number
        for first in case.first_forces
        for mine in samples.values()
        for number in numbers_over(case, mine, layers, first)
    ]
    return Evidence(
        title="Where MDR must fail: contact area, mean gap, roughness with a roll-off",
        method=_method(case),
        numbers=tuple(numbers),
        tables=(table_of("curves", [row for mine in samples.values() for row in curve(result, mine, layers)]),),
        conclusions=(
            _no_area_or_gap([*numbers_with(numbers, AREA), *numbers_with(numbers, GAP)]),
            *(_at_one_force(result, mine) for mine in samples.values()),
            *_exponents(numbers),
        ),
        captions=_captions(case),
        unconverged=result.unconverged,
    )


def _method(case: MdrLimits) -> str:
    return (
        f"Punches with H = {case.hurst:g} as in Fig. 14.1, and others without waves longer than L over "
        f"{', '.join(map(str, case.roll_offs[1:]))}, all to {case.cells // 4} waves on a side. {case.surfaces} "
        f"surfaces of {case.cells}² cells, {case.profiles} profiles of {case.points} springs, equal forces. The "
        "case compares "
        "the true contact area over L² and the share of springs in contact; the mean gap between the faces over "
        "h; the stiffness and its relative deviation; and, with a roll-off, the exponent of the stiffness of the rough "
        "interface alone. That is the uniform layer under a flat punch that makes it as stiff as the rough one. "
        f"Boundary elements are extrapolated to first order from {case.cells}² and {2 * case.cells}² cells on "
        f"{case.refined} surfaces; ± grid is half of that correction, with its 95 % interval."
    )


def _captions(case: MdrLimits) -> dict[str, str]:
    return {
        "mdr_limits": (
            f"Symbols: boundary elements on {case.cells}² cells, 95 % intervals of the sample, open where the mean "
            f"contact has fewer than {FEW_CELLS} cells; lines in bands: MDR, L_1D = L. (a) Contact fraction; "
            "dotted: Persson's erf(√2 p / (E* h')) for the mean pressure p and the rms slope h' of the surfaces. "
            "(b) Mean gap over h. (c) Stiffness of the interface alone over the force: level where it is "
            "proportional to the load. (d) Relative deviation of the stiffness of the punch. Dark to light: "
            f"{ROLL_OFF} = {', '.join(map(str, case.roll_offs))}."
        )
    }


def _no_area_or_gap(numbers: Sequence[Number]) -> str:
    confirmed = "" if all(n.verdict is Verdict.DIFFER for n in numbers) else "Not confirmed at every load here: "
    return (
        f"{confirmed}MDR is no model of contact area and gap. More springs are in contact than there is true contact. "
        "Their mean gap is smaller than that of the faces, and closes at loads that leave the faces apart."
    )


def _at_one_force(result: MdrLimitsResult, mine: RollOffSamples) -> str:
    """All quantities at the force nearest to Fbar = 0.1, boundary elements and MDR."""
    case = result.case
    level = nearest(case.forces, 0.1)

    def both(measured: str, statistic: Statistic = log_mean) -> str:
        value = value_of(case, measured)
        bem, grid = mine.extrapolated(measured, at_level(level, statistic))
        springs = mine.by_method[MDR, measured].estimate(at_level(level, statistic))
        return f"{_with_interval(bem, grid, value)} and {value(springs.value):.3g}"

    return (
        f"{ROLL_OFF} = {mine.roll_off}, Fbar = {case.forces[level]:.2g}, boundary elements (extrapolated, with their "
        f"interval) and MDR: contact fraction {both('area')} (Persson {persson(result, mine.roll_off, level):.2g}), "
        f"mean gap over h {both('gap')}, stiffness over E* L {both('stiffness')}, relative deviation "
        f"{both('stiffness', log_relative_deviation)}."
    )


def _with_interval(found: Estimate, grid: float, value: Callable[[float], float]) -> str:
    half = found.half_width + grid
    middle, low, high = (value(log) for log in (found.value, found.value - half, found.value + half))
    return f"{middle:.3g} ({low:.2g} to {high:.2g})"


def _exponents(numbers: Sequence[Number]) -> list[str]:
    """A sentence a method that has any."""
    found = {method: numbers_with(numbers, EXPONENT, method) for method in METHODS}
    return [
        f"{EXPONENT.capitalize()}, {method}, 1 if it is proportional to the load: "
        + "; ".join(f"{n.conditions}: {n.value:.2f} ± {n.uncertainty:.2f} ({n.verdict})" for n in mine)
        + "."
        for method, mine in found.items()
        if mine
    ]


CASE = Case(
    name="mdr_limits",
    chapter=Chapter.PRESSED,
    place=3,
    claim="MDR gives neither the true contact area nor the gap, nor the stiffness of roughness with a roll-off.",
    answers="Where MDR fails by its assumptions: true contact area, mean gap, stiffness with a roll-off",
    quick=MdrLimits(),
    full=MdrLimits(
        roll_offs=(1, 8, 16), cells=256, surfaces=30, refined=8, profiles=500, decades=(-3, 1), per_decade=3
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.rolled_off,
)
