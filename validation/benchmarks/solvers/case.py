"""The solver comparison: the same contact problems, the same residual, one thread each, solvers in turns."""

import itertools
import time
import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.analysis.evidence import Table
from validation.benchmarks.isolation import isolated_process, one_thread, peak_memory, timed
from validation.benchmarks.solvers.problems import (
    PUNCH,
    ROUGH,
    SPHERE,
    SPHERE_LOAD,
    SurfaceProblem,
    configurations_of,
    methods,
    names_of,
    punch,
)
from validation.benchmarks.solvers.rolling import RollingThroughput, rolling_throughput
from validation.benchmarks.solvers.wheel_steps import SteppingThroughput, stepping_throughput
from validation.benchmarks.timing import FINISHED, RunLimits, Timing, time_in_turns
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import Surface, press_surface

FloatArray = NDArray[np.float64]

NOT_INSTALLED = "not installed"
ROLLING, STEPPING = RollingThroughput(), SteppingThroughput()
SETTLED = 1.0
"""Seconds of runs after which the fewest are enough."""


@dataclass(frozen=True)
class LoadPathWorkload:
    """A sample of the work of Fig. 14.1.

    cells: on a side; forces: Fbar of a load path, ascending; sampled: those of them that all solvers solve, cold;
    tolerance: residual; paths: surfaces that our solver presses along the whole path.
    """

    cells: int = 64
    forces: tuple[float, ...] = tuple(10.0 ** (-3 + i / 6) for i in range(25))
    sampled: tuple[int, ...] = (0, 12, 24)
    tolerance: float = 1e-4
    paths: int = 1

    def problems(self, seed: int) -> list[SurfaceProblem]:
        """The sampled forces."""
        height = punch(self.cells, seed).height
        return [SurfaceProblem(PUNCH, self.forces[i] * height, self.cells, False, seed) for i in self.sampled]

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
class SolverComparison:
    """All problems.

    cells: grids; loads: of the rough surfaces; residual: that each solver reaches, see `bem3d.residual`; slow: a solve
    that takes longer is timed once [s]; scaling: grids on which our solver alone is measured; load_path: a sample of
    the work of Fig. 14.1; rolling, wheel: positions and steps a second of a wheel, by our own methods.
    """

    cells: tuple[int, ...] = (64, 128)
    loads: tuple[float, ...] = (0.001, 0.008)
    residual: float = 1e-8
    slow: float = 5.0
    scaling: tuple[int, ...] = (64, 128, 256)
    load_path: LoadPathWorkload = LoadPathWorkload()
    rolling: RollingThroughput = ROLLING
    wheel: SteppingThroughput = STEPPING
    seed: int = 20261121

    def problems(self) -> list[SurfaceProblem]:
        """Every surface in both half-spaces on every grid."""
        surfaces = [(SPHERE, SPHERE_LOAD), *((ROUGH, load) for load in self.loads)]
        return [
            SurfaceProblem(surface, load, n, periodic, self.seed)
            for periodic, (surface, load), n in itertools.product((True, False), surfaces, self.cells)
        ]

    def scalings(self) -> list["GridScaling"]:
        """Our solver alone, along the cells of three problems."""
        problems = ((SPHERE, SPHERE_LOAD, False), (ROUGH, self.loads[-1], False), (ROUGH, self.loads[-1], True))
        return [
            GridScaling(SurfaceProblem(surface, load, n, periodic, self.seed), self.residual)
            for surface, load, periodic in problems
            for n in self.scaling
        ]


@dataclass(frozen=True)
class ProblemRun:
    """One problem, solved by all methods in the versions that are installed."""

    problem: SurfaceProblem
    residual: float
    slow: float
    methods: tuple[str, ...]


@dataclass(frozen=True)
class GridScaling:
    """Our solver alone on one grid: its time and the memory of its process."""

    problem: SurfaceProblem
    residual: float


@dataclass(frozen=True)
class SolverComparisonResult:
    """One outcome a problem, one a grid, one a load path; the sample of Fig. 14.1 apart."""

    case: SolverComparison
    runs: list[ProblemRun]
    outcomes: list[Outcome]
    scalings: list[GridScaling]
    costs: list[Outcome]
    load_path_runs: list[ProblemRun]
    load_path_outcomes: list[Outcome]
    paths: list[Outcome]
    rolling: Table
    wheel: Table
    began: float = 0.0

    @property
    def resumed(self) -> int:
        """Problems that an interrupted run had solved before."""
        return sum(float(outcome["time"]) < self.began for outcome in self.outcomes)


def run(case: SolverComparison, engine: Engine = SERIAL) -> SolverComparisonResult:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    began = time.time()
    runs = [ProblemRun(problem, case.residual, case.slow, methods()) for problem in case.problems()]
    path = case.load_path
    path_runs = [ProblemRun(p, path.tolerance, case.slow, methods()) for p in path.problems(case.seed)]
    # a run that was interrupted goes on; one that is over is timed anew the next time
    with engine.timed() as alone:
        return SolverComparisonResult(
            case,
            runs,
            alone.map(time_problem, runs),
            case.scalings(),
            alone.map(measure_scaling, case.scalings()),
            path_runs,
            alone.map(time_problem, path_runs),
            alone.map(measure_path, path.surfaces(case.seed)),
            rolling_throughput(case.rolling, alone),
            stepping_throughput(case.wheel, alone),
            began,
        )


def time_problem(run: ProblemRun) -> Outcome:
    """All methods in processes of their own, with one thread, in turns.

    One row a method: name; status: "finished", or why not; seconds (median, fastest, slowest, runs), set-up seconds,
    residual reached, applications, differences to our solver, see `_differences`.
    """
    problem = run.problem
    configurations = configurations_of(problem, run.residual)
    timings = time_in_turns(configurations, RunLimits(slow=run.slow, enough=SETTLED))
    by_name = dict(zip((each.label for each in configurations), timings, strict=True))
    rows = [by_name.get(name, Timing(NOT_INSTALLED, np.nan)) for name in names_of(problem)]
    ours = rows[0].results[0].values["pressure"] if rows[0].results else None
    stiffness = _stiffness(problem, ours) if problem.scene and ours is not None else np.nan
    return {
        "method": np.array(names_of(problem)),
        "status": np.array([row.status for row in rows]),
        "seconds": np.array([_spread(row) for row in rows]),
        "setup": np.array([min(row.draws, default=np.nan) for row in rows]),
        "residual": np.array([_value(row, "residual") for row in rows]),
        "applications": np.array([_work(row) / problem.cells**2 for row in rows]),
        "difference": np.array([_differences(row, ours, stiffness) for row in rows]),
        "time": np.array(time.time()),
        "area": np.array(np.nan if ours is None else np.count_nonzero(ours) / ours.size),
    }


def _spread(row: Timing) -> tuple[float, float, float, int]:
    times = row.seconds if row.status == FINISHED else [np.nan]
    return float(np.median(times)), min(times), max(times), len(times)


def _value(row: Timing, name: str) -> float:
    return float(np.mean(row.results[0].values.get(name, np.nan))) if row.results else np.nan


def _work(row: Timing) -> float:
    return row.results[0].work if row.results else np.nan


def _stiffness(problem: SurfaceProblem, pressure: FloatArray) -> float:
    """Of the contact of our solver."""
    half_space = bem3d.HalfSpace(shape=pressure.shape, spacing=1 / problem.cells, modulus=1.0)
    return bem3d.solve_fixed_area(half_space, pressure > 0).stiffness


def _differences(row: Timing, ours: FloatArray | None, stiffness: float) -> tuple[float, float, float, float]:
    """Of the pressure field in L2, of the force, of the area, of the stiffness, each relative to our solver."""
    lost = (np.nan,) * 3
    if not row.results or ours is None:
        return (*lost, np.nan)
    pressure = row.results[0].values.get("pressure")
    if pressure is None:
        return (*lost, abs(_value(row, "stiffness") / stiffness - 1))
    field = float(np.sqrt(((pressure - ours) ** 2).sum() / (ours**2).sum()))
    area = np.count_nonzero(pressure > 1e-9 * pressure.max()) / np.count_nonzero(ours > 1e-9 * ours.max())
    return field, abs(float(pressure.sum() / ours.sum()) - 1), abs(area - 1), np.nan


def measure_scaling(scaling: GridScaling) -> Outcome:
    """Seconds and peak memory of a solve in a process of its own, and the seconds of one application."""
    with one_thread(), isolated_process() as worker:
        return worker.submit(_measure_scaling, scaling).result()


def _measure_scaling(scaling: GridScaling) -> Outcome:
    idle, problem = peak_memory(), scaling.problem
    height, spacing = problem.height(), 1 / problem.cells
    half_space = bem3d.HalfSpace(shape=height.shape, spacing=spacing, modulus=1.0, periodic=problem.periodic)

    def solve() -> bem3d.Contact:
        return bem3d.solve(half_space, -height, force=problem.load, tolerance=scaling.residual)

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
    with one_thread(), isolated_process() as worker:
        return worker.submit(_measure_path, surface).result()


def _measure_path(surface: Surface) -> Outcome:
    outcome, seconds = timed(lambda: press_surface(surface))
    return {
        "seconds": np.array(seconds),
        "applications": outcome["applications"] + outcome["frozen applications"],
        "failed": outcome["failed"],
    }
