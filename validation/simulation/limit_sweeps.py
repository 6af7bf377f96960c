"""A sweep through a limit: one problem and one solve, whichever its probe."""

from dataclasses import dataclass

from validation.engine.engine import Outcome
from validation.simulation import limits_of_half_space, limits_of_springs

PROBES = {**vars(limits_of_springs), **vars(limits_of_half_space)}


@dataclass(frozen=True, kw_only=True)
class SweepProblem:
    """probe: a function of `limits_of_springs` or `limits_of_half_space`; values: of its parameter; settings: of it."""

    probe: str
    values: tuple[float, ...]
    settings: tuple[tuple[str, float | str], ...] = ()


def sweep(problem: SweepProblem) -> Outcome:
    """What the probe finds at each value, as `probing.swept` has it."""
    outcome: Outcome = PROBES[problem.probe](problem.values, **dict(problem.settings))
    return outcome
