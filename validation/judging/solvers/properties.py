"""Properties that the pressure of every half-space has, each a function of a solver and a problem."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from itertools import pairwise

import numpy as np

from validation.analysis.evidence import Verdict, verdict_of
from validation.benchmarks.discrete import ContactProblem
from validation.judging.judgement import ROUNDING, JudgedNumber
from validation.judging.registry import Caller, Failed, FloatArray

OF_ANSWER, FLOOR = 50.0, 1e-5
"""Residuals by which an approach, a force or a pressure may be off: the condition of a contact on so few cells, up to
24 where solvers stop early; rounding."""
SINGLE_CELLS = 0.02
"""Of the force: cells of vanishing pressure may be in or out of contact."""
PARTS = (0.3, 0.6, 1.0)
"""Of a load that grows."""


Way = Callable[[FloatArray], FloatArray]


class Symptom(StrEnum):
    """Reasons of a wrong number that name what is measured, and no cause."""

    CONDITION = "above the residual that it names"
    ANSWER = "a deviation above what its residual allows"
    FORCE = "force not held"
    PRESSURE = "the pressure is another one"
    AREA = "the contact shrinks under more load"
    STIFFNESS = "it falls under more load"
    ORDER = "the error does not fall with the cell size"


LOADS = ("force", "approach")
"""What a solver may be given."""
NOT_SERVED = "not served"
"""How the reason begins where a solver declares a limit, or raises NotImplementedError."""


class UnansweredError(Exception):
    """A solver has no answer, for this reason; late: it was not awaited; unserved: it says that it serves no such."""

    def __init__(self, reason: str, late: bool = False, unserved: bool = False):
        super().__init__(reason)
        self.late, self.unserved = late, unserved


@dataclass(frozen=True, eq=False)
class JudgedSolver:
    """A solver with the residual that it names, under one kind of load; each problem is solved once.

    by: "force" or "approach"; without it by force where both are offered; judged: pressures that were judged by
    themselves, under the quantity and the name of the problem.
    """

    model: Caller
    pressures: dict[ContactProblem, FloatArray] = field(default_factory=dict, repr=False)
    by: str = ""
    judged: dict[tuple[str, str], ContactProblem] = field(default_factory=dict, repr=False)

    @property
    def residual(self) -> float:
        return float(self.model.options["residual"])

    @property
    def of_answer(self) -> float:
        return max(OF_ANSWER * self.residual, FLOOR)

    @property
    def by_force(self) -> bool:
        return self.by == "force" if self.by else "force" in self.model.asks

    @property
    def cells(self) -> float:
        """The most of a grid that the solver declares to serve."""
        return float(self.model.options.get("cells", math.inf))

    def serves(self, problem: ContactProblem) -> bool:
        """Its half-space and its number of cells, and a load that determines the pressure."""
        served = self.model.options["periodic" if problem.periodic else "free"] and problem.gap.size <= self.cells
        return bool(served) and (self.by_force or problem.is_determined_by_approach)

    def pressure(self, problem: ContactProblem) -> FloatArray:
        """Its answer [Pa]. Raises UnansweredError where there is none."""
        if problem not in self.pressures:
            self.pressures[problem] = self.answer(problem, self.residual)
        return self.pressures[problem]

    def answer(self, problem: ContactProblem, tolerance: float) -> FloatArray:
        """Of a call of its own. Raises UnansweredError as `pressure`."""
        if problem.gap.size > self.cells:
            raise UnansweredError(f"{NOT_SERVED}: more than the {self.cells:g} cells that it declares", unserved=True)
        other = {"approach" if self.by_force else "force": None}
        pressure = self.model.call(**vars(problem) | other, tolerance=tolerance)
        if isinstance(pressure, Failed):
            unserved = pressure.reason.startswith("raised NotImplementedError")
            reason = f"{NOT_SERVED}: {pressure.reason}" if unserved else pressure.reason
            raise UnansweredError(reason, pressure.late, unserved)
        if not pressure.any():
            raise UnansweredError("no pressure anywhere")
        return pressure


def loads_of(model: Caller) -> list[str]:
    """What it is asked by: force, approach, or both."""
    return [load for load in LOADS if load in model.asks]


def checked(
    quantity: str, problem: ContactProblem, value: float, within: float, reason: str, reference: float = 0.0
) -> JudgedNumber:
    """A number of a solver, which has no error: WITHIN or OUTSIDE, with the reason of the latter.

    By the relative deviation, of a reference of zero by the value; NaN is outside.
    """
    difference = value / reference - 1 if reference else value
    verdict = verdict_of(math.inf if math.isnan(difference) else difference, 0.0, within, rounding=ROUNDING)
    return JudgedNumber(
        quantity,
        {"problem": problem.name},
        value,
        reference,
        difference,
        0.0,
        verdict,
        "" if verdict is Verdict.WITHIN else reason,
        decides=True,
        tolerance=within,
    )


def relative_deviation(values: FloatArray, reference: FloatArray) -> float:
    """In L2, relative to the reference; infinite where that is zero."""
    norm = float(np.linalg.norm(reference))
    return float(np.linalg.norm(values - reference)) / norm if norm else math.inf


LEFT = {"force balance": Symptom.FORCE, "tension": "negative pressures: p >= 0 is not held"}
"""What is said of a condition that is left."""


def conditions(solver: JudgedSolver, problem: ContactProblem) -> Iterator[JudgedNumber]:
    """No tension, no pressure at a gap, no overlap, and a force that is held, by the operator that judges."""
    left, _ = problem.residuals_and_approach(solver.pressure(problem), solver.by_force)
    solver.judged["", problem.name] = problem
    for name, value in left.items():
        yield checked(name, problem, value, solver.residual, LEFT.get(name, Symptom.CONDITION))


def rescaled(
    problem: ContactProblem, *, modulus: float = 1.0, length: float = 1.0, height: float = 1.0
) -> ContactProblem:
    """In other units, and over other heights: its pressure goes with modulus * height / length."""
    dx, dy = problem.spacing
    return replace(
        problem,
        gap=height * problem.gap,
        spacing=(length * dx, length * dy),
        modulus=modulus * problem.modulus,
        force=modulus * length * height * problem.force,
        approach=height * problem.approach,
    )


def loaded(problem: ContactProblem, part: float) -> ContactProblem:
    """With a part of the force, or of the overlap."""
    return replace(problem, force=part * problem.force, approach=problem.gap.min() + part * problem.overlap)


def moved(problem: ContactProblem, way: Way) -> ContactProblem:
    gap, (dx, dy) = np.ascontiguousarray(way(problem.gap)), problem.spacing
    return replace(problem, gap=gap, spacing=(dy, dx) if way is np.transpose else (dx, dy))


def flat(problem: ContactProblem) -> ContactProblem:
    return replace(problem, gap=0 * problem.gap, approach=problem.overlap)


def rolled(a: FloatArray, cells: int = 1) -> FloatArray:
    return np.roll(a, (5 * cells, 3 * cells), axis=(0, 1))


@dataclass(frozen=True)
class Same:
    """A contact that is told in another way has the same pressure, told in that way.

    served: half-spaces of which this is true.
    """

    quantity: str
    other: Callable[[ContactProblem], ContactProblem]
    back: Way
    first: Callable[[ContactProblem], ContactProblem] = lambda problem: problem
    served: tuple[bool, ...] = (False, True)

    def __call__(self, solver: JudgedSolver, problem: ContactProblem) -> Iterator[JudgedNumber]:
        if problem.periodic in self.served:
            other = solver.judged[self.quantity, problem.name] = self.other(problem)
            off = relative_deviation(self.back(solver.pressure(other)), solver.pressure(self.first(problem)))
            yield checked(self.quantity, problem, off, 2 * solver.of_answer, Symptom.PRESSURE)


SAME = (
    Same("scaling in E", lambda problem: rescaled(problem, modulus=3.0), lambda p: p / 3.0),
    Same("scaling in length", lambda problem: rescaled(problem, length=7.0, height=7.0), lambda p: p),
    Same("scaling in height", lambda problem: rescaled(problem, height=2.0), lambda p: p / 2.0),
    Same("mirror", lambda problem: moved(problem, np.flipud), np.flipud),
    Same("transposition", lambda problem: moved(problem, np.transpose), np.transpose),
    Same("shift", lambda problem: moved(problem, rolled), lambda p: rolled(p, -1), served=(True,)),
    # one contact, whatever the load
    Same("superposition", lambda problem: loaded(flat(problem), 2.0), lambda p: p / 2.0, flat, served=(False,)),
)


def monotone(solver: JudgedSolver, problem: ContactProblem) -> Iterator[JudgedNumber]:
    """Contact and stiffness grow with the load."""
    steps = [loaded(problem, part) for part in PARTS]
    pressures = [solver.pressure(step) for step in steps]
    lost = max(float(before[after <= 0].sum() / before.sum()) for before, after in pairwise(pressures))
    yield checked("monotone area", problem, lost, SINGLE_CELLS, Symptom.AREA)
    force = np.array([step.force_of(p) for step, p in zip(steps, pressures, strict=True)])
    approach = np.array(
        [step.residuals_and_approach(p, solver.by_force)[1] for step, p in zip(steps, pressures, strict=True)]
    )
    # compliances over that of the chord from the first touch: a full periodic contact has none
    with np.errstate(all="ignore"):  # the same pressure under every load
        first, second = np.diff(approach) / np.diff(force) * force[-1] / (approach[-1] - problem.gap.min())
    fall = max(second - first, -first, -second, 0.0)
    yield checked("monotone stiffness", problem, fall, solver.of_answer, Symptom.STIFFNESS)


def served(has: "Property") -> tuple[bool, ...]:
    """Of which half-spaces a property is one: not periodic, periodic."""
    return has.served if isinstance(has, Same) else (False, True)


Property = Callable[[JudgedSolver, ContactProblem], Iterator[JudgedNumber]]
PROPERTIES: Mapping[str, Property] = {
    "conditions": conditions,
    **{same.quantity: same for same in SAME},
    "monotone": monotone,
}
