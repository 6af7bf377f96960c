"""The solver comparison: the same contact problems, the same residual, one thread each, solvers in turns."""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Table, table_of
from validation.analysis.printed import times_source
from validation.analysis.series import Margin, Series, single
from validation.analysis.statistics import Interval
from validation.analysis.study import Outcomes, Study
from validation.benchmarks.judging.discrete import ContactProblem, pressed
from validation.benchmarks.peers import (
    OUR_SOLVER,
    OURS,
    PeerSolver,
    all_methods,
    by_pressure,
    solvers_with,
)
from validation.benchmarks.timing import (
    FINISHED,
    Configuration,
    NamedMethod,
    TimedProblem,
    Timing,
    along,
    interval_of_median,
    time_in_turns,
)
from validation.engine.engine import SERIAL, Engine, FloatArray, Outcome
from validation.engine.random_numbers import random_generator
from validation.simulation.surface import draw_surface

SPHERE, ROUGH = "sphere", "rough"
SPHERE_LOAD = 4 / 3 / 4**3
"""The force of Hertz for a = L/4 and R = L, over E* L^2."""
ROUGH_HEIGHT = 0.01


@dataclass(frozen=True)
class SurfaceProblem:
    """A surface pressed on an n x n grid of unit side: a sphere with a = n/4 cells, or a self-affine surface.

    Rough: H = 0.7, from 2 pi/L to four cells a wave, rms height 0.01 L; load: F / (E* L^2); residual: that each solver
    reaches, see `bem3d.residual`; own: a file with other solvers.
    """

    surface: str
    load: float
    cells: int
    periodic: bool
    seed: int
    residual: float
    own: str = ""

    @property
    def solvers(self) -> tuple[PeerSolver, ...]:
        """Those that serve it."""
        return tuple(solver for solver in solvers_with(self.own) if self.half_space in solver.serves)

    @property
    def name(self) -> str:
        """Without its grid."""
        load = "" if self.surface == SPHERE else f", F = {self.load:g} E* L²"
        return f"{self.surface}{load}, {self.half_space}"

    @property
    def label(self) -> str:
        return f"{self.name}, {self.cells}²"

    @property
    def half_space(self) -> str:
        return "periodic" if self.periodic else "free"

    def height(self) -> FloatArray:
        """Positive towards the half-space [L]."""
        n = self.cells
        if self.surface == SPHERE:
            x = (np.arange(n) + 0.5) / n - 0.5
            return np.asarray(-(x[:, np.newaxis] ** 2 + x**2) / 2)
        band = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * n / 4, rms=ROUGH_HEIGHT)
        rng = random_generator(self.seed)
        return draw_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=rng, rms=ROUGH_HEIGHT)

    def discrete(self) -> ContactProblem:
        """In plain values, with the approach that belongs to its force."""
        side = 1 / self.cells
        known: dict[str, Any] = {
            "gap": -self.height(),
            "spacing": (side, side),
            "modulus": 1.0,
            "periodic": self.periodic,
        }
        problem = ContactProblem(name=self.name, force=self.load, **known)
        return replace(problem, approach=pressed(problem, 1e-10, force=self.load).approach)

    def configurations(self) -> tuple[Configuration, ...]:
        """Each solver that is installed, in a process of its own."""
        methods = [NamedMethod(solver.name, by_pressure, (solver,)) for solver in self.solvers if solver.version]
        sizes: dict[str, Any] = {"sizes": (self.cells,), "parameter": "# cells a side", "residual": self.residual}
        return tuple(each for by in methods for each in along(by, self, **sizes, worker=by.name))


NOT_INSTALLED, NOT_SERVED = "not installed", "not served"
PRESSURE, FORCE, AREA = (f"{what} difference to ours" for what in ("pressure", "force", "area"))
"""Relative, of the pressure field in L2."""


def time_problem(given: TimedProblem) -> Outcome:
    """All solvers in processes of their own, with one thread, in turns: a row each."""
    problem, configurations = given.problem, given.problem.configurations()
    rows = {solver.name: Timing(NOT_INSTALLED, math.nan) for solver in problem.solvers}
    rows |= zip((each.label for each in configurations), time_in_turns(configurations, given), strict=True)
    ours = rows[OUR_SOLVER].results[0].values["pressure"] if rows[OUR_SOLVER].results else None
    known = {"problem": problem.label, "surface": problem.surface, "half-space": problem.half_space}
    known |= {"name": problem.name, "cells": problem.cells}
    known |= {"area": math.nan if ours is None else np.count_nonzero(ours) / ours.size}
    found = [
        {**known, "solver": name, "status": row.status, **_row(row, problem.cells, ours)} for name, row in rows.items()
    ]
    return {name: np.array([row[name] for row in found]) for name in found[0]}


def _row(timing: Timing, cells: int, ours: FloatArray | None) -> dict[str, float]:
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
        "operator applications": result.work / cells**2 if result else math.nan,
        **dict.fromkeys((PRESSURE, FORCE, AREA), math.nan),
        **(_differences(result.values["pressure"], ours) if result and ours is not None else {}),
    }


def _differences(pressure: FloatArray, ours: FloatArray) -> dict[str, float]:
    cells = np.count_nonzero(pressure > 1e-9 * pressure.max()) / np.count_nonzero(ours > 1e-9 * ours.max())
    return {
        PRESSURE: float(np.sqrt(((pressure - ours) ** 2).sum() / (ours**2).sum())),
        FORCE: abs(float(pressure.sum() / ours.sum()) - 1),
        AREA: abs(cells - 1),
    }


SETTLED = 1.0
"""Seconds of runs after which the fewest are enough."""


@dataclass(frozen=True)
class SolverComparison:
    """All problems.

    cells: grids; loads: of the rough surfaces; residual: that each solver reaches; slow: a solve that takes longer is
    timed once [s]; own: a file with other solvers.
    """

    cells: tuple[int, ...] = (64, 128)
    loads: tuple[float, ...] = (0.001, 0.008)
    residual: float = 1e-8
    slow: float = 5.0
    seed: int = 20261121
    own: str = ""

    def problems(self) -> list[SurfaceProblem]:
        """Every surface in both half-spaces on every grid."""
        surfaces = [(SPHERE, SPHERE_LOAD), *((ROUGH, load) for load in self.loads)]
        kinds = itertools.product((True, False), surfaces, self.cells)
        return [self._problem(*surface, n, periodic) for periodic, surface, n in kinds]

    def _problem(self, surface: str, load: float, cells: int, periodic: bool) -> SurfaceProblem:
        return SurfaceProblem(surface, load, cells, periodic, self.seed, self.residual, self.own)


Row = Mapping[str, Any]
Rows = Sequence[Sequence[Row]]
"""Of each problem, those of all solvers."""


def run(case: SolverComparison, engine: Engine = SERIAL) -> Outcomes:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    given = [TimedProblem(problem=p, slow=case.slow, enough=SETTLED, methods=all_methods()) for p in case.problems()]
    # a run that was interrupted goes on; one that is over is timed anew the next time
    with engine.timed() as alone:
        rows = [rows_of(outcome) for outcome in alone.map(time_problem, given)]
    ours = [solver.name for solver in solvers_with("") if solver.package == OURS]
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
    ("pressure field, relative L2", PRESSURE, 1e-4, PRESSURES),
    ("force, relative", FORCE, 1e-6, FORCES),
    ("contact area, relative", AREA, 1e-3, AREAS),
)
"""The residual weighs gaps; pressures follow with the condition of the contact, areas by whole cells."""


def series(result: Outcomes) -> list[Series]:
    """Criteria for what must agree; times, none right or wrong."""
    finished = [_finished(rows) for rows in result["problems"]]
    return [*_agreement(finished, solvers_with(result.case.own)), *_speed(finished)]


def _finished(rows: Sequence[Row]) -> dict[str, Row]:
    """By the name of the solver."""
    return {row["solver"]: row for row in rows if row["status"] == FINISHED}


def _agreement(finished: Sequence[Mapping[str, Row]], solvers: Sequence[PeerSolver]) -> Iterator[Series]:
    """The largest difference to our answer over all runs that a solver has finished."""
    source = "the same discrete problem has one solution"
    for name in (solver.name for solver in solvers if solver.name != OUR_SOLVER):
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
    timed, solvers = result["problems"], solvers_with(result.case.own)
    versions = [{"solver": s.name, "mode": s.mode, "version": s.version or NOT_INSTALLED} for s in solvers]
    return (
        table_of("heats", list(itertools.chain(*timed))),
        _seconds(timed, [s.name for s in solvers]),
        table_of(PEERS, versions),
    )


def _seconds(solved: Rows, solvers: Sequence[str]) -> Table:
    known = [{"problem": rows[0]["problem"], "area": f"{rows[0]['area']:.1%}"} for rows in solved]
    said = [dict.fromkeys(solvers, NOT_SERVED) | {row["solver"]: _said(row) for row in rows} for rows in solved]
    return table_of(SECONDS, [mine | theirs for mine, theirs in zip(known, said, strict=True)])


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
        "as it is installed."
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
    full=SolverComparison(cells=(128, 256, 384)),
    run=run,
    study=STUDY,
    needs="–",
    timed=True,
)
