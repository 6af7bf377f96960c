"""A rule for the spectrum of a profile, and a contact law of a wheel with a mass, of others."""

import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

import mdr
from validation.analysis import spectral_features as regions
from validation.analysis.judgement import (
    FAILED,
    JudgedPoint,
    compared,
    compared_deviations,
    compared_levels,
    not_compared,
)
from validation.analysis.multilevel import moments
from validation.analysis.spectra import band_means, record_spectra
from validation.analysis.statistics import POWER_DECIBEL, FloatArray, jackknifed
from validation.engine.offered import Caller, Failed
from validation.engine.random_numbers import random_generator
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.selection.judging.references import Reference, curve
from validation.selection.judging.spectra import CONTACT, MODULUS, judged_density, unanswered
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_springs import band_edges
from validation.theory.gauss_legendre import on_panels
from validation.theory.rolling import force_spectrum_1d

FIRST, LAST, HEIGHT = 1e3, 64e3, 1e-6
"""Band of the roughness of which a rule must have the properties [rad/m]; rms [m]."""
HURSTS = (0.4, 0.7, 1.0)
MOMENTS = {0: "rms height", 1: "moment 1", 2: "rms gradient", 3: "moment 3", 4: "moment 4"}
ROUNDING = 1e-9
QUADRATURE = 1e-4
SIDE, OVER_SIDE, WAVES, POINTS, PROFILES, SEED = 1e-2, 1e-3, 64, 2048, 500, 145
"""Of the profiles that springs are pressed on: L [m], h / L, q_max / q_min; how many, and their seed."""
STIFFNESS, DEVIATION = "mean stiffness", "deviation of the stiffness"
FEATURE, REGION = "feature of the wheel", "level of the acceleration"
WHEELS, APART, DOUBLINGS, HALVINGS = 20, 10.0, 12, 60
"""Wheels that roll, metres from one to the next; steps of the search for the load."""
AT_REST = 1e-6
"""Change of the force along the track, over the load, that is none."""


def judged_profile_spectrum(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Properties; then springs with that spectrum beside Fig. 14.1, and their linear rolling levels."""
    for hurst in HURSTS:
        ground = mdr.SelfAffine(hurst=hurst, q_min=FIRST, q_max=LAST, rms=HEIGHT)
        yield from properties_of_rule(model, ground, tolerance)
    for hurst in HURSTS:
        yield from _springs(model, hurst, tolerance)

    def density(q: FloatArray, ground: mdr.SelfAffine) -> FloatArray | Failed:
        found = model.call(q=q, roughness=ground)
        if isinstance(found, Failed):
            return found
        return force_spectrum_1d(q, lambda _: found, contact_radius=CONTACT, modulus=MODULUS)

    yield from judged_density(density, tolerance)


def properties_of_rule(model: Caller, whole: mdr.SelfAffine, tolerance: float) -> Iterator[JudgedPoint]:
    """Moments of the surface; not negative; linear in C_2D; scaling with the length. Each a ratio that is one."""
    hurst, first, last, height = whole.hurst, whole.q_min, whole.q_max, whole.rms
    # below the band a line has waves too
    ends = [*np.linspace(0, first, 5), *np.geomspace(first, last, 25)[1:]]
    q, dq = on_panels(ends, 8)
    level, middle = first ** (-2 * hurst) - last ** (-2 * hurst), math.sqrt(first * last)
    parts = [
        replace(whole, q_min=a, q_max=b, rms=height * math.sqrt((a ** (-2 * hurst) - b ** (-2 * hurst)) / level))
        for a, b in ((first, middle), (middle, last))
    ]
    twice = replace(whole, rms=math.sqrt(2) * height)
    longer = replace(whole, q_min=first / 2, q_max=last / 2, rms=2 * height)
    asked = [(q, whole), *((q, part) for part in parts), (q, twice), (q / 2, longer)]
    found = [model.call(q=at, roughness=one) for at, one in asked]
    where = {"H": hurst}
    if lost := next((one for one in found if isinstance(one, Failed)), None):
        yield unanswered(MOMENTS[0], where, lost, 1.0)
        return
    mine, lower, upper, doubled, scaled = (np.asarray(one) for one in found)
    judge = partial(compared, where=where, reference=1.0, half_width=QUADRATURE, tolerance=tolerance)
    for n, name in MOMENTS.items():
        share = float(2 * mine * q**n @ dq / (2 * math.pi * whole.c2d(q) * q ** (n + 1) @ dq))
        yield judge(name, value=math.sqrt(max(share, 0.0)) if name.startswith("rms") else share)
    yield compared("not negative", where, 1 + min(float(mine.min() / np.abs(mine).max()), 0.0), 1.0, 0.0, ROUNDING)
    total = float(np.abs(mine) @ dq)
    apart = np.abs(mine - lower - upper) + np.abs(doubled - 2 * mine)
    yield judge("linear in C_2D", value=1 + float(apart @ dq) / total)
    yield judge("scaling with the length", value=1 + float(np.abs(scaled - 8 * mine) @ dq) / (8 * total))


def _springs(model: Caller, hurst: float, tolerance: float) -> Iterator[JudgedPoint]:
    """Mean and deviation of the stiffness of springs under profiles of that spectrum, L_1D = L."""
    rows = {name: [one for one in curve(name) if one.where["H"] == hurst] for name in (STIFFNESS, DEVIATION)}
    found = _pressed(model, hurst, np.array([one.where["Fbar"] for one in rows[STIFFNESS]]))
    for i, known in enumerate(rows[STIFFNESS]):
        deviation = rows[DEVIATION][i]
        if isinstance(found, Failed):
            for one, name in ((known, STIFFNESS), (deviation, DEVIATION)):
                yield unanswered(name, one.where, found, one.value)
            continue
        of = moments(found[:, i], np.isfinite(found[:, i]))
        yield compared(
            STIFFNESS, known.where, of.mean.value, known.value, _both(known, of.log_mean.half_width), tolerance
        )
        log = of.log_relative_deviation
        half = _both(deviation, log.half_width if math.isfinite(log.value) else 0.0)
        yield compared_deviations(DEVIATION, deviation.where, math.exp(log.value), deviation.value, half, tolerance)


def _both(known: Reference, half: float) -> float:
    return known.grid + math.hypot(known.sample, half)


def _pressed(model: Caller, hurst: float, forces: FloatArray) -> FloatArray | Failed:
    """k / (E* L) of each profile under each Fbar."""
    first = 2 * math.pi / SIDE
    ground = mdr.SelfAffine(hurst=hurst, q_min=first, q_max=WAVES * first, rms=OVER_SIDE * SIDE)
    waves = first * np.arange(1, WAVES + 1)
    found = model.call(q=waves, roughness=ground)
    if isinstance(found, Failed):
        return found
    if found.min() < 0 or not found.any():
        return Failed("no profile has a spectrum that is negative, or zero")

    def c1d(q: FloatArray) -> FloatArray:
        number = np.rint(np.asarray(q) / first).astype(int)
        inside = (number >= 1) & (number <= WAVES)
        return np.where(inside, found[np.clip(number, 1, WAVES) - 1], 0.0)

    # a band that begins at the first wave counts it whole, as that of Geike's rule, which has the rms of the surface
    rms = ground.rms * math.sqrt(float(found.sum() / ground.c1d(waves).sum()))
    drawn = mdr.rough_profiles(
        c1d, length=SIDE, points=POINTS, count=PROFILES, rng=random_generator(SEED, round(1000 * hurst)), rms=rms
    )
    load = forces * ground.rms * SIDE
    with warnings.catch_warnings():
        # as in Fig. 14.1, the lightest loads stand on few springs
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        pressed = [mdr.load_curve(height, length=SIDE, modulus=1.0).at_force(load).stiffness for height in drawn]
    return np.array(pressed) / SIDE


class _LostError(ArithmeticError):
    """A contact law has no answer."""


@dataclass(frozen=True)
class _Law:
    """The contact of several wheels with their own places on one track; each begins APART from the last."""

    model: Caller
    scene: WheelScene

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        position = APART * np.arange(WHEELS) + place * self.scene.spacing
        found = self.model.call(approach=approach, position=position)
        if isinstance(found, Failed):
            raise _LostError(found.reason)
        return found

    def at_rest(self, place: int) -> FloatArray:
        """By halves, between approaches at which it bears less and more."""
        low, high = (np.full(WHEELS, sign * self.scene.approach) for sign in (-1.0, 1.0))
        for _ in range(DOUBLINGS):
            high = np.where(self.force(place, high) < self.scene.load, 2 * high, high)
            low = np.where(self.force(place, low) > self.scene.load, 2 * low, low)
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            heavy = self.force(place, middle) > self.scene.load
            low, high = np.where(heavy, low, middle), np.where(heavy, middle, high)
        return np.asarray((low + high) / 2)


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """The wheel of Table 14.1 on that law: features of its spectrum, and levels of its regions, beside springs."""
    # half as many cells as the case has, which are five to the shortest wave
    scene = replace(table := load_wheel_scene("table_14_1"), springs=table.springs // 2)
    features, levels, law = curve(FEATURE), curve(REGION), _Law(model, scene)
    try:
        start = law.at_rest(0)
        if all(np.allclose(law.force(place, start), scene.load, rtol=AT_REST) for place in range(0, 1000, 50)):
            raise _LostError("the wheel stays at rest: the force does not change with the position")
        motion = simulate(scene.body, law, time_step=scene.time_step, steps=scene.points, approach=start)
    except (_LostError, ValueError) as error:
        for quantity, rows, unit in ((FEATURE, features, "-"), (REGION, levels, "dB")):
            for one in rows:
                yield not_compared(quantity, one.where, FAILED, str(error), reference=one.value, unit=unit)
        return
    plain, hann = (record_spectra(motion.acceleration, time_step=motion.time_step, window=w) for w in ("none", "hann"))
    edges = band_edges(plain.omega)
    bands = band_means(plain.omega, plain.density, edges)

    def of(kept: FloatArray) -> FloatArray:
        some = kept.astype(int)
        of_features = features_of(scene, hann.omega, hann.density[:, some].mean(axis=1))
        return np.array([*of_features.values(), *region_levels(scene, edges, bands[:, some].mean(axis=1)).values()])

    found = jackknifed(of, np.arange(float(WHEELS)))
    for one, mine in zip((*features, *levels), found, strict=True):
        quantity, judge, unit = (FEATURE, compared, "-") if "feature" in one.where else (REGION, compared_levels, "dB")
        if not math.isfinite(mine.value):
            reason = "the spectrum does not show it"
            yield not_compared(quantity, one.where, FAILED, reason, reference=one.value, unit=unit)
            continue
        half = _both(one, mine.half_width / (abs(mine.value) if unit == "-" else 1.0))
        yield judge(quantity, one.where, mine.value, one.value, half, tolerance)


def features_of(scene: WheelScene, omega: FloatArray, hann: FloatArray) -> dict[str, float]:
    """As the case finds them, in a scene whose jump is apart from its peak."""
    between, period = math.sqrt(scene.eigenfrequency * scene.jump), scene.oscillation_period
    jump = regions.jump(omega, hann, between, 0.5 * scene.cutoff)
    first, last = max(1.1 * jump, 3 * scene.eigenfrequency), 0.9 * scene.cutoff
    return {
        "peak ω_eigen": regions.peak(omega, hann, between),
        "jump": jump,
        "slope of region 3": regions.slope(omega, hann, first, last, period),
        "period of the oscillation": regions.oscillation_period(omega, hann, first, 0.5 * scene.cutoff, 3),
    }


def region_levels(scene: WheelScene, edges: FloatArray, means: FloatArray) -> dict[str, float]:
    """The mean level of A in twelfths of octaves in each region [dB re 1 (m/s^2)^2 s]."""
    centres = np.sqrt(edges[1:] * edges[:-1])
    return {
        name: float(np.nanmean(POWER_DECIBEL * np.log(means[(centres > first) & (centres < last)])))
        for name, (first, last) in ends_of(scene).items()
    }


def ends_of(scene: WheelScene) -> dict[str, tuple[float, float]]:
    """Of the regions of Fig. 14.4, clear of peak, jump and end [rad/s]."""
    peak, jump, end = scene.eigenfrequency, scene.jump, scene.cutoff
    return {
        "region 1": (peak / 2, 2 * peak),
        "region 2": (2 * peak, 0.8 * jump),
        "region 3": (1.1 * jump, 0.9 * end),
        "region 4": (1.3 * end, 2 * end),
    }
