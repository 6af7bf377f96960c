"""The clock: methods at their settings take turns, one thread each, in processes of their own."""

import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import special

from validation.benchmarks.isolation import isolated_process, one_thread, timed
from validation.simulation.method import Method, Prepared, Resolution, Result

FINISHED, OUT_OF_RANGE, FAILED = "finished", "out of range", "failed"
OURS = "ours"
FEWEST_RUNS, MOST_RUNS = 5, 15
NO_GRID = Resolution()
ALONE = 0.25
"""By which a single run may be off."""
SHORTEST = 1e-3
"""Seconds that a run lasts at least: a shorter solve is repeated in it, or a waking processor is timed."""


@dataclass(frozen=True, kw_only=True)
class Configuration:
    """One method of a scene at one value of a parameter.

    label: of its curve; parameter: in words, "#" stands for the value; realisations: so many, one a run; none, the same
    problem again and again; paired: whether they are those of the reference; is_reference: whether it is the reference
    itself; worker: the process that it shares.
    """

    method: Method
    scene: Any
    resolution: Resolution = NO_GRID
    label: str
    parameter: str
    value: float
    realisations: int = 0
    paired: bool = True
    is_reference: bool = False
    worker: str = OURS

    def prepare(self) -> Prepared:
        """Set-up: operators, plans, all that is done once. Raises ValueError where the scene is out of range."""
        return self.method.prepare(self.scene, self.resolution)


def interval_of_median(times: Sequence[float]) -> tuple[float, float]:
    """Between order statistics, 93 % and more whatever the distribution; a single run is trusted to a quarter."""
    ordered = sorted(times)
    if len(ordered) == 1:
        return (1 - ALONE) * ordered[0], (1 + ALONE) * ordered[0]
    # the quantile of the binomial distribution; scipy.stats takes a second to import in each process that is timed
    below = special.bdtr(np.arange(len(ordered)), len(ordered), 0.5)
    beyond = max(int(np.searchsorted(below, 0.025)), 1)
    return ordered[beyond - 1], ordered[-beyond]


def along(
    method: Method,
    scene: Any,
    sizes: Iterable[float],
    parameter: str,
    *,
    label: str = "",
    residual: float = 0.0,
    **settings: Any,
) -> tuple[Configuration, ...]:
    """A method along the sizes of its resolution; a formula has one, and no size."""
    return tuple(
        Configuration(
            method=method,
            scene=scene,
            resolution=Resolution(size=size, residual=residual),
            label=label or method.name,
            parameter=parameter,
            value=size,
            **settings,
        )
        for size in sizes
    )


@dataclass(frozen=True, kw_only=True)
class RunLimits:
    """slow: a solve that takes longer is timed once [s]; enough: after so many seconds the fewest runs are enough."""

    slow: float
    enough: float


@dataclass
class Timing:
    """How one configuration fares.

    status: "finished", or why not; setup: seconds of its preparation; draws: seconds before each run; seconds: of each
    run, a realisation, or until it failed; results: of each realisation; runs: seconds of whole runs.
    """

    status: str
    setup: float
    seconds: list[float] = field(default_factory=list)
    draws: list[float] = field(default_factory=list)
    results: list[Result] = field(default_factory=list)
    runs: list[float] = field(default_factory=list)

    def needs_more_runs(self, configuration: Configuration, limits: RunLimits) -> bool:
        """Each realisation has one run; the same problem has runs until their median is settled."""
        if self.status != FINISHED:
            return False
        if configuration.realisations:
            return len(self.seconds) < configuration.realisations
        enough = len(self.runs) >= FEWEST_RUNS and sum(self.runs) >= limits.enough
        return not enough and len(self.runs) < MOST_RUNS and not (self.runs and self.runs[0] > limits.slow)


def time_in_turns(configurations: Sequence[Configuration], limits: RunLimits) -> list[Timing]:
    """Timings of all configurations. A failure, or the death of a process, is the status of its configuration."""
    with ExitStack() as stack:
        stack.enter_context(one_thread())
        names = dict.fromkeys(configuration.worker for configuration in configurations)
        workers = {name: stack.enter_context(isolated_process()) for name in names}
        timings = [_prepared(workers[each.worker], i, each) for i, each in enumerate(configurations)]
        for _ in range(max(MOST_RUNS, *(each.realisations for each in configurations))):
            for i, (configuration, timing) in enumerate(zip(configurations, timings, strict=True)):
                if timing.needs_more_runs(configuration, limits):
                    _add_run(workers[configuration.worker], i, configuration, timing)
    return timings


def _prepared(worker: ProcessPoolExecutor, i: int, configuration: Configuration) -> Timing:
    try:
        return Timing(*worker.submit(_prepare, i, configuration).result())
    except Exception as error:  # a process that has died
        return Timing(_reason(error), math.nan, [0.0])


def _add_run(worker: ProcessPoolExecutor, i: int, configuration: Configuration, timing: Timing) -> None:
    realisation = len(timing.seconds) if configuration.realisations else 0
    read = bool(configuration.realisations) or not timing.results
    try:
        status, draw, seconds, result = worker.submit(_run, i, realisation, read).result()
    except Exception as error:  # as above
        status, draw, seconds, result = _reason(error), 0.0, 0.0, None
    if status != FINISHED:
        # the time that it took to fail is its place on the chart
        timing.status, timing.seconds, timing.results = status, [seconds], []
        return
    if result is not None:
        timing.results.append(result)
    timing.draws.append(draw)
    timing.runs.append(seconds)
    timing.seconds.append(seconds / timing.results[-1].count)


_ready: dict[int, Prepared] = {}
"""In the process of a worker, by the place of the configuration."""


def _prepare(i: int, configuration: Configuration) -> tuple[str, float, list[float]]:
    """In the worker: status, seconds of the set-up; the same in a list where it failed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (prepared, status), seconds = timed(lambda: _caught(configuration.prepare))
    if prepared is not None:
        _ready[i] = prepared
        return status, seconds, []
    return status, seconds, [seconds]


def _run(i: int, realisation: int, read: bool) -> tuple[str, float, float, Result | None]:
    """In the worker: status, seconds of the draw and of a solve, and its result where it is to be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (solve, status), draw = timed(lambda: _caught(lambda: _ready[i](realisation)))
        if solve is None:
            return status, draw, draw, None
        (found, status), seconds = timed(lambda: _caught(solve.run))
        if status != FINISHED:
            return status, draw, seconds, None
        if solve.repeatable and seconds < SHORTEST:
            times = math.ceil(SHORTEST / seconds)
            seconds = timed(lambda: [solve.run() for _ in range(times)])[1] / times
        return status, draw, seconds, solve.read(found) if read else None


def _caught(function: Callable[[], Any]) -> tuple[Any, str]:
    """The result, or why there is none."""
    try:
        return function(), FINISHED
    except Exception as error:  # any failure is a row of the table
        return None, _reason(error)


def _reason(error: Exception) -> str:
    if isinstance(error, ValueError):
        return f"{OUT_OF_RANGE}: {error}"
    return f"{FAILED}: {type(error).__name__}: {error}"[:300]
