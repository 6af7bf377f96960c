"""Numbers of Fig. 14.5: the law of the break, its cause, what is real in the plateau, and the peak by amplitude."""

import math
from functools import partial

import numpy as np

from validation.analysis.evidence import Number, Role, Table
from validation.analysis.features import FEATURES
from validation.analysis.over_range import worst
from validation.analysis.statistics import Estimate, ratio_of_means
from validation.cases.wheel.distance import LINEAR_OPEN, LINEAR_STEADY, OPEN, PERIODIC, STEADY, WheelDistance
from validation.cases.wheel.distance import DistanceResult as Result
from validation.cases.wheel.features import (
    FIRST,
    FOURTH,
    PEAK,
    PLATEAU,
    THIRD,
    Spectrum,
    hurst,
    level,
    level_number,
    measured,
    ratio,
    regions_of,
)
from validation.theory import wheel as wheel_theory

BREAK_LAW, JUMP, LEVEL = "d ln ω_break / d ln T", "rms jump over linear theory", FEATURES["level"].quantity
ORDER, SQUARE, PEAK_QUANTITY = "d ln A / d ln h₀", "mean square acceleration", FEATURES[PEAK].quantity
DISTANCE = "distance [m]"
HANN = f"{OPEN}, Hann's window"
QUARTER, WHOLE = 0.25, 1.0
"""Heights over h_0 between which the order of growth is measured."""

finding = partial(Number, role=Role.FINDING)


def numbers_of(result: Result, breaks: Table) -> list[Number]:
    return [
        *outside_the_roughness(result),
        break_law(result.case, breaks),
        worst(jumps(breaks), DISTANCE),
        *levels_over_open(result),
        order_in_height(result),
        mean_square(result),
        *peak_frequencies(result),
    ]


def outside_the_roughness(result: Result) -> list[Number]:
    """A linear contact has nothing at frequencies without waves, once nothing leaks."""
    bands, steady = regions_of(result.case.scene), result.ends[LINEAR_STEADY]
    third = level(steady, bands[THIRD]).value
    return [
        Number(
            quantity="level over that in region 3",
            model=LINEAR_STEADY,
            where={"region": region},
            value=math.exp(level(steady, bands[region]).value - third),
            reference=0.0,
            source="zero: the track has waves from q_min to q_max alone",
            tolerance=1e-18,
            reason="square of the rounding of the acceleration, 1e-16 of its size, spread over all frequencies",
            role=Role.IDENTITY,
        )
        for region in (PLATEAU, FOURTH)
    ]


def break_law(case: WheelDistance, breaks: Table) -> Number:
    """d ln omega_break / d ln T by weighted least squares."""
    x, y = np.log(breaks["duration [s]"]), np.log(breaks["break [rad/s]"])
    weights = breaks["break [rad/s]"] / breaks["standard error [rad/s]"]
    (slope, _), covariance = np.polyfit(x, y, 1, w=weights, cov="unscaled")
    estimate = Estimate(float(slope), math.sqrt(covariance[0, 0]), case.groups)
    return finding(
        quantity=BREAK_LAW,
        model=OPEN,
        where={"durations": f"over a factor of {2**case.doublings}"},
        value=estimate.value,
        reference=wheel_theory.break_exponent(hurst(case.scene)),
        source="1 / (2 H + 1): a floor J² / (ω² T) under a spectrum of ω^(-2H-3)",
        tolerance=0.1,
        reason="0.1: separates this law from no dependence, 0, and from exponents of 1/2 and more",
        sample=estimate.half_width_among(3),
    )


def jumps(breaks: Table) -> list[Number]:
    """The rms jump beside linear theory, by distance; the errors of mean squares of so many Gaussian values."""
    rms = breaks["rms jump [m/s2]"] / breaks["of linear theory [m/s2]"]
    rows = list(zip(breaks["distance [m]"], rms, breaks["wheels"], strict=True))
    return [
        finding(
            quantity=JUMP,
            model=OPEN,
            where={DISTANCE: float(distance)},
            value=float(value),
            reference=1.0,
            source="(1 + cos²(ω_eigen T)) int A df of (14.12) through the resonator, from static equilibrium",
            tolerance=0.1,
            reason="10 %: 0.8 dB; nonlinearity adds a part of order h₀/d",
            sample=Estimate(0.0, value / math.sqrt(2 * count), count).half_width_among(len(rows)),
        )
        for distance, value, count in rows
    ]


def levels_over_open(result: Result) -> list[Number]:
    """Regions over springs on open tracks: without a jump at the end, of leakage or nonlinearity alone.

    A claim takes three of them, whose intervals hold at once.
    """
    ends, bands = result.ends, regions_of(result.case.scene)

    def over(model: str, kind: str, region: str, source: str, window: str = "plain", **cause: str) -> Number:
        return level_number(
            ratio(ends[kind], ends[OPEN], bands[region], window),
            model=f"{model}, over {OPEN}",
            where={"region": region, **cause},
            source=source,
            among=3,
        )

    fourth, plateau = (FOURTH, "no change: what a region 4 without leakage would show"), (PLATEAU, "all of the plateau")
    return [
        over(LINEAR_OPEN, LINEAR_OPEN, FIRST, "all of the peak"),
        over(HANN, OPEN, *fourth, window="hann"),
        *(over(kind, kind, *fourth) for kind in (PERIODIC, STEADY, LINEAR_OPEN)),
        over(LINEAR_OPEN, LINEAR_OPEN, *plateau, cause="leakage alone"),
        over(STEADY, STEADY, *plateau, cause="nonlinearity alone"),
    ]


def order_in_height(result: Result) -> Number:
    """The power of h_0 with which the nonlinear part of region 2 grows; leakage of a linear contact grows as h_0^2."""
    band, step = regions_of(result.case.scene)[PLATEAU], math.log(WHOLE / QUARTER)
    growth = ratio(result.sweep[STEADY, WHOLE], result.sweep[STEADY, QUARTER], band)
    return finding(
        quantity=ORDER,
        model=STEADY,
        where={"region": PLATEAU, "h / h₀": (QUARTER, WHOLE)},
        value=growth.value / step,
        reference=4.0,
        source="second order: products of two waves, each linear in h₀",
        tolerance=0.3,
        reason="0.3: separates the exponents 2, 3 and 4",
        sample=growth.half_width / step,
    )


def mean_square(result: Result) -> Number:
    """Mean square of the acceleration from static equilibrium over that without free vibration."""
    squares = ratio_of_means(result.ends[OPEN]["square"], result.ends[STEADY]["square"])
    return finding(
        quantity=SQUARE,
        model=f"{OPEN}, over {STEADY}",
        value=squares.value,
        reference=1.5,
        source="1 + 1/2: the free vibration begins with the amplitude dF / M that cancels the forced acceleration",
        tolerance=0.15,
        reason="10 %: 1.5 holds for waves far above the resonance; few wheels",
        sample=squares.half_width,
    )


def peak_frequencies(result: Result) -> list[Number]:
    """The peak by the amplitude of free vibration, beside that on a Hertz contact; intervals hold at once."""
    frequency, found = result.case.scene.eigenfrequency, peaks(result)
    return [
        FEATURES[PEAK].number(
            frequency * estimate.value,
            frequency * (1 / wheel_theory.hertz_period(1 + release) if release else 1.0),
            "period of free vibration on a Hertz contact, quadrature" if release else "sqrt(2 a E* / M)",
            model=OPEN,
            where={"release / d": release},
            sample=frequency * estimate.half_width_among(len(found)),
        )
        for release, estimate in found.items()
    ]


def peaks(result: Result) -> dict[float, Estimate]:
    """The frequency of the peak over omega_eigen, by release."""
    frequencies = {}
    for release, ensemble in result.case.vibrations().items():
        value = measured(Spectrum.of(ensemble.scene, [result.vibrations[release]]))[PEAK]
        frequency = ensemble.scene.eigenfrequency
        frequencies[release] = Estimate(value.value / frequency, value.error / frequency, value.samples)
    return frequencies
