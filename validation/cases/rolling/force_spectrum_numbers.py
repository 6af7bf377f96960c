"""Numbers of rolling over isotropic roughness: levels over boundary elements, variance and mean of the force."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Place, Role
from validation.analysis.over_range import root_mean_square, worst
from validation.analysis.statistics import (
    DECIBEL,
    Estimate,
    extrapolated,
    log_ratio_of_means,
    mean_estimate,
    ratio_of_means,
)
from validation.cases.rolling.force_spectrum import ForceSpectrum
from validation.cases.rolling.force_spectrum_levels import (
    LINEAR_1D,
    LINEAR_3D,
    MODELS,
    SPRINGS,
    FloatArray,
    LevelsAtHeight,
    Region,
)
from validation.theory.rolling import level_ratio

LEVEL, NONLINEAR = "level of a one-third octave", "nonlinear over linear level of a one-third octave"
RMS = "rms of "
"""Before the name of what the root mean square over a range is taken of."""
IN_RMS, RMS_NONLINEAR = RMS + LEVEL, RMS + NONLINEAR
VARIANCE, MEAN = "variance of the force over that of linear theory", "mean force over that of Hertz"
RMS_FORCE = "rms force over that of boundary elements"
EXCESS = "mean level over its limit for q a >> 1"
BOTH = "springs beside bem3d"
THREE_DECIBELS, FORD_THOMPSON = 3.0, "3 dB in one-third octaves: Ford and Thompson, J. Sound Vib. 293 (2006)"
TEN_PER_CENT, OF_WHOLE = DECIBEL * math.log(1.1), "10 %: 0.8 dB of the whole force, less than what is repeatable"
ONE_DECIBEL, REPEATABLE = 1.0, "1 dB: repeatability of measured one-third octave levels"
LINEAR_UP_TO = 0.01
"""h/d up to which boundary elements must agree with linear theory, or something is wrong with them."""


def regions(case: ForceSpectrum) -> list[Region]:
    """Below the band, where springs with Geike's spectrum have no level; the band."""
    ends = ((case.lowest, case.first), (case.first, case.last))
    return [region for region in ends if region[0] < region[1]]


def numbers_of(case: ForceSpectrum, found: list[LevelsAtHeight]) -> list[Number]:
    numbers = [number for mine in found for number in (*_levels(mine), *moments(mine), *rms_forces(mine))]
    return [*numbers, _excess(found[0])]


def place(height: float, region: Region) -> dict[str, Place]:
    """Where a level is: at h/d, in the bands of a region."""
    return {"h/d": height, "q a": region}


def over_bem(mine: LevelsAtHeight, model: str, region: Region, role: Role = Role.FINDING) -> list[Number]:
    """A model over boundary elements: the worst one-third octave of a region, and the rms over all of its."""
    return _judged(
        mine,
        region,
        lambda weights: mine.model_level(model, weights),
        quantity=LEVEL,
        model=f"{model} over bem3d",
        source="bem3d, extrapolated, on the same surfaces as linear theory in 3D",
        role=role,
    )


def nonlinear(mine: LevelsAtHeight, region: Region) -> list[Number]:
    """What nonlinearity does to the level of springs, beside what it does to that of boundary elements."""
    return _judged(
        mine,
        region,
        mine.springs_over_linear,
        quantity=NONLINEAR,
        model=BOTH,
        source="bem3d over linear theory in 3D",
        absolute=True,
    )


def _judged(
    mine: LevelsAtHeight, region: Region, level: Callable[[FloatArray], Estimate], **settings: Any
) -> list[Number]:
    """The worst band and the mean square over bands, whose intervals hold at once for all heights and regions.

    A criterion is no part of a claim: its intervals hold at once for its own bands.
    """
    bands, together = mine.bands_in(region), 2 * len(mine.case.heights) * len(regions(mine.case))
    if settings.get("role") is Role.CRITERION:
        together = 1

    def points(among: int) -> list[Number]:
        found = []
        for band in bands:
            weights = mine.single_bands[band]
            bem, grid = mine.bem_level(weights, among)
            found.append(
                difference(
                    level(weights),
                    bem,
                    where={"h/d": mine.height, "q a": float(mine.case.bands.centres[band])},
                    tolerance=THREE_DECIBELS,
                    reason=FORD_THOMPSON,
                    grid=grid,
                    among=among,
                    **settings,
                )
            )
        return found

    rms = replace(root_mean_square(points(together), "q a", ONE_DECIBEL, REPEATABLE), role=Role.FINDING)
    return [
        replace(one, where={**one.where, "q a": region}) for one in (worst(points(len(bands) * together), "q a"), rms)
    ]


def _levels(mine: LevelsAtHeight) -> list[Number]:
    numbers = []
    for region in regions(mine.case):
        inside = region[0] >= mine.case.first
        for model in MODELS:
            if inside or model != LINEAR_1D:
                must = model == LINEAR_3D and mine.height <= LINEAR_UP_TO
                role = Role.CRITERION if must else Role.FINDING
                numbers += over_bem(mine, model, region, role)
        if inside:
            numbers += nonlinear(mine, region)
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
            sample=ratio.half_width_among(2 * len(mine.case.heights)),
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
        among=len(mine.case.heights),
    )
    return [*variances, mean]


def rms_forces(mine: LevelsAtHeight) -> list[Number]:
    """Springs and linear theory over boundary elements, all bands together.

    Geike's rule keeps the variance of linear theory in 3D, over which each one-sided model is taken.
    """
    refined = mine.result.refined[mine.height]
    pairs = [(one["variance"], one["linear variance"]) for one in (mine.bem, mine.springs)]
    bem, springs = (_log_ratio(*pair) for pair in pairs)
    finer = _log_ratio(refined["variance"], mine.bem["variance"][: len(refined["variance"])])
    among = 2 * len(mine.case.heights)
    whole, grid = extrapolated(bem, finer, among)
    return [
        difference(
            value.minus(whole),
            quantity=RMS_FORCE,
            model=f"{model} over bem3d",
            where={"h/d": mine.height},
            source="bem3d, extrapolated, all over linear theory on the same roughness",
            tolerance=TEN_PER_CENT,
            reason=OF_WHOLE,
            grid=grid,
            among=among,
        )
        for model, value in ((SPRINGS, springs), (LINEAR_3D, Estimate(0.0, 0.0, bem.samples)))
    ]


def _log_ratio(values: FloatArray, references: FloatArray) -> Estimate:
    """ln of the ratio of the means over realisations."""
    return log_ratio_of_means(values[:, np.newaxis], references[:, np.newaxis], np.ones(1))


def _excess(mine: LevelsAtHeight) -> Number:
    """By how much Geike's spectrum is too loud along the track in the mean, beside the power law without ends."""
    short: Region = (4 * mine.case.first, mine.case.last)
    bem, grid = mine.bem_level(mine.weights(short))
    limit = Estimate(-math.log(level_ratio(mine.case.hurst)), 0.0, bem.samples)
    return difference(
        mine.model_level(LINEAR_1D, mine.weights(short)).minus(bem),
        limit,
        absolute=True,
        quantity=EXCESS,
        model=f"{LINEAR_1D} over bem3d",
        where=place(mine.height, short),
        source="sqrt(π) Γ(H + 2) / Γ(H + 3/2), an unbounded power law in linear theory, whose sin² has the mean 1/2",
        tolerance=0.5,
        reason="0.5 dB: the band is bounded and q a is finite",
        grid=grid,
    )
