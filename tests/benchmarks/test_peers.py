"""The solver comparison: the same for all solvers, a row for each, and true where other packages are installed."""

import dataclasses
import functools
import math
import os
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis.case import Outcomes
from validation.analysis.series import numbers_of
from validation.analysis.statistics import Interval
from validation.benchmarks import peers, timing
from validation.benchmarks import solvers as comparison
from validation.benchmarks import timing as alone
from validation.benchmarks.discrete import ContactProblem, pressed
from validation.benchmarks.peers import OURS, SOLVERS, PeerSolver
from validation.benchmarks.solvers import AREA, CASE, FORCE, PRESSURE
from validation.benchmarks.surface_problem import SurfaceProblem
from validation.benchmarks.timing import TimedProblem
from validation.simulation.method import Result

RUN = TimedProblem(problem=SurfaceProblem("rough", 0.004, 32, True, 1, 1e-6), slow=5.0, enough=0.0)


def dies(problem, tolerance):
    return lambda: os._exit(1)


def raises(problem, tolerance):
    return lambda: 1 / 0


def forgets_a_factor(problem, tolerance):
    solve = peers.bem3d_fast(problem, tolerance)
    return lambda: (1.01 * solve()[0], 1)


def dies_the_second_time(problem, tolerance):
    if tolerance in solved_before:
        os._exit(1)
    solved_before.append(tolerance)
    return peers.bem3d_fast(problem, tolerance)


solved_before = []


def returns_nan(problem, tolerance):
    return lambda: (np.full(problem.gap.shape, np.nan), 1)


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


@pytest.mark.slow
def test_a_solver_that_fails_is_a_row(forked, monkeypatch):
    broken = {
        "dies": (dies, "failed: BrokenProcessPool"),
        "raises": (raises, "failed: ZeroDivisionError"),
        "wrong": (forgets_a_factor, "failed: RuntimeError: residual 0.0"),
        "nan": (returns_nan, "failed: RuntimeError: pressure is not finite"),
        "late": (dies_the_second_time, "failed: BrokenProcessPool"),
    }
    solvers = (
        *SOLVERS[:2],
        *(other(name, prepare) for name, (prepare, _) in broken.items()),
        other("absent", dies, package="no-such-package"),
        other("warm", warms_up),
    )
    monkeypatch.setattr(peers, "SOLVERS", solvers)
    outcome = comparison.time_problem(RUN)
    said = dict(zip(outcome["solver"].tolist(), outcome["status"].tolist(), strict=True))
    assert list(said) == [solver.name for solver in solvers]
    assert said["bem3d"] == said["bem3d, Polonsky-Keer"] == said["warm"] == "finished"
    assert all(said[name].startswith(status) for name, (_, status) in broken.items())
    assert said["absent"] == "not installed"
    # a solver that remembers is prepared anew each time
    assert outcome["fastest [s]"][-1] >= 0.1
    finished = outcome["status"] == "finished"
    assert np.isnan(outcome["median [s]"][~finished]).all()
    assert (outcome["residual"][finished] <= 1e-6).all()
    assert (outcome[PRESSURE][finished] <= 1e-4).all()


def test_threads_of_the_solvers_are_one(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    with alone.one_thread():
        assert {os.environ[name] for name in alone.THREADS} == {"1"}
    assert os.environ["OMP_NUM_THREADS"] == "7"
    assert "MKL_NUM_THREADS" not in os.environ


SMALL = comparison.SolverComparison(cells=(32,), loads=(0.004,))


@pytest.fixture(scope="module")
def result(forked):
    return comparison.run(SMALL)


@pytest.fixture(scope="module")
def evidence(result):
    return CASE.evidence(result)


@pytest.mark.slow
def test_evidence(evidence):
    heats, seconds = (evidence.table(name) for name in ("heats", comparison.SECONDS))
    assert len(heats["problem"]) == 4 * len(SOLVERS)
    assert len(seconds["problem"]) == 4
    assert not evidence.unconverged and all(number.met for number in evidence.numbers)
    for name in ("bem3d", "bem3d, Polonsky-Keer"):
        mine = heats.where(solver=name)
        assert (mine["median [s]"] > 0).all()
        assert (mine["residual"] <= 1e-8).all()
        assert (mine[PRESSURE] <= 1e-4).all()


def with_rows(result, *changes):
    """The result with other values in the rows of each problem, by solver."""
    changed = [
        [{**row, **change.get(row["solver"], {})} for row in rows]
        for rows, change in zip(result["problems"], changes, strict=True)
    ]
    return dataclasses.replace(result, by_key={**result.by_key, "problems": changed})


@pytest.mark.slow
def test_fastest_is_claimed_of_times(result):
    """Where another solver takes less time on one grid, the claim holds on larger ones alone; on all, it is refuted."""

    def took(seconds, n=64):
        return {"median [s]": seconds, "low [s]": 0.95 * seconds, "high [s]": 1.05 * seconds, "cells": n}

    def claim(*ratios):
        absent = {solver.name: {"status": "not installed"} for solver in SOLVERS[2:]}
        pairs = zip((64, 64, 128, 128), ratios, strict=True)
        rows = [{"bem3d": took(x, n), "bem3d, Polonsky-Keer": took(1.0, n), **absent} for n, x in pairs]
        return CASE.evidence(with_rows(result, *rows)).claims[0]

    assert claim(0.5, 0.1, 0.5, 0.5).status == "supported"
    on_one = claim(0.5, 2.0, 0.5, 0.5)
    assert on_one.status == "refuted"
    assert CASE.study.claims[0].outcome(on_one.numbers).only_within == (128,)
    assert claim(0.5, 2.0, 0.5, 1.5).status == "refuted"
    # intervals that overlap decide nothing
    assert claim(0.5, 0.5, 0.98, 0.5).status == "inconclusive"


FIRST = (other("theirs", dies), *SOLVERS[:2])
"""Somebody's solver, placed before ours."""


def timed_rows(configurations, given):
    """Ours takes 2 s and presses with 1, the published iteration 3 s and 1, the first of all 4 s and 3."""
    pressed = [Result({"pressure": np.full((4, 4), p), "residual": np.array(0.0)}, 1.0) for p in (3.0, 1.0, 1.0)]
    return [
        timing.Timing(timing.FINISHED, 0.0, runs=[seconds] * 5, results=[one])
        for seconds, one in zip((4.0, 2.0, 3.0), pressed, strict=True)
    ]


@catches("our solver for the first of the list").at("validation.benchmarks.solvers.OUR_SOLVER", "theirs")
def test_a_solver_that_is_placed_first_does_not_become_ours():
    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(peers, "SOLVERS", FIRST)
        monkeypatch.setattr(comparison, "time_in_turns", timed_rows)
        named = [SimpleNamespace(label=each.name) for each in FIRST]
        monkeypatch.setattr(SurfaceProblem, "configurations", lambda self: named)
        problem = dataclasses.replace(RUN.problem, cells=4)
        outcome = comparison.time_problem(dataclasses.replace(RUN, problem=problem))
        finished = [comparison._finished_by_solver(comparison.rows_of(outcome))]
        # (3 - 1) / 1 of the pressure field
        assert outcome[PRESSURE].tolist() == [2.0, 0.0, 0.0]
        speeds = numbers_of(comparison._speed_series(finished))
        assert {number.model for number in speeds} == {"bem3d"}
        # the published iteration on our operator is the algorithm's rival alone
        assert {(number.quantity, number.source, number.value) for number in speeds} == {
            (comparison.ALGORITHM, "bem3d, Polonsky-Keer", 2 / 3),
            (comparison.IMPLEMENTATION, "theirs", 2 / 4),
        }
        assert {n.model for n in comparison._difference_series(finished, FIRST)} == {"theirs", "bem3d, Polonsky-Keer"}
        assert peers.of_others() == FIRST[:1]


OWN = """
from own_solver import solve
from validation import contact_solver
from validation.benchmarks.discrete import ContactProblem, pressed

@contact_solver("waves", free=False, periodic=True)
def waves(gap, spacing, modulus, periodic, tolerance, force=None, approach=None):
    assert approach is None
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=periodic, force=force)
    return pressed(problem, tolerance, force=force).pressure
"""
EXAMPLE = Path(peers.__file__).parents[1] / "examples" / "own_solver.py"


@pytest.mark.slow
def test_a_solver_of_a_file_races_where_it_serves(forked, tmp_path, monkeypatch):
    monkeypatch.setattr(peers, "SOLVERS", peers.SOLVERS[:1])
    (tmp_path / "own_solver.py").write_bytes(EXAMPLE.read_bytes())
    (tmp_path / "mine.py").write_text(OWN, encoding="utf-8")
    result = comparison.run(dataclasses.replace(SMALL, residual=1e-6, own=str(tmp_path / "mine.py")))
    for name, served in (("conjugate gradients", "free"), ("waves", "periodic")):
        rows = [row for some in result["problems"] for row in some if row["solver"] == name]
        assert [(row["status"], row["half-space"]) for row in rows] == [("finished", served)] * 2
    _, _, seconds, versions = comparison.tables(result)
    assert "mine.py" in versions["version"]
    periodic = np.array(["periodic" in problem for problem in seconds["problem"]])
    assert ((seconds["conjugate gradients"] == "not asked") == periodic).all() and periodic.any()


def test_the_half_spaces_of_a_race_are_those_that_a_solver_of_the_file_serves():
    """The quick size has two problems for a solver in free space alone, and four without a file."""
    quick = dataclasses.replace(CASE.quick, own=str(EXAMPLE))
    assert [problem.label for problem in quick.problems()] == [
        "sphere, free, 128²",
        "rough, F = 0.001 E* L², free, 128²",
    ]
    assert len(CASE.quick.problems()) == 4


@catches("a median without an interval").at(
    "validation.benchmarks.timing.interval_of_median", lambda times: (np.median(times), np.median(times))
)
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
@pytest.mark.parametrize("name", [solver.name for solver in SOLVERS if solver.package != OURS])
def test_peers_find_the_same_pressure(name, evidence):
    """Relative L2 under 1e-4 at a residual of 1e-8, force and area too; periodic and free, sphere and rough."""
    mine = evidence.table("heats").where(solver=name)
    if "not installed" in mine["status"]:
        pytest.skip(f"{name} is not installed")
    assert (mine["status"] == "finished").all() and (mine["residual"] <= 1e-8).all()
    assert (mine[PRESSURE] <= 1e-4).all() and (mine[FORCE] <= 1e-6).all() and (mine[AREA] == 0).all()


@pytest.mark.slow
def test_a_difference_of_answers_is_a_missed_criterion(result):
    off = with_rows(result, {"bem3d, Polonsky-Keer": {PRESSURE: 2e-4, FORCE: 2e-6, AREA: 0.0}}, {}, {}, {})
    assert sum(not number.met for number in CASE.evidence(off).numbers) == 2


def rigid(problem):
    return SimpleNamespace(displacement=lambda pressure: 0 * pressure)


@catches("a rim that touches", gap=[[0.0] * 3] * 5, periodic=False, shape=(6, 4)).at(
    "validation.benchmarks.discrete.ContactProblem.half_space", property(rigid)
)
@pytest.mark.parametrize(
    ("gap", "periodic", "shape"),
    [([[0.0] * 3] * 5, False, (6, 4)), ([[0.0, 2.0], [1.0, 0.5], [2.0, 1.0]], True, (6, 2))],
)
def test_where_tamaas_has_no_answer_another_contact_stands_in(gap, periodic, shape):
    """A rim beside a flat body, two periods of an odd number of cells: the same pressure."""
    problem = ContactProblem(gap=1e-3 * np.array(gap), spacing=(1.0, 0.5), modulus=3.0, periodic=periodic, force=5e-3)
    gap, force = peers.equivalent_for_tamaas(problem)
    other = dataclasses.replace(problem, gap=gap, force=force)
    p, q = (pressed(one, 1e-10, force=one.force).pressure for one in (problem, other))
    n, m = p.shape
    assert q.shape == shape and q[:n, :m] == pytest.approx(p, rel=1e-8)
    assert q.sum() == pytest.approx((1 + periodic) * p.sum())


def test_on_large_grids_solvers_that_share_their_work_out_have_threads_too():
    """With the same bits; times are compared with one thread each, however fast ours is with more."""
    (problem,) = (one for one in comparison.SolverComparison(cells=(), large=(40,)).problems() if not one.periodic)
    outcome = comparison.time_problem(dataclasses.replace(RUN, problem=dataclasses.replace(problem, threads=2)))
    rows = {row["solver"]: row for row in comparison.rows_of(outcome)}
    assert rows["bem3d, 2 threads"]["status"] == "finished" and rows["bem3d, 2 threads"][PRESSURE] == 0
    assert rows["bem3d, 2 threads"]["operator applications"] == rows["bem3d"]["operator applications"] > 0
    fast = {**rows["bem3d, 2 threads"], "median [s]": 1e-9, "low [s]": 1e-9, "high [s]": 1e-9}
    finished = comparison._finished_by_solver([*rows.values(), fast])
    numbers = {number.quantity: number for number in numbers_of(comparison._speed_series([finished]))}
    published = rows["bem3d, Polonsky-Keer"]
    assert numbers[comparison.ALGORITHM].value == rows["bem3d"]["median [s]"] / published["median [s]"]


def made_row(solver, seconds, applications, package=OURS, **changes):
    times = {"median [s]": seconds, "low [s]": 0.9 * seconds, "high [s]": 1.2 * seconds}
    row = {"solver": solver, "package": package, "alone": "", "status": "finished", **times}
    return row | {"name": "rough", "problem": "rough, 8²", "cells": 8, "operator applications": applications, **changes}


SHOWN = {"fastest [s]": 1.0, "slowest [s]": 9.0, "set-up [s]": 0.5, "area": 0.1}
OURS_AND_THEIRS = [
    made_row("bem3d", 2.0, 10.0),
    made_row("bem3d, Polonsky-Keer", 6.0, 40.0),
    made_row("tamaas", 8.0, math.nan, "tamaas"),
    made_row("tamaas, 2 threads", 1.0, math.nan, "tamaas", alone="tamaas"),
]


@catches("the operator of another package under the algorithm").at("validation.benchmarks.solvers.PUBLISHED", "tamaas")
def test_the_factor_of_the_algorithm_is_that_over_polonsky_and_keer_on_the_same_operator():
    """Three times faster by four times fewer applications; the interval has both medians."""
    algorithm, implementation = numbers_of(comparison._speed_series([{r["solver"]: r for r in OURS_AND_THEIRS}]))
    assert (algorithm.quantity, algorithm.source) == (comparison.ALGORITHM, "bem3d, Polonsky-Keer")
    assert algorithm.value == pytest.approx(1 / 3)
    assert (implementation.source, implementation.value) == ("tamaas", 0.25)
    timed = Outcomes(SMALL, {"problems": [[row | SHOWN for row in OURS_AND_THEIRS]]}, ())
    _, table, seconds, _ = comparison.tables(timed)
    (row,) = (dict(zip(table.columns, cells, strict=True)) for cells in zip(*table.columns.values(), strict=True))
    assert (row["times the seconds"], row["times the applications"]) == (3.0, 4.0)
    assert (row["from"], row["to"]) == pytest.approx((3 * 0.9 / 1.2, 3 * 1.2 / 0.9))
    assert "; 10 applications; " in seconds["bem3d"][0] and "applications" not in seconds["tamaas"][0]


@catches("an interval of times that is dropped").at(
    "validation.benchmarks.solvers.time_ratio",
    lambda one, other: Interval(one["median [s]"] / other["median [s]"], 0.0),
)
def test_the_ratio_of_two_medians_has_the_intervals_of_both():
    ratio = comparison.time_ratio(OURS_AND_THEIRS[0], OURS_AND_THEIRS[1])
    # (2 x 1.2) / (6 x 0.9) - 1 / 3
    assert (ratio.value, ratio.half_width) == pytest.approx((1 / 3, 4 / 9 - 1 / 3))


@pytest.mark.parametrize(("backend", "threaded"), [("cpp", ()), ("omp", ("made up, 2 threads",))])
def test_a_solver_runs_with_threads_where_its_backend_has_them_and_the_page_names_it(backend, threaded, monkeypatch):
    solver = dataclasses.replace(other("made up", dies), backend=lambda: backend)
    monkeypatch.setattr(peers, "SOLVERS", (solver,))
    assert tuple(one.name for one in peers.with_threads(2)) == threaded
    assert peers.with_threads(1) == ()
    assert solver.build == f"{solver.version}, backend {backend}"
    assert dataclasses.replace(solver, package="no-such-package").build is None


def test_a_solver_that_rounding_leaves_above_what_is_asked_is_asked_for_half_of_it():
    """As Polonsky and Keer's iteration, which left 1.04e-8 of 1e-8 on a grid of the race."""
    found = functools.partial(np.full, (2, 2))
    solver = PeerSolver("made up", "", "", lambda problem, tolerance: lambda: (found(1.04 * tolerance), 0))
    problem = SimpleNamespace(worst=lambda pressure, by_force: pressure.max())
    assert peers.find_tolerance(solver, problem, 1e-8) == 0.5e-8
    with pytest.raises(RuntimeError, match="residual 1e-08 at its tightest tolerance"):
        peers.find_tolerance(dataclasses.replace(solver, tolerances=(1.0,)), problem, 1e-8)


def test_who_would_take_minutes_on_the_next_grid_is_left_out(monkeypatch):
    """Times the cells, from the grid before; who was left out, failed or is not installed is not expected anew."""
    with_omp = [dataclasses.replace(one, package="numpy", backend=lambda: "omp") for one in SOLVERS[2:3]]
    monkeypatch.setattr(peers, "SOLVERS", (*SOLVERS[:2], *with_omp, *SOLVERS[3:]))
    case = comparison.SolverComparison(cells=(64,), large=(128, 256))
    *_, first, last = (dataclasses.replace(one, threads=2) for one in case.problems() if not one.periodic)
    known = {"bem3d": 1.0, "bem3d, Polonsky-Keer": 4.9, "tamaas": 5.1, "ContactMechanics": math.nan}
    rows = [
        {"name": first.name, "cells": 64, "solver": solver, "median [s]": median, "status": "finished"}
        for solver, median in known.items()
    ]
    rows[-1]["status"] = comparison.NOT_INSTALLED
    assert comparison.too_slow(first, [rows]) == ("tamaas", "tamaas, 2 threads")
    left = [{**row, "cells": 128, "status": comparison.TOO_LONG, "median [s]": math.nan} for row in rows[2:3]]
    assert comparison.too_slow(last, [rows, left]) == ("tamaas", "tamaas, 2 threads")
    assert comparison.too_slow(first, []) == ()
