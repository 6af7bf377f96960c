"""The wheel in three dimensions: every model beside boundary elements in the time loop, in words."""

from collections.abc import Sequence

import numpy as np

from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, numbers_with
from validation.analysis.features import FEATURES
from validation.analysis.wording import by_status, by_verdict, farthest_off, sentence, too_loud
from validation.cases.wheel import half_space_tables as tables
from validation.cases.wheel.features import SLOPE
from validation.cases.wheel.half_space import TABLE, TIGHTER, Result3D, Wheel3D, run
from validation.cases.wheel.half_space_levels import GEIKE, LINEAR_3D, ROLLING, WheelLevels
from validation.cases.wheel.half_space_numbers import LEVEL, OVER_BEM, levels_over_bem, mean_over_range, numbers_of
from validation.selection import model_needed

CLAIM = "Boundary elements in the time loop confirm Fig. 14.4."
SLOPE_3, CONTRAST = FEATURES[SLOPE].quantity, FEATURES["contrast"].quantity


def evidence(result: Result3D) -> Evidence:
    """Levels in one-third octaves with intervals, the worst in the plateau and parts of region 3; slope, contrast."""
    levels = WheelLevels(result)
    bands = levels_over_bem(levels)
    numbers = numbers_of(levels, bands)
    applications = float(np.mean([strip["applications"] for strip in levels.converged]))
    claims = _claims(numbers, bands)
    return Evidence(
        title="The wheel in three dimensions: boundary elements inside the time loop",
        method=_method(result.case),
        numbers=tuple(numbers),
        tables=(
            tables.levels_of(levels),
            tables.oscillation_of(levels),
            *tables.contrast_of(levels),
            tables.wheel_of(levels),
        ),
        page_tables=(tables.shown_regions(levels, numbers), tables.shown_within(levels)),
        claims=claims,
        conclusions=tuple(conclusions(applications)),
        finding=finding(numbers, claims),
        headlines={"wheel_3d": _geike(numbers)},
        captions=_captions(result.case),
        unconverged=result.unconverged,
    )


def _claims(numbers: Sequence[Number], bands: Sequence[Number]) -> tuple[JudgedClaim, ...]:
    """What boundary elements say of the figure, and of what is cheaper."""

    def of(model: str) -> list[Number]:
        return numbers_with(numbers, LEVEL, OVER_BEM[model])

    def found(model: str) -> str:
        return "; ".join(over_range(n, bands, model) for n in of(model))

    slope, contrast = numbers_with(numbers, SLOPE_3, "bem3d"), numbers_with(numbers, CONTRAST)
    also = [f"the slope of region 3 is {n.value:.2f} beside {n.reference:.2f}" for n in slope]
    also += [f"maxima of region 3 are {n.value:.1f} dB over zero {n.where['worst at']:g}" for n in contrast]

    def by_model(claim: str, model: str) -> JudgedClaim:
        # linear theory ends at short waves, along which contact is lost
        inside = agreeing_from_the_first([number] for number in of(model))
        limits = f"up to {inside[-1].where['range']}" if inside else ""
        return answered(claim, of(model), f"over boundary elements, {found(model)}.", limits=limits, inside=inside)

    return (
        answered(
            CLAIM,
            [*of(GEIKE), *slope, *contrast],
            f"springs of Fig. 14.4 are over boundary elements: {found(GEIKE)}{''.join(f'; {part}' for part in also)}.",
        ),
        by_model("Linear theory in three dimensions has the acceleration of the wheel.", LINEAR_3D),
        by_model("Springs of the rolling spectrum have the acceleration of the wheel in three dimensions.", ROLLING),
    )


def over_range(number: Number, bands: Sequence[Number], model: str) -> str:
    """The mean over a range, and the worst band with its interval: it need not have the largest value."""
    where = str(number.where["range"])
    return (
        f"{where} {mean_over_range(bands, where, model):+.1f} dB in the mean, "
        f"{number.value:+.1f} ± {number.uncertainty:.1f} dB in the worst one-third octave"
    )


def _method(case: Wheel3D) -> str:
    scene, spacing = case.scene, case.strip.spacing
    steps, across = case.strip.shape
    rail = scene.rail
    waves = f"{1e3 * rail.longest:g} to {1e3 * rail.shortest:g} mm, H = {rail.hurst:g}" if rail else ""
    return (
        f"{case.strips} wheels of {scene.name} over isotropic surfaces, waves of {waves}, h₀/d = "
        f"{scene.rms / scene.approach:.3g}; contact by boundary elements in each of {steps} time steps, {case.cells} "
        f"cells to a contact radius, residual {case.tolerance:g}; surfaces {1e3 * steps * spacing:.0f} mm by "
        f"{1e3 * across * spacing:.0f} mm, periodic, {case.periods + 0.5:g} natural periods long. The linear contact "
        "of fixed radius rolls on the same surfaces; boundary elements begin in its steady state. "
        f"{case.wheels} wheels on springs move in their steady state, on tracks of Geike's spectrum of these surfaces, "
        "or of the rolling spectrum, with which springs have the force level of the half-space. All use Hann's window. "
        "Levels of boundary elements are over the linear contact on the same surfaces, times linear theory; grid: from "
        f"{case.coarse} cells to a radius to first order; solver: from a residual {case.tolerance / TIGHTER:g}. "
        "Nothing damps the wheel, and in 3D roughness excites its resonance, so that all begin in the steady state and "
        "bands begin at twice the eigenfrequency."
    )


def conclusions(applications: float) -> list[str]:
    """What a time step costs."""
    return [
        f"A time step takes {applications:.1f} applications of the operator; on springs, one addition for each spring "
        "that may touch. The solver comparison has the cost of a step and of a simulated metre."
    ]


def finding(numbers: Sequence[Number], claims: Sequence[JudgedClaim]) -> str:
    return sentence(
        _geike(numbers),
        by_status(
            claims[1],
            holds="linear theory in 3D is within 1 dB in every one-third octave",
            fails="linear theory in 3D is not within 1 dB in every one-third octave",
            undecided="whether linear theory in 3D is within 1 dB in every one-third octave is open",
        ),
    )


def _geike(numbers: Sequence[Number]) -> str:
    """Springs of Fig. 14.4 in the worst one-third octave of region 2 and of region 3."""
    of = numbers_with(numbers, LEVEL, OVER_BEM[GEIKE])
    parts = []
    for region in ("region 2", "region 3"):
        mine = [number for number in of if str(number.where["range"]).startswith(region)]
        if mine:
            found = by_verdict(
                mine,
                agree=f"within {mine[0].tolerance:g} dB",
                differ=f"up to {too_loud(farthest_off(mine).difference)}",
                undecided=f"open within {mine[0].tolerance:g} dB",
            )
            parts.append(f"{found} in {region}")
    return f"Springs of Fig. 14.4: {', '.join(parts)}"


def _captions(case: Wheel3D) -> dict[str, str]:
    return {
        "wheel_3d": (
            "(a) Acceleration of the wheel in one-third octaves: circles, boundary elements in the time loop, 95 % of "
            "sample, grid and solver; thick grey, linear theory in 3D; line, (14.12); squares, springs of Geike's "
            "spectrum; triangles, of the rolling spectrum. Shaded: region 2. (b) The same over boundary elements; "
            "dotted: ± 1 and ± 3 dB. (c) The oscillation of region 3. (d) Its contrast at each zero of sin²(q a), 95 %."
        )
    }


CASE = Case(
    name="wheel_3d",
    chapter=Chapter.WHEEL,
    place=3,
    claim=CLAIM,
    answers="Boundary elements inside the time loop: the wheel in three dimensions, against every cheaper model",
    quick=Wheel3D(strips=3, wheels=30),
    full=Wheel3D(
        scene=TABLE,
        strips=8,
        periods=4,
        width=4,
        cells=40,
        shared=10,
        coarse=30,
        coarser=3,
        tolerance=0.0001,
        short=1,
        wheels=200,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
