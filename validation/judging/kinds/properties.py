"""Properties of every model of a kind: rules of scaling, which are exact, and closed forms, which hold at the ends."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

import numpy as np

import mdr
from validation.analysis.statistics import FloatArray, ratio_of_means
from validation.judging.judgement import Conditions
from validation.judging.kinds import rolling, stiffness
from validation.judging.kinds.judge import Answer, Finding, LostError, ModelAnswer, answer_of, attempted, rule
from validation.judging.kinds.references import reference_rows
from validation.judging.kinds.stiffness import FORCE, MEAN, MODULUS, SIDE, H, JudgedPunch
from validation.judging.registry import Caller, Failed
from validation.theory.closed_forms import SQUARE_PUNCH

EXACT, OF_SAMPLE = 1e-6, 2.0
"""Tolerance; of a mean of draws so many half-widths of its 95 % interval, so that chance breaks none of many rules."""
LOADS, WAVES, CELLS, PUNCH = (0.01, 3.0), (1.25, 10.0), 8, "stiffness"
"""Fbar of a punch; q a of a spectrum; cells to a contact radius of a strip; how kinds of punches begin."""
HURSTS, HEIGHTS = (0.7, 0.4, 1.0), (rolling.HEIGHTS[0], rolling.HEIGHTS[-1])


class Powers(NamedTuple):
    """Of E*, of all lengths, and of the heights of a punch with the load that they bear."""

    modulus: int = 0
    length: int = 0
    height: int = 0


LENGTH = Powers(length=1)
OF_ARGUMENTS = dict.fromkeys(("side", "spacing", "contact_radius", "approach", "radius"), LENGTH) | {
    "load": Powers(1, 2, 1),
    "modulus": Powers(modulus=1),
    "height": Powers(length=1, height=1),
    "line": Powers(length=1, height=1),
    "q": Powers(length=-1),
}
OF_ANSWERS = {
    "stiffness_model": Powers(1, 1),
    "stiffness_of_surface": Powers(1, 1),
    "force_spectrum": Powers(2, 5),
    "rolling_model": Powers(1, 2),
}
"""Of the arguments, and of the answers; that of a rolling model under a load is a length."""
RULES = {
    "scaling with the modulus": Powers(3, 1, 1),
    "scaling with the length": Powers(1, 3, 1),
    "scaling with the height": Powers(1, 1, 3),
}
"""Factors; the last of punches alone, whose heights are small beside their side."""


def judged_scaling(model: Caller) -> Iterator[Finding]:
    """At a light and a heavy contact, of spectra for a long and a short wave."""
    if model.kind not in OF_ANSWERS:
        return
    answer = LENGTH if model.kind == "rolling_model" and "load" in model.asks else OF_ANSWERS[model.kind]
    rules = {name: by for name, by in RULES.items() if by.height == 1 or model.kind.startswith(PUNCH)}
    for where, arguments in _places(model):
        before = attempted(_answers, model, arguments)
        for quantity, by in rules.items():
            other = scaled(arguments, by), _factor(answer, by)
            change = before if isinstance(before, Failed) else attempted(_ratio, model, before, *other)
            value, within = (change, None) if isinstance(change, Failed) else change
            yield rule(quantity, where, value, within=within)


def _answers(model: Caller, arguments: Mapping[str, Any]) -> FloatArray:
    """One, or those of the same draws each time. Raises LostError where there is none."""
    values = (
        stiffness.draws(model, arguments, stiffness.FEWEST)
        if "rng" in model.asks
        else np.atleast_1d(answer_of(model, **arguments))
    )
    if model.kind.startswith(PUNCH) and not values[0] > 0:
        raise LostError(Failed(f"a stiffness of {values[0]:.3g} N/m"))
    return values


def _ratio(model: Caller, before: FloatArray, arguments: Mapping[str, Any], factor: float) -> tuple[float, float]:
    """Of means of draws, or of one number; of several one and the rms of what is apart; and how near one it must be."""
    after = _answers(model, arguments) / factor
    if "rng" in model.asks:
        ratio = ratio_of_means(after, before)
        return ratio.value, max(EXACT, OF_SAMPLE * ratio.half_width)
    peak = float(np.abs(before).max()) or 1.0
    deviation, size = (after - before) / peak, float(np.linalg.norm(before / peak)) or 1.0
    return 1 + float(deviation[0] if deviation.size == 1 else np.linalg.norm(deviation)) / size, EXACT


def _places(model: Caller) -> Iterator[tuple[Conditions, dict[str, Any]]]:
    """Conditions, and arguments in SI units."""
    if model.kind == "stiffness_model":
        for hurst, force in product(HURSTS[:1] if "rng" in model.asks else HURSTS, LOADS):
            yield {H: hurst, FORCE: force}, JudgedPunch(hurst, force).arguments
    if model.kind == "stiffness_of_surface":
        surface, spacing = SIDE * stiffness.roughness(HURSTS[0]).surface(stiffness.CELLS, 0), SIDE / stiffness.CELLS
        for force in LOADS:
            arguments = {"height": surface, "spacing": spacing, "modulus": MODULUS, "load": stiffness.load_of(force)}
            yield {FORCE: force}, arguments
    if model.kind == "force_spectrum":
        for height, qa in product(HEIGHTS, WAVES):
            arguments = rolling.over(np.array([qa / rolling.CONTACT]), rolling.ground_of(height))
            yield {rolling.HEIGHT: height, rolling.Q: qa}, arguments
    if model.kind == "rolling_model":
        for height in HEIGHTS:
            yield {rolling.HEIGHT: height}, rolling.on(rolling.strip_of(height).surface(CELLS, 0), CELLS)


def scaled(arguments: Mapping[str, Any], by: Powers) -> dict[str, Any]:
    """The same problem in other units."""
    return {name: _scaled(value, name, by) for name, value in arguments.items()}


def _scaled(value: Any, name: str, by: Powers) -> Any:
    if name == "roughness":
        band = {end: getattr(value, end) / by.length for end in ("q_min", "q_max")}
        return replace(value, rms=value.rms * by.length * by.height, **band)
    factor = _factor(OF_ARGUMENTS[name], by)
    return tuple(factor * part for part in value) if isinstance(value, tuple) else factor * value


def _factor(powers: Powers, by: Powers) -> float:
    return math.prod(float(factor) ** power for factor, power in zip(by, powers, strict=True))


HEAVY, LIGHT, FEW = "under a heavy load", "under a light load", "on few cells"
LONG, SHORT, SMOOTH = "for long waves", "for short waves", "smooth wheel on few cells"
ROUNDING, SPHERE, TRACK = 1e-9, 64, 8
"""Tolerance of a bound; cells on a side below a sphere; contact radii along and across a track."""


def normalised_stiffness(model: Caller, force: float) -> float:
    """k / (E* L)."""
    punch = JudgedPunch(0.7, force)
    answer = stiffness.answers_of(model, [punch], stiffness.FEWEST)[punch]
    if isinstance(answer, Failed):
        raise LostError(answer)
    return answer.mean.value


def left_by_the_heaviest() -> float:
    """How far from flat boundary elements are under the heaviest load that is known."""
    return abs(reference_rows(MEAN, where={H: 0.7})[-1].value / SQUARE_PUNCH - 1)


def below_a_sphere(model: Caller, cells: float) -> float:
    """k = 2 E* a, by Hertz, on a contact of so many cells."""
    spacing, radius = SIDE / SPHERE, 100 * SIDE
    x = (np.arange(SPHERE) - (SPHERE - 1) / 2) * spacing
    height, a = -(x**2 + x[:, np.newaxis] ** 2) / (2 * radius), math.sqrt(cells / math.pi) * spacing
    load = 4 / 3 * MODULUS * a**3 / radius
    return float(answer_of(model, height=height, spacing=spacing, modulus=MODULUS, load=load)) / (2 * MODULUS * a)


def rms_of_long_waves(model: Caller, qa: float) -> float:
    """Waves that are all longer than the contact have 2 E* a times the rms of the heights."""
    last, rms = qa / rolling.CONTACT, 1e-3 * rolling.APPROACH
    ground = mdr.SelfAffine(hurst=0.7, q_min=last / 4, q_max=last, rms=rms)
    q = (np.arange(rolling.FINE) + 0.5) / rolling.FINE * last
    density = answer_of(model, **rolling.over(q, ground))
    variance = 2 * float(density.sum()) * last / rolling.FINE
    return math.sqrt(max(variance, 0.0)) / (2 * rolling.MODULUS * rolling.CONTACT * rms)


def amplitude(model: Caller, qa: float) -> float:
    """One for long waves, up to those of no wavenumber."""
    k = np.full(1, qa / rolling.CONTACT)
    axes = {"a_x": rolling.CONTACT, "a_y": rolling.CONTACT, "approach": rolling.APPROACH, "alpha": 1.0}
    return float(np.abs(answer_of(model, k_x=k, k_y=0 * k, **axes)[0]))


def rolled(model: Caller, cells: float, line: FloatArray) -> FloatArray:
    """Force, or approach, over that of Hertz; line: of ridges, over d."""
    height = rolling.APPROACH * np.broadcast_to(line[:, np.newaxis], (line.size, round(TRACK * cells)))
    spacing, unit = (rolling.CONTACT / cells,) * 2, rolling.FORCE if "approach" in model.asks else rolling.APPROACH
    return answer_of(model, height=height, line=height[:, 0], spacing=spacing, **rolling.SMOOTH_WHEEL) / unit


def followed(model: Caller, length: float) -> float:
    """The wheel follows a wave much longer than the contact; on top of one, the rms of what is apart from Hertz."""
    wave = 0.1 * np.cos(2 * math.pi * np.arange(4 * length) / (4 * length))
    exact = (1 + wave) ** 1.5 if "approach" in model.asks else 1 - wave
    force = rolled(model, 4.0, wave) / float(rolled(model, 4.0, 0 * wave)[0])
    return 1 + float(np.std(force - exact) / np.std(exact))


class ModelSweep(NamedTuple):
    """ratio: of a model at each, over a closed form, or over a bound, which realisations need not keep; left: by the
    form, or the cells."""

    quantity: str
    along: str
    at: Sequence[float]
    ratio: Callable[[Caller, float], float]
    left: float | Callable[[], float] = 0.0
    bound: bool = False


OF_CELLS = "cells in the contact", "cells to a contact radius"
SWEEPS: Mapping[str, Sequence[ModelSweep]] = {
    "stiffness_model": (
        ModelSweep(
            HEAVY,
            FORCE,
            (30, 1e2, 1e3, 1e4),
            lambda m, x: normalised_stiffness(m, x) / SQUARE_PUNCH,
            left_by_the_heaviest,
        ),
        ModelSweep(
            LIGHT,
            FORCE,
            (1e-8, 1e-6, 1e-4),
            lambda m, x: min(normalised_stiffness(m, 2 * x) / normalised_stiffness(m, x), 1.0),
            bound=True,
        ),
    ),
    "stiffness_of_surface": (ModelSweep(FEW, OF_CELLS[0], (3, 10, 30, 100, 300), below_a_sphere),),
    "force_spectrum": (ModelSweep(LONG, "q a", (1e-4, 1e-3, 1e-2), rms_of_long_waves, 1e-2),),
    "contact_filter": (
        ModelSweep(LONG, "q a", (0, 1e-6, 1e-3), amplitude, 1e-3),
        ModelSweep(SHORT, "q a", (1e2, 1e3, 1e4), lambda m, x: 2 - max(amplitude(m, x), 1.0), bound=True),
    ),
    "rolling_model": (
        ModelSweep(
            SMOOTH, OF_CELLS[1], (1, 2, 4, 8, 16), lambda m, x: float(rolled(m, x, np.zeros(round(TRACK * x))).mean())
        ),
        ModelSweep(LONG, "wavelength over a", (32, 128), followed, 1e-2),
    ),
}
"""Of the kinds that can be asked that."""
SWEPT = frozenset(sweep.quantity for sweeps in SWEEPS.values() for sweep in sweeps)


def swept(model: Caller) -> Iterator[Finding]:
    """Each number, and whether the model warned."""
    for sweep in SWEEPS.get(model.kind, ()):
        left = sweep.left() if callable(sweep.left) else sweep.left
        for x in () if sweep.bound and "rng" in model.asks else map(float, sweep.at):
            value: Answer = attempted(sweep.ratio, model, x)
            if model.warned and isinstance(value, float):
                value = ModelAnswer(value, reason=f"it warned: {model.warned}")
            yield rule(sweep.quantity, {sweep.along: x}, value, left, ROUNDING if sweep.bound else None)
