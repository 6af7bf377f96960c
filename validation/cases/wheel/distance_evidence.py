"""Fig. 14.5: what the ends of records do to a spectrum, in words."""

import math
from collections.abc import Sequence
from dataclasses import replace

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import (
    Evidence,
    JudgedClaim,
    Number,
    Verdict,
    if_confirmed,
    number_with,
    numbers_with,
    with_reference,
)
from validation.analysis.wording import by_status, by_verdict, sentence, title
from validation.cases.wheel import distance_numbers as numbers_of_distance
from validation.cases.wheel import distance_tables as tables
from validation.cases.wheel.distance import LINEAR_OPEN, OPEN, SHORT, STEADY, TABLE, DistanceResult, WheelDistance, run
from validation.cases.wheel.distance_numbers import BREAK_LAW, HANN, JUMP, LEVEL, ORDER, PEAK_QUANTITY, SQUARE, WHOLE
from validation.cases.wheel.features import FIRST, FOURTH, PLATEAU, level, regions_of
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

CLAIM = "The break that moves with the distance is leakage (Fig. 14.5)."


def evidence(result: DistanceResult) -> Evidence:
    """The break and its law; levels of the regions by contact and track, and by height; the peak by amplitude."""
    breaks, plateau = tables.breaks_of(result), tables.plateau_of(result)
    numbers = numbers_of_distance.numbers_of(result, breaks)
    claims = _claims(result, numbers)
    return Evidence(
        title="Fig. 14.5: the break, the plateau and the ends of a record",
        method=_method(result.case),
        numbers=tuple(numbers),
        tables=(
            tables.spectra_of(result),
            breaks,
            tables.law_of(number_with(numbers, BREAK_LAW), breaks),
            tables.endings_of(result),
            plateau,
            tables.vibrations_of(result),
            tables.hertz_of(result),
        ),
        page_tables=(
            tables.shown_breaks(breaks),
            tables.shown_levels(result),
            tables.shown_plateau(plateau),
            tables.shown_phases(result),
        ),
        claims=claims,
        conclusions=tuple(conclusions(numbers)),
        finding=finding(claims, numbers),
        headlines=headlines(numbers),
        captions=_captions(result.case),
        unconverged=result.unconverged,
    )


def _method(case: WheelDistance) -> str:
    scene = case.scene
    return (
        f"Wheels of {scene.name}, {case.wheels} and fewer, over {case.periods} to {case.periods * 2**case.doublings} "
        f"natural periods, from static equilibrium; and over {scene.length:.3g} m with every contact and track. Open "
        f"tracks: their end is {WAVES_APART} longest waves from their beginning. Periodic tracks: their end is their "
        "beginning, after a whole number of natural periods. Steady-state motion on a periodic track: shooting finds "
        "the approach and the velocity with which the motion repeats itself; it has no free vibration, and nothing "
        "leaks. The linear contact of fixed radius, (14.11), rolls on the same tracks as springs. Its waves end at "
        "q_min v₀ and q_max v₀, so its level in regions 2 and 4 is leakage alone; that of springs in the steady state "
        "is nonlinearity alone. Region 1 is measured from 0.5 to 2 ω_eigen, region 2 from 2 ω_eigen to 0.8 q_min v₀, "
        "region 3 from 1.1 q_min v₀ over half a period of its oscillation, region 4 from 1.3 to 2.6 q_max v₀."
    )


def _claims(result: DistanceResult, numbers: list[Number]) -> tuple[JudgedClaim, ...]:
    law, peaks = number_with(numbers, BREAK_LAW), numbers_with(numbers, PEAK_QUANTITY)
    hann = number_with(numbers, LEVEL, f"{HANN}, over {OPEN}")
    linear = {number.where["region"]: number for number in numbers_with(numbers, LEVEL, f"{LINEAR_OPEN}, over {OPEN}")}
    first, plateau, fourth = (linear[region] for region in (FIRST, PLATEAU, FOURTH))
    order, highest = number_with(numbers, ORDER), result.case.heights[-1]
    return (
        answered(
            CLAIM,
            [law, fourth],
            f"a linear contact, which has leakage alone in region 4, is {fourth.value:+.1f} dB off the level of "
            f"springs there; Hann's window changes that by {hann.value:+.1f} dB; the exponent of the break over the "
            f"duration is {with_reference(law)}, that of a floor which a jump at the end of the record makes.",
        ),
        answered(
            "Regions 1, 2 and 4 arise from the non-linearity of the contact.",
            [first, plateau, fourth],
            "a linear contact on the same tracks has them too, "
            f"{first.value:+.1f}, {plateau.value:+.1f} and {fourth.value:+.1f} dB off springs. Region 1 is free "
            "vibration from the start, and region 4 leakage. Region 2 is leakage and a nonlinear part that grows as "
            f"h₀^{order.value:.2f}: {_share(result, highest):.0f} % of its power at {highest:g} h₀, "
            f"{_share(result, WHOLE):.1f} % at h₀.",
            confirmed_by=Verdict.DIFFER,
        ),
        answered(
            "The frequency of the peak depends on the amplitude as on a Hertz contact.",
            peaks,
            "; ".join(
                f"released {n.where['release / d']:g} d below equilibrium: {n.value:.5g} beside {n.reference:.5g} rad/s"
                for n in peaks
            )
            + ".",
        ),
    )


def _share(result: DistanceResult, height: float) -> float:
    """Of nonlinearity in the power of region 2, in per cent."""
    band = regions_of(result.case.scene)[PLATEAU]
    nonlinear, whole = (level(result.sweep[kind, height], band).value for kind in (STEADY, OPEN))
    return 100 * math.exp(nonlinear - whole)


def conclusions(numbers: list[Number]) -> list[str]:
    jump, square = (number_with(numbers, quantity) for quantity in (JUMP, SQUARE))
    return [
        if_confirmed(
            "Linear theory and the start in static equilibrium make the jump from the end of a record to its "
            "beginning, 1 + cos²(ω_eigen T) times the forced acceleration squared: its rms is "
            f"{jump.value:.3f} ± {jump.uncertainty:.3f} of that at {jump.where['worst at']:.3g} m, the worst distance.",
            [jump],
        ),
        if_confirmed(
            "Free vibration from the start stays: the mean square acceleration is "
            f"{square.value:.2f} ± {square.uncertainty:.2f} times that without it.",
            [square],
        ),
    ]


def finding(claims: Sequence[JudgedClaim], numbers: Sequence[Number]) -> str:
    return sentence(
        by_status(
            claims[0],
            holds="the break that moves with the distance is leakage",
            fails="the break that moves with the distance is not leakage alone",
            undecided="whether the break that moves with the distance is leakage is open",
        ),
        _plateau(numbers),
    )


def headlines(numbers: Sequence[Number]) -> dict[str, str]:
    law = number_with(numbers, BREAK_LAW)
    leakage = f"a jump at the end gives T^{law.reference:.2f}"
    return {
        "wheel_distance": by_verdict(
            [law],
            agree=f"The break goes as T^{law.value:.2f}, as leakage does: {leakage}",
            differ=f"The break goes as T^{law.value:.2f}, not as leakage: {leakage}",
            undecided=f"The break goes as T^({law.value:.2f} ± {law.uncertainty:.2f}); {leakage}",
        ),
        "wheel_distance-cause": title(_plateau(numbers)),
    }


def _plateau(numbers: Sequence[Number]) -> str:
    """Power of region 2 at h₀: of a linear contact, which only leaks there, and of springs without leakage."""
    leakage, nonlinear = (
        100 * 10 ** (number_with(numbers, LEVEL, f"{kind}, over {OPEN}", region=PLATEAU).value / 10)
        for kind in (LINEAR_OPEN, STEADY)
    )
    return f"{leakage:.0f} % of the power of region 2 is leakage, {float(f'{nonlinear:.1g}'):g} % nonlinearity"


def _captions(case: WheelDistance) -> dict[str, str]:
    return {
        "wheel_distance": (
            "Fig. 14.5. (a) Spectra without window, dark to light from the shortest distance to the longest, "
            f"{2**case.doublings} times as long; circles: the break. (b) The break against the duration with 95 % "
            "intervals; crosses: predicted by the jumps of the same records; line: T^(1/(2H+1)) through the middle."
        ),
        "wheel_distance-cause": (
            f"(a) Wheels over {case.scene.length:.3g} m. Springs: full line, open track, no window; dashed, Hann's "
            "window; thick, steady state; dash-dotted, periodic track. Dotted: linear contact, open tracks. (b) Region "
            "2 against the roughness: circles, springs, open; crosses, linear contact; squares, springs, steady state; "
            "lines: h² and h⁴. (c) The peak against the amplitude of free vibration; line: quadrature, Hertz."
        ),
    }


CASE = Case(
    name="wheel_distance",
    chapter=Chapter.WHEEL,
    place=2,
    claim=CLAIM,
    answers="Fig. 14.5: the break that moves with the distance, its cause, and the share of leakage in the plateau",
    quick=WheelDistance(scene=replace(SHORT, springs=64), doublings=3, wheels=40, causes=10),
    full=WheelDistance(
        scene=TABLE,
        doublings=6,
        wheels=300,
        fewest=40,
        causes=60,
        rough=20,
        heights=(0.125, 0.25, 0.5, 1.0, 2.0, 4.0),
        phases=(0.0, 0.25, 0.5),
        releases=(0.0, 0.1, 0.2, 0.4),
        released=5,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
