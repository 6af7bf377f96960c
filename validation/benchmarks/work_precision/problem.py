"""A problem of the charts: its quantities, its configurations, its reference, and the measurement of all of them."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from validation.analysis.statistics import POWER_DECIBEL
from validation.benchmarks.timing import FINISHED, Configuration, RunLimits, Timing, time_in_turns
from validation.engine.engine import Outcome
from validation.simulation.method import FloatArray, Method, Resolution, Values
from validation.simulation.model import models_serving

CLOSED = "closed form"
FILTER_1D, FILTER_3D = "linear filter, 1D", "linear filter, 3D"
MDR, MDR_ROLLING = "MDR", "MDR, rolling spectrum"
POLONSKY_KEER, BEM, LOOSE, EXTRAPOLATED = (
    "Polonsky-Keer",
    "BEM, finer cells",
    "BEM, looser residual",
    "BEM, extrapolated",
)
ROUNDING = 1e-12
"""What a closed form leaves open."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Quantity:
    """A quantity of a problem.

    log: its natural logarithm from values, one number or one a band; needs: names of the values; order: of its error in
    the size of the cells; band: relative uncertainty of a reference that is not computed; decibel: whether errors are
    root mean squares of level differences [dB], of powers, or relative.
    """

    name: str
    log: Callable[[Values], FloatArray]
    needs: tuple[str, ...]
    order: float = 1.0
    band: float = ROUNDING
    decibel: bool = False

    def distance(self, log_ratio: FloatArray) -> float:
        """|ratio - 1|, or the root mean square of 10 lg ratio [dB]."""
        if self.decibel:
            return float(POWER_DECIBEL * np.sqrt(np.mean(log_ratio**2)))
        return float(np.abs(np.expm1(log_ratio)).max())


class ChartProblem(Protocol):
    """A frozen dataclass: configurations in the order of their parameters, and a reference for their values."""

    @property
    def name(self) -> str:
        """For tables and figures."""

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """All that are charted."""

    @property
    def scene(self) -> Any:
        """The scene of which models are found, None where there is none."""

    def configurations(self) -> tuple[Configuration, ...]:
        """All that are timed, models that are found not among them."""

    def reference(self) -> Values | tuple[Configuration, Configuration]:
        """What is exact, or the coarse and the fine grid from which it is extrapolated."""

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Coarse and fine grids that are extrapolated like the reference."""


def configurations_of(problem: ChartProblem) -> tuple[Configuration, ...]:
    """Models that are found in `simulation/models`, and what the problem has."""
    own = problem.configurations()
    names = {configuration.label for configuration in own}
    models = tuple(
        Configuration(
            method=model, scene=problem.scene, label=model.name, parameter=model.setting, value=1.0, paired=False
        )
        for model in models_serving(problem.scene, "stiffness")
        if model.name not in names
    )
    return (*models, *own)


def along(
    method: Method, scene: Any, sizes: Iterable[float], parameter: str, **settings: Any
) -> tuple[Configuration, ...]:
    """A method along the sizes of its resolution."""
    return tuple(
        Configuration(
            method=method,
            scene=scene,
            resolution=Resolution(size=size),
            label=method.name,
            parameter=parameter,
            value=size,
            **settings,
        )
        for size in sizes
    )


@dataclass(frozen=True)
class TimedProblem:
    """A problem on the clock. methods: names and versions: a run that goes on after a change of these begins anew."""

    problem: ChartProblem
    limits: RunLimits
    methods: tuple[str, ...] = ()


def measure(timed: TimedProblem) -> Outcome:
    """All configurations of a problem in turns.

    status: "finished", or why not; setup: seconds before the clock runs; seconds i: of each run of the i-th, a
    realisation; work: median of a realisation; NAME i: its values, realisations along the first axis.
    """
    timings = time_in_turns(configurations_of(timed.problem), timed.limits)
    outcome: dict[str, Any] = {
        "status": np.array([timing.status for timing in timings]),
        "setup": np.array([timing.setup for timing in timings]),
        "work": np.array([_work(timing) for timing in timings]),
    }
    for i, timing in enumerate(timings):
        outcome[f"seconds {i}"] = np.array(timing.seconds)
        for name in timing.results[0].values if timing.results else ():
            rows = [np.asarray(result.values[name]) for result in timing.results]
            outcome[f"{name} {i}"] = np.stack(rows) if timing.results[0].count == 1 else np.concatenate(rows)
    return outcome


def _work(timing: Timing) -> float:
    return float(np.median([result.work / result.count for result in timing.results])) if timing.results else np.nan


def values_by_configuration(problem: ChartProblem, outcome: Mapping[str, Any]) -> dict[Configuration, Values]:
    """Of all that have finished."""
    configurations = configurations_of(problem)
    return {each: _values(outcome, i) for i, each in enumerate(configurations) if str(outcome["status"][i]) == FINISHED}


def _values(outcome: Mapping[str, Any], i: int) -> Values:
    end = f" {i}"
    names = (name.removesuffix(end) for name in outcome if name.endswith(end) and name != f"seconds{end}")
    return {name: outcome[name + end] for name in names}
