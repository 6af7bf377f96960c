"""Springs under a rough body: MDR with profiles of Geike's spectrum, L_1D = L."""

import math
from dataclasses import replace
from typing import ClassVar

import numpy as np

import mdr
from validation.engine.random_numbers import random_generator
from validation.scenes.indentation import IndentationScene
from validation.simulation.calibrated_range import SCATTER, WAVES, beyond_spectrum, conditions_of, sphere_shape
from validation.simulation.calibration import calibrated
from validation.simulation.indentation import ground_of, side_of
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Model, Target
from validation.simulation.sampling import realisations

PROFILES = 1
"""The spawn key under which profiles draw."""
SPRING = 3.5e-8
"""Seconds that a spring takes in a sort, about."""
SPRINGS_TO_A_WAVE, SPRINGS_TO_A_RADIUS = 8, 100
ROLL_OFF = 0.6
"""By which the error of a punch grows, relative, with each more of the longest waves on a side."""
MOST_SPRINGS, BLOCK = 2**26, 2**22
"""Springs of a profile at the most, which take four gigabytes, and of all that are drawn at once, or one profile."""


class SpringsPressed(Model):
    """The mean of many profiles; of a measured surface, of profiles of its spectrum."""

    name: ClassVar = "springs"
    setting: ClassVar = "profiles of Geike's spectrum"
    element: ClassVar = "springs"
    charted: ClassVar = False
    is_mdr: ClassVar = True

    def serves(self, scene: object, quantity: str) -> bool:
        return isinstance(scene, IndentationScene) and scene.ground is not None and quantity == "stiffness"

    def resolutions(self, target: Target) -> tuple[Resolution, ...]:
        """Springs of a profile: eight to the shortest wave, and a hundred to the contact radius of a smooth sphere."""
        scene, length = target.scene, side_of(target.scene)
        radii = length / scene.contact_radius if scene.shape == "sphere" else 0.0
        waves = length * ground_of(scene).q_max / (2 * math.pi)
        return (
            Resolution(size=max(256, math.ceil(SPRINGS_TO_A_WAVE * waves), math.ceil(SPRINGS_TO_A_RADIUS * radii))),
        )

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        work = profiles(target) * resolution.size
        return Cost(work=work, unit="springs", seconds=1e-3 + SPRING * work)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        """A measured face is one of many that have its spectrum."""
        ground = ground_of(target.scene)
        if reason := beyond_spectrum(ground):
            return ErrorEstimate.out_of_range(reason)
        if resolution.size > MOST_SPRINGS:
            return ErrorEstimate.out_of_range(
                f"a profile needs {resolution.size:.3g} springs, more than {MOST_SPRINGS:.3g}"
            )
        expected = calibrated(self, target)
        if ground.is_single and expected.in_range:
            own = 2 * SCATTER
            reason = f"one surface scatters {own:.0%} about the mean of its spectrum; {expected.reason}"
            expected = replace(expected, model=expected.model + own, reason=reason)
        return replace(expected, sample=target.tolerance / 5)

    def shape(self, target: Target) -> float:
        waves = conditions_of(target.scene).get(WAVES, 1.0)
        return sphere_shape(target.scene) * (1 + ROLL_OFF * (waves - 1))

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        """All profiles are one solve, from one stream of random numbers, in blocks that fit into memory."""
        scene, ground, points = target.scene, ground_of(target.scene), round(resolution.size)
        length, count, block = side_of(scene), profiles(target), max(1, BLOCK // points)
        x = (np.arange(points) + 0.5) * length / points - length / 2
        smooth = mdr.sphere_profile(x, radius=scene.size) if scene.shape == "sphere" else np.zeros(points)

        def run() -> list[np.ndarray]:
            rng = random_generator(target.seed, PROFILES)
            found = []
            for first in range(0, count, block):
                rough = mdr.rough_profiles(
                    lambda q: mdr.geike(q, ground.c2d),
                    length=length,
                    points=points,
                    count=min(block, count - first),
                    rng=rng,
                    rms=ground.rms,
                )
                found.append(mdr.stiffness_under(scene.load, rough - smooth, length=length, modulus=scene.modulus))
            return found

        def read(found: list[np.ndarray]) -> Result:
            stiffness = np.concatenate(found)
            springs = stiffness / (scene.modulus * length / points)
            return Result({target.quantity: stiffness, "in contact": springs}, float(count * points), count)

        return lambda _: Solve(run, read)


def profiles(target: Target) -> int:
    """So many that the sample leaves a fifth of the tolerance."""
    return realisations(SCATTER, target.tolerance / 5, least=50)


MODEL = SpringsPressed()
