"""Comparisons of several scenes by the workers of an engine, which stores each scene as soon as it is finished."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, is_dataclass

import numpy as np
from numpy.typing import NDArray

from validation.engine.engine import Engine, Outcome
from validation.scenes.load import Scene
from validation.selection.compare import Comparison, compare_quantities
from validation.selection.hierarchy import Answer, Candidate, ContactModel, Selection
from validation.selection.quantities import models_of
from validation.selection.tolerance import Tolerance, tolerance_of
from validation.simulation.model import Cost, ErrorEstimate


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

    def compared(self, callback: Callable[[ContactModel], None] = lambda _: None) -> dict[str, Comparison]:
        """Each quantity by its name."""
        return compare_quantities(
            self.scene,
            self.quantities,
            self.tolerance,
            self.seed,
            solve_all=self.solve_all,
            models=self.models,
            callback=callback,
        )


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
    found = problem.compared().items()
    texts = {name: json.dumps([_plain(candidate) for candidate in one.models]) for name, one in found}
    return {name: np.frombuffer(text.encode(), dtype=np.uint8).astype(np.float64) for name, text in texts.items()}


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


def _plain(candidate: Candidate) -> dict[str, object]:
    answer = candidate.answer
    return {
        "status": candidate.status,
        "reason": candidate.reason,
        "estimate": asdict(candidate.estimate),
        "answer": answer
        and {
            **{one.name: getattr(answer, one.name) for one in fields(answer)},
            "value": answer.value.tolist(),
            "cost": asdict(answer.cost),
            "band_errors": {name: halves.tolist() for name, halves in answer.band_errors.items()},
        },
    }


def _comparison(problem: SceneProblem, quantity: str, outcome: Outcome) -> Comparison:
    rows = json.loads(outcome[quantity].astype(np.uint8).tobytes())
    models = models_of(problem.scene, quantity, problem.wanted.relative, problem.seed)
    candidates = tuple(
        Candidate(
            model=model,
            status=row["status"],
            reason=row["reason"],
            estimate=ErrorEstimate(**row["estimate"]),
            answer=row["answer"] and _answer(row["answer"]),
        )
        for model, row in zip(models, rows, strict=True)
    )
    selection = Selection(problem.wanted.relative, candidates)
    return Comparison(problem.scene, quantity, selection, problem.wanted.in_decibels, timed=problem.solve_all)


def _answer(row: dict[str, object]) -> Answer:
    read = {
        "value": _array(row["value"]),
        "cost": Cost(**row["cost"]),  # type: ignore[arg-type]  # as it was written
        "band_errors": {name: _array(halves) for name, halves in row["band_errors"].items()},  # type: ignore[attr-defined]
    }
    return Answer(**{**row, **read})  # type: ignore[arg-type]


def _array(values: object) -> NDArray[np.float64]:
    return np.array(values, dtype=np.float64)
