"""The contrast of the oscillation of region 3: how far the zeros of sin²(q a) are filled, one after the other."""

import numpy as np

from validation.analysis.evidence import Number, Table, table_of
from validation.analysis.features import FEATURES
from validation.analysis.over_range import worst
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknife_error
from validation.cases.wheel.features import OSCILLATION_LAST, THIRD_FIRST, FloatArray, hurst, linear_spectrum
from validation.scenes.dynamic_wheel import WheelScene

ZERO = "zero of sin²(q a)"
HALF_BAND = 1 / 24
"""Of a period: half of the band about a maximum or a zero."""


def zeros_of(scene: WheelScene) -> FloatArray:
    """The numbers n of the zeros q a = n pi that have both of their maxima in region 3."""
    first, last = scene.jump / scene.oscillation_period, scene.cutoff / scene.oscillation_period
    return np.arange(np.ceil(first + 0.5 + HALF_BAND), np.floor(last - 0.5 - HALF_BAND) + 1)


def period_range(scene: WheelScene) -> str:
    """Where the period is sought."""
    last = OSCILLATION_LAST * scene.cutoff
    return f"from {THIRD_FIRST * scene.jump:.3g} to {last:.3g} rad/s, up to zero {last / scene.oscillation_period:.0f}"


def contrasts(omega: FloatArray, density: FloatArray, scene: WheelScene) -> FloatArray:
    """The mean of A omega^(2 H + 3) about the two maxima beside each zero, over that about the zero."""
    law = density * omega ** (2 * hurst(scene) + 3)

    def mean_about(place: float) -> float:
        return float(np.mean(law[np.abs(omega / scene.oscillation_period - place) < HALF_BAND]))

    zeros = zeros_of(scene)
    return np.array([(mean_about(n - 0.5) + mean_about(n + 0.5)) / 2 / mean_about(n) for n in zeros])


def log_contrasts(omega: FloatArray, density: FloatArray, scene: WheelScene) -> list[Estimate]:
    """ln of the contrast at each zero; density: of each group of wheels, (groups, frequencies); by the jackknife."""

    def of(some: FloatArray) -> FloatArray:
        return np.asarray(np.log(contrasts(omega, some.mean(axis=0), scene)))

    values = of(density)
    errors = jackknife_error(np.array([of(np.delete(density, i, axis=0)) for i in range(len(density))]))
    return [Estimate(float(v), float(e), len(density)) for v, e in zip(values, errors, strict=True)]


def contrast_numbers(
    model: str, found: list[Estimate], linear: FloatArray, scene: WheelScene, claimed: int = 1
) -> list[Number]:
    """Each contrast beside that of linear theory in the same bands; intervals hold for all at once.

    claimed: numbers of the claim, of which the worst contrast is one.
    """
    return [
        FEATURES["contrast"].number(
            POWER_DECIBEL * estimate.value,
            POWER_DECIBEL * float(np.log(reference)),
            "linear theory in the same bands",
            model=model,
            where={ZERO: float(n)},
            sample=POWER_DECIBEL * estimate.half_width_among(len(found) * claimed),
        )
        for n, estimate, reference in zip(zeros_of(scene), found, linear, strict=True)
    ]


def linear_contrasts(omega: FloatArray, scene: WheelScene) -> FloatArray:
    """Of (14.12) through the resonator, at the lines of a record."""
    return contrasts(omega, linear_spectrum(scene, omega), scene)


def worst_contrast(numbers: list[Number]) -> Number:
    """The zero whose verdict is that of all."""
    return worst(numbers, ZERO)


def contrast_table(scene: WheelScene, curves: dict[str, FloatArray | list[Estimate]]) -> Table:
    """Contrast over omega by model, with the 95 % interval of each estimate."""
    rows: list[dict[str, object]] = []
    for i, n in enumerate(zeros_of(scene)):
        row: dict[str, object] = {ZERO: float(n), "omega [rad/s]": float(n * scene.oscillation_period)}
        for name, curve in curves.items():
            value = curve[i]
            if isinstance(value, Estimate):
                row[name] = float(np.exp(value.value))
                row[f"{name}, from"], row[f"{name}, to"] = (float(np.exp(end)) for end in value.interval[1:])
            else:
                row[name] = float(value)
        rows.append(row)
    return table_of("contrast", rows)
