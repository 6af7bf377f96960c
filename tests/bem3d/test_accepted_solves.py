"""What is called converged is within its tolerance, by a residual taken elsewhere; what was cut short says so.

An iteration does not depend on the tolerance that it is stopped by: cut after so many steps, it has the same residual
whatever was asked for, so that a tolerance a little above it must be met and one a little below it must not.
"""

from functools import partial

import numpy as np
import pytest

import bem3d
from bem3d import window_solve
from bem3d.window_solve import IterationState
from tests.oracles import displacement, residual
from tests.seeded import catches

ASKED = np.geomspace(3e-2, 3e-9, 15)
"""Close enough that a residual ten times too large falls between two of them."""
BELOW = (0.99, 0.5, 0.11)
"""Of the residual that is left: a tolerance that is nearly met, and one that a tenth of it would meet."""


def rough(periodic):
    rng = np.random.default_rng(5)
    body = bem3d.HalfSpace(shape=(14, 12), spacing=(0.1, 0.12), modulus=2.0, periodic=periodic)
    return body, -0.02 * rng.standard_normal(body.shape)


def solved(solver, periodic, **settings):
    body, gap = rough(periodic)
    return solver(body, gap, force=0.02, **settings)


def residual_by_hand(contact):
    return residual(contact.problem.half_space, contact.problem.gap, contact.pressure, contact.approach)


SOLVERS = {"solve": bem3d.solve, "solve_plain": bem3d.solve_polonsky_keer}


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("solver", SOLVERS)
def test_a_converged_contact_is_within_its_tolerance(solver, periodic):
    for tolerance in ASKED:
        contact = solved(SOLVERS[solver], periodic, tolerance=tolerance)
        assert contact.status == "converged"
        assert contact.residual <= tolerance
        assert residual_by_hand(contact) == pytest.approx(contact.residual, rel=1e-4, abs=1e-13)


def wheel(tolerance, **settings):
    track = bem3d.Track(height=bumps(), spacing=1 / 6, radius=1.0, modulus=1.0)
    return bem3d.RollingContact(track, tolerance=tolerance, **settings)


def fixed_area(**settings):
    body, gap = rough(False)
    return bem3d.solve_fixed_area(body, gap < 0, **settings)


def bumps():
    x = np.arange(48) / 6
    return 0.1 * np.cos(2 * np.pi * x / 4)[:, np.newaxis] * np.ones(24)


def a_path(**settings):
    return list(bem3d.indent(*rough(False), forces=[0.01, 0.02, 0.03], stiffness=True, **settings))


def rolled(**settings):
    return bem3d.roll(bumps(), spacing=1 / 6, radius=1.0, modulus=1.0, approach=1.0, positions=4, **settings)


ASKED_ONCE = {
    "solve": partial(solved, bem3d.solve, False, raise_on_failure=False),
    "solve_plain": partial(solved, bem3d.solve_polonsky_keer, False, raise_on_failure=False),
    "fixed area": partial(fixed_area, raise_on_failure=False),
    "wheel": lambda **settings: wheel(**settings).press(0, 1.0),
}


def at_ten_times_the_tolerance(attempt, residual, tolerance, max_iterations):
    judged(attempt, residual, 10 * tolerance, max_iterations)


judged = window_solve.IterationState.record_residual


@catches("accepted at ten times its tolerance", solver="solve", limit=3).at(
    "bem3d.window_solve.IterationState.record_residual", at_ten_times_the_tolerance
)
@catches("the iteration limit taken for convergence", solver="solve", limit=3).at(
    "bem3d.Contact.converged", property(lambda one: one.status in ("converged", "iteration limit"))
)
@pytest.mark.parametrize("limit", [1, 2, 3, 5, 8])
@pytest.mark.parametrize("solver", ASKED_ONCE)
def test_a_solve_that_is_cut_short_says_so(solver, limit):
    cut = partial(ASKED_ONCE[solver], max_iterations=limit)
    left = cut(tolerance=1e-13)
    assert not left.converged and getattr(left, "status", "iteration limit") == "iteration limit"
    if solver.startswith("solve"):
        assert residual_by_hand(left) == pytest.approx(left.residual, rel=1e-6)
    for part in BELOW:
        again = cut(tolerance=part * left.residual)
        assert again.converged == (again.residual <= part * left.residual)
    assert cut(tolerance=1.01 * left.residual).converged


@pytest.mark.parametrize("limit", [1, 3])
@pytest.mark.parametrize("asked", [*(partial(solved, s, False) for s in SOLVERS.values()), fixed_area, a_path, rolled])
def test_a_failure_is_raised_unless_it_is_wanted_as_a_value(asked, limit):
    cut = {"max_iterations": limit, "tolerance": 1e-12}
    with pytest.raises(bem3d.ConvergenceError, match=r"iteration limit|frozen-contact"):
        asked(**cut)
    found = asked(**cut, raise_on_failure=False)
    for contact in found if asked is a_path else [found]:
        assert not np.any(contact.converged)
        if isinstance(contact, bem3d.Contact):
            with pytest.raises(bem3d.ConvergenceError, match=r"no stiffness|iteration limit"):
                contact.stiffness()


@pytest.mark.parametrize(
    ("residuals", "status"),
    [
        ((0.0,), "converged"),
        ((1e-4,), "converged"),
        ((1.001e-4,), None),
        ((9.9e-4,), None),
        ((np.nan,), "breakdown"),
        ((1.0,) * 5, None),
        ((1.0,) * 6, "iteration limit"),
    ],
)
def test_the_tolerance_and_the_iteration_limit_are_those_of_the_caller(residuals, status):
    """1e-4 and 5; a history has an entry for the start, too."""
    attempt = IterationState(np.zeros((1, 1)), 1.0)
    for found in residuals:
        attempt.record_residual(found, 1e-4, 5)
    assert attempt.status == status
    assert attempt.history == list(residuals)


def test_every_load_of_a_path_is_within_its_tolerance():
    for tolerance in ASKED[::3]:
        for contact in a_path(tolerance=tolerance):
            assert contact.converged and contact.residual <= tolerance
            assert residual_by_hand(contact) <= tolerance * (1 + 1e-6)
            assert contact.frozen.converged


def test_a_fixed_area_is_within_its_tolerance():
    body, gap = rough(False)
    for tolerance in ASKED:
        found = fixed_area(tolerance=tolerance)
        left = 1 - displacement(body, found.pressure)[gap < 0]
        assert found.converged
        assert np.sqrt(np.mean(left**2)) <= tolerance * (1 + 1e-6)


@catches("a residual of rolling that is not looked at").at("bem3d.rolling_solve.residual", lambda *_: 0.0)
def test_every_position_of_a_wheel_is_within_its_tolerance():
    body = bem3d.HalfSpace(shape=(48, 24), spacing=1 / 6, modulus=1.0)
    for tolerance in ASKED[:-4]:
        rolling = wheel(tolerance)
        for position in range(3):
            contact = rolling.press(position, 1.0)
            x, y, pressure = rolling.pressure()
            rows, columns = np.rint(6 * x).astype(int) + 24, np.rint(6 * y + 11.5).astype(int)
            whole = np.zeros(body.shape)
            whole[np.ix_(rows, columns)] = pressure
            gap = ((np.arange(48) - 24)[:, np.newaxis] ** 2 + (np.arange(24) - 11.5) ** 2) / 36 / 2
            gap -= np.roll(bumps(), 24 - position, axis=0)
            assert contact.converged and contact.residual <= tolerance
            assert residual(body, gap, whole, 1.0) == pytest.approx(contact.residual, rel=1e-3, abs=1e-12)
