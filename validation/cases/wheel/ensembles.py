"""What an ensemble of wheels shows: each feature of its mean spectrum with its error, and what theory expects of it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis import spectra as regions
from validation.analysis.spectra import band_means
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, jackknifed
from validation.case import Quantity, Series
from validation.engine.engine import Outcome
from validation.scenes.load import load_scene_with_track
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.simulation import wheel_features
from validation.theory import rolling as rolling_theory

TABLE = load_scene_with_track("table_14_1")
Spectrum1D = Callable[[FloatArray], FloatArray]
decibels = partial(Series, scale=POWER_DECIBEL, unit="dB")

PEAK, JUMP, SLOPE, PERIOD = wheel_features.NAMES
FLOOR, BREAK = "floor", "break"
FEATURES = (*wheel_features.NAMES, FLOOR, BREAK)
QUANTITIES = {
    PEAK: Quantity("peak_ω_eigen", "peak ω_eigen"),
    JUMP: "jump",
    SLOPE: Quantity("slope_of_region_3"),
    PERIOD: Quantity("period_of_the_oscillation"),
}
"""Of the features that are judged."""
LEVEL, OMEGA, UNIT = "level", "ω [rad/s]", "(m/s²)² s"
DENSITY = f"A [{UNIT}]"
density_of = partial(Series, along=OMEGA, unit=UNIT)
HALF_BAND = 1 / 24
"""Of a period of an oscillation: half of the band about a maximum or a zero."""
FLOOR_BAND = (1.3, 2.6)
"""Where the floor is measured, over q_max v_0."""


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Mean spectra of an ensemble: omega; plain, hann: (groups, frequencies); jumps: of each wheel; times [s]."""

    scene: RollingScene
    omega: FloatArray
    plain: FloatArray
    hann: FloatArray
    jumps: FloatArray
    time_step: float
    duration: float

    @classmethod
    def of(cls, scene: RollingScene, outcomes: Sequence[Outcome]) -> "Spectrum":
        """All batches of one ensemble, of equal size."""
        first = outcomes[0]
        plain, hann = (np.concatenate([o[name] for o in outcomes]) for name in ("plain", "hann"))
        jumps = np.concatenate([o["jump"] for o in outcomes])
        return cls(scene, first["omega"], plain, hann, jumps, float(first["time step"]), float(first["duration"]))

    @property
    def linear(self) -> FloatArray:
        """(14.12) with (14.18), through the resonator, as (14.17) has it; infinite at the resonance."""
        return linear_spectrum(self.scene, self.omega)


def linear_spectrum(scene: RollingScene, omega: FloatArray, c1d: Spectrum1D | None = None) -> FloatArray:
    """A of linear theory in one dimension: C_F of (14.12) over the fixed contact, and the wheel on its spring.

    c1d: of the tracks; by default Geike's of rail and wheel.
    """
    same = {"contact_radius": scene.contact_radius, "modulus": scene.modulus}
    force = rolling_theory.force_spectrum_1d(omega / scene.rolling_speed, c1d or roughness(scene), **same)
    return accelerated_by(force, scene, omega)


def linear_force_3d(scene: RollingScene, q: FloatArray) -> FloatArray:
    """C_F of linear theory in three dimensions, over a rough rail."""
    assert scene.rail is not None  # strips refuse a smooth rail
    return rolling_theory.force_spectrum_3d(
        q, scene.rail.spectrum.c2d, edges=scene.rail.edges, contact_radius=scene.contact_radius, modulus=scene.modulus
    )


def accelerated_by(force: FloatArray, scene: RollingScene, omega: FloatArray) -> FloatArray:
    """A of the wheel on its contact spring under a force of that C_F."""
    same = {name: getattr(scene, name) for name in ("eigenfrequency", "mass", "damping")}
    resonator = rolling_theory.acceleration_over_force(omega, **same)
    return np.asarray(rolling_theory.over_frequency(force, speed=scene.rolling_speed) * resonator)


def roughness(scene: RollingScene) -> Spectrum1D:
    """C_1D of rail and wheel together: independent heights add as spectra."""
    both = [r.spectrum for r in (scene.rail, scene.wheel) if r]
    return lambda q: np.asarray(sum((s.c1d(q) for s in both), np.zeros_like(q)))


def sixths_of_an_octave(low: float, high: float) -> FloatArray:
    return np.asarray(low * 2 ** (np.arange(0, 6 * math.log2(high / low)) / 6))


def in_sixths(omega: FloatArray, density: FloatArray, low: float, high: float) -> tuple[FloatArray, FloatArray]:
    """Centres of sixths of an octave that hold a line, and means of A there."""
    edges = sixths_of_an_octave(low, high)
    means = band_means(omega, density, edges)
    return np.sqrt(edges[1:] * edges[:-1])[np.isfinite(means)], means[np.isfinite(means)]


def measured(spectrum: Spectrum) -> dict[str, Estimate]:
    """The features that stand out, with standard errors by the jackknife over groups of wheels."""

    def of(kept: FloatArray) -> FloatArray:
        groups = kept.astype(int)
        values = _features(spectrum, *(s[groups].mean(axis=0) for s in (spectrum.plain, spectrum.hann)))
        return np.array([values.get(name, math.nan) for name in FEATURES])

    estimates = zip(FEATURES, jackknifed(of, np.arange(float(len(spectrum.plain)))), strict=True)
    return {name: value for name, value in estimates if math.isfinite(value.value) and math.isfinite(value.error)}


def expected(spectrum: Spectrum) -> dict[str, float]:
    """What theory has for each: sqrt(2 a E* / M), q_min v_0, -2 H - 3, pi v_0 / a, the jump at the end of records."""
    scene = spectrum.scene
    exponent = -2 * hurst(scene) - 3
    floor = float(np.mean(spectrum.jumps**2)) / spectrum.duration
    period = scene.oscillation_period
    # sin^2 in the mean: (14.14) through the resonator, far above the resonance
    power = rolling_theory.over_frequency(
        rolling_theory.mean_force_spectrum_1d(
            scene.cutoff / scene.rolling_speed, roughness(scene), modulus=scene.modulus
        ),
        speed=scene.rolling_speed,
    ) / (scene.body.mass**2 * scene.cutoff**exponent)
    if scene.rail and scene.wheel and _shape(scene.rail) != _shape(scene.wheel):
        # no power law: what the same rule finds in linear theory
        first, last = wheel_features.third_region(scene, scene.jump)
        fine = np.arange(1, math.ceil(1.1 * scene.cutoff / spectrum.omega[0])) * spectrum.omega[0]
        linear = linear_spectrum(scene, fine)
        if last - first >= wheel_features.MIN_PERIODS * period:
            exponent = regions.slope(fine, linear, first, last, period)
            power = np.asarray(regions.power_level(fine, linear, first, last, period, exponent))
    return {
        PEAK: scene.eigenfrequency,
        JUMP: scene.jump,
        SLOPE: exponent,
        PERIOD: period,
        FLOOR: floor,
        BREAK: regions.crossing(float(power), exponent, floor),
    }


def hurst(scene: RollingScene) -> float:
    """H of the rail, or of the wheel where the rail is smooth. Raises ValueError where both are."""
    rough = scene.rail or scene.wheel
    if rough is None:
        raise ValueError("scene must have a rough rail or a rough wheel, got both smooth")
    return rough.hurst


def _shape(rough: Roughness) -> tuple[float, float, float]:
    return rough.hurst, rough.longest, rough.shortest


def _features(spectrum: Spectrum, plain: FloatArray, hann: FloatArray) -> dict[str, float]:
    """Those of one mean spectrum, as far as the scene has room for them: frequencies beyond the roughness, too."""
    scene, omega, expect = spectrum.scene, spectrum.omega, expected(spectrum)
    values = wheel_features.features_of(scene, omega, hann)
    first, last = (beyond * scene.cutoff for beyond in FLOOR_BAND)
    last = min(last, wheel_features.THIRD_LAST * float(omega[-1]))
    if first < wheel_features.THIRD_LAST * last:
        values[FLOOR] = regions.floor_level(omega, plain, first, last, spectrum.time_step)
    if SLOPE in values:
        ends = wheel_features.third_region(scene, values.get(JUMP, scene.jump))
        power = regions.power_level(omega, hann, *ends, expect[PERIOD], expect[SLOPE])
        if FLOOR in values:
            values[BREAK] = regions.crossing(power, expect[SLOPE], values[FLOOR])
    return values


def log_beside_over_at(periods: FloatArray, flat: FloatArray, places: FloatArray) -> FloatArray:
    """ln of the mean half a period to either side of each place, over that about the place; periods: of each line."""

    def mean_about(place: float) -> float:
        return float(np.mean(flat[np.abs(periods - place) < HALF_BAND]))

    return np.log([(mean_about(n - 0.5) + mean_about(n + 0.5)) / 2 / mean_about(n) for n in places])


# --- levels of the regions ---

FIRST, PLATEAU, THIRD, FOURTH = "region 1", "region 2", "region 3", "region 4"


def regions_of(scene: RollingScene) -> dict[str, tuple[float, float]]:
    """The band in which each region is measured [rad/s]."""
    return {
        FIRST: (0.5 * scene.eigenfrequency, 2 * scene.eigenfrequency),
        PLATEAU: (2 * scene.eigenfrequency, 0.8 * scene.jump),
        THIRD: (1.1 * scene.jump, 1.1 * scene.jump + scene.oscillation_period / 2),
        FOURTH: (1.3 * scene.cutoff, 2.6 * scene.cutoff),
    }


def of_groups(outcome: Outcome, band: tuple[float, float], window: str) -> FloatArray:
    """The mean of A in a band, group by group."""
    inside = (outcome["omega"] >= band[0]) & (outcome["omega"] <= band[1])
    return np.asarray(outcome[window][:, inside].mean(axis=1))
