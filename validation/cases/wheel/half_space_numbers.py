"""Numbers of the wheel in three dimensions: each model over boundary elements, and the slope of region 3."""

from collections.abc import Iterator

import numpy as np

from validation.analysis import spectral_features
from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role
from validation.analysis.statistics import Estimate, jackknife_error
from validation.cases.wheel.half_space import FINEST
from validation.cases.wheel.half_space_levels import MODELS, FloatArray, WheelLevels, hann_spectra

LEVEL, SLOPE = "level", "slope"
OVER_BEM = {model: f"{model}, over bem3d" for model in MODELS}
ONE_DECIBEL = 1.0


def numbers_of(levels: WheelLevels) -> list[Number]:
    return [mean_of_steady_state(levels), *levels_over_bem(levels), *slope(levels)]


def mean_of_steady_state(levels: WheelLevels) -> Number:
    """A motion that repeats itself gains no velocity."""
    series = [strip["linear"] for strip in levels.result.strips[FINEST]]
    return Number(
        quantity="mean acceleration over its rms",
        model="linear, steady-state",
        where={"strips": "worst strip"},
        value=max(abs(float(one.mean())) / float(one.std()) for one in series),
        reference=0.0,
        source="zero: a periodic motion has no mean acceleration",
        tolerance=1e-9,
        reason="rounding of a sum over all steps",
    )


def levels_over_bem(levels: WheelLevels) -> Iterator[Number]:
    """The mean over bands of each range; not of a model that has nothing there."""
    for name, bands in levels.ranges.items():
        for model in MODELS:
            if not bands.any() or not np.isfinite(levels.over_bem(model)[bands]).all():
                continue
            value, grid = levels.mean_over_bem(model, bands)
            yield difference(
                value,
                quantity=LEVEL,
                model=OVER_BEM[model],
                where={"range": name},
                source="boundary elements in the time loop",
                tolerance=ONE_DECIBEL,
                reason="1 dB: a third of the 3 dB accepted for one-third octaves of rolling noise",
                grid=grid,
            )


def slope(levels: WheelLevels) -> Iterator[Number]:
    """The power law of region 3 by boundary elements, where it has four periods of the oscillation."""
    case, scene = levels.result.case, levels.result.case.scene
    assert scene.rail is not None  # strips refuse a smooth rail
    period = scene.oscillation_period
    first, last = 1.1 * scene.jump, 0.7 * scene.cutoff
    if last - first < 4 * period:
        return
    records = [hann_spectra([strip], "bem") for strip in levels.converged]
    omega, density = records[0].omega, np.array([record.density[:, 0] for record in records])

    def of(some: FloatArray) -> float:
        return spectral_features.slope(omega, some.mean(axis=0), first, last, period)

    without = [of(np.delete(density, i, axis=0)) for i in range(len(density))]
    value = Estimate(of(density), float(jackknife_error(without)), len(density))
    yield Number(
        quantity=SLOPE,
        model="bem3d",
        where={"region": "region 3"},
        value=value.value,
        reference=-2 * scene.rail.hurst - 3,
        source="-2 H - 3, (14.13); the same in linear theory in 3D",
        tolerance=0.2,
        reason=f"0.2: 5 %, {case.strips} strips and the end of the band",
        sample=value.half_width,
        role=Role.FINDING,
    )
