"""Solves of the calibration: cheap models of a scene and their reference, fine boundary elements.

They are called by `.ci/calibrate.py`, and stand here so that stored results are keyed by the code that they rest on.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.advice.calibration_scenes import OTHER_SEED, CalibrationScene
from validation.advice.hierarchy import try_to_solve
from validation.advice.scene_model import SceneModel
from validation.engine.engine import Outcome
from validation.simulation.method import distance
from validation.simulation.model import GridModel, Model, Target, models_serving

REFERENCE_TOLERANCE = {"stiffness": 0.06, "force-rms": 0.1, "acceleration-rms": 0.1}
SPECTRUM_TOLERANCE = 0.15
"""Of the references, by their quantity, and of spectra: half of it is left to their samples."""


def reference_answer(point: CalibrationScene) -> Outcome:
    """Of fine boundary elements on surfaces of their own: the reference of cheap models.

    value; reference: the relative error that it leaves; each: the values of the realisations that it is the mean of;
    failed: one where there is no answer.
    """
    tolerance = REFERENCE_TOLERANCE.get(point.quantity, SPECTRUM_TOLERANCE)
    target = point.target(tolerance, OTHER_SEED)
    (judge,) = (model for model in models_serving(point.scene, point.quantity) if isinstance(model, GridModel))
    model = SceneModel(judge, target, judge.resolutions(target)[-1])
    answer = try_to_solve(model)
    solved = [] if answer.failed else model.shared[judge, model.resolution].solved
    return {
        "value": answer.value,
        "reference": np.array(answer.error),
        "each": np.array([result.values[point.quantity].ravel() for result in solved]),
        "failed": np.array(float(bool(answer.failed))),
    }


def measure_errors(point: CalibrationScene) -> Outcome:
    """Distance of each cheap model from fine boundary elements, NaN where one has no answer.

    With all of the reference, see `reference_answer`.
    """
    reference = reference_answer(point)
    truth = reference["value"]
    return {**reference, "error": np.array([_error(model, point.target(), truth) for model in point.cheap])}


@dataclass(frozen=True)
class MeasuredAlone:
    """A model, a scene, and the stored answer of boundary elements, with the error that this leaves."""

    model: str
    point: CalibrationScene
    truth: tuple[float, ...]
    reference: float


def measure_alone(alone: MeasuredAlone) -> Outcome:
    """The error of one model, as `measure_errors` computes it, NaN for all other models."""
    point, truth = alone.point, np.array(alone.truth)
    errors = [_error(model, point.target(), truth) if model.name == alone.model else math.nan for model in point.cheap]
    return {"error": np.array(errors), "reference": np.array(alone.reference), "failed": np.array(0.0)}


def _error(model: Model, target: Target, truth: NDArray[np.float64]) -> float:
    answer = try_to_solve(SceneModel(model, target, model.resolutions(target)[-1]))
    return math.nan if answer.failed or not np.isfinite(truth).all() else distance(answer.value, truth)
