"""How far off a contact solver may be, on both sides of each bound, by answers made up."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from validation.analysis.judgement import AGREE, DIFFER
from validation.benchmarks.judging import discrete, judged, properties

RESIDUAL = 1e-6
OF_ANSWER = 50 * RESIDUAL
"""As the page on solvers says: 50 residuals."""


@dataclass(eq=False)
class Answering:
    """A solver with the answers that it is given, in turn or one for all."""

    answers: list = field(default_factory=list)
    by_force: bool = True
    residual: float = RESIDUAL
    of_answer: float = OF_ANSWER

    def pressure(self, problem):
        return self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]


SPHERE = next(problem for problem in discrete.problems() if problem.name == "sphere")


def of(points, quantity):
    (point,) = (point for point in points if point.quantity == quantity)
    return point


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(("residuals", "verdict"), [(40, AGREE), (70, DIFFER), (400, DIFFER)])
def test_an_approach_or_a_force_may_be_off_by_fifty_residuals(residuals, verdict, sign):
    """The known pressure, beside a problem whose approach, or force, is another one by so much of the overlap."""
    off = sign * residuals * RESIDUAL
    known = SPHERE.pressure
    right = SPHERE.left(known, True)[1]
    moved = replace(SPHERE, approach=right + off * SPHERE.overlap)
    assert of(judged.answer(Answering([known]), moved), "approach").verdict == verdict
    heavier = replace(SPHERE, force=SPHERE.force_of(known) * (1 + off))
    assert of(judged.answer(Answering([known], by_force=False), heavier), "force").verdict == verdict


def test_the_bound_of_an_answer_is_fifty_residuals_and_no_less_than_rounding():
    class Named:
        def __init__(self, residual):
            self.options = {"residual": residual}

    assert properties.Asked(Named(1e-6)).of_answer == pytest.approx(5e-5)
    assert properties.Asked(Named(1e-4)).of_answer == pytest.approx(5e-3)
    assert properties.Asked(Named(1e-9)).of_answer == pytest.approx(1e-5)


@pytest.mark.parametrize("step", [0, 1])
@pytest.mark.parametrize(("lost", "verdict"), [(0.0, AGREE), (0.015, AGREE), (0.03, DIFFER), (0.4, DIFFER)])
def test_a_contact_that_shrinks_under_more_load_is_found(lost, verdict, step):
    """At the first step of the load or at the second: cells that have carried this part of the force are left."""
    pressure = np.zeros(SPHERE.gap.shape)
    pressure[10, 10], pressure[20, 20] = lost, 1 - lost
    without = pressure.copy()
    without[10, 10] = 0.0
    answers = [pressure, without, without] if step == 0 else [pressure, pressure, without]
    point = of(properties.monotone(Answering([(i + 1) * p for i, p in enumerate(answers)]), SPHERE), "monotone area")
    assert point.verdict == verdict and point.value == pytest.approx(lost)
    assert (point.reason == "the contact shrinks under more load") is (verdict == DIFFER)


FLAT = next(problem for problem in discrete.problems() if problem.name == "flat")


@pytest.mark.parametrize(
    ("order", "verdict"), [(0.86, AGREE), (0.94, AGREE), (1.0, AGREE), (1.14, AGREE), (0.84, DIFFER), (1.16, DIFFER)]
)
def test_the_order_of_a_solver_is_that_of_its_errors(order, verdict):
    """A force that is off by e on 12 cells and by e / 4^order on 48; within 0.15 of one."""
    cells_off = {12: 0.1, 48: 0.1 / 4**order}
    answers = []
    for cells, off in cells_off.items():
        one = discrete.STATED["flat"].on(cells)
        even = np.ones(one.gap.shape)
        answers.append(even * FLAT.force * (1 + off) / one.force_of(even))
    point = of(judged.convergence(Answering(answers, by_force=False), FLAT), "order of convergence")
    assert point.value == pytest.approx(order, abs=1e-9) and point.verdict == verdict
    assert point.reference == 1.0 and math.isfinite(point.difference)
