"""Speed against accuracy: what one measurement is, and how methods take turns on the clock."""

import math
import warnings
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import POWER_DECIBEL
from validation.benchmarks.isolation import one_thread, own_process, timed
from validation.engine.engine import Outcome

FloatArray = NDArray[np.float64]
Answers = Mapping[str, FloatArray]
"""By name; realisations along the first axis."""

FINISHED, REFUSED, FAILED = "finished", "refused", "failed"
CLOSED = "closed form"
FILTER_1D, FILTER_3D = "linear filter, 1D", "linear filter, 3D"
MDR, FED = "MDR", "MDR, fed for rolling"
PLAIN, BEM, LOOSE, EXTRAPOLATED = "plain BEM", "BEM, finer cells", "BEM, looser residual", "BEM, extrapolated"
OURS = "ours"
FEWEST_RUNS, MOST_RUNS = 5, 15
SHORT = 1e-3
"""Seconds that a turn lasts at least: what takes less is solved several times in it, or a waking processor is timed."""
ROUNDING = 1e-12
"""What a closed form leaves open."""


@dataclass(frozen=True, eq=False)
class SolveResult:
    """What a solve has found, and its cost that no machine changes.

    values: answers without the axis of realisations, or, where count is not one, with it; visits: cells times operator
    applications, springs evaluated, points filtered; NaN where nobody counts; count: realisations in this solve.
    """

    values: Answers
    visits: float
    count: int = 1


@dataclass(frozen=True, eq=False)
class TimedSolve:
    """solve: on the clock; read: what it has found, off the clock; again: whether a second solve is as cold."""

    solve: Callable[[], Any]
    read: Callable[[Any], SolveResult]
    again: bool = True


Draw = Callable[[int], TimedSolve]
"""From the number of a realisation to a solve on it, cold."""


@dataclass(frozen=True, kw_only=True)
class Configuration:
    """One method at one setting of its knob.

    line: the method; knob, value: what is turned along its line; realisations: on so many, one a turn; none, the same
    problem again and again; paired: whether they are those of the reference; referee: whether this is the reference;
    lane: whose process it shares.
    """

    line: str
    knob: str
    value: float
    realisations: int = 0
    paired: bool = True
    referee: bool = False
    lane: str = OURS

    def prepare(self) -> Draw:
        """Set-up: operators, plans, all that is done once for a grid. Raises ValueError to refuse."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False, kw_only=True)
class Quantity:
    """What is asked of a scene.

    log: its natural logarithm from answers, one number or one a band; needs: names of answers it takes; order: of its
    error in the size of the cells; band: relative uncertainty of a reference that is not computed; decibel: whether
    errors are root mean squares of level differences [dB], of powers, or relative.
    """

    name: str
    log: Callable[[Answers], FloatArray]
    needs: tuple[str, ...]
    order: float = 1.0
    band: float = ROUNDING
    decibel: bool = False

    def distance(self, log_ratio: FloatArray) -> float:
        """|ratio - 1|, or the root mean square of 10 lg ratio [dB]."""
        if self.decibel:
            return float(POWER_DECIBEL * np.sqrt(np.mean(log_ratio**2)))
        return float(np.abs(np.expm1(log_ratio)).max())


class Scene(Protocol):
    """A frozen dataclass: attempts in the order of their knobs, and what their answers are measured against."""

    @property
    def name(self) -> str:
        """For tables and figures."""

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """All that is asked."""

    def attempts(self) -> tuple[Configuration, ...]:
        """All that is timed."""

    def reference(self) -> Answers | tuple[Configuration, Configuration]:
        """What is exact, or the coarse and the fine grid from which it is extrapolated."""

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Coarse and fine grids that are extrapolated like the reference."""


@dataclass(frozen=True)
class TimedScene:
    """A scene on the clock.

    slow: who takes longer is timed once; enough: seconds after which the fewest runs are enough; entrants: versions of
    the peers, since a run that goes on after something was installed begins anew.
    """

    scene: Scene
    slow: float
    enough: float
    entrants: tuple[str, ...] = ()


@dataclass
class TimingRecord:
    """How one attempt fares: seconds a realisation, what it has found on each, and seconds of whole turns."""

    status: str
    setup: float
    seconds: list[float] = field(default_factory=list)
    works: list[SolveResult] = field(default_factory=list)
    taken: list[float] = field(default_factory=list)

    def wanting(self, attempt: Configuration, trial: TimedScene) -> bool:
        """Whether it has another turn: each realisation once; the same problem until the median is settled."""
        if self.status != FINISHED:
            return False
        if attempt.realisations:
            return len(self.seconds) < attempt.realisations
        enough = len(self.taken) >= FEWEST_RUNS and sum(self.taken) >= trial.enough
        return not enough and len(self.taken) < MOST_RUNS and not (self.taken and self.taken[0] > trial.slow)


def measure(trial: TimedScene) -> Outcome:
    """All attempts at a scene in turns, one thread each, ours in one process, each peer in another.

    status: "finished", or why not; setup: seconds before the clock runs; seconds i: of each turn of the i-th attempt, a
    realisation; visits: median of a realisation; NAME i: its answers, realisations along the first axis.
    """
    attempts = trial.scene.attempts()
    with ExitStack() as stack:
        stack.enter_context(one_thread())
        lanes = {name: stack.enter_context(own_process()) for name in dict.fromkeys(a.lane for a in attempts)}
        records = [_begun(lanes[attempt.lane], attempt) for attempt in attempts]
        for _ in range(max(MOST_RUNS, *(attempt.realisations for attempt in attempts))):
            for attempt, record in zip(attempts, records, strict=True):
                if record.wanting(attempt, trial):
                    _take_turn(lanes[attempt.lane], attempt, record)
    return _outcome(records)


def _begun(lane: ProcessPoolExecutor, attempt: Configuration) -> TimingRecord:
    try:
        return TimingRecord(*lane.submit(_prepare, attempt).result())
    except Exception as error:  # a process that has died
        return TimingRecord(_why(error), float("nan"), [0.0])


def _take_turn(lane: ProcessPoolExecutor, attempt: Configuration, record: TimingRecord) -> None:
    realisation = len(record.seconds) if attempt.realisations else 0
    try:
        status, seconds, work = lane.submit(_turn, attempt, realisation).result()
    except Exception as error:  # as above
        status, seconds, work = _why(error), 0.0, None
    if work is None:
        # how long it took to fail is where it stands on the chart
        record.status, record.seconds, record.works = status, [seconds], []
        return
    record.taken.append(seconds)
    record.seconds.append(seconds / work.count)
    if attempt.realisations or not record.works:
        record.works.append(work)


_drawn: dict[Configuration, Draw] = {}


def _prepare(attempt: Configuration) -> tuple[str, float, list[float]]:
    """In the process of the attempt: how its set-up ended, and how long it took; the third only where it failed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (draw, status), seconds = timed(lambda: _caught(attempt.prepare))
    if draw is not None:
        _drawn[attempt] = draw
        return status, seconds, []
    return status, seconds, [seconds]


def _turn(attempt: Configuration, realisation: int) -> tuple[str, float, SolveResult | None]:
    """One solve from a cold start, or the mean of several where one is too short for the clock."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (turn, status), drawing = timed(lambda: _caught(lambda: _drawn[attempt](realisation)))
        if turn is None:
            return status, drawing, None
        (result, status), seconds = timed(lambda: _caught(turn.solve))
        if status != FINISHED:
            return status, seconds, None
        if turn.again and seconds < SHORT:
            times = math.ceil(SHORT / seconds)
            seconds = timed(lambda: [turn.solve() for _ in range(times)])[1] / times
        return status, seconds, turn.read(result)


def _caught(function: Callable[[], Any]) -> tuple[Any, str]:
    """The result, or why there is none."""
    try:
        return function(), FINISHED
    except Exception as error:  # whatever an attempt dies of is a row of the table
        return None, _why(error)


def _why(error: Exception) -> str:
    if isinstance(error, ValueError):
        return f"{REFUSED}: {error}"
    return f"{FAILED}: {type(error).__name__}: {error}"[:300]


def _outcome(records: list[TimingRecord]) -> Outcome:
    outcome: dict[str, Any] = {
        "status": np.array([record.status for record in records]),
        "setup": np.array([record.setup for record in records]),
        "visits": np.array([np.median([w.visits / w.count for w in r.works]) if r.works else np.nan for r in records]),
    }
    for i, record in enumerate(records):
        outcome[f"seconds {i}"] = np.array(record.seconds)
        for name in record.works[0].values if record.works else ():
            rows = [np.asarray(w.values[name]) for w in record.works]
            alone = record.works[0].count == 1
            outcome[f"{name} {i}"] = np.stack(rows) if alone else np.concatenate(rows)
    return outcome


def answers_of(outcome: Outcome, i: int) -> Answers:
    """What the i-th attempt has found."""
    end = f" {i}"
    return {
        name[: -len(end)]: values for name, values in outcome.items() if name.endswith(end) and name != f"seconds{end}"
    }
