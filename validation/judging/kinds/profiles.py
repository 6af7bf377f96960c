"""A rule for the spectrum of a profile, of others: what it keeps, and springs and wheels with it."""

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import groupby, repeat
from typing import Any

import numpy as np

import mdr
from validation.analysis.statistics import FloatArray
from validation.engine.realisations import random_generator
from validation.judging.kinds.judge import Finding, LostError, answer_of, attempted, rule
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.kinds.rolling import WheelAtApproach, of_density
from validation.judging.kinds.stiffness import DEVIATION, MEAN, UNIT, H, JudgedPunch, beside_punches, sampled
from validation.judging.registry import Caller, Failed
from validation.theory.half_space import on_panels
from validation.theory.rolling import force_spectrum_1d

FIRST, LAST, HEIGHT = 1e3, 64e3, 1e-6
"""Band of the roughness of which a rule must have the properties [rad/m]; rms [m]."""
HURSTS = (0.4, 0.7, 1.0)
MOMENTS = {0: "rms height", 1: "moment 1", 2: "rms gradient", 3: "moment 3", 4: "moment 4"}
ROUNDING, EXACT, QUADRATURE = 1e-9, 1e-6, 1e-4
POINTS, PROFILES, SEED = 2048, 500, 145
"""Of the profiles that springs are pressed on; how many, and their seed."""
NO_PROFILE = "no profile has a spectrum that is negative, or zero"


def judged(model: Caller) -> Iterator[Finding]:
    """Properties; then springs with that spectrum beside Fig. 14.1, and their linear rolling levels."""
    for hurst in HURSTS:
        yield from properties_of_rule(model, hurst, FIRST, LAST, HEIGHT)
    for hurst in HURSTS:
        yield from springs_beside(model, reference_rows(MEAN, DEVIATION, where={H: hurst}))
    yield from of_density(partial(density_of_rule, model))


def springs_beside(model: Caller, rows: Sequence[Reference]) -> Iterator[Finding]:
    """Springs on profiles of that rule under each load, roughness by roughness."""
    for _, grouped in groupby(rows, lambda row: replace(JudgedPunch.at(row.where), force=1.0)):
        group = list(grouped)
        punches = list(dict.fromkeys(JudgedPunch.at(row.where) for row in group))
        pressed = attempted(_stiffness_of_profiles, model, punches)
        answers = repeat(pressed) if isinstance(pressed, Failed) else map(sampled, pressed.T)
        yield from beside_punches(group, dict(zip(punches, answers, strict=False)))


def density_of_rule(model: Caller, q: FloatArray, wheel: WheelAtApproach, ground: mdr.SelfAffine) -> FloatArray:
    """C_F [N^2 m] of springs under a wheel, by linear theory on a profile of that rule."""
    c1d = answer_of(model, q=q, roughness=replace(ground))
    return force_spectrum_1d(q, lambda _: c1d, contact_radius=wheel.contact, modulus=wheel.modulus)


def properties_of_rule(model: Caller, hurst: float, first: float, last: float, height: float) -> Iterator[Finding]:
    """Moments of the surface; not negative; linear in C_2D; scaling with the length. Each a ratio that is one.

    first, last: of the band [rad/m]; height: rms [m].
    """
    ground = mdr.SelfAffine(hurst=hurst, q_min=first, q_max=last, rms=height)
    # below the band a line has waves too
    ends = [*np.linspace(0, first, 5), *np.geomspace(first, last, 25)[1:]]
    q, dq = on_panels(ends, 8)
    level, middle = first ** (-2 * hurst) - last ** (-2 * hurst), math.sqrt(first * last)
    parts = [
        replace(ground, q_min=a, q_max=b, rms=height * math.sqrt((a ** (-2 * hurst) - b ** (-2 * hurst)) / level))
        for a, b in ((first, middle), (middle, last))
    ]
    twice = replace(ground, rms=math.sqrt(2) * height)
    longer = replace(ground, q_min=first / 2, q_max=last / 2, rms=2 * height)
    arguments = [(q, ground), *((q, part) for part in parts), (q, twice), (q / 2, longer)]
    spectra = attempted(lambda: [answer_of(model, q=at, roughness=replace(roughness)) for at, roughness in arguments])
    ratio = partial(rule, where={H: hurst}, grid=QUADRATURE)
    if isinstance(spectra, Failed) or not spectra[0].any():
        yield ratio(MOMENTS[0], answer=spectra if isinstance(spectra, Failed) else Failed(NO_PROFILE))
        return
    spectrum, lower, upper, doubled, scaled = spectra
    for n, name in MOMENTS.items():
        share = float(2 * spectrum * q**n @ dq / (2 * math.pi * ground.c2d(q) * q ** (n + 1) @ dq))
        yield ratio(name, answer=math.sqrt(max(share, 0.0)) if name.startswith("rms") else share)
    least = min(float(spectrum.min() / np.abs(spectrum).max()), 0.0)
    yield ratio("not negative", answer=1 + least, grid=0.0, within=ROUNDING)
    total = float(np.abs(spectrum) @ dq)
    residual = np.abs(spectrum - lower - upper) + np.abs(doubled - 2 * spectrum)
    yield ratio("linear in C_2D", answer=1 + float(residual @ dq) / total)
    residual = np.abs(scaled - 8 * spectrum)
    yield ratio("scaling with the length", answer=1 + float(residual @ dq) / (8 * total), grid=0.0, within=EXACT)


def rms_of_profile(c1d: FloatArray, waves: FloatArray, ground: Any) -> float:
    """On springs: rms of the surface times sqrt(sum C_1D / sum of Geike's C_1D), over the waves of a side.

    A band that begins at the first wave counts it whole, as that of Geike's rule, which has the rms of the surface.
    Raises LostError, which is a ValueError, for a spectrum that is negative, or zero.
    """
    if c1d.min() < 0 or not c1d.any():
        raise LostError(Failed(NO_PROFILE))
    return float(ground.rms * math.sqrt(float(c1d.sum() / mdr.geike(waves, ground.c2d).sum())))


def _stiffness_of_profiles(model: Caller, punches: list[JudgedPunch]) -> FloatArray:
    """k / (E* L), of shape (`PROFILES`, punches): profiles with the spectrum of the model, under each load.

    punches: of one roughness and side. Springs have L_1D = L. Raises LostError for a spectrum that no profile has.
    """
    load, side, modulus, ground = punches[0].arguments.values()
    step, first, last = 2 * math.pi / side, punches[0].first, punches[0].first * punches[0].waves
    waves = step * np.arange(first, last + 1)
    spectrum = answer_of(model, q=waves, roughness=replace(ground))
    rms = rms_of_profile(spectrum, waves, ground)

    def c1d(q: FloatArray) -> FloatArray:
        number = np.rint(np.asarray(q) / step).astype(int)
        return np.where((number >= first) & (number <= last), spectrum[np.clip(number, first, last) - first], 0.0)

    rng = random_generator(SEED, round(1000 * ground.hurst))
    drawn = mdr.rough_profiles(c1d, length=side, points=POINTS, count=PROFILES, rng=rng, rms=rms)
    with warnings.catch_warnings():
        # as in Fig. 14.1, the lightest loads stand on few springs
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        curves = [mdr.load_curve(height, length=side, modulus=modulus) for height in drawn]
        loads = load / punches[0].force * np.array([punch.force for punch in punches])
        return np.array([curve.at_force(loads).stiffness for curve in curves]) / UNIT
