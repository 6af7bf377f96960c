"""The tests of `validation.conformance`: properties of a contact solver and of a rule, on drawn examples."""

import math
import warnings
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from timeit import repeat
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, assume, given, note, settings
from hypothesis import strategies as st

from validation.analysis.evidence import Verdict
from validation.benchmarks.discrete import STATED, ContactProblem, pressed
from validation.judging import MAPPING, SOLVER
from validation.judging.judgement import JudgedNumber
from validation.judging.kinds.profiles import properties_of_rule
from validation.judging.own_models import named_in
from validation.judging.registry import KINDS, FloatArray, offer
from validation.judging.solvers.properties import PROPERTIES, JudgedSolver, UnansweredError, loads_of, served
from validation.judging.worker import Called

OF_RULE = 1e-3
"""Relative, the error of the quadrature included."""
EXAMPLES, LONGEST = 30, 10.0
"""Of each property; until they take so long [s]."""
all_examples = settings(deadline=None, suppress_health_check=list(HealthCheck), max_examples=EXAMPLES)


def settings_for(example: Callable[[], object]) -> settings:
    """Fewer examples, and no search for a smaller one, where all would take longer than `LONGEST`."""
    seconds = min(repeat(example, number=1, repeat=2))
    if (count := max(min(EXAMPLES, int(LONGEST / seconds)), 1)) == EXAMPLES:
        return all_examples
    warnings.warn(f"{count} of {EXAMPLES} examples, none made smaller: one takes {seconds:.2g} s", stacklevel=2)
    return settings(all_examples, max_examples=count, phases=[Phase.explicit, Phase.reuse, Phase.generate])


# --- contact solvers ---


class Noted(JudgedSolver):
    """What it is asked, and what it answers, stands below a failure."""

    def pressure(self, problem: ContactProblem) -> FloatArray:
        """As its parent."""
        names = ("gap", "spacing", "modulus", "periodic", "force" if self.by_force else "approach")
        note("\n".join(f"{name} = {pasted(getattr(problem, name))}" for name in names))
        pressure = super().pressure(problem)
        note(f"pressure = {pasted(pressure)}")
        return pressure


def pasted(value: Any) -> str:
    """With all digits."""
    with np.printoptions(precision=17):
        return f"np.{value!r}" if isinstance(value, np.ndarray) else repr(value)


def ours(gap: FloatArray, spacing: Any, modulus: float, periodic: bool, tolerance: float, force: float) -> FloatArray:
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=periodic, force=force)
    return pressed(problem, tolerance, force=force).pressure


@pytest.fixture(scope="module")
def asked(request: pytest.FixtureRequest) -> list[JudgedSolver]:
    """The solver under test, called in this process, by each load that it offers; that of this project without one."""
    place = request.config.getoption(SOLVER, None)
    options = {**KINDS["contact_solver"].options, "periodic": True, "residual": 1e-5}
    solver = Called(named_in(place, "contact_solver") if place else offer("contact_solver", "bem3d", options, ours))
    return [Noted(solver, by=load) for load in loads_of(solver)]


@st.composite
def contacts(draw: st.DrawFn, half_spaces: Sequence[bool], cells: float) -> ContactProblem:
    """A few cells of any heights, from a light load on; an approach below the mean, which a periodic one can have.

    half_spaces: periodic or not; cells: the most of a grid.
    """
    n = draw(st.integers(1, int(min(8, cells))))
    m = draw(st.integers(1, int(min(8, cells / n))))
    heights = st.lists(st.integers(0, 100), min_size=n * m, max_size=n * m)
    spacing = draw(st.sampled_from([(1e-6, 1e-6), (1e-3, 5e-4), (0.2, 0.5)]))
    modulus = draw(st.sampled_from([1e6, 1e9, 2.3e11]))
    gap = np.array(draw(heights), dtype=float).reshape(n, m) * 1e-4 * spacing[0]
    part, periodic = draw(st.sampled_from([1e-3, 0.05, 0.9])), draw(st.sampled_from(half_spaces))
    # what is flat has no overlap on a periodic half-space
    depth = gap.mean() - gap.min() if periodic else 1e-2 * spacing[0]
    assume(depth > 0)
    force = part * modulus * 1e-2 * math.sqrt(n * m) * spacing[0] * math.sqrt(spacing[0] * spacing[1])
    values: dict[str, Any] = {"gap": gap, "spacing": spacing, "modulus": modulus, "periodic": periodic, "force": force}
    return ContactProblem(name="drawn", approach=gap.min() + part * depth, **values)


def points_by_each(
    solvers: Sequence[JudgedSolver], name: str, problem: ContactProblem, unserved: list[str]
) -> list[JudgedNumber]:
    """Of a property, by each load; what the solver says that it does not serve goes to a list."""
    points = list[JudgedNumber]()
    for solver in solvers:
        try:
            points += PROPERTIES[name](solver, problem)
        except UnansweredError as error:
            if not error.unserved:
                raise
            unserved.append(str(error))
    return points


@pytest.mark.parametrize("name", PROPERTIES)
def test_a_contact_solver_has_the_property(asked: list[JudgedSolver], name: str) -> None:
    """What it does not serve is not asked; where it serves nothing that the property needs, the test is skipped."""
    solver, unserved, answers = asked[0], list[str](), list[str]()
    keys = {True: "periodic", False: "free"}
    half_spaces = [periodic for periodic in served(PROPERTIES[name]) if solver.model.options[keys[periodic]]]
    if not half_spaces:
        pytest.skip("a property of half-spaces that the solver does not serve")

    def holds(problem: ContactProblem) -> None:
        for point in points_by_each(asked, name, problem, unserved):
            message = f"{point.quantity}, deviation {point.difference:.3g}: {point.reason}"
            assert point.verdict is Verdict.WITHIN, message
            answers.append(point.quantity)

    sphere = STATED["sphere, periodic" if half_spaces[0] else "sphere"].on(int(min(8, solver.cells**0.5)))

    def example() -> None:
        with suppress(UnansweredError):
            for _ in range(2):
                JudgedSolver(solver.model).pressure(
                    replace(sphere, approach=float(sphere.gap.mean() + sphere.gap.min()) / 2)
                )

    settings_for(example)(given(contacts(half_spaces, solver.cells))(holds))()
    if unserved and not answers:
        pytest.skip(unserved[0])
    if unserved:
        warnings.warn(f"{len(unserved)} examples are {unserved[0]}", stacklevel=1)


# --- rules for profiles ---


@pytest.fixture(scope="module")
def rule(request: pytest.FixtureRequest) -> Called:
    """C_1D(q) of a roughness; Geike's rule without one."""
    place = request.config.getoption(MAPPING, None)
    geike = offer("profile_spectrum", "Geike", {}, lambda q, roughness: roughness.c1d(q))
    return Called(named_in(place, "profile_spectrum") if place else geike)


def test_a_rule_has_the_properties(rule: Called) -> None:
    """Of `judge`."""

    def holds(hurst: float, q_min: float, ratio: float, rms: float) -> None:
        for finding in properties_of_rule(rule, hurst, q_min, q_min * ratio, rms):
            number = finding.judged(OF_RULE)
            assert number.verdict is Verdict.WITHIN, f"{number.quantity}: {number.shown}"

    drawn = st.floats(0.1, 1.0), st.floats(1e2, 1e5), st.floats(2.0, 100.0), st.floats(1e-8, 1e-4)
    settings_for(lambda: list(properties_of_rule(rule, 0.7, 1e3, 1e5, 1e-6)))(given(*drawn)(holds))()
