"""The race: the same contact problems, the same residual, one thread each, one after the other in turns."""

import itertools
import time
import warnings
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.analysis.evidence import Table
from validation.benchmarks.isolation import one_thread, own_process, peak_memory, timed
from validation.benchmarks.peers import CONTESTANTS, Contestant, Run, Solve, Task
from validation.benchmarks.solvers.dynamic_wheel import SteppingThroughput, measure_wheels
from validation.benchmarks.solvers.rolling import RollingThroughput, measure_rolls
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.simulation.rough_punch import PunchRoughness, Surface, press_surface

SPHERE, ROUGH, PUNCH = "sphere", "rough", "punch of Fig. 14.1"
SPHERE_LOAD = 4 / 3 / 4**3
"""The force of Hertz for a = L/4 and R = L, over E* L^2."""
FINISHED = "finished"
ROLLS, STEPS = RollingThroughput(), SteppingThroughput()
FEWEST_RUNS, MOST_RUNS = 5, 15


@dataclass(frozen=True)
class Course:
    """A surface pressed on an n x n grid of unit side: a sphere with a = n/4 cells, or a self-affine surface.

    Rough: H = 0.7, from 2 pi/L to four cells a wave, rms height 0.01 L; the punch of Fig. 14.1 alike, with its own
    height; load: F / (E* L^2).
    """

    surface: str
    load: float
    cells: int
    periodic: bool
    seed: int

    @property
    def label(self) -> str:
        """For tables and figures."""
        load = "" if self.surface == SPHERE else f", F = {self.load:g} E* L²"
        return f"{self.surface}{load}, {'periodic' if self.periodic else 'free'}, {self.cells}²"

    def height(self) -> np.ndarray:
        """Positive towards the half-space [L]."""
        n = self.cells
        if self.surface == SPHERE:
            x = (np.arange(n) + 0.5) / n - 0.5
            return -(x[:, np.newaxis] ** 2 + x**2) / 2
        if self.surface == PUNCH:
            return punch(n, self.seed).surface(n, 0)
        band = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * n / 4, rms=0.01)
        return bem3d.rough_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=random_generator(self.seed), rms=0.01)

    def task(self) -> Task:
        """The problem, with the approach that belongs to its force."""
        height = self.height()
        task = Task(height, 1 / self.cells, 1.0, self.periodic, self.load, 0.0)
        approach = bem3d.solve(task.half_space(), task.gap, force=self.load, tolerance=1e-10).approach
        return Task(height, 1 / self.cells, 1.0, self.periodic, self.load, approach)


def punch(cells: int, seed: int) -> PunchRoughness:
    """One of those of Fig. 14.1, with four cells to its shortest wave."""
    return PunchRoughness(hurst=0.7, waves=(1, cells // 4), seed=seed)


@dataclass(frozen=True)
class Errand:
    """The work of Fig. 14.1, a sample of it.

    cells: on a side; forces: Fbar of a load path, ascending; sampled: those of them that everyone solves, cold;
    tolerance: residual; paths: surfaces that we press along the whole path; contacts: so many has the full figure.
    """

    cells: int = 64
    forces: tuple[float, ...] = tuple(10.0 ** (-3 + i / 6) for i in range(25))
    sampled: tuple[int, ...] = (0, 12, 24)
    tolerance: float = 1e-4
    paths: int = 1

    def heats(self, seed: int, slow: float) -> list["Heat"]:
        """The sampled forces, one cold solve each."""
        height = punch(self.cells, seed).height
        return [
            Heat(Course(PUNCH, self.forces[i] * height, self.cells, False, seed), self.tolerance, slow, entrants())
            for i in self.sampled
        ]

    def surfaces(self, seed: int) -> list[Surface]:
        """Our load paths."""
        return [
            Surface(
                roughness=punch(self.cells, seed),
                realisation=i,
                cells=self.cells,
                forces=self.forces,
                tolerance=self.tolerance,
            )
            for i in range(self.paths)
        ]


@dataclass(frozen=True)
class Race:
    """All courses.

    cells: grids; loads: of the rough surfaces; residual: to be reached by everyone, see `bem3d.residual`;
    slow: a contestant that takes longer is timed once [s]; scaling: grids on which our solver alone is measured;
    errand: a sample of the work of Fig. 14.1; rolling, wheel: a wheel that rolls,
    quasi-statically and dynamically, by ourselves.
    """

    cells: tuple[int, ...] = (64, 128)
    loads: tuple[float, ...] = (0.001, 0.008)
    residual: float = 1e-8
    slow: float = 5.0
    scaling: tuple[int, ...] = (64, 128, 256)
    errand: Errand = Errand()
    rolling: RollingThroughput = ROLLS
    wheel: SteppingThroughput = STEPS
    seed: int = 20261121

    def courses(self) -> list[Course]:
        """Every surface in both half-spaces on every grid."""
        surfaces = [(SPHERE, SPHERE_LOAD), *((ROUGH, load) for load in self.loads)]
        return [
            Course(surface, load, n, periodic, self.seed)
            for periodic, (surface, load), n in itertools.product((True, False), surfaces, self.cells)
        ]


@dataclass(frozen=True)
class Heat:
    """One course, run by everyone in the version that is installed."""

    course: Course
    residual: float
    slow: float
    entrants: tuple[str, ...]


@dataclass(frozen=True)
class Measured:
    """Our solver alone on one grid: its time and the memory of its process."""

    course: Course
    residual: float


@dataclass(frozen=True)
class RaceResult:
    """The race and what was measured: one outcome a heat, one a grid, one a load path; the errand's heats apart."""

    race: Race
    heats: list[Heat]
    outcomes: list[Outcome]
    measured: list[Measured]
    costs: list[Outcome]
    errands: list[Heat]
    errand_outcomes: list[Outcome]
    paths: list[Outcome]
    rolling: list[Table]
    wheel: list[Table]
    began: float = 0.0

    @property
    def resumed(self) -> int:
        """Heats that an interrupted race had run before."""
        return sum(float(outcome["time"]) < self.began for outcome in self.outcomes)


def entrants() -> tuple[str, ...]:
    """Names and versions: a race that goes on after something was installed begins anew."""
    return tuple(f"{contestant.name} {contestant.version}" for contestant in CONTESTANTS)


def run(race: Race, engine: Engine = SERIAL) -> RaceResult:
    """Run all heats, one at a time whatever the engine's workers, so that nobody is disturbed."""
    began = time.time()
    heats = [Heat(course, race.residual, race.slow, entrants()) for course in race.courses()]
    measured = [
        Measured(Course(surface, load, n, periodic, race.seed), race.residual)
        for surface, load, periodic in (
            (SPHERE, SPHERE_LOAD, False),
            (ROUGH, race.loads[-1], False),
            (ROUGH, race.loads[-1], True),
        )
        for n in race.scaling
    ]
    errands = race.errand.heats(race.seed, race.slow)
    # a race that was interrupted goes on; one that is over is run anew the next time
    with engine.timed() as alone:
        return RaceResult(
            race,
            heats,
            alone.map(run_heat, heats),
            measured,
            alone.map(measure, measured),
            errands,
            alone.map(run_heat, errands),
            alone.map(measure_path, race.errand.surfaces(race.seed)),
            measure_rolls(race.rolling, alone),
            measure_wheels(race.wheel, alone),
            began,
        )


def run_heat(heat: Heat) -> Outcome:
    """Everyone in a process of its own, with one thread, taking turns; who fails or dies is a row, not an omission.

    One row a contestant: seconds (median, fastest, slowest), set-up seconds, residual reached, applications, relative
    L2 difference of the pressure, relative difference of force and of area to our solver's; status "finished" or why
    not.
    """
    with ExitStack() as stack:
        stack.enter_context(warnings.catch_warnings())
        warnings.simplefilter("ignore", bem3d.EdgeWarning)  # a rough surface is pressed as far as its grid goes
        task = heat.course.task()
        stack.enter_context(one_thread())
        lanes = [stack.enter_context(own_process()) for _ in CONTESTANTS]
        rows = [
            _qualify(lane, contestant, task, heat.residual) for lane, contestant in zip(lanes, CONTESTANTS, strict=True)
        ]
        for _ in range(MOST_RUNS - 1):
            for row, lane in zip(rows, lanes, strict=True):
                if row.wanting(heat.slow):
                    _repeat(row, lane)
    return _outcome(task, rows)


@dataclass
class Row:
    """How one contestant fares."""

    status: str
    setup: float = float("nan")
    residual: float = float("nan")
    applications: float = float("nan")
    seconds: list[float] = field(default_factory=list)
    pressure: np.ndarray | None = None

    def wanting(self, slow: float) -> bool:
        """Whether one more run would make the median better: until five, and a second in all."""
        enough = len(self.seconds) >= FEWEST_RUNS and sum(self.seconds) >= 1.0
        return self.status == FINISHED and self.seconds[0] < slow and not enough


def _qualify(lane: ProcessPoolExecutor, contestant: Contestant, task: Task, residual: float) -> Row:
    """The first run: with the loosest of its own tolerances that reaches the residual."""
    if contestant.version is None:
        return Row("not installed")
    reached = float("nan")
    for part in contestant.tolerances:
        try:
            setup = lane.submit(_prepare, contestant, task, part * residual).result()
            seconds, run = lane.submit(_run).result()
        except Exception as error:  # whatever a contestant dies of, the race goes on
            return Row(_failure(error))
        if not np.isfinite(run.pressure).all():
            return Row("failed: pressure is not finite")
        reached = task.residual(run.pressure)
        if reached <= residual:
            return Row(FINISHED, setup, reached, run.applications, [seconds], run.pressure)
    return Row(f"failed: residual {reached:.2g} at its tightest tolerance")


def _repeat(row: Row, lane: ProcessPoolExecutor) -> None:
    """One more run. Who fails in it has not finished."""
    try:
        row.seconds.append(lane.submit(_again).result())
    except Exception as error:  # as above
        row.status, row.seconds, row.pressure = _failure(error), [], None


def _failure(error: Exception) -> str:
    return f"failed: {type(error).__name__}: {error}"[:200]


_asked: list[Any] = []
_ready: list[Solve] = []


def _prepare(contestant: Contestant, task: Task, tolerance: float) -> float:
    """In the contestant's process: everything before the clock runs. Returns how long it took."""
    warnings.simplefilter("ignore")
    begin = time.perf_counter()
    _asked[:] = [contestant, task, tolerance]
    _ready[:] = [contestant.prepare(task, tolerance)]
    return time.perf_counter() - begin


def _again() -> float:
    """Prepared anew, since what a contestant has solved once may be where it starts from."""
    _prepare(*_asked)
    return _run()[0]


def _run() -> tuple[float, Run]:
    """In the contestant's process: one solve from a cold start."""
    begin = time.perf_counter()
    run = _ready[0]()
    return time.perf_counter() - begin, run


def _outcome(task: Task, rows: list[Row]) -> Outcome:
    ours = rows[0].pressure
    times = [row.seconds or [float("nan")] for row in rows]
    return {
        "status": np.array([row.status for row in rows]),
        "seconds": np.array([(np.median(t), min(t), max(t), len(t)) for t in times]),
        "setup": np.array([row.setup for row in rows]),
        "residual": np.array([row.residual for row in rows]),
        "applications": np.array([row.applications for row in rows]),
        "difference": np.array([_differences(row.pressure, ours) for row in rows]),
        "time": np.array(time.time()),
        "area": np.array(np.nan if ours is None else np.count_nonzero(ours) / ours.size),
    }


def _differences(pressure: np.ndarray | None, ours: np.ndarray | None) -> tuple[float, float, float]:
    """Of the pressure field in L2, of the force, of the area, each relative to ours."""
    if pressure is None or ours is None:
        return float("nan"), float("nan"), float("nan")
    field = float(np.sqrt(((pressure - ours) ** 2).sum() / (ours**2).sum()))
    area = np.count_nonzero(pressure > 1e-9 * pressure.max()) / np.count_nonzero(ours > 1e-9 * ours.max())
    return field, abs(float(pressure.sum() / ours.sum()) - 1), abs(area - 1)


def measure(measured: Measured) -> Outcome:
    """Seconds and peak memory of a solve in a process of its own, and the seconds of one application."""
    with one_thread(), own_process() as lane:
        return lane.submit(_measure, measured).result()


def _measure(measured: Measured) -> Outcome:
    idle, course = peak_memory(), measured.course
    task = Task(course.height(), 1 / course.cells, 1.0, course.periodic, course.load, 0.0)
    half_space = task.half_space()

    def solve() -> bem3d.Contact:
        return bem3d.solve(half_space, task.gap, force=task.force, tolerance=measured.residual)

    warnings.simplefilter("ignore", bem3d.EdgeWarning)  # this process has nothing else to say
    contact, first = timed(solve)
    peak = peak_memory()
    # what the plans cost is nothing beside a solve that takes so long
    seconds = sorted(timed(solve)[1] for _ in range(3)) if first < 5 else [first]
    half_space.displacement(contact.pressure)
    application = sorted(timed(lambda: half_space.displacement(contact.pressure))[1] for _ in range(5))
    return {
        "seconds": np.array(seconds[len(seconds) // 2]),
        "first": np.array(first),
        "application": np.array(application[2]),
        "applications": np.array(contact.operator_applications),
        "coarse": np.array(sum(n for _, n in contact.coarse_applications)),
        "peak": np.array(peak),
        "idle": np.array(idle),
        "residual": np.array(contact.residual),
    }


def measure_path(surface: Surface) -> Outcome:
    """Seconds of a whole load path with its stiffnesses, and the operator applications of each contact."""
    with one_thread(), own_process() as lane:
        return lane.submit(_measure_path, surface).result()


def _measure_path(surface: Surface) -> Outcome:
    outcome, seconds = timed(lambda: press_surface(surface))
    return {
        "seconds": np.array(seconds),
        "applications": outcome["applications"] + outcome["frozen applications"],
        "failed": outcome["failed"],
    }
