"""The wheel in three dimensions: every model beside boundary elements in the time loop, in words."""

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, if_confirmed, numbers_with, with_reference
from validation.cases.wheel import half_space_tables as tables
from validation.cases.wheel.half_space import TABLE, TIGHTER, Result3D, Wheel3D, run
from validation.cases.wheel.half_space_levels import GEIKE, LINEAR_3D, WheelLevels
from validation.cases.wheel.half_space_numbers import LEVEL, OVER_BEM, SLOPE, numbers_of
from validation.selection import model_needed


def evidence(result: Result3D) -> Evidence:
    """Levels in one-third octaves with intervals; means over the plateau and parts of region 3."""
    levels = WheelLevels(result)
    numbers = numbers_of(levels)
    applications = float(np.mean([strip["applications"] for strip in levels.converged]))
    return Evidence(
        title="The wheel in three dimensions: boundary elements inside the time loop",
        method=_method(result.case),
        numbers=tuple(numbers),
        tables=(tables.levels_of(levels), tables.oscillation_of(levels)),
        page_tables=(tables.shown_regions(levels, numbers), tables.shown_within(levels)),
        conclusions=tuple(conclusions(list(levels.ranges), numbers, applications)),
        captions=_captions(result.case),
        unconverged=result.unconverged,
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


def conclusions(ranges: list[str], numbers: list[Number], applications: float) -> list[str]:
    """Levels by range, the slope, the plateau, and what a time step costs."""
    sentences = []
    for name in ranges:
        parts = [
            f"{model} {n.value:+.1f} ± {n.uncertainty:.1f} dB ({n.verdict})"
            for model, over in OVER_BEM.items()
            for n in numbers_with(numbers, LEVEL, over, range=name)
        ]
        if parts:
            sentences.append(f"Level over boundary elements, {name}: {'; '.join(parts)}.")
    sentences += [
        if_confirmed(f"The power law of region 3 holds in three dimensions: slope {with_reference(slope)}.", [slope])
        for slope in numbers_with(numbers, SLOPE)
    ]
    theory, geike = (numbers_with(numbers, LEVEL, OVER_BEM[m], range="region 2") for m in (LINEAR_3D, GEIKE))
    if theory and geike:
        below = geike[0].value
        sentences.append(
            if_confirmed(
                "In three dimensions region 2 is real: an isotropic surface has waves that cross the track obliquely, "
                "and along the track these are longer than those of q_min. The level of linear theory in region 2 is "
                f"{with_reference(theory[0])}. Springs of Geike's spectrum have only leakage and nonlinearity there: "
                f"without leakage they are {abs(below):.0f} dB too {'low' if below < 0 else 'high'}.",
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
            "same surfaces, springs."
        )
    }


CASE = Case(
    name="wheel_3d",
    chapter=Chapter.WHEEL,
    place=3,
    claim="Boundary elements in the time loop confirm Fig. 14.4.",
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
