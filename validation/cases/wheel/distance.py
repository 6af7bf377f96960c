"""Fig. 14.5 and the steady state: what of regions 1, 2 and 4 is the contact, and what is the end of a record."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from validation.analysis.evidence import Place, Role
from validation.analysis.series import MARGINS, Estimates, Margin
from validation.analysis.spectra import band_levels, band_means, one_third_octaves
from validation.analysis.statistics import Estimate, FloatArray, jackknifed, ratio_of_means
from validation.case import SERIAL, Engine, Outcomes, Quantity, Series
from validation.cases.wheel import ensembles
from validation.cases.wheel.ensembles import FIRST, FOURTH, PLATEAU, TABLE, decibels, density_of
from validation.engine.engine import Outcome
from validation.engine.realisations import NotConvergedError
from validation.scenes.rolling import RollingScene
from validation.simulation.wheel_on_springs import TrackKind, WheelEnsemble, simulate_ensemble
from validation.theory.rolling import RollingWheel, acceleration_over_force, break_exponent, over_the_resonance

SHORT = replace(TABLE, distance=0.16)
MIN_JUMP, MIN_PERIODS = 4.0, 5.0
"""q_min v0 over the eigenfrequency, and periods of the oscillation behind it: with less, regions cannot be separated.
"""
SPRINGS, LINEAR = "springs", "linear contact"
PER_GROUP = 4
"""Wheels of a steady state whose mean spectrum is kept."""


class Kind(NamedTuple):
    """A contact, a track, and whether the wheel is damped."""

    model: str
    track: TrackKind
    damped: bool


STEADY, UNDAMPED = Kind(SPRINGS, "steady-state", True), Kind(SPRINGS, "steady-state", False)
PART, FROM_REST = Kind(SPRINGS, "part", True), Kind(SPRINGS, "open", False)
KINDS = tuple(kind._replace(model=model) for kind in (STEADY, UNDAMPED, PART, FROM_REST) for model in (SPRINGS, LINEAR))


@dataclass(frozen=True, kw_only=True)
class WheelDistance:
    """Wheels of one scene on springs over several distances; and in a steady state, beside a linear contact.

    scene; periods: natural periods in the shortest distance, whole; doublings: of it; wheels: to a distance up to the
    middle one, half as many for each doubling beyond, fewest at least; damping: ratio zeta of steady states, beside
    none; steady: wheels of each kind, in groups of four; heights: factors on h_0, ascending, with one among them;
    short: longest wave of a band whose second order has zeros in region 2 [m]; rms: its height [m]; groups: of wheels,
    for errors; seed: zero or more.
    """

    scene: RollingScene = SHORT
    periods: int = 1
    doublings: int = 4
    wheels: int = 60
    fewest: int = 20
    damping: float = 0.02
    steady: int = 40
    heights: tuple[float, ...] = (0.5, 1.0, 2.0)
    short: float = 1e-3
    rms: float = 0.18e-6
    groups: int = 10
    seed: int = 147

    def distances(self) -> dict[tuple[str, int], WheelEnsemble]:
        """Open tracks, each twice as long as the one before: all end in the same phase of free vibration, so that the
        jump at their end is equally large. The longest first, so that no worker is left alone with it.
        """
        counts = [round(self.wheels * 2 ** (self.doublings / 2 - i)) for i in range(self.doublings + 1)]
        counts = [max(self.fewest, min(self.wheels, count)) // self.groups * self.groups for count in counts]
        problems = {}
        for i, count in reversed(list(enumerate(counts))):
            scene = replace(self.scene, distance=self.periods * self.scene.period_length * 2**i)
            problems["distance", i] = WheelEnsemble(scene=scene, count=count, groups=self.groups, seed=self.seed)
        return problems

    def ensemble(self, kind: Kind, height: float = 1.0, short: bool = False) -> WheelEnsemble:
        """A steady state lasts a round; a part of one, and the motion from rest, are recorded over half of it."""
        rail = self.scene.rail
        assert rail is not None  # as checked
        rail = replace(rail, rms=height * rail.rms)
        if short:
            rail = replace(rail, longest=self.short, rms=self.rms)
        damping = self.damping if kind.damped else 0.0
        distance = self.scene.track.distance * (2 if kind.track == "steady-state" else 1)
        return WheelEnsemble(
            scene=replace(self.scene, ground=rail, damping=damping, distance=distance),
            count=self.steady,
            groups=self.steady // PER_GROUP,
            track=kind.track,
            linear=kind.model == LINEAR,
            seed=self.seed,
        )

    def ensembles(self) -> dict[Any, WheelEnsemble]:
        return {
            **self.distances(),
            **{kind: self.ensemble(kind) for kind in KINDS},
            **{(STEADY, h): self.ensemble(STEADY, h) for h in self.heights if h != 1},
            "short waves": self.ensemble(STEADY, short=True),
        }


def run(case: WheelDistance, engine: Engine = SERIAL) -> Outcomes:
    """Simulate all wheels.

    Raises ValueError for a scene without plateau or without region 3, NotConvergedError where most wheels of an
    ensemble do not converge.
    """
    _check_regions(case.scene)
    problems = case.ensembles()
    outcomes = dict(zip(problems, engine.map(simulate_ensemble, list(problems.values())), strict=True))
    failed = [(ensemble, int(outcomes[key]["failed"])) for key, ensemble in problems.items() if outcomes[key]["failed"]]
    unconverged = tuple(
        f"{count} of {ensemble.count} wheels do not repeat their motion, h₀ = {ensemble.scene.rms:.3g} m"
        for ensemble, count in failed
    )
    if any(count > ensemble.count / 2 for ensemble, count in failed):
        raise NotConvergedError("most wheels of an ensemble do not repeat their motion", unconverged)
    return Outcomes(case, outcomes, unconverged)


def _check_regions(scene: RollingScene) -> None:
    """Refuse a scene without a plateau, or with too few periods of the oscillation behind it."""
    if not scene.rail_alone_is_rough:
        raise ValueError("scene must have a rough rail and a smooth wheel")
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


SPECTRA = Quantity("A_by_distance")
BREAK_AT = Quantity("ω_break_rad_s", "ω_break [rad/s]")
DURATION, DISTANCE = "T [s]", "distance [m]"
BREAK_LAW = Quantity("d_ln_ω_break_d_ln_T", "d ln ω_break / d ln T")
SHARE = Quantity("share_of_the_mean_square")
OF_REGION = Quantity("level_of_a_region")
BY_KIND = Quantity("A_by_contact_and_record")
UP_TO_JUMP = Quantity("A_of_regions_1_and_2")
SHORT_WAVES = Quantity("A_over_short_waves")
OVER = Quantity("level_over_the_second_order")
OF_RESONANCE = Quantity("integral_over_the_resonance_m_s²_²", "integral over the resonance [(m/s²)²]")
CONTRAST = Quantity("contrast_of_region_2")
SECOND_ORDER = "second order, closed form"
H_OVER_D, RECORD, DAMPING, MAXIMUM = "h/d", "record", "damping", "maximum of cos²(q a)"
PERIODIC, HANN, CUT = "periodic motion", "steady, Hann's window", "steady, no window"
BOOK = "from rest, no window, undamped"
OF_LAW = Margin(
    0.1,
    "0.1: separates this law from no dependence, 0, and from exponents of 1/2 and more",
    source="1 / (2 H + 1): a floor J² / (ω² T) under a spectrum of ω^(-2H-3)",
)
OF_SHARE = Margin(0.01, "1 %: 20 dB below", source="nothing is left")
OF_SECOND_ORDER = MARGINS["level"].with_source(
    "the closed second order through the damped resonance, no free parameter"
)


class Record(NamedTuple):
    """Whose spectrum, with which window."""

    kind: Kind
    window: str = "plain"

    def of(self, result: Outcomes, band: tuple[float, float], model: str = "") -> FloatArray:
        """The mean of A in a band, wheel by wheel."""
        return ensembles.of_groups(result[self.kind._replace(model=model or self.kind.model)], band, self.window)


RECORDS = {
    PERIODIC: Record(STEADY),
    f"{PERIODIC}, undamped": Record(UNDAMPED),
    HANN: Record(PART, "hann"),
    CUT: Record(PART),
    BOOK: Record(FROM_REST),
}
"""Those without leakage first."""
UNDEFINED = f"{PERIODIC}, undamped", FIRST
"""A resonance of no width, of which lines beside it tell nothing but how far off they are."""
WITHOUT_LEAKAGE = (PERIODIC, f"{PERIODIC}, undamped", HANN)
WIDTH = 2**0.25
"""Over the resonance to both sides: where lines of a periodic motion tell the force that excites it."""


def series(result: Outcomes) -> list[Series]:
    return [*_breaks(result), *_regions(result), *_second_order(result)]


def _breaks(result: Outcomes) -> Iterator[Series]:
    """Fig. 14.5, the break and its law; distances from the shortest on."""
    case, rows = result.case, []
    for key, ensemble in reversed(case.distances().items()):
        scene, outcome, distance = ensemble.scene, result[key], ensemble.steps * ensemble.scene.spacing
        spectrum = ensembles.Spectrum.of(scene, [outcome])
        measured, by_jumps = (
            ensembles.measured(spectrum)[ensembles.BREAK],
            ensembles.expected(spectrum)[ensembles.BREAK],
        )
        low, high = 1.5 * float(outcome["omega"][0]), 1.6 * scene.cutoff
        omega, density = ensembles.in_sixths(outcome["omega"], outcome["plain"].mean(axis=0), low, high)
        spectra = partial(density_of, SPECTRA, where={DISTANCE: round(distance, 3)})
        yield spectra("spectrum", density, at=omega)
        at_break = math.exp(np.interp(np.log(measured.value), np.log(omega), np.log(density)))
        yield spectra("break", (at_break,), at=(measured.value,))
        rows.append((spectrum.duration, by_jumps, measured))
    t, predicted, breaks = zip(*rows, strict=True)
    law = break_exponent(ensembles.hurst(case.scene))
    middle = math.exp(np.mean(np.log(Estimates(breaks).values) - law * np.log(t)))
    by_duration = partial(Series, BREAK_AT, along=DURATION, at=t)
    yield by_duration("found", breaks)
    yield by_duration("by the jumps of the records", predicted)
    yield by_duration("T^(1/(2H+1))", middle * np.array(t) ** law)
    exponent = (law_of_break(np.array(t), Estimates(breaks)),)
    where = {"durations": f"over a factor of {2**case.doublings}"}
    yield Series(BREAK_LAW, SPRINGS, exponent, where=where, reference=law, family=3, margin=OF_LAW)


def law_of_break(t: FloatArray, breaks: Estimates) -> Estimate:
    """d ln omega_break / d ln T by weighted least squares."""
    weights = breaks.values / np.array([point.error for point in breaks])
    (slope, _), covariance = np.polyfit(np.log(t), np.log(breaks.values), 1, w=weights, cov="unscaled")
    return Estimate(float(slope), math.sqrt(covariance[0, 0]), breaks[0].samples)


def _regions(result: Outcomes) -> Iterator[Series]:
    """Spectra and levels of every record; what a linear contact has of regions 1 and 2; what is left of region 4."""
    scene = result.case.scene
    bands = ensembles.regions_of(scene)
    for name, record in RECORDS.items():
        for model in (SPRINGS, LINEAR):
            outcome = result[record.kind._replace(model=model)]
            mean, ends = outcome[record.window].mean(axis=0), (0.5 * scene.eigenfrequency, 4 * scene.cutoff)
            omega, density = ensembles.in_sixths(outcome["omega"], mean, *ends)
            yield density_of(BY_KIND, f"{model}, {name}", density, at=omega)
        for region, band in bands.items():
            if (name, region) == UNDEFINED:
                continue
            for model in (SPRINGS, LINEAR):
                level = Estimates.ratios(record.of(result, band, model), np.ones(1))
                yield decibels(OF_REGION, model, level, where={RECORD: name, "region": region})
    share = partial(Series, SHARE)
    for name in WITHOUT_LEAKAGE:
        record = RECORDS[name]
        for region in (FIRST, PLATEAU):
            if (name, region) == UNDEFINED:
                continue
            linear, of_springs = (record.of(result, bands[region], model) for model in (LINEAR, SPRINGS))
            # of a linear contact that repeats its motion nothing can be elsewhere
            margin = OF_SHARE if name == HANN else replace(OF_SHARE, role=Role.IDENTITY)
            of = {"region": region, RECORD: name}
            yield share(LINEAR, (ratio_of_means(linear, of_springs),), where=of, family=2, margin=margin)
        left = ratio_of_means(record.of(result, bands[FOURTH]), RECORDS[CUT].of(result, bands[FOURTH]))
        of = {"region": FOURTH, RECORD: name}
        yield share(SPRINGS, (left,), where=of, family=len(WITHOUT_LEAKAGE), margin=OF_SHARE)


def theory_of(scene: RollingScene) -> RollingWheel:
    same = ("radius", "modulus", "contact_radius", "mass", "speed", "damping")
    return RollingWheel(**{name: getattr(scene, name) for name in same})


def second_order(scene: RollingScene, omega: FloatArray) -> FloatArray:
    """A of the second order below the jump; zero from there on."""
    density, inside = np.zeros(omega.size), omega < scene.jump
    q_max = scene.cutoff / scene.rolling_speed
    density[inside] = theory_of(scene).acceleration(omega[inside], ensembles.roughness(scene), q_max=q_max)
    return density


def _second_order(result: Outcomes) -> Iterator[Series]:
    """Contrast of region 2 over short waves; regions 1 and 2 by height, 2 without damping too; spectra to the jump."""
    case = result.case
    yield from _contrasts(case.ensemble(STEADY, short=True).scene, result["short waves"])
    steady = [(case.ensemble(STEADY, h), result[STEADY if h == 1 else (STEADY, h)]) for h in case.heights]
    family = 2 * len(steady) + 2
    for ensemble, outcome in steady:
        yield from _resonance(ensemble.scene, outcome, family)
    for ensemble, outcome in (*steady, (case.ensemble(UNDAMPED), result[UNDAMPED])):
        yield from _over_second_order(ensemble.scene, outcome, family)


def _resonance(scene: RollingScene, outcome: Outcome, family: int) -> Iterator[Series]:
    """Region 1, an integral over the resonance: of springs by the force that its lines tell, and in closed form.

    A periodic motion has lines, of which none may be on the resonance: A over the gain of each is the spectrum of the
    force, which is level over the resonance, and its integral is that through the whole of the resonance. The lines are
    those within WIDTH of it, or the two nearest where a record is short.
    """
    omega, same = outcome["omega"], {name: getattr(scene, name) for name in ("eigenfrequency", "mass", "damping")}
    apart = np.abs(np.log(omega / scene.eigenfrequency))
    near = apart <= max(math.log(WIDTH), np.sort(apart)[:2].max())
    force = (outcome["plain"][:, near] / acceleration_over_force(omega[near], **same)).mean(axis=1)
    q_max = scene.cutoff / scene.rolling_speed
    theory = theory_of(scene).over_resonance(ensembles.roughness(scene), q_max=q_max)
    region = {"region": FIRST, DAMPING: _damping_of(scene), **at_height(scene)}
    level = Estimates.ratios(force * over_the_resonance(**same), np.full(1, theory))
    yield decibels(OVER, f"{SPRINGS}, integral", level, where=region, family=family, margin=OF_SECOND_ORDER)
    for model, value in ((SPRINGS, float(force.mean()) * over_the_resonance(**same)), (SECOND_ORDER, theory)):
        yield Series(OF_RESONANCE, model, (value,), where=region)


def _damping_of(scene: RollingScene) -> str:
    return f"{100 * scene.damping:g} % of critical" if scene.damping else "none"


def _over_second_order(scene: RollingScene, outcome: Outcome, family: int) -> Iterator[Series]:
    omega, bands = outcome["omega"], ensembles.regions_of(scene)
    theory, place = second_order(scene, omega), at_height(scene)
    damping = {DAMPING: _damping_of(scene)}
    edges = one_third_octaves(*bands[PLATEAU])
    levels, reference = band_levels(omega, outcome["plain"].T, edges).T, band_levels(omega, theory, edges)
    yield decibels(
        OVER,
        SPRINGS,
        Estimates.ratios(levels, reference),
        where={"region": PLATEAU, **damping, **place},
        along=ensembles.OMEGA,
        at=np.sqrt(edges[1:] * edges[:-1]),
        family=family,
        margin=OF_SECOND_ORDER,
    )
    lines = omega[omega < 0.99 * scene.jump]
    drawn = partial(density_of, UP_TO_JUMP, where={**damping, **place}, at=lines)
    yield drawn(SPRINGS, outcome["plain"].mean(axis=0)[: lines.size])
    yield drawn(SECOND_ORDER, theory[: lines.size])


def at_height(scene: RollingScene) -> dict[str, Place]:
    return {H_OVER_D: round(scene.rms / scene.approach, 4)}


def _contrasts(scene: RollingScene, outcome: Outcome) -> Iterator[Series]:
    """Maxima of cos²(q a) in region 2 over the zeros beside them, of A omega²: a power of the cosine."""
    omega, at, theory = outcome["omega"], maxima_of(scene), second_order(scene, outcome["omega"])

    def contrasts(groups: FloatArray) -> FloatArray:
        return -ensembles.log_beside_over_at(omega / scene.oscillation_period, groups.mean(axis=0) * omega**2, at)

    yield decibels(
        CONTRAST,
        SPRINGS,
        jackknifed(contrasts, outcome["plain"]),
        where=at_height(scene),
        along=MAXIMUM,
        at=at,
        reference=Estimates.exact(contrasts(theory[np.newaxis])),
        margin=MARGINS["contrast"].with_source("the closed second order in the same bands"),
    )
    edges = np.arange(scene.eigenfrequency, 0.99 * scene.jump, scene.oscillation_period / 12)
    for model, density in ((SPRINGS, outcome["plain"].mean(axis=0)), (SECOND_ORDER, theory)):
        means = band_means(omega, density, edges)
        yield density_of(SHORT_WAVES, model, means, at=(edges[1:] + edges[:-1]) / 2)


def maxima_of(scene: RollingScene) -> FloatArray:
    """The numbers n of the maxima q a = n pi of cos²(q a) that have both of their zeros in region 2."""
    last = ensembles.regions_of(scene)[PLATEAU][1]
    return np.arange(1.0, math.floor(last / scene.oscillation_period - 0.5) + 1)
