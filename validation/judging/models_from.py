"""The option `--models-from` of `compare`: models of a file, or of an installed package, beside those of a scene."""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from validation.advice.compare import SceneProblem
from validation.engine.engine import Engine
from validation.engine.progress import Part
from validation.judging.own_models import NOT_IN_KEY, OwnModel, calibrated, group_of, models_in
from validation.scenes.printable import printable


def with_models(problems: Sequence[SceneProblem], name: str) -> Sequence[SceneProblem]:
    """And the models of a file, or of an installed package; of several scenes those that these serve have them."""
    own = tuple(models_in(name))

    def is_served(problem: SceneProblem) -> bool:
        return any(one.model().serves(problem.scene, asked) for one in own for asked in problem.quantities)

    served = [is_served(problem) for problem in problems]
    # where none is served, all have them, which is refused with the reason
    return [
        replace(one, own=own if here or not any(served) else ()) for one, here in zip(problems, served, strict=True)
    ]


def measured(problems: Sequence[SceneProblem], name: str, store: Path) -> Sequence[SceneProblem]:
    """With the errors of models of somebody's own, which are measured first where they are not in the store."""
    groups = {group_of(one.scene, quantity) for one in problems for quantity in one.quantities}
    solved = Part()
    engine = Engine(store=store / "realisations", progress=solved)

    def with_errors(problem: SceneProblem) -> SceneProblem:
        own = tuple(calibrated(one, groups, engine) for one in problem.own if isinstance(one, OwnModel))
        return replace(problem, own=own)

    found = [with_errors(problem) for problem in problems]
    if any(kind.stored for kind in solved.kinds):
        print(
            f"errors of {printable(name)} are those kept in {printable(store)}, {NOT_IN_KEY}",
            file=sys.stderr,
        )
    return found
