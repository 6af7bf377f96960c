"""Scenes at the edges of every range in which models claim errors, and beyond: where a claim is most easily false."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from validation.advice.calibration_scenes import QUANTITIES
from validation.advice.cases.random_scenes import EdgeKind, log_uniform
from validation.engine.engine import FloatArray
from validation.engine.realisations import random_generator
from validation.engine.street import objects_of_houses
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.scene import Scene
from validation.simulation.surface import draw_surface
from validation.theory.closed_forms import hertz_force

Generator = np.random.Generator

PUNCH, SPHERE, ROLLING, WHEEL = "punch", "sphere", "rolling", "wheel"
OF_HOUSES: dict[str, EdgeKind] = {kind.name: kind for kind in objects_of_houses("edge_scenes")}
"""Kinds of scenes that other houses have at the edges."""
MEASURED = "measured "
"""Before the name of a body: one surface of points, no two of the same texture after each other."""
EDGE_KINDS = (*(start + body for start in ("", MEASURED) for body in (PUNCH, SPHERE, ROLLING, WHEEL)), *OF_HOUSES)
EDGE_QUANTITIES = {**QUANTITIES, ROLLING: QUANTITIES[ROLLING][::-1]}
LOADS = (-6.0, 2.0)
"""lg of F / (E* h L) of punches."""
HEIGHTS = {SPHERE: (-2.5, 1.0), ROLLING: (-2.5, 0.3), WHEEL: (-2.5, -0.3)}
"""lg of h / d."""
HURSTS = (0.2, 1.2)
WAVES_ON_A_SIDE = (1, 2, 4, 8, 16, 32)
LONGEST = (0.5, 20.0)
"""Longest wave over the contact radius."""
BANDS = (2.0, 12.0)
"""Longest over shortest wave."""
RESONANCES = (0.6, 6.0)
"""Frequency of the longest wave over the resonance; below one there is no steady answer."""
POINTS, TRACK, TO_A_RADIUS = (40, 128), (256, 64), (4, 5, 6, 8, 12)
"""Points along the sides of a measured face, of a measured track, and to a contact radius under a sphere or wheel."""
RANGES = (
    "F / (E* h L) of punches 1e-6 to 100, one to 32 of the longest waves on a side, Hurst exponent 0.2 to 1.2, h/d to "
    "10 under spheres, to 2 under rolling and to 0.5 under dynamic wheels, the longest wave half to 20 contact radii, "
    "and measured heights: Gaussian, ridges, honed, log-normal, outliers, pits"
    + "".join(f"; {kind.ranges}" for kind in OF_HOUSES.values())
)
"""In words."""


def edge_scene(kind: str, number: int, seed: int) -> tuple[Scene, str]:
    """A scene of one of `EDGE_KINDS` and a quantity of it; the same for the same numbers."""
    rng = random_generator(seed, EDGE_KINDS.index(kind), number)
    body, name = kind.removeprefix(MEASURED), f"{kind} {number}"
    if house := OF_HOUSES.get(kind):
        return house.scene(rng, name), house.quantity
    draw_face = TEXTURES[number % len(TEXTURES)] if kind.startswith(MEASURED) else None
    quantity = EDGE_QUANTITIES[body][number // 2 % len(EDGE_QUANTITIES[body])]
    make = _edge_punch if body == PUNCH else _edge_sphere_or_wheel
    return make(rng, body, name, draw_face), quantity


def _edge_punch(rng: Generator, body: str, name: str, draw_face: "Face | None") -> IndentationScene:
    modulus, side = 10 ** rng.uniform(6, 11.5), 10 ** rng.uniform(-4, -1)
    first, height = int(rng.choice(WAVES_ON_A_SIDE)), side * 10 ** rng.uniform(-5, -3)
    # a measured face is pressed where more than a few of its points touch
    load = 10 ** rng.uniform(-3.0 if draw_face else LOADS[0], LOADS[1])
    band = _random_band(rng, height, side / (min(first, 8) if draw_face else first))
    points = int(rng.choice(POINTS))
    ground = _measured_heights(rng, draw_face, band, (points, points), side / points) if draw_face else band
    return IndentationScene(
        name=name, shape="punch", size=side, load=load * modulus * ground.rms * side, modulus=modulus, ground=ground
    )


def _edge_sphere_or_wheel(rng: Generator, body: str, name: str, draw_face: "Face | None") -> Scene:
    modulus, radius = 10 ** rng.uniform(6, 11.5), 10 ** rng.uniform(-3, 0)
    approach = radius * 10 ** rng.uniform(-5, -3.5)
    a = math.sqrt(radius * approach)
    longest = a * log_uniform(rng, LONGEST)
    band = _random_band(rng, approach * 10 ** rng.uniform(*HEIGHTS[body]), longest)
    settings: dict[str, Any] = {"name": name, "modulus": modulus, "ground": band}
    settings["load"] = hertz_force(radius=radius, modulus=modulus, approach=approach)
    if draw_face:
        points = (int(rng.choice(POINTS)),) * 2 if body == SPHERE else TRACK
        settings["ground"] = _measured_heights(rng, draw_face, band, points, a / int(rng.choice(TO_A_RADIUS)))
    if body == SPHERE:
        return IndentationScene(shape="sphere", size=radius, **settings)
    if body == WHEEL:
        mass = 10 ** rng.uniform(0, 3)
        resonance = math.sqrt(2 * a * modulus / mass)
        ground = settings["ground"]
        # so fast at least that a band of waves is left an octave above the resonance
        fast = max(log_uniform(rng, RESONANCES), 3.5 * ground.q_min / ground.q_resolved)
        settings |= {"mass": mass, "speed": fast * resonance / ground.q_min}
    return RollingScene(radius=radius, **settings)


def _random_band(rng: Generator, height: float, longest: float) -> Roughness:
    ratio = log_uniform(rng, BANDS)
    return Roughness(rms=height, hurst=rng.uniform(*HURSTS), longest=longest, shortest=longest / ratio)


# --- measured faces, made from Gaussian heights ---

Face = Callable[[FloatArray, Generator], FloatArray]
"""From Gaussian heights of unit rms to others."""


def _measured_heights(
    rng: Generator, draw_face: Face, band: Roughness, points: tuple[int, int], spacing: float
) -> MeasuredHeights:
    """Waves of the band that the points resolve, in a texture, with the height of the band."""
    first, last = 2 * math.pi / (min(points) * spacing), math.pi / (2 * spacing)
    low = min(max(band.q_min, first), last / 2)
    high = min(max(band.q_max, 2 * low), last)
    exponent = -2 * band.hurst - 2

    def c2d(q: FloatArray) -> FloatArray:
        inside = (np.abs(q) >= low * (1 - 1e-9)) & (np.abs(q) <= high)
        return np.where(inside, (np.where(inside, np.abs(q), low) / low) ** exponent, 0.0)

    gaussian = draw_surface(c2d, shape=points, spacing=spacing, rng=rng)
    height = draw_face(gaussian / gaussian.std(), rng)
    return MeasuredHeights(height=band.rms * height / height.std(), spacing=(spacing, spacing))


def gaussian_face(height: FloatArray, rng: Generator) -> FloatArray:
    return height


def ridges(height: FloatArray, rng: Generator) -> FloatArray:
    """Across the track, and a little of all other waves."""
    return np.asarray(height.mean(axis=1, keepdims=True) / height.mean(axis=1).std() + 0.1 * height)


def honed(height: FloatArray, rng: Generator) -> FloatArray:
    """Plateaus between deep grooves along both diagonals."""
    rows, columns = (np.arange(n) for n in height.shape)
    profile, count = height[:, 0] / height[:, 0].std(), len(height)
    grooves = [profile[(rows[:, np.newaxis] + sign * columns) % count] for sign in (1, -1)]
    return np.asarray(np.minimum(np.minimum(*grooves), 0.3) + 0.05 * height)


def log_normal(height: FloatArray, rng: Generator) -> FloatArray:
    return np.asarray(np.exp(0.8 * height))


def outliers(height: FloatArray, rng: Generator) -> FloatArray:
    """Single points that stand out by five to twenty heights, as dust or errors of a profilometer do."""
    surface = height.copy()
    surface.flat[rng.integers(0, height.size, 6)] += rng.uniform(5, 20, 6)
    return surface


def pits(height: FloatArray, rng: Generator) -> FloatArray:
    """Of four points a side, five to twenty heights deep."""
    surface = height.copy()
    for i, j in rng.integers(0, np.array(height.shape) - 4, (12, 2)).tolist():
        surface[i : i + 4, j : j + 4] -= rng.uniform(5, 20)
    return surface


TEXTURES: tuple[Face, ...] = (gaussian_face, ridges, honed, log_normal, outliers, pits)
