"""The clock: methods at their settings take turns, one thread each, in processes of their own."""

import itertools
import math
import multiprocessing
import os
import signal
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any, ParamSpec, TypeVar

import numpy as np
from scipy import special

from validation.engine.workers import end_after
from validation.simulation.method import Method, Prepared, Resolution, Result
from validation.simulation.model import Target, all_models

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")
P = ParamSpec("P")
T = TypeVar("T")


class IsolatedProcess(ProcessPoolExecutor):
    """Ended at once where an exception leaves it, since its result is not needed then."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            for process in list((self._processes or {}).values()):
                process.kill()
        super().__exit__(kind, error, trace)


def isolated_process() -> ProcessPoolExecutor:
    """A fresh process, which leaves an interruption to its parent."""
    spawn = multiprocessing.get_context("spawn")
    return IsolatedProcess(1, spawn, _begin)


def _begin() -> None:
    """In the process, before its first call."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None
    end_after(parent.join)


def timed(function: Callable[[], T]) -> tuple[T, float]:
    """Result and seconds."""
    begin = time.perf_counter()
    result = function()
    return result, time.perf_counter() - begin


@contextmanager
def one_thread() -> Iterator[None]:
    """Processes started meanwhile compute with one thread."""
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def alone(function: Callable[P, T], *arguments: P.args, **named: P.kwargs) -> T:
    """The result of a fresh process with one thread."""
    with one_thread(), isolated_process() as worker:
        return worker.submit(function, *arguments, **named).result()


FINISHED, OUT_OF_RANGE, FAILED, NOT_SERVED = "finished", "out of range", "failed", "not served"
OURS = "ours"
FEWEST_RUNS, MOST_RUNS = 5, 15
ALONE = 0.25
"""By which a single run may be off."""
SHORTEST = 1e-3
"""Seconds that a run lasts at least: a shorter solve is repeated in it, or a waking processor is timed."""


@dataclass(frozen=True)
class NamedMethod:
    """A function of a scene, a resolution and these options that prepares a method."""

    name: str
    by: Callable[..., Prepared]
    options: tuple[Any, ...] = ()

    def prepare(self, scene: Any, resolution: Resolution) -> Prepared:
        return self.by(scene, resolution, *self.options)


@dataclass(frozen=True, kw_only=True)
class Configuration:
    """One method of a scene at one value of a parameter.

    label: of its curve; parameter: in words, "#" stands for the value; realisations: so many, one a run; none, the same
    problem again and again; paired: whether they are those of the reference; is_reference: whether it is the reference
    itself; worker: the process that it shares.
    """

    method: Method
    scene: Any
    resolution: Resolution
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
    fields = {"method": method, "scene": scene, "label": label or method.name, "parameter": parameter, **settings}
    return tuple(
        Configuration(resolution=Resolution(size=size, residual=residual), value=size, **fields) for size in sizes
    )


@dataclass(frozen=True, kw_only=True)
class TimedProblem:
    """A problem on the clock.

    problem: a frozen dataclass with `configurations`, models that are found not among them; slow: a solve that takes
    longer is timed once [s]; enough: after so many seconds the fewest runs are enough; methods: names and versions: a
    run that goes on after a change of these begins anew.
    """

    problem: Any
    slow: float
    enough: float
    methods: tuple[str, ...] = ()


def configurations_of(problem: Any) -> tuple[Configuration, ...]:
    """All contact models that serve the problem, but for those with `charted` false, then its own configurations.

    problem: has `configurations`, a `scene` and `served`, the quantities by which models are chosen.
    """
    own = problem.configurations()
    labels, targets = {each.label for each in own}, [Target(problem.scene, quantity) for quantity in problem.served]
    model_configurations = (
        along(model, target, (1.0,), model.setting, paired=False)
        for model in all_models()
        if model.charted and model.name not in labels
        for target in [candidate for candidate in targets if model.serves(candidate.scene, candidate.quantity)][:1]
    )
    return (*itertools.chain(*model_configurations), *own)


def interval_of_median(times: Sequence[float]) -> tuple[float, float]:
    """Between order statistics, 93 % and more whatever the distribution; a single run is trusted to a quarter."""
    ordered = sorted(times)
    if len(ordered) == 1:
        return (1 - ALONE) * ordered[0], (1 + ALONE) * ordered[0]
    # the quantile of the binomial distribution; scipy.stats takes a second to import in each process that is timed
    below = special.bdtr(np.arange(len(ordered)), len(ordered), 0.5)
    beyond = max(int(np.searchsorted(below, 0.025)), 1)
    return ordered[beyond - 1], ordered[-beyond]


@dataclass
class Timing:
    """How one configuration fares.

    status: "finished", or why not; setup: seconds of its preparation; runs: seconds of each, or until it failed; draws:
    seconds before each run; results: of each realisation, or of the first run.
    """

    status: str
    setup: float
    runs: list[float] = field(default_factory=list)
    draws: list[float] = field(default_factory=list)
    results: list[Result] = field(default_factory=list)

    @property
    def seconds(self) -> list[float]:
        """Of each run, a realisation."""
        return [run / self.results[0].count if self.results else run for run in self.runs]

    def needs_more_runs(self, realisations: int, problem: TimedProblem) -> bool:
        """Each realisation has one run; the same problem has runs until their median is settled."""
        done = len(self.runs)
        if self.status != FINISHED or realisations:
            return self.status == FINISHED and done < realisations
        enough = done >= FEWEST_RUNS and sum(self.runs) >= problem.enough
        return not enough and done < MOST_RUNS and not (self.runs and self.runs[0] > problem.slow)


def time_in_turns(configurations: Sequence[Configuration], problem: TimedProblem) -> list[Timing]:
    """Timings of all configurations. A failure, or the death of a process, is the status of its configuration."""
    with ExitStack() as stack:
        stack.enter_context(one_thread())
        names = dict.fromkeys(configuration.worker for configuration in configurations)
        workers = {name: stack.enter_context(isolated_process()) for name in names}
        timings = [_first_timing(workers[each.worker], i, each) for i, each in enumerate(configurations)]
        for _ in range(max(MOST_RUNS, *(each.realisations for each in configurations))):
            for i, (configuration, timing) in enumerate(zip(configurations, timings, strict=True)):
                if timing.needs_more_runs(configuration.realisations, problem):
                    _add_run(workers[configuration.worker], i, configuration, timing)
    return timings


def _first_timing(worker: ProcessPoolExecutor, i: int, configuration: Configuration) -> Timing:
    """Prepare a configuration in its worker; the timing has no runs yet, or the reason of a failure."""
    try:
        status, setup = worker.submit(_prepare, i, configuration).result()
        return Timing(status, setup, [] if status == FINISHED else [setup])
    except Exception as error:  # a process that has died
        return Timing(_reason(error), math.nan, [0.0])


def _add_run(worker: ProcessPoolExecutor, i: int, configuration: Configuration, timing: Timing) -> None:
    realisation = len(timing.runs) if configuration.realisations else 0
    read = bool(configuration.realisations) or not timing.results
    try:
        status, draw, seconds, result = worker.submit(_run, i, realisation, read).result()
    except Exception as error:  # as above
        status, draw, seconds, result = _reason(error), 0.0, 0.0, None
    if status != FINISHED:
        # the time that it took to fail is its place on the chart
        timing.status, timing.runs, timing.results = status, [seconds], []
        return
    if result is not None:
        timing.results.append(result)
    timing.draws.append(draw)
    timing.runs.append(seconds)


_ready: dict[int, Prepared] = {}
"""In the process of a worker, by the place of the configuration."""


def _prepare(i: int, configuration: Configuration) -> tuple[str, float]:
    """In the worker: status, seconds of the set-up."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (_ready[i], status), seconds = timed(lambda: _result_or_reason(configuration.prepare))
    return status, seconds


def _run(i: int, realisation: int, read: bool) -> tuple[str, float, float, Result | None]:
    """In the worker: status, seconds of the draw and of a solve, and its result where it is to be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (solve, status), draw = timed(lambda: _result_or_reason(lambda: _ready[i](realisation)))
        if solve is None:
            return status, draw, draw, None
        (answer, status), seconds = timed(lambda: _result_or_reason(solve.run))
        if status != FINISHED:
            return status, draw, seconds, None
        if solve.repeatable and seconds < SHORTEST:
            times = math.ceil(SHORTEST / seconds)
            seconds = timed(lambda: [solve.run() for _ in range(times)])[1] / times
        return status, draw, seconds, solve.read(answer) if read else None


def _result_or_reason(function: Callable[[], Any]) -> tuple[Any, str]:
    """Return the result and "finished", or None and the reason why the call has no result."""
    try:
        return function(), FINISHED
    except Exception as error:  # any failure is a row of the table
        return None, _reason(error)


def _reason(error: Exception) -> str:
    """Return the status that an exception stands for: out of range, not served or failed."""
    if isinstance(error, ValueError):
        return f"{OUT_OF_RANGE}: {error}"
    if isinstance(error, NotImplementedError):
        return f"{NOT_SERVED}: {error}"[:300]
    return f"{FAILED}: {type(error).__name__}: {error}"[:300]
