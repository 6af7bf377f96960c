"""Comparisons of the bundled scenes with answers that are made up: all kinds of text and files, without a solve."""

from functools import cache
from itertools import cycle

import numpy as np

import validation
from validation.scenes.rail import RailScene
from validation.selection.compare import Comparison
from validation.selection.hierarchy import Candidate, Selection
from validation.selection.quantities import LEVELS, models_of
from validation.selection.scene_model import Answer
from validation.selection.tolerance import tolerance_of
from validation.simulation.rolling_quantity import RollingQuantity

REASON = "a reason " * 20
PARTS = ("model", "grid", "sample")


def planted(name, quantity, tolerance="10%", *, statuses=("not needed", "accepted", "out of range"), error=0.0512):
    """All models were solved, with statuses in turn; those out of range without an error."""
    scene, wanted, candidates = validation.load_scene(name), tolerance_of(tolerance), []
    values = _values(scene, quantity)
    for i, (model, estimate, cost) in enumerate(models_with_estimates(name, quantity)):
        status = next(found for j, found in enumerate(cycle(statuses)) if j == i)
        left = np.inf if status == "out of range" else error
        bands = {part: np.full(values.size, left) for part in PARTS} if isinstance(scene, RailScene) else {}
        answer = Answer(value=values * 1.1**i, cost=cost, model=left, reason=REASON, band_errors=bands)
        candidates.append(Candidate(model, status, REASON, estimate, answer))
    return Comparison(scene, quantity, Selection(wanted.relative, tuple(candidates)), wanted.in_decibels)


@cache
def models_with_estimates(name, quantity):
    """Those of a wheel on a rail compute filters for each."""
    models = models_of(validation.load_scene(name), quantity, 0.1, 0)
    return [(model, model.estimate(), model.cost()) for model in models]


def _values(scene, quantity):
    if quantity not in LEVELS:
        return np.array([5.4e7])
    rail = isinstance(scene, RailScene)
    count = len(scene.levels.bands) if rail else RollingQuantity(scene, quantity).bands.centres.size
    return np.logspace(-3, 3, count)
