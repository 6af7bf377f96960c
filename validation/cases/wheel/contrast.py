"""The contrast of an oscillation: how far its zeros are filled, one after the other."""

import numpy as np

from validation.analysis.margins import MARGINS
from validation.analysis.series import Estimates, Series
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknifed
from validation.cases.wheel.features import FloatArray, hurst, linear_spectrum
from validation.scenes.dynamic_wheel import WheelScene

CONTRAST, ZERO = "contrast of the oscillation", "zero of sin²(q a)"
HALF_BAND = 1 / 24
"""Of a period: half of the band about a maximum or a zero."""


def zeros_of(scene: WheelScene) -> FloatArray:
    """The numbers n of the zeros q a = n pi that have both of their maxima in region 3."""
    first, last = scene.jump / scene.oscillation_period, scene.cutoff / scene.oscillation_period
    return np.arange(np.ceil(first + 0.5 + HALF_BAND), np.floor(last - 0.5 - HALF_BAND) + 1)


def log_beside_over_at(periods: FloatArray, flat: FloatArray, places: FloatArray) -> FloatArray:
    """ln of the mean half a period to either side of each place, over that about the place; periods: of each line."""

    def mean_about(place: float) -> float:
        return float(np.mean(flat[np.abs(periods - place) < HALF_BAND]))

    return np.log([(mean_about(n - 0.5) + mean_about(n + 0.5)) / 2 / mean_about(n) for n in places])


def log_contrasts(omega: FloatArray, density: FloatArray, scene: WheelScene) -> FloatArray:
    """ln of the mean of A omega^(2 H + 3) about the two maxima beside each zero, over that about the zero."""
    flat = density * omega ** (2 * hurst(scene) + 3)
    return log_beside_over_at(omega / scene.oscillation_period, flat, zeros_of(scene))


def contrasts_of(omega: FloatArray, groups: FloatArray, scene: WheelScene) -> list[Estimate]:
    """Of the mean of groups of wheels, (groups, frequencies), by the jackknife."""
    return jackknifed(lambda some: log_contrasts(omega, some.mean(axis=0), scene), groups)


def linear_contrasts(omega: FloatArray, scene: WheelScene) -> FloatArray:
    """Of (14.12) through the resonator, at the lines of a record."""
    return log_contrasts(omega, linear_spectrum(scene, omega), scene)


def contrast_series(
    model: str, found: list[Estimate] | FloatArray, scene: WheelScene, linear: FloatArray | None = None, family: int = 1
) -> Series:
    """By the number of the zero, in decibels; judged beside linear theory, where that is given."""
    return Series(
        CONTRAST,
        model,
        found,
        along=ZERO,
        at=zeros_of(scene),
        reference=0.0 if linear is None else Estimates.exact(linear),
        scale=POWER_DECIBEL,
        unit="dB",
        family=family,
        margin=None if linear is None else MARGINS["contrast"].beside("linear theory in the same bands"),
    )
