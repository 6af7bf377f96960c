"""Numbers of region 2: its level and contrast beside the second-order force, and its end at low speed."""

import math
from functools import partial

import numpy as np

from validation.analysis import spectral_features
from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.features import FEATURES
from validation.analysis.spectra import band_levels, one_third_octaves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknife_error, log_ratio_of_means
from validation.cases.wheel.contrast import HALF_BAND
from validation.cases.wheel.features import JUMP, FloatArray, level_number, resonator, roughness
from validation.cases.wheel.regions import SHORT_OPEN, RegionsResult
from validation.scenes.dynamic_wheel import WheelScene
from validation.theory import rolling as rolling_theory
from validation.theory import wheel as wheel_theory

OMEGA, RATIO, MAXIMUM = "ω [rad/s]", "q_min v₀ / ω_eigen", "maximum of cos²(q a)"
FIRST, LAST = 3.0, 0.9
"""Region 2 begins at this multiple of the eigenfrequency and ends at this of q_min v_0."""
OF_SECOND_ORDER = 3
"""Numbers of its claim, whose intervals hold at once: two levels and a contrast."""
RESOLVED = 2
"""Lines between two tones of equal height that Hann's window keeps apart: the width of its main lobe at half height."""
APART = 3.0
"""Decibels by which a valley stands below the jump behind it."""


def second_order(scene: WheelScene, omega: FloatArray) -> FloatArray:
    """A of the second-order force of springs through the resonator, up to region 3; zero there."""
    inside = omega < scene.jump
    force = rolling_theory.second_order_force_spectrum(
        omega[inside] / scene.speed,
        roughness(scene),
        q_max=scene.cutoff / scene.speed,
        contact_radius=scene.contact_radius,
        radius=scene.radius,
        modulus=scene.modulus,
    )
    found = np.zeros(omega.size)
    found[inside] = wheel_theory.over_frequency(force, speed=scene.speed) * resonator(scene, omega[inside])
    return found


def levels_over_second_order(result: RegionsResult, name: str) -> list[Number]:
    """One-third octaves of region 2 without leakage, over the second-order force."""
    scene, outcome = result.case.plateaus()[name].scene, result.plateaus[name]
    omega = outcome["omega"]
    edges = one_third_octaves(FIRST * scene.eigenfrequency, LAST * scene.jump)
    groups, theory = (
        band_levels(omega, outcome["plain"].T, edges).T,
        band_levels(omega, second_order(scene, omega), edges),
    )
    return [
        level_number(
            log_ratio_of_means(groups, theory, weights=one_band),
            model=f"{name}, over the second-order force",
            where={"region": "region 2", OMEGA: float(centre)},
            source="(E* R / 2a)² cos²(q a) 2 int C_1D(k) C_1D(q - k) dk, through the resonator",
            among=OF_SECOND_ORDER * theory.size,
        )
        for centre, one_band in zip(np.sqrt(edges[1:] * edges[:-1]), np.eye(theory.size), strict=True)
    ]


def maxima_of(scene: WheelScene) -> FloatArray:
    """The numbers n of the maxima q a = n pi of cos²(q a) that have both of their zeros in region 2."""
    return np.arange(1.0, math.floor(LAST * scene.jump / scene.oscillation_period - 0.5) + 1)


def log_contrasts(scene: WheelScene, omega: FloatArray, density: FloatArray) -> FloatArray:
    """ln of the mean of A omega^2 about each maximum of cos²(q a) over that about the zeros beside it."""
    flat = density * omega**2

    def mean_about(place: float) -> float:
        return float(np.mean(flat[np.abs(omega / scene.oscillation_period - place) < HALF_BAND]))

    return np.log([2 * mean_about(n) / (mean_about(n - 0.5) + mean_about(n + 0.5)) for n in maxima_of(scene)])


def contrast_numbers(result: RegionsResult, name: str) -> list[Number]:
    """Of region 2 over short waves: beside the second-order force in the steady state, beside none on open tracks."""
    scene, outcome = result.case.plateaus()[name].scene, result.plateaus[name]
    omega, groups = outcome["omega"], outcome["plain"]
    values = log_contrasts(scene, omega, groups.mean(axis=0))
    without = [log_contrasts(scene, omega, np.delete(groups, i, axis=0).mean(axis=0)) for i in range(len(groups))]
    leaks = name == SHORT_OPEN
    expected = np.zeros(values.size) if leaks else log_contrasts(scene, omega, second_order(scene, omega))
    return [
        FEATURES["contrast"].number(
            POWER_DECIBEL * value,
            POWER_DECIBEL * reference,
            "no substructure" if leaks else "the second-order force in the same bands",
            model=name,
            where={"region": "region 2", MAXIMUM: float(n)},
            sample=POWER_DECIBEL * Estimate(0.0, error, len(groups)).half_width_among(OF_SECOND_ORDER * values.size),
        )
        for n, value, reference, error in zip(
            maxima_of(scene), values, expected, jackknife_error(np.array(without)), strict=True
        )
    ]


def valley(scene: WheelScene, omega: FloatArray, hann: FloatArray) -> float:
    """How far A falls between the resonance and the jump, below the rise behind it [dB]; 0 where no line is there."""
    between = (omega > scene.eigenfrequency) & (omega < scene.jump)
    behind = (omega >= scene.jump) & (omega < 1.2 * scene.jump)
    if not between.any():
        return 0.0
    return max(POWER_DECIBEL * math.log(hann[behind].max() / hann[between].min()), 0.0)


def _jump(scene: WheelScene, omega: FloatArray, hann: FloatArray) -> float:
    between = math.sqrt(scene.eigenfrequency * scene.jump)
    return spectral_features.jump(omega, hann.mean(axis=0), between, scene.cutoff / 2)


def speeds_of(result: RegionsResult) -> Table:
    """Jump and valley by speed."""
    rows: list[dict[str, object]] = []
    for ratio, ensemble in result.case.speeds().items():
        scene, outcome = ensemble.scene, result.speeds[ratio]
        omega, groups = outcome["omega"], outcome["hann"]
        jump = partial(_jump, scene, omega)
        without = [jump(np.delete(groups, i, axis=0)) for i in range(len(groups))]
        rows.append(
            {
                RATIO: ratio,
                "v0 [m/s]": scene.speed,
                "line [rad/s]": float(omega[0]),
                "jump [rad/s]": jump(groups),
                "standard error [rad/s]": float(jackknife_error(without)),
                "q_min v0 [rad/s]": scene.jump,
                "valley [dB]": valley(scene, omega, groups.mean(axis=0)),
                "merges at": 1 + RESOLVED / result.case.periods,
            }
        )
    return table_of("speeds", rows)


def jump_numbers(result: RegionsResult, speeds: Table) -> list[Number]:
    """The jump by speed, as long as a valley is before it."""
    seen = [i for i, depth in enumerate(speeds["valley [dB]"]) if depth > APART and speeds[RATIO][i] > 1.5]
    return [
        FEATURES[JUMP].number(
            float(speeds["jump [rad/s]"][i]),
            float(speeds["q_min v0 [rad/s]"][i]),
            "q_min v₀, (14.20)",
            model="springs, open",
            where={RATIO: float(speeds[RATIO][i])},
            grid=float(speeds["line [rad/s]"][i]) / 2,
            sample=Estimate(0.0, float(speeds["standard error [rad/s]"][i]), result.case.groups).half_width_among(
                len(seen)
            ),
        )
        for i in seen
    ]


def merging(result: RegionsResult, speeds: Table) -> Number:
    """q_min v_0 over the eigenfrequency below which no valley separates regions 1 and 2 from region 3."""
    ratios, depth = speeds[RATIO][::-1], speeds["valley [dB]"][::-1]
    last = int(np.flatnonzero(depth < APART).max(initial=-1))
    low, high = ratios[last] if last >= 0 else 0.0, ratios[min(last + 1, ratios.size - 1)]
    return Number(
        quantity="q_min v₀ / ω_eigen at which the plateau disappears",
        model="springs, open",
        where={"natural periods": float(result.case.periods), "window": "Hann's window"},
        value=float((low + high) / 2),
        reference=float(speeds["merges at"][0]),
        source=f"1 + {RESOLVED} / N: a record of N natural periods keeps apart what lies {RESOLVED} lines apart",
        tolerance=3 / result.case.periods,
        reason="three lines of the record: the jump is no tone, and the resonance is higher than it",
        grid=float((high - low) / 2),
        role=Role.FINDING,
    )
