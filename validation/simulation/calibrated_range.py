"""Where the errors that models claim were measured: outside of it a model is out of range."""

import math
from collections.abc import Mapping

from validation.scenes.indentation import IndentationScene
from validation.scenes.roughness import RoughSurface
from validation.simulation.indentation import ground_of

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
"""What decides how far cheap models are off, in words."""
FACE: Ranges = {WAVES: (1, 5), RATIO: (3, 64), HURST: (0.2, 1.2)}
BALL: Ranges = {HEIGHT: (0, 1), LONG: (0, 2), SHORT: (0, 20), RATIO: (2, 20), HURST: (0.2, 1.2)}
"""Rough punches and spheres for which errors are known: drawn ones were pressed with bands up to a factor 32 wide,
those of Fig. 14.1 up to 64, and spheres with h/d from 0.003 and q a of the longest wave from 0.1. Under high loads
both are flat punches, whose stiffness is known; waves much longer than the contact of a sphere only move it."""
SCATTER = 0.22
"""Relative deviation of the stiffness of one rough punch without roll-off, about: Fig. 14.1."""
SPHERE_FLOOR = 0.01
"""Error that the finest grid leaves beside which models of rough spheres were measured."""


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


def beyond_spectrum(ground: RoughSurface) -> str:
    """Why a model that knows a surface by its spectrum alone is out of range for this one; empty where it is not."""
    beyond = ground.beyond_a_spectrum()
    return f"knows the spectrum alone, and {beyond[0]}" if beyond else ""
