"""A problem on the clock: its own configurations, and the models of its scene that `simulation/models` holds."""

from dataclasses import dataclass
from typing import Any

from validation.benchmarks.peers import SOLVERS
from validation.benchmarks.timing import Configuration, RunLimits, along
from validation.simulation.model import Target, all_models


@dataclass(frozen=True)
class TimedProblem:
    """A problem on the clock.

    problem: a frozen dataclass with `configurations`, models that are found not among them, a `scene`, None where no
    models are found, and `served`, the quantities that a model may have of it; methods: names and versions: a run that
    goes on after a change of these begins anew.
    """

    problem: Any
    limits: RunLimits
    methods: tuple[str, ...] = ()


def all_methods() -> tuple[str, ...]:
    """Solvers with their versions, and models."""
    return (*(f"{solver.name} {solver.version}" for solver in SOLVERS), *(model.name for model in all_models()))


def configurations_of(problem: Any) -> tuple[Configuration, ...]:
    """Models that are found, each once, and what the problem has."""
    own = problem.configurations()
    names = {each.label for each in own}
    return (*(found for found in found_models(problem) if found.label not in names), *own)


def found_models(problem: Any) -> tuple[Configuration, ...]:
    """All that have one of the quantities, but those whose resolution charts vary themselves."""
    targets = [Target(problem.scene, quantity) for quantity in problem.served]
    served = {
        model: next((target for target in targets if model.serves(target.scene, target.quantity)), None)
        for model in all_models()
        if model.charted
    }
    return tuple(
        each
        for model, target in served.items()
        if target
        for each in along(model, target, (1.0,), model.setting, paired=False)
    )
