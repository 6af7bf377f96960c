"""Solvers of others: the right one is accepted, each seeded fault is caught and named."""

import math
import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import bem3d
from bem3d import kernel
from tests import oracles
from tests.judging.judged_points import OUTSIDE, WITHIN
from tests.seeded import catches
from validation import contact_solver
from validation.benchmarks import discrete, peers
from validation.benchmarks.discrete import STATED, ContactProblem, pressed
from validation.judging.registry import KINDS, LOOSEST, Failed, Offered
from validation.judging.solvers import checks
from validation.judging.solvers.checks import findings
from validation.judging.solvers.properties import PROPERTIES, JudgedSolver
from validation.judging.worker import Called

EXAMPLE = str(Path(discrete.__file__).parents[1] / "examples" / "own_solver.py")
OPTIONS = KINDS["contact_solver"].options


def ours(tolerance, force=math.nan, approach=math.nan, **given):
    load = {"force": force} if math.isfinite(force) else {"approach": approach}
    return pressed(ContactProblem(force=force, approach=approach, **given), tolerance, **load).pressure


def asked(solve, load="force", **options):
    """As of somebody's file."""
    asks = ("gap", "spacing", "modulus", "periodic", "tolerance", load)
    return JudgedSolver(Called(Offered("contact_solver", "planted", solve, asks, OPTIONS | options)))


def wrong_in(solve, load="force", **options):
    return [finding for finding in findings(asked(solve, load, **options)) if finding.verdict != WITHIN]


@pytest.mark.parametrize("load", ["force", "approach"])
def test_our_solver_is_right_on_every_problem(load):
    found = list(findings(asked(ours, load, periodic=True, residual=1e-6)))
    # of a full periodic contact an approach determines nothing
    every = set(STATED) if load == "force" else set(STATED) - {"full contact, periodic"}
    assert {finding.where["problem"] for finding in found} > every
    assert {"mirror", "shift", "superposition", "monotone stiffness", "repeated call"} < {
        finding.quantity for finding in found
    }
    assert [finding for finding in found if finding.verdict != WITHIN] == []


def test_a_solver_of_forty_lines_is_accepted_and_not_asked_what_it_does_not_serve():
    example = runpy.run_path(EXAMPLE)["solve"]
    found = list(findings(JudgedSolver(Called(example))))
    assert all(finding.verdict == WITHIN for finding in found)
    assert not any("periodic" in finding.where["problem"] for finding in found)
    periodic = {one.where["problem"] for one in findings(asked(ours, free=False, periodic=True))}
    assert len(periodic) == 17 and all("periodic" in name for name in periodic)


@pytest.mark.parametrize(
    ("package", "solver", "load"),
    [("tamaas", peers.tamaas, "force"), ("ContactMechanics", peers.contact_mechanics, "approach")],
)
def test_the_solvers_of_other_packages_are_right(package, solver, load):
    """Where they are installed; flat bodies, few cells and odd numbers of them included."""
    pytest.importorskip(package)

    def solve(tolerance, **given):
        return solver(ContactProblem(**{"force": math.nan, **given}), tolerance / 10)()[0]

    found = list(findings(asked(solve, load, periodic=True)))
    assert {finding.where["problem"] for finding in found} > set(STATED) - {"full contact, periodic"}
    assert [finding for finding in found if finding.verdict != WITHIN] == []


def test_a_solver_that_serves_both_loads_is_given_the_force_alone():
    given = []
    offered = contact_solver("both")(
        lambda gap, force=None, approach=None: given.append((force, approach)) or gap * 0 + 1
    )
    problem = discrete.problems()[0]
    JudgedSolver(Called(offered)).pressure(problem)
    assert given == [(problem.force, None)]


def changed(**factors):
    return lambda **given: ours(**{**given, **{name: given[name] * by for name, by in factors.items()}})


def spoiled(way):
    return lambda **given: way(ours(**given))


def on_a_side(gap, **given):
    """Padded as if the second axis were as long as the first."""
    longer = np.full((gap.shape[0], 2 * gap.shape[1]), gap.max() + 1.0)
    longer[:, : gap.shape[1]] = gap
    p = ours(gap=longer, **given | {"periodic": True})
    return p[:, : gap.shape[1]]


FAULTS = {
    "E for E*": (changed(modulus=1 / 0.91), "complementarity", "the answer for 1.099 times the modulus"),
    "a factor 2 in the operator": (changed(modulus=0.5), "complementarity", "an operator with a factor of 2"),
    "no padding": (lambda **given: ours(**given | {"periodic": True}), "penetration", "no padding"),
    "half a cell": (spoiled(lambda p: (p + np.roll(p, 1, 0)) / 2), "pressure", "shifted by 0.5 cells along axis 0"),
    "a loose stop": (changed(tolerance=300.0), "penetration", "it does not converge to the residual that it names"),
    "pressure outside": (
        spoiled(lambda p: p + 0.01 * p.max() * (p == 0)),
        "complementarity",
        "pressure outside of the contact",
    ),
    "a force that is not held": (changed(force=1.01), "force balance", "the force is not held"),
    "more force": (changed(force=1.01), "pressure", "the answer under another load"),
    "tension": (spoiled(lambda p: p - 0.01 * p.max() * (p == 0)), "tension", "negative pressures: p >= 0 is not held"),
    "spacings exchanged": (
        lambda spacing, **given: ours(spacing=spacing[::-1], **given),
        "pressure",
        "the answer with dx and dy exchanged",
    ),
    "a little tension": (
        spoiled(lambda p: p - 1e-3 * p.max() * (p == 0)),
        "tension",
        "negative pressures: p >= 0 is not held",
    ),
    "one answer for all of a shape": (
        lambda gap, answers={}, **given: answers.setdefault(gap.shape, ours(gap=gap, **given)),
        "pressure",
        "the answer of another problem",
    ),
    "over E*": (lambda **given: ours(**given) / given["modulus"], "approach", "over the modulus"),
    "cells of a rectangle in another order": (
        spoiled(lambda p: p.ravel(order="F" if p.shape[0] != p.shape[1] else "C").reshape(p.shape)),
        "mirror",
        "rows and columns exchanged in memory",
    ),
    "a rectangle without padding along one axis": (on_a_side, "penetration", "no padding along axis 0"),
    "heights in single precision far from zero": (
        lambda gap, **given: ours(gap=(gap + 1.0).astype(np.float32).astype(float), **given),
        "scaling in length",
        "near the answer: it does not converge to the residual that it names, rounding",
    ),
}


@catches("properties of nothing but a square", *FAULTS["cells of a rectangle in another order"]).at(
    "validation.judging.solvers.checks._rectangle", lambda problem, shape, longer: problem
)
@pytest.mark.parametrize(("solve", "quantity", "reason"), FAULTS.values(), ids=FAULTS)
def test_a_seeded_fault_is_caught_and_named(solve, quantity, reason):
    assert any(reason in finding.reason for finding in wrong_in(solve) if finding.quantity == quantity)


SOFTER = {
    "softer": (
        lambda **given: ours(**given) / (given["approach"] - given["gap"].min()) ** 3,
        "",
        "it falls under more",
    ),
    "heights from their mean": (
        lambda gap, **given: ours(gap=gap - gap.mean(), **given),
        "",
        "the approach counts from the mean plane of the gap",
    ),
}


@catches("the approach of an answer for the one that is prescribed, in causes", fault="heights from their mean").at(
    "validation.judging.solvers.diagnosis._shift", lambda contact: 0.0
)
@pytest.mark.parametrize("fault", ["E for E*", "a factor 2 in the operator", "half a cell", "tension", *SOFTER])
def test_a_fault_is_caught_by_approach_too(fault):
    solve, _, reason = (FAULTS | SOFTER)[fault]
    assert any(reason in finding.reason for finding in wrong_in(solve, "approach"))


@pytest.mark.parametrize("load", ["force", "approach"])
def test_square_cells_are_not_called_exchanged_and_another_load_is_no_image(load):
    """Each wrong solver on cells of one length, by force or by approach."""
    wrong = FAULTS["one answer for all of a shape"][0] if load == "force" else SOFTER["heights from their mean"][0]
    said = {finding.reason for finding in wrong_in(wrong, load) if finding.quantity == "pressure"}
    assert said and not [reason for reason in said if "exchanged" in reason or "images" in reason]


def test_the_loosest_residual_lets_no_point_loads_pass(monkeypatch):
    """A point load at the centre of each cell, whose own displacement is that of a disc of its area."""

    def point_table(cells, aspect):
        with np.errstate(divide="ignore"):
            table = aspect / np.hypot(np.arange(cells[0])[:, np.newaxis], aspect * np.arange(cells[1]))
        table[0, 0] = 2 * math.sqrt(math.pi * aspect)
        return table

    monkeypatch.setattr(kernel, "love_table", point_table)
    assert len(wrong_in(ours, residual=LOOSEST)) > 9


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (lambda gap: 1 / 0, "raised ZeroDivisionError"),
        (lambda gap: gap * np.nan, "returned NaN or infinity, 2304 of 2304 values"),
        (lambda gap: gap[:-1], "returned shape (47, 48), must be (48, 48)"),
        (lambda gap: gap * 0, "no pressure anywhere"),
    ],
)
def test_no_answer_is_a_finding_with_its_reason(answer, reason):
    found = wrong_in(lambda gap, **_: answer(gap))
    assert reason in found[0].reason
    assert {finding.quantity for finding in found} == {"answer", *PROPERTIES, "order of convergence"} - {"shift"}


left = discrete.ContactProblem.residuals_and_approach


@catches("the approach of a contact for the one that is prescribed").at(
    "validation.benchmarks.discrete.ContactProblem.residuals_and_approach",
    lambda problem, pressure, by_force, *operator: left(problem, pressure, True, *operator),
)
def test_a_condition_that_is_left_has_its_size():
    problem = STATED["sphere"].on(12)
    p = pressed(problem, 1e-11, force=problem.force).pressure
    assert problem.worst(p, by_force=True) < 1e-10
    approach = problem.residuals_and_approach(p, by_force=True)[1]
    assert replace(problem, approach=approach).worst(p, by_force=False) < 1e-10
    assert replace(problem, approach=1.01 * approach).worst(p, by_force=False) > 1e-3
    assert problem.residuals_and_approach(1.02 * p, by_force=True)[0]["force balance"] == pytest.approx(0.02)
    assert math.isnan(problem.worst(-p, by_force=True)), "no overlap"


@pytest.mark.parametrize(
    ("name", "cells"), [("sphere", 12), ("tilted", 12), ("cells of two lengths", 12), ("rough, heavy load", 24)]
)
def test_the_answers_are_those_of_a_dense_matrix(name, cells):
    """A smaller grid of each problem that a matrix can hold."""
    found, gap = discrete.answered(STATED[name].on(cells)), STATED[name].on(cells).gap
    half_space = bem3d.HalfSpace(shape=gap.shape, spacing=found["spacing"], modulus=found["modulus"])
    known = oracles.contact_by_least_squares(half_space, gap / 1e-6, found["approach"] / 1e-6) * 1e-6
    assert found["pressure"] == pytest.approx(known, abs=1e-6 * known.max())


def test_stored_problems_are_made_anew_to_their_digits_and_hold_their_limits():
    stored = {problem.name: problem for problem in discrete.problems()}
    assert list(stored) == list(STATED)
    sphere, flat = stored["sphere"], stored["flat"]
    anew = discrete.answered(STATED["sphere"].on(discrete.CELLS))
    np.testing.assert_allclose(anew["pressure"], sphere.pressure, atol=1e-7 * sphere.pressure.max())
    radius, a = discrete.SIDE / discrete.LOW, discrete.SIDE / 5
    hertz = (a**2 / radius, 2 * sphere.modulus * a, np.pi * a**2)
    punch = flat.force / (1.1523 * flat.modulus * discrete.SIDE)
    assert (np.abs(sphere.limits[:, 0] - hertz) <= 2 * sphere.limits[:, 1] + 0.01 * np.abs(hertz)).all()
    assert flat.limits[0, 0] == pytest.approx(punch, rel=2e-4)


@pytest.mark.parametrize(("seconds", "grids"), [(1.0, [24, 32]), (2.0, [24])])
def test_a_solver_is_timed_beside_ours_until_it_takes_too_long(seconds, grids, monkeypatch):
    monkeypatch.setattr(checks, "GRIDS", (24, 32))
    monkeypatch.setattr(checks, "clocked", lambda solve: (solve(), seconds))
    rows, times = zip(*checks.timed(asked(ours)), strict=True)
    assert list(times) == [[(cells, seconds, seconds)] for cells in grids]
    assert {point.verdict for some in rows for point in some} == {WITHIN}


LARGE = {
    "an even pressure": (lambda p: np.full_like(p, p.mean()), "complementarity"),
    "one part of the surface": (lambda p: p * (np.arange(len(p)) < 48)[:, None], "penetration"),
    "no number": (lambda p: p * np.nan, "answer"),
}


timed = checks.timed


@catches("answers that are timed and not judged", *LARGE["an even pressure"]).at(
    "validation.judging.solvers.checks.timed", lambda asked: (([], times) for _, times in timed(asked))
)
@pytest.mark.parametrize(("way", "quantity"), LARGE.values(), ids=LARGE)
def test_a_solver_that_is_right_on_small_grids_alone_is_wrong(way, quantity):
    """What is timed is judged, and its grid is named."""

    def solve(**given):
        p = ours(**given)
        return way(p) if len(p) > 48 else p

    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(checks, "GRIDS", (32, 64))
        points, times = checks.judged(asked(solve).model)
    wrong = {(point.quantity, point.where["problem"]) for point in points if point.verdict != WITHIN}
    assert (quantity, "rough, light load, 64 x 64 cells") in wrong
    assert {place for _, place in wrong} == {"rough, light load, 64 x 64 cells"}
    assert all(point.decides for point in points) and len(times) == (1 if quantity == "answer" else 2)


def test_a_solver_that_is_too_slow_for_a_large_grid_is_not_wrong_there(monkeypatch):
    late = asked(ours)
    monkeypatch.setattr(late.model, "calls", lambda *given: [Failed("no answer within 10 s", late=True)])
    ((found,), times), *more = checks.timed(late)
    assert (found.reason, found.decides, times, more) == ("no answer within 10 s", False, [], [])


def test_a_factor_in_our_own_operator_makes_us_wrong(monkeypatch):
    """The operator that judges is not ours, and no answer of ours is needed."""
    symbol = kernel.free_space_symbol
    monkeypatch.setattr(kernel, "free_space_symbol", lambda *of: 2 * symbol(*of))
    assert any("the answer for 0.5 times the modulus" in finding.reason for finding in wrong_in(ours))
    monkeypatch.setattr(checks, "GRIDS", (24,))
    ((found, times),) = checks.timed(asked(ours))
    assert len(times) == 1 and {point.verdict for point in found} == {WITHIN, OUTSIDE}
