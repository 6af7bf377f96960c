"""Comparisons of several scenes by the workers of an engine, which stores each scene as soon as it is finished."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from validation.advice.compare import Comparison, SceneProblem
from validation.advice.hierarchy import Candidate, Selection, Status
from validation.advice.scene_model import Answer, SceneModel
from validation.engine.engine import Engine, Outcome
from validation.simulation.model import Cost, ErrorEstimate


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
    texts = {
        name: json.dumps(
            [_row_of_candidate(candidate) for candidate in comparison.models], default=np.ndarray.tolist
        ).encode()
        for name, comparison in problem.compared().items()
    }
    return {name: np.frombuffer(text, dtype=np.uint8).astype(np.float64) for name, text in texts.items()}


def _comparison(problem: SceneProblem, quantity: str, outcome: Outcome) -> Comparison:
    rows = json.loads(outcome[quantity].astype(np.uint8).tobytes())
    models, _ = problem.listed_and_solvable(quantity)
    candidates = tuple(_candidate(model, *row) for model, row in zip(models, rows, strict=True))
    selection = Selection(problem.parsed_tolerance.relative, candidates)
    return Comparison(problem.scene, quantity, selection, problem.parsed_tolerance.in_decibels, timed=problem.solve_all)


def _row_of_candidate(candidate: Candidate) -> tuple[object, ...]:
    """Status, reason, estimate and answer of a candidate, in the order of the arguments of `_candidate`."""
    return candidate.status, candidate.reason, asdict(candidate.estimate), candidate.answer and asdict(candidate.answer)


def _candidate(model: SceneModel, status: Status, reason: str, estimate: Any, answer: Any) -> Candidate:
    """A candidate from its row, see `_row_of_candidate`."""
    if answer:
        bands = {name: np.array(half, dtype=np.float64) for name, half in answer["band_errors"].items()}
        value, cost = np.array(answer["value"], dtype=np.float64), Cost(**answer["cost"])
        answer = Answer(**{**answer, "value": value, "cost": cost, "band_errors": bands})
    return Candidate(model, status, reason, ErrorEstimate(**estimate), answer)
