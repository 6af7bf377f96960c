"""A smooth sphere or square punch in closed form; the roughness of a sphere is the error."""

from typing import ClassVar

import numpy as np

from validation.scenes.indentation import IndentationScene
from validation.simulation.calibrated_range import (
    BALL,
    HEIGHT,
    SPHERE_FLOOR,
    beyond_spectrum,
    conditions_of,
    counted,
    outside,
)
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Model, Target

ROUGH_SPHERE = 0.32
"""Error over h/d, beside boundary elements."""


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
        scene = target.scene
        if scene.ground is None:
            return ErrorEstimate(reason="exact for a smooth body")
        if reason := beyond_spectrum(scene.ground) or outside(conditions_of(scene), BALL):
            return ErrorEstimate.out_of_range(reason)
        ratio = scene.roughness_ratio
        return ErrorEstimate(model=ROUGH_SPHERE * ratio + SPHERE_FLOOR, reason=counted({HEIGHT: ratio}))

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        return lambda _: Solve(
            lambda: target.scene.stiffness, lambda found: Result({"stiffness": np.array(found)}, 1.0)
        )


MODEL = SmoothBodyClosedForm()
