"""The solver comparison: the same contact problems, the same residual, solvers in turns."""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from bem3d.threads import cores
from validation.analysis.case import Case, Chapter, Outcomes, Study
from validation.analysis.chart import Chart
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Table, table_of
from validation.analysis.number_text import times_source
from validation.analysis.quantity import Quantity
from validation.analysis.series import Margin, Series, single
from validation.analysis.statistics import Interval
from validation.benchmarks.peers import (
    OUR_SOLVER,
    OURS,
    PUBLISHED,
    PeerSolver,
    all_methods,
    solvers_with,
)
from validation.benchmarks.surface_problem import ROUGH, SPHERE, SPHERE_LOAD, SurfaceProblem
from validation.benchmarks.timing import (
    FINISHED,
    TimedProblem,
    Timing,
    interval_of_median,
    time_in_turns,
)
from validation.engine.engine import SERIAL, Engine, FloatArray, Outcome

NOT_INSTALLED, NOT_ASKED, TOO_LONG = "not installed", "not asked", "not timed: it would take minutes"
PRESSURE, FORCE, AREA = (f"{what} difference to ours" for what in ("pressure", "force", "area"))
"""Relative, of the pressure field in L2."""


def time_problem(timed: TimedProblem) -> Outcome:
    """All solvers in processes of their own, with one thread, in turns: a row each."""
    problem, configurations = timed.problem, timed.problem.configurations()
    rows = {solver.name: Timing(TOO_LONG if solver.version else NOT_INSTALLED, math.nan) for solver in problem.solvers}
    rows |= zip((each.label for each in configurations), time_in_turns(configurations, timed), strict=True)
    ours = rows[OUR_SOLVER].results[0].values["pressure"] if rows[OUR_SOLVER].results else None
    problem_columns = {"problem": problem.label, "surface": problem.surface, "half-space": problem.half_space}
    problem_columns |= {"name": problem.name, "cells": problem.cells}
    problem_columns |= {"area": math.nan if ours is None else np.count_nonzero(ours) / ours.size}
    table = [
        {**problem_columns, **_solver_columns(solver, rows[solver.name]), **_timing_columns(rows[solver.name], ours)}
        for solver in problem.solvers
    ]
    return {name: np.array([row[name] for row in table]) for name in table[0]}


def _solver_columns(solver: PeerSolver, timing: Timing) -> dict[str, str]:
    """Return the columns that name a solver; alone: the same with one thread, empty where it has no more."""
    return {
        "solver": solver.name,
        "package": solver.file or solver.package,
        "alone": solver.alone,
        "status": timing.status,
    }


def _timing_columns(timing: Timing, ours: FloatArray | None) -> dict[str, float]:
    """Return the columns that the clock fills: times [s], residual, work and differences, NaN where the solver has
    none."""
    seconds, result = (timing.seconds, timing.results[0]) if timing.status == FINISHED else ([math.nan], None)
    low, high = interval_of_median(seconds)
    return {
        "median [s]": float(np.median(seconds)),
        "fastest [s]": min(seconds),
        "slowest [s]": max(seconds),
        "runs": len(seconds),
        "low [s]": low,
        "high [s]": high,
        "set-up [s]": min(timing.draws, default=math.nan),
        "residual": float(result.values["residual"]) if result else math.nan,
        "operator applications": result.work / result.values["pressure"].size if result else math.nan,
        **dict.fromkeys((PRESSURE, FORCE, AREA), math.nan),
        **(_differences(result.values["pressure"], ours) if result and ours is not None else {}),
    }


def _differences(pressure: FloatArray, ours: FloatArray) -> dict[str, float]:
    """Return relative differences of pressure (L2), force and contact area to those of our solver."""
    cells = np.count_nonzero(pressure > 1e-9 * pressure.max()) / np.count_nonzero(ours > 1e-9 * ours.max())
    return {
        PRESSURE: float(np.sqrt(((pressure - ours) ** 2).sum() / (ours**2).sum())),
        FORCE: abs(float(pressure.sum() / ours.sum()) - 1),
        AREA: abs(cells - 1),
    }


SETTLED = 1.0
"""Seconds of runs after which the fewest are enough."""
PATIENCE = 20.0
"""Seconds of a solve at the most, as that on the grid before lets expect: a solver is timed in several of them."""


@dataclass(frozen=True)
class SolverComparison:
    """All problems.

    cells: grids; loads: of the rough surfaces; large: grids of the lightest of them alone, with threads; residual: that
    each solver reaches; slow: a solve that takes longer is timed once [s]; own: a file with other solvers.
    """

    cells: tuple[int, ...] = (64, 128)
    loads: tuple[float, ...] = (0.001, 0.008)
    large: tuple[int, ...] = ()
    residual: float = 1e-8
    slow: float = 5.0
    seed: int = 20261121
    own: str = ""

    def problems(self) -> list[SurfaceProblem]:
        """Every surface on every grid, in both half-spaces, or in those that a solver of the file serves."""
        served = {kind for solver in solvers_with(self.own) if solver.file == self.own for kind in solver.serves}
        surfaces = [(SPHERE, SPHERE_LOAD), *((ROUGH, load) for load in self.loads)]
        kinds = itertools.product((True, False), surfaces, self.cells)
        small = [self._problem(*surface, n, periodic) for periodic, surface, n in kinds]
        grids = itertools.product((True, False), self.large)
        large = [self._problem(ROUGH, self.loads[0], n, periodic, cores()) for periodic, n in grids]
        return [problem for problem in (*small, *large) if problem.half_space in served]

    def _problem(self, surface: str, load: float, cells: int, periodic: bool, threads: int = 1) -> SurfaceProblem:
        return SurfaceProblem(surface, load, cells, periodic, self.seed, self.residual, self.own, threads)


Row = Mapping[str, Any]
Rows = Sequence[Sequence[Row]]
"""Of each problem, those of all solvers."""


def run(case: SolverComparison, engine: Engine = SERIAL) -> Outcomes:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    settings: dict[str, Any] = {"slow": case.slow, "enough": SETTLED, "methods": all_methods()}
    rows: list[list[Row]] = []
    # a run that was interrupted goes on; one that is over is timed anew the next time
    with engine.timed() as alone:
        for problem in case.problems():
            timed = TimedProblem(problem=replace(problem, left_out=too_slow(problem, rows)), **settings)
            rows.extend(rows_of(outcome) for outcome in alone.map(time_problem, [timed]))
    ours = [solver.name for solver in solvers_with("") if solver.package == OURS]
    lost = [row for each in rows for row in each if row["solver"] in ours and row["status"] not in (FINISHED, TOO_LONG)]
    failures = tuple(f"{row['problem']}: {row['solver']} {row['status']}" for row in lost)
    return Outcomes(case, {"problems": rows}, failures)


def too_slow(problem: SurfaceProblem, row_sets: "Rows") -> tuple[str, ...]:
    """Solvers of which a solve on the largest grid before, times the cells, takes longer than the patience."""
    earlier = [row for rows in row_sets for row in rows if row["name"] == problem.name and row["cells"] < problem.cells]
    last = max((row["cells"] for row in earlier), default=0)
    rows_of_grid = {row["solver"]: row for row in earlier if row["cells"] == last}
    # with threads for the first time, it takes as long as without, at the most
    rows = {solver.name: rows_of_grid.get(solver.name, rows_of_grid.get(solver.alone)) for solver in problem.solvers}
    return tuple(
        name for name, row in rows.items() if row and _expected_seconds(row) * (problem.cells / last) ** 2 > PATIENCE
    )


def _expected_seconds(row: "Row") -> float:
    """Return the median time of a solve [s]; infinite where the solver was left out as too slow, zero where it
    failed."""
    return math.inf if row["status"] == TOO_LONG else float(row[MEDIAN]) if row["status"] == FINISHED else 0.0


def rows_of(outcome: Outcome) -> list[Row]:
    """Return the table of an outcome as one row for each solver."""
    columns = (column.tolist() for column in outcome.values())
    return [dict(zip(outcome, row, strict=True)) for row in zip(*columns, strict=True)]


ALGORITHM = Quantity("time_over_that_of_Polonsky-Keer_on_the_same_operator")
IMPLEMENTATION = Quantity("time_over_that_of_the_fastest_other_package")
MEDIAN, APPLICATIONS = "median [s]", "operator applications"
DIFFERENCE = "{}, difference to bem3d.solve"
FASTER = Margin(1.0, "above one the other solver is faster")
PRESSURES = "1e4 times the residual: the conditioning of the contact on fine grids"
FORCES = "100 times the residual: zero where the force is prescribed, by the stiffness elsewhere"
AREAS = "single cells of vanishing pressure may be in or out of contact"
AGREEMENT = (
    ("pressure field, relative L2", PRESSURE, 1e-4, PRESSURES),
    ("force, relative", FORCE, 1e-6, FORCES),
    ("contact area, relative", AREA, 1e-3, AREAS),
)
"""The residual weighs gaps; pressures follow with the condition of the contact, areas by whole cells."""


def series(result: Outcomes) -> list[Series]:
    """Criteria for what must agree; times, none right or wrong."""
    finished = [_finished_by_solver(rows) for rows in result["problems"]]
    return [*_difference_series(finished, solvers_with(result.case.own)), *_speed_series(finished)]


def _finished_by_solver(rows: Sequence[Row]) -> dict[str, Row]:
    """Return the rows of solvers that have finished, by the solver's name."""
    return {row["solver"]: row for row in rows if row["status"] == FINISHED}


def _difference_series(finished: Sequence[Mapping[str, Row]], solvers: Sequence[PeerSolver]) -> Iterator[Series]:
    """Yield the largest difference to our answer over all runs that a solver has finished."""
    source = "the same discrete problem has one solution"
    for name in (solver.name for solver in solvers if solver.name != OUR_SOLVER):
        done = [rows[name] for rows in finished if {name, OUR_SOLVER} <= rows.keys()]
        if done:
            for what, key, tolerance, reason in AGREEMENT:
                value, at = max(row[key] for row in done), {"problems": len(done)}
                yield single(DIFFERENCE.format(what), name, value, tolerance, source, reason, where=at)


def _speed_series(finished: Sequence[Mapping[str, Row]]) -> Iterator[Series]:
    """Yield the time of our algorithm over that of Polonsky and Keer on our operator, and over the fastest package.

    One thread each. Only the first ratio has the same transforms on both sides.
    """
    for rows in finished:
        packages = [row for row in rows.values() if row["package"] != OURS and not row["alone"]]
        fastest = min(packages, key=lambda row: float(row[MEDIAN]), default=None)
        for quantity, rival in ((ALGORITHM, rows.get(PUBLISHED)), (IMPLEMENTATION, fastest)):
            ours = rows.get(OUR_SOLVER)
            if ours and rival:
                at = {"problem": ours["name"], "cells": ours["cells"]}
                margin = replace(FASTER, source=rival["solver"])
                yield Series(quantity, OUR_SOLVER, (time_ratio(ours, rival),), where=at, margin=margin)


def time_ratio(numerator: Row, denominator: Row) -> Interval:
    """Ratio of medians; the interval spans the ratios of all order statistics that bound the two medians."""
    ratio = float(numerator[MEDIAN] / denominator[MEDIAN])
    low, high = numerator["low [s]"] / denominator["high [s]"], numerator["high [s]"] / denominator["low [s]"]
    return Interval(ratio, float(max(high - ratio, ratio - low)))


SECONDS = Quantity(
    "seconds_median_from_the_fastest_to_the_slowest_run",
    "seconds: median (from the fastest to the slowest run); operator applications",
)
PEERS = "solvers"
SAME_OPERATOR = Quantity("Polonsky-Keer_over_bem3d_on_the_same_operator")


def tables(result: Outcomes) -> tuple[Table, ...]:
    timed, solvers = result["problems"], solvers_with(result.case.own)
    pairs = [row for rows in timed for row in _same_operator_rows(_finished_by_solver(rows))]
    versions = [{"solver": s.name, "mode": s.mode, "version": s.build or NOT_INSTALLED} for s in solvers]
    return (
        table_of("heats", list(itertools.chain(*timed))),
        table_of(SAME_OPERATOR, pairs) if pairs else Table(SAME_OPERATOR, {"problem": []}),
        _seconds_table(timed, list(dict.fromkeys(row["solver"] for row in itertools.chain(*timed)))),
        table_of(PEERS, versions),
    )


def _same_operator_rows(rows: Mapping[str, Row]) -> Iterator[dict[str, object]]:
    """Yield what the published iteration takes, over ours: time with its interval, and operator applications."""
    if {OUR_SOLVER, PUBLISHED} <= rows.keys():
        ours, published = rows[OUR_SOLVER], rows[PUBLISHED]
        time = time_ratio(published, ours)
        yield {
            "problem": ours["problem"],
            "times the seconds": time.value,
            "from": published["low [s]"] / ours["high [s]"],
            "to": published["high [s]"] / ours["low [s]"],
            "applications, bem3d": ours[APPLICATIONS],
            "applications, Polonsky-Keer": published[APPLICATIONS],
            "times the applications": published[APPLICATIONS] / ours[APPLICATIONS],
        }


def _seconds_table(solved: Rows, solvers: Sequence[str]) -> Table:
    """Return a row for each problem and a column for each solver, whose cells are texts."""
    problem_columns = [{"problem": rows[0]["problem"], "area": f"{rows[0]['area']:.1%}"} for rows in solved]
    time_columns = [
        dict.fromkeys(solvers, NOT_ASKED) | {row["solver"]: _time_text(row) for row in rows} for rows in solved
    ]
    return table_of(SECONDS, [problem | times for problem, times in zip(problem_columns, time_columns, strict=True)])


def _time_text(row: Row) -> str:
    """Return median, range and set-up time [s] of a row with its operator applications, or why it has none."""
    if row["status"] != FINISHED:
        return str(row["status"])
    median, fastest, slowest, setup = (row[name] for name in (MEDIAN, "fastest [s]", "slowest [s]", "set-up [s]"))
    counted = f"; {row[APPLICATIONS]:.3g} applications" if math.isfinite(row[APPLICATIONS]) else ""
    return f"{median:.3g} s ({fastest:.3g} to {slowest:.3g}){counted}; set-up {setup:.2g} s"


STUDY = Study(
    title="Solver comparison: time to the same residual",
    method=(
        "All solvers solve the same discrete problems, cold, to a residual of {c.residual:g} as this project defines "
        "it, from a fresh operator application on the returned pressure. Each has the loosest of its own tolerances "
        "that reaches this residual, and the force, or the approach of this force, as its interface requires. Each has "
        "a process, in turns, with one thread; on large grids those that have threads also run with one for each core, "
        f"and a solve that would take longer than {PATIENCE:g} s is left out. The time is the median of 5 to 15 "
        "runs, or one long run; claims compare medians of one thread with intervals between order statistics. Set-up "
        "(operators, plans; ours with a whole first solve) is timed separately. Two questions stay apart. The "
        "algorithm: bem3d.solve relative to the iteration of Polonsky and Keer, both on the operator of bem3d. The "
        "implementation: relative to other packages, whose Fourier transforms are those of each as it is installed; "
        "the wheel of tamaas has the backend cpp, without threads, and transforms without SIMD instructions. "
        "Applications of the operator are those on the finest grid, a window of it counted as a whole; our own include "
        "those on coarser grids, by their cells. tamaas does not count applications."
    ),
    series=series,
    tables=tables,
    printed=(SAME_OPERATOR, SECONDS, PEERS),
    matrices=tuple(
        Matrix(name=ratio, quantity=ratio, rows=("problem",), columns="cells", printed=times_source)
        for ratio in (ALGORITHM, IMPLEMENTATION)
    ),
    claims=(
        Claim(quantity=ALGORITHM, along="-cells", printed=times_source).saying(
            "On the same operator our solver takes less time than the iteration of Polonsky and Keer.",
            short="Our solver is faster than the iteration of Polonsky and Keer on the same operator",
            key="algorithm",
        ),
        Claim(quantity=IMPLEMENTATION, along="-cells", printed=times_source).saying(
            "Our implementation is the fastest of the packages at the same residual.",
            short="Our implementation is the fastest of the packages at the same residual",
            key="fastest",
        ),
    ),
    charts=(
        Chart("race").of(
            "Grids of {c.cells} cells a side, and larger ones. (a) Median time to the residual, bars from the fastest "
            "to the slowest run. (b) Operator applications, of solvers that count them. (c) Median time relative to "
            "that of bem3d.solve: the algorithm alone where the operator is the same (Polonsky-Keer), algorithm and "
            "implementation elsewhere. (d) Median time as a function of the cells of the lighter rough surface in free "
            "space, and the exponent of a straight line."
        ),
    ),
)
CASE = Case(
    name="race",
    chapter=Chapter.SPEED,
    place=2,
    answers="Our solver beside other packages that are installed, same problems, same residual",
    quick=SolverComparison(cells=(128,), loads=(0.001,)),
    full=SolverComparison(cells=(128, 384), large=(1024, 2048), slow=2.0),
    run=run,
    study=STUDY,
    needs="–",
    timed=True,
)
