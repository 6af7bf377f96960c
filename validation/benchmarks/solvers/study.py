"""What the solver comparison shows, declared."""

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix, off_by, times_source
from validation.analysis.study import Study
from validation.benchmarks.peers import OUR_SOLVER
from validation.benchmarks.solvers import case, problems
from validation.benchmarks.solvers.case import LoadPathWorkload, SolverComparison
from validation.benchmarks.solvers.throughput import PLAIN, STEPS, RollingThroughput, SteppingThroughput

GUIDE = Curve(problems.SOLVE, case.GUIDE, "guide", case.GUIDE, of={"problem": "rough, free"})


def panel(along: str, quantity: str, legend: str, *curves: Curve) -> Panel:
    return Panel(along, quantity, log="xy", ticked=True, legend=legend).of(*curves)


SOLVE, MEMORY = (Curve(quantity, OUR_SOLVER, by=("problem",)) for quantity in (problems.SOLVE, problems.MEMORY))
STEPPED = Curve(STEPS, by=("h0/d",)), Curve(PLAIN, style="open", label="_", by=("h0/d",))
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
        "as it is installed. Contact models that have no pressure are listed with the difference of their stiffness. "
        "Load paths of Fig. 14.1: {c.load_path.cells} cells a side, residual {c.load_path.tolerance:g}, everything "
        "included; cold solves have no stiffness: a path of them has secants. Rolling: a = {c.rolling.cells} cells, 4 "
        "cells to the shortest wave, residual {c.rolling.tolerance:g}."
    ),
    series=case.series,
    tables=case.tables,
    printed=(case.SECONDS, case.LOADS, case.WORK, case.ROLLED, case.EXPONENT, case.PEERS),
    matrices=(Matrix(name=case.SPEED, quantity=case.SPEED, rows=("problem",), columns="cells", printed=times_source),),
    claims=(
        Claim(quantity=case.SPEED, along="-cells", printed=times_source).saying(
            "Our solver is the fastest at the same residual.", short="Problems on which our solver is the fastest"
        ),
        Claim(quantity=tuple(case.DIFFERENCE.format(what) for what, *_ in case.AGREEMENT), printed=off_by).saying(
            "Different solvers of the same discrete problem find the same pressure."
        ),
    ),
    charts=(
        Chart("race").of(
            "Grids of {c.cells} cells a side. (a) Median time to the residual, bars from the fastest to the slowest "
            "run. (b) The same over the median of bem3d.solve."
        ),
        Chart("race-growth", claims=(), width=11.0).of(
            "Our solver alone against the cells along a side. (a) Time of a solve, and n² log n through the largest "
            "rough one in free space. (b) Peak memory of its process, less that of an idle one.",
            panel(case.CELLS, problems.SOLVE, "upper left", SOLVE, GUIDE),
            panel(case.CELLS, problems.MEMORY, "upper left", MEMORY),
        ),
        Chart("race-wheel", claims=(), width=5.4).of(
            "A dynamic wheel on springs, {c.wheel.wheels} in a batch on one core: steps of one wheel a second against "
            "the springs to a contact radius, by roughness h0/d. Filled: as simulated; open: plain sums over all "
            "springs.",
            panel(case.SPRINGS, STEPS, "best", *STEPPED),
        ),
    ),
)
CASE = Case(
    name="race",
    chapter=Chapter.SPEED,
    place=2,
    answers="Our solver beside other packages that are installed, same problems, same residual",
    quick=SolverComparison(),
    full=SolverComparison(
        cells=(128, 256, 512),
        scaling=(128, 256, 512, 1024, 2048),
        load_path=LoadPathWorkload(cells=256, sampled=(0, 6, 12, 18, 24), paths=5),
        rolling=RollingThroughput(positions=1600),
        wheel=SteppingThroughput(springs=(12, 25, 50, 100, 200, 400), heights=(0.01, 0.1, 0.3, 1.0), steps=8000),
    ),
    run=case.run,
    study=STUDY,
    needs="–",
    timed=True,
)
