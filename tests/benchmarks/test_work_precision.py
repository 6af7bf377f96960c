"""Speed against accuracy: every problem, small, on a clock that ticks by itself; linear theory; the command."""

import dataclasses
import math

import numpy as np
import pytest

import validation.__main__ as command
from tests.benchmarks.made_up import named, run_command, timed_problem, use_a_clock_of_its_own
from validation.analysis.evidence import Table, Verdict
from validation.benchmarks import peers
from validation.benchmarks.peers import SOLVERS, all_methods
from validation.benchmarks.timing import FINISHED, TimedProblem
from validation.benchmarks.work_precision import exact_problems, figure_cost
from validation.benchmarks.work_precision import problem as precision
from validation.benchmarks.work_precision.case import WITHIN, WITHOUT, Precision, run
from validation.benchmarks.work_precision.dynamic_wheel import WheelProblem, steady_acceleration
from validation.benchmarks.work_precision.errors import points
from validation.benchmarks.work_precision.pareto import TOLERANCES
from validation.benchmarks.work_precision.problem import BEM, CLOSED, EXTRAPOLATED, LOOSE, MDR, POLONSKY_KEER, Grids
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import RoughPunchProblem
from validation.benchmarks.work_precision.study import CASE
from validation.engine.engine import Engine
from validation.report import contents
from validation.report.contents import TIMED
from validation.simulation.motion import simulate
from validation.simulation.rolling_strip import HERTZ
from validation.simulation.wheel_on_half_space import linear_law_3d
from validation.theory.closed_forms import westergaard_approach, westergaard_full_pressure, westergaard_half_width


@pytest.fixture(scope="module", autouse=True)
def no_peers():
    """Whichever are installed."""
    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(peers, "SOLVERS", SOLVERS[:2])
        yield


# --- every scene, small ---


def exact_grids(cells, per):
    few = {"polonsky_keer": cells[:2], "fixed": cells[1], "tolerances": (0.1, 1e-3)}
    return Grids(cells=cells, tight=1e-8, per=per, **few)


SMALL = Precision(
    sphere=exact_problems.SphereProblem(
        grids=exact_grids((4, 8, 16), "to a radius"), peers=(4, 8), springs=(2.4, 4.4, 8.4, 16.4)
    ),
    punch=exact_problems.PunchProblem(grids=exact_grids((8, 16, 32), "a side"), springs=(4,)),
    wave=exact_problems.WaveProblem(grids=exact_grids((16, 32, 64), "to a wavelength"), peers=(16, 32)),
    fractal=RoughPunchProblem(
        waves=7,
        realisations=4,
        profiles=12,
        grids=Grids(cells=(10, 16, 32, 64), polonsky_keer=(16,), fixed=16, tolerances=(0.1,)),
        springs=(10, 16, 64),
    ),
    rolling=RollingProblem(
        last=6.0,
        width=12,
        tracks=6,
        grids=Grids(cells=(1, 3, 6), polonsky_keer=(3,), fixed=3, tolerances=(0.1,), per="to a radius"),
        filtered=(3, 6),
        springs=(1, 8),
    ),
    wheel=WheelProblem(
        wheels=6,
        grids=Grids(cells=(6, 12), fixed=6, tolerances=(1e-2,), per="to a radius"),
        filtered=(6,),
        springs=(12,),
    ),
    cost=figure_cost.FigureCost(wheels=20, steps=20),
)


@pytest.fixture(scope="module")
def result():
    with pytest.MonkeyPatch.context() as monkeypatch:
        use_a_clock_of_its_own(monkeypatch)
        return run(SMALL)


@pytest.fixture(scope="module")
def found(result):
    return CASE.evidence(result)


@pytest.fixture(scope="module")
def charts(found):
    return found.table("points")


EXACT = {CLOSED, POLONSKY_KEER, BEM, LOOSE, EXTRAPOLATED}
ROUGH = {CLOSED, MDR, BEM, LOOSE, precision.MDR_ROLLING, precision.FILTER_1D, precision.FILTER_3D}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "lines"),
    [
        ("sphere", {*EXACT, MDR}),
        ("square punch", {*EXACT, MDR}),
        ("Westergaard's wave", EXACT),
        ("fractal punch", {"fit", MDR, BEM, LOOSE, POLONSKY_KEER, EXTRAPOLATED}),
        ("rolling force", {*ROUGH, POLONSKY_KEER}),
        ("dynamic wheel", ROUGH),
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


@pytest.mark.slow
def test_looser_residuals_cost_less_and_are_farther_off(charts):
    loose, tight = (line(charts, "sphere", "force", method) for method in (LOOSE, BEM))
    assert loose["error"][0] > tight["error"][1]
    assert (loose["work"] < tight["work"][1]).all()


@pytest.mark.slow
@pytest.mark.parametrize(("scene", "quantity"), [("fractal punch", "mean stiffness"), ("rolling force", "rms")])
def test_of_the_finest_grid_the_reference_leaves_open_as_much_as_it_lies_from_it(scene, quantity, charts):
    mine = line(charts, scene, quantity, BEM)
    assert mine["error"][-1] == pytest.approx(mine["band"][-1]) and mine["band"][0] > 0


@pytest.mark.slow
def test_what_cannot_be_done_is_refused_with_a_reason(charts, found):
    refused = charts["status"][[s.startswith("out of range") for s in charts["status"]]]
    reasons = " ".join(refused.tolist())
    assert "no one-dimensional image of independent springs" in reasons
    assert "c2d must vanish beyond the Nyquist wavenumber" in reasons
    assert "c1d must vanish beyond the Nyquist wavenumber" in reasons
    assert not any(s.startswith("failed") for s in charts["status"])
    rows = list(zip(*found.table(WITHOUT).columns.values(), strict=True))
    assert rows and len(rows) == len(set(rows))


@pytest.mark.slow
def test_criteria_hold_where_theory_predicts(found):
    criteria = [number for number in found.numbers if number.role == "criterion"]
    assert len(criteria) == 6
    assert [number.label for number in criteria if number.verdict is not Verdict.AGREE] == []
    assert found.unconverged == ()
    assert len(found.table("summary")["tolerance"]) == 11 * len(TOLERANCES)
    assert len(found.table(WITHIN)["scene"]) == 11


@pytest.mark.slow
def test_three_dimensions_cost_hours_and_not_days(result, found):
    """dx = a / cells, 20 wheels over 0.65 m; planted, two days."""
    table, a = found.table(figure_cost.COST_OF_STEPS), result.case.cost.scene.contact_radius
    np.testing.assert_allclose(table["one metre [s]"], table["one step [s]"] * table["a/dx"] / a)
    np.testing.assert_allclose(table["Fig. 14.4 [h]"], table["one metre [s]"] * 0.65 * 20 / 3600)
    assert found.claims[-1].status == "contradicted"
    days = dict(table.columns, **{name: [1.0, 50.0] for name in figure_cost.HOURS})
    slow = dataclasses.replace(result, found={**result.found, "cost": Table(figure_cost.COST_OF_STEPS, days)})
    assert CASE.evidence(slow).claims[-1].status == "holds"


@pytest.mark.slow
def test_the_same_seed_draws_the_same_errors(by_hand):
    first, again, different = (
        precision.measure(TimedProblem(problem=dataclasses.replace(SMALL.fractal, seed=seed), slow=1.0, enough=0.0))
        for seed in (3, 3, 5)
    )
    assert again.keys() == first.keys()
    for name in again:
        np.testing.assert_array_equal(again[name], first[name])
    last = next(reversed([name for name in first if name.startswith("stiffness")]))
    assert not np.array_equal(different[last], first[last])


@pytest.mark.slow
def test_finished_scenes_are_kept_until_all_are(tmp_path, by_hand, monkeypatch):
    """Who is interrupted goes on; who is done times everything anew."""
    timed = timed_problem(named("right"))
    monkeypatch.setattr(Precision, "problems", lambda self: (timed.problem,))
    engine = Engine(store=tmp_path)
    limits = {"slow": SMALL.slow, "enough": SMALL.enough}
    engine.map(precision.measure, [TimedProblem(problem=timed.problem, methods=all_methods(), **limits)])
    assert [file.match("*-measure-*.npz") for file in tmp_path.iterdir()] == [True]
    lost = timed_problem(named("right"), named("raises")).problem
    monkeypatch.setattr(Precision, "problems", lambda self: (timed.problem, lost))
    assert run(SMALL, engine).unconverged == ("made: raises, 1: failed: RuntimeError: lost its way",)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("solver", SOLVERS[2:], ids=lambda solver: solver.name)
def test_peers_are_as_close_as_we_are(solver, monkeypatch):
    """The same discrete problems: equal answers, whichever load they prescribe, within what carrying it over leaves."""
    if solver.version is None:
        pytest.skip(f"{solver.name} is not installed")
    monkeypatch.setattr(peers, "SOLVERS", (*SOLVERS[:2], solver))
    for scene in (SMALL.sphere, SMALL.wave):
        found = points(scene, precision.measure(TimedProblem(problem=scene, slow=0.0, enough=0.0)))
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
    linear = linear_law_3d(strip.scene.body, strip.surface(), strip.spacing)
    time_step = strip.spacing / strip.scene.speed
    approach, velocity = linear.steady_state(time_step)
    steps = len(linear.change)
    motion = simulate(linear.wheel, linear, time_step=time_step, steps=steps, approach=approach, velocity=velocity)
    expected = steady_acceleration(linear, time_step)
    np.testing.assert_allclose(motion.acceleration, expected, atol=1e-8 * np.abs(expected).max())


@pytest.mark.slow
@pytest.mark.parametrize("scene", [SMALL.rolling, STRIP], ids=lambda scene: scene.name)
def test_means_over_phases_are_those_of_many_linear_realisations(scene):
    draw = next(each for each in scene.configurations() if each.label == precision.FILTER_3D).prepare()
    solves = [draw(i) for i in range(60)]
    values = [solve().values for solve in solves]
    found = {"level": np.array([one["level"] for one in values])}
    if scene is SMALL.rolling:
        # at a place, so that the mean of a strip counts too
        found["variance"] = np.array([np.mean((solve.run()[0] / HERTZ - 1) ** 2) for solve in solves])
    for name, drawn in found.items():
        mean = values[0][f"mean {name}"]
        assert (np.abs(drawn.mean(axis=0) - mean) < 4 * drawn.std(axis=0, ddof=1) / math.sqrt(60)).all()
        np.testing.assert_allclose(values[1][f"mean {name}"], mean, rtol=1e-9)


# --- the command ---


@pytest.mark.slow
def test_command_line(result, tmp_path, monkeypatch, capsys):
    """A page, tables on the terminal, and times that are kept apart from results."""
    results = run_command(CASE, result, tmp_path, monkeypatch)
    assert "scene: fractal punch; quantity: mean stiffness; within 30 %: " in capsys.readouterr().out
    assert results["settings"]["sphere"]["grids"]["cells"] == [4, 8, 16]
    for file in (*(f"figures/precision{part}.svg" for part in ("", "-summary", "-work")), "data/precision-points.csv"):
        assert (tmp_path / file).exists()
    page = (tmp_path / "index.html").read_text()
    assert "Speed against accuracy" in page and 'href="precision.json"' in page


@pytest.mark.parametrize("installed", [True, False])
def test_report_times_last_of_all_and_before_the_race(installed, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(contents, "peers_installed", lambda: installed)
    monkeypatch.setattr("validation.report.commands.report.build", lambda names, **settings: seen.extend(names) or [])
    command.main(["report", "--out", str(tmp_path)])
    assert seen[-2:] == ["precision", "race"] if installed else seen[-1] == "precision" and "race" not in seen


def test_a_seed_is_that_of_all_roughness():
    case = TIMED["precision"].settings("quick", 7)
    assert [scene.seed for scene in case.problems()[3:]] == [7, 7, 7]
