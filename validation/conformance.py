"""Properties that every contact solver and every rule for profiles has, as tests for their author.

``pytest --pyargs validation.conformance --contact-solver my_solver.py:solve --mapping my_rule.py:rule``

The file is run as a program. Without an option `bem3d` and Geike's rule are tested. A failure ends with the smallest
example that hypothesis finds, as arrays that can be pasted.
"""

import math
import runpy
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, note, settings
from hypothesis import strategies as st

import mdr
from validation.analysis.judgement import AGREE
from validation.benchmarks.judging.discrete import ContactProblem, pressed
from validation.benchmarks.judging.properties import PROPERTIES, Asked
from validation.engine.offered import KINDS, FloatArray, Offered, offer
from validation.engine.others import Called
from validation.theory.gauss_legendre import on_panels

Rule = Callable[..., FloatArray]
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
    known = {"gap": gap, "spacing": spacing, "modulus": modulus, "periodic": periodic, "force": force}
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
def rule(request: pytest.FixtureRequest) -> Rule:
    """C_1D(q) of a roughness; Geike's rule without one."""
    place = request.config.getoption("--mapping", None)
    return named_in(place, "profile_spectrum").function if place else lambda q, roughness: roughness.c1d(q)


bands = st.builds(
    lambda hurst, q_min, ratio, rms: mdr.SelfAffine(hurst=hurst, q_min=q_min, q_max=q_min * ratio, rms=rms),
    *(st.floats(*ends) for ends in ((0.1, 1.0), (1e2, 1e5), (2.0, 100.0), (1e-8, 1e-4))),
)


def inside(roughness: mdr.SelfAffine) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of an integral over the band."""
    return on_panels(np.geomspace(roughness.q_min, roughness.q_max, 40), 10)


@slow
@given(bands)
def test_a_profile_spectrum_is_finite_and_not_negative(rule: Rule, roughness: mdr.SelfAffine) -> None:
    found = np.asarray(rule(q=inside(roughness)[0], roughness=roughness))
    assert np.isfinite(found).all() and (found >= 0).all() and found.max() > 0


@slow
@given(bands, st.sampled_from([1e-2, 5.0]), st.sampled_from([1e-3, 1.0, 40.0]))
def test_a_profile_spectrum_is_linear_in_that_of_the_surface_and_has_no_length_of_its_own(
    rule: Rule, roughness: mdr.SelfAffine, factor: float, s: float
) -> None:
    """x -> s x and h -> s h takes C_1D(q) [m^3] to s^3 C_1D(s q), and f C_2D takes it to f C_1D."""
    q, band = inside(roughness)[0], {"q_min": roughness.q_min / s, "q_max": roughness.q_max / s}
    other = replace(roughness, rms=s * math.sqrt(factor) * roughness.rms, **band)
    found, wanted = rule(q=q / s, roughness=other), factor * s**3 * np.asarray(rule(q=q, roughness=roughness))
    np.testing.assert_allclose(found, wanted, rtol=1e-6)


@slow
@pytest.mark.parametrize(("moment", "name"), [(0, "height"), (2, "gradient"), (4, "curvature")])
@given(roughness=bands)
def test_the_profile_has_the_mean_square_of_the_surface(
    rule: Rule, moment: int, name: str, roughness: mdr.SelfAffine
) -> None:
    """Geike's moments: int |q|^n C_1D dq over both signs is int |q|^n C_2D d²q, for the height, gradient, curvature."""
    q, weight = inside(roughness)
    line = 2 * (weight * q**moment * np.asarray(rule(q=q, roughness=roughness))).sum()
    surface = 2 * math.pi * (weight * q ** (moment + 1) * roughness.c2d(q)).sum()
    assert line == pytest.approx(surface, rel=1e-6), f"mean square {name} of the profile over that of the surface"
