"""A flag that something did not converge: from each solve through its case to the page, the words and exit status 3."""

import ast
import functools
import inspect
from dataclasses import fields, replace
from types import SimpleNamespace
from typing import get_type_hints

import numpy as np
import pytest

import bem3d
from validation import __main__ as command
from validation.analysis.evidence import Evidence, Number, Role, Table, Verdict
from validation.benchmarks.timing import FAILED, FINISHED, OUT_OF_RANGE
from validation.benchmarks.work_precision import evidence as precision_evidence
from validation.benchmarks.work_precision.problem import BEM, LOOSE, MDR, POLONSKY_KEER
from validation.cases.limits import limits
from validation.cases.limits.solver import Grid, press_grid
from validation.cases.punch import area_gap_rolloff as mdr_limits
from validation.cases.punch import bandwidth, fractal_punch, normalisation
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import input_spectrum as rolling_input
from validation.cases.rolling import ridges
from validation.cases.selection import model_selection as ladder
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import spectrum as wheel
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Engine
from validation.engine.progress import Part
from validation.engine.random_numbers import random_generator
from validation.report.contents import CASES
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.simulation import rolling_strip, rough_punch
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.track_spectrum import self_affine

# --- solves: what is cut short has no value, and is counted ---


def cut(function, lost):
    """A path of contacts, or a rolling wheel, in which some loads get a single iteration; `lost` counts its calls."""

    @functools.wraps(function)
    def short(*args, **settings):
        return function(*args, **{**settings, **({"max_iterations": 1} if lost() else {})})

    return short


def test_a_load_that_does_not_converge_has_no_value_at_all(monkeypatch):
    """Neither stiffness nor area, approach or gap; the others have all of them."""
    problem = PUNCH.surface(0.7, 0, 8)
    whole = rough_punch.press_surface(problem)
    assert whole["failed"] == 0
    indent = bem3d.indent

    def stubborn(half_space, gap, *, forces, **settings):
        for i, force in enumerate(forces):
            yield from indent(half_space, gap, forces=[force], **settings, max_iterations=1 if i == 2 else 500)

    monkeypatch.setattr(bem3d, "indent", stubborn)
    found = rough_punch.press_surface(problem)
    assert found["failed"] == 1
    for name in ("stiffness", "area", "approach", "gap"):
        assert np.flatnonzero(np.isnan(found[name])).tolist() == [2]
    assert found["residual"][2] > problem.tolerance
    line = rough_punch.describe_failures([problem], [found])
    assert len(line) == 1 and line[0].startswith("surface 0, H = 0.7, 8² cells, Fbar = 0.464: residual")


def test_a_stiffness_that_does_not_converge_loses_its_load(monkeypatch):
    problem = PUNCH.surface(0.7, 0, 8)
    indent = bem3d.indent

    def unfrozen(*args, **settings):
        for i, contact in enumerate(indent(*args, **settings)):
            yield replace(contact, frozen=replace(contact.frozen, converged=i != 1))

    monkeypatch.setattr(bem3d, "indent", unfrozen)
    found = rough_punch.press_surface(problem)
    assert found["failed"] == 1 and np.isnan(found["stiffness"][1])


def test_a_position_that_does_not_converge_has_no_force(monkeypatch):
    spectrum = self_affine(0.7, 1.0, 4.0)
    scene = rolling_strip.RoughStrip(spectrum=spectrum, height=0.1, length=8.0, width=6.0, seed=1)
    (strip,) = scene.strips(4, 1e-6, 1)
    assert rolling_strip.roll_strip(strip)["failed"] == 0
    monkeypatch.setattr(bem3d, "roll", cut(bem3d.roll, lambda: True))
    found = rolling_strip.roll_strip(strip)
    assert found["failed"] == np.isnan(found["force"]).sum() == 32
    assert np.isfinite(found["linear"]).all()
    levels = rolling_strip.strip_levels([found], 0.25, rolling.ForceSpectrum(lowest=1.0, last=3.0, length=32.0).bands)
    assert np.isnan(levels["level"]).all()


@pytest.mark.slow
def test_both_ways_over_ridges_are_counted(monkeypatch):
    case = ridges.RollingOverRidges(length=8, shortest=4.0, cells=(4,))
    rolled = ridges.RidgesTrack(case=case, method="bem3d", cells=4)
    assert ridges.roll_over(rolled)["failed"] == 0
    calls = iter([False, True])
    monkeypatch.setattr(bem3d, "roll", cut(bem3d.roll, lambda: next(calls)))
    assert ridges.roll_over(rolled)["failed"] == 32


def test_wheels_that_do_not_repeat_themselves_are_counted(monkeypatch):
    scene = replace(load_wheel_scene("table_14_1"), distance=0.05, springs=20)
    rides = wheel_ensemble.WheelEnsemble(scene=scene, count=4, groups=2, track="steady-state", seed=1)
    monkeypatch.setattr(
        wheel_ensemble, "periodic_motion", lambda *_, start, **__: (*start, np.array([0, 1, 2e-3, 0.0]))
    )
    assert wheel_ensemble.simulate_ensemble(rides)["failed"] == np.sum(
        np.array([0, 1, 2e-3, 0.0]) > wheel_ensemble.STEADY_TOLERANCE
    )
    assert wheel_ensemble.STEADY_TOLERANCE < 1e-3


@pytest.mark.parametrize("solver", ["solve", "solve_polonsky_keer"])
def test_a_grid_that_does_not_converge_is_flagged_at_each_residual(solver):
    grid = Grid(scene="sphere", solver=solver, cells=12, tolerances=(1e-3, 1e-30), seed=1, true=False)
    with np.errstate(all="ignore"):
        assert press_grid(grid)["failed"].tolist() == [0.0, 1.0]


# --- cases: a flag in an outcome is a line of the result, or its end ---


class Given:
    """An engine that solves nothing: each problem's outcome is made up, some of them lost."""

    def __init__(self, outcome, lost):
        self._outcome, self._lost, self.seen = outcome, lost, []

    def map(self, _, problems):
        self.seen += problems
        return [self._outcome(problem, self._lost(problem)) for problem in problems]

    def map_groups(self, solve, groups):
        return {key: self.map(solve, group) for key, group in groups.items()}


def pressed(problem, lost):
    if isinstance(problem, rough_punch.Surface):
        ones, last = np.ones(len(problem.forces)), np.where(np.arange(len(problem.forces)) == 1, np.nan, 1.0)
        values = last if lost else ones
        found = dict.fromkeys(("stiffness", "area", "approach", "gap"), values)
        return {**found, "residual": 0.5 * ones, "failed": np.array(float(lost)), "gradient": np.array(1.0)}
    if isinstance(problem, rolling_strip.Strip):
        cells = round(problem.scene.length * problem.cells)
        force = np.random.default_rng(problem.realisation).standard_normal(cells)
        return {"force": np.nan * force if lost else force, "linear": force, "failed": np.array(7.0 * lost)}
    if isinstance(problem, ridges.RidgesTrack):
        return {"response": np.ones((2, 3)), "failed": np.array(3.0 * lost)}
    if isinstance(problem, wheel_ensemble.WheelEnsemble | ladder.CalibrationTrial) or hasattr(
        problem, "natural_periods"
    ):
        return {"failed": np.array(float(lost))}
    return {"height": np.array(1.0), "stiffness": np.ones((3, 3))}


def one_surface(realisation, **settings):
    def lost(problem):
        mine = isinstance(problem, rough_punch.Surface) and problem.realisation == realisation
        return mine and all(getattr(problem, name) == value for name, value in settings.items())

    return lost


def one_strip(realisation, height, cells):
    return lambda p: (
        isinstance(p, rolling_strip.Strip) and (p.realisation, p.scene.height, p.cells) == (realisation, height, cells)
    )


PUNCH = fractal_punch.FractalPunch(
    hursts=(0.7,), cells=8, surfaces=((0, 4, 4, 4, 0),), profiles=3, fine_profiles=2, decades=(-1, 0)
)
LOST = {
    "fractal punch, middle grid": (fractal_punch.run, PUNCH, one_surface(2, cells=8), "surface 2, H = 0.7, 8² cells"),
    "fractal punch, finer grid": (fractal_punch.run, PUNCH, one_surface(1, cells=16), "surface 1, H = 0.7, 16² cells"),
    "fractal punch, coarser": (fractal_punch.run, PUNCH, one_surface(0, cells=4), "surface 0, H = 0.7, 4² cells"),
    "mdr limits, refined": (
        mdr_limits.run,
        mdr_limits.MdrLimits(roll_offs=(1,), cells=16, surfaces=4, refined=3),
        one_surface(1, cells=32),
        "surface 1, H = 0.7, 32² cells",
    ),
    "bandwidth, wider": (
        bandwidth.run,
        bandwidth.Bandwidth(cells=16, surfaces=4, pairs=(3, 3), refined=3, rolled_off=3),
        one_surface(5, cells=32),
        "surface 5, H = 0.7, 32² cells",
    ),
    "normalisation": (
        normalisation.run,
        replace(normalisation.Normalisation(), hursts=(0.7,), surfaces=4),
        lambda p: one_surface(3)(p) and p.roughness.amplitudes == "gaussian" and p.roughness.normalised == "each",
        "surface 3, H = 0.7",
    ),
    "ridges": (
        ridges.run,
        ridges.RollingOverRidges(cells=(4, 6), springs=(8.5,)),
        lambda p: p.method == "bem3d" and p.cells == 6,
        "bem3d, 6 cells to a radius: 3 positions",
    ),
    "rolling, finer grid": (
        rolling.run,
        rolling.ForceSpectrum(heights=(0.1,), strips=4, refined=4, cells=4),
        one_strip(3, 0.1, 8),
        "strip 3, h/d = 0.1, 8 cells to a radius: 7 positions",
    ),
    "rolling, all strips": (
        rolling.run,
        rolling.ForceSpectrum(heights=(0.1, 0.3), strips=4, rough_strips=4, cells=4),
        one_strip(0, 0.3, 4),
        "strip 0, h/d = 0.3, 4 cells to a radius: 7 positions",
    ),
    "rolling input, strips": (
        rolling_input.run,
        rolling_input.RollingInput(heights=(0.03,), strips=4, cells=4, surfaces=3),
        lambda p: one_strip(2, 0.03, 4)(p) and p.scene.spectrum == rolling_input.RollingInput().spectra["H = 0.7"],
        "strip 2, h/d = 0.03",
    ),
    "rolling input, punches": (
        rolling_input.run,
        rolling_input.RollingInput(heights=(0.03,), strips=3, cells=4, surfaces=4),
        one_surface(3),
        "surface 3, H = 0.7",
    ),
    "wheel distance": (
        wheel_distance.run,
        wheel_distance.WheelDistance(),
        lambda p: p.track == "steady-state" and p.scene.rms == wheel_distance.SHORT.rms and p.linear,
        "1 of 20 wheels do not repeat their motion, h₀ = 5e-07 m",
    ),
}


@pytest.mark.parametrize("name", LOST)
def test_what_is_lost_is_a_line_of_the_result(name):
    run, case, lost, line = LOST[name]
    assert run(case, Given(pressed, lambda _: False)).unconverged == ()
    found = run(case, Given(pressed, lost)).unconverged
    assert len(found) == 1 and found[0].startswith(line), found


@pytest.mark.parametrize(
    ("run", "case", "lost"),
    [
        (rolling.run, rolling.ForceSpectrum(heights=(0.1,), strips=3, refined=3, cells=4), one_strip(1, 0.1, 4)),
        (rolling.run, rolling.ForceSpectrum(heights=(0.1,), strips=4, refined=3, cells=4), one_strip(2, 0.1, 8)),
        (
            rolling_input.run,
            rolling_input.RollingInput(heights=(0.03,), strips=3, cells=4, surfaces=3),
            one_strip(1, 0.03, 4),
        ),
        (
            rolling_input.run,
            rolling_input.RollingInput(heights=(0.03,), strips=3, cells=4, surfaces=3),
            one_surface(0),
        ),
        (wheel.run, wheel.WheelSpectrum(parameters=False), lambda p: isinstance(p, wheel_ensemble.WheelEnsemble)),
        (wheel_distance.run, wheel_distance.WheelDistance(), lambda p: p.release > 0),
    ],
)
def test_too_little_left_is_no_evidence(run, case, lost):
    given = Given(
        lambda p, gone: {**pressed(p, gone), **({"failed": np.array(99.0)} if gone and hasattr(p, "release") else {})},
        lost,
    )
    with pytest.raises(NotConvergedError) as caught:
        run(case, given)
    assert caught.value.unconverged


@pytest.mark.parametrize("which", [wheel_3d.COARSER, wheel_3d.LOOSE, wheel_3d.TIGHT])
def test_no_strip_may_be_lost_that_tells_an_error_bar(which):
    case = wheel_3d.Wheel3D(strips=4)
    mine = case.strips_of()[which][-1]
    with pytest.raises(NotConvergedError) as caught:
        wheel_3d.run(case, Given(pressed, lambda p: p is mine or p == mine))
    assert len(caught.value.unconverged) == 1


def swept_through(problem, lost):
    if isinstance(problem, Grid):
        failed = np.zeros(len(problem.tolerances))
        failed[-1] = lost
        return {"failed": failed, "iterations": np.ones(2), "applications": np.ones(2)}
    parts = {"values": np.ones(3), "error": np.ones(3), "threshold": np.array(1.0), "messages": np.array([""] * 3)}
    found = {f"{limit.name} {part}": value for limit in limits.LIMITS for part, value in parts.items()}
    return {**found, "failed": np.array(2.0 * lost)}


def test_a_solve_that_is_lost_in_a_sweep_is_a_line_of_the_result():
    case = limits.Limits(grids=(32, 64), tolerances=(1e-2, 1e-4))
    assert limits.run(case, Given(swept_through, lambda _: False)).unconverged == ()
    first = case.problems()[0]
    assert limits.run(case, Given(swept_through, lambda p: p == first)).unconverged == (f"{type(first).__name__}: 2",)
    grid = next(g for g in case.judged_grids() if g.solver == "solve_polonsky_keer")
    lost = limits.run(case, Given(swept_through, lambda p: p == grid)).unconverged
    assert lost == (f"{grid.scene}, {grid.cells}² cells, solve_polonsky_keer to {grid.tolerances[-1]:g}",)


def test_a_reference_that_fails_is_a_line_of_the_result():
    case = ladder.CalibrationTest(punches=2, spheres=1, rolling=0, wheels=0)
    gone = case.trials[1]
    assert ladder.run(case, Given(pressed, lambda p: p == gone)).unconverged == (f"{gone.kind} {gone.number}",)
    with pytest.raises(NotConvergedError):
        ladder.run(case, Given(pressed, lambda _: True))


@pytest.mark.parametrize("name", CASES)
def test_every_case_hands_on_what_is_lost(name):
    """Where a result knows what has not converged, the evidence that is read from it says so."""
    evidence = CASES[name].evidence
    (result,) = [kind for parameter, kind in get_type_hints(evidence).items() if parameter != "return"]
    tree = ast.parse(inspect.getsource(inspect.getmodule(evidence)))
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call) and getattr(n.func, "id", "") == "Evidence"]
    assert calls
    for call in calls:
        handed = [ast.unparse(keyword.value) for keyword in call.keywords if keyword.arg == "unconverged"]
        knows = "unconverged" in {field.name for field in fields(result)}
        assert (handed == ["result.unconverged"]) if knows else (handed != ["()"])


def points(**statuses):
    rows = [
        SimpleNamespace(scene="sphere", method=line, setting="8 cells", status=status)
        for line, status in statuses.items()
        for _ in range(2)
    ]
    return SimpleNamespace(points=rows)


def test_a_method_that_fails_on_the_clock_is_not_converged_and_a_refusal_is_an_answer():
    """Once for all of its quantities; the textbook's iteration is there to be seen failing."""
    failed = f"{FAILED}: ConvergenceError: residual 1"
    lost = precision_evidence._unconverged(
        points(**{BEM: failed, MDR: FINISHED, LOOSE: f"{OUT_OF_RANGE}: no", POLONSKY_KEER: failed})
    )
    assert lost == (f"sphere: {BEM}, 8 cells: {failed}",)


# --- the page, the words, the exit status ---


def number(verdict, role=Role.CRITERION):
    value, sample = {"agree": (1.0, 0.0), "differ": (3.0, 0.0), "undecided": (1.0, 1.0)}[verdict]
    return Number(
        quantity=f"a {verdict} {role}",
        value=value,
        reference=1.0,
        source="s",
        tolerance=0.1,
        reason="r",
        sample=sample,
        role=role,
    )


def reported(monkeypatch, tmp_path, *, numbers=(), unconverged=(), raises=None):
    """Exit status and page of a report of one case, made up."""
    shown = Evidence(
        title="Made up",
        method="nothing",
        numbers=tuple(numbers),
        tables=(Table("t", {"x": [1.0]}),),
        conclusions=(),
        captions={},
        unconverged=unconverged,
    )

    def run(case, engine):
        if raises:
            raise raises
        return shown

    entry = replace(CASES["geike"], run=run, evidence=lambda result: result)
    monkeypatch.setitem(CASES, "geike", entry)
    status = command.main(["report", "--only", "geike", "--out", str(tmp_path / "report"), "--workers", "1"])
    return status, (tmp_path / "report" / "index.html").read_text(), (tmp_path / "report" / "results.json").read_text()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("numbers", "unconverged", "status"),
    [
        ([number("agree")], (), 0),
        ([number("differ", Role.FINDING), number("undecided", Role.FINDING)], (), 0),
        ([number("agree"), number("differ")], (), 1),
        ([number("undecided")], (), 1),
        ([number("agree")], ("surface 3: residual 0.1",), 3),
        ([number("differ")], ("surface 3: residual 0.1",), 3),
    ],
)
def test_what_a_report_ends_with(numbers, unconverged, status, monkeypatch, tmp_path, capsys):
    ended, page, results = reported(monkeypatch, tmp_path, numbers=numbers, unconverged=unconverged)
    assert ended == status
    printed = capsys.readouterr().out
    for line in unconverged:
        assert line in page and line in results and f"not converged: {line}" in printed
    assert ("Not converged" in page) == ("1 not converged" in page) == bool(unconverged)
    missed = [n for n in numbers if n.role is Role.CRITERION and n.verdict is not Verdict.AGREE]
    for n in missed:
        assert f"missed: {n.sentence}" in printed
    assert page.count("Missed criterion") == len(missed)
    criteria = sum(n.role is Role.CRITERION for n in numbers)
    assert f"criteria met {criteria - len(missed)} of {criteria}" in printed


@pytest.mark.slow
@pytest.mark.parametrize(
    "error",
    [
        NotConvergedError("too little is left", ("strip 1: 3 positions",)),
        bem3d.ConvergenceError("residual 0.1 after 1 iterations", (1.0, 0.1), None),
    ],
)
def test_a_case_without_evidence_is_not_converged(error, monkeypatch, tmp_path, capsys):
    ended, page, results = reported(monkeypatch, tmp_path, raises=error)
    assert ended == command.Exit.NOT_CONVERGED == 3
    printed = capsys.readouterr().out
    for line in (str(error), *getattr(error, "unconverged", ())):
        assert line in page and line in results and f"not converged: {line}" in printed
    assert "no result" in page and "no result" in printed


def test_what_is_lost_is_counted_while_it_runs(tmp_path):
    for found, failed in ((0, 2), (4, 2)):
        progress = Part("toy")
        Engine(store=tmp_path, progress=progress).map(lost_if_odd, range(4))
        assert (progress.done, progress.found, progress.failed) == (4, found, failed)


def lost_if_odd(problem):
    return {"failed": np.array(float(problem % 2))} if problem else {}


# --- whose surfaces are whose ---


@pytest.mark.slow
def test_the_reference_of_the_calibration_test_has_surfaces_of_its_own():
    """The tested models draw with the seed of the trial, the reference with another."""
    seeds = []
    models_of = ladder.models_of

    def seen(scene, want, tolerance, seed):
        seeds.append(seed)
        return models_of(scene, want, tolerance, seed)

    trial = ladder.CalibrationTest(punches=1, spheres=0, rolling=0, wheels=0, tolerances=(0.3,)).trials[0]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ladder, "models_of", seen)
        ladder.calibrate(trial)
    reference, *tested = seeds
    assert set(tested) == {trial.seed} and reference != trial.seed


def drawn_by(monkeypatch, module):
    """Addresses of all that a module draws."""
    seen = []

    def recorded(entropy, *key):
        seen.append((entropy, *key))
        return random_generator(entropy, *key)

    monkeypatch.setattr(module, "random_generator", recorded)
    return seen


def test_surfaces_are_the_same_on_all_grids_and_at_all_heights(monkeypatch):
    """Pairs of grids, and what is taken over linear theory, lean on it."""
    seen = drawn_by(monkeypatch, rolling_strip)
    case = rolling.ForceSpectrum(length=8.0, width=6.0)
    for height in (0.01, 1.0):
        for cells in (4, 8):
            case.strips_of(height, cells)[2].surface()
    assert len(set(seen)) == 1
    seen = drawn_by(monkeypatch, rough_punch)
    for cells in (8, 16):
        one = PUNCH.surface(0.7, 2, cells)
        one.roughness.surface(one.cells, one.realisation)
    assert len(set(seen)) == 1


def test_springs_and_surfaces_draw_apart(monkeypatch):
    """No address of random numbers is used for two things."""
    seen = drawn_by(monkeypatch, rough_punch)
    roughness = PUNCH.roughness(0.7)
    for i in range(3):
        roughness.surface(8, i)
        roughness.profile(64, i)
    assert len(seen) == 6 == len(set(seen))


def test_every_problem_of_a_case_is_its_own():
    """No realisation is solved, or counted, twice."""
    for run, case, _, _ in LOST.values():
        given = Given(pressed, lambda _: False)
        run(case, given)
        assert len({repr(problem) for problem in given.seen}) == len(given.seen)
