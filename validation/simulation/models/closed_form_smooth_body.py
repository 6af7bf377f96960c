"""A smooth sphere or square punch in closed form; the roughness of a sphere is the error."""

from typing import ClassVar

import numpy as np

from validation.scenes.indentation import IndentationScene
from validation.simulation.calibrated_range import beyond_spectrum, sphere_shape
from validation.simulation.calibration import calibrated
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Model, Target


class SmoothBodyClosedForm(Model):
    """k = 2 E* a of a sphere, 1.1523 E* L of a square punch."""

    name: ClassVar = "closed form"
    setting: ClassVar = "smooth body"

    def serves(self, scene: object, quantity: str) -> bool:
        body = isinstance(scene, IndentationScene) and (scene.shape == "sphere" or scene.ground is None)
        return body and quantity == "stiffness"

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        return Cost(work=1, unit="formula", seconds=2.0e-5)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        ground = target.scene.ground
        if ground is None:
            return ErrorEstimate(reason="exact for a smooth body")
        reason = beyond_spectrum(ground)
        return ErrorEstimate.out_of_range(reason) if reason else calibrated(self, target)

    def shape(self, target: Target) -> float:
        return sphere_shape(target.scene)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        return lambda _: Solve(
            lambda: target.scene.stiffness, lambda found: Result({"stiffness": np.array(found)}, 1.0)
        )


MODEL = SmoothBodyClosedForm()
