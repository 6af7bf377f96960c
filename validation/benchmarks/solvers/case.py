"""The solver comparison: the same contact problems, the same residual, one thread each, solvers in turns."""

import itertools
import time
import warnings
from dataclasses import dataclass, replace

import numpy as np

import bem3d
from validation.analysis.evidence import Table
from validation.benchmarks.found_models import TimedProblem, all_methods, configurations_of
from validation.benchmarks.isolation import measure_alone, peak_memory, timed
from validation.benchmarks.peers import OUR_SOLVER, SOLVERS
from validation.benchmarks.solvers.problems import PUNCH, ROUGH, SPHERE, SPHERE_LOAD, SurfaceProblem, punch
from validation.benchmarks.solvers.rolling import RollingThroughput, rolling_throughput
from validation.benchmarks.solvers.wheel_steps import SteppingThroughput, stepping_throughput
from validation.benchmarks.timing import FINISHED, RunLimits, Timing, interval_of_median, time_in_turns
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.method import FloatArray, Values
from validation.simulation.rough_punch import Surface, press_surface

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
        loads = (self.forces[i] * punch(self.cells, seed).height for i in self.sampled)
        return [SurfaceProblem(PUNCH, load, self.cells, False, seed, self.tolerance) for load in loads]

    def load_paths(self, seed: int) -> list["LoadPath"]:
        first = Surface(
            roughness=punch(self.cells, seed),
            realisation=0,
            cells=self.cells,
            forces=self.forces,
            tolerance=self.tolerance,
        )
        return [LoadPath(replace(first, realisation=i)) for i in range(self.paths)]


@dataclass(frozen=True)
class SolverComparison:
    """All problems.

    cells: grids; loads: of the rough surfaces; residual: that each solver reaches; slow: a solve that takes longer is
    timed once [s]; scaling: grids on which our solver alone is measured; load_path: a sample of the work of Fig. 14.1;
    rolling, wheel: positions and steps a second of a wheel, by our own methods.
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
            SurfaceProblem(surface, load, n, periodic, self.seed, self.residual)
            for periodic, (surface, load), n in itertools.product((True, False), surfaces, self.cells)
        ]

    def scalings(self) -> list["GridScaling"]:
        """Our solver alone, along the cells of three problems."""
        problems = ((SPHERE, SPHERE_LOAD, False), (ROUGH, self.loads[-1], False), (ROUGH, self.loads[-1], True))
        return [
            GridScaling(SurfaceProblem(surface, load, n, periodic, self.seed, self.residual))
            for surface, load, periodic in problems
            for n in self.scaling
        ]


Solved = list[tuple[SurfaceProblem, Outcome]]


@dataclass(frozen=True)
class SolverComparisonResult:
    """Problems with their outcomes; the sample of Fig. 14.1 apart."""

    case: SolverComparison
    problems: Solved
    scalings: list[tuple[SurfaceProblem, Outcome]]
    load_path_problems: Solved
    load_paths: list[Outcome]
    rolling: Table
    wheel: Table
    began: float = 0.0

    @property
    def resumed(self) -> int:
        """Problems that an interrupted run had solved before."""
        return sum(float(outcome["time"]) < self.began for _, outcome in self.problems)


def run(case: SolverComparison, engine: Engine = SERIAL) -> SolverComparisonResult:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    began, limits = time.time(), RunLimits(slow=case.slow, enough=SETTLED)

    def solved(problems: list[SurfaceProblem]) -> Solved:
        outcomes = alone.map(time_problem, [TimedProblem(problem, limits, all_methods()) for problem in problems])
        return list(zip(problems, outcomes, strict=True))

    # a run that was interrupted goes on; one that is over is timed anew the next time
    with engine.timed() as alone:
        scalings = case.scalings()
        return SolverComparisonResult(
            case=case,
            problems=solved(case.problems()),
            scalings=[(s.problem, o) for s, o in zip(scalings, alone.map(measure_alone, scalings), strict=True)],
            load_path_problems=solved(case.load_path.problems(case.seed)),
            load_paths=alone.map(measure_alone, case.load_path.load_paths(case.seed)),
            rolling=rolling_throughput(case.rolling, alone),
            wheel=stepping_throughput(case.wheel, alone),
            began=began,
        )


def time_problem(timed: TimedProblem) -> Outcome:
    """All methods in processes of their own, with one thread, in turns.

    One row a method, solvers first, and models that are found: its name; status: "finished", or why not; seconds
    (median, fastest, slowest, runs), interval of the median, set-up seconds, residual reached, applications,
    differences to our solver, see `_differences`.
    """
    problem = timed.problem
    configurations = configurations_of(problem)
    timings = time_in_turns(configurations, timed.limits)
    by_name = {solver.name: Timing(NOT_INSTALLED, np.nan) for solver in SOLVERS}
    by_name |= dict(zip((each.label for each in configurations), timings, strict=True))
    rows = list(by_name.values())
    found = by_name[OUR_SOLVER].results
    ours = found[0].values["pressure"] if found else None
    whole = _of_the_contact(problem, ours) if problem.scene and ours is not None else {}
    return {
        "method": np.array(list(by_name)),
        "status": np.array([row.status for row in rows]),
        "seconds": np.array([_spread(row) for row in rows]),
        "interval": np.array([interval_of_median(_times(row)) for row in rows]),
        "setup": np.array([min(row.draws, default=np.nan) for row in rows]),
        "residual": np.array([_value(row, "residual") for row in rows]),
        "applications": np.array([row.results[0].work / problem.cells**2 if row.results else np.nan for row in rows]),
        "difference": np.array([_differences(row, ours, whole) for row in rows]),
        "time": np.array(time.time()),
        "area": np.array(np.nan if ours is None else np.count_nonzero(ours) / ours.size),
    }


def _times(row: Timing) -> list[float]:
    return row.seconds if row.status == FINISHED else [np.nan]


def _spread(row: Timing) -> tuple[float, float, float, int]:
    times = _times(row)
    return float(np.median(times)), min(times), max(times), len(times)


def _value(row: Timing, name: str) -> float:
    return float(np.mean(row.results[0].values.get(name, np.nan))) if row.results else np.nan


def _of_the_contact(problem: SurfaceProblem, pressure: FloatArray) -> Values:
    """What models may have of the contact of our solver."""
    half_space = bem3d.HalfSpace(shape=pressure.shape, spacing=1 / problem.cells, modulus=1.0)
    stiffness = bem3d.solve_fixed_area(half_space, pressure > 0).stiffness
    return {"stiffness": np.array(stiffness), "area": np.array(np.count_nonzero(pressure) / pressure.size)}


def _differences(row: Timing, ours: FloatArray | None, whole: Values) -> tuple[float, float, float, float]:
    """Of the pressure field in L2, of the force, of the area, of the stiffness, each relative to our solver."""
    if not row.results or ours is None:
        return (np.nan,) * 4
    pressure = row.results[0].values.get("pressure")
    if pressure is None:
        area, stiffness = (abs(_value(row, name) / float(whole[name]) - 1) for name in ("area", "stiffness"))
        return np.nan, np.nan, area, stiffness
    field = float(np.sqrt(((pressure - ours) ** 2).sum() / (ours**2).sum()))
    cells = np.count_nonzero(pressure > 1e-9 * pressure.max()) / np.count_nonzero(ours > 1e-9 * ours.max())
    return field, abs(float(pressure.sum() / ours.sum()) - 1), abs(cells - 1), np.nan


@dataclass(frozen=True)
class GridScaling:
    """Our solver alone on one grid."""

    problem: SurfaceProblem

    def measure(self) -> Outcome:
        """Seconds and peak memory of a solve, and the seconds of one application."""
        idle, problem = peak_memory(), self.problem
        height, spacing = problem.height(), 1 / problem.cells
        half_space = bem3d.HalfSpace(shape=height.shape, spacing=spacing, modulus=1.0, periodic=problem.periodic)

        def solve() -> bem3d.Contact:
            return bem3d.solve(half_space, -height, force=problem.load, tolerance=problem.residual)

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


@dataclass(frozen=True)
class LoadPath:
    """A whole load path with its stiffnesses."""

    surface: Surface

    def measure(self) -> Outcome:
        """Its seconds, and the operator applications of each contact."""
        outcome, seconds = timed(lambda: press_surface(self.surface))
        applications = outcome["applications"] + outcome["frozen applications"]
        return {"seconds": np.array(seconds), "applications": applications, "failed": outcome["failed"]}
