"""What MDR does not model, beside boundary elements: numbers, tables and sentences."""

import math
from collections.abc import Sequence

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Verdict, numbers_with, table_of
from validation.analysis.statistics import (
    DECIBEL,
)
from validation.analysis.wording import by_status, farthest_off, in_a_word, sentence
from validation.cases.punch.area_gap_rolloff import MdrLimits, MdrLimitsResult, run
from validation.cases.punch.area_gap_rolloff_numbers import (
    AREA,
    DEVIATION,
    EXPONENT,
    GAP,
    ROLL_OFF,
    STIFFNESS,
    curve,
    numbers_over,
    resampled,
)
from validation.cases.punch.rough_interface import SPRINGS, layer_on_half_space
from validation.cases.punch.work import Worked
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR, METHODS, require_converged

CLAIM = "MDR has neither the true contact area nor the mean gap of a rough punch."

WITH_ROLL_OFF = "MDR has the stiffness of roughness with a roll-off."


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
    claims = claims_of(numbers)
    return Evidence(
        title="Where MDR must fail: contact area, mean gap, roughness with a roll-off",
        method=_method(case),
        numbers=tuple(numbers),
        claims=claims,
        finding=finding(claims),
        headlines={"mdr_limits": headline(claims)},
        tables=(
            table_of("curves", [row for mine in samples.values() for row in curve(result, mine, layers)]),
            Worked.of(case.cells, case.points, result.bem.values()).table,
        ),
        conclusions=(),
        captions=_captions(case),
        unconverged=result.unconverged,
    )


def claims_of(numbers: Sequence[Number]) -> tuple[JudgedClaim, ...]:
    """Those that have numbers: a claim of a roll-off needs one."""
    area, gap, stiffness, deviation = (numbers_with(numbers, name) for name in (AREA, GAP, STIFFNESS, DEVIATION))
    rolled_off = [n for n in stiffness if n.where[ROLL_OFF] != 1]
    judged = [
        (
            CLAIM,
            [*area, *gap],
            Verdict.DIFFER,
            f"{_times(area)} as many springs are in contact as there is true contact, with {_times(gap)} the mean gap.",
        ),
        (
            WITH_ROLL_OFF,
            rolled_off,
            Verdict.AGREE,
            f"over that of boundary elements it is {_farthest(rolled_off)}.",
        ),
        (
            "MDR has the relative deviation of the stiffness.",
            deviation,
            Verdict.AGREE,
            f"over that of boundary elements it is {_farthest(deviation)}.",
        ),
    ]
    for method in METHODS:
        exponents = numbers_with(numbers, EXPONENT, method)
        found = "; ".join(f"{n.value:.2f} ± {n.uncertainty:.2f} at {n.conditions}" for n in exponents)
        claim = f"With a roll-off the stiffness of the rough interface is proportional to the load, by {method}."
        judged.append((claim, exponents, Verdict.AGREE, f"the exponent, which would be 1, is {found}."))
    return tuple(answered(claim, mine, answer, confirmed_by=verdict) for claim, mine, verdict, answer in judged if mine)


def _times(numbers: Sequence[Number]) -> str:
    """From the smallest to the largest ratio, at the worst forces of all decades and roll-offs."""
    ratios = sorted(math.exp(n.value / DECIBEL) for n in numbers)
    ends = dict.fromkeys(f"{float(f'{ratio:.2g}'):g}" for ratio in (*ratios[:1], *ratios[-1:]))
    return f"{' to '.join(ends)} times"


def _farthest(numbers: Sequence[Number]) -> str:
    """The ratio that is farthest off, with its interval; of those that differ where there are any.

    A ratio from few surfaces may be far off and say nothing.
    """
    if not numbers:
        return ""
    worst = farthest_off(numbers)
    ends = (worst.value, worst.value - worst.uncertainty, worst.value + worst.uncertainty)
    ratio, low, high = (f"{math.exp(end / DECIBEL):.2g}" for end in ends)
    decided = sum(n.verdict is not Verdict.UNDECIDED for n in numbers)
    return f"{ratio} ({low} to {high}) at {worst.conditions}; {decided} of {len(numbers)} are decided"


def headline(claims: Sequence[JudgedClaim]) -> str:
    """Area and gap."""
    numbers = claims[0].numbers
    area, gap = (_times(numbers_with(numbers, name)) for name in (AREA, GAP))
    return by_status(
        claims[0],
        holds=f"MDR has {area} the contact area and {gap} the mean gap",
        fails="MDR has the contact area or the mean gap at some forces",
        undecided=f"MDR has {area} the contact area and {gap} the mean gap: not all decided",
    )


def finding(claims: Sequence[JudgedClaim]) -> str:
    rolled_off = [claim for claim in claims if claim.claim == WITH_ROLL_OFF]
    return sentence(
        headline(claims), *(f"its stiffness with a roll-off is right: {in_a_word(claim)}" for claim in rolled_off)
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
        f"{case.refined} surfaces; ± grid is half of that correction, with its 95 % interval (jackknife, Student's "
        "t). A number over a decade of force is that of its worst force."
    )


def _captions(case: MdrLimits) -> dict[str, str]:
    return {
        "mdr_limits": (
            "Symbols: boundary elements, 95 % of the sample, open where the mean contact has fewer than "
            f"{FEW_CELLS} cells; lines in bands: MDR, L_1D = L; dark to light: {ROLL_OFF} = "
            f"{', '.join(map(str, case.roll_offs))}. (a) Contact fraction; dotted: Persson's erf(√2 p / (E* g)), g the "
            "rms gradient. (b) Mean gap over h. (c) Stiffness of the interface alone over the force. (d) Relative "
            "deviation of the stiffness."
        )
    }


CASE = Case(
    name="mdr_limits",
    chapter=Chapter.PRESSED,
    place=3,
    claim=CLAIM,
    answers="Where MDR fails by its assumptions: true contact area, mean gap, stiffness with a roll-off",
    quick=MdrLimits(surfaces=8, refined=4),
    full=MdrLimits(
        roll_offs=(1, 8, 16), cells=256, surfaces=30, refined=12, profiles=500, decades=(-3, 1), per_decade=3
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.rolled_off,
)
