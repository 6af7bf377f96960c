"""Solvers of others: the right one is accepted, each planted fault is caught and named."""

import runpy
import warnings
from pathlib import Path

import numpy as np
import pytest

import bem3d
from bem3d import kernel
from tests import oracles
from validation.analysis.judgement import AGREE
from validation.benchmarks.judging import discrete
from validation.benchmarks.judging.judged import Asked, timed
from validation.engine.offered import Offered
from validation.engine.others import Called

EXAMPLE = Path(discrete.__file__).parents[2] / "examples" / "own_solver.py"


def ours(gap, spacing, modulus, periodic, tolerance, **load):
    half_space = bem3d.HalfSpace(shape=gap.shape, spacing=spacing, modulus=modulus, periodic=periodic)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        return bem3d.solve(half_space, gap, tolerance=tolerance, **load).pressure


def right(finding):
    return finding.verdict == AGREE


def asked(solve, load="force", **options):
    """As of somebody's file."""
    options = {"free": True, "periodic": False, "residual": 1e-4} | options
    asks = ("gap", "spacing", "modulus", "periodic", "tolerance", load)
    return Asked(Called(Offered("contact_solver", "planted", solve, asks, options)))


def wrong_in(one):
    return [finding for finding in one.findings() if not right(finding)]


@pytest.mark.parametrize("load", ["force", "approach"])
def test_our_solver_is_right_on_every_problem(load):
    findings = list(asked(ours, load, periodic=True).findings())
    assert {finding.where["problem"] for finding in findings} == set(discrete.STATED)
    assert all(right(finding) for finding in findings)


def test_a_solver_of_forty_lines_is_accepted():
    example = runpy.run_path(str(EXAMPLE))["solve"]
    findings = list(Asked(Called(example)).findings())
    assert all(right(finding) for finding in findings)
    assert not any("periodic" in finding.where["problem"] for finding in findings), (
        "what it does not serve is not asked"
    )


def changed(**factors):
    return lambda **given: ours(**{**given, **{name: given[name] * by for name, by in factors.items()}})


def spoiled(way):
    return lambda **given: way(ours(**given))


FAULTS = {
    "E for E*": (changed(modulus=1 / 0.91), "complementarity", "the answer for 1.099 times the modulus"),
    "a factor 2 in the operator": (changed(modulus=0.5), "complementarity", "an operator with a factor of 2"),
    "no padding": (lambda **given: ours(**{**given, "periodic": True}), "penetration", "no padding"),
    "half a cell": (
        spoiled(lambda p: (p + np.roll(p, 1, axis=0)) / 2),
        "pressure",
        "shifted by 0.5 cells along axis 0",
    ),
    "a loose stop": (changed(tolerance=300.0), "penetration", ""),
    "pressure outside": (
        spoiled(lambda p: p + 0.01 * p.max() * (p == 0)),
        "complementarity",
        "is outside of the contact",
    ),
    "a force that is not held": (changed(force=1.01), "force balance", "force not held"),
    "tension": (spoiled(lambda p: p - 0.01 * p.max() * (p == 0)), "tension", "tension, -0.01 of the largest pressure"),
}


@pytest.mark.parametrize(("solve", "quantity", "reason"), FAULTS.values(), ids=FAULTS)
def test_a_planted_fault_is_caught_and_named(solve, quantity, reason):
    wrong = wrong_in(asked(solve))
    assert len({finding.where["problem"] for finding in wrong}) > 3
    assert any(reason in finding.reason for finding in wrong if finding.quantity == quantity)


@pytest.mark.parametrize("fault", ["E for E*", "a factor 2 in the operator", "half a cell", "tension"])
def test_a_fault_is_caught_by_approach_too(fault):
    solve, _, reason = FAULTS[fault]
    wrong = wrong_in(asked(solve, "approach"))
    assert any(reason in finding.reason for finding in wrong)


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
    first = next(iter(asked(lambda gap, **_: answer(gap)).findings()))
    assert not right(first)
    assert reason in first.reason


def test_a_solver_that_depends_on_units_or_on_an_axis_is_caught():
    def in_units(gap, **given):
        return ours(np.round(gap, 7), **given)

    def by_axis(gap, spacing, **given):
        return ours(gap, (spacing[0], spacing[0]), **given)

    assert "scaling in length" in {finding.quantity for finding in wrong_in(asked(in_units))}
    assert {finding.where["problem"] for finding in wrong_in(asked(by_axis))} == {"cells of two lengths"}


def test_the_stored_answers_are_those_of_a_dense_matrix():
    """A smaller grid of each problem that a matrix can hold."""
    for name, cells in (("sphere", 12), ("tilted", 12), ("cells of two lengths", 12), ("rough, heavy load", 24)):
        problem = discrete.problem_on(name, cells)
        (n, m), spacing = problem.gap.shape, problem.spacing
        half_space = bem3d.HalfSpace(shape=(n, m), spacing=spacing, modulus=problem.modulus)
        known = oracles.contact_by_least_squares(half_space, problem.gap / 1e-6, problem.approach / 1e-6) * 1e-6
        assert problem.pressure == pytest.approx(known, abs=1e-6 * known.max())


def test_stored_problems_are_made_anew_to_their_digits_and_hold_their_limits():
    stored = {problem.name: problem for problem in discrete.problems()}
    assert list(stored) == list(discrete.STATED)
    sphere, flat = stored["sphere"], stored["flat"]
    anew = discrete.problem_on("sphere", discrete.CELLS)
    np.testing.assert_allclose(anew.pressure, sphere.pressure, atol=1e-7 * sphere.pressure.max())
    radius, a = discrete.SIDE / discrete.LOW, discrete.SIDE / 5
    hertz = (a**2 / radius, 2 * sphere.modulus * a, np.pi * a**2)
    punch = flat.force / (1.1523 * flat.modulus * discrete.SIDE)
    assert (np.abs(sphere.limits[:, 0] - hertz) <= 2 * sphere.limits[:, 1] + 0.01 * np.abs(hertz)).all()
    assert flat.limits[0, 0] == pytest.approx(punch, rel=2e-4)


def test_a_solver_is_timed_beside_ours_until_it_takes_too_long(monkeypatch):
    monkeypatch.setattr("validation.benchmarks.judging.judged.GRIDS", (24, 32))
    rows = timed(asked(ours))
    assert [row.cells for row in rows] == [24, 32]
    assert all(row.seconds > 0 and row.ours > 0 for row in rows)


def test_a_factor_in_our_own_operator_makes_us_wrong(monkeypatch):
    """The operator that judges is not ours."""
    symbol = kernel.free_space_symbol
    monkeypatch.setattr(kernel, "free_space_symbol", lambda *of: 2 * symbol(*of))
    wrong = wrong_in(asked(ours))
    assert any("the answer for 0.5 times the modulus" in finding.reason for finding in wrong)
