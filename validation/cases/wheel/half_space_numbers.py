"""Numbers of the wheel in three dimensions: models over boundary elements, slope and contrast of region 3."""

from collections.abc import Iterator, Sequence

import numpy as np

from validation.analysis import spectral_features
from validation.analysis.evidence import Number, numbers_with
from validation.analysis.features import FEATURES
from validation.analysis.over_range import signed_mean, worst
from validation.analysis.statistics import Estimate, jackknife_error
from validation.cases.wheel.contrast import ZERO, contrast_numbers, linear_contrasts, log_contrasts, zeros_of
from validation.cases.wheel.features import SLOPE, FloatArray, hurst, level_number
from validation.cases.wheel.half_space import FINEST
from validation.cases.wheel.half_space_levels import LINEAR_3D, MODELS, WheelLevels

LEVEL, OMEGA = FEATURES["level"].quantity, "ω [rad/s]"
OF_FIGURE = 5
"""Numbers of the claim of Fig. 14.4, whose intervals hold at once: levels of three ranges, slope, contrast."""
OVER_BEM = {model: f"{model}, over bem3d" for model in MODELS}
CONTACTS = {"bem3d": "bem", LINEAR_3D: "linear"}


def numbers_of(levels: WheelLevels, bands: Sequence[Number]) -> list[Number]:
    """bands: of `levels_over_bem`; a range of them is judged by its worst."""
    contrasts = contrasts_beside_linear(levels)
    return [
        mean_of_steady_state(levels),
        *(worst(of_range(bands, name, model), OMEGA) for name, model in judged_ranges(levels, bands)),
        *slopes(levels),
        *([worst(contrasts, ZERO)] if contrasts else []),
    ]


def judged_ranges(levels: WheelLevels, bands: Sequence[Number]) -> list[tuple[str, str]]:
    """Range and model, where the model has a level in all bands of the range."""
    return [
        (name, model)
        for name, inside in levels.ranges.items()
        for model in MODELS
        if 0 < inside.sum() == len(of_range(bands, name, model))
    ]


def of_range(bands: Sequence[Number], name: str, model: str) -> list[Number]:
    return numbers_with(bands, LEVEL, OVER_BEM[model], range=name)


def mean_over_range(bands: Sequence[Number], name: str, model: str) -> float:
    """Signed: what is judged is the worst band."""
    return signed_mean(of_range(bands, name, model))


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


def levels_over_bem(levels: WheelLevels) -> list[Number]:
    """Each one-third octave of each range, whose intervals hold at once; none of a model that has nothing there."""
    return [
        _over_bem(levels, model, name, int(band), among=OF_FIGURE * int(inside.sum()))
        for name, inside in levels.ranges.items()
        for model in MODELS
        for band in np.flatnonzero(inside & np.isfinite(levels.over_bem(model)))
    ]


def _over_bem(levels: WheelLevels, model: str, name: str, band: int, among: int) -> Number:
    estimate, grid = levels.mean_over_bem(model, np.arange(levels.centres.size) == band)
    return level_number(
        estimate,
        model=OVER_BEM[model],
        where={"range": name, OMEGA: float(levels.centres[band])},
        source="boundary elements in the time loop",
        grid=grid,
        among=among,
    )


def slopes(levels: WheelLevels) -> Iterator[Number]:
    """The power law of region 3, where it has four periods of the oscillation, on the same strips for both."""
    scene = levels.result.case.scene
    first, last, period = 1.1 * scene.jump, 0.7 * scene.cutoff, scene.oscillation_period
    if last - first < 4 * period:
        return
    for model, contact in CONTACTS.items():
        omega, density = levels.spectra(contact)

        def of(some: FloatArray, omega: FloatArray = omega) -> float:
            return spectral_features.slope(omega, some.mean(axis=0), first, last, period)

        without = [of(np.delete(density, i, axis=0)) for i in range(len(density))]
        value = Estimate(of(density), float(jackknife_error(without)), len(density))
        yield FEATURES[SLOPE].number(
            value.value,
            -2 * hurst(scene) - 3,
            "-2 H - 3, (14.13); the same in linear theory in 3D",
            model=model,
            where={"region": "region 3"},
            sample=value.half_width_among(OF_FIGURE),
        )


def contrasts_beside_linear(levels: WheelLevels) -> list[Number]:
    """Of boundary elements beside sin²(q a); none where region 3 has no whole period."""
    scene = levels.result.case.scene
    if not zeros_of(scene).size:
        return []
    omega, density = levels.spectra("bem")
    found = log_contrasts(omega, density, scene)
    return contrast_numbers("bem3d", found, linear_contrasts(omega, scene), scene, claimed=OF_FIGURE)
