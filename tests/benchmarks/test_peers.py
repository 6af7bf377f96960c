"""The solver comparison: the same for all solvers, a row for each, and true where other packages are installed."""

import dataclasses
import itertools
import json
import multiprocessing
import os
import time
from types import SimpleNamespace

import numpy as np
import pytest

import validation.__main__ as command
from validation.benchmarks import isolation as alone
from validation.benchmarks import peers, timing
from validation.benchmarks.found_models import TimedProblem
from validation.benchmarks.peers import OURS, SOLVERS, PeerSolver, PressureField
from validation.benchmarks.solvers import case as comparison
from validation.benchmarks.solvers import claims as comparison_claims
from validation.benchmarks.solvers import evidence as comparison_evidence
from validation.benchmarks.solvers import problems
from validation.benchmarks.solvers.problems import SurfaceProblem
from validation.benchmarks.solvers.rolling import RollingThroughput
from validation.benchmarks.solvers.wheel_steps import SteppingThroughput
from validation.benchmarks.timing import RunLimits
from validation.report import contents
from validation.report.contents import TIMED
from validation.simulation.method import Result

RUN = TimedProblem(SurfaceProblem("rough", 0.004, 32, True, 1, 1e-6), RunLimits(slow=5.0, enough=0.0))


def dies(problem, tolerance):
    return lambda: os._exit(1)


def raises(problem, tolerance):
    return lambda: 1 / 0


def forgets_a_factor(problem, tolerance):
    solve = peers.bem3d_fast(problem, tolerance)
    return lambda: PressureField(1.01 * solve().pressure, 1)


def dies_the_second_time(problem, tolerance):
    if tolerance in solved_before:
        os._exit(1)
    solved_before.append(tolerance)
    return peers.bem3d_fast(problem, tolerance)


solved_before = []


def returns_nan(problem, tolerance):
    return lambda: PressureField(np.full(problem.height.shape, np.nan), 1)


def warms_up(problem, tolerance):
    """As fast as can be, the second time."""
    solve, known = peers.bem3d_fast(problem, tolerance), []

    def run():
        if not known:
            time.sleep(0.1)
            known.append(solve())
        return known[0]

    return run


def other(name, prepare, package="numpy"):
    return PeerSolver(name, package, "for a test", prepare, (1.0, 0.1))


@pytest.fixture(scope="module")
def forked():
    """Isolated processes are copies of one that has imported everything, which takes two seconds; fewest runs."""
    server = multiprocessing.get_context("forkserver")
    server.set_forkserver_preload([__name__])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(alone, "multiprocessing", SimpleNamespace(get_context=lambda kind: server))
        patch.setattr(comparison, "SETTLED", 0.0)
        yield


@pytest.mark.slow
def test_a_solver_that_fails_is_a_row(forked, monkeypatch):
    solvers = (
        SOLVERS[0],
        SOLVERS[1],
        other("dies", dies),
        other("raises", raises),
        other("wrong", forgets_a_factor),
        other("nan", returns_nan),
        other("late", dies_the_second_time),
        other("absent", dies, package="no-such-package"),
        other("warm", warms_up),
    )
    for module in (problems, comparison):
        monkeypatch.setattr(module, "SOLVERS", solvers)
    outcome = comparison.time_problem(RUN)
    said = dict(zip(outcome["method"].tolist(), outcome["status"].tolist(), strict=True))
    assert list(said) == [solver.name for solver in solvers]
    assert said["bem3d"] == said["bem3d, Polonsky-Keer"] == said["warm"] == "finished"
    assert said["dies"].startswith("failed: BrokenProcessPool")
    assert said["late"].startswith("failed: BrokenProcessPool")
    assert said["raises"].startswith("failed: ZeroDivisionError")
    assert said["wrong"].startswith("failed: RuntimeError: residual 0.0")
    assert said["nan"] == "failed: RuntimeError: pressure is not finite"
    assert said["absent"] == "not installed"
    # a solver that remembers is prepared anew each time
    assert outcome["seconds"][-1, 1] >= 0.1
    finished = outcome["status"] == "finished"
    assert np.isnan(outcome["seconds"][~finished, 0]).all()
    assert (outcome["residual"][finished] <= 1e-6).all()
    assert (outcome["difference"][finished, 0] <= 1e-4).all()


def test_threads_of_the_solvers_are_one(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    with alone.one_thread():
        assert {os.environ[name] for name in alone.THREADS} == {"1"}
    assert os.environ["OMP_NUM_THREADS"] == "7"
    assert "MKL_NUM_THREADS" not in os.environ


def small(**settings):
    return comparison.SolverComparison(
        cells=(32,),
        loads=(0.004,),
        residual=1e-8,
        scaling=(32, 64),
        rolling=RollingThroughput(cells=8, positions=60),
        wheel=SteppingThroughput(springs=(12, 25), heights=(0.1,), wheels=20, steps=40),
        **settings,
    )


@pytest.fixture(scope="module")
def result(forked):
    return comparison.run(small())


@pytest.mark.slow
def test_evidence(result):
    evidence = comparison_evidence.evidence(result)
    heats, scaling = evidence.table("heats"), evidence.table("scaling")
    # a contact model beside the solvers where the half-space is free
    assert len(heats["problem"]) == 4 * len(SOLVERS) + 2
    assert len(scaling["cells"]) == 6
    assert not evidence.unconverged
    assert all(number.met for number in evidence.numbers)
    assert sum("too small for an exponent" in sentence for sentence in evidence.conclusions) == 3
    assert [len(table["problem"]) for table in evidence.page_tables[:2]] == [4, 3]
    assert (scaling["peak memory [MiB]"] > 1).all()
    for name in ("bem3d", "bem3d, Polonsky-Keer"):
        mine = heats.where(solver=name)
        assert (mine["median [s]"] > 0).all()
        assert (mine["residual"] <= 1e-8).all()
        assert (mine["pressure difference to ours, L2"] <= 1e-4).all()


@pytest.mark.slow
def test_fastest_is_claimed_of_times(result):
    """Where another solver takes less time on one grid, the claim holds on larger ones alone; on all, it is refuted."""

    def claim(*ratios):
        solved = [
            (dataclasses.replace(problem, cells=n), {**outcome, **times_of(ratio)})
            for (problem, outcome), n, ratio in zip(result.problems, (64, 64, 128, 128), ratios, strict=True)
        ]
        return comparison_evidence.evidence(dataclasses.replace(result, problems=solved)).claims[0]

    assert claim(0.5, 0.1, 0.5, 0.5).status == "holds"
    limited = claim(0.5, 2.0, 0.5, 0.5)
    assert limited.status == "holds within limits"
    assert limited.answer.startswith("Within limits (from 128² cells on): it is faster on 3 of 4 problems, slower on 1")
    assert claim(0.5, 2.0, 0.5, 1.5).answer.startswith("No: ")
    # intervals that overlap decide nothing
    assert claim(0.5, 0.5, 0.98, 0.5).answer.startswith("Not decided: it is faster on 3 of 4 problems, slower on 0")


def times_of(ratio):
    """Of our solver and the published iteration; others are not installed."""
    status = np.array([timing.FINISHED, timing.FINISHED, *["not installed"] * (len(SOLVERS) - 2)])
    median = np.array([ratio, 1.0, *[np.nan] * (len(SOLVERS) - 2)])
    return {
        "status": status,
        "method": np.array([solver.name for solver in SOLVERS]),
        "seconds": np.stack([median, 0.9 * median, 1.1 * median, 5 + 0 * median], axis=1),
        "interval": np.stack([0.95 * median, 1.05 * median], axis=1),
    }


FIRST = (other("theirs", dies), *SOLVERS[:2])
"""Somebody's solver, placed before ours."""


def timed_rows(problem, limits):
    """Ours takes 2 s and presses with 1, the published iteration 3 s and 1, the other one 4 s and 3."""
    found = {"theirs": (4.0, 3.0), "bem3d": (2.0, 1.0), "bem3d, Polonsky-Keer": (3.0, 1.0)}
    return [
        timing.Timing(
            timing.FINISHED,
            0.0,
            seconds=[seconds] * 5,
            results=[Result({"pressure": np.full((4, 4), pressure), "residual": np.array(0.0)}, 1.0)],
        )
        for seconds, pressure in found.values()
    ]


def test_a_solver_that_is_placed_first_does_not_become_ours():
    with pytest.MonkeyPatch.context() as monkeypatch:
        for module in (peers, problems, comparison, comparison_claims, comparison_evidence):
            monkeypatch.setattr(module, "SOLVERS", FIRST)
        monkeypatch.setattr(comparison, "time_in_turns", timed_rows)
        named = [SimpleNamespace(label=each.name) for each in FIRST]
        monkeypatch.setattr(comparison, "configurations_of", lambda problem: named)
        outcome = comparison.time_problem(dataclasses.replace(RUN, problem=dataclasses.replace(RUN.problem, cells=4)))
        result = SimpleNamespace(problems=[(RUN.problem, outcome)])
        # (3 - 1) / 1 of the pressure field
        assert outcome["difference"][:, 0].tolist() == [2.0, 0.0, 0.0]
        (number,) = comparison_claims.speed_numbers(result)
        assert (number.model, number.source, number.value) == ("bem3d", "bem3d, Polonsky-Keer", 2 / 3)
        assert {n.model for n in comparison_evidence._agreement(result)} == {"theirs", "bem3d, Polonsky-Keer"}
        assert "first on 1 of 1 problems; 2.0 times" in comparison_evidence._standing(result, True, "it", [0])
        assert peers.of_others() == FIRST[:1]


def test_the_median_lies_between_order_statistics():
    """Of 1000 samples of 7 or 15 skew runs, at least 93 % have an interval that holds the median of all."""
    rng = np.random.default_rng(6)
    for runs in (5, 7, 15):
        ends = np.array([timing.interval_of_median(list(row)) for row in rng.lognormal(0, 1, (1000, runs))])
        assert np.mean((ends[:, 0] <= 1) & (ends[:, 1] >= 1)) > 0.92
    assert timing.interval_of_median([2.0]) == (1.5, 2.5)
    low, high = timing.interval_of_median(list(range(15)))
    assert (low, high) == (3, 11)


@pytest.mark.slow
def test_contact_models_are_listed_with_the_difference_of_their_stiffness(result):
    """Of the sphere the difference of the grid alone; rough faces scatter about the fit."""
    heats = comparison_evidence.evidence(result).table("heats")
    for model, surface, most in (("closed form", "sphere", 0.05), ("fit", "rough", 1.0)):
        found = heats.where(solver=model, status="finished")
        assert found["surface"].tolist() == [surface]
        assert found["stiffness difference to ours"] < most
        assert np.isnan(found["residual"])
        assert found["median [s]"] > 0


@pytest.mark.slow
def test_steps_of_the_wheel_are_counted_on_the_same_force(result):
    """The plain sum over all springs is the same force, and slower where only some are in doubt."""
    rates = comparison_evidence.evidence(result).table("wheel")
    assert (rates["difference to the plain sum"] < 1e-12).all()
    assert (rates["springs examined"] < 2 * 1.5 * rates["a/dx"]).all()
    assert (rates["wheel-steps a second"] > 0).all()


@pytest.mark.slow
def test_positions_of_a_rolling_wheel_are_beside_their_floor(result):
    assert result.rolling["h/d"].tolist() == [0.01, 0.3]
    assert (result.rolling["positions a second"] > 0).all()
    assert (result.rolling["applications a position"] >= 2).all()
    assert (result.rolling["time over applications on 3a x 3a"] > 0).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", [solver.name for solver in SOLVERS if solver.package != OURS])
def test_peers_find_the_same_pressure(name, result):
    """Relative L2 under 1e-4 at a residual of 1e-8, force and area too; periodic and free, sphere and rough."""
    i = [solver.name for solver in SOLVERS].index(name)
    if SOLVERS[i].version is None:
        pytest.skip(f"{name} is not installed")
    for _, outcome in result.problems:
        assert outcome["status"][i] == "finished"
        assert outcome["residual"][i] <= 1e-8
        assert outcome["difference"][i, 0] <= 1e-4
        assert outcome["difference"][i, 1] <= 1e-6
        assert outcome["difference"][i, 2] == 0.0


@pytest.mark.slow
def test_a_difference_of_answers_is_a_missed_criterion(result):
    (problem, outcome), *others = result.problems
    difference = outcome["difference"].copy()
    difference[1] = (2e-4, 2e-6, 0.0, np.nan)
    solved = [(problem, {**outcome, "difference": difference}), *others]
    numbers = comparison_evidence.evidence(dataclasses.replace(result, problems=solved)).numbers
    assert sum(not number.met for number in numbers) == 2


@pytest.mark.slow
def test_command_line(result, tmp_path, monkeypatch, capsys):
    """The comparison has a page, a table on the terminal, and times that are kept apart from results."""
    entry = dataclasses.replace(TIMED["race"], quick=result.case, run=lambda case, engine: result)
    monkeypatch.setitem(TIMED, "race", entry)
    assert command.main(["race", "--out", str(tmp_path)]) == command.Exit.MET
    printed = capsys.readouterr().out
    assert "rough, F = 0.004 E* L², free, 32²" in printed
    results = json.loads((tmp_path / "race.json").read_text())["cases"]["race"]
    assert results["settings"]["cells"] == [32]
    assert json.loads((tmp_path / "results.json").read_text())["cases"] == {}
    assert (tmp_path / "figures" / "race.svg").exists()
    assert (tmp_path / "data" / "race-heats.csv").exists()
    assert "Solver comparison" in (tmp_path / "speed.html").read_text()


@pytest.mark.slow
def test_exponents_are_those_of_the_measurements(result):
    """Time n^2.5, memory n^2 planted on grids of 512 and more."""
    scalings = []
    for (problem, outcome), n in itertools.product(result.scalings[::2], (512, 1024, 2048)):
        planted = {"seconds": 1e-6 * n**2.5, "idle": 1e6, "peak": 1e6 + 8.0 * n**2}
        cost = {**outcome, **{name: np.array(value) for name, value in planted.items()}}
        scalings.append((dataclasses.replace(problem, cells=n), cost))
    sentences = comparison_evidence.evidence(dataclasses.replace(result, scalings=scalings)).conclusions
    assert sum("time grows like n^2.50 (n² log n: n^2.1" in s and "process like n^2.00" in s for s in sentences) == 3


@pytest.mark.parametrize("installed", [True, False])
def test_report_runs_the_race_where_there_are_peers(installed, tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(contents, "peers_installed", lambda: installed)
    monkeypatch.setattr("validation.report.commands.report.build", lambda names, **settings: asked.extend(names) or [])
    command.main(["report", "--out", str(tmp_path)])
    assert ("race" in asked) == installed
