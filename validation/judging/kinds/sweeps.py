"""Where a model breaks: it is led past the scenes of its judge, as the methods of the case `limits` are.

References are closed forms, which hold at the ends: the flat punch, Hertz, waves much longer than the contact.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

import mdr
from validation.analysis.statistics import FloatArray
from validation.judging.kinds import rolling
from validation.judging.kinds.judge import Answer, Finding, LostError, ModelAnswer, answer_of, attempted, rule
from validation.judging.kinds.references import reference_rows
from validation.judging.kinds.stiffness import FEWEST, FORCE, MEAN, MODULUS, SIDE, H, JudgedPunch, answers_of
from validation.judging.registry import Caller, Failed
from validation.theory.closed_forms import SQUARE_PUNCH

HEAVY, LIGHT, FEW = "under a heavy load", "under a light load", "on few cells"
LONG, SHORT, SMOOTH = "for long waves", "for short waves", "smooth wheel on few cells"
EXACT, SPHERE, TRACK = 1e-9, 64, 8
"""Tolerance of a bound; cells on a side below a sphere; contact radii along and across a track."""


def stiffness(model: Caller, force: float) -> float:
    """k / (E* L)."""
    punch = JudgedPunch(0.7, force)
    answer = answers_of(model, [punch], FEWEST)[punch]
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


CELLS = "cells in the contact", "cells to a contact radius"
SWEEPS: Mapping[str, Sequence[ModelSweep]] = {
    "stiffness_model": (
        ModelSweep(
            HEAVY, FORCE, (30, 1e2, 1e3, 1e4), lambda m, x: stiffness(m, x) / SQUARE_PUNCH, left_by_the_heaviest
        ),
        ModelSweep(
            LIGHT, FORCE, (1e-8, 1e-6, 1e-4), lambda m, x: min(stiffness(m, 2 * x) / stiffness(m, x), 1.0), bound=True
        ),
    ),
    "stiffness_of_surface": (ModelSweep(FEW, CELLS[0], (3, 10, 30, 100, 300), below_a_sphere),),
    "force_spectrum": (ModelSweep(LONG, "q a", (1e-4, 1e-3, 1e-2), rms_of_long_waves, 1e-2),),
    "contact_filter": (
        ModelSweep(LONG, "q a", (0, 1e-6, 1e-3), amplitude, 1e-3),
        ModelSweep(SHORT, "q a", (1e2, 1e3, 1e4), lambda m, x: 2 - max(amplitude(m, x), 1.0), bound=True),
    ),
    "rolling_model": (
        ModelSweep(
            SMOOTH, CELLS[1], (1, 2, 4, 8, 16), lambda m, x: float(rolled(m, x, np.zeros(round(TRACK * x))).mean())
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
            yield rule(sweep.quantity, {sweep.along: x}, value, left, EXACT if sweep.bound else None)
