"""What the solver comparison shows: times to equal residual, agreement, and how time and memory grow."""

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Table, table_of
from validation.benchmarks.peers import OUR_SOLVER, OURS, PUBLISHED, SOLVERS, place_of
from validation.benchmarks.solvers.case import (
    LoadPathWorkload,
    Solved,
    SolverComparison,
    SolverComparisonResult,
    run,
)
from validation.benchmarks.solvers.claims import CLAIM, claims_of, headline, speed_numbers
from validation.benchmarks.solvers.rolling import RollingThroughput
from validation.benchmarks.solvers.wheel_steps import SteppingThroughput
from validation.benchmarks.timing import FINISHED

# the residual weighs gaps; pressures follow with the condition of the contact, areas by whole cells
AGREEMENT = (
    ("pressure field, relative L2", 1e-4, "1e4 times the residual: the conditioning of the contact on fine grids"),
    ("force, relative", 1e-6, "100 times the residual: zero where the force is prescribed, by the stiffness elsewhere"),
    ("contact area, relative", 1e-3, "single cells of vanishing pressure may be in or out of contact"),
)
RATIO = "solve / (applications x one on the whole grid)"


def evidence(result: SolverComparisonResult) -> Evidence:
    """Numbers for what must agree; the times as tables and conclusions, since no time is right or wrong."""
    cells = " and ".join(f"{n}²" for n in result.case.cells)
    speed, agreement = speed_numbers(result), tuple(_agreement(result))
    return Evidence(
        title="Solver comparison: time to the same residual, one thread each",
        method=(
            f"All solvers solve the same discrete problems, cold, to a residual of {result.case.residual:g} as this "
            "project defines it, from a fresh operator application on the returned pressure. Each has the loosest of "
            "its own tolerances that reaches this residual, and the force, or the approach of this force, as its "
            "interface requires. Each has a process with one thread, in turns; the time is the median of 5 to 15 runs, "
            "or one long run; the claim compares medians with intervals between order statistics. Set-up (operators, "
            "plans; ours with a whole first solve) is timed separately. Our applications are those on the finest grid "
            "or a window of it; our time includes the coarser grids. tamaas does not count applications. Fourier "
            "transforms are those of each package as it is installed. Contact models that have no pressure are listed "
            "with the difference of their stiffness. "
            + "; ".join(f"{s.name}: {s.mode} ({s.version or 'not installed'})" for s in SOLVERS)
            + "."
        ),
        numbers=(*agreement, *speed),
        claims=claims_of(result, speed, agreement),
        finding=f"{headline(speed)}." if speed else "",
        headlines=({"race": headline(speed)} if speed else {}) | {"race-wheel": _over_plain_sums(result.wheel)},
        tables=(
            _runs(result.problems, "heats"),
            _scaling(result),
            _runs(result.load_path_problems, "errand"),
            result.wheel,
        ),
        page_tables=(
            _times(result.problems, "Seconds"),
            _times(result.load_path_problems, "Times at some of the loads of Fig. 14.1"),
            result.rolling,
        ),
        conclusions=tuple(_conclusions(result)),
        captions={
            "race": (
                f"On {cells} cells. (a) Median time to the residual, bars from the fastest to the slowest run. (b) Our "
                "solver alone against the cells along a side: time of a solve, and n² log n through the largest rough "
                "one in free space. (c) As (a), over the median of bem3d.solve. (d) Peak memory of its process, less "
                "that of an idle one."
            ),
            "race-wheel": (
                f"A dynamic wheel on springs, {result.case.wheel.wheels} in a batch on one core: steps of one wheel a "
                "second against the springs to a contact radius, by roughness h₀/d. Filled: as simulated; open: plain "
                "sums over all springs."
            ),
        },
        unconverged=tuple(
            f"{problem.label}: {solver.name} {outcome['status'][i]}"
            for problem, outcome in result.problems
            for i, solver in enumerate(SOLVERS)
            if solver.package == OURS and outcome["status"][i] != FINISHED
        ),
    )


COLUMNS = (
    ("seconds", 0, "median [s]"),
    ("seconds", 1, "fastest [s]"),
    ("seconds", 2, "slowest [s]"),
    ("seconds", 3, "runs"),
    ("setup", None, "set-up [s]"),
    ("residual", None, "residual"),
    ("applications", None, "operator applications"),
    ("difference", 0, "pressure difference to ours, L2"),
    ("difference", 1, "force difference to ours"),
    ("difference", 2, "area difference to ours"),
    ("difference", 3, "stiffness difference to ours"),
)
"""Of an outcome: its name, its column, and its title in a table."""


def _runs(solved: Solved, name_of_table: str) -> Table:
    rows = [
        {
            "problem": problem.label,
            "surface": problem.surface,
            "half-space": problem.half_space,
            "cells": problem.cells,
            "area": float(outcome["area"]),
            "solver": str(name),
            "status": str(outcome["status"][i]),
            **{title: float(outcome[key][i] if c is None else outcome[key][i, c]) for key, c, title in COLUMNS},
        }
        for problem, outcome in solved
        for i, name in enumerate(outcome["method"])
    ]
    return table_of(name_of_table, rows)


def _times(solved: Solved, title: str) -> Table:
    """Seconds as they stand on the page: median, from the fastest to the slowest, and set-up."""
    names = dict.fromkeys(str(name) for _, outcome in solved for name in outcome["method"])
    rows = []
    for problem, outcome in solved:
        row = {"problem": problem.label, "area": f"{float(outcome['area']):.1%}", **dict.fromkeys(names, "")}
        for i, name in enumerate(outcome["method"]):
            median, fastest, slowest, _ = outcome["seconds"][i]
            times = f"{median:.3g} s ({fastest:.3g} to {slowest:.3g}); set-up {outcome['setup'][i]:.2g} s"
            row[str(name)] = times if outcome["status"][i] == FINISHED else str(outcome["status"][i])
        rows.append(row)
    return table_of(f"{title}: median (from the fastest to the slowest run)", rows)


def _scaling(result: SolverComparisonResult) -> Table:
    rows = [
        {
            "problem": f"{problem.surface}, {problem.half_space}",
            "cells": problem.cells,
            "solve [s]": float(outcome["seconds"]),
            "first solve, with plans [s]": float(outcome["first"]),
            "one application on the whole grid [s]": float(outcome["application"]),
            "operator applications": int(outcome["applications"]),
            "on coarser grids": int(outcome["coarse"]),
            RATIO: float(outcome["seconds"] / (outcome["applications"] * outcome["application"])),
            "peak memory less start [MiB]": float((outcome["peak"] - outcome["idle"]) / 2**20),
            "peak memory [MiB]": float(outcome["peak"] / 2**20),
        }
        for problem, outcome in result.scalings
    ]
    return table_of("scaling", rows)


def _agreement(result: SolverComparisonResult) -> list[Number]:
    """The largest difference to our answer over all runs that a solver has finished."""
    numbers, us = [], place_of(OUR_SOLVER)
    for i, solver in enumerate(SOLVERS):
        done = [o["difference"][i] for _, o in result.problems if o["status"][i] == o["status"][us] == FINISHED]
        if not done or i == us:
            continue
        for column, (what, tolerance, reason) in enumerate(AGREEMENT):
            numbers.append(
                Number(
                    quantity=f"{what}, difference to bem3d.solve",
                    model=solver.name,
                    where={"problems": len(done)},
                    value=float(np.max([row[column] for row in done])),
                    reference=0.0,
                    source="the same discrete problem has one solution",
                    tolerance=tolerance,
                    reason=reason,
                )
            )
    return numbers


def _conclusions(result: SolverComparisonResult) -> list[str]:
    against = ("the fastest peer", _others()), ("the iteration of Polonsky and Keer", [place_of(PUBLISHED)])
    sentences = [_standing(result, periodic, *some) for periodic in (True, False) for some in against]
    sentences += [
        f"Not finished: {problem.label}: {SOLVERS[i].name} {outcome['status'][i]}."
        for problem, outcome in (*result.problems, *result.load_path_problems)
        for i in _others()
        if outcome["status"][i].startswith("failed")
    ]
    if result.resumed:
        sentences.append(
            f"{result.resumed} of {len(result.problems)} problems were solved before this run was interrupted."
        )
    sentences += [_work(result), _rolled(result)]
    table = _scaling(result)
    problems = list(dict.fromkeys(table["problem"].tolist()))
    return sentences + [_growth(problem, table.where(problem=problem)) for problem in problems]


def _work(result: SolverComparisonResult) -> str:
    """What a contact of Fig. 14.1 costs us, and what it would cost the fastest peer."""
    load_path, cold_solves = result.case.load_path, [outcome for _, outcome in result.load_path_problems]
    seconds = float(np.mean([path["seconds"] for path in result.load_paths])) / len(load_path.forces)
    applications = float(np.mean([path["applications"] for path in result.load_paths]))
    ours = (
        f"The work of Fig. 14.1 on {load_path.cells}² cells to a residual of {load_path.tolerance:g}: a contact with "
        f"its stiffness takes us {1e3 * seconds:.1f} ms and {applications:.1f} operator applications, on load paths of "
        f"{len(load_path.forces)} forces ({len(result.load_paths)} surfaces, H = 0.7, everything included)"
    )
    times = {
        SOLVERS[i].name: float(np.mean([outcome["seconds"][i, 0] for outcome in cold_solves]))
        for i in _others()
        if all(outcome["status"][i] == FINISHED for outcome in cold_solves)
    }
    if not times:
        return f"{ours}; no peer has finished all of the sampled loads."
    fastest = min(times, key=lambda name: times[name])
    cold = float(np.mean([outcome["seconds"][place_of(OUR_SOLVER), 0] for outcome in cold_solves]))
    return (
        f"{ours}. A cold solve without stiffness takes us {1e3 * cold:.1f} ms in the mean over "
        f"{len(load_path.sampled)} of these loads, and the fastest peer that solves them all, {fastest}, "
        f"{1e3 * times[fastest]:.0f} ms "
        f"({times[fastest] / cold:.0f} times as long). It has no stiffness: by this mean, a path of such solves, "
        f"whose differences are secants, would take {times[fastest] / seconds:.0f} times as long as ours, with a "
        f"second load beside each for a tangent {2 * times[fastest] / seconds:.0f} times; set-up not counted."
    )


def _rolled(result: SolverComparisonResult) -> str:
    """Positions a second, beside warm solves on one window."""
    rolling = result.case.rolling
    rows = zip(*(result.rolling[name] for name in result.rolling.columns), strict=True)
    found = "; ".join(
        f"h/d = {h:g}: {rate:.0f} positions a second, {n:.1f} applications each, {rate / warm:.1f} times as fast as "
        "warm solves on one window"
        for h, rate, n, _, _, warm in rows
    )
    return f"A rolling wheel, a = {rolling.cells} cells, residual {rolling.tolerance:g}, one core: {found}."


def _growth(problem: str, rows: Table) -> str:
    """What the largest grid costs, and the exponents where there are grids enough to fit them."""
    n, seconds, memory = rows["cells"], rows["solve [s]"], rows["peak memory less start [MiB]"]
    applications = rows["operator applications"]
    sentence = (
        f"{problem}: {applications.min()} to {applications.max()} applications on the finest grid from {n.min()}² to "
        f"{n.max()}² cells; at {n.max()}² {seconds[-1]:.3g} s, {rows[RATIO][-1]:.2f} times as long as so many "
        "applications on the whole grid (windows make it shorter; coarser grids, preconditioner and vectors longer), "
        f"and {rows['peak memory [MiB]'][-1]:.0f} MiB"
    )
    large = n >= 512
    if np.count_nonzero(large) < 3:
        return sentence + "; too small for an exponent."
    time, reference, growth = (_exponent(n[large], y[large]) for y in (seconds, n**2 * np.log(n), memory))
    return sentence + (
        f"; from {n[large].min()}² on the time grows like n^{time:.2f} (n² log n: n^{reference:.2f} there), the memory "
        f"less that of an idle process like n^{growth:.2f}."
    )


def _standing(result: SolverComparisonResult, periodic: bool, name: str, others: list[int]) -> str:
    """Our time beside the fastest of others on each problem."""
    where = f"{'Periodic' if periodic else 'Free space'}, beside {name}"
    pairs, us = [], place_of(OUR_SOLVER)
    for problem, outcome in result.problems:
        finished = [i for i in others if outcome["status"][i] == FINISHED]
        if problem.periodic == periodic and outcome["status"][us] == FINISHED and finished:
            pairs.append(outcome["seconds"][finished, :2].min(axis=0) / outcome["seconds"][us, :2])
    if not pairs:
        return f"{where}: no solver has finished."
    by_median, by_fastest = np.array(pairs).T
    return (
        f"{where}: first on {np.count_nonzero(by_median > 1)} of {len(pairs)} problems; "
        f"{_mean(by_median):.1f} times as fast in the geometric mean of medians ({_mean(by_fastest):.1f} by fastest "
        f"runs), {by_median.min():.1f} to {by_median.max():.1f} times on single problems."
    )


def _over_plain_sums(wheel: Table) -> str:
    """Of the finest springs, from the least rough track to the roughest."""
    finest = wheel.where(**{"a/dx": wheel["a/dx"].max()})
    ratios = finest["wheel-steps a second"] / finest["plain sums a second"]
    return (
        f"With {finest['a/dx'][0]:g} springs to a radius a step is {ratios.min():.3g} to {ratios.max():.3g} times as "
        "fast as a plain sum over all of them"
    )


def _others() -> list[int]:
    """Rows of the solvers of other packages."""
    return [i for i, solver in enumerate(SOLVERS) if solver.package != OURS]


def _mean(ratios: np.ndarray) -> float:
    """Geometric."""
    return float(np.exp(np.mean(np.log(ratios))))


def _exponent(n: np.ndarray, y: np.ndarray) -> float:
    return float(np.polyfit(np.log(n), np.log(y), 1)[0])


CASE = Case(
    name="race",
    chapter=Chapter.SPEED,
    place=2,
    claim=CLAIM,
    answers="Our solver beside other packages that are installed, same problems, same residual",
    quick=SolverComparison(),
    full=SolverComparison(
        cells=(128, 256, 512),
        scaling=(128, 256, 512, 1024, 2048),
        load_path=LoadPathWorkload(cells=256, sampled=(0, 6, 12, 18, 24), paths=5),
        rolling=RollingThroughput(positions=1600),
        wheel=SteppingThroughput(springs=(12, 25, 50, 100, 200, 400), heights=(0.01, 0.1, 0.3, 1.0), steps=8000),
    ),
    run=run,
    evidence=evidence,
    needs="–",
    timed=True,
)
