"""Comparisons of several scenes by the workers of an engine, which stores each scene as soon as it is finished."""

import json
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from validation.engine.engine import Engine, Outcome
from validation.selection.compare import Comparison, SceneProblem
from validation.selection.hierarchy import Candidate, Selection
from validation.selection.scene_model import Answer
from validation.simulation.model import Cost, ErrorEstimate

KINDS = {kind.__name__: kind for kind in (Answer, Cost, ErrorEstimate)}
"""Of what a store has of a model, by their names."""


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


def _comparison(problem: SceneProblem, quantity: str, outcome: Outcome) -> Comparison:
    rows = json.loads(outcome[quantity].astype(np.uint8).tobytes(), object_hook=_read)
    models, _ = problem.offered(quantity)
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
