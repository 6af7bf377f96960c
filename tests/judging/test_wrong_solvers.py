"""Wrong solvers of others are caught, each with its own cause first; right ones are not refused."""

import dataclasses
import math

import numpy as np
import pytest

from tests.judging.foreign_solver import WRONG, free, pressed, pressed_to
from tests.judging.foreign_solver import periodic as periodic_waves
from tests.judging.judged_points import NOT_SERVED, WITHIN
from validation.benchmarks import discrete
from validation.benchmarks.discrete import STATED
from validation.judging.judgement_text import solver_lines
from validation.judging.registry import KINDS, Offered
from validation.judging.solvers import checks, diagnosis
from validation.judging.solvers.causes import JudgedContact, causes
from validation.judging.solvers.checks import findings
from validation.judging.solvers.diagnosis import numbered
from validation.judging.solvers.properties import JudgedSolver
from validation.judging.worker import Called

FEW = (
    "odd grid",
    "odd along axis 1",
    "oblong",
    "cells of 2:1",
    "cells of 1:4",
    "cells of 4:1",
    "15 cells",
    "full contact",
    "odd cells of 2:1, light load",
    "odd along axis 0",
)


def solver(function, load="force", **options):
    asks = ("gap", "spacing", "modulus", "periodic", "tolerance", load)
    return Called(Offered("contact_solver", "foreign", function, asks, KINDS["contact_solver"].options | options))


def on_free_space(function):
    return lambda periodic, **given: function(**given)


@pytest.fixture
def few_problems(monkeypatch):
    """Small ones, of each kind."""
    stored = {problem.name: problem for problem in discrete.problems()}
    few = tuple(stored[name] for name in FEW)
    monkeypatch.setattr(checks, "problems", lambda: few)
    monkeypatch.setattr(checks, "RECTANGLE", ("odd grid",))
    monkeypatch.setattr(checks, "RECTANGLES", {(15, 11): 1.0})
    monkeypatch.setattr(checks, "GRIDS", ())
    monkeypatch.setattr(diagnosis, "SAMPLE", 8)


def said_first(points):
    """Of the summary."""
    return list(solver_lines("foreign", points, (), 0.0))[1].strip()


OPTIONS = {"single precision": {"residual": 1e-8}}


QUICK = (
    "no padding along axis 1",
    "E for E*, nu = 0.3",
    "mean pressure for the load",
    "boundary excluded",
    "two cells of the boundary excluded",
    "one cell",
    "flipped on odd grids",
    "clipped",
    "tension",
    "elongated cells",
    "kept operator",
    "random",
)
"""One of each family; the others take a minute together."""


@pytest.mark.parametrize("name", [pytest.param(one, marks=() if one in QUICK else pytest.mark.slow) for one in WRONG])
def test_a_wrong_solver_is_caught_and_its_cause_is_named_first(name, few_problems):
    function, cause = WRONG[name]
    points = findings(JudgedSolver(solver(on_free_space(function), **OPTIONS.get(name, {}))))
    assert any(point.verdict != WITHIN and point.decides for point in points)
    assert cause in said_first(points)


def contact_of(name, pressure=None, earlier=()):
    problem = next(problem for problem in discrete.problems() if problem.name == name)
    p = problem.pressure if pressure is None else pressure
    return JudgedContact(problem, p, True, 1e-5, earlier)


def test_what_all_problems_have_in_common_is_no_kind_of_them():
    wrong = [contact_of(name) for name in ("oblong", "cells of 2:1", "cells of 4:1", "full contact")]
    assert diagnosis.kind_of(wrong, [contact_of("cells of 1:4")]) == ""
    assert diagnosis.kind_of(wrong, [contact_of("odd grid")]) == "grids of an even number of cells"


def test_a_problem_that_is_asked_twice_is_no_other_problem():
    problem = contact_of("oblong").problem
    again, heavier = dataclasses.replace(problem), dataclasses.replace(problem, force=2 * problem.force)
    names = {
        other: [name for name, _ in causes(contact_of("oblong", earlier=[(one, problem.pressure)]))]
        for other, one in {"again": again, "heavier": heavier}.items()
    }
    assert "the answer of another problem" in names["heavier"]
    assert "the answer of another problem" not in names["again"]


def test_a_pressure_that_is_far_too_high_is_not_explained_by_none():
    heavy = contact_of("rough, heavy load").pressure
    light = contact_of("rough, light load", heavy)
    parts = dict(numbered([light], [light]))
    assert parts["over the area of a cell"] == parts["over the modulus"] == [0.0]


def test_answers_of_two_other_problems_are_one_cause():
    earlier = [(contact_of(name).problem, contact_of(name).pressure) for name in ("sphere", "rough, heavy load")]
    wrong = [contact_of("rough, light load", earlier[i][1], earlier) for i in (0, 1)]
    found = diagnosis.diagnosed(wrong, lambda *_: None)
    assert set(found.values()) == {"the answer of another problem"} and len(found) == 2


# --- right ones ---


def free_or_periodic(gap, spacing, periodic, **given):
    return pressed(gap, spacing, apply=(periodic_waves if periodic else free)(gap.shape, spacing), **given)


def to_force_or_approach(gap, spacing, modulus, periodic, tolerance, force=None, approach=None):
    apply = (periodic_waves if periodic else free)(gap.shape, spacing)
    if force is not None:
        return pressed(gap, spacing, modulus, force, tolerance, apply=apply)
    return pressed_to(gap, spacing, modulus, approach, tolerance, apply=apply)


def square_cells_alone(gap, spacing, **given):
    if not math.isclose(*spacing):
        raise NotImplementedError("square cells alone")
    return pressed(gap, spacing, **given)


def single_to_a_thousandth(gap, spacing, **given):
    apply = free(gap.shape, spacing)
    return np.float32(pressed(gap - gap.min(), spacing, apply=lambda p: np.float32(apply(np.float32(p))), **given))


RIGHT = {
    "free and periodic": (free_or_periodic, {"periodic": True}),
    "periodic alone": (free_or_periodic, {"free": False, "periodic": True}),
    "free": (on_free_space(pressed), {}),
    "loose, as it names": (on_free_space(pressed), {"residual": 1e-3}),
    "single precision, as it names": (on_free_space(single_to_a_thousandth), {"residual": 1e-3}),
}


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_solver_is_right_on_all_that_it_serves(name):
    function, options = RIGHT[name]
    points = findings(JudgedSolver(solver(function, **options)))
    assert [point for point in points if point.verdict != WITHIN] == []
    asked = {"periodic" in point.where["problem"] for point in points}
    assert asked == {served for served, key in ((True, "periodic"), (False, "free")) if options.get(key, not served)}


def test_a_solver_of_both_loads_is_judged_by_both(few_problems):
    asks = ("gap", "spacing", "modulus", "periodic", "tolerance", "force", "approach")
    both = Called(Offered("contact_solver", "both", to_force_or_approach, asks, KINDS["contact_solver"].options))
    points, _ = checks.judged(both)
    assert [point for point in points if point.verdict != WITHIN] == []
    places = {str(point.where["problem"]) for point in points}
    assert {f"{name}, by approach" for name in FEW} < places and set(FEW) < places

    # a mistake in one of them is found
    def wrong(approach=None, **given):
        return to_force_or_approach(approach=approach, **given) * (1 if approach is None else 1.2)

    points, _ = checks.judged(Called(Offered("contact_solver", "both", wrong, asks, KINDS["contact_solver"].options)))
    failed = {str(point.where["problem"]) for point in points if point.verdict != WITHIN}
    assert failed and all(name.endswith(", by approach") for name in failed)


def test_what_a_solver_does_not_serve_is_counted_apart_and_never_wrong():
    points = findings(JudgedSolver(solver(on_free_space(square_cells_alone))))
    unserved = [point for point in points if point.verdict == NOT_SERVED]
    assert {point.verdict for point in points} == {WITHIN, NOT_SERVED}
    assert {"cells of 1:4", "cells of 2:1"} < {point.where["problem"] for point in unserved}
    assert not any(point.decides for point in unserved)
    lines = list(solver_lines("foreign", points, (), 0.0))
    asked = len({point.where["problem"] for point in points if point.decides})
    assert f"{len(unserved)} not served" in lines[0] and f"the verdict covers {asked} problems" in lines[1]
    in_part = {str(p.where["problem"]) for p in unserved} & {str(p.where["problem"]) for p in points if p.decides}
    assert ("in part" in lines[1]) == bool(in_part) and "of 0" not in lines[1]
    assert "not served: raised NotImplementedError: square cells alone" in lines[2]
    assert f"solves the {asked} discrete problems of free half-spaces" in lines[-1] and "does not serve" in lines[-1]


def test_a_solver_is_not_asked_beyond_the_cells_that_it_declares():
    asked = []

    def counting(gap, **given):
        asked.append(gap.size)
        return pressed(gap, **given)

    points = findings(JudgedSolver(solver(on_free_space(counting), cells=900)))
    assert max(asked) <= 900 and {point.verdict for point in points} == {WITHIN, NOT_SERVED}
    assert {"mirror", "superposition", "order of convergence"} < {p.quantity for p in points if p.verdict == WITHIN}
    assert {point.where["problem"] for point in points if point.verdict == NOT_SERVED} >= {
        "sphere",
        "rough, heavy load",
    }


def test_a_solver_that_serves_nothing_has_no_verdict():
    def nothing(**_):
        raise NotImplementedError("not yet")

    points = findings(JudgedSolver(solver(nothing)))
    assert {point.verdict for point in points} == {NOT_SERVED} and not any(point.decides for point in points)
    assert "without an answer" in next(iter(solver_lines("foreign", points, (), 0.0)))


# --- problems ---


def test_problems_cannot_be_changed():
    for problem in discrete.problems():
        for array in (problem.gap, problem.pressure, problem.limits):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1.0
            with pytest.raises(ValueError, match="WRITEABLE"):
                array.setflags(write=True)
        with pytest.raises(dataclasses.FrozenInstanceError):
            problem.force = 1.0
    assert isinstance(discrete.problems(), tuple)


@pytest.mark.parametrize("name", [name for name, stated in STATED.items() if math.prod(stated.cells) <= 900])
def test_answers_on_small_grids_are_those_of_another_solver_and_operator(name):
    """Of conjugate gradients on a kernel, or on waves, that share no code with the package."""
    (problem,) = (problem for problem in discrete.problems() if problem.name == name)
    apply = (periodic_waves if problem.periodic else free)(problem.gap.shape, problem.spacing)
    p = pressed(problem.gap, problem.spacing, problem.modulus, problem.force, 1e-9, apply=apply, iterations=5000)
    assert p == pytest.approx(problem.pressure, abs=1e-6 * problem.pressure.max())
    approach = (p * (problem.gap + apply(p) / problem.modulus)).sum() / p.sum()
    assert approach == pytest.approx(problem.approach, abs=1e-7 * np.ptp(problem.gap))
