"""A fit for a rough square punch: the flat punch in series with its rough face, 0.48 h a measured length."""

from dataclasses import replace
from functools import partial
from typing import ClassVar

import numpy as np

from validation.scenes.indentation import IndentationScene
from validation.simulation.calibrated_range import SCATTER, WAVES, beyond_spectrum, conditions_of
from validation.simulation.calibration import calibrated
from validation.simulation.indentation import ground_of
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Model, Target
from validation.theory.closed_forms import rough_punch_stiffness


class FittedRoughPunch(Model):
    """1 / k = 1 / (1.1523 E* L) + 0.48 h / F."""

    name: ClassVar = "fit"
    setting: ClassVar = "flat punch on its rough face"

    def serves(self, scene: object, quantity: str) -> bool:
        rough_punch = isinstance(scene, IndentationScene) and scene.shape == "punch" and scene.ground is not None
        return rough_punch and quantity == "stiffness"

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        return Cost(work=1, unit="formula", seconds=2.0e-5)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        """A measured face is one of many that have its spectrum, and its interface yields as one over the load."""
        ground = ground_of(target.scene)
        if reason := beyond_spectrum(ground):
            return ErrorEstimate.out_of_range(reason)
        expected = calibrated(self, target)
        own = 2 * SCATTER / max(target.scene.reduced_load, 1.0) ** 2 if ground.is_single else 0.0
        return replace(expected, model=expected.model + own)

    def shape(self, target: Target) -> float:
        """Few waves are no mean face: N on a side are N^2 parts, whose mean scatters as 1 / N about a bias."""
        return float(conditions_of(target.scene)[WAVES] ** -0.75)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        scene, height = target.scene, ground_of(target.scene).rms
        formula = partial(
            rough_punch_stiffness, side=scene.size, modulus=scene.modulus, force=scene.load, height=height
        )
        return lambda _: Solve(formula, lambda stiffness: Result({"stiffness": np.array(stiffness)}, 1.0))


MODEL = FittedRoughPunch()
