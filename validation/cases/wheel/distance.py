"""Fig. 14.5: distances, the break, and what is real in the plateau; the peak at large amplitudes."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from validation.analysis.evidence import Role
from validation.analysis.margins import MARGINS
from validation.analysis.series import Estimates, Margin, Series, Where
from validation.analysis.spectra import band_means
from validation.analysis.statistics import Estimate, FloatArray, ratio_of_means
from validation.analysis.study import Outcomes
from validation.cases.wheel import features
from validation.cases.wheel.features import TABLE, decibels
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.roughness import Roughness
from validation.simulation.wheel_on_springs import TrackKind, WheelEnsemble, simulate_ensemble
from validation.theory import wheel as wheel_theory

SHORT = replace(TABLE, distance=0.16)
MIN_JUMP, MIN_PERIODS = 4.0, 5.0
"""q_min v0 over the eigenfrequency, and periods of the oscillation behind it: with less, regions cannot be separated.
"""
OPEN, PERIODIC, STEADY = "springs, open", "springs, periodic", "springs, steady-state"
LINEAR_OPEN, LINEAR_STEADY = "linear, open", "linear, steady-state"
KINDS: dict[str, tuple[bool, TrackKind]] = {
    OPEN: (False, "open"),
    PERIODIC: (False, "periodic"),
    STEADY: (False, "steady-state"),
    LINEAR_OPEN: (True, "open"),
    LINEAR_STEADY: (True, "steady-state"),
}
"""Of contact and track: whether the contact is linear, and the track."""
BY_HEIGHT_OF = {OPEN: 0, LINEAR_OPEN: 2, STEADY: 4}
"""What makes region 2, with the power of the height as which it grows, where it has one."""


@dataclass(frozen=True, kw_only=True)
class WheelDistance:
    """Wheels of one scene on springs over several distances, contacts and tracks, heights and amplitudes.

    scene; periods: natural periods in the shortest distance, whole; doublings: of it; wheels: to a distance up to the
    middle one, half as many for each doubling beyond, fewest at least; causes: wheels for each contact and track;
    rough: wheels for each height; heights: factors on h_0, ascending, with a quarter and one among them; phases:
    natural periods beyond a whole number after which records end, of `rough` wheels each; releases: amplitudes of free
    vibration over d, of `released` wheels each; groups: of wheels, for errors; seed: zero or more.
    """

    scene: WheelScene = SHORT
    periods: int = 1
    doublings: int = 4
    wheels: int = 60
    fewest: int = 20
    causes: int = 20
    rough: int = 10
    heights: tuple[float, ...] = (0.25, 1.0, 4.0)
    phases: tuple[float, ...] = (0.0, 0.5)
    releases: tuple[float, ...] = (0.0, 0.4)
    released: int = 4
    groups: int = 10
    seed: int = 147

    def distances(self) -> dict[tuple[str, int], WheelEnsemble]:
        """Open tracks, each twice as long as the one before: all end in the same phase of free vibration, so that the
        jump at their end is equally large. The longest first, so that no worker is left alone with it.
        """
        counts = [round(self.wheels * 2 ** (self.doublings / 2 - i)) for i in range(self.doublings + 1)]
        counts = [max(self.fewest, min(self.wheels, count)) // self.groups * self.groups for count in counts]
        found = {}
        for i, count in reversed(list(enumerate(counts))):
            scene = replace(self.scene, distance=self.periods * self.scene.period_length * 2**i)
            found["distance", i] = WheelEnsemble(scene=scene, count=count, groups=self.groups, seed=self.seed)
        return found

    def ensemble(self, kind: str, count: int, height: float = 1.0) -> WheelEnsemble:
        linear, track = KINDS[kind]
        scene = scaled(self.scene, height)
        return WheelEnsemble(scene=scene, count=count, groups=self.groups, track=track, linear=linear, seed=self.seed)

    def ended(self, kind: str, phase: float) -> WheelEnsemble:
        period = self.scene.period_length
        whole = max(round(self.scene.length / period), 1)
        return replace(self.ensemble(kind, self.rough), scene=replace(self.scene, distance=(whole + phase) * period))

    def vibration(self, release: float) -> WheelEnsemble:
        scene, count = replace(self.scene, distance=2 * self.scene.distance), self.released
        return WheelEnsemble(scene=scene, count=count, groups=count, release=release, seed=self.seed)

    def ensembles(self) -> dict[Any, WheelEnsemble]:
        """All, by what they are for: each contact and track, what makes region 2 at each height, ends, releases."""
        return {
            **self.distances(),
            **{kind: self.ensemble(kind, self.causes) for kind in KINDS},
            **{("height", k, h): self.ensemble(k, self.rough, h) for k, h in product(BY_HEIGHT_OF, self.heights)},
            **{("phase", k, p): self.ended(k, p) for k in (OPEN, LINEAR_OPEN) for p in self.phases},
            **{("release", release): self.vibration(release) for release in self.releases},
        }


def scaled(scene: WheelScene, factor: float) -> WheelScene:

    def times(rough: Roughness | None) -> Roughness | None:
        return replace(rough, rms=factor * rough.rms) if rough else None

    return replace(scene, rail=times(scene.rail), wheel=times(scene.wheel))


def run(case: WheelDistance, engine: Engine = SERIAL) -> Outcomes:
    """Simulate all wheels.

    Raises ValueError for a scene without plateau or without region 3, NotConvergedError where most wheels of an
    ensemble do not converge.
    """
    _check_regions(case.scene)
    ensembles = case.ensembles()
    found = dict(zip(ensembles, engine.map(simulate_ensemble, list(ensembles.values())), strict=True))
    failed = [(one, int(found[key]["failed"])) for key, one in ensembles.items() if found[key]["failed"]]
    unconverged = tuple(
        f"{count} of {one.count} wheels do not repeat their motion, h₀ = {one.scene.rms:.3g} m" for one, count in failed
    )
    if any(count > one.count / 2 for one, count in failed):
        raise NotConvergedError("most wheels of an ensemble do not repeat their motion", unconverged)
    return Outcomes(case, found, unconverged)


def _check_regions(scene: WheelScene) -> None:
    """Refuse a scene without a plateau, or with too few periods of the oscillation behind it."""
    features.hurst(scene)
    if scene.jump < MIN_JUMP * scene.eigenfrequency:
        raise ValueError(
            f"scene must have q_min v0 of at least {MIN_JUMP:g} omega_eigen, {MIN_JUMP * scene.eigenfrequency:.4g} "
            f"rad/s, for a plateau between, got {scene.jump:.4g} rad/s"
        )
    least = scene.jump + MIN_PERIODS * scene.oscillation_period
    if scene.cutoff < least:
        raise ValueError(
            f"scene must have q_max v0 of at least {least:.4g} rad/s, {MIN_PERIODS:g} periods pi v0 / a behind "
            f"q_min v0, got {scene.cutoff:.4g} rad/s"
        )


SPECTRA, BREAK_AT, DURATION = "A by distance", "ω_break [rad/s]", "T [s]"
BREAK_LAW, JUMP = "d ln ω_break / d ln T", "rms jump over linear theory"
ORDER, SQUARE = "d ln A / d ln h₀", "mean square acceleration"
CAUSE, OF_REGION = "A by contact and track", "level of a region"
BY_HEIGHT, BY_PHASE, FLOORS = "level by height", "level by phase", "floor over J² / (ω² T), an identity"
OVER_EIGEN, DISTANCE, RELEASE, H_OVER_D = "peak over ω_eigen", "distance [m]", "release / d", "h / d"
HANN = f"{OPEN}, Hann's window"
QUARTER, WHOLE = 0.25, 1.0
"""Heights over h_0 between which the order of growth is measured."""
NO_CHANGE = "no change: what a region 4 without leakage would show"
OF_LAW = Margin(
    0.1,
    "0.1: separates this law from no dependence, 0, and from exponents of 1/2 and more",
    source="1 / (2 H + 1): a floor J² / (ω² T) under a spectrum of ω^(-2H-3)",
)
OF_JUMP = Margin(
    0.1,
    "10 %: 0.8 dB; nonlinearity adds a part of order h₀/d",
    source="(1 + cos²(ω_eigen T)) int A df of (14.12) through the resonator, from static equilibrium",
)
NOTHING_THERE = Margin(
    1e-18,
    "square of the rounding of the acceleration, 1e-16 of its size, spread over all frequencies",
    source="zero: the track has waves from q_min to q_max alone",
    role=Role.IDENTITY,
)
OF_ORDER = Margin(
    0.3, "0.3: separates the exponents 2, 3 and 4", source="second order: products of two waves, each linear in h₀"
)
OF_SQUARE = Margin(
    0.15,
    "10 %: 1.5 holds for waves far above the resonance; few wheels",
    source="1 + 1/2: the free vibration begins with the amplitude dF / M that cancels the forced acceleration",
)


def series(result: Outcomes) -> list[Series]:
    return [*_breaks(result), *_regions(result), *_plateau(result), *_motion(result)]


def _breaks(result: Outcomes) -> Iterator[Series]:
    """Fig. 14.5, the break and its law, the jump that makes the floor behind it; distances from the shortest on."""
    case, rows = result.case, []
    for key, ensemble in reversed(case.distances().items()):
        scene, outcome, distance = ensemble.scene, result[key], ensemble.steps * ensemble.scene.spacing
        spectrum = features.Spectrum.of(scene, [outcome])
        found = features.measured(spectrum)
        low, high = 1.5 * float(outcome["omega"][0]), 1.6 * scene.cutoff
        omega, density = features.in_sixths(outcome["omega"], outcome["plain"].mean(axis=0), low, high)
        spectra = partial(Series, SPECTRA, where={DISTANCE: round(distance, 3)}, along=features.OMEGA)
        yield spectra("spectrum", density, at=omega)
        at_break = math.exp(np.interp(np.log(found[features.BREAK].value), np.log(omega), np.log(density)))
        yield spectra("break", (at_break,), at=(found[features.BREAK].value,))
        jump = rms_over(spectrum.jumps, _linear_jump(spectrum))
        by_jumps, floor = features.expected(spectrum)[features.BREAK], found[features.FLOOR + features.PREDICTED]
        rows.append((spectrum.duration, distance, by_jumps, found[features.BREAK], floor, jump))
    t, distances, predicted, breaks, floors, jumps = zip(*rows, strict=True)
    law = wheel_theory.break_exponent(features.hurst(case.scene))
    middle = math.exp(np.mean(np.log(Estimates(breaks).values) - law * np.log(t)))
    by_duration = partial(Series, along=DURATION, at=t)
    yield by_duration(BREAK_AT, "found", breaks)
    yield by_duration(BREAK_AT, "by the jumps of the records", predicted)
    yield by_duration(BREAK_AT, "T^(1/(2H+1))", middle * np.array(t) ** law)
    yield by_duration(FLOORS, OPEN, floors)
    found_law = (law_of_break(np.array(t), Estimates(breaks)),)
    where = {"durations": f"over a factor of {2**case.doublings}"}
    yield Series(BREAK_LAW, OPEN, found_law, where=where, reference=law, family=3, margin=OF_LAW)
    yield Series(JUMP, OPEN, jumps, along=DISTANCE, at=distances, reference=1.0, margin=OF_JUMP)


def law_of_break(t: FloatArray, breaks: Estimates) -> Estimate:
    """d ln omega_break / d ln T by weighted least squares."""
    weights = breaks.values / np.array([one.error for one in breaks])
    (slope, _), covariance = np.polyfit(np.log(t), np.log(breaks.values), 1, w=weights, cov="unscaled")
    return Estimate(float(slope), math.sqrt(covariance[0, 0]), breaks[0].samples)


def rms_over(jumps: FloatArray, linear: float) -> Estimate:
    """The rms jump over that of linear theory, with the error of a mean square of so many Gaussian values."""
    value = float(np.sqrt(np.mean(jumps**2))) / linear
    return Estimate(value, value / math.sqrt(2 * jumps.size), jumps.size)


def _linear_jump(spectrum: features.Spectrum) -> float:
    """The rms jump of linear theory after a start in static equilibrium."""
    scene = spectrum.scene
    # lines of a short record are too far apart to resolve the oscillation
    fine = np.linspace(0.9 * scene.jump, 1.01 * scene.cutoff, 200001)
    forced = 2 * float(np.trapezoid(features.linear_spectrum(scene, fine), fine)) / (2 * math.pi)
    square = wheel_theory.mean_square_jump(forced, eigenfrequency=scene.eigenfrequency, duration=spectrum.duration)
    return math.sqrt(square)


def _regions(result: Outcomes) -> Iterator[Series]:
    """Spectra of every contact and track; regions over springs on open tracks, of leakage or nonlinearity alone."""
    scene, bands = result.case.scene, features.regions_of(result.case.scene)
    edges = features.sixths_of_an_octave(1.5 * float(result[OPEN]["omega"][0]), 4 * scene.cutoff)
    for model, kind, window in (*((kind, kind, "plain") for kind in KINDS), (HANN, OPEN, "hann")):
        means = band_means(result[kind]["omega"], result[kind][window].mean(axis=0), edges)
        yield Series(CAUSE, model, means, along=features.OMEGA, at=np.sqrt(edges[1:] * edges[:-1]))
        for region, band in bands.items():
            yield decibels(OF_REGION, model, (features.level(result[kind], band, window),), where={"region": region})
    for model, kind, region, source, cause in (
        (LINEAR_OPEN, LINEAR_OPEN, features.FIRST, "all of the peak", {}),
        (HANN, OPEN, features.FOURTH, NO_CHANGE, {}),
        *((kind, kind, features.FOURTH, NO_CHANGE, {}) for kind in (PERIODIC, STEADY, LINEAR_OPEN)),
        (LINEAR_OPEN, LINEAR_OPEN, features.PLATEAU, "all of the plateau", {"cause": "leakage alone"}),
        (STEADY, STEADY, features.PLATEAU, "all of the plateau", {"cause": "nonlinearity alone"}),
    ):
        over = (features.ratio(result[kind], result[OPEN], bands[region], "hann" if model == HANN else "plain"),)
        where, margin = {"region": region, **cause}, replace(MARGINS["level"], source=source)
        yield decibels(features.LEVEL, f"{model}, over {OPEN}", over, where=where, family=3, margin=margin)
    steady = {region: features.level(result[LINEAR_STEADY], band).value for region, band in bands.items()}
    for region in (features.PLATEAU, features.FOURTH):
        above = (math.exp(steady[region] - steady[features.THIRD]),)
        yield Series(
            "level over that in region 3", LINEAR_STEADY, above, where={"region": region}, margin=NOTHING_THERE
        )


def _plateau(result: Outcomes) -> Iterator[Series]:
    """Levels in region 2 by height and by the phase in which a record ends; the power of h_0 of the nonlinear part."""
    case, scene, band = result.case, result.case.scene, features.regions_of(result.case.scene)[features.PLATEAU]
    by_height = partial(decibels, BY_HEIGHT, along=H_OVER_D, at=np.array(case.heights) * scene.rms / scene.approach)
    growth = np.log(np.array(case.heights) / case.heights[0])
    for kind, order in BY_HEIGHT_OF.items():
        found = Estimates(features.level(result["height", kind, h], band) for h in case.heights)
        yield by_height(kind, found)
        if order:
            yield by_height(f"h^{order}", found.values[0] + order * growth)
    for kind in (OPEN, LINEAR_OPEN):
        found = Estimates(features.level(result["phase", kind, phase], band) for phase in case.phases)
        yield decibels(BY_PHASE, kind, found, along="phase", at=case.phases)
    over = features.ratio(result["height", STEADY, WHOLE], result["height", STEADY, QUARTER], band)
    step = math.log(WHOLE / QUARTER)
    power = (Estimate(over.value / step, over.error / step, over.samples),)
    where: Where = {"region": features.PLATEAU, "h / h₀": (QUARTER, WHOLE)}
    yield Series(ORDER, STEADY, power, where=where, reference=4.0, margin=OF_ORDER)


def _motion(result: Outcomes) -> Iterator[Series]:
    """Mean square with free vibration over that without; the peak by the amplitude of free vibration."""
    case, frequency, found = result.case, result.case.scene.eigenfrequency, []
    squares = (ratio_of_means(result[OPEN]["square"], result[STEADY]["square"]),)
    yield Series(SQUARE, f"{OPEN}, over {STEADY}", squares, reference=1.5, margin=OF_SQUARE)
    for release in case.releases:
        spectrum = features.Spectrum.of(case.vibration(release).scene, [result["release", release]])
        value = features.measured(spectrum)[features.PEAK]
        found.append(Estimate(value.value / frequency, value.error / frequency, value.samples))
        source = "period of free vibration on a Hertz contact, quadrature" if release else "sqrt(2 a E* / M)"
        yield Series(
            features.QUANTITIES[features.PEAK],
            OPEN,
            found[-1:],
            where={RELEASE: release},
            reference=1 / wheel_theory.hertz_period(1 + release) if release else 1.0,
            scale=frequency,
            unit="rad/s",
            family=len(case.releases),
            margin=replace(MARGINS["peak"], source=source),
        )
    yield Series(OVER_EIGEN, "springs", found, along=RELEASE, at=case.releases)
    fine = np.linspace(0.02, 1.15 * max(*case.releases, 0.1), 60)
    exact = [1 / wheel_theory.hertz_period(1 + one) for one in fine]
    yield Series(OVER_EIGEN, "Hertz, quadrature", exact, along=RELEASE, at=fine)
