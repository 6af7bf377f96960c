"""The solver comparison: the same contact problems, the same residual, one thread each, solvers in turns."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Table, table_of
from validation.analysis.printed import times_source
from validation.analysis.series import Margin, Series, single
from validation.analysis.statistics import Interval
from validation.analysis.study import Outcomes, Study
from validation.benchmarks.peers import OUR_SOLVER, OURS, SOLVERS, all_methods
from validation.benchmarks.solvers import problems
from validation.benchmarks.solvers.problems import (
    ROUGH,
    SPHERE,
    SPHERE_LOAD,
    SurfaceProblem,
)
from validation.benchmarks.timing import FINISHED, TimedProblem
from validation.engine.engine import SERIAL, Engine, Outcome

SETTLED = 1.0
"""Seconds of runs after which the fewest are enough."""


@dataclass(frozen=True)
class SolverComparison:
    """All problems.

    cells: grids; loads: of the rough surfaces; residual: that each solver reaches; slow: a solve that takes longer is
    timed once [s].
    """

    cells: tuple[int, ...] = (64, 128)
    loads: tuple[float, ...] = (0.001, 0.008)
    residual: float = 1e-8
    slow: float = 5.0
    seed: int = 20261121

    def problems(self) -> list[SurfaceProblem]:
        """Every surface in both half-spaces on every grid."""
        surfaces = [(SPHERE, SPHERE_LOAD), *((ROUGH, load) for load in self.loads)]
        kinds = itertools.product((True, False), surfaces, self.cells)
        return [self._problem(*surface, n, periodic) for periodic, surface, n in kinds]

    def _problem(self, surface: str, load: float, cells: int, periodic: bool) -> SurfaceProblem:
        return SurfaceProblem(surface, load, cells, periodic, self.seed, self.residual)


Row = Mapping[str, Any]
Rows = Sequence[Sequence[Row]]
"""Of each problem, those of all solvers."""


def run(case: SolverComparison, engine: Engine = SERIAL) -> Outcomes:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""

    given = [TimedProblem(problem=p, slow=case.slow, enough=SETTLED, methods=all_methods()) for p in case.problems()]
    # a run that was interrupted goes on; one that is over is timed anew the next time
    with engine.timed() as alone:
        rows = [rows_of(outcome) for outcome in alone.map(problems.time_problem, given)]
    ours = [solver.name for solver in SOLVERS if solver.package == OURS]
    lost = [row for each in rows for row in each if row["solver"] in ours and row["status"] != FINISHED]
    said = tuple(f"{row['problem']}: {row['solver']} {row['status']}" for row in lost)
    return Outcomes(case, {"problems": rows}, said)


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


def series(result: Outcomes) -> list[Series]:
    """Criteria for what must agree; times, none right or wrong."""
    finished = [_finished(rows) for rows in result["problems"]]
    return [*_agreement(finished), *_speed(finished)]


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


SECONDS = "seconds: median (from the fastest to the slowest run)"
PEERS = "solvers"


def tables(result: Outcomes) -> tuple[Table, ...]:
    timed = result["problems"]
    versions = [{"solver": s.name, "mode": s.mode, "version": s.version or problems.NOT_INSTALLED} for s in SOLVERS]
    return (
        table_of("heats", list(itertools.chain(*timed))),
        _seconds(timed),
        table_of(PEERS, versions),
    )


def _seconds(solved: Rows) -> Table:
    solvers = dict.fromkeys((row["solver"] for rows in solved for row in rows), "")
    known = [{"problem": rows[0]["problem"], "area": f"{rows[0]['area']:.1%}"} for rows in solved]
    said = [{row["solver"]: _said(row) for row in rows} for rows in solved]
    return table_of(SECONDS, [mine | solvers | theirs for mine, theirs in zip(known, said, strict=True)])


def _said(row: Row) -> str:
    if row["status"] != FINISHED:
        return str(row["status"])
    median, fastest, slowest, setup = (row[name] for name in (MEDIAN, "fastest [s]", "slowest [s]", "set-up [s]"))
    return f"{median:.3g} s ({fastest:.3g} to {slowest:.3g}); set-up {setup:.2g} s"


STUDY = Study(
    title="Solver comparison: time to the same residual, one thread each",
    method=(
        "All solvers solve the same discrete problems, cold, to a residual of {c.residual:g} as this project defines "
        "it, from a fresh operator application on the returned pressure. Each has the loosest of its own tolerances "
        "that reaches this residual, and the force, or the approach of this force, as its interface requires. Each has "
        "a process with one thread, in turns; the time is the median of 5 to 15 runs, or one long run; the claim "
        "compares medians with intervals between order statistics. Set-up (operators, plans; ours with a whole first "
        "solve) is timed separately. Our applications are those on the finest grid or a window of it; our time "
        "includes the coarser grids. tamaas does not count applications. Fourier transforms are those of each package "
        "as it is installed. Contact models that have no pressure are listed with the difference of their stiffness."
    ),
    series=series,
    tables=tables,
    printed=(SECONDS, PEERS),
    matrices=(Matrix(name=SPEED, quantity=SPEED, rows=("problem",), columns="cells", printed=times_source),),
    claims=(
        Claim(quantity=SPEED, along="-cells", printed=times_source).saying(
            "Our solver is the fastest at the same residual.",
            short="Our solver is the fastest at the same residual",
        ),
    ),
    charts=(
        Chart("race").of(
            "Grids of {c.cells} cells a side. (a) Median time to the residual, bars from the fastest to the slowest "
            "run. (b) The same over the median of bem3d.solve."
        ),
    ),
)
CASE = Case(
    name="race",
    chapter=Chapter.SPEED,
    place=2,
    answers="Our solver beside other packages that are installed, same problems, same residual",
    quick=SolverComparison(),
    full=SolverComparison(cells=(128, 256, 512)),
    run=run,
    study=STUDY,
    needs="–",
    timed=True,
)
