"""What decides how far cheap models are off, and the ranges in which that is known."""

import math
from collections.abc import Mapping

import numpy as np

from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingScene
from validation.scenes.rolling_quantity import RollingQuantity
from validation.scenes.roughness import RoughSurface
from validation.simulation.indentation import ground_of
from validation.theory.rolling import contact_lost

Conditions = Mapping[str, float]
Ranges = Mapping[str, tuple[float, float]]

SLACK = 1e-9
"""By which a scene may lie beyond an end, relative: the rounding of its units."""


def outside(conditions: Conditions, ranges: Ranges) -> str:
    """The first condition beyond the range in which the error was measured, in words; empty where none is.

    A range that a scene has no condition for, as the Hurst exponent of measured heights, says nothing of it.
    """
    for name, (low, high) in ranges.items():
        value = conditions.get(name, low)
        if not low * (1 - SLACK) <= value <= high * (1 + SLACK):
            span = f"from {low:g} on" if math.isinf(high) else f"from {low:g} to {high:g}"
            return f"{name} = {value:.3g}; the error of the model is known {span} only"
    return ""


def counted(conditions: Conditions) -> str:
    """Names with their numbers, for a reason."""
    return ", ".join(f"{name} = {value:.3g}" for name, value in conditions.items())


LOAD, HEIGHT, WAVES, HURST = "F / (E* h L)", "h/d", "longest waves on a side", "Hurst exponent"
LONG, SHORT, RATIO = "q a of the longest wave", "q a of the shortest wave", "longest over shortest wave"
MOVING_LONG = "q a of the longest wave above the resonance"
"""What decides how far cheap models are off, in words."""
CONDITIONS = (LOAD, HEIGHT, WAVES, LONG, MOVING_LONG, RATIO, HURST)
"""Those of the calibration."""
ENVELOPE: Ranges = {HEIGHT: (0, 1), LONG: (0, 2), SHORT: (0, 40), RATIO: (2, 64), HURST: (0.2, 1.2)}
"""Of rolling: drawn scenes were rolled with h/d from 0.003, q a of the longest wave from 0.2 and bands up to a factor
20 wide. Longer waves only move the contact, which linear theory knows; that it holds in wider bands is taken from Table
14.1 alone."""
SPHERE_SHAPE = (1.0, 0.05, 0.005)
"""What the errors of a rough sphere go with, `shape` of the calibration: the contact that is lost, h q a / d with the q
of the longest wave, no rms slope, and what the reference leaves."""
SCATTER = 0.22
"""Relative deviation of the stiffness of one rough punch without roll-off, about: Fig. 14.1."""


def conditions_of(scene: IndentationScene) -> dict[str, float]:
    """What decides how far cheap models are off."""
    ground = ground_of(scene)
    band = {RATIO: ground.q_max / ground.q_min}
    if ground.hurst is not None:
        band[HURST] = ground.hurst
    if scene.shape == "punch":
        return {LOAD: scene.reduced_load, WAVES: ground.q_min * scene.size / (2 * math.pi), **band}
    radius = scene.contact_radius
    return {HEIGHT: scene.roughness_ratio, LONG: ground.q_min * radius, SHORT: ground.q_max * radius, **band}


def rolling_conditions(quantity: RollingQuantity) -> dict[str, float]:
    """The same of a wheel; of a moving one h/d is by its resonance, and the waves are those that count."""
    scene, ground = quantity.scene, quantity.scene.ground
    first, last = (q * scene.contact_radius for q in (ground.q_min, quantity.q_max))
    height = scene.roughness_ratio * quantity.amplification
    longest = {MOVING_LONG: quantity.longest_moving * scene.contact_radius} if quantity.dynamic else {LONG: first}
    conditions = {HEIGHT: height, **longest, SHORT: last, RATIO: last / first}
    return conditions if ground.hurst is None else {**conditions, HURST: ground.hurst}


def beyond_envelope(quantity: RollingQuantity) -> str:
    """Why rules of rolling models do not hold where no error is measured; empty where they do."""
    scene = quantity.scene
    as_given = {LONG: scene.ground.q_min * scene.contact_radius, HEIGHT: scene.roughness_ratio}
    return outside({**rolling_conditions(quantity), **as_given}, ENVELOPE)


def lost_contact(scene: IndentationScene | RollingScene) -> float:
    """Share of the contact of a smooth sphere or wheel that linear theory loses to the roughness."""
    ground = scene.ground
    assert ground is not None  # as asked
    smooth = {"contact_radius": scene.contact_radius, "radius": scene.body.radius}
    return contact_lost(ground.c2d, edges=ground.edges, **smooth)


def sphere_shape(scene: IndentationScene) -> float:
    """What errors of cheap models of a rough sphere go with; one for a punch."""
    if scene.shape == "punch":
        return 1.0
    longest = scene.roughness_ratio * ground_of(scene).q_min * scene.contact_radius
    return float(np.dot(SPHERE_SHAPE, (lost_contact(scene), longest, 1.0)))


def beyond_spectrum(ground: RoughSurface) -> str:
    """Why a model that knows a surface by its spectrum alone is out of range for this one; empty where it is not."""
    beyond = ground.beyond_a_spectrum()
    return f"it knows the spectrum alone, and {beyond[0]}" if beyond else ""
