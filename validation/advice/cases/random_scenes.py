"""Scenes drawn at random over wide ranges, for the calibration test of model selection."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from validation.advice.calibration_scenes import QUANTITIES
from validation.engine.realisations import random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.scene import Scene
from validation.theory.closed_forms import hertz_force

Generator = np.random.Generator
KINDS = tuple(QUANTITIES)
RANGES = (
    "Hurst exponent 0.3 to 1, h/d from 0.003 to 1, F / (E* h L) from 0.003 to 30, q a of the longest wave from 0.5 to "
    "2, the shortest three to ten times shorter, of punches up to three of the longest waves on a side"
)
"""In words."""


class EdgeKind(NamedTuple):
    """Scenes of a house at the edges of their ranges. ranges: in words; scene: of random numbers, with a name."""

    name: str
    quantity: str
    ranges: str
    scene: Callable[[Generator, str], Scene]


def log_uniform(rng: Generator, ends: tuple[float, float]) -> float:
    return float(np.exp(rng.uniform(math.log(ends[0]), math.log(ends[1]))))


def random_scene(kind: str, number: int, seed: int) -> IndentationScene | RollingScene:
    """One of `KINDS`, with units, Hurst exponent, band, height and load at random; the same for the same numbers."""
    rng = random_generator(seed, KINDS.index(kind), number)
    modulus = 10 ** rng.uniform(6, 11.5)
    if kind == "punch":
        return _punch(rng, modulus, f"punch {number}")
    radius, approach = 10 ** rng.uniform(-3, 0), 10 ** rng.uniform(-5, -3.5)
    d = approach * radius
    a, load = math.sqrt(radius * d), hertz_force(radius=radius, modulus=modulus, approach=d)
    height = 10 ** rng.uniform(-2.5, 0) * d
    longest = 2 * math.pi * a / 10 ** rng.uniform(-0.3, 0.3)
    ground = Roughness(
        rms=height, hurst=rng.uniform(0.3, 1.0), longest=longest, shortest=longest / 10 ** rng.uniform(0.5, 1.0)
    )
    if kind == "sphere":
        return IndentationScene(
            name=f"sphere {number}", shape="sphere", size=radius, load=load, modulus=modulus, ground=ground
        )
    mass = speed = None
    if kind == "wheel":
        mass = 10 ** rng.uniform(0, 3)
        # the resonance below the longest wave, by a factor of two to five
        eigenfrequency = math.sqrt(2 * a * modulus / mass)
        speed = eigenfrequency * longest / (2 * math.pi) * 10 ** rng.uniform(0.3, 0.7)
    return RollingScene(
        name=f"{kind} {number}", radius=radius, load=load, modulus=modulus, ground=ground, mass=mass, speed=speed
    )


def _punch(rng: Generator, modulus: float, name: str) -> IndentationScene:
    side = 10 ** rng.uniform(-4, -1)
    first, last = int(rng.choice([1, 1, 1, 2, 3])), int(rng.choice([8, 12, 16]))
    height = side * 10 ** rng.uniform(-5, -3)
    return IndentationScene(
        name=name,
        shape="punch",
        size=side,
        load=10 ** rng.uniform(-2.5, 1.5) * modulus * height * side,
        modulus=modulus,
        ground=Roughness(rms=height, hurst=rng.uniform(0.3, 1.0), longest=side / first, shortest=side / last),
    )
