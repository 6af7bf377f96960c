"""Speed against accuracy: every problem, small, on a clock that ticks by itself; linear theory; the command."""

import dataclasses
import math

import numpy as np
import pytest

import validation.__main__ as command
from tests.benchmarks.made_up import named, run_command, timed_problem, use_a_clock_of_its_own
from tests.seeded import catches
from validation.analysis.evidence import Table
from validation.analysis.spectra import levels, waves
from validation.benchmarks.peers import all_methods
from validation.benchmarks.timing import FINISHED, TimedProblem
from validation.benchmarks.work_precision import figure_cost
from validation.benchmarks.work_precision import problem as precision
from validation.benchmarks.work_precision.case import CASE, WITHIN, WITHOUT, Precision, run
from validation.benchmarks.work_precision.pareto import CHEAPEST_SETTING, TOLERANCES
from validation.benchmarks.work_precision.problem import (
    BEM,
    CLOSED,
    EXTRAPOLATED,
    LOOSE,
    MDR,
    Grids,
    PunchProblem,
    RolledOffPunchProblem,
    RollingProblem,
    RoughPunchProblem,
    SphereProblem,
)
from validation.engine.engine import Engine
from validation.report import contents
from validation.report.commands import run_cases
from validation.report.contents import TIMED
from validation.simulation.rolling_strip import HERTZ
from validation.simulation.rough_punch import Profiles, Surface, press_profiles, press_surface
from validation.theory.rolling import linear_force

# --- every scene, small ---


def exact_grids(cells, per):
    return Grids(cells=cells, tight=1e-8, per=per, fixed=cells[1], tolerances=(0.1, 1e-3))


SMALL = Precision(
    sphere=SphereProblem(grids=exact_grids((4, 8, 16), "to a radius"), springs=(2.4, 4.4, 8.4, 16.4)),
    punch=PunchProblem(grids=exact_grids((8, 16, 32), "a side"), springs=(4,)),
    fractal=RoughPunchProblem(
        waves=7,
        realisations=4,
        profiles=12,
        grids=Grids(cells=(10, 16, 32, 64), fixed=16, tolerances=(0.1,)),
        springs=(10, 16, 64),
    ),
    rolled_off=RolledOffPunchProblem(
        waves=8,
        roll_off=2,
        realisations=4,
        profiles=12,
        grids=Grids(cells=(10, 16, 32, 64), fixed=16, tolerances=(0.1,)),
        springs=(10, 16, 64),
    ),
    rolling=RollingProblem(
        last=6.0,
        width=12,
        tracks=6,
        grids=Grids(cells=(1, 3, 6), fixed=3, tolerances=(0.1,), per="to a radius"),
        springs=(1, 8),
    ),
    cost=figure_cost.FigureCost(wheels=4, steps=4, cells=24),
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


ELEMENTS = {BEM, LOOSE, EXTRAPOLATED}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "lines"),
    [
        ("sphere", {CLOSED, MDR, *ELEMENTS}),
        ("square punch", {CLOSED, MDR, *ELEMENTS}),
        ("fractal punch", {"fit", MDR, *ELEMENTS}),
        ("punch with a roll-off", {MDR, *ELEMENTS}),
        ("rolling force", {precision.FILTER_3D, MDR, precision.MDR_ROLLING, BEM, LOOSE}),
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
def test_looser_residuals_are_farther_off(charts):
    loose, tight = (line(charts, "sphere", "force", method) for method in (LOOSE, BEM))
    assert loose["error"][0] > tight["error"][1]


@pytest.mark.slow
def test_what_cannot_be_done_is_refused_with_a_reason(charts, found):
    refused = charts["status"][[s.startswith("out of range") for s in charts["status"]]]
    reasons = " ".join(refused.tolist())
    assert "c2d must vanish beyond the Nyquist wavenumber" in reasons
    assert "c1d must vanish beyond the Nyquist wavenumber" in reasons
    assert not any(s.startswith("failed") for s in charts["status"])
    rows = list(zip(*found.table(WITHOUT).columns.values(), strict=True))
    assert rows and len(rows) == len(set(rows))


@pytest.mark.slow
def test_every_quantity_has_a_cheapest_method_of_each_tolerance(found):
    assert found.unconverged == () and {number.role for number in found.numbers} == {"finding"}
    settings, shown = found.table(CHEAPEST_SETTING), found.table(WITHIN)
    charts = set(zip(settings["scene"], settings["quantity"], settings["unit"], strict=True))
    assert len(charts) == 11 and {unit for _, _, unit in charts} == set(TOLERANCES)
    elements = settings.where(method="boundary elements")
    assert len(elements["scene"]) == sum(len(TOLERANCES[unit]) for _, _, unit in charts)
    assert (elements["time from [s]"] <= elements["time [s]"]).all()
    assert np.isfinite(settings["error"]).all()
    # who has no setting is shown once
    assert len(charts) < len(shown["scene"]) <= len(settings["scene"])


@pytest.mark.slow
def test_errors_fall_with_the_order_of_theory(charts):
    for scene, quantity, method, order, within in (
        # second order; the staircase edge scatters the error from grid to grid
        ("sphere", "force", BEM, 2.0, 0.5),
        ("sphere", "force", MDR, 2.0, 0.1),
        # the pressure is singular at the edge
        ("square punch", "stiffness", BEM, 1.0, 0.15),
    ):
        mine = line(charts, scene, quantity, method)
        assert -np.polyfit(np.log(mine["value"]), np.log(mine["error"]), 1)[0] == pytest.approx(order, abs=within)


@pytest.mark.slow
def test_three_dimensions_cost_hours_and_not_days(result, found):
    """dx = a / cells, 4 wheels over 0.65 m; planted, two days."""
    table, a = found.table(figure_cost.COST_OF_STEPS), result.case.cost.scene.contact_radius
    np.testing.assert_allclose(table["one metre [s]"], table["one step [s]"] * table["a/dx"] / a)
    np.testing.assert_allclose(table["Fig. 14.4 [h]"], table["one metre [s]"] * 0.65 * 4 / 3600)
    assert found.claims[-1].status == "refuted"
    days = dict(table.columns, **{name: [1.0, 50.0] for name in figure_cost.HOURS})
    slow = dataclasses.replace(result, by_key={**result.by_key, "cost": Table(figure_cost.COST_OF_STEPS, days)})
    assert CASE.evidence(slow).claims[-1].status == "supported"


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
    monkeypatch.setattr(figure_cost, "alone", lambda function, *given: function(*given))
    engine = Engine(store=tmp_path)
    limits = {"slow": SMALL.slow, "enough": SMALL.enough}
    engine.map(precision.measure, [TimedProblem(problem=timed.problem, methods=all_methods(), **limits)])
    assert [file.match("*-measure-*.npz") for file in tmp_path.iterdir()] == [True]
    lost = timed_problem(named("right"), named("raises")).problem
    monkeypatch.setattr(Precision, "problems", lambda self: (timed.problem, lost))
    assert run(SMALL, engine).unconverged == ("made: raises, 1: failed: RuntimeError: lost its way",)
    assert not list(tmp_path.iterdir())


# --- area and gap of the punch with a roll-off ---


def gap_without_displacement(self, contact, fixed):
    return {
        **RoughPunchProblem.read(self, contact, fixed),
        **precision.scalars(area=contact.area, gap=-contact.approach),
    }


@catches("a mean gap without the mean displacement", method=BEM).at(
    "validation.benchmarks.work_precision.problem.RolledOffPunchProblem.read", gap_without_displacement
)
@pytest.mark.parametrize("method", [BEM, MDR])
def test_a_punch_with_a_roll_off_has_area_and_gap_of_the_ensembles(method):
    """As pressed by the ensembles, by other calls: the work on a uniform pressure, and all profiles at once."""
    scene = RolledOffPunchProblem(waves=8, roll_off=2, force=0.5)
    (each,) = (c for c in scene.configurations() if c.label == method and c.value == 32)
    solve = each.prepare()(0)
    values = solve.read(solve.run()).values
    common = {"roughness": scene.roughness, "forces": (scene.force,)}
    if method == BEM:
        pressed = press_surface(Surface(**common, realisation=0, cells=32, tolerance=1e-6))
        assert values["area"] == pytest.approx(pressed["area"][0], rel=0.01)
    else:
        pressed = {
            k: v[0] for k, v in press_profiles(Profiles(**common, realisations=1, points=32, length=1.0)).items()
        }
        assert "area" not in values
    assert values["gap"] == pytest.approx(pressed["gap"][0], rel=1e-3)
    assert values["stiffness"] == pytest.approx(pressed["stiffness"][0], rel=1e-3)


# --- what linear theory is used for ---


@pytest.mark.slow
def test_means_over_phases_are_those_of_many_linear_realisations():
    """At a place, so that the mean of a strip counts too."""
    scene, cells = SMALL.rolling, 3
    surfaces = [scene.rough_strip.surface(cells, i) for i in range(60)]
    values = [scene.on(cells).prepare()(i).read(np.zeros(scene.length * cells)).values for i in range(2)]
    forces = [linear_force(one, spacing=1 / cells, **precision.SMOOTH) / HERTZ - 1 for one in surfaces]
    found = {
        "level": np.array([levels(waves(force, spacing=1 / cells), scene.bands) for force in forces]),
        "variance": np.array([np.mean(force**2) for force in forces]),
    }
    for name, drawn in found.items():
        mean = values[0][f"mean {name}"]
        assert (np.abs(drawn.mean(axis=0) - mean) < 4 * drawn.std(axis=0, ddof=1) / math.sqrt(60)).all()
        np.testing.assert_allclose(values[1][f"mean {name}"], mean, rtol=1e-9)


# --- the command ---


@pytest.mark.slow
def test_command_line(result, tmp_path, monkeypatch, capsys):
    """A page, tables on the terminal, and times that are kept apart from results."""
    results = run_command(CASE, result, tmp_path, monkeypatch)
    assert "scene: fractal punch; quantity: mean stiffness; tolerance: 10 %; " in capsys.readouterr().out
    assert results["settings"]["sphere"]["grids"]["cells"] == [4, 8, 16]
    for file in ("figures/precision.svg", "data/precision-points.csv"):
        assert (tmp_path / file).exists()
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "Speed against accuracy" in page and 'href="precision.json"' in page


@pytest.mark.parametrize("installed", [True, False])
def test_report_times_last_of_all_and_before_the_race(installed, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(contents, "peers_installed", lambda: installed)
    monkeypatch.setattr(run_cases, "build", lambda names, **settings: seen.extend(names) or [])
    command.main(["report", "--out", str(tmp_path)])
    assert seen[-2:] == ["precision", "race"] if installed else seen[-1] == "precision" and "race" not in seen


def test_a_seed_is_that_of_all_roughness():
    case = TIMED["precision"].settings("quick", 7)
    assert [scene.seed for scene in case.problems()[2:]] == [7, 7, 7]
