"""Whether a contact solver is right: problems with known answers, and properties of every half-space."""

import math
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

import bem3d
from validation.analysis.judgement import AGREE, DIFFER, FAILED, UNDECIDED, JudgedPoint, not_compared
from validation.benchmarks.judging.discrete import KnownContact, problem_on, problems
from validation.engine.offered import Caller, Failed, FloatArray
from validation.theory.half_space import LoveHalfSpace, Residual

RESIDUAL = 1e-4
"""That a solver is asked for, where it names none."""
OF_ANSWER, OF_PRESSURE = 100.0, 0.03
"""Residuals by which an approach or a force may be off, and the most of a pressure field in L2: a contact of few cells
is as badly conditioned."""
FREE, PERIODIC = "sphere", "sphere, periodic"
"""Problems that properties are asked of."""
GRIDS, LONGEST = (32, 64, 128, 256), 10.0
"""Cells on a side that are timed, until a solve takes longer [s]."""
FEW_CELLS, NEXT_TERM = 0.02, 0.15
"""Of a contact that grows: a stop may leave single cells of vanishing pressure in; of an order: the next term, of order
1.5 at the edge, changes it on coarse grids."""
TIME, NOT_JUDGED = "time beside bem3d", "a time is neither right nor wrong"


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Right or wrong by the residual that the solver names, whatever the tolerance; then its times, not judged."""
    asked = Asked(model)
    yield from asked.findings()
    for row in timed(asked):
        known, ratio = {"cells": float(row.cells)}, row.seconds / row.ours
        yield JudgedPoint(TIME, known, row.seconds, row.ours, ratio - 1, math.nan, UNDECIDED, NOT_JUDGED)


def checked(
    quantity: str, problem: str, value: float, reference: float, apart: float, within: float, reason: str
) -> JudgedPoint:
    """One number of a solver. apart: from the reference; within: what is accepted; reason: what is wrong, in words."""
    right = abs(apart) <= within  # NaN is not
    where = {"problem": problem}
    verdict, said = (AGREE, "") if right else (DIFFER, reason)
    return JudgedPoint(quantity, where, value, reference, apart, 0.0, verdict, said, decides=True)


def unanswered(quantity: str, problem: str, failed: Failed) -> JudgedPoint:
    return not_compared(quantity, {"problem": problem}, FAILED, failed.reason, decides=True)


@dataclass(frozen=True)
class Asked:
    """A solver with the residual that it is asked for."""

    solver: Caller

    @property
    def residual(self) -> float:
        return float(self.solver.options.get("residual") or RESIDUAL)

    @property
    def by_force(self) -> bool:
        return "force" in self.solver.asks

    def serves(self, problem: KnownContact) -> bool:
        option = ("periodic", False) if problem.periodic else ("free", True)
        return bool(self.solver.options.get(*option))

    def pressure(self, problem: KnownContact) -> FloatArray | Failed:
        """Its answer, or why there is none."""
        given = {"gap": problem.gap, "spacing": problem.spacing, "modulus": problem.modulus}
        given |= {"periodic": problem.periodic, "force": problem.force, "approach": problem.approach}
        found = self.solver.call(**given, tolerance=self.residual)
        return found if isinstance(found, Failed) or found.any() else Failed("no pressure anywhere")

    def findings(self) -> Iterator[JudgedPoint]:
        """All of them; what a solver does not serve is not asked."""
        for problem in filter(self.serves, problems()):
            yield from self.answered(problem)
        for known in (FREE, PERIODIC):
            (problem,) = (one for one in problems() if one.name == known)
            if self.serves(problem):
                yield from self.properties(problem)
        if self.solver.options.get("free", True):
            yield from self.convergence()

    def answered(self, problem: KnownContact) -> Iterator[JudgedPoint]:
        """Conditions of the contact by the operator that judges, then the answer."""
        p = self.pressure(problem)
        if isinstance(p, Failed):
            yield unanswered("answer", problem.name, p)
            return
        left, force = self.left(problem, p), float(p.sum()) * problem.cell
        wrong = diagnosed(problem, p)
        for name, value in (("tension", left.tension), ("complementarity", left.complementarity)):
            yield checked(name, problem.name, value, 0.0, value, self.residual, wrong)
        yield checked("penetration", problem.name, left.penetration, 0.0, left.penetration, self.residual, wrong)
        if self.by_force:
            apart = force / problem.force - 1
            yield checked("force balance", problem.name, force, problem.force, apart, self.residual, "force not held")
        of_answer, deepest = OF_ANSWER * self.residual, problem.approach - float(problem.gap.min())
        apart = (left.approach - problem.approach) / deepest if self.by_force else force / problem.force - 1
        mine, known = (left.approach, problem.approach) if self.by_force else (force, problem.force)
        yield checked("approach" if self.by_force else "force", problem.name, mine, known, apart, of_answer, wrong)
        off = float(np.linalg.norm(p - problem.pressure) / np.linalg.norm(problem.pressure))
        yield checked("pressure", problem.name, off, 0.0, off, max(OF_PRESSURE, of_answer), wrong)

    def left(self, problem: KnownContact, p: FloatArray) -> Residual:
        """Of what was prescribed; a force has the approach of its contact."""
        return problem.half_space.residual(problem.gap, p, None if self.by_force else problem.approach)

    def properties(self, problem: KnownContact) -> Iterator[JudgedPoint]:
        """The same contact in other units, mirrored and moved, pressed more, and one whose contact is fixed."""
        within = 2 * max(OF_PRESSURE, OF_ANSWER * self.residual)
        first = self.pressure(problem)
        others: dict[str, tuple[KnownContact, Any]] = {
            "scaling in E": (scaled(problem, modulus=3.0), lambda p: p / 3.0),
            "scaling in length": (scaled(problem, length=7.0), lambda p: p),
            "mirror": (moved(problem, np.flipud), np.flipud),
            "transposition": (replace(moved(problem, np.transpose), spacing=problem.spacing[::-1]), np.transpose),
        }
        if problem.periodic:
            others["shift"] = (moved(problem, lambda a: np.roll(a, 5, axis=0)), lambda p: np.roll(p, -5, axis=0))
        for name, (other, back) in others.items():
            second = self.pressure(other)
            if isinstance(first, Failed):
                yield unanswered(name, problem.name, first)
            elif isinstance(second, Failed):
                yield unanswered(name, problem.name, second)
            else:
                off = float(np.linalg.norm(back(second) - first) / np.linalg.norm(first))
                yield checked(name, problem.name, off, 0.0, off, within, "the pressure is another one")
        yield from self.monotone(problem)
        if not problem.periodic:
            yield from self.superposition()

    def monotone(self, problem: KnownContact) -> Iterator[JudgedPoint]:
        """The area grows with the load."""
        loads = [pressed(problem, part) for part in (0.3, 0.6, 1.0)]
        found = [self.pressure(one) for one in loads]
        for (one, before), (_, after) in pairwise(zip(loads, found, strict=True)):
            if isinstance(before, Failed) or isinstance(after, Failed):
                continue  # the answer itself is a finding
            cells = [int(np.count_nonzero(p > 1e-9 * np.max(p))) for p in (before, after)]
            reason = "the contact shrinks under more load"
            lost = max(cells[0] - cells[1], 0) / cells[0]
            yield checked("monotone area", one.name, float(cells[1]), float(cells[0]), lost, FEW_CELLS, reason)

    def superposition(self) -> Iterator[JudgedPoint]:
        """A flat punch has one contact: twice the load, twice the pressure."""
        (flat,) = (one for one in problems() if one.name == "flat")
        single, double = self.pressure(flat), self.pressure(pressed(flat, 2.0))
        if not isinstance(single, Failed) and not isinstance(double, Failed):
            off = float(np.linalg.norm(double - 2 * single) / np.linalg.norm(2 * single))
            within = max(OF_PRESSURE, OF_ANSWER * self.residual)
            yield checked("superposition", flat.name, off, 0.0, off, within, "twice the load is not twice the pressure")

    def convergence(self) -> Iterator[JudgedPoint]:
        """The approach of a flat punch goes to its limit with the cell size, to first order."""
        if not self.by_force:
            return
        (flat,) = (one for one in problems() if one.name == "flat")
        limit, errors = flat.limits[0, 0], []
        for cells in (12, 24, 48):
            coarse = problem_on(flat.name, cells)
            p = self.pressure(coarse)
            if isinstance(p, Failed):
                return
            errors.append(abs(self.left(coarse, p).approach - limit))
        order = math.log2(errors[0] / errors[2]) / 2 if min(errors) > 0 else math.nan
        reason = "the error does not fall with the cell size"
        yield checked("order of convergence", flat.name, order, 1.0, order - 1, NEXT_TERM, reason)


def diagnosed(problem: KnownContact, p: FloatArray) -> str:
    """What the pressure of a wrong solver is the answer of, where that can be told."""
    answer, space, gap = problem.pressure, problem.half_space, problem.gap
    if np.linalg.norm(p - answer) <= 1e-2 * np.linalg.norm(answer):
        return ""
    if p.min() < -1e-3 * p.max():
        return f"tension, {p.min() / p.max():.2g} of the largest pressure"
    inside = p > 1e-6 * p.max()
    touching = inside & (p > 1e-3 * p.max())
    if np.count_nonzero(touching) > 2:
        # gap + c u = approach on the contact: c is one for the right half-space
        u, under = space.displacement(p)[touching], gap[touching]
        (_, c), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u], axis=1), under, rcond=None)
        offset = float((under + c * u).mean())
        left = float(np.abs(under + c * u - offset).max())
        if left < 0.02 * np.ptp(under) and abs(c - 1) > 0.02:
            return f"the answer for {1 / c:.4g} times the modulus, or an operator with a factor of {c:.4g}"
    image = LoveHalfSpace(space.shape, space.spacing, space.modulus, not problem.periodic)
    here, there = (one.residual(gap, np.maximum(p, 0)).worst for one in (space, image))
    if there < 0.2 * here or (math.isnan(here) and not math.isnan(there)):
        return "the answer of a free half-space" if problem.periodic else "the answer with periodic images: no padding"
    for axis in (0, 1):
        cells = np.arange(p.shape[axis])
        mine, known = (float((q.sum(axis=1 - axis) * cells).sum() / q.sum()) for q in (p, answer))
        if 0.1 < abs(mine - known) < 2:
            return f"shifted by {mine - known:.2g} cells along axis {axis}"
    outside = float(p[answer == 0].sum() / p.sum())
    if outside > 0.01:
        return f"{outside:.0%} of the force is outside of the contact"
    factor = float((p * answer).sum() / (answer**2).sum())
    return f"{factor:.3g} times the answer at the best, or a stop too early"


def scaled(problem: KnownContact, *, modulus: float = 1.0, length: float = 1.0) -> KnownContact:
    """In other units; a pressure goes with the modulus."""
    return replace(
        problem,
        gap=problem.gap * length,
        spacing=(problem.spacing[0] * length, problem.spacing[1] * length),
        modulus=problem.modulus * modulus,
        force=problem.force * modulus * length**2,
        approach=problem.approach * length,
    )


def moved(problem: KnownContact, way: Any) -> KnownContact:
    return replace(problem, gap=np.ascontiguousarray(way(problem.gap)))


def pressed(problem: KnownContact, part: float) -> KnownContact:
    """With a part of the force, or of the overlap."""
    first = float(problem.gap.min())
    return replace(problem, force=part * problem.force, approach=first + part * (problem.approach - first))


@dataclass(frozen=True)
class Timed:
    """A solve of a rough surface beside ours, one thread each, the same residual [s]."""

    cells: int
    seconds: float
    ours: float


def timed(asked: Asked, name: str = "rough, light load") -> list[Timed]:
    """On grids that grow until a solve takes too long; the medians of three."""
    rows: list[Timed] = []
    periodic = not asked.solver.options.get("free", True)
    for cells in GRIDS:
        problem = problem_on("rough, periodic" if periodic else name, cells)
        space = bem3d.HalfSpace(
            shape=problem.half_space.shape, spacing=problem.spacing, modulus=problem.modulus, periodic=periodic
        )
        mine, ours = [], []
        for _ in range(3):
            begun = time.perf_counter()
            if isinstance(asked.pressure(problem), Failed):
                return rows
            mine.append(time.perf_counter() - begun)
            ours.append(_seconds_of_ours(space, problem, asked.residual))
            if sum(mine) > LONGEST:
                break
        rows.append(Timed(cells, float(np.median(mine)), float(np.median(ours))))
        if mine[-1] > LONGEST / 8:
            break
    return rows


def _seconds_of_ours(space: bem3d.HalfSpace, problem: KnownContact, residual: float) -> float:
    begun = time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        bem3d.solve(space, problem.gap, force=problem.force, tolerance=residual)
    return time.perf_counter() - begun
