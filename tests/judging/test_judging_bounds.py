"""What a judged solver may be off by, and what is no agreement whatever the number."""

import dataclasses
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.judging.judged_points import NO_RESULT, OUTSIDE, WITHIN
from tests.seeded import Times, catches
from validation.benchmarks import discrete, peers, timing
from validation.benchmarks import solvers as comparison
from validation.benchmarks.discrete import ContactProblem, pressed
from validation.benchmarks.surface_problem import SurfaceProblem
from validation.judging.registry import KINDS, Offered
from validation.judging.solvers import checks, properties
from validation.judging.solvers.properties import JudgedSolver, loaded, monotone
from validation.judging.worker import Called

SMALL = next(problem for problem in discrete.problems() if problem.name == "odd cells of 2:1, light load")
GRID = ContactProblem(
    name="grid", gap=np.zeros((4, 5)), spacing=(1.0, 1.0), modulus=1.0, periodic=False, force=1.0, approach=1.0
)


def solver(function, load="force", **options):
    asks = ("gap", "spacing", "modulus", "periodic", "tolerance", load)
    return JudgedSolver(
        Called(Offered("contact_solver", "foreign", function, asks, KINDS["contact_solver"].options | options))
    )


def ours(force=math.nan, approach=math.nan, tolerance=0.0, **given):
    load = {"force": force} if math.isfinite(force) else {"approach": approach}
    return pressed(ContactProblem(force=force, approach=approach, **given), tolerance, **load).pressure


def answers(*pressures):
    """One after the other, whatever is asked."""
    remaining = list(pressures)
    return solver(lambda **_: remaining.pop(0))


checked = properties.checked


@catches("no number agrees", value=float("nan"), reference=0.0, verdict=OUTSIDE).at(
    "validation.judging.solvers.properties.checked",
    lambda *point: dataclasses.replace(checked(*point), verdict=WITHIN, reason=""),
)
@pytest.mark.parametrize(
    ("value", "reference", "verdict"),
    [
        *((value, 0.0, OUTSIDE) for value in (math.nan, math.inf, 0.11, -0.11)),
        *((value, 0.0, WITHIN) for value in (0.0, 0.1, -0.1)),
        *((value, 2.0, OUTSIDE) for value in (math.nan, 2.21, 1.79)),
        *((value, 2.0, WITHIN) for value in (2.19, 1.81)),
    ],
)
def test_a_number_agrees_within_its_bound_and_no_number_never(value, reference, verdict):
    point = properties.checked("approach", GRID, value, 0.1, "why", reference)
    assert (point.verdict, point.reason, point.decides) == (verdict, "why" if verdict == OUTSIDE else "", True)


@catches(
    "an approach that may be off by ten times as much",
    quantity="approach",
    load="force",
    residuals=55,
    verdict=OUTSIDE,
).at("validation.judging.solvers.properties.OF_ANSWER", Times(10.0))
@pytest.mark.parametrize(("quantity", "load"), [("approach", "force"), ("force", "approach")])
@pytest.mark.parametrize(("residuals", "verdict"), [(45, WITHIN), (55, OUTSIDE), (-45, WITHIN), (-55, OUTSIDE)])
def test_an_answer_may_be_off_by_fifty_residuals(quantity, load, residuals, verdict):
    """Of the overlap, or of the force; the known answer is moved, not the pressure."""
    asked = solver(ours, load, residual=1e-4)
    moved = replace(SMALL, approach=SMALL.approach + residuals * 1e-4 * SMALL.overlap)
    if load == "approach":
        moved = replace(SMALL, force=SMALL.force * (1 + residuals * 1e-4))
    points = {point.quantity: point for point in checks.answer(asked, moved)}
    assert points[quantity].verdict == verdict and points["pressure"].verdict == WITHIN


@pytest.mark.parametrize(("off", "verdict"), [(0.9, WITHIN), (1.1, OUTSIDE)])
def test_a_pressure_may_be_off_by_fifty_residuals_in_l2(off, verdict):
    noise = SMALL.pressure * np.sign(np.random.default_rng(1).standard_normal(SMALL.pressure.shape))
    asked = answers(SMALL.pressure + off * 50 * 1e-4 * noise)
    assert {p.quantity: p.verdict for p in checks.answer(asked, SMALL)}["pressure"] == verdict


@pytest.mark.parametrize(("off", "verdict"), [(1.9, WITHIN), (2.1, OUTSIDE)])
def test_two_answers_that_must_be_one_may_be_off_by_both_their_errors(off, verdict):
    p = np.random.default_rng(2).random(GRID.gap.shape)
    points = list(properties.PROPERTIES["mirror"](answers(np.flipud(p) * (1 + off * 50 * 1e-4), p), GRID))
    assert [point.verdict for point in points] == [verdict]


@catches("an order of convergence that may be off by 0.1 more", order=0.8, verdict=OUTSIDE).at(
    "validation.judging.solvers.checks.NEXT_TERM", 0.25
)
@pytest.mark.parametrize(
    ("order", "verdict"), [(1.0, WITHIN), (0.87, WITHIN), (1.13, WITHIN), (0.8, OUTSIDE), (1.2, OUTSIDE)]
)
def test_the_order_of_convergence_is_one_to_the_next_term(order, verdict):
    flat = next(problem for problem in discrete.problems() if problem.name == "flat")

    def pressure(problem):
        n = len(problem.gap)
        return np.full((n, n), flat.force * (1 + 0.1 * (12 / n) ** order) / (n * n * math.prod(problem.spacing)))

    for cells in (math.inf, 900):
        (point,) = checks.convergence(SimpleNamespace(by_force=False, cells=cells, pressure=pressure), flat)
        assert point.value == pytest.approx(order) and point.verdict == verdict


@catches("a contact that may shrink under more load", lost=0.03, verdict=OUTSIDE, step=1).at(
    "validation.judging.solvers.properties.SINGLE_CELLS", float("inf")
)
@pytest.mark.parametrize("step", [0, 1])
@pytest.mark.parametrize(("lost", "verdict"), [(0.0, WITHIN), (0.015, WITHIN), (0.03, OUTSIDE), (0.4, OUTSIDE)])
def test_a_contact_that_shrinks_under_more_load_is_found(lost, verdict, step):
    """At the first or the second step of the load, by the part of the force that lay on the cells that are lost."""
    before = np.zeros((4, 5))
    before[1:3, 1:3], before[0, 0] = (1 - lost) / 4, lost
    after = before.copy()
    after[0, 0] = 0.0
    pressures = [before, after, after] if step == 0 else [before, before, after]
    points = {p.quantity: p for p in monotone(answers(*pressures), loaded(GRID, 1.0))}
    area = points["monotone area"]
    assert area.verdict == verdict and area.value == pytest.approx(lost)
    assert (area.reason == "the contact shrinks under more load") == (verdict == OUTSIDE)


@pytest.mark.parametrize(("residual", "bound"), [(1e-6, 5e-5), (1e-4, 5e-3), (1e-9, 1e-5)])
def test_the_bound_of_an_answer_is_fifty_residuals_and_no_less_than_rounding(residual, bound):
    assert solver(ours, residual=residual).of_answer == pytest.approx(bound)


def test_an_approach_that_falls_under_more_load_is_no_stiffness():
    """Though its compliance falls from one step to the next, as it must."""
    spread, cell = np.ones(GRID.gap.shape) / GRID.gap.size, np.zeros(GRID.gap.shape)
    cell[2, 2] = 1.0
    grown = {p.quantity: p for p in monotone(answers(0.3 * spread, 0.6 * spread, spread), GRID)}
    fallen = {p.quantity: p for p in monotone(answers(0.3 * spread, 0.6 * cell, spread), GRID)}
    assert grown["monotone stiffness"].verdict == WITHIN and fallen["monotone stiffness"].verdict == OUTSIDE
    assert fallen["monotone stiffness"].value > 0.1


def test_the_worst_of_the_timed_runs_is_judged(monkeypatch):
    """A solver that is right twice and wrong once."""
    calls = []

    def sometimes(**given):
        calls.append(given)
        return ours(**given) * (1.1 if len(calls) == 2 else 1.0)

    monkeypatch.setattr(checks, "GRIDS", (24,))
    ((points, times),) = checks.timed(solver(sometimes))
    assert len(calls) == checks.RUNS and len(times) == 1
    assert OUTSIDE in {point.verdict for point in points}


def test_a_grid_beyond_the_declared_cells_is_not_timed(monkeypatch):
    monkeypatch.setattr(checks, "GRIDS", (24, 32))
    assert [time.cells for _, times in checks.timed(solver(ours, cells=600)) for time in times] == [24]


@pytest.mark.parametrize(
    ("change", "verdict", "said"),
    [
        (lambda calls, rng: 1.0, WITHIN, ""),
        (lambda calls, rng: 1 + 0.02 * calls, OUTSIDE, checks.STATE),
        (lambda calls, rng: 1 + 0.05 * rng.standard_normal(SMALL.gap.shape), OUTSIDE, checks.RANDOM),
    ],
)
def test_an_answer_is_the_same_when_it_is_asked_for_again(change, verdict, said):
    calls, rng = [], np.random.default_rng(3)

    def changing(**given):
        calls.append(1)
        return SMALL.pressure * change(len(calls), rng)

    asked = solver(changing)
    asked.pressure(SMALL)
    (point,) = checks.repeated(asked)
    assert (point.verdict, point.reason, point.quantity) == (verdict, said, "repeated call")


@catches("an approach for a full periodic contact, which determines nothing").at(
    "validation.benchmarks.discrete.ContactProblem.is_determined_by_approach", True
)
def test_a_full_periodic_contact_is_not_asked_by_approach():
    (full,) = (problem for problem in discrete.problems() if problem.name == "full contact, periodic")
    (part,) = (problem for problem in discrete.problems() if problem.name == "odd grid, periodic")
    for problem, by_approach in ((full, False), (part, True)):
        assert solver(ours, "force", periodic=True).serves(problem)
        assert solver(ours, "approach", periodic=True).serves(problem) == by_approach
    assert not solver(ours).serves(part)


def test_a_prescribed_load_is_that_which_is_named():
    """A function of both is given one of them."""
    given = []
    both = Called(
        Offered(
            "contact_solver",
            "both",
            lambda gap, force=None, approach=None: given.append((force, approach)) or gap * 0 + 1,
            ("gap", "force", "approach"),
            KINDS["contact_solver"].options,
        )
    )
    for load in ("force", "approach"):
        JudgedSolver(both, by=load).pressure(SMALL)
    assert given == [(SMALL.force, None), (None, SMALL.approach)]


# --- the solver comparison ---


def test_a_solver_of_few_cells_is_not_raced_on_more(tmp_path):
    (tmp_path / "few.py").write_text(
        "from validation import contact_solver\n\n"
        "@contact_solver('few', cells=1000)\ndef few(gap, force): return gap\n",
        encoding="utf-8",
    )
    for cells, there in ((16, True), (32, False)):
        problem = SurfaceProblem("sphere", 0.01, cells, False, 1, 1e-6, own=str(tmp_path / "few.py"))
        assert ("few" in {one.name for one in problem.solvers}) == there


@catches("what is not served for a failure").at("validation.benchmarks.timing.NOT_SERVED", NO_RESULT)
def test_what_a_solver_does_not_serve_is_a_status_of_its_own():
    assert timing._reason(NotImplementedError("square cells alone")) == "not served: square cells alone"
    assert timing._reason(RuntimeError("no")).startswith("failed: RuntimeError")
    assert timing._reason(ValueError("no")).startswith("out of range")


def test_a_tolerance_is_the_loosest_that_reaches_the_residual():
    tried = []

    def prepare(problem, tolerance):
        tried.append(tolerance)
        return lambda: (pressed(problem, 3 * tolerance, force=problem.force).pressure, 1.0)

    peer = peers.PeerSolver("loose", "numpy", "", prepare, (30.0, 1.0, 0.1, 0.01))
    found = peers.find_tolerance(peer, SMALL, 1e-4)
    assert tried == [1e-4 * part for part in (30.0, 1.0, 0.1, 0.01)][: len(tried)] and found == tried[-1]
    worst = [SMALL.worst(pressed(SMALL, 3 * one, force=SMALL.force).pressure, True) for one in tried]
    assert worst[-1] <= 1e-4 and all(one > 1e-4 for one in worst[:-1])


def test_a_solver_is_left_out_where_its_time_grows_beyond_patience():
    problem = SurfaceProblem("sphere", 0.01, 128, False, 1, 1e-6)
    row = {"name": problem.name, "cells": 64, "solver": "bem3d", "status": "finished"}
    for seconds, left_out in ((comparison.PATIENCE / 4.1, ()), (comparison.PATIENCE / 3.9, ("bem3d",))):
        assert comparison.too_slow(problem, [[{**row, comparison.MEDIAN: seconds}]]) == left_out
    assert comparison.too_slow(problem, [[{**row, "status": comparison.TOO_LONG}]]) == ("bem3d",)


def test_differences_of_pressures_are_relative_to_ours():
    ones = np.pad(np.ones((2, 2)), 1)
    found = comparison._differences(2 * ones, ones)
    assert found == {comparison.PRESSURE: 1.0, comparison.FORCE: 1.0, comparison.AREA: 0.0}
    wider = ones.copy()
    wider[0, 0] = 1.0
    assert comparison._differences(wider, ones)[comparison.AREA] == pytest.approx(0.25)
