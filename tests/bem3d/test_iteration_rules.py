"""Where an iteration ends: with its last pressure, and after rounds that gain nothing."""

import itertools

import numpy as np
import pytest

import bem3d
from bem3d import projected_cg, rolling_solve, window_solve
from bem3d.projected_cg import Load
from bem3d.window import Candidates
from tests import oracles


def solve_on(frame):
    """A flat gap on a frame of 4 x 4 cells, at a unit approach."""
    attempt, flat = window_solve.IterationState(np.zeros((4, 4)), 0.0), np.zeros((4, 4))
    given = {"near": flat, "load": Load(overlap=1.0), "tolerance": 1e-6, "max_iterations": 99}
    return rolling_solve.FrameSolve(frame=frame, attempt=attempt, **given)


def test_an_iteration_without_a_way_down_ends_with_its_last_pressure(monkeypatch):
    def three(*given):
        return (projected_cg.State(np.full(16, float(i)), 0.5) for i in range(3))

    monkeypatch.setattr(rolling_solve, "projected_cg", three)
    track = bem3d.Track(height=np.zeros((40, 40)), spacing=1 / 8, radius=1.0, modulus=1.0)
    on_frame, field = solve_on(rolling_solve.Frame(track, ((0, 4), (18, 22)))), np.ones((4, 4))
    assert (on_frame._iterated(field > 0, field, field) == 2.0).all()
    assert on_frame.attempt.operator_applications == len(on_frame.attempt.history) == 3


def test_patience_ends_where_the_residual_has_not_halved(monkeypatch):
    """At the next after 100 iterations of a press, and after 30 of a wheel."""

    def forever(cells, pressure, separation, load, length=0.4):
        return itertools.repeat(projected_cg.State(pressure, 0.5))

    for module in (window_solve, rolling_solve):
        monkeypatch.setattr(module, "projected_cg", forever)
    half_space, field = bem3d.HalfSpace(shape=(4, 4), spacing=1.0, modulus=1.0), np.ones((4, 4))
    attempt = window_solve.IterationState(np.zeros((4, 4)), 0.0)
    cells, vector = Candidates(half_space, field > 0), np.ones(16)
    window_solve._iterate(cells, vector, vector, Load(overlap=1.0), attempt, 1e-9, 10**6)
    track = bem3d.Track(height=np.zeros((40, 40)), spacing=1 / 8, radius=1.0, modulus=1.0)
    on_frame = solve_on(rolling_solve.Frame(track, ((0, 4), (18, 22))))
    on_frame._iterated(field > 0, field, field)
    assert (len(attempt.history), len(on_frame.attempt.history)) == (101, 32)


@pytest.mark.parametrize("load", [Load(overlap=1.0), Load(total=0.2454)])
@pytest.mark.parametrize("separation", [[-1.0293, 2.9952], [-3.0, 0.5], [2.0, 1.0]])
def test_a_start_that_pulls_is_made_one_that_presses(load, separation):
    """Under the same force, with the displacement that it has; at worst, where a step takes all, it presses evenly."""
    cells = Candidates(bem3d.HalfSpace(shape=(1, 2), spacing=1.0, modulus=1.0), np.ones((1, 2), dtype=bool))
    pressure, separation = np.array([0.3094, -0.064]), np.array(separation)
    pressing, moved = rolling_solve._pressing(cells, pressure, separation, load)
    assert (pressing >= 0).all()
    np.testing.assert_allclose(moved - separation, cells.displacement(pressing - pressure), atol=1e-12)
    assert load.total is None or pressing.sum() == pytest.approx(load.total, rel=1e-12)


def rounds_of_press(monkeypatch, errors):
    """Of a punch with a flat face, which all cells touch: iterations that leave an error of so much, in turn."""
    half_space, depth = bem3d.HalfSpace(shape=(4, 4), spacing=1.0, modulus=1.0), 1.0
    exact = np.linalg.solve(oracles.dense_operator(half_space), np.full(16, depth)).reshape(4, 4)
    monkeypatch.setattr(window_solve, "_iterate", lambda *_: (1 + next(errors)) * exact.ravel())
    problem = bem3d.problem.Problem(half_space=half_space, gap=np.zeros((4, 4)), approach=depth)
    attempt = window_solve.solve_on_window(problem, window_solve.InitialGuess((1 + next(errors)) * exact), 1e-6, 99)
    return attempt.operator_applications, str(attempt.status)


def rounds_of_rolling(monkeypatch, errors):
    """The same of a wheel so large that it is flat, on a frame of which it touches all."""
    track = bem3d.Track(height=np.zeros((9, 9)), spacing=1.0, radius=1e12, modulus=1.0)
    frame = rolling_solve.Frame(track, ((-2, 2), (2, 6)))
    on_frame = solve_on(frame)
    exact = np.linalg.solve(oracles.dense_operator(frame.half_space), np.ones(16)).reshape(4, 4)

    def iterated(solve, *_):
        solve.attempt.history.append(0.0)
        return (1 + next(errors)) * exact

    monkeypatch.setattr(rolling_solve.FrameSolve, "_iterated", iterated)
    on_frame.solve(rolling_solve.FramePressure.by(frame, (1 + next(errors)) * exact), 1.0)
    return on_frame.attempt.operator_applications, str(on_frame.attempt.status)


@pytest.mark.parametrize("rounds", [rounds_of_press, rounds_of_rolling])
def test_rounds_end_where_a_fresh_residual_is_not_half_of_the_last(rounds, monkeypatch):
    """The residual is the error: by 0.48 a round to 1e-6 takes 19 of them; 0.52 is not enough."""
    first = rounds is rounds_of_press
    assert rounds(monkeypatch, (0.48**i for i in range(99))) == (19 + first, "converged")
    assert rounds(monkeypatch, (0.52**i for i in range(99))) == (2, "stagnation")
    assert rounds(monkeypatch, iter([1.0, 0.4, 0.1, 0.07, 0.0])) == (3 + first, "stagnation")
