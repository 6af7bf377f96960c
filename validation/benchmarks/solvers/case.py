"""The solver comparison: the same contact problems, the same residual, one thread each, solvers in turns."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from validation.analysis.evidence import Table, table_of
from validation.analysis.series import Margin, Series, single
from validation.analysis.statistics import Interval
from validation.analysis.study import Outcomes
from validation.benchmarks.isolation import measure_alone
from validation.benchmarks.peers import OUR_SOLVER, OURS, SOLVERS, all_methods
from validation.benchmarks.solvers import problems
from validation.benchmarks.solvers.problems import (
    MEMORY,
    PUNCH,
    ROUGH,
    SOLVE,
    SPHERE,
    SPHERE_LOAD,
    LoadPath,
    SurfaceProblem,
    punch,
)
from validation.benchmarks.solvers.throughput import RollingThroughput, SteppingThroughput
from validation.benchmarks.timing import FINISHED, TimedProblem
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import Surface

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

    def load_paths(self, seed: int) -> list[LoadPath]:
        rough, forces = punch(self.cells, seed), self.forces
        first = Surface(roughness=rough, realisation=0, cells=self.cells, forces=forces, tolerance=self.tolerance)
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
        kinds = itertools.product((True, False), surfaces, self.cells)
        return [self._problem(*surface, n, periodic) for periodic, surface, n in kinds]

    def scalings(self) -> list[SurfaceProblem]:
        """For our solver alone, along the cells of three problems."""
        chosen = ((SPHERE, SPHERE_LOAD, False), (ROUGH, self.loads[-1], False), (ROUGH, self.loads[-1], True))
        return [self._problem(kind, load, n, periodic) for kind, load, periodic in chosen for n in self.scaling]

    def _problem(self, surface: str, load: float, cells: int, periodic: bool) -> SurfaceProblem:
        return SurfaceProblem(surface, load, cells, periodic, self.seed, self.residual)


Row = Mapping[str, Any]
Rows = Sequence[Sequence[Row]]
"""Of each problem, those of all solvers."""


def run(case: SolverComparison, engine: Engine = SERIAL) -> Outcomes:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""

    def solved(some: Sequence[SurfaceProblem]) -> Rows:
        given = [TimedProblem(problem=p, slow=case.slow, enough=SETTLED, methods=all_methods()) for p in some]
        return [rows_of(outcome) for outcome in alone.map(problems.time_problem, given)]

    # a run that was interrupted goes on; one that is over is timed anew the next time
    with engine.timed() as alone:
        rows, scalings = solved(case.problems()), case.scalings()
        found = {
            "problems": rows,
            "scalings": list(zip(scalings, alone.map(measure_alone, scalings), strict=True)),
            "loads": solved(case.load_path.problems(case.seed)),
            "load paths": alone.map(measure_alone, case.load_path.load_paths(case.seed)),
            "rolling": alone.map(measure_alone, case.rolling.rolls()),
            "wheel": alone.map(measure_alone, case.wheel.problems()),
        }
    ours = [solver.name for solver in SOLVERS if solver.package == OURS]
    lost = (row for each in rows for row in each if row["solver"] in ours and row["status"] != FINISHED)
    return Outcomes(case, found, tuple(f"{row['problem']}: {row['solver']} {row['status']}" for row in lost))


def rows_of(outcome: Outcome) -> list[Row]:
    """A row a solver."""
    columns = (column.tolist() for column in outcome.values())
    return [dict(zip(outcome, row, strict=True)) for row in zip(*columns, strict=True)]


SPEED, MEDIAN, APPLICATIONS = "time over that of the fastest other solver", "median [s]", "operator applications"
DIFFERENCE = "{}, difference to bem3d.solve"
FASTER = Margin(1.0, "above one another solver is faster")
PRESSURES = "1e4 times the residual: the conditioning of the contact on fine grids"
FORCES = "100 times the residual: zero where the force is prescribed, by the stiffness elsewhere"
AREAS = "single cells of vanishing pressure may be in or out of contact"
AGREEMENT = (
    ("pressure field, relative L2", problems.PRESSURE, 1e-4, PRESSURES),
    ("force, relative", problems.FORCE, 1e-6, FORCES),
    ("contact area, relative", problems.AREA, 1e-3, AREAS),
)
"""The residual weighs gaps; pressures follow with the condition of the contact, areas by whole cells."""
CELLS, GUIDE, LARGE = "cells along a side, n", "n² log n", 512
EXPONENT = f"exponent of n from {LARGE} cells on"
SPRINGS = "springs to a contact radius, a / dx"
WORK, ROLLED = "seconds of a contact of Fig. 14.1", "a rolling wheel"


def series(result: Outcomes) -> list[Series]:
    """Criteria for what must agree; times, none right or wrong; how time and memory grow."""
    finished = [_finished(rows) for rows in result["problems"]]
    steps = _steps(result.case.wheel, result["wheel"])
    return [*_agreement(finished), *_speed(finished), *_work(result), *_growth(result["scalings"]), *steps]


def _finished(rows: Sequence[Row]) -> dict[str, Row]:
    """By the name of the solver; contact models, which have no pressure, are none."""
    names = [solver.name for solver in SOLVERS]
    return {row["solver"]: row for row in rows if row["status"] == FINISHED and row["solver"] in names}


def _agreement(finished: Sequence[Mapping[str, Row]]) -> Iterator[Series]:
    """The largest difference to our answer over all runs that a solver has finished."""
    source = "the same discrete problem has one solution"
    for name in (solver.name for solver in SOLVERS if solver.name != OUR_SOLVER):
        done = [rows[name] for rows in finished if {name, OUR_SOLVER} <= rows.keys()]
        if done:
            for what, key, tolerance, reason in AGREEMENT:
                value, at = max(row[key] for row in done), {"problems": len(done)}
                yield single(DIFFERENCE.format(what), name, value, tolerance, source, reason, where=at)


def _speed(finished: Sequence[Mapping[str, Row]]) -> Iterator[Series]:
    """Our time over that of the fastest other solver, for each problem."""
    for rows in finished:
        rivals = [row for name, row in rows.items() if name != OUR_SOLVER]
        if OUR_SOLVER in rows and rivals:
            ours, rival = rows[OUR_SOLVER], min(rivals, key=lambda row: float(row[MEDIAN]))
            ratio = ours[MEDIAN] / rival[MEDIAN]
            half = max(ours["high [s]"] / rival["low [s]"] - ratio, ratio - ours["low [s]"] / rival["high [s]"])
            at, margin = {"problem": ours["name"], "cells": ours["cells"]}, replace(FASTER, source=rival["solver"])
            yield Series(SPEED, OUR_SOLVER, (Interval(ratio, half),), where=at, margin=margin)


def _work(result: Outcomes) -> Iterator[Series]:
    """With its stiffness along a load path by our solver; of a cold solve without it by each."""
    ours = np.mean([path["seconds"] for path in result["load paths"]]) / len(result.case.load_path.forces)
    yield Series(WORK, f"{OUR_SOLVER}, along the path, with stiffness", (float(ours),))
    finished = [_finished(rows) for rows in result["loads"]]
    for name in (solver.name for solver in SOLVERS if all(solver.name in rows for rows in finished)):
        yield Series(WORK, f"{name}, cold", (float(np.mean([rows[name][MEDIAN] for rows in finished])),))


def _measured(outcomes: Sequence[Outcome], model: str, **settings: Any) -> list[Series]:
    """A series of each value that they have."""
    return [Series(name, model, np.array([float(o[name]) for o in outcomes]), **settings) for name in outcomes[0]]


def _growth(scalings: Sequence[tuple[SurfaceProblem, Outcome]]) -> Iterator[Series]:
    """Of our solver alone; exponents where there are grids enough to fit them."""
    for problem, group in itertools.groupby(scalings, key=lambda pair: f"{pair[0].surface}, {pair[0].half_space}"):
        pairs, at = list(group), {"problem": problem}
        n = np.array([each.cells for each, _ in pairs], dtype=float)
        ours = _measured([outcome for _, outcome in pairs], OUR_SOLVER, where=at, along=CELLS, at=n)
        known = {one.quantity: np.asarray(one.found) for one in ours}
        guide, large = n**2 * np.log(n), n >= LARGE
        yield from (*ours, Series(SOLVE, GUIDE, known[SOLVE][-1] * guide / guide[-1], where=at, along=CELLS, at=n))
        if np.count_nonzero(large) > 2:
            for name, y in ((SOLVE, known[SOLVE]), (MEMORY, known[MEMORY]), (GUIDE, guide)):
                yield Series(EXPONENT, name, np.polyfit(np.log(n[large]), np.log(y[large]), 1)[:1], where=at)


def _steps(wheel: SteppingThroughput, outcomes: Sequence[Outcome]) -> list[Series]:
    n, at = len(wheel.springs), np.array(wheel.springs, dtype=float)
    return [
        one
        for i, height in enumerate(wheel.heights)
        for one in _measured(outcomes[i * n : (i + 1) * n], "springs", where={"h0/d": height}, along=SPRINGS, at=at)
    ]


SECONDS = "seconds: median (from the fastest to the slowest run)"
LOADS, PEERS = "seconds at some of the loads of Fig. 14.1", "solvers"


def tables(result: Outcomes) -> tuple[Table, ...]:
    timed, loads = result["problems"], result["loads"]
    rolled = zip(result.case.rolling.heights, result["rolling"], strict=True)
    versions = [{"solver": s.name, "mode": s.mode, "version": s.version or problems.NOT_INSTALLED} for s in SOLVERS]
    return (
        table_of("heats", list(itertools.chain(*timed))),
        table_of("errand", list(itertools.chain(*loads))),
        _seconds(SECONDS, timed),
        _seconds(LOADS, loads),
        table_of(ROLLED, [{"h/d": h, **{name: float(x) for name, x in o.items()}} for h, o in rolled]),
        table_of(PEERS, versions),
    )


def _seconds(name: str, solved: Rows) -> Table:
    solvers = dict.fromkeys((row["solver"] for rows in solved for row in rows), "")
    known = [{"problem": rows[0]["problem"], "area": f"{rows[0]['area']:.1%}"} for rows in solved]
    said = [{row["solver"]: _said(row) for row in rows} for rows in solved]
    return table_of(name, [mine | solvers | theirs for mine, theirs in zip(known, said, strict=True)])


def _said(row: Row) -> str:
    if row["status"] != FINISHED:
        return str(row["status"])
    median, fastest, slowest, setup = (row[name] for name in (MEDIAN, "fastest [s]", "slowest [s]", "set-up [s]"))
    return f"{median:.3g} s ({fastest:.3g} to {slowest:.3g}); set-up {setup:.2g} s"
