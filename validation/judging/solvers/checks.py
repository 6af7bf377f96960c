"""Whether a contact solver is right: problems with known answers, and properties of every half-space."""

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import pairwise, product

import numpy as np

from validation.analysis.evidence import Verdict
from validation.benchmarks.discrete import STATED, ContactProblem, KnownContact, pressed, problems
from validation.benchmarks.timing import timed as clocked
from validation.judging.judgement import JudgedNumber, SolverTime, missing_number
from validation.judging.registry import Caller, FloatArray
from validation.judging.solvers.causes import JudgedContact
from validation.judging.solvers.diagnosis import LOOSE, diagnosed
from validation.judging.solvers.properties import (
    PROPERTIES,
    JudgedSolver,
    Symptom,
    UnansweredError,
    checked,
    conditions,
    loads_of,
    relative_deviation,
)

RECTANGLE, RECTANGLES = ("rough, heavy load", "rough, periodic"), {(40, 28): 1.5, (27, 21): 1.0}
"""What properties are asked of, in parts of so many cells; their length across."""
ROUGH = {"rough, light load", "rough, periodic"}
"""What is timed."""
GRIDS, LONGEST, RUNS = (32, 64, 128, 256), 10.0, 3
"""Cells on a side that are timed, until so many solves take too long [s]."""
FLAT, NEXT_TERM = "flat", 0.15
"""Of the order: the next term, of order 1.5 at the edge, changes it on coarse grids."""
COARSEST, FINEST = 12, (48, 24)
"""Cells on a side of a flat punch; the latter of a solver that serves fewer."""
NO_CAUSE = "not the answer of any half-space"
MEASURED = ("monotone area", "monotone stiffness", "order of convergence")
"""Properties of several answers: their reasons are what is measured."""
RANDOM, STATE = "each call gives another answer: random numbers", "the answer depends on earlier calls"


def judged(model: Caller) -> tuple[list[JudgedNumber], list[SolverTime]]:
    """Right or wrong by the residual that the solver names, whatever the tolerance; and its times.

    Both by force and by approach where it offers both; times are those of the first.
    """
    points, times = list[JudgedNumber](), list[SolverTime]()
    for load in loads_of(model):
        solver = JudgedSolver(model, by=load)
        points += findings(solver, [] if load != loads_of(model)[0] else times)
    return points, times


def findings(solver: JudgedSolver, times: list[SolverTime] | None = None) -> list[JudgedNumber]:
    """All of one load, each with its cause; what a solver does not serve is not asked, and that is said.

    times: to which seconds on growing grids are added; without a list none are taken.
    """
    points = list(_points_of(solver))
    if times is not None:
        for numbers, seconds in timed(solver) if not times else ():
            points += numbers
            times += seconds
    points += repeated(solver)
    points = explained(solver, points)
    if solver.by == "approach" and "force" in solver.model.asks:
        return [replace(point, where={"problem": f"{point.where['problem']}, by approach"}) for point in points]
    return points


def _points_of(solver: JudgedSolver) -> Iterator[JudgedNumber]:
    served = [problem for problem in problems() if solver.serves(problem)]
    for problem in problems():
        if problem.gap.size > solver.cells and solver.model.options["periodic" if problem.periodic else "free"]:
            yield from _points_or_reason("answer", problem, partial(answer, solver, problem))
    for problem in served:
        yield from _points_or_reason("answer", problem, partial(answer, solver, problem))
    rough = [problem for problem in problems() if problem.name in RECTANGLE]
    for part in (_rectangle(problem, shape, longer) for shape, longer in RECTANGLES.items() for problem in rough):
        if solver.serves(part):
            for name, has in PROPERTIES.items():
                yield from _points_or_reason(name, part, partial(has, solver, part))
    for problem in problems():
        if problem.name == FLAT and solver.model.options["free"]:
            yield from _points_or_reason("order of convergence", problem, partial(convergence, solver, problem))


def _points_or_reason(
    quantity: str, problem: ContactProblem, of: Callable[[], Iterator[JudgedNumber]]
) -> Iterator[JudgedNumber]:
    try:
        yield from of()
    except UnansweredError as error:
        yield unanswered(quantity, problem, error)


def unanswered(quantity: str, problem: ContactProblem, error: UnansweredError) -> JudgedNumber:
    """Without a number: wrong, but for what the solver says that it does not serve."""
    verdict, decides = (Verdict.NOT_SERVED, False) if error.unserved else (Verdict.NO_RESULT, True)
    return missing_number(quantity, {"problem": problem.name}, verdict, str(error), decides=decides)


def _rectangle(problem: KnownContact, shape: tuple[int, int], longer: float) -> ContactProblem:
    """A part of it with more cells along one axis, so much longer along the other: no symmetry, and no answer."""
    (dx, dy), (n, m) = problem.spacing, shape
    fields = {name: getattr(problem, name) for name in ("modulus", "periodic", "force", "approach")}
    name = f"{problem.name}, {n} x {m} cells"
    return ContactProblem(name=name, gap=problem.gap[:n, :m], spacing=(dx, longer * dy), **fields)


def answer(solver: JudgedSolver, problem: KnownContact) -> Iterator[JudgedNumber]:
    """Conditions of the contact by the operator that judges, then the known answer."""
    p = solver.pressure(problem)
    yield from conditions(solver, problem)
    if solver.by_force:
        _, approach = problem.residuals_and_approach(p, solver.by_force)
        off = (approach - problem.approach) / problem.overlap
        yield replace(
            checked("approach", problem, off, solver.of_answer, Symptom.ANSWER),
            value=approach,
            reference=problem.approach,
        )
    else:
        yield checked("force", problem, problem.force_of(p), solver.of_answer, Symptom.ANSWER, problem.force)
    yield checked("pressure", problem, relative_deviation(p, problem.pressure), solver.of_answer, Symptom.ANSWER)


def repeated(solver: JudgedSolver) -> Iterator[JudgedNumber]:
    """The first problem that has an answer, asked again at the end: the pressure is the same."""
    if not solver.pressures:
        return
    # under a flat punch many a mistake has no effect
    problem = max(solver.pressures, key=lambda candidate: bool(np.ptp(candidate.gap)))
    try:
        last = [solver.answer(problem, solver.residual) for _ in range(3)]
    except UnansweredError as error:
        yield replace(unanswered("repeated call", problem, error), decides=not (error.late or error.unserved))
        return
    steps = [after - before for before, after in pairwise([solver.pressures[problem], *last])]
    off = max(relative_deviation(pressure, solver.pressures[problem]) for pressure in last)
    # random steps go to and fro: half of the square of each is taken back by the next
    going, squares = float((steps[1] * steps[2]).sum()), [float((step**2).sum()) for step in steps]
    random = going < -0.25 * math.sqrt(squares[1] * squares[2])
    yield checked("repeated call", problem, off, 2 * solver.of_answer, RANDOM if random else STATE)


def explained(solver: JudgedSolver, points: Sequence[JudgedNumber]) -> list[JudgedNumber]:
    """Each wrong point with the cause of its problem, where there is one."""
    contacts = dict[ContactProblem, JudgedContact]()
    for problem, pressure in solver.pressures.items():
        earlier = [(contact.problem, contact.pressure) for contact in contacts.values()]
        contacts[problem] = JudgedContact(problem, pressure, solver.by_force, solver.residual, earlier)

    def tightened(problem: ContactProblem, factor: float) -> FloatArray | None:
        with suppress(UnansweredError):
            return solver.answer(problem, factor * solver.residual)
        return None

    causes = diagnosed(list(contacts.values()), tightened if "tolerance" in solver.model.asks else lambda *_: None)
    of = {place: causes.get(contacts[problem], "") for place, problem in solver.judged.items() if problem in contacts}
    commonest = Counter(causes.values()).most_common(1)
    # a call that is answered otherwise is a cause by itself
    state = next(
        (point.reason for point in points if point.quantity == "repeated call" and point.verdict is Verdict.OUTSIDE), ""
    )

    def with_cause(point: JudgedNumber) -> JudgedNumber:
        if point.verdict is not Verdict.OUTSIDE or not commonest or point.quantity in MEASURED:
            return point
        name = str(point.where["problem"])
        cause = of.get((point.quantity, name)) or of.get(("", name), "")
        if state and (not cause or NO_CAUSE in cause or LOOSE in cause):
            cause = state
        return replace(point, reason=cause or point.reason)

    return [with_cause(point) for point in points]


def convergence(solver: JudgedSolver, flat: KnownContact) -> Iterator[JudgedNumber]:
    """The approach of a flat punch, or its force, goes to its limit with the cell size, to first order."""
    limit, errors = flat.limits[0, 0], []
    finest = FINEST[0] if FINEST[0] ** 2 <= solver.cells else FINEST[1]
    for cells in (COARSEST, finest):
        problem = replace(STATED[FLAT].on(cells), approach=limit)
        p = solver.pressure(problem)
        value = (
            problem.residuals_and_approach(p, True)[1] / limit if solver.by_force else problem.force_of(p) / flat.force
        )
        errors.append(abs(value - 1))
    order = math.log(errors[0] / errors[1]) / math.log(finest / COARSEST) if min(errors) > 0 else math.nan
    yield checked("order of convergence", flat, order, NEXT_TERM, Symptom.ORDER, 1.0)


def timed(solver: JudgedSolver) -> Iterator[tuple[list[JudgedNumber], list[SolverTime]]]:
    """Of a rough surface on grids that grow: conditions of what is timed, and seconds beside ours, one thread each, the
    same residual: medians."""
    rough_problems = [problem for problem in problems() if problem.name in ROUGH]
    served = [rough for rough in rough_problems if solver.model.options["periodic" if rough.periodic else "free"]][:1]
    for cells, rough in product([cells for cells in GRIDS if cells**2 <= solver.cells], served):
        name = f"{rough.name}, {cells} x {cells} cells"
        problem = replace(STATED[rough.name].on(cells), name=name, approach=rough.limits[0, 0])
        load = {"force": problem.force} if solver.by_force else {"approach": problem.approach}
        runs: list[list[JudgedNumber]] = []
        seconds: list[tuple[float, float]] = []
        while len(seconds) < RUNS and sum(elapsed for elapsed, _ in seconds) < LONGEST:
            again = replace(problem)
            try:
                _, elapsed = clocked(partial(solver.pressure, again))
            except UnansweredError as error:
                point = unanswered("answer", problem, error)
                yield [replace(point, decides=point.decides and not error.late)], []
                return
            _, ours = clocked(partial(pressed, problem, solver.residual, **load))
            seconds.append((elapsed, ours))
            runs.append(list(conditions(solver, again)))
        elapsed, ours = np.median(seconds, axis=0).tolist()
        worst = max(runs, key=lambda run: sum(point.verdict is not Verdict.WITHIN for point in run))
        yield worst, [SolverTime(float(cells), elapsed, ours)]
        if elapsed > LONGEST / 8:
            return
