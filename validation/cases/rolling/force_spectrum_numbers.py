"""Numbers of rolling over isotropic roughness: levels over boundary elements, variance and mean of the force."""

import math
from dataclasses import replace

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Place, Role, number_with
from validation.analysis.statistics import POWER_DECIBEL, mean_estimate, ratio_of_means
from validation.cases.rolling.force_spectrum import ForceSpectrum
from validation.cases.rolling.force_spectrum_levels import (
    LINEAR_1D,
    LINEAR_3D,
    ROLLING_SPRINGS,
    SPRINGS,
    LevelsAtHeight,
    Region,
    ratio_of_pairs,
)
from validation.theory.rolling import level_ratio

LEVEL, NONLINEAR = "mean level", "level of the nonlinear over the linear force"
VARIANCE, MEAN = "variance of the force over that of linear theory", "mean force over that of Hertz"
BOTH = "springs beside bem3d"
ONE_DECIBEL = 1.0
REASON = "1 dB: repeatability of measured one-third octave levels"
LINEAR_UP_TO = 0.01
"""h/d up to which boundary elements must agree with linear theory, or something is wrong with them."""


def regions(case: ForceSpectrum) -> list[Region]:
    """Below the band, where springs with Geike's spectrum have no level; its long waves; its short ones."""
    middle = 4 * case.first
    ends = ((case.lowest, case.first), (case.first, middle), (middle, case.last))
    return [region for region in ends if region[0] < region[1]]


def numbers_of(case: ForceSpectrum, found: list[LevelsAtHeight]) -> list[Number]:
    numbers = [number for mine in found for number in (*_levels(mine), *moments(mine))]
    return [*numbers, _excess(case, numbers)]


def place(height: float, region: Region) -> dict[str, Place]:
    """Where a level is: at h/d, in the bands of a region."""
    return {"h/d": height, "q a": region}


def over_bem(mine: LevelsAtHeight, model: str, region: Region, role: Role = Role.FINDING) -> Number:
    """A model over boundary elements, in the mean over the bands of a region."""
    weights = mine.weights(region)
    bem, grid = mine.bem_level(weights)
    return difference(
        mine.model_level(model, weights),
        bem,
        quantity=LEVEL,
        model=f"{model} over bem3d",
        where=place(mine.height, region),
        source="bem3d, extrapolated, on the same surfaces as linear theory in 3D",
        tolerance=ONE_DECIBEL,
        reason=REASON,
        grid=grid,
        role=role,
    )


def nonlinear(mine: LevelsAtHeight, region: Region) -> Number:
    """What nonlinearity does to the level of springs, beside what it does to that of boundary elements."""
    weights = mine.weights(region)
    bem, grid = mine.bem_level(weights)
    return difference(
        ratio_of_pairs(mine.springs_over_linear, weights),
        bem,
        absolute=True,
        quantity=NONLINEAR,
        model=BOTH,
        where=place(mine.height, region),
        source="bem3d over linear theory in 3D",
        tolerance=ONE_DECIBEL,
        reason=REASON,
        grid=grid,
    )


def _levels(mine: LevelsAtHeight) -> list[Number]:
    numbers = []
    for i, region in enumerate(regions(mine.case)):
        must = i < 2 and mine.height <= LINEAR_UP_TO
        numbers.append(over_bem(mine, LINEAR_3D, region, Role.CRITERION if must else Role.FINDING))
        if i > 0:
            numbers += [over_bem(mine, LINEAR_1D, region), nonlinear(mine, region)]
        numbers += [over_bem(mine, model, region) for model in (SPRINGS, ROLLING_SPRINGS)]
    return numbers


def moments(mine: LevelsAtHeight) -> list[Number]:
    """Variance at one position over that of linear theory, the same in 1D and in 3D; the mean force."""
    variances = [
        Number(
            quantity=VARIANCE,
            model=model,
            where={"h/d": mine.height},
            value=ratio.value,
            reference=1.0,
            source="Geike's rule keeps the variance of the force at one position",
            tolerance=0.1,
            reason="10 %: 0.4 dB of a variance",
            sample=ratio.half_width,
            role=Role.FINDING,
        )
        for model, outcome in (("bem3d", mine.bem), (SPRINGS, mine.springs))
        for ratio in [ratio_of_means(outcome["variance"], outcome["linear variance"])]
    ]
    mean = difference(
        mean_estimate(mine.springs["mean"]),
        mean_estimate(mine.bem["mean"]),
        absolute=True,
        scale=1.0,
        quantity=MEAN,
        model=BOTH,
        where={"h/d": mine.height},
        source="bem3d",
        tolerance=0.02,
        unit="-",
        reason="2 %: uncertainty of the load of a wheel",
    )
    return [*variances, mean]


def _excess(case: ForceSpectrum, numbers: list[Number]) -> Number:
    """By how much Geike's spectrum is too loud along the track, beside the power law without ends."""
    found = number_with(numbers, LEVEL, f"{LINEAR_1D} over bem3d", **place(case.heights[0], regions(case)[-1]))
    return replace(
        found,
        quantity="mean level over its limit for q a >> 1",
        reference=-POWER_DECIBEL * math.log(level_ratio(case.hurst)),
        source="sqrt(π) Γ(H + 2) / Γ(H + 3/2), an unbounded power law in linear theory",
        tolerance=0.5,
        reason="0.5 dB: the band is bounded and q a is finite",
    )
