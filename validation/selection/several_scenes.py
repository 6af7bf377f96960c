"""Comparisons of several scenes by the workers of an engine, which stores each scene as soon as it is finished."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any

import numpy as np

from validation.engine.engine import Engine, Outcome
from validation.scenes.load import Scene
from validation.selection.compare import Comparison, compare_quantities
from validation.selection.hierarchy import Candidate, Selection
from validation.selection.quantities import models_of
from validation.selection.scene_model import Answer, SceneModel
from validation.selection.tolerance import Tolerance, tolerance_of
from validation.simulation.model import Cost, ErrorEstimate

KINDS = {kind.__name__: kind for kind in (Answer, Cost, ErrorEstimate)}
"""Of what a store has of a model, by their names."""


@dataclass(frozen=True)
class SceneProblem:
    """What `compare` is asked of one scene, of each quantity.

    content: digest of all that the scene is made of, since its repr leaves out most of an array.
    """

    scene: Scene = field(repr=False)
    quantities: tuple[str, ...]
    tolerance: float | str
    seed: int = 0
    solve_all: bool = False
    models: str | tuple[str, ...] = ()
    content: str = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "content", content_of(self.scene))

    @property
    def wanted(self) -> Tolerance:
        return tolerance_of(self.tolerance)

    def compared(self, callback: Callable[[SceneModel], None] = lambda _: None) -> dict[str, Comparison]:
        """Each quantity by its name."""
        asked = (self.quantities, self.tolerance, self.seed, self.solve_all, self.models)
        return compare_quantities(self.scene, *asked, callback)


def compare_scenes(problems: Sequence[SceneProblem], engine: Engine) -> list[Comparison]:
    """`compare` of each scene and quantity, in their order; finished scenes are taken from the store of the engine."""
    outcomes = engine.map(compare_scene, problems)
    return [
        _comparison(problem, quantity, outcome)
        for problem, outcome in zip(problems, outcomes, strict=True)
        for quantity in problem.quantities
    ]


def compare_scene(problem: SceneProblem) -> Outcome:
    """What became of each model, as JSON in one array a quantity."""
    rows = {
        name: [(one.status, one.reason, one.estimate, one.answer) for one in found.models]
        for name, found in problem.compared().items()
    }
    texts = {name: json.dumps(of, default=_plain).encode() for name, of in rows.items()}
    return {name: np.frombuffer(text, dtype=np.uint8).astype(np.float64) for name, text in texts.items()}


def content_of(scene: Scene) -> str:
    """Digest of a scene: equal for equal values, whatever has been computed from them."""
    return hashlib.sha256(repr(_content(scene)).encode()).hexdigest()[:16]


def _content(value: object) -> object:
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, hashlib.sha256(value.tobytes()).hexdigest()
    if is_dataclass(value) and not isinstance(value, type):
        return type(value).__name__, [(one.name, _content(getattr(value, one.name))) for one in fields(value)]
    if isinstance(value, Mapping):
        return [(key, _content(part)) for key, part in value.items()]
    return [_content(part) for part in value] if isinstance(value, tuple | list) else value


def _comparison(problem: SceneProblem, quantity: str, outcome: Outcome) -> Comparison:
    rows = json.loads(outcome[quantity].astype(np.uint8).tobytes(), object_hook=_read)
    models = models_of(problem.scene, quantity, problem.wanted.relative, problem.seed)
    candidates = tuple(Candidate(model, *row) for model, row in zip(models, rows, strict=True))
    selection = Selection(problem.wanted.relative, candidates)
    return Comparison(problem.scene, quantity, selection, problem.wanted.in_decibels, timed=problem.solve_all)


def _plain(value: Any) -> object:
    """An array, or one of the `KINDS`."""
    if isinstance(value, np.ndarray):
        return {"array": value.tolist()}
    return {type(value).__name__: {one.name: getattr(value, one.name) for one in fields(value)}}


def _read(found: dict[str, Any]) -> object:
    """What `_plain` has made."""
    if len(found) == 1:
        ((name, part),) = found.items()
        return np.array(part, dtype=np.float64) if name == "array" else KINDS[name](**part)
    return found
