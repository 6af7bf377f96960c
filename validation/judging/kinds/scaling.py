"""Rules of scaling, which are exact: in which units E*, lengths and heights are counted is no part of a model."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from validation.analysis.statistics import FloatArray, ratio_of_means
from validation.judging.judgement import Conditions
from validation.judging.kinds import rolling, surfaces
from validation.judging.kinds.judge import Finding, LostError, answer_of, attempted, rule
from validation.judging.kinds.stiffness import FEWEST, FORCE, MODULUS, SIDE, H, JudgedPunch, draws, load_of
from validation.judging.registry import Caller, Failed

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


def judged(model: Caller) -> Iterator[Finding]:
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
    values = draws(model, arguments, FEWEST) if "rng" in model.asks else np.atleast_1d(answer_of(model, **arguments))
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
        surface, spacing = SIDE * surfaces.roughness(HURSTS[0]).surface(surfaces.CELLS, 0), SIDE / surfaces.CELLS
        for force in LOADS:
            arguments = {"height": surface, "spacing": spacing, "modulus": MODULUS, "load": load_of(force)}
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
