"""The tests of `validation.conformance`: properties of a contact solver and of a rule, on drawn examples."""

import math
import runpy
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, note, settings
from hypothesis import strategies as st

from validation.analysis.judgement import AGREE
from validation.benchmarks.judging.discrete import ContactProblem, pressed
from validation.benchmarks.judging.properties import PROPERTIES, Asked
from validation.engine.offered import KINDS, FloatArray, Offered, offer
from validation.engine.others import Called
from validation.selection.judging.profiles import properties_of_rule

OF_RULE = 1e-3
"""Relative, the error of the quadrature included."""
slow = settings(deadline=None, suppress_health_check=list(HealthCheck), max_examples=30)


def named_in(place: str, kind: str) -> Offered:
    """FILE:NAME, a function with or without its decorator; the file is run, and its folder can be imported.

    Raises ValueError where there is none.
    """
    file, _, name = place.rpartition(":")
    if not Path(file).is_file():
        raise ValueError(f"a function is named as FILE:NAME, and there is no file {file!r} in {place!r}")
    sys.path.insert(0, str(Path(file).resolve().parent))
    found = runpy.run_path(file).get(name)
    if isinstance(found, Offered) and found.kind == kind:
        return found
    if not callable(found) or isinstance(found, Offered):
        raise ValueError(f"{file} has no function {name!r} for @{kind}")
    return offer(kind, name, KINDS[kind].options, found)


# --- contact solvers ---


class Noted(Asked):
    """What it is asked, and what it answers, stands below a failure."""

    def pressure(self, problem: ContactProblem) -> FloatArray:
        """As its parent."""
        asked = ("gap", "spacing", "modulus", "periodic", "force" if self.by_force else "approach")
        note("\n".join(f"{name} = {pasted(getattr(problem, name))}" for name in asked))
        found = super().pressure(problem)
        note(f"pressure = {pasted(found)}")
        return found


def pasted(value: Any) -> str:
    """With all digits."""
    with np.printoptions(precision=17):
        return f"np.{value!r}" if isinstance(value, np.ndarray) else repr(value)


def ours(gap: FloatArray, spacing: Any, modulus: float, periodic: bool, tolerance: float, force: float) -> FloatArray:
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=periodic, force=force)
    return pressed(problem, tolerance, force=force).pressure


@pytest.fixture(scope="module")
def asked(request: pytest.FixtureRequest) -> Asked:
    """The solver under test, called in this process; that of this project without one."""
    place = request.config.getoption("--contact-solver", None)
    options = {**KINDS["contact_solver"].options, "periodic": True, "residual": 1e-5}
    return Noted(
        Called(named_in(place, "contact_solver") if place else offer("contact_solver", "bem3d", options, ours))
    )


@st.composite
def contacts(draw: st.DrawFn) -> ContactProblem:
    """A few cells of any heights, from a light load on; an approach below the mean, which a periodic one can have."""
    n, m = draw(st.integers(1, 8)), draw(st.integers(1, 8))
    heights = st.lists(st.integers(0, 100), min_size=n * m, max_size=n * m)
    spacing = draw(st.sampled_from([(1e-6, 1e-6), (1e-3, 5e-4), (0.2, 0.5)]))
    modulus = draw(st.sampled_from([1e6, 1e9, 2.3e11]))
    gap = np.array(draw(heights), dtype=float).reshape(n, m) * 1e-4 * spacing[0]
    part, periodic = draw(st.sampled_from([1e-3, 0.05, 0.9])), draw(st.booleans())
    # what is flat has no overlap on a periodic half-space
    depth = gap.mean() - gap.min() if periodic else 1e-2 * spacing[0]
    assume(depth > 0)
    force = part * modulus * 1e-2 * math.sqrt(n * m) * spacing[0] * math.sqrt(spacing[0] * spacing[1])
    known: dict[str, Any] = {"gap": gap, "spacing": spacing, "modulus": modulus, "periodic": periodic, "force": force}
    return ContactProblem(name="drawn", approach=gap.min() + part * depth, **known)


@slow
@pytest.mark.parametrize("name", PROPERTIES)
@given(problem=contacts())
def test_a_contact_solver_has_the_property(asked: Asked, name: str, problem: ContactProblem) -> None:
    """What it does not serve is not asked."""
    assume(asked.serves(problem))
    for found in PROPERTIES[name](asked, problem):
        assert found.verdict == AGREE, f"{found.quantity}, {found.difference:.3g} off: {found.reason}"


# --- rules for profiles ---


@pytest.fixture(scope="module")
def rule(request: pytest.FixtureRequest) -> Called:
    """C_1D(q) of a roughness; Geike's rule without one."""
    place = request.config.getoption("--mapping", None)
    geike = offer("profile_spectrum", "Geike", {}, lambda q, roughness: roughness.c1d(q))
    return Called(named_in(place, "profile_spectrum") if place else geike)


@slow
@given(st.floats(0.1, 1.0), st.floats(1e2, 1e5), st.floats(2.0, 100.0), st.floats(1e-8, 1e-4))
def test_a_rule_has_the_properties(rule: Called, hurst: float, q_min: float, ratio: float, rms: float) -> None:
    """Of `judge`."""
    for finding in properties_of_rule(rule, hurst, q_min, q_min * ratio, rms):
        found = finding.judged(OF_RULE)
        assert found.verdict == AGREE, f"{found.quantity}: {found.shown}"
