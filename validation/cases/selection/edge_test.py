"""Scenes at the edges of all ranges and beyond: whether the answers of model selection hold there."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from operator import itemgetter

import numpy as np

from validation.cases.selection.edge_scenes import MEASURED, PUNCH, RAIL, ROLLING, SPHERE, WHEEL, edge_scene
from validation.engine.engine import Outcome
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.scenes.measured import MeasuredHeights
from validation.selection.hierarchy import select_model, try_to_solve
from validation.selection.quantities import models_of
from validation.selection.scene_model import SceneModel, Shared
from validation.simulation.model import GridModel
from validation.simulation.rail_models import relative
from validation.simulation.rail_quantity import COUNTED
from validation.simulation.sampling import distance

OTHER_SEED = 1_000_003
"""Added to the seed of the tested models: the reference has surfaces of its own."""
REFERENCE_TOLERANCE = 0.05
FACES, TRACKS = (MEASURED + PUNCH, MEASURED + SPHERE), (MEASURED + ROLLING, MEASURED + WHEEL)
PARTS = 4
"""Of a measured point along each side."""
DRAWN = 4
"""Times as many scenes as are solved: a sphere with h/d = 10 costs as much as a hundred others."""
ROLLED = (ROLLING, WHEEL, *TRACKS, RAIL)
"""Asked for nothing finer than the tolerance of their references: that would cost several times as much."""


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

    @property
    def scene(self) -> Scene:
        return edge_scene(self.kind, self.number, self.seed)[0]

    def models(self, tolerance: float) -> Sequence[SceneModel]:
        """All models of the scene."""
        return models_of(self.scene, self.quantity, tolerance, self.seed)

    def sharing(self, tolerance: float, solved: Shared) -> Sequence[SceneModel]:
        """The same, whose grids have what was solved on them at other tolerances: the same realisations."""
        return [
            replace(model, shared=solved) if model.kind == GridModel.name else model for model in self.models(tolerance)
        ]

    @property
    def reference(self) -> SceneModel:
        """Boundary elements on the finest grid that is offered; of measured faces with their points split."""
        scene = split(self.scene) if self.kind in FACES else self.scene
        models = models_of(scene, self.quantity, REFERENCE_TOLERANCE, self.seed + OTHER_SEED)
        return [model for model in models if model.kind == GridModel.name][-1]

    @property
    def offered(self) -> SceneModel:
        """Boundary elements on the finest grid of the scene itself."""
        return [model for model in self.models(REFERENCE_TOLERANCE) if model.kind == GridModel.name][-1]

    @property
    def is_own_reference(self) -> bool:
        """Whether boundary elements on the finest grid are the reference itself: no seed draws a track anew."""
        return self.kind in TRACKS


def split(scene: Scene) -> IndentationScene:
    """Each point of a measured face in parts of its height, in other ones than those that its error is claimed by."""
    assert isinstance(scene, IndentationScene) and isinstance(scene.ground, MeasuredHeights)  # of `FACES`
    height = np.asarray(np.kron(scene.ground.height, np.ones((PARTS, PARTS))), dtype=np.float64)
    along, across = scene.ground.spacing
    return replace(scene, ground=MeasuredHeights(height=height, spacing=(along / PARTS, across / PARTS)))


def edge_trials(scenes: Sequence[tuple[str, int]], tolerances: tuple[float, ...], seed: int) -> list[EdgeTrial]:
    """scenes: how many of each kind: of those drawn that have a reference, the ones where it costs least."""
    return [trial for kind, count in scenes for trial in _cheapest(kind, count, _asked(kind, tolerances), seed)]


def _asked(kind: str, tolerances: tuple[float, ...]) -> tuple[float, ...]:
    coarse = tuple(tolerance for tolerance in tolerances if tolerance >= REFERENCE_TOLERANCE)
    return coarse if kind in ROLLED else tolerances


@cache
def _cheapest(kind: str, count: int, tolerances: tuple[float, ...], seed: int) -> tuple[EdgeTrial, ...]:
    """Which they are takes seconds: kept."""
    drawn = [EdgeTrial(kind=kind, number=i, tolerances=tolerances, seed=seed) for i in range(DRAWN * count)]
    costs = [(trial.reference.cost().seconds, trial) for trial in drawn if trial.reference.estimate().in_range]
    return tuple(trial for _, trial in sorted(costs, key=itemgetter(0))[:count])


def solve_edge(trial: EdgeTrial) -> Outcome:
    """A selection at each tolerance beside the reference.

    offered: the error of the finest boundary elements that the scene is offered, infinite where these have no answer;
    estimated, true: error of its answer, by itself and beside the reference, NaN where it has none; true is NaN, too,
    of measured tracks on the grid of the reference; met: one where the tolerance was met; reference: the error that
    the reference itself leaves; failed: one where it has no answer.
    """
    solved: Shared = {}
    judge = replace(trial.reference, shared=solved) if trial.is_own_reference else trial.reference
    reference = try_to_solve(judge)
    truth = np.array([math.nan]) if reference.failed else reference.value
    rows = np.array([_selected(trial, tolerance, solved, truth) for tolerance in trial.tolerances])
    return {
        **dict(zip(("estimated", "true", "met"), rows.T, strict=True)),
        "reference": np.array(math.nan if reference.failed else reference.error),
        "offered": np.array(try_to_solve(trial.offered).error if trial.kind in FACES else reference.error),
        "failed": np.array(float(bool(reference.failed))),
    }


def true_error(trial: EdgeTrial, value: np.ndarray, truth: np.ndarray) -> float:
    """How far an answer is off, as its model claims it: on a rail in the worst of the bands that count, else in all.

    NaN where none counts.
    """
    if trial.kind != RAIL:
        return distance(value, truth)
    counted = 20 * np.log10(truth) > COUNTED
    return relative(float(np.abs(20 * np.log10(value / truth))[counted].max())) if counted.any() else math.nan


def _selected(trial: EdgeTrial, tolerance: float, solved: Shared, truth: np.ndarray) -> tuple[float, float, float]:
    selection = select_model(trial.sharing(tolerance, solved), tolerance)
    best = selection.best
    if best is None or best.answer is None:
        return math.nan, math.nan, 0.0
    same = trial.is_own_reference and best.name == trial.reference.name
    true = math.nan if same or not np.isfinite(truth).all() else true_error(trial, best.answer.value, truth)
    return best.answer.error, true, float(selection.met)
