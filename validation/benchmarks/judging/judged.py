"""Whether a contact solver is right: problems with known answers, and properties of every half-space."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np

from validation.analysis.judgement import AGREE, FAILED, JudgedPoint, not_compared
from validation.benchmarks.isolation import timed as clocked
from validation.benchmarks.judging.diagnosis import diagnosed
from validation.benchmarks.judging.discrete import STATED, ContactProblem, KnownContact, pressed, problems
from validation.benchmarks.judging.properties import PROPERTIES, Asked, UnansweredError, apart, checked, conditions
from validation.engine.offered import Caller

RECTANGLE = {"rough, heavy load", "rough, periodic"}
"""What properties are asked of, in part."""
ROUGH = {"rough, light load", "rough, periodic"}
"""What is timed."""
GRIDS, LONGEST, RUNS = (32, 64, 128, 256), 10.0, 3
"""Cells on a side that are timed, until so many solves take too long [s]."""
FLAT, NEXT_TERM = "flat", 0.15
"""Of the order: the next term, of order 1.5 at the edge, changes it on coarse grids."""


class SolverTime(NamedTuple):
    """Seconds of a solver and of `bem3d` on one grid, of so many cells on a side: neither right nor wrong."""

    cells: float
    seconds: float
    bem3d: float


def judged(model: Caller) -> tuple[list[JudgedPoint], list[SolverTime]]:
    """Right or wrong by the residual that the solver names, whatever the tolerance; and its times."""
    asked, times = Asked(model), list[SolverTime]()
    points = list(findings(asked))
    for found, seconds in timed(asked):
        points += found
        times += seconds
    return points, times


def findings(asked: Asked) -> Iterator[JudgedPoint]:
    """All of them; what a solver does not serve is not asked."""
    known = [problem for problem in problems() if asked.serves(problem)]
    for problem in known:
        yield from _found("answer", problem, partial(answer, asked, problem))
    for part in (_rectangle(problem) for problem in known if problem.name in RECTANGLE):
        for name, has in PROPERTIES.items():
            yield from _found(name, part, partial(has, asked, part))
    for problem in known:
        if problem.name == FLAT:
            yield from _found("order of convergence", problem, partial(convergence, asked, problem))


def _found(quantity: str, problem: ContactProblem, of: Callable[[], Iterator[JudgedPoint]]) -> Iterator[JudgedPoint]:
    try:
        yield from of()
    except UnansweredError as error:
        yield not_compared(quantity, {"problem": problem.name}, FAILED, str(error), decides=True)


def _rectangle(problem: KnownContact) -> ContactProblem:
    """A part of it with more cells along one axis, which are longer along the other: no symmetry, and no answer."""
    dx, dy = problem.spacing
    whole = {name: getattr(problem, name) for name in ("modulus", "periodic", "force", "approach")}
    return ContactProblem(
        name=f"{problem.name}, 40 x 28 cells", gap=problem.gap[:40, :28], spacing=(dx, 1.5 * dy), **whole
    )


def answer(asked: Asked, problem: KnownContact) -> Iterator[JudgedPoint]:
    """Conditions of the contact by the operator that judges, then the known answer."""
    p = asked.pressure(problem)
    wrong = diagnosed(problem, p, asked.residual)
    yield from conditions(asked, problem, wrong)
    if asked.by_force:
        _, mine = problem.left(p, asked.by_force)
        off = (mine - problem.approach) / problem.overlap
        yield replace(checked("approach", problem, off, asked.of_answer, wrong), value=mine, reference=problem.approach)
    else:
        yield checked("force", problem, problem.force_of(p), asked.of_answer, wrong, problem.force)
    yield checked("pressure", problem, apart(p, problem.pressure), asked.of_answer, wrong)


def convergence(asked: Asked, flat: KnownContact) -> Iterator[JudgedPoint]:
    """The approach of a flat punch, or its force, goes to its limit with the cell size, to first order."""
    limit, errors = flat.limits[0, 0], []
    for cells in (12, 48):
        one = replace(STATED[FLAT].on(cells), approach=limit)
        p = asked.pressure(one)
        found = one.left(p, True)[1] / limit if asked.by_force else one.force_of(p) / flat.force
        errors.append(abs(found - 1))
    order = math.log2(errors[0] / errors[1]) / 2 if min(errors) > 0 else math.nan
    yield checked("order of convergence", flat, order, NEXT_TERM, "the error does not fall with the cell size", 1.0)


def timed(asked: Asked) -> Iterator[tuple[list[JudgedPoint], list[SolverTime]]]:
    """Of a rough surface on grids that grow: conditions of what is timed, and seconds beside ours, one thread each, the
    same residual: medians."""
    known = [problem for problem in problems() if problem.name in ROUGH and asked.serves(problem)][:1]
    for cells, rough in product(GRIDS, known):
        name = f"{rough.name}, {cells} x {cells} cells"
        problem = replace(STATED[rough.name].on(cells), name=name, approach=rough.limits[0, 0])
        load = {"force": problem.force} if asked.by_force else {"approach": problem.approach}
        found: list[list[JudgedPoint]] = []
        seconds: list[tuple[float, float]] = []
        while len(seconds) < RUNS and sum(mine for mine, _ in seconds) < LONGEST:
            again = replace(problem)
            try:
                _, mine = clocked(partial(asked.pressure, again))
            except UnansweredError as error:
                yield [not_compared("answer", {"problem": name}, FAILED, str(error), decides=not error.late)], []
                return
            _, ours = clocked(partial(pressed, problem, asked.residual, **load))
            seconds.append((mine, ours))
            found.append(list(conditions(asked, again)))
        mine, ours = np.median(seconds, axis=0).tolist()
        worst = max(found, key=lambda run: sum(point.verdict != AGREE for point in run))
        yield worst, [SolverTime(float(cells), mine, ours)]
        if mine > LONGEST / 8:
            return
