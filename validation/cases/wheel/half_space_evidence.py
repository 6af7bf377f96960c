"""The wheel in three dimensions: every model beside boundary elements in the time loop, in words."""

from collections.abc import Sequence

import numpy as np

from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import (
    Evidence,
    JudgedClaim,
    Number,
    if_confirmed,
    numbers_with,
    with_reference,
)
from validation.analysis.features import FEATURES
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
        claims=_claims(numbers, bands),
        conclusions=tuple(conclusions(numbers, bands, applications)),
        captions=_captions(result.case),
        unconverged=result.unconverged,
    )


def _claims(numbers: Sequence[Number], bands: Sequence[Number]) -> tuple[JudgedClaim, ...]:
    """What boundary elements say of the figure, and of what is cheaper."""

    def of(model: str) -> list[Number]:
        return numbers_with(numbers, LEVEL, OVER_BEM[model])

    def found(model: str) -> str:
        return "; ".join(
            f"{n.where['range']} {mean_over_range(bands, str(n.where['range']), model):+.1f} dB in the mean, "
            f"{n.value:+.1f} dB in the worst one-third octave"
            for n in of(model)
        )

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
        f"{case.coarse} cells to a radius to first order; solver: from a residual {case.tolerance / TIGHTER:g}."
    )


def conclusions(numbers: Sequence[Number], bands: Sequence[Number], applications: float) -> list[str]:
    """The slope, the contrast, the plateau, and what a time step costs."""
    sentences = [
        if_confirmed(f"The slope of region 3 is that of (14.13): {slope.model} {with_reference(slope)}.", [slope])
        for slope in numbers_with(numbers, SLOPE_3)
    ]
    sentences += [
        if_confirmed(
            f"Region 3 oscillates as sin²(q a) in three dimensions, zero {n.where['worst at']:g}: {with_reference(n)}.",
            [n],
        )
        for n in numbers_with(numbers, CONTRAST)
    ]
    theory, geike = (numbers_with(numbers, LEVEL, OVER_BEM[m], range="region 2") for m in (LINEAR_3D, GEIKE))
    if theory and geike:
        below = mean_over_range(bands, "region 2", GEIKE)
        sentences.append(
            if_confirmed(
                "In three dimensions region 2 is real: an isotropic surface has waves that cross the track obliquely, "
                "and along the track these are longer than those of q_min. The level of linear theory in the worst "
                f"one-third octave of region 2 is {with_reference(theory[0])}. Springs of Geike's spectrum have only "
                f"leakage and nonlinearity there: without leakage they are {abs(below):.0f} dB too "
                f"{'low' if below < 0 else 'high'} in the mean.",
                theory,
            )
        )
    return [
        *sentences,
        f"A time step takes {applications:.1f} applications of the operator; on springs, one addition for each spring "
        "that may touch. The solver comparison has the cost of a step and of a simulated metre.",
        "Nothing damps the wheel, and in three dimensions roughness excites its resonance: on an open track the "
        "vibration would grow with the distance and have no stationary level. So all begin in the steady state, and "
        "bands begin at twice the eigenfrequency.",
    ]


def _captions(case: Wheel3D) -> dict[str, str]:
    return {
        "wheel_3d": (
            "(a) Acceleration of the wheel in one-third octaves: circles, boundary elements in the time loop, "
            f"{case.strips} surfaces, with 95 % intervals of sample, grid and solver; thick grey: linear theory in 3D; "
            "line: linear theory in 1D, (14.12); squares: springs of Geike's spectrum; triangles: springs of the "
            "rolling spectrum. Shaded: region 2. (b) The same over boundary elements; dotted: ± 1 and ± 3 dB; shaded: "
            "the error of boundary elements. (c) The oscillation of region 3: boundary elements, linear contact on the "
            "same surfaces, springs. (d) Its contrast: the mean of A ω^(2H+3) about the maxima beside each zero of "
            "sin²(q a), over that about the zero, with 95 % intervals."
        )
    }


CASE = Case(
    name="wheel_3d",
    chapter=Chapter.WHEEL,
    place=3,
    claim=CLAIM,
    answers="Boundary elements inside the time loop: the wheel in three dimensions, against every cheaper model",
    quick=Wheel3D(),
    full=Wheel3D(
        scene=TABLE,
        strips=16,
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
