"""Configurations take turns on the clock, in processes that may fail."""

import numpy as np
import pytest

from tests.benchmarks.made_up import named, timed_problem
from validation.benchmarks import timing
from validation.benchmarks.timing import FINISHED
from validation.benchmarks.work_precision import problem as precision
from validation.benchmarks.work_precision.pareto import points
from validation.simulation.method import Result, Solve


@pytest.mark.slow
def test_whoever_fails_is_a_row_with_its_reason_and_its_place_on_the_chart(forked):
    """In real processes: who dies takes no other's process along."""
    timed = timed_problem(
        named("right"), named("refuses"), named("raises"), named("dies", "a"), named("dies at once", "b")
    )
    found = {p.method: p for p in points(timed.problem, precision.measure(timed))}
    assert found["right"].finished and found["right"].error == 0.0
    assert found["right"].runs == timing.FEWEST_RUNS
    assert found["refuses"].status == "out of range: springs must be more, got 3"
    assert found["raises"].status == "failed: RuntimeError: lost its way"
    assert found["dies"].status.startswith("failed: BrokenProcessPool")
    assert found["dies at once"].status.startswith("failed: BrokenProcessPool")
    assert not any(found[line].finished for line in found if line != "right")
    assert found["raises"].seconds[1] > 0


def test_configurations_take_turns(by_hand, monkeypatch):
    turns = []
    one = timing._run

    def recorded(i, realisation, read):
        turns.append((("right", "again")[i], realisation))
        return one(i, realisation, read)

    monkeypatch.setattr(timing, "_run", recorded)
    outcome = precision.measure(timed_problem(named("right"), named("again", realisations=7)))
    assert turns[:6] == [("right", 0), ("again", 0), ("right", 0), ("again", 1), ("right", 0), ("again", 2)]
    assert turns[10:] == [("again", 5), ("again", 6)]
    # each realisation is solved once, and all of them are kept
    np.testing.assert_array_equal(outcome["k 1"], 2.0 + np.arange(7))
    np.testing.assert_array_equal(outcome["k 0"], [2.0])
    assert outcome["seconds 0"].size == 5 and outcome["seconds 1"].size == 7


@pytest.mark.parametrize(("again", "solves"), [(True, 1 + 4), (False, 1)])
def test_what_is_too_short_for_the_clock_is_solved_several_times(again, solves, monkeypatch):
    """A first solve of 0.25 ms, and four more to fill a millisecond; but not where the first helps the next."""
    done = []
    solve = Solve(lambda: done.append(1), lambda found: Result({}, 1.0), again)
    monkeypatch.setattr(timing, "timed", lambda function: (function(), 0.25e-3 * (len(done) if len(done) < 2 else 2)))
    monkeypatch.setitem(timing._ready, 7, lambda realisation: solve)
    status, _, seconds, _ = timing._run(7, 0, True)
    assert status == FINISHED
    assert len(done) == solves
    assert seconds == pytest.approx(0.25e-3 if not again else 0.5e-3 / 4)


def test_who_is_slow_is_timed_once(by_hand):
    outcome = precision.measure(timed_problem(named("right"), slow=0.005))
    assert outcome["seconds 0"].size == 1
    outcome = precision.measure(timed_problem(named("right"), enough=100.0))
    assert outcome["seconds 0"].size == timing.MOST_RUNS
