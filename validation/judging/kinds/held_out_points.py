"""Held-out points: a model is asked between and beside the scenes of the tables, where it cannot look them up."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from itertools import groupby

import numpy as np

from validation.analysis.statistics import FloatArray
from validation.judging.judgement import LEVEL as DECIBELS
from validation.judging.judgement import RATIO, Conditions
from validation.judging.kinds import filters, profiles, rolling, stiffness, surfaces
from validation.judging.kinds.held_out_solves import (
    FACE_CELLS,
    FACE_HEIGHT,
    FACES,
    OCTAVES,
    SCENES,
    SURFACE,
    HeldOutScene,
    held_out,
)
from validation.judging.kinds.judge import Finding, answer_of, attempted, compared
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.kinds.rolling import GRIDS, HEIGHT, Density
from validation.judging.kinds.stiffness import MEAN, MODULUS, SIDE, JudgedPunch, answers_of, load_of
from validation.judging.registry import Caller, Failed
from validation.railway.problems.rail_strip import strip_bands
from validation.railway.scenes.rail import RailScene
from validation.railway.theory.contact_filters import half_space_filter

BAND = (0.62, 700.0, 23.0, 3e-7)
"""H, first wavenumber [rad/m], the last over the first, and rms height [m] of the roughness of which a rule must have
the properties."""
WHEELS, ALPHAS, OF_LINEAR = ((35.0, 540.0, 0.12), (70.0, 800.0, 1.0)), (0.0, 0.7, 3.0, math.inf), 0.12
"""Load [kN], diameter [mm] and radius of the crown [m]; alpha; and how far boundary elements are from linear theory of
the ellipse at most, in the bands that count, on rails of the roughness of ISO 3095 [dB]."""


def judged(model: Caller) -> Iterator[Finding]:
    """By the kind; a contact law has no scene of its own: its wheels start where no table of them is."""
    if model.kind in JUDGES:
        yield from JUDGES[model.kind](model)


# --- punches ---


def _stiffness(model: Caller) -> Iterator[Finding]:
    """Mean at another H, bandwidth and longest wave."""
    rows = reference_rows(held_out(MEAN))
    yield from stiffness.beside_punches(rows, answers_of(model, [JudgedPunch.at(row.where) for row in rows]))


def _surfaces(model: Caller) -> Iterator[Finding]:
    """Of isotropic and elongated faces."""
    height = {str(face): face for face in FACES}
    for name, rows in groupby(reference_rows(held_out(surfaces.OF_SURFACE)), lambda row: str(row.where[SURFACE])):
        face = FACE_HEIGHT * SIDE * height[name].height(FACE_CELLS)
        for row in rows:
            load = load_of(row[stiffness.FORCE])
            value = model.call(height=face, spacing=SIDE / FACE_CELLS, modulus=MODULUS, load=load)
            yield Finding(row, stiffness.over_unit(value))


# --- wheels ---


def _spectrum(model: Caller) -> Iterator[Finding]:
    return levels(lambda q, wheel, ground: answer_of(model, **rolling.over(q, ground, wheel)))


def levels(density: Density) -> Iterator[Finding]:
    """Octaves and variance of a second and a third wheel over other roughness."""
    for scene in SCENES:
        rows = reference_rows(*map(held_out, (rolling.LEVEL, rolling.RMS)), where=scene.where)
        for height in dict.fromkeys(row[HEIGHT] for row in rows):
            at_height = [row for row in rows if row[HEIGHT] == height]
            yield from compared(at_height, attempted(_levels_of_scene, density, scene, height))


def _levels_of_scene(density: Density, scene: HeldOutScene, height: float) -> FloatArray:
    wheel, ground = scene.wheel, scene.ground(height)
    return rolling.levels_of_density(lambda q: density(q, wheel, ground), wheel, height, scene.settings, OCTAVES)


def _rolling(model: Caller) -> Iterator[Finding]:
    """Position by position along one strip of each, and the mean over it; the third has cells of two lengths."""
    by_load = "approach" not in model.asks
    quantity, mean, unit = (
        (rolling.LIFT, "mean approach", "approach") if by_load else (rolling.EACH, rolling.MEAN, "force")
    )
    for scene in SCENES:
        rows = reference_rows(held_out(quantity), where=scene.where)
        for height in dict.fromkeys(row[HEIGHT] for row in rows):
            at_height = [row for row in rows if row[HEIGHT] == height]
            answer = attempted(_rolled_over_scene, model, scene, height)
            where: Conditions = {**scene.where, HEIGHT: height}
            yield rolling.position_by_position(model, at_height, answer, scene.wheel, where, held_out(""))
            grid = float(np.mean([row.value * row.grid for row in at_height]))
            value = float(np.mean([row.value for row in at_height]))
            row = Reference(where, value, grid=grid / value, unit=RATIO, quantity=held_out(mean))
            if not isinstance(answer, Failed):
                answer = float(rolling.at_centres(answer).mean()) / getattr(scene.wheel, unit)
            yield Finding(row, answer)


def _rolled_over_scene(model: Caller, scene: HeldOutScene, height: float) -> FloatArray:
    surface = scene.surface(height, GRIDS[1])
    return answer_of(model, **rolling.on(surface, GRIDS[1], scene.wheel, scene.lateral))


# --- a rail ---


def _filter(model: Caller) -> Iterator[Finding]:
    """Beside linear theory of the ellipse, which boundary elements have at that roughness up to `OF_LINEAR`."""
    for wheel in WHEELS:
        scene = filters.scene_of(*wheel)
        for alpha in ALPHAS:
            if math.isfinite(alpha) or filters.answers_isotropic(model):
                rows = _linear_references(scene, alpha)
                answers = attempted(filters.in_bands, model, scene, alpha, [i for i, _ in rows])
                yield from compared((row for _, row in rows), answers)


@cache
def _linear_references(scene: RailScene, alpha: float) -> list[tuple[int, Reference]]:
    """Number and reference of the bands that count."""
    axes = scene.contact.semi_axes
    levels = filters.a3(scene, alpha, partial(half_space_filter, semi_axes=axes))
    where = {"wheel": scene.name, filters.ALPHA: "isotropic" if math.isinf(alpha) else alpha}
    waves = np.round(1000 * strip_bands(scene).nominal, 2).tolist()
    lowest = np.minimum.accumulate(levels)
    return [
        (
            i,
            Reference(
                {**where, filters.WAVE: wave},
                float(levels[i]),
                grid=OF_LINEAR,
                unit=DECIBELS,
                quantity=held_out(filters.FILTER),
            ),
        )
        for i, wave in enumerate(waves)
        if lowest[i] > filters.COUNTED
    ]


# --- rules ---


def _rule(model: Caller) -> Iterator[Finding]:
    """Properties of another roughness; springs and levels with it."""
    hurst, first, ratio, height = BAND
    for finding in profiles.properties_of_rule(model, hurst, first, first * ratio, height):
        reference = replace(finding.reference, quantity=held_out(finding.reference.quantity))
        yield finding._replace(reference=reference)
    yield from profiles.springs_beside(model, reference_rows(held_out(MEAN)))
    yield from levels(partial(profiles.density_of_rule, model))


JUDGES: Mapping[str, Callable[[Caller], Iterator[Finding]]] = {
    "stiffness_model": _stiffness,
    "stiffness_of_surface": _surfaces,
    "force_spectrum": _spectrum,
    "rolling_model": _rolling,
    "contact_filter": _filter,
    "profile_spectrum": _rule,
}
