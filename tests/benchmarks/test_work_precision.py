"""Speed against accuracy: fronts and errors of hand-made data; every scene small, on a clock that ticks by itself."""

import dataclasses
import json
import math
import os
from concurrent.futures import Future
from contextlib import nullcontext

import numpy as np
import pytest

import validation.__main__ as command
from validation.analysis.evidence import Table, Verdict
from validation.benchmarks import peers, timing
from validation.benchmarks.found_models import TimedProblem, configurations_of
from validation.benchmarks.peers import SOLVERS
from validation.benchmarks.timing import FINISHED, Configuration, RunLimits
from validation.benchmarks.work_precision import pareto as precision_front
from validation.benchmarks.work_precision import problem as precision
from validation.benchmarks.work_precision.case import Precision, run
from validation.benchmarks.work_precision.claims import claims_of, time_numbers
from validation.benchmarks.work_precision.dynamic_wheel import (
    WheelProblem,
    linear_strip,
    mean_levels,
    steady_acceleration,
)
from validation.benchmarks.work_precision.errors import MethodValues, error, points
from validation.benchmarks.work_precision.evidence import evidence
from validation.benchmarks.work_precision.exact_problems import PunchProblem, SphereProblem, WaveProblem
from validation.benchmarks.work_precision.figure_cost import FigureCost
from validation.benchmarks.work_precision.pareto import (
    Point,
    break_even,
    cheapest,
    front,
    work,
)
from validation.benchmarks.work_precision.problem import (
    BEM,
    CLOSED,
    EXTRAPOLATED,
    FILTER_1D,
    FILTER_3D,
    LOOSE,
    MDR,
    MDR_ROLLING,
    POLONSKY_KEER,
    Grids,
    Quantity,
    logarithm,
)
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import RoughPunchProblem, log_deviation
from validation.engine.engine import Engine
from validation.report import contents
from validation.report.contents import TIMED
from validation.simulation.method import Result, Solve
from validation.simulation.motion import simulate
from validation.simulation.rolling_strip import HERTZ
from validation.simulation.wheel_on_half_space import linear_law_3d
from validation.theory.closed_forms import westergaard_approach, westergaard_full_pressure, westergaard_half_width

# --- who is the cheapest, of hand-made data ---


def point(line, off, seconds, **settings):
    settings = {"status": FINISHED, "band": 0.001, "unit": "%", "parameter": "# cells", "value": 8.0, **settings}
    return Point(
        scene="scene",
        quantity="force",
        method=line,
        error=off,
        seconds=(0.9 * seconds, seconds, 1.2 * seconds),
        **settings,
    )


CHART = [
    point("MDR", 0.13, 1e-5, value=16, work=16.0),
    point("MDR", 0.12, 2e-5, value=32, work=32.0),
    point("BEM", 0.2, 1e-4, value=4, work=1000.0),
    point("BEM", 0.03, 1e-3, value=8, work=9000.0),
    point("BEM", 0.0005, 1e-2, value=16, work=80000.0),
    point("BEM", 0.0001, 1e-1, value=32, work=800000.0),
    point("plain", 0.03, 2e-3, value=8, work=8000.0),
]


def names(found):
    return [(p.method, p.value) for p in found]


def test_the_front_is_what_nothing_beats_and_ends_in_the_band():
    """BEM with 32 cells is closer than with 16, but below what the reference can tell."""
    assert names(front(CHART)) == [("MDR", 16), ("MDR", 32), ("BEM", 8), ("BEM", 16)]
    assert names(front(CHART[::-1])) == names(front(CHART))
    assert names(front(CHART, work)) == [("MDR", 16), ("MDR", 32), ("plain", 8), ("BEM", 16)]


def test_of_equals_the_first_stands_on_the_front():
    twins = [point("one", 0.1, 1.0), point("other", 0.1, 1.0)]
    assert names(front(twins)) == [("one", 8.0)]
    assert names(front(twins[::-1])) == [("other", 8.0)]
    # as wrong and dearer, or as dear and worse, is beaten
    assert names(front([*twins[:1], point("dearer", 0.1, 2.0), point("worse", 0.2, 1.0)])) == [("one", 8.0)]


@pytest.mark.parametrize("status", ["failed: RuntimeError: lost", "out of range: too few cells"])
def test_who_has_not_finished_is_not_on_the_front(status):
    lost = point("lost", math.nan, 1e-9, status=status)
    assert names(front([lost, *CHART])) == names(front(CHART))
    assert front([lost]) == []


def test_whose_cost_nobody_counts_has_no_place_among_counts():
    uncounted = point("peer", 0.01, 1e-6, work=math.nan)
    assert names(front([uncounted, *CHART]))[0] == ("peer", 8.0)
    assert ("peer", 8.0) not in names(front([uncounted, *CHART], work))


def test_errors_are_ranked_by_their_upper_ends():
    sure, unsure = point("sure", 0.02, 1.0), point("unsure", 0.01, 0.5, half_width=0.5)
    assert cheapest([sure, unsure], 0.1).method == "sure"
    assert cheapest([sure, dataclasses.replace(unsure, half_width=0.05)], 0.1).method == "unsure"


def test_the_cheapest_within_a_tolerance():
    assert [cheapest(CHART, t).value for t in (0.3, 0.125, 0.1, 0.01)] == [16, 32, 8, 16]
    assert cheapest(CHART, 1e-3).value == 16
    assert cheapest(CHART, 1e-4) is None
    assert cheapest(CHART[:3], 0.01) is None


def test_levels_are_asked_for_in_decibels():
    level = point("MDR", 2.0, 1.0, unit="dB", band=0.1)
    assert cheapest([level], 0.3) is level
    assert cheapest([level], 0.1) is None


def timed_point(line, off, seconds):
    return point(line, off, seconds, runs=100, unit="%")


BESIDE_SPRINGS = [
    timed_point(CLOSED, 0.5, 1e-6),
    timed_point(MDR, 0.2, 1e-5),
    timed_point(MDR_ROLLING, 0.1, 1e-4),
    timed_point(BEM, 0.05, 1e-2),
    timed_point(BEM, 0.01, 1e-1),
]


@pytest.mark.parametrize(
    ("another", "statuses", "words"),
    [
        # cheaper, but not as close
        (timed_point(FILTER_1D, 0.3, 1e-6), ("holds", "holds"), "Yes: they are the cheapest on 1 of 1 charts"),
        # as close as the closest springs, and cheaper than these alone
        (timed_point(FILTER_1D, 0.1, 5e-5), ("contradicted", "holds"), "2 times the time of linear filter, 1D"),
        (timed_point(FILTER_3D, 0.05, 1e-3), ("holds", "contradicted"), "10 times the time of linear filter, 3D"),
        # times whose intervals overlap
        (timed_point(FILTER_1D, 0.1, 0.99e-4), ("open", "holds"), "Not decided: they are the cheapest on 0 of 1"),
    ],
)
def test_the_cheapest_is_claimed_of_times(another, statuses, words):
    """At every error that springs reach, and at every smaller one; one error decides."""
    found = claims_of(time_numbers([[*BESIDE_SPRINGS, another]]), (), (), ())
    assert tuple(claim.status for claim in found) == statuses
    assert words in " ".join(claim.answer for claim in found)


def test_break_even_in_words():
    reference = point(CLOSED, 0.0, 1e-6, is_reference=True)
    assert break_even([reference, *CHART]) == (
        "scene, force: down to 13 % MDR (16 cells, 10 µs) is the cheapest; beyond, down to 0.1 % BEM "
        "(8 to 16 cells, 1 ms to 10 ms); below 0.1 % the reference cannot tell. "
        "The closed form itself takes 1 µs."
    )
    assert break_even(CHART[:2]).endswith("; no method gets below 12 %.")


# --- how wrong an answer is ---

MEAN = Quantity(name="mean", log=logarithm("k"), needs=("k",))


def k(values):
    return {"k": np.array(values, dtype=float)}


def test_what_realisations_have_of_their_own_drops_out_of_paired_errors():
    drawn = np.random.default_rng(1).lognormal(0, 0.3, 12)
    paired = error(MEAN, MethodValues(k(1.1 * drawn)), MethodValues(k(drawn)))
    assert paired.value == pytest.approx(0.1)
    assert paired.over == pytest.approx(1.1)
    assert paired.half_width < 1e-9
    alone = error(MEAN, MethodValues(k(1.1 * drawn), paired=False), MethodValues(k(drawn)))
    assert alone.value == pytest.approx(0.1)
    # two means of twelve, each of a relative standard error of s / sqrt(12)
    expected = 2.2 * 1.1 * drawn.std(ddof=1) / drawn.mean() * math.sqrt(2 / 12)
    assert alone.half_width == pytest.approx(expected, rel=0.02)


def test_fewer_realisations_are_paired_with_the_first_of_the_reference():
    drawn = np.random.default_rng(2).lognormal(0, 0.3, 12)
    assert error(MEAN, MethodValues(k(1.1 * drawn[:5])), MethodValues(k(drawn))).value == pytest.approx(0.1)


def test_intervals_cover_the_truth():
    """Of 300 pairs of samples of the same mean, more than 90 % have an error that their interval holds."""
    rng, held = np.random.default_rng(3), 0
    for _ in range(300):
        mine, reference = rng.lognormal(0, 0.2, 20), rng.lognormal(0, 0.2, 10)
        found = error(MEAN, MethodValues(k(mine), paired=False), MethodValues(k(reference)))
        held += found.value <= found.half_width
    assert held > 0.90 * 300


def test_no_scatter_is_all_wrong_and_a_single_value_has_none():
    assert log_deviation({"stiffness": np.ones(1)}) == -np.inf
    quantity = Quantity(name="deviation", log=log_deviation, needs=("stiffness",))
    drawn = {"stiffness": np.random.default_rng(4).lognormal(0, 0.3, 12)}
    found = error(quantity, MethodValues({"stiffness": np.ones(1)}, paired=False), MethodValues(drawn))
    assert found.value == 1.0


@pytest.mark.parametrize("order", [1.0, 2.0])
def test_two_grids_of_a_power_law_are_extrapolated_to_the_truth(order):
    quantity = dataclasses.replace(MEAN, order=order)
    coarse, fine = (k([math.exp(0.3 * n**-order)]) for n in (10.0, 15.0))
    assert error(quantity, MethodValues(fine, coarse, 1.5), MethodValues(k([1.0]))).value < 1e-12
    assert error(quantity, MethodValues(fine), MethodValues(k([1.0]))).value > 1e-4


def test_levels_differ_by_the_root_mean_square_of_decibels():
    quantity = Quantity(name="levels", log=lambda a: np.log(a["k"].mean(axis=0)), needs=("k",), decibel=True)
    found = error(quantity, MethodValues(k([[2.0, 1.0]])), MethodValues(k([[1.0, 1.0]])))
    assert found.value == pytest.approx(10 * math.log10(2) / math.sqrt(2))
    assert math.isnan(found.over)


# --- turns on the clock ---


@dataclasses.dataclass(frozen=True)
class Acting:
    """For a test: what it does, by name."""

    name: str = "right"

    def prepare(self, scene, resolution):
        if self.name == "refuses":
            raise ValueError("springs must be more, got 3")
        if self.name == "dies at once":
            os._exit(1)

        def run():
            if self.name == "dies":
                os._exit(1)
            if self.name == "raises":
                raise RuntimeError("lost its way")
            return 2.0

        return lambda realisation: Solve(run, lambda found: Result({"k": np.array(found + realisation)}, 10.0))


@dataclasses.dataclass(frozen=True)
class Made:
    """For a test: a problem of such configurations."""

    tried: tuple[Configuration, ...]
    name = "made"
    quantities = (MEAN,)
    scene, served = None, ()

    def configurations(self):
        return self.tried

    def reference(self):
        return k([2.0])

    def pairs(self):
        return ()


def named(act, worker=timing.OURS, **settings):
    name = "right" if act == "again" else act
    return Configuration(
        method=Acting(name), scene=None, label=act, parameter="#", value=1.0, worker=worker, **settings
    )


def timed_problem(*tried, slow=1.0, enough=0.0):
    return TimedProblem(Made(tried), RunLimits(slow=slow, enough=enough))


class Inline:
    """A process that is this one."""

    def submit(self, function, *arguments):
        done = Future()
        done.set_result(function(*arguments))
        return done


@pytest.fixture(scope="module", autouse=True)
def no_peers():
    """Whichever are installed."""
    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(peers, "SOLVERS", SOLVERS[:2])
        yield


@pytest.fixture
def by_hand(monkeypatch):
    """No processes; every call takes 10 ms."""
    use_a_clock_of_its_own(monkeypatch)


def use_a_clock_of_its_own(monkeypatch):
    monkeypatch.setattr(timing, "isolated_process", lambda: nullcontext(Inline()))
    monkeypatch.setattr(timing, "timed", lambda function: (function(), 0.01))


@pytest.mark.slow
def test_whoever_fails_is_a_row_with_its_reason_and_its_place_on_the_chart():
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


# --- every scene, small ---

SMALL = Precision(
    sphere=SphereProblem(
        grids=Grids(
            cells=(4, 8, 16), polonsky_keer=(4, 8), fixed=8, tight=1e-8, tolerances=(0.1, 1e-3), per="to a radius"
        ),
        peers=(4, 8),
        springs=(2.4, 4.4, 8.4, 16.4),
    ),
    punch=PunchProblem(
        grids=Grids(cells=(8, 16, 32), polonsky_keer=(8, 16), fixed=16, tight=1e-8, tolerances=(0.1, 1e-3)),
        springs=(4,),
    ),
    wave=WaveProblem(
        grids=Grids(
            cells=(16, 32, 64),
            polonsky_keer=(16, 32),
            fixed=32,
            tight=1e-8,
            tolerances=(0.1, 1e-3),
            per="to a wavelength",
        ),
        peers=(16, 32),
    ),
    fractal=RoughPunchProblem(
        waves=7,
        realisations=4,
        profiles=12,
        grids=Grids(cells=(10, 16, 32, 64), polonsky_keer=(16,), fixed=16, tolerances=(0.1,)),
        springs=(10, 16, 64),
    ),
    rolling=RollingProblem(
        last=6.0,
        length=24,
        width=12,
        realisations=3,
        tracks=6,
        grids=Grids(cells=(1, 3, 6), polonsky_keer=(3,), fixed=3, tolerances=(0.1,), per="to a radius"),
        filtered=(3, 6),
        springs=(1, 8),
    ),
    wheel=WheelProblem(
        realisations=3,
        wheels=6,
        grids=Grids(cells=(6, 12), fixed=6, tolerances=(1e-2,), per="to a radius"),
        filtered=(6,),
        springs=(12,),
    ),
    cost=FigureCost(wheels=20, steps=20),
)


@pytest.fixture(scope="module")
def result():
    with pytest.MonkeyPatch.context() as monkeypatch:
        use_a_clock_of_its_own(monkeypatch)
        return run(SMALL)


@pytest.fixture(scope="module")
def found(result):
    return evidence(result)


@pytest.fixture(scope="module")
def charts(found):
    return found.table("points")


ROUGH = {CLOSED, MDR, BEM, LOOSE}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "lines"),
    [
        ("sphere", {CLOSED, MDR, POLONSKY_KEER, BEM, LOOSE, EXTRAPOLATED}),
        ("square punch", {CLOSED, MDR, POLONSKY_KEER, BEM, LOOSE, EXTRAPOLATED}),
        ("Westergaard's wave", {CLOSED, POLONSKY_KEER, BEM, LOOSE, EXTRAPOLATED}),
        ("fractal punch", {"fit", MDR, BEM, LOOSE, POLONSKY_KEER, EXTRAPOLATED}),
        ("rolling force", {*ROUGH, POLONSKY_KEER, MDR_ROLLING, FILTER_1D, FILTER_3D}),
        ("dynamic wheel", {*ROUGH, MDR_ROLLING, FILTER_1D, FILTER_3D}),
    ],
)
def test_every_method_has_its_line(scene, lines, charts):
    mine = charts.where(scene=scene, status=FINISHED)
    assert lines <= set(mine["method"].tolist())
    assert np.isfinite(mine["error"]).all()
    assert (mine["± sample"] >= 0).all()
    np.testing.assert_array_equal(mine["upper quartile [s]"], mine["median [s]"])


def line(charts, scene, quantity, method):
    return charts.where(scene=scene, quantity=quantity, method=method, status=FINISHED)


@pytest.mark.slow
def test_extrapolated_grids_are_closer_than_the_finer_of_them(charts):
    fine, both = (line(charts, "square punch", "stiffness", method) for method in (BEM, EXTRAPOLATED))
    assert (both["error"] < fine["error"][1:] / 3).all()
    # both grids are paid for
    np.testing.assert_allclose(both["median [s]"], 0.02)
    np.testing.assert_allclose(both["work"], fine["work"][1:] + fine["work"][:-1])


@pytest.mark.slow
def test_looser_residuals_cost_less_and_are_farther_off(charts):
    loose, tight = (line(charts, "sphere", "force", method) for method in (LOOSE, BEM))
    assert loose["error"][0] > tight["error"][1]
    assert (loose["work"] < tight["work"][1]).all()


@pytest.mark.slow
def test_nobody_is_ranked_below_the_reference(charts):
    """Of the finest grid the reference leaves open as much as it lies from it; the last step."""
    for scene, quantity in (("fractal punch", "mean stiffness"), ("rolling force", "rms")):
        mine = line(charts, scene, quantity, BEM)
        assert mine["band"][0] > 0
        assert mine["error"][-1] == pytest.approx(mine["band"][-1])
        ahead = charts.where(scene=scene, quantity=quantity, front=True)
        rank = np.maximum(ahead["error"] + ahead["± sample"], ahead["band"])
        assert (np.diff(rank[np.argsort(ahead["median [s]"], kind="stable")]) <= 0).all()


@pytest.mark.slow
def test_what_cannot_be_done_is_refused_with_a_reason(charts, found):
    refused = charts["status"][[s.startswith("out of range") for s in charts["status"]]]
    reasons = " ".join(refused.tolist())
    assert "no one-dimensional image of independent springs" in reasons
    assert "c2d must vanish beyond the Nyquist wavenumber" in reasons
    assert "c1d must vanish beyond the Nyquist wavenumber" in reasons
    assert not any(s.startswith("failed") for s in charts["status"])
    assert {"scene", "method", "setting", "quantities", "reason"} == set(found.page_tables[1].columns)
    assert len(found.page_tables[1]["reason"]) == len(set(zip(*found.page_tables[1].columns.values(), strict=True)))


@pytest.mark.slow
def test_criteria_hold_where_theory_predicts(found):
    criteria = [number for number in found.numbers if number.role == "criterion"]
    assert len(criteria) == 6
    assert [number.label for number in criteria if number.verdict is not Verdict.AGREE] == []
    assert found.unconverged == ()


@pytest.mark.slow
def test_conclusions_and_summary_name_the_cheapest(found):
    assert len(found.conclusions) == 11
    assert all(" is the cheapest" in sentence for sentence in found.conclusions)
    assert len(found.table("summary")["tolerance"]) == 11 * len(precision_front.TOLERANCES)
    assert len(found.page_tables[0]["scene"]) == 11


@pytest.mark.slow
def test_three_dimensions_cost_hours_and_not_days(result, found):
    """dx = a / cells, 20 wheels over 0.65 m; planted, two days."""
    costly, table = found.claims[-1], found.table("cost")
    a = result.case.cost.scene.contact_radius
    np.testing.assert_allclose(table["one metre [s]"], table["one step [s]"] * table["a/dx"] / a)
    np.testing.assert_allclose(table["Fig. 14.4 [h]"], table["one metre [s]"] * 0.65 * 20 / 3600)
    assert costly.answer.startswith("No: a step takes ")
    days = dict(table.columns, **{name: [1.0, 50.0] for name in ("Fig. 14.4 [h]", "from [h]", "to [h]")})
    slow = evidence(dataclasses.replace(result, cost=Table("cost", days)))
    assert slow.claims[-1].answer.startswith("Yes: a step takes ")


@pytest.mark.slow
def test_an_answer_that_is_lost_is_not_converged(result):
    outcomes = [{**outcome} for outcome in result.outcomes]
    configurations = configurations_of(SMALL.problems()[0])
    last = max(i for i, each in enumerate(configurations) if each.label == BEM)
    outcomes[0]["status"] = outcomes[0]["status"].astype("<U40")
    outcomes[0]["status"][last] = "failed: ConvergenceError: lost"
    lost = evidence(dataclasses.replace(result, outcomes=outcomes)).unconverged
    assert lost == ("sphere: BEM, finer cells, 16 cells to a radius: failed: ConvergenceError: lost",)


@pytest.mark.slow
def test_the_same_seed_draws_the_same_errors(result, found):
    with pytest.MonkeyPatch.context() as monkeypatch:
        use_a_clock_of_its_own(monkeypatch)
        limits = RunLimits(slow=1.0, enough=0.0)
        one, other = (TimedProblem(dataclasses.replace(SMALL.fractal, seed=seed), limits) for seed in (SMALL.seed, 5))
        again, different = precision.measure(one), precision.measure(other)
    first = result.outcomes[3]
    assert again.keys() == first.keys()
    for name in again:
        np.testing.assert_array_equal(again[name], first[name])
    last = next(reversed([name for name in first if name.startswith("stiffness")]))
    assert not np.array_equal(different[last], first[last])


def test_finished_scenes_are_kept_until_all_are(tmp_path, by_hand, monkeypatch):
    """Who is interrupted goes on; who is done times everything anew."""
    timed = timed_problem(named("right"))
    monkeypatch.setattr(Precision, "problems", lambda self: (timed.problem,))
    engine = Engine(store=tmp_path)
    engine.map(precision.measure, [timed])
    assert [file.match("*-measure-*.npz") for file in tmp_path.iterdir()] == [True]
    run(SMALL, engine)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("solver", SOLVERS[2:], ids=lambda solver: solver.name)
def test_peers_are_as_close_as_we_are(solver, monkeypatch):
    """The same discrete problems: equal answers, whichever load they prescribe, within what carrying it over leaves."""
    if solver.version is None:
        pytest.skip(f"{solver.name} is not installed")
    monkeypatch.setattr(peers, "SOLVERS", (*SOLVERS[:2], solver))
    for scene in (SMALL.sphere, SMALL.wave):
        found = points(scene, precision.measure(TimedProblem(scene, RunLimits(slow=0.0, enough=0.0))))
        mine = {(p.quantity, p.value): p for p in found if p.method == BEM}
        theirs = [p for p in found if p.method == solver.name and (scene.name != "sphere" or p.quantity != "stiffness")]
        assert theirs
        for p in theirs:
            assert p.finished, p.status
            ours = mine[p.quantity, p.value]
            assert p.over == pytest.approx(ours.over, abs=0.2 * ours.error + 1e-6)


# --- what linear theory is used for ---


def test_the_approach_under_a_wave_is_the_sum_of_its_compliances():
    """dd / dp = -(2 lambda / (pi E*)) ln sin(pi a / lambda), integrated from the first touch."""
    scene = {"amplitude": 2e-6, "wavelength": 1e-3, "modulus": 1e9}
    full = westergaard_full_pressure(**scene)
    p = np.linspace(0, 0.4, 4001)[1:] * full
    a = np.array([westergaard_half_width(mean_pressure=float(one), **scene) for one in p])
    compliance = -2 * 1e-3 / (np.pi * 1e9) * np.log(np.sin(np.pi * a / 1e-3))
    d = np.array([westergaard_approach(mean_pressure=float(one), **scene) for one in (p[0], p[-1])])
    assert np.trapezoid(compliance, p) == pytest.approx(d[1] - d[0], rel=1e-3)
    assert westergaard_approach(mean_pressure=full, **scene) == pytest.approx(2e-6)


@pytest.mark.slow
def test_boundary_elements_find_the_approach_under_a_wave(charts):
    """On grids the error falls at least at first order."""
    mine = line(charts, "Westergaard's wave", "approach", BEM)
    assert mine["error"][-1] < mine["error"][0] * mine["value"][0] / mine["value"][-1]


STRIP = WheelProblem(realisations=3, wheels=6)


def test_the_filtered_acceleration_is_the_motion_that_repeats_itself():
    strip = STRIP.strip(0, 6, 1e-5)
    linear = linear_law_3d(strip, strip.surface())
    time_step = strip.spacing / strip.scene.speed
    approach, velocity = linear.steady_state(time_step)
    steps = len(linear.change)
    motion = simulate(linear.wheel, linear, time_step=time_step, steps=steps, approach=approach, velocity=velocity)
    expected = steady_acceleration(linear, time_step)
    np.testing.assert_allclose(motion.acceleration, expected, atol=1e-8 * np.abs(expected).max())


@pytest.mark.slow
def test_mean_levels_are_those_of_many_linear_wheels():
    known = [linear_strip(STRIP, STRIP.strip(i, 6, 1e-5)) for i in range(60)]
    levels = np.array([one.level for one in known])
    off = levels.mean(axis=0) / known[0].mean - 1
    error_of_the_mean = levels.std(axis=0, ddof=1) / math.sqrt(60) / known[0].mean
    assert (np.abs(off) < 4 * error_of_the_mean).all()
    strip = STRIP.strip(0, 6, 1e-5)
    other = mean_levels(STRIP, known[1].surface, strip.spacing, known[0].time_step)
    np.testing.assert_allclose(other, known[0].mean, rtol=1e-9)


def test_mean_rolling_levels_are_those_of_many_linear_forces():
    scene = SMALL.rolling
    draw = next(each for each in scene.configurations() if each.label == FILTER_3D).prepare()
    turns = [draw(i) for i in range(60)]
    forces = [turn.run()[0] for turn in turns]
    found = [turn().values for turn in turns]
    # at a place, so that the mean of a strip counts too
    variance = np.array([np.mean((force / HERTZ - 1) ** 2) for force in forces])
    for values, name in ((variance, "mean variance"), (np.array([one["level"] for one in found]), "mean level")):
        mean = found[0][name]
        assert (np.abs(values.mean(axis=0) - mean) < 4 * values.std(axis=0, ddof=1) / math.sqrt(60)).all()


# --- the command ---


@pytest.mark.slow
def test_command_line(result, tmp_path, monkeypatch, capsys):
    """A page, sentences on the terminal, and times that are kept apart from results."""
    monkeypatch.setitem(
        TIMED, "precision", dataclasses.replace(TIMED["precision"], quick=SMALL, run=lambda case, engine: result)
    )
    assert command.main(["precision", "--out", str(tmp_path)]) == command.Exit.MET
    assert "fractal punch, mean stiffness: down to" in capsys.readouterr().out
    results = json.loads((tmp_path / "precision.json").read_text())["cases"]
    assert list(results) == ["precision"]
    assert results["precision"]["settings"]["sphere"]["grids"]["cells"] == [4, 8, 16]
    assert json.loads((tmp_path / "results.json").read_text())["cases"] == {}
    for name in ("precision", "precision-summary", "precision-work"):
        assert (tmp_path / "figures" / f"{name}.svg").exists()
    assert (tmp_path / "data" / "precision-points.csv").exists()
    page = (tmp_path / "index.html").read_text()
    assert "Speed against accuracy" in page and 'href="precision.json"' in page


@pytest.mark.parametrize("installed", [True, False])
def test_report_times_last_of_all_and_before_the_race(installed, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(contents, "peers_installed", lambda: installed)
    monkeypatch.setattr("validation.commands.report.build", lambda names, **settings: seen.extend(names) or [])
    command.main(["report", "--out", str(tmp_path)])
    assert seen[-2:] == ["precision", "race"] if installed else seen[-1] == "precision" and "race" not in seen


def test_a_seed_is_that_of_all_roughness():
    case = TIMED["precision"].settings("quick", 7)
    assert [scene.seed for scene in case.problems()[3:]] == [7, 7, 7]
