"""Scenes at the edges of all ranges and beyond: whether the answers of model selection hold there."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from operator import itemgetter

import numpy as np

from validation.cases.selection.edge_scenes import edge_scene
from validation.engine.engine import Outcome
from validation.selection.compare import models_of
from validation.selection.hierarchy import select_model, try_to_solve
from validation.selection.scene_model import SceneModel
from validation.simulation.model import GridModel
from validation.simulation.sampling import distance

OTHER_SEED = 1_000_003
"""Added to the seed of the tested models: the reference has surfaces of its own."""
REFERENCE_TOLERANCE = 0.05
DRAWN = 4
"""Times as many scenes as are solved: a sphere with h/d = 10 costs as much as a hundred others."""


@dataclass(frozen=True, kw_only=True)
class EdgeTrial:
    """One scene of `EDGE_KINDS`: one reference, and a selection at each tolerance."""

    kind: str
    number: int
    tolerances: tuple[float, ...]
    seed: int

    @property
    def quantity(self) -> str:
        return edge_scene(self.kind, self.number, self.seed)[1]

    def models(self, tolerance: float, seed: int = 0) -> Sequence[SceneModel]:
        """All models of the scene; seed: added to that of the trial."""
        scene, quantity = edge_scene(self.kind, self.number, self.seed)
        return models_of(scene, quantity, tolerance, self.seed + seed)

    @property
    def reference(self) -> SceneModel:
        """Boundary elements on the finest grid that is offered."""
        models = self.models(REFERENCE_TOLERANCE, OTHER_SEED)
        return [model for model in models if isinstance(model.model, GridModel)][-1]


def edge_trials(kinds: Sequence[str], scenes: int, tolerances: tuple[float, ...], seed: int) -> list[EdgeTrial]:
    """So many of each kind: of those drawn that have a reference, the ones where it costs least."""
    found = []
    for kind in kinds:
        drawn = [EdgeTrial(kind=kind, number=i, tolerances=tolerances, seed=seed) for i in range(DRAWN * scenes)]
        costs = [(trial.reference.cost().seconds, trial) for trial in drawn if trial.reference.estimate().in_range]
        found += [trial for _, trial in sorted(costs, key=itemgetter(0))[:scenes]]
    return found


def solve_edge(trial: EdgeTrial) -> Outcome:
    """A selection at each tolerance beside the reference.

    estimated, true: error of its answer, by itself and beside the reference, NaN where it has none; true is NaN, too,
    of measured heights on the grid of the reference; met: one where the tolerance was met; reference: the error that
    the reference itself leaves; failed: one where it has no answer.
    """
    judge = trial.reference
    reference = try_to_solve(judge)
    truth = np.array([math.nan]) if reference.failed else reference.value
    rows = np.array([_selected(trial, tolerance, judge, truth) for tolerance in trial.tolerances])
    return {
        **dict(zip(("estimated", "true", "met"), rows.T, strict=True)),
        "reference": np.array(math.nan if reference.failed else reference.error),
        "failed": np.array(float(bool(reference.failed))),
    }


def _selected(trial: EdgeTrial, tolerance: float, judge: SceneModel, truth: np.ndarray) -> tuple[float, float, float]:
    selection = select_model(trial.models(tolerance), tolerance)
    best = selection.best
    if best is None or best.answer is None:
        return math.nan, math.nan, 0.0
    same = best.name == judge.name and judge.target.scene.ground.is_single
    true = math.nan if same or not np.isfinite(truth).all() else distance(best.answer.value, truth)
    return best.answer.error, true, float(selection.met)
