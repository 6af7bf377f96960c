"""Wrong solvers of others are caught, each with its own cause first; right ones are not refused."""

import pytest

from tests.benchmarks.foreign_solver import WRONG
from validation.analysis.judgement import AGREE
from validation.benchmarks.judging import discrete, judged
from validation.benchmarks.judging.judged import findings
from validation.benchmarks.judging.properties import Asked
from validation.engine.offered import KINDS, Offered
from validation.engine.others import Called
from validation.report.judged_solver import solver_lines

FEW = (
    "flat",
    "odd grid",
    "odd along axis 1",
    "oblong",
    "cells of 2:1",
    "cells of 1:4",
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
    few = tuple(stored[name] for name in (*FEW, "rough, heavy load"))
    monkeypatch.setattr(judged, "problems", lambda: few)


def said_first(points):
    """Of the summary."""
    return next(line for line in list(solver_lines("foreign", points, (), 0.0))[1:]).strip()


@pytest.mark.parametrize(("function", "cause"), WRONG.values(), ids=WRONG)
def test_a_wrong_solver_is_caught_and_its_cause_is_named_first(function, cause, few_problems):
    points = findings(Asked(solver(on_free_space(function))))
    assert any(point.verdict != AGREE and point.decides for point in points)
    assert cause in said_first(points)
