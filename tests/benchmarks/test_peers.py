"""The race: fair to everyone, a row for everyone, and true where peers are installed."""

import dataclasses
import json
import os
import time

import numpy as np
import pytest

import validation.__main__ as command
from validation.analysis.evidence import Verdict
from validation.benchmarks import isolation as alone
from validation.benchmarks import peers
from validation.benchmarks.peers import CONTESTANTS, Contestant, Run
from validation.benchmarks.solvers import case as race
from validation.benchmarks.solvers import evidence as race_evidence
from validation.benchmarks.solvers.dynamic_wheel import SteppingThroughput
from validation.benchmarks.solvers.rolling import RollingThroughput, interpolated
from validation.report import contents
from validation.report.contents import TIMED

HEAT = race.Heat(race.Course("rough", 0.004, 32, True, 1), residual=1e-6, slow=5.0, entrants=())


def dies(task, tolerance):
    return lambda: os._exit(1)


def raises(task, tolerance):
    return lambda: 1 / 0


def forgets_a_factor(task, tolerance):
    solve = peers.bem3d_fast(task, tolerance)
    return lambda: Run(1.01 * solve().pressure, 1)


def dies_the_second_time(task, tolerance):
    if tolerance in solved_before:
        os._exit(1)
    solved_before.append(tolerance)
    return peers.bem3d_fast(task, tolerance)


solved_before = []


def returns_nan(task, tolerance):
    return lambda: Run(np.full(task.height.shape, np.nan), 1)


def warms_up(task, tolerance):
    """As fast as can be, the second time."""
    solve, known = peers.bem3d_fast(task, tolerance), []

    def run():
        if not known:
            time.sleep(0.1)
            known.append(solve())
        return known[0]

    return run


def other(name, prepare, package="numpy"):
    return Contestant(name, package, "for a test", prepare, (1.0, 0.1))


def test_whoever_fails_is_a_row(monkeypatch):
    entrants = (
        CONTESTANTS[0],
        CONTESTANTS[1],
        other("dies", dies),
        other("raises", raises),
        other("wrong", forgets_a_factor),
        other("nan", returns_nan),
        other("late", dies_the_second_time),
        other("absent", dies, package="no-such-package"),
        other("warm", warms_up),
    )
    monkeypatch.setattr(race, "CONTESTANTS", entrants)
    outcome = race.run_heat(HEAT)
    said = dict(zip([entrant.name for entrant in entrants], outcome["status"], strict=True))
    assert said["bem3d"] == said["bem3d, textbook"] == said["warm"] == "finished"
    assert said["dies"].startswith("failed: BrokenProcessPool")
    assert said["late"].startswith("failed: BrokenProcessPool")
    assert said["raises"].startswith("failed: ZeroDivisionError")
    assert said["wrong"].startswith("failed: residual 0.0")
    assert said["nan"] == "failed: pressure is not finite"
    assert said["absent"] == "not installed"
    # a start that remembers is prepared anew each time
    assert outcome["seconds"][-1, 1] >= 0.1
    finished = outcome["status"] == "finished"
    assert np.isnan(outcome["seconds"][~finished, 0]).all()
    assert (outcome["residual"][finished] <= 1e-6).all()
    assert (outcome["difference"][finished, 0] <= 1e-4).all()


def test_threads_of_the_contestants_are_one(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    with alone.one_thread():
        assert {os.environ[name] for name in alone.THREADS} == {"1"}
    assert os.environ["OMP_NUM_THREADS"] == "7"
    assert "MKL_NUM_THREADS" not in os.environ


STEPS = SteppingThroughput(springs=(12, 25), heights=(0.1,), wheels=20, steps=40, cells=8, bem_steps=20)


def small(**settings):
    rolls = RollingThroughput(cells=(4, 6), tolerances=(1e-3, 1e-5), finest=12, goal=(8, 1e-4), positions=20, last=6.0)
    return race.Race(
        cells=(32,), loads=(0.004,), residual=1e-8, scaling=(32, 64), rolling=rolls, wheel=STEPS, **settings
    )


@pytest.fixture(scope="module")
def result():
    return race.run(small())


def test_evidence(result):
    evidence = race_evidence.evidence(result)
    heats, scaling = evidence.table("heats"), evidence.table("scaling")
    assert len(heats["problem"]) == 4 * len(CONTESTANTS)
    assert len(scaling["cells"]) == 6
    assert not evidence.unconverged
    assert all(number.verdict is Verdict.AGREE for number in evidence.numbers)
    assert sum("too small for an exponent" in sentence for sentence in evidence.conclusions) == 3
    assert [len(table["problem"]) for table in evidence.page_tables[:2]] == [4, 3]
    assert (scaling["peak memory [MiB]"] > 1).all()
    for name in ("bem3d", "bem3d, textbook"):
        mine = heats.where(contestant=name)
        assert (mine["median [s]"] > 0).all()
        assert (mine["residual"] <= 1e-8).all()
        assert (mine["pressure difference to ours, L2"] <= 1e-4).all()


def test_steps_of_the_wheel_are_counted_on_the_same_force(result):
    """The plain sum over all springs is the same force, and slower where only some are in doubt."""
    rates, goals = race_evidence.evidence(result).table("wheel"), result.wheel[1]
    assert (rates["difference to the plain sum"] < 1e-12).all()
    assert (rates["springs examined"] < 2 * 1.5 * rates["a/dx"]).all()
    assert (rates["wheel-steps a second"] > 0).all()
    assert goals["goal"].tolist() == ["5e+06", "400"]
    assert (goals["seconds a simulated metre"].astype(float) > 0).all()


def test_the_error_of_a_rolling_force_falls_with_the_residual_and_with_the_cells(result):
    rolls = race_evidence.evidence(result).table("rolling")
    for height in (0.01, 0.3):
        for cells in (4, 6):
            solver = rolls.where(**{"h/d": height, "cells to a radius": cells})["rms error of the force, solver"]
            assert solver[0] > solver[1] > solver[2] == 0
    assert (rolls["positions a second"] > 0).all()
    assert not rolls["not converged"].any()
    scenes = result.rolling[1]
    assert (scenes["applications a position"] >= 2).all()


def test_series_are_interpolated_by_their_waves():
    x = np.arange(32) + 0.5

    def wave(x):
        return np.cos(2 * np.pi * 3 * x / 32 + 0.4) + 2

    places = np.array([0.1, 7.3])
    np.testing.assert_allclose(interpolated(wave(x), 32.0, places), wave(places), atol=1e-12)


@pytest.mark.parametrize("name", [c.name for c in CONTESTANTS if c.package != "mdr-validation"])
def test_peers_find_the_same_pressure(name, result):
    """Relative L2 under 1e-4 at a residual of 1e-8, force and area too; periodic and free, sphere and rough."""
    i = [contestant.name for contestant in CONTESTANTS].index(name)
    if CONTESTANTS[i].version is None:
        pytest.skip(f"{name} is not installed")
    for outcome in result.outcomes:
        assert outcome["status"][i] == "finished"
        assert outcome["residual"][i] <= 1e-8
        assert outcome["difference"][i, 0] <= 1e-4
        assert outcome["difference"][i, 1] <= 1e-6
        assert outcome["difference"][i, 2] == 0.0


def test_a_difference_of_answers_is_a_missed_criterion(result):
    outcomes = [{**outcome} for outcome in result.outcomes]
    outcomes[0]["difference"] = outcomes[0]["difference"].copy()
    outcomes[0]["difference"][1] = (2e-4, 2e-6, 0.0)
    numbers = race_evidence.evidence(dataclasses.replace(result, outcomes=outcomes)).numbers
    assert sum(not number.met for number in numbers) == 2


def test_command_line(result, tmp_path, monkeypatch, capsys):
    """The race has a page, a table on the terminal, and times that are kept apart from results."""
    entry = dataclasses.replace(TIMED["race"], quick=result.race, run=lambda race, engine: result)
    monkeypatch.setitem(TIMED, "race", entry)
    assert command.main(["race", "--out", str(tmp_path)]) == command.Exit.MET
    printed = capsys.readouterr().out
    assert "rough, F = 0.004 E* L², free, 32²" in printed
    results = json.loads((tmp_path / "race.json").read_text())["cases"]["race"]
    assert results["settings"]["cells"] == [32]
    assert json.loads((tmp_path / "results.json").read_text())["cases"] == {}
    assert (tmp_path / "figures" / "race.svg").exists()
    assert (tmp_path / "data" / "race-heats.csv").exists()
    assert "The race" in (tmp_path / "index.html").read_text()


def test_exponents_are_those_of_the_measurements(result):
    """Time n^2.5, memory n^2 planted on grids of 512 and more."""
    measured = [
        dataclasses.replace(m, course=dataclasses.replace(m.course, cells=n))
        for m in result.measured[::2]
        for n in (512, 1024, 2048)
    ]
    costs = [
        {
            **result.costs[0],
            "seconds": np.array(1e-6 * m.course.cells**2.5),
            "idle": np.array(1e6),
            "peak": np.array(1e6 + 8.0 * m.course.cells**2),
        }
        for m in measured
    ]
    sentences = race_evidence.evidence(dataclasses.replace(result, measured=measured, costs=costs)).conclusions
    assert sum("time grows like n^2.50 (n² log n: n^2.1" in s and "process like n^2.00" in s for s in sentences) == 3


@pytest.mark.parametrize("installed", [True, False])
def test_report_runs_the_race_where_there_are_peers(installed, tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(contents, "peers_installed", lambda: installed)
    monkeypatch.setattr(command, "build", lambda names, **settings: asked.extend(names) or [])
    command.main(["report", "--out", str(tmp_path)])
    assert ("race" in asked) == installed
