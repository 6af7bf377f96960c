"""A fit for a rough square punch: the flat punch in series with its rough face, 0.48 h a measured length."""

import math
from functools import partial
from typing import ClassVar

import numpy as np

from validation.scenes.indentation import IndentationScene
from validation.simulation.calibrated_range import (
    FACE,
    LOAD,
    SCATTER,
    WAVES,
    Ranges,
    beyond_spectrum,
    conditions_of,
    counted,
    outside,
)
from validation.simulation.indentation import ground_of
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Model, Target
from validation.theory.closed_forms import rough_punch_stiffness

MEASURED = (
    np.array([-0.7, -0.5, -0.3, -0.15, 0.0, 0.3, 0.5, 0.8, 1.0, 1.5]),
    np.array([0.25, 0.10, 0.07, 0.080, 0.07, 0.055, 0.06, 0.075, 0.06, 0.03]),
)
"""lg Fbar, and the error there, H from 0.3 to 1, beside boundary elements; above, it falls like 1 / Fbar."""
ROLL_OFF = 0.015
"""By which the error grows with each more of the longest waves on a side."""
RANGES: Ranges = {LOAD: (0.2, math.inf), **FACE}


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
        """By the load; a measured face is one of many that have its spectrum."""
        ground, conditions = ground_of(target.scene), conditions_of(target.scene)
        if reason := beyond_spectrum(ground) or outside(conditions, RANGES):
            return ErrorEstimate.out_of_range(reason)
        load, waves = conditions[LOAD], conditions[WAVES]
        power, last = math.log10(load), float(MEASURED[0][-1])
        error = float(np.interp(power, *MEASURED)) * 10 ** min(last - power, 0.0)
        own = 2 * SCATTER / max(load, 1.0) ** 2 if ground.is_single else 0.0
        reason = counted({LOAD: load, WAVES: waves})
        return ErrorEstimate(model=error + ROLL_OFF * max(waves - 1, 0.0) + own, reason=reason)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        scene, height = target.scene, ground_of(target.scene).rms
        formula = partial(
            rough_punch_stiffness, side=scene.size, modulus=scene.modulus, force=scene.load, height=height
        )
        return lambda _: Solve(formula, lambda stiffness: Result({"stiffness": np.array(stiffness)}, 1.0))


MODEL = FittedRoughPunch()
