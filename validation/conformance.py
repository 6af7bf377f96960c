"""Properties that every contact solver and every rule for profiles has, as tests for their author.

``pytest --pyargs validation.conformance --contact-solver my_solver.py:solve --mapping my_rule.py:rule``

The file is run as a program. Without an option `bem3d` and Geike's rule are tested. A failure ends with the smallest
example that hypothesis finds, as arrays that can be pasted.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, note, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from validation.benchmarks.judging.discrete import KnownContact, problems
from validation.benchmarks.judging.given import approach_of, inside, roughness_of, rule_of, solver_of
from validation.benchmarks.judging.judged import Asked, moved, pressed, scaled

FloatArray = NDArray[np.float64]
Rule = Callable[..., FloatArray]
np.set_printoptions(precision=17)
slow = settings(deadline=None, suppress_health_check=list(HealthCheck), max_examples=30)


# --- contact solvers ---


@pytest.fixture(scope="module")
def asked(request: pytest.FixtureRequest) -> Asked:
    """The solver under test; that of this project without one."""
    return solver_of(request.config.getoption("--contact-solver", None))


@st.composite
def contacts(draw: st.DrawFn) -> KnownContact:
    """A few cells of any heights, from a light load on; its answer is not known."""
    n, m = draw(st.integers(1, 8)), draw(st.integers(1, 8))
    heights = st.lists(st.integers(0, 100), min_size=n * m, max_size=n * m)
    spacing = draw(st.sampled_from([(1e-6, 1e-6), (1e-3, 5e-4), (0.2, 0.5)]))
    modulus = draw(st.sampled_from([1e6, 1e9, 2.3e11]))
    gap = np.array(draw(heights), dtype=float).reshape(n, m) * 1e-4 * spacing[0]
    part = draw(st.sampled_from([1e-3, 0.05, 1.0]))
    force = part * modulus * 1e-2 * math.sqrt(n * m) * spacing[0] * math.sqrt(spacing[0] * spacing[1])
    return replace(problems()[0], name="drawn", gap=gap, spacing=spacing, modulus=modulus, force=force)


def pasted(array: FloatArray) -> str:
    """As an array that can be pasted, with all digits."""
    with np.printoptions(precision=17):
        return f"np.{array!r}"


def solved(asked: Asked, problem: KnownContact, like: str = "") -> FloatArray:
    """The pressure under the force, or under the approach that our solver finds for it."""
    note(f"gap = {pasted(problem.gap)}\nspacing, modulus = {problem.spacing}, {problem.modulus!r}{like}")
    if not asked.by_force:
        problem = replace(problem, approach=approach_of(problem))
        note(f"approach = {problem.approach!r}")
    else:
        note(f"force = {problem.force!r}")
    found = asked.pressure(problem)
    assert isinstance(found, np.ndarray), found
    left = asked.left(problem, found)
    note(f"pressure = {pasted(found)}\n{left}")
    assert left.worst <= asked.residual, f"a residual of {left.worst:.3g}, promised: {asked.residual:g}"
    if asked.by_force:
        assert found.sum() * problem.cell == pytest.approx(problem.force, rel=asked.residual), "the force is not held"
    return found


def same(asked: Asked, one: FloatArray, other: FloatArray) -> None:
    """As far as the residual settles a pressure: by its mean square over that of the larger."""
    scale = max(float(np.linalg.norm(one)), float(np.linalg.norm(other)))
    assert np.linalg.norm(one - other) <= max(300 * asked.residual, 1e-9) * scale


@slow
@given(contacts())
def test_pressures_carry_no_tension_and_nothing_overlaps(asked: Asked, problem: KnownContact) -> None:
    solved(asked, problem)


@slow
@given(contacts(), st.sampled_from([1e-3, 7.0]), st.sampled_from([1e-2, 3.0]))
def test_pressures_go_with_the_modulus_and_not_with_the_length(
    asked: Asked, problem: KnownContact, length: float, modulus: float
) -> None:
    other = solved(asked, scaled(problem, modulus=modulus, length=length), ", in other units")
    same(asked, other / modulus, solved(asked, problem))


@slow
@given(contacts(), st.sampled_from([np.flipud, np.fliplr]))
def test_a_mirrored_indenter_has_the_mirrored_pressure(
    asked: Asked, problem: KnownContact, way: Callable[[FloatArray], FloatArray]
) -> None:
    same(asked, way(solved(asked, moved(problem, way), ", mirrored")), solved(asked, problem))


@slow
@given(contacts())
def test_a_larger_load_presses_no_cell_out_of_contact(asked: Asked, problem: KnownContact) -> None:
    """Of a convex functional with K^-1 an M-matrix up to the residual: pressures of more load sum to more."""
    light, heavy = solved(asked, pressed(problem, 0.5), ", half of it"), solved(asked, problem)
    approach = [asked.left(one, p).approach for one, p in ((pressed(problem, 0.5), light), (problem, heavy))]
    assert approach[1] >= approach[0] - asked.residual * abs(approach[0])
    assert heavy.sum() >= light.sum() * (1 - asked.residual)


# --- rules for profiles ---


@pytest.fixture(scope="module")
def rule(request: pytest.FixtureRequest) -> Rule:
    """C_1D(q) of a roughness; Geike's rule without one."""
    rule: Rule = rule_of(request.config.getoption("--mapping", None))
    return rule


bands = st.tuples(st.floats(0.1, 1.0), st.floats(1e2, 1e5), st.floats(2.0, 100.0), st.floats(1e-8, 1e-4))


@slow
@given(bands)
def test_a_profile_spectrum_is_finite_and_not_negative(rule: Rule, band: Any) -> None:
    roughness = roughness_of(*band)
    found = np.asarray(rule(q=inside(roughness)[0], roughness=roughness))
    assert np.isfinite(found).all() and (found >= 0).all() and found.max() > 0


@slow
@given(bands, st.sampled_from([1e-2, 5.0]))
def test_a_profile_spectrum_is_linear_in_that_of_the_surface(rule: Rule, band: Any, factor: float) -> None:
    hurst, q_min, ratio, rms = band
    roughness, other = roughness_of(*band), roughness_of(hurst, q_min, ratio, rms * math.sqrt(factor))
    q = inside(roughness)[0]
    np.testing.assert_allclose(
        rule(q=q, roughness=other), factor * np.asarray(rule(q=q, roughness=roughness)), rtol=1e-6
    )


@slow
@given(bands, st.sampled_from([1e-3, 40.0]))
def test_a_profile_spectrum_has_no_length_of_its_own(rule: Rule, band: Any, length: float) -> None:
    """x -> s x and h -> s h takes C_1D(q) [m^3] to s^3 C_1D(s q)."""
    hurst, q_min, ratio, rms = band
    roughness, other = roughness_of(*band), roughness_of(hurst, q_min / length, ratio, rms * length)
    q = inside(roughness)[0]
    found, wanted = rule(q=q / length, roughness=other), length**3 * np.asarray(rule(q=q, roughness=roughness))
    np.testing.assert_allclose(found, wanted, rtol=1e-6)


@slow
@pytest.mark.parametrize(("moment", "name"), [(0, "height"), (2, "gradient"), (4, "curvature")])
@given(bands)
def test_the_profile_has_the_mean_square_of_the_surface(rule: Rule, moment: int, name: str, band: Any) -> None:
    """Geike's moments: int |q|^n C_1D dq over both signs is int |q|^n C_2D d²q, for the height, gradient, curvature."""
    roughness = roughness_of(*band)
    q, weight = inside(roughness)
    line = 2 * (weight * q**moment * np.asarray(rule(q=q, roughness=roughness))).sum()
    surface = 2 * math.pi * (weight * q ** (moment + 1) * roughness.c2d(q)).sum()
    assume(surface > 0)
    assert line == pytest.approx(surface, rel=1e-6), f"mean square {name} of the profile over that of the surface"
