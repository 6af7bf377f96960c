"""The rules of the iteration one by one: what is free to move, which step is taken, what is remembered, when it ends.

They show in no answer: they save operator applications.
"""

import itertools

import numpy as np
import pytest

import bem3d
from bem3d import projected_cg, rolling_solve, window_solve
from bem3d.projected_cg import Load, Memory
from tests import oracles


class Cells:
    """Cells that do not feel each other: u = p / 4, and an approximate inverse of anybody's choice."""

    stiffness = 4.0

    def __init__(self, inverse, compliance=0.25):
        self.inverse, self.compliance = inverse, compliance

    def displacement(self, pressure):
        return self.compliance * pressure


def downhill(inverse, pressure, w, memory=None, *, load=None, length=0.5):
    cells, load = Cells(inverse), load or Load(overlap=1.0)
    return projected_cg._downhill(cells, np.array(pressure), np.array(w), load, memory or Memory(len(w)), length)


@pytest.mark.parametrize("wrong", [-3.0, 0.0], ids=["uphill", "nowhere"])
def test_where_the_inverse_leads_nowhere_the_gradient_is_followed(wrong):
    """p + length * stiffness * (-w) on free cells, and back to p >= 0: a step that says that it is cut."""
    step = downhill(lambda u: wrong * u, [1.0, 1.0, 0.0, 0.0], [0.25, -0.5, -0.125, 0.5])
    assert step.change == pytest.approx([-0.5, 1.0, 0.25, 0.0])
    assert step.gain == pytest.approx(0.125 + 0.5 + 0.03125)
    assert step.cut


def test_an_operator_that_answers_nothing_ends_the_iteration():
    cells = Cells(lambda u: u, compliance=0.0)
    states = projected_cg.projected_cg(cells, np.ones(2), np.zeros(2), Load(overlap=1.0))
    assert len(list(itertools.islice(states, 9))) == 1


def falling(factor, every):
    """Residuals that fall by a factor every so many iterations, at a pressure that stays."""

    def states(cells, pressure, separation, load, length=0.4):
        return (projected_cg.State(pressure, separation, 1.0, 0.5 * factor ** (i // every)) for i in itertools.count())

    return states


def iterations_of_press(monkeypatch, states, tolerance, most):
    monkeypatch.setattr(window_solve, "projected_cg", states)
    half_space = bem3d.HalfSpace(shape=(2, 2), spacing=1.0, modulus=1.0)
    cells, attempt = (
        window_solve.Candidates(half_space, np.ones((2, 2), dtype=bool)),
        window_solve.IterationState(np.zeros((2, 2)), 0.0),
    )
    field = np.ones((2, 2))
    window_solve._iterate(cells, field, field, Load(overlap=1.0), attempt, tolerance, most)
    assert attempt.operator_applications == len(attempt.history)
    assert attempt.status is None
    return len(attempt.history)


def solve_on(frame, tolerance, most):
    """A flat gap on a frame of 4 x 4 cells, at a unit approach."""
    attempt, flat = window_solve.IterationState(np.zeros((4, 4)), 0.0), np.zeros((4, 4))
    load = Load(overlap=1.0)
    return rolling_solve.FrameSolve(
        frame=frame, near=flat, load=load, attempt=attempt, tolerance=tolerance, max_iterations=most
    )


def iterated_on_a_frame(monkeypatch, states, tolerance, most):
    """The pressure, and what has been recorded on the way."""
    monkeypatch.setattr(rolling_solve, "projected_cg", states)
    track = bem3d.Track(height=np.zeros((40, 40)), spacing=1 / 8, radius=1.0, modulus=1.0)
    frame, field = rolling_solve.Frame(track, ((0, 4), (18, 22))), np.ones((4, 4))
    on_frame = solve_on(frame, tolerance, most)
    return on_frame._iterated(field > 0, field, field), on_frame.attempt


def iterations_of_rolling(monkeypatch, states, tolerance, most):
    _, attempt = iterated_on_a_frame(monkeypatch, states, tolerance, most)
    assert attempt.operator_applications == len(attempt.history) - 1
    assert attempt.status is None
    return len(attempt.history) - 1


def test_an_iteration_without_a_way_down_ends_with_its_last_pressure(monkeypatch):
    def three(*given):
        return (projected_cg.State(np.full(16, float(i)), np.ones(16), 1.0, 0.5) for i in range(3))

    pressure, attempt = iterated_on_a_frame(monkeypatch, three, 1e-9, 99)
    assert (pressure == 2.0).all()
    assert attempt.operator_applications == len(attempt.history) == 3


@pytest.mark.parametrize(("count", "patience"), [(iterations_of_press, 100), (iterations_of_rolling, 30)])
def test_patience_ends_where_the_residual_has_not_halved(count, patience, monkeypatch):
    """By 0.45 in as many iterations is enough, for ever; by 0.6 is not, and the iteration ends at the next."""
    assert count(monkeypatch, falling(0.45, patience + 1), 0.11, 10**6) == 2 * patience + 2
    assert count(monkeypatch, falling(0.45, patience + 1), 0.05, 10**6) == 3 * patience + 3
    assert count(monkeypatch, falling(0.6, patience + 1), 1e-9, 10**6) == patience + 1
    assert count(monkeypatch, falling(0.45, patience + 2), 1e-9, 10**6) == patience + 1
    assert count(monkeypatch, falling(0.9, 1), 0.04, 10**6) == 24
    assert count(monkeypatch, falling(0.9, 1), 0.04, 7) in (7, 8)


def rounds_of_press(monkeypatch, errors):
    """Of a punch with a flat face, which all cells touch: iterations that leave an error of so much, in turn."""
    half_space, depth = bem3d.HalfSpace(shape=(4, 4), spacing=1.0, modulus=1.0), 1.0
    exact = np.linalg.solve(oracles.dense_operator(half_space), np.full(16, depth)).reshape(4, 4)
    monkeypatch.setattr(window_solve, "_iterate", lambda *_: (1 + next(errors)) * exact)
    problem = bem3d.problem.Problem(half_space=half_space, gap=np.zeros((4, 4)), approach=depth)
    attempt = window_solve.solve_on_window(problem, window_solve.InitialGuess((1 + next(errors)) * exact), 1e-6, 99)
    return attempt.operator_applications, str(attempt.status)


def rounds_of_rolling(monkeypatch, errors):
    """The same of a wheel so large that it is flat, on a frame of which it touches all."""
    track = bem3d.Track(height=np.zeros((9, 9)), spacing=1.0, radius=1e12, modulus=1.0)
    frame = rolling_solve.Frame(track, ((-2, 2), (2, 6)))
    on_frame = solve_on(frame, 1e-6, 99)
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
