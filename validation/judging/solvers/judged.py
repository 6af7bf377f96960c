"""Whether a contact solver is right: problems with known answers, and properties of every half-space."""

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from validation.analysis.verdict import Verdict
from validation.benchmarks.discrete import STATED, ContactProblem, KnownContact, pressed, problems
from validation.benchmarks.timing import timed as clocked
from validation.judging.judgement import JudgedNumber, missing_number
from validation.judging.registry import Caller, FloatArray
from validation.judging.solvers.causes import JudgedContact
from validation.judging.solvers.diagnosis import LOOSE, diagnosed
from validation.judging.solvers.properties import (
    PROPERTIES,
    Asked,
    UnansweredError,
    apart,
    checked,
    conditions,
    loads_of,
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
OFF, NO_CAUSE = "a deviation above what its residual allows", "not the answer of any half-space"
MEASURED = ("monotone area", "monotone stiffness", "order of convergence")
"""Properties of several answers: their reasons are what is measured."""
RANDOM, STATE = "each call gives another answer: random numbers", "the answer depends on earlier calls"


class SolverTime(NamedTuple):
    """Seconds of a solver and of `bem3d` on one grid, of so many cells on a side: neither right nor wrong."""

    cells: float
    seconds: float
    bem3d: float


def judged(model: Caller) -> tuple[list[JudgedNumber], list[SolverTime]]:
    """Right or wrong by the residual that the solver names, whatever the tolerance; and its times.

    Both by force and by approach where it offers both; times are those of the first.
    """
    points, times = list[JudgedNumber](), list[SolverTime]()
    for load in loads_of(model):
        asked = Asked(model, by=load)
        points += findings(asked, [] if load != loads_of(model)[0] else times)
    return points, times


def findings(asked: Asked, times: list[SolverTime] | None = None) -> list[JudgedNumber]:
    """All of one load, each with its cause; what a solver does not serve is not asked, and that is said.

    times: to which seconds on growing grids are added; without a list none are taken.
    """
    points = list(_found_of(asked))
    if times is not None:
        for found, seconds in timed(asked) if not times else ():
            points += found
            times += seconds
    points += repeated(asked)
    points = explained(asked, points)
    if asked.by == "approach" and "force" in asked.solver.asks:
        return [replace(point, where={"problem": f"{point.where['problem']}, by approach"}) for point in points]
    return points


def _found_of(asked: Asked) -> Iterator[JudgedNumber]:
    known = [problem for problem in problems() if asked.serves(problem)]
    for problem in problems():
        if problem.gap.size > asked.cells and asked.solver.options["periodic" if problem.periodic else "free"]:
            yield from _found("answer", problem, partial(answer, asked, problem))
    for problem in known:
        yield from _found("answer", problem, partial(answer, asked, problem))
    whole = [problem for problem in problems() if problem.name in RECTANGLE]
    for part in (_rectangle(problem, shape, longer) for shape, longer in RECTANGLES.items() for problem in whole):
        if asked.serves(part):
            for name, has in PROPERTIES.items():
                yield from _found(name, part, partial(has, asked, part))
    for problem in problems():
        if problem.name == FLAT and asked.solver.options["free"]:
            yield from _found("order of convergence", problem, partial(convergence, asked, problem))


def _found(quantity: str, problem: ContactProblem, of: Callable[[], Iterator[JudgedNumber]]) -> Iterator[JudgedNumber]:
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
    whole = {name: getattr(problem, name) for name in ("modulus", "periodic", "force", "approach")}
    name = f"{problem.name}, {n} x {m} cells"
    return ContactProblem(name=name, gap=problem.gap[:n, :m], spacing=(dx, longer * dy), **whole)


def answer(asked: Asked, problem: KnownContact) -> Iterator[JudgedNumber]:
    """Conditions of the contact by the operator that judges, then the known answer."""
    p = asked.pressure(problem)
    yield from conditions(asked, problem)
    if asked.by_force:
        _, mine = problem.residuals_and_approach(p, asked.by_force)
        off = (mine - problem.approach) / problem.overlap
        yield replace(checked("approach", problem, off, asked.of_answer, OFF), value=mine, reference=problem.approach)
    else:
        yield checked("force", problem, problem.force_of(p), asked.of_answer, OFF, problem.force)
    yield checked("pressure", problem, apart(p, problem.pressure), asked.of_answer, OFF)


def repeated(asked: Asked) -> Iterator[JudgedNumber]:
    """The first problem that has an answer, asked again at the end: the pressure is the same."""
    if not asked.known:
        return
    # under a flat punch many a mistake has no effect
    problem = max(asked.known, key=lambda one: bool(np.ptp(one.gap)))
    try:
        last = [asked.answer(problem, asked.residual) for _ in range(3)]
    except UnansweredError as error:
        yield replace(unanswered("repeated call", problem, error), decides=not (error.late or error.unserved))
        return
    steps = [after - before for before, after in pairwise([asked.known[problem], *last])]
    off = max(apart(one, asked.known[problem]) for one in last)
    # random steps go to and fro: half of the square of each is taken back by the next
    going, squares = float((steps[1] * steps[2]).sum()), [float((step**2).sum()) for step in steps]
    random = going < -0.25 * math.sqrt(squares[1] * squares[2])
    yield checked("repeated call", problem, off, 2 * asked.of_answer, RANDOM if random else STATE)


def explained(asked: Asked, points: Sequence[JudgedNumber]) -> list[JudgedNumber]:
    """Each wrong point with the cause of its problem, where there is one."""
    contacts = dict[ContactProblem, JudgedContact]()
    for problem, pressure in asked.known.items():
        earlier = [(one.problem, one.pressure) for one in contacts.values()]
        contacts[problem] = JudgedContact(problem, pressure, asked.by_force, asked.residual, earlier)

    def tightened(problem: ContactProblem, factor: float) -> FloatArray | None:
        with suppress(UnansweredError):
            return asked.answer(problem, factor * asked.residual)
        return None

    causes = diagnosed(list(contacts.values()), tightened if "tolerance" in asked.solver.asks else lambda *_: None)
    of = {place: causes.get(contacts[problem], "") for place, problem in asked.judged.items() if problem in contacts}
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


def convergence(asked: Asked, flat: KnownContact) -> Iterator[JudgedNumber]:
    """The approach of a flat punch, or its force, goes to its limit with the cell size, to first order."""
    limit, errors = flat.limits[0, 0], []
    finest = FINEST[0] if FINEST[0] ** 2 <= asked.cells else FINEST[1]
    for cells in (COARSEST, finest):
        one = replace(STATED[FLAT].on(cells), approach=limit)
        p = asked.pressure(one)
        found = one.residuals_and_approach(p, True)[1] / limit if asked.by_force else one.force_of(p) / flat.force
        errors.append(abs(found - 1))
    order = math.log(errors[0] / errors[1]) / math.log(finest / COARSEST) if min(errors) > 0 else math.nan
    yield checked("order of convergence", flat, order, NEXT_TERM, "the error does not fall with the cell size", 1.0)


def timed(asked: Asked) -> Iterator[tuple[list[JudgedNumber], list[SolverTime]]]:
    """Of a rough surface on grids that grow: conditions of what is timed, and seconds beside ours, one thread each, the
    same residual: medians."""
    served = [problem for problem in problems() if problem.name in ROUGH]
    known = [one for one in served if asked.solver.options["periodic" if one.periodic else "free"]][:1]
    for cells, rough in product([cells for cells in GRIDS if cells**2 <= asked.cells], known):
        name = f"{rough.name}, {cells} x {cells} cells"
        problem = replace(STATED[rough.name].on(cells), name=name, approach=rough.limits[0, 0])
        load = {"force": problem.force} if asked.by_force else {"approach": problem.approach}
        found: list[list[JudgedNumber]] = []
        seconds: list[tuple[float, float]] = []
        while len(seconds) < RUNS and sum(mine for mine, _ in seconds) < LONGEST:
            again = replace(problem)
            try:
                _, mine = clocked(partial(asked.pressure, again))
            except UnansweredError as error:
                point = unanswered("answer", problem, error)
                yield [replace(point, decides=point.decides and not error.late)], []
                return
            _, ours = clocked(partial(pressed, problem, asked.residual, **load))
            seconds.append((mine, ours))
            found.append(list(conditions(asked, again)))
        mine, ours = np.median(seconds, axis=0).tolist()
        worst = max(found, key=lambda run: sum(point.verdict is not Verdict.WITHIN for point in run))
        yield worst, [SolverTime(float(cells), mine, ours)]
        if mine > LONGEST / 8:
            return
