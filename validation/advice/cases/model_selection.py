"""Calibration test of model selection: random scenes, and scenes at the edges of all ranges and beyond.

Each is solved by selection and by fine boundary elements.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from operator import itemgetter

import numpy as np

from validation.advice.calibration_scenes import OTHER_SEED, QUANTITIES
from validation.advice.cases.edge_scenes import MEASURED, OF_HOUSES, PUNCH, ROLLING, SPHERE, WHEEL, edge_scene
from validation.advice.cases.random_scenes import KINDS, random_scene
from validation.advice.hierarchy import REFUSALS, select_model, try_to_solve, unsolved
from validation.advice.models_of_scene import models_of, quantity_of
from validation.advice.scene_model import Answer, SceneModel, Shared
from validation.advice.tolerance import relative
from validation.analysis.case import Outcomes
from validation.analysis.spectra import assessed_bands
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.engine.realisations import NotConvergedError, as_not_converged
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.scene import Scene
from validation.simulation.method import distance
from validation.simulation.model import GridModel, all_models

REFERENCE_TOLERANCE = 0.05
FACES, TRACKS = (MEASURED + PUNCH, MEASURED + SPHERE), (MEASURED + ROLLING, MEASURED + WHEEL)
PARTS = 4
"""Of a measured point along each side."""
DRAWN = 4
"""Times as many scenes as are solved: a sphere with h/d = 10 costs as much as a hundred others."""
ROLLED = (ROLLING, WHEEL, *TRACKS, *OF_HOUSES)
"""Asked for nothing finer than the tolerance of their references: that would cost several times as much."""
CHEAP_EDGES = tuple((kind, 1) for kind in (PUNCH, SPHERE, ROLLING, MEASURED + PUNCH, MEASURED + SPHERE))
"""Kinds of scenes at the edges whose references take seconds."""
MANY, ENOUGH, SOME, FEW = 36, 18, 4, 4
"""Scenes of a kind at the edges: all together decide that 97 % of the answers hold, if all do. Moving wheels on
measured tracks take 20 s each, so that there are fewer; rails have cases of their own: a few are to find a false
claim."""
EDGE_SCENES = (
    *((kind, MANY) for kind in (PUNCH, SPHERE, ROLLING, MEASURED + PUNCH, MEASURED + SPHERE)),
    *((kind, ENOUGH) for kind in (WHEEL, MEASURED + ROLLING)),
    (MEASURED + WHEEL, SOME),
    *((kind, FEW) for kind in OF_HOUSES),
)
COARSE, FINE = "coarse boundary elements", "fine boundary elements"
CHEAP = tuple(
    dict.fromkeys(model.name for model in all_models() if not isinstance(model, GridModel) and model.answer is None)
)
MODELS = (*CHEAP, COARSE, FINE)
"""What selection may end on: the models below boundary elements by their kind, and those on two kinds of grid."""


@dataclass(frozen=True, kw_only=True)
class CalibrationTest:
    """Random scenes of each kind, for each of which a model is selected at each tolerance.

    punches, spheres, rolling, wheels: how many; edges: kinds of scenes at the edges of the ranges, and how many of
    each; tolerances: relative; seed: zero or positive.
    """

    punches: int = 8
    spheres: int = 2
    rolling: int = 1
    wheels: int = 0
    edges: tuple[tuple[str, int], ...] = ()
    tolerances: tuple[float, ...] = (0.1,)
    seed: int = 14

    @property
    def edge_trials(self) -> list["EdgeTrial"]:
        return edge_trials(self.edges, self.tolerances, self.seed)

    @property
    def edge_scenes(self) -> int:
        """How many lie at the edges."""
        return sum(count for _, count in self.edges)

    @property
    def trials(self) -> list["CalibrationTrial"]:
        """All of them; what takes longest first."""
        counts = dict(zip(KINDS, (self.punches, self.spheres, self.rolling, self.wheels), strict=True))
        return [
            CalibrationTrial(kind=kind, number=number, tolerances=self.tolerances, seed=self.seed)
            for kind in reversed(KINDS)
            for number in range(counts[kind])
        ]


@dataclass(frozen=True, kw_only=True)
class CalibrationTrial:
    """One random scene: one reference, and a selection at each tolerance."""

    kind: str
    number: int
    tolerances: tuple[float, ...]
    seed: int

    @property
    def drawn(self) -> tuple[Scene, str]:
        """The scene, and one of the quantities of its kind, one scene after the other."""
        quantities = QUANTITIES[self.kind]
        return random_scene(self.kind, self.number, self.seed), quantities[self.number % len(quantities)]

    @property
    def scene(self) -> Scene:
        return self.drawn[0]

    @property
    def quantity(self) -> str:
        return self.drawn[1]

    def models(self, tolerance: float, seed: int = 0) -> Sequence[SceneModel]:
        """All models of the scene; seed: added to that of the trial."""
        return models_of(*self.drawn, tolerance, self.seed + seed)


def run(case: CalibrationTest, engine: Engine = SERIAL) -> Outcomes:
    """Solve all scenes, "random" ones and those at the "edges". Raises NotConvergedError where no reference has an
    answer."""
    outcomes = engine.map(calibrate, case.trials)
    failed = lost(case.trials, outcomes)
    if len(failed) == len(outcomes):
        raise NotConvergedError("boundary elements converged on no scene", failed)
    edges = engine.map(solve_edge, case.edge_trials)
    return Outcomes(case, {"random": outcomes, "edges": edges}, (*failed, *lost(case.edge_trials, edges, "edge, ")))


def lost(trials: Sequence["CalibrationTrial"], outcomes: Sequence[Outcome], where: str = "") -> tuple[str, ...]:
    return tuple(f"{where}{t.kind} {t.number}" for t, o in zip(trials, outcomes, strict=True) if o["failed"])


def calibrate(trial: CalibrationTrial) -> Outcome:
    """Fine boundary elements as the reference, and model selection beside it.

    One value a tolerance: model, index of the selected model in MODELS, -1 for none; estimated, true: error of its
    answer, by itself and beside the reference; spent, fine: seconds of the selection, and of fine boundary elements
    with as many surfaces as the tolerance needs; met: one where the tolerance was met. Of the scene: reference: the
    error that the reference itself leaves; failed: one where the reference did not converge.
    """
    finest = trial.models(REFERENCE_TOLERANCE, OTHER_SEED)[-1]
    reference = try_to_solve(finest)
    # a reference whose grid leaves more than its tolerance ends after its first surfaces
    finished = reference.error <= REFERENCE_TOLERANCE
    slower = reference.cost.seconds / finest.cost().seconds if finished else 1.0
    rows = np.array([_selection_row(trial, tolerance, reference.value, slower) for tolerance in trial.tolerances])
    return {
        "reference": np.array(math.nan if reference.failed else reference.error),
        **dict(zip(("model", "estimated", "true", "spent", "fine", "met"), rows.T, strict=True)),
        "failed": np.array(float(bool(reference.failed))),
    }


def _selection_row(trial: CalibrationTrial, tolerance: float, truth: np.ndarray, slower: float) -> tuple[float, ...]:
    """One value of each output of `calibrate`. slower: time of the reference over its expected time."""
    models = trial.models(tolerance)
    selection = select_model(models, tolerance)
    best, fine = selection.best, models[-1].cost().seconds * slower
    if best is None or best.answer is None:
        return -1.0, math.nan, math.nan, selection.spent, fine, 0.0
    true = distance(best.answer.value, truth) if np.isfinite(truth).all() else math.nan
    index = MODELS.index(name_in_models(best.model, models))
    return float(index), best.answer.error, true, selection.spent, fine, float(selection.met)


def name_in_models(model: SceneModel, models: Sequence[SceneModel]) -> str:
    """Which of MODELS it is. Raises ValueError for a model that is none of them: its estimates would not be tested."""
    name = (FINE if model is models[-1] else COARSE) if model.kind == GridModel.name else model.kind
    if name not in MODELS:
        raise ValueError(f"the kind of a model must be one of {', '.join((*CHEAP, GridModel.name))}, got {name}")
    return name


# --- at the edges ---


class EdgeTrial(CalibrationTrial):
    """One scene of `EDGE_KINDS`."""

    @property
    def drawn(self) -> tuple[Scene, str]:
        return edge_scene(self.kind, self.number, self.seed)

    def sharing(self, tolerance: float, solved: Shared) -> Sequence[SceneModel]:
        """The same, whose grids have what was solved on them at other tolerances: the same realisations."""
        return [
            replace(model, shared=solved) if model.kind == GridModel.name else model for model in self.models(tolerance)
        ]

    @property
    def reference(self) -> SceneModel:
        """Boundary elements on the finest grid that is offered; of measured faces with their points split."""
        scene = split(self.scene) if self.kind in FACES else self.scene
        return finest_grid(models_of(scene, self.quantity, REFERENCE_TOLERANCE, self.seed + OTHER_SEED))

    @property
    def offered(self) -> SceneModel:
        """Boundary elements on the finest grid of the scene itself."""
        return finest_grid(self.models(REFERENCE_TOLERANCE))

    @property
    def is_own_reference(self) -> bool:
        """Whether boundary elements on the finest grid are the reference itself: no seed draws a track anew."""
        return self.kind in TRACKS


def finest_grid(models: Sequence[SceneModel]) -> SceneModel:
    return [model for model in models if model.kind == GridModel.name][-1]


def split(scene: Scene) -> IndentationScene:
    """Each point of a measured face in parts of its height, in other ones than those that its error is claimed by."""
    assert isinstance(scene, IndentationScene) and isinstance(scene.ground, MeasuredHeights)  # of `FACES`
    height = np.asarray(np.kron(scene.ground.height, np.ones((PARTS, PARTS))), dtype=np.float64)
    along, across = scene.ground.spacing
    return replace(scene, ground=MeasuredHeights(height=height, spacing=(along / PARTS, across / PARTS)))


def edge_trials(scenes: Sequence[tuple[str, int]], tolerances: tuple[float, ...], seed: int) -> list[EdgeTrial]:
    """scenes: how many of each kind: of those drawn that have a reference, the ones where it costs least."""
    return [
        trial
        for kind, count in scenes
        for trial in _cheapest_trials(kind, count, _tolerances_of_kind(kind, tolerances), seed)
    ]


def _tolerances_of_kind(kind: str, tolerances: tuple[float, ...]) -> tuple[float, ...]:
    """Tolerances at which scenes of a kind are tested: of `ROLLED` none below that of the reference."""
    coarse = tuple(tolerance for tolerance in tolerances if tolerance >= REFERENCE_TOLERANCE)
    return coarse if kind in ROLLED else tolerances


@cache
def _cheapest_trials(kind: str, count: int, tolerances: tuple[float, ...], seed: int) -> tuple[EdgeTrial, ...]:
    """The trials whose references cost least; cached, since their costs take seconds."""
    drawn = [EdgeTrial(kind=kind, number=i, tolerances=tolerances, seed=seed) for i in range(DRAWN * count)]
    costs = [(trial.reference.cost().seconds, trial) for trial in drawn if trial.reference.estimate().in_range]
    return tuple(trial for _, trial in sorted(costs, key=itemgetter(0))[:count])


def solve_edge(trial: EdgeTrial) -> Outcome:
    """A selection at each tolerance beside the reference.

    offered: the error of the finest boundary elements that the scene is offered, infinite where these have no answer;
    estimated, true: error of its answer, by itself and beside the reference, NaN where it has none; true is NaN, too,
    of measured tracks on the grid of the reference; met: one where the tolerance was met; reference: the error that
    the reference itself leaves; refused: why the reference has no answer to a scene that tests nothing then, empty
    where it has one; failed: one where a contact of it did not converge.
    """
    solved: Shared = {}
    judge = replace(trial.reference, shared=solved) if trial.is_own_reference else trial.reference
    reference, refused = reference_at_edge(judge)
    truth = np.array([math.nan]) if reference.failed else reference.value
    rows = np.array([_edge_row(trial, tolerance, solved, truth) for tolerance in trial.tolerances])
    return {
        **dict(zip(("estimated", "true", "met"), rows.T, strict=True)),
        "reference": np.array(math.nan if reference.failed else reference.error),
        "offered": np.array(try_to_solve(trial.offered).error if trial.kind in FACES else reference.error),
        "refused": np.array(refused),
        "failed": np.array(float(bool(reference.failed) and not refused)),
    }


def reference_at_edge(judge: SceneModel) -> tuple[Answer, str]:
    """Its answer, and why it refuses the scene, empty where it does not.

    A scene beyond the ranges may be refused: by an exception that is no lack of convergence, or since the answer, which
    is there, has no error estimate. A scene on which a contact did not converge is not refused: it is lost.
    """
    try:
        with as_not_converged():
            answer = judge.solve()
    except REFUSALS as problem:
        return unsolved(judge, problem), "" if isinstance(problem, NotConvergedError) else str(problem)
    return answer, answer.failed if np.isfinite(answer.value).all() else ""


def true_error(trial: EdgeTrial, value: np.ndarray, truth: np.ndarray) -> float:
    """How far an answer is off, as its model claims it: on a rail in the worst of the assessed bands, else in all.

    NaN where none is.
    """
    quantity = quantity_of(trial.scene, trial.quantity)
    if not quantity.by_worst_band:
        return distance(value, truth)
    assessed = assessed_bands(20 * np.log10(truth / quantity.reference), quantity.counted_above)
    return relative(float(np.abs(20 * np.log10(value / truth))[assessed].max())) if assessed.any() else math.nan


def _edge_row(trial: EdgeTrial, tolerance: float, solved: Shared, truth: np.ndarray) -> tuple[float, float, float]:
    """The outputs estimated, true and met of `solve_edge` at one tolerance."""
    selection = select_model(trial.sharing(tolerance, solved), tolerance)
    best = selection.best
    if best is None or best.answer is None:
        return math.nan, math.nan, 0.0
    same = trial.is_own_reference and best.name == trial.reference.name
    true = math.nan if same or not np.isfinite(truth).all() else true_error(trial, best.answer.value, truth)
    return best.answer.error, true, float(selection.met)
