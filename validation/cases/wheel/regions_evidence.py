"""Region 2 and its neighbours: the second-order force, its zeros, and where the plateau ends at low speed."""

import math
from collections.abc import Sequence

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Verdict
from validation.analysis.over_range import signed_mean, worst
from validation.analysis.wording import by_status, sentence, title
from validation.cases.wheel.regions import LONG_STEADY, SHORT_OPEN, SHORT_STEADY, RegionsResult, WheelRegions, run
from validation.cases.wheel.regions_numbers import (
    APART,
    MAXIMUM,
    OMEGA,
    RATIO,
    contrast_numbers,
    jump_numbers,
    levels_over_second_order,
    merging,
    speeds_of,
)
from validation.cases.wheel.regions_tables import plateau_tables, shown_speeds, spectra_by_speed
from validation.selection import model_needed

CLAIM = "The plateau of region 2 has a substructure or none, depending on the parameters."


def evidence(result: RegionsResult) -> Evidence:
    """Levels and contrast of region 2 beside the second-order force; the jump and the valley by speed."""
    speeds = speeds_of(result)
    levels = {name: levels_over_second_order(result, name) for name in (LONG_STEADY, SHORT_STEADY)}
    contrasts = {name: contrast_numbers(result, name) for name in (SHORT_STEADY, SHORT_OPEN)}
    jumps = jump_numbers(result, speeds)
    of_levels = [worst(some, OMEGA) for some in levels.values() if some]
    of_contrast = [worst(some, MAXIMUM) for some in contrasts.values() if some]
    of_speed = [*([worst(jumps, RATIO)] if jumps else []), merging(result, speeds)]
    claims = _claims(result.case, of_levels, of_contrast, of_speed, levels)
    return Evidence(
        title="Region 2: its substructure, and its end at low speed",
        method=_method(result.case),
        numbers=(*of_levels, *of_contrast, *of_speed),
        tables=(*plateau_tables(result), speeds, spectra_by_speed(result)),
        page_tables=(shown_speeds(speeds, jumps),),
        claims=claims,
        conclusions=(),
        finding=finding(claims),
        headlines={"wheel_regions": title(_substructure(claims[0]), _end(claims[2]))},
        captions=_captions(result.case),
    )


def _method(case: WheelRegions) -> str:
    own, short = case.q_min_a
    return (
        f"{case.wheels} wheels of {case.scene.name} on springs over {case.distance:g} m: in the steady state, where "
        f"nothing leaks, over its own waves and over waves of {1e3 * case.short:g} mm and less, h₀ = "
        f"{1e6 * case.rms:g} µm; over the latter also on open tracks without window. q_min a is "
        f"{own:.3g} and {short:.3g}. The second-order force "
        "is that of the springs which the ends of the contact gain and lose, E* R / 4a (h(x + a)² + h(x - a)²). "
        f"Speeds: {case.wheels} wheels on open tracks of {case.periods} natural periods, Hann's window; the valley is "
        "the least A between ω_eigen and q_min v₀ under the largest within a fifth behind q_min v₀."
    )


def _claims(
    case: WheelRegions,
    of_levels: Sequence[Number],
    of_contrast: Sequence[Number],
    of_speed: Sequence[Number],
    levels: dict[str, list[Number]],
) -> tuple[JudgedClaim, ...]:
    steady, leaking = of_contrast
    means = ", ".join(f"{signed_mean(some):+.1f} dB in the mean for {name}" for name, some in levels.items() if some)
    merged = of_speed[-1]
    own, short = case.q_min_a
    return (
        answered(
            CLAIM,
            [leaking],
            f"over short waves, q_min a = {short:.3g}, open records have maxima {leaking.value:.0f} dB over zeros; "
            f"without leakage these are {steady.value:.0f} dB, in the second-order force {steady.reference:.0f} dB, "
            f"whose zeros begin at q a = π/2; {case.scene.name} has q_min a = {own:.3g} and "
            f"{'no zero' if own < math.pi / 2 else 'a zero'} below it.",
            confirmed_by=Verdict.DIFFER,
        ),
        answered(
            "Without leakage, region 2 of springs is the second-order force of the roughness.",
            [*of_levels, steady],
            f"one-third octaves are {means}; the worst is {max((n.value for n in of_levels), key=abs):+.1f} dB; maxima "
            f"over zeros are {steady.value:.1f} dB beside {steady.reference:.1f} dB.",
        ),
        answered(
            "At low speed the jump comes to the resonance, and the plateau disappears.",
            of_speed,
            f"it ends at q_min v₀ = {merged.value:.2f} ± {merged.grid:.2f} ω_eigen beside {merged.reference:.2f} in a "
            f"record of {case.periods} natural periods.",
        ),
    )


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(_substructure(claims[0]), _end(claims[2]))


def _substructure(claim: JudgedClaim) -> str:
    (contrast,) = claim.numbers
    maxima = f"maxima {contrast.value:.0f} dB over its zeros"
    return by_status(
        claim,
        holds=f"over short waves region 2 has {maxima}",
        fails="over short waves region 2 has no substructure",
        undecided=f"whether region 2 has a substructure over short waves is open, {maxima}",
    )


def _end(claim: JudgedClaim) -> str:
    merged = claim.numbers[-1]
    return by_status(
        claim,
        holds=f"its plateau ends at q_min v₀ = {merged.value:.2f} ω_eigen, as predicted",
        fails=f"its plateau ends at q_min v₀ = {merged.value:.2f} ω_eigen, predicted {merged.reference:.2f}",
        undecided="where its plateau ends at low speed is open",
    )


def _captions(case: WheelRegions) -> dict[str, str]:
    return {
        "wheel_regions": (
            f"(a) Region 2 over waves of {1e3 * case.short:g} mm and less: circles, springs, steady state; line, "
            f"second-order force; dotted, springs on open tracks. (b) The same over the waves of {case.scene.name}. "
            "(c) Spectra at lower and lower speeds, dark to light. (d) The valley between resonance and jump; dashed: "
            f"where a record of this length no longer keeps them apart; dotted: {APART:g} dB."
        )
    }


CASE = Case(
    name="wheel_regions",
    chapter=Chapter.WHEEL,
    place=4,
    claim=CLAIM,
    answers="Regions 1 and 2: the substructure of the plateau, the force that makes it, and where it ends at low speed",
    quick=WheelRegions(wheels=10, groups=10),
    full=WheelRegions(distance=0.4, springs=96, rms=0.15e-6, wheels=80, periods=60),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
