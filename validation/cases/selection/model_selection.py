"""Calibration test of model selection: random scenes, each solved by selection and by fine boundary elements."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from validation.cases.selection.edge_test import OTHER_SEED, REFERENCE_TOLERANCE, EdgeTrial, edge_trials, solve_edge
from validation.cases.selection.random_scenes import KINDS, QUANTITIES_BY_KIND, random_scene
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.indentation import IndentationScene
from validation.selection.hierarchy import ContactModel, select_model, try_to_solve
from validation.selection.quantities import models_of
from validation.simulation.model import GridModel, all_models
from validation.simulation.rail_models import RailModel
from validation.simulation.sampling import distance

EVERY_TOLERANCE = 0.1
"""Of the models that are solved whatever error they expect."""
COARSE, FINE = "coarse boundary elements", "fine boundary elements"
CHEAP = tuple(dict.fromkeys(model.name for model in all_models() if not isinstance(model, GridModel | RailModel)))
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
    def edge_trials(self) -> list[EdgeTrial]:
        return edge_trials(self.edges, self.tolerances, self.seed)

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
    def quantity(self) -> str:
        """The quantities of the kind, one scene after the other."""
        return QUANTITIES_BY_KIND[self.kind][self.number % len(QUANTITIES_BY_KIND[self.kind])]

    def models(self, tolerance: float, seed: int = 0) -> Sequence[ContactModel]:
        """All models of the scene; seed: added to that of the trial."""
        scene = random_scene(self.kind, self.number, self.seed)
        return models_of(scene, self.quantity, tolerance, self.seed + seed)


@dataclass(frozen=True)
class CalibrationResult:
    case: CalibrationTest
    outcomes: list[Outcome]
    unconverged: tuple[str, ...]
    edges: list[Outcome] = field(default_factory=list)


def run(case: CalibrationTest, engine: Engine = SERIAL) -> CalibrationResult:
    """Solve all scenes. Raises NotConvergedError where no reference has an answer."""
    outcomes = engine.map(calibrate, case.trials)
    failed = tuple(f"{t.kind} {t.number}" for t, o in zip(case.trials, outcomes, strict=True) if o["failed"])
    if len(failed) == len(outcomes):
        raise NotConvergedError("boundary elements converged on no scene", failed)
    return CalibrationResult(case, outcomes, failed, engine.map(solve_edge, case.edge_trials))


def calibrate(trial: CalibrationTrial) -> Outcome:
    """Fine boundary elements as the reference, and model selection beside it.

    One value a tolerance: model, index of the selected model in MODELS, -1 for none; estimated, true: error of its
    answer, by itself and beside the reference; spent, fine: seconds of the selection, and of fine boundary elements
    with as many surfaces as the tolerance needs; met: one where the tolerance was met. One value for each of CHEAP,
    solved whatever error it estimates: every estimated, every true. Of the scene: height, load: h/d and F / (E* h L);
    reference: the error that the reference itself leaves; failed: one where the reference did not converge.
    """
    finest = trial.models(REFERENCE_TOLERANCE, OTHER_SEED)[-1]
    reference = try_to_solve(finest)
    # a reference whose grid leaves more than its tolerance ends after its first surfaces
    finished = reference.error <= REFERENCE_TOLERANCE
    slower = reference.cost.seconds / finest.cost().seconds if finished else 1.0
    rows = np.array([_selected(trial, tolerance, reference.value, slower) for tolerance in trial.tolerances])
    models = trial.models(EVERY_TOLERANCE)
    every = np.array([_solved(models, kind, reference.value) for kind in CHEAP])
    scene = random_scene(trial.kind, trial.number, trial.seed)
    punch = isinstance(scene, IndentationScene) and scene.shape == "punch"
    return {
        "reference": np.array(math.nan if reference.failed else reference.error),
        **dict(zip(("model", "estimated", "true", "spent", "fine", "met"), rows.T, strict=True)),
        "every estimated": every[:, 0],
        "every true": every[:, 1],
        "height": np.array(math.nan if punch else scene.roughness_ratio),
        "load": np.array(scene.reduced_load if isinstance(scene, IndentationScene) and punch else math.nan),
        "failed": np.array(float(bool(reference.failed))),
    }


def _selected(trial: CalibrationTrial, tolerance: float, truth: np.ndarray, slower: float) -> tuple[float, ...]:
    """slower: time that the reference took over what it was expected to take."""
    models = trial.models(tolerance)
    selection = select_model(models, tolerance)
    best, fine = selection.best, models[-1].cost().seconds * slower
    if best is None or best.answer is None:
        return -1.0, math.nan, math.nan, selection.spent, fine, 0.0
    true = distance(best.answer.value, truth) if np.isfinite(truth).all() else math.nan
    index = MODELS.index(name_in_models(best.model, models))
    return float(index), best.answer.error, true, selection.spent, fine, float(selection.met)


def name_in_models(model: ContactModel, models: Sequence[ContactModel]) -> str:
    """Which of MODELS it is. Raises ValueError for a model that is none of them: its estimates would not be tested."""
    name = (FINE if model is models[-1] else COARSE) if model.kind == GridModel.name else model.kind
    if name not in MODELS:
        raise ValueError(f"the kind of a model must be one of {', '.join((*CHEAP, GridModel.name))}, got {name}")
    return name


def _solved(models: Sequence[ContactModel], kind: str, truth: np.ndarray) -> tuple[float, float]:
    """Estimated and true error of a model below boundary elements; NaN where the scene has none, or out of range."""
    model = {name_in_models(model, models): model for model in reversed(models)}.get(kind)
    if model is None or not model.estimate().in_range:
        return math.nan, math.nan
    answer = try_to_solve(model)
    return (math.nan, math.nan) if answer.failed else (answer.error, distance(answer.value, truth))
