"""What did not converge leaves no value and a flag: a line of the result, or its end; and no problem is solved twice.

Outcomes are made up where a case is asked, and cut short where a solve is.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import bem3d
from tests.cases.planted import TABLE
from tests.seeded import catches
from validation.advice.cases import model_selection
from validation.analysis.case import Outcomes, Study
from validation.benchmarks.timing import FAILED, FINISHED, OUT_OF_RANGE
from validation.benchmarks.work_precision.case import failure_messages
from validation.benchmarks.work_precision.problem import BEM, LOOSE, MDR
from validation.cases.limits import limits
from validation.cases.punch import bandwidth, bandwidth_study, fractal_punch, interface
from validation.cases.rolling import force_spectrum, ridges
from validation.cases.wheel import distance, half_space, spectrum
from validation.engine.engine import identity
from validation.engine.realisations import NotConvergedError
from validation.simulation import rolling_strip, rough_punch, wheel_on_springs
from validation.simulation.limits import swept
from validation.simulation.rolling_strip import RidgesTrack


class Given:
    """An engine that solves nothing: each problem's outcome is made up, some of them lost."""

    def __init__(self, outcome, lost=lambda problem: False):
        self._outcome, self._lost, self.seen = outcome, lost, []

    def map(self, _, problems):
        self.seen += problems
        return [self._outcome(problem, self._lost(problem)) for problem in problems]

    def map_groups(self, solve, groups):
        return {key: self.map(solve, group) for key, group in groups.items()}


def solved(problem, lost):
    """Ones; where it is lost, NaN and a count of what failed."""
    if isinstance(problem, rough_punch.Surface):
        ones = np.ones(len(problem.forces))
        values = np.where(np.arange(ones.size) == 1, np.nan, 1.0) if lost else ones
        found = dict.fromkeys(("stiffness", "area", "approach", "gap"), values)
        lengths = dict.fromkeys(("gradient", "highest"), np.array(1.0))
        return {**found, "residual": 0.5 * ones, "failed": np.array(float(lost)), **lengths}
    if isinstance(problem, rolling_strip.Strip):
        force = np.random.default_rng(problem.realisation).standard_normal(round(problem.scene.length * problem.cells))
        return {"force": np.nan * force if lost else force, "linear": force, "failed": np.array(7.0 * lost)}
    if isinstance(problem, RidgesTrack):
        return {"response": np.ones((2, 3)), "failed": np.array(3.0 * lost)}
    if type(problem) in {type(limit.problem(SWEPT)) for limit in limits.LIMITS}:
        return swept(np.ones(3), np.ones((2, 3)), [""] * 3, measured=[1.0, 1.0], imbalance=0.0, failed=2.0 * lost)
    return {"height": np.array(1.0), "stiffness": np.ones((3, 3)), "failed": np.array(float(lost))}


def one_surface(realisation, **settings):
    def lost(problem):
        mine = isinstance(problem, rough_punch.Surface) and problem.realisation == realisation
        return mine and all(getattr(problem, name) == value for name, value in settings.items())

    return lost


def one_strip(realisation, height, cells):
    return lambda p: (
        isinstance(p, rolling_strip.Strip) and (p.realisation, p.scene.height, p.cells) == (realisation, height, cells)
    )


def the(problem):
    return lambda one: one is problem or one == problem


PUNCH = fractal_punch.FractalPunch(
    hursts=(0.7,), cells=8, surfaces=((0, 4, 4, 4, 0),), profiles=3, fine_profiles=2, decades=(-1, 0)
)
FORCE = force_spectrum.ForceSpectrum(heights=(0.1, 0.3), strips=4, rough_strips=4, refined=4, cells=4)
SWEPT = limits.Limits()
STRIPS_3D = half_space.Wheel3D(strips=4)

TRIALS = model_selection.CalibrationTest(punches=2, spheres=1, rolling=0, wheels=0)
LOST = {
    "fractal punch, middle grid": (fractal_punch, PUNCH, one_surface(2, cells=8), "surface 2, H = 0.7, 8² cells"),
    "fractal punch, finer grid": (fractal_punch, PUNCH, one_surface(1, cells=16), "surface 1, H = 0.7, 16² cells"),
    "fractal punch, coarser": (fractal_punch, PUNCH, one_surface(0, cells=4), "surface 0, H = 0.7, 4² cells"),
    "interface, refined": (
        interface,
        interface.Interface(grounds=((4, 0.7),), pressed=(2, 0.7), surfaces=4, refined=3),
        one_surface(1, cells=128),
        "surface 1, H = 0.7, 128² cells",
    ),
    "bandwidth, wider": (
        bandwidth,
        bandwidth_study.CASE.quick,
        one_surface(110, cells=64),
        "surface 110, H = 0.7, 64² cells",
    ),
    "ridges": (
        ridges,
        ridges.RollingOverRidges(cells=(4, 6), springs=(8.5,)),
        lambda p: p.method == "bem3d" and p.cells == 6,
        "boundary elements, 6 cells to a radius: 3 positions",
    ),
    "rolling, finer grid": (force_spectrum, FORCE, one_strip(3, 0.1, 8), "strip 3, h/d = 0.1, 8 cells to a radius: 7"),
    "rolling, all strips": (force_spectrum, FORCE, one_strip(0, 0.3, 4), "strip 0, h/d = 0.3, 4 cells to a radius: 7"),
    "wheel distance": (
        distance,
        distance.WheelDistance(),
        lambda p: p.track == "steady-state" and p.scene.damping > 0 and p.linear,
        "1 of 40 wheels do not repeat their motion, h₀ = 5e-07 m",
    ),
    "wheel in three dimensions": (
        half_space,
        STRIPS_3D,
        the(STRIPS_3D.strips_of()[half_space.STRIPS][3]),
        "strip 3, 8 cells to a radius, residual 0.0001",
    ),
    "limits, a sweep": (limits, SWEPT, the(limits.LIMITS[0].problem(SWEPT)), "rough strips: 2"),
    "calibration": (
        model_selection,
        TRIALS,
        the(TRIALS.trials[1]),
        f"{TRIALS.trials[1].kind} {TRIALS.trials[1].number}",
    ),
}


@catches("failed loads are not listed", name="fractal punch, finer grid").at(
    "validation.cases.punch.ensembles.describe_failures", lambda *_: ()
)
@pytest.mark.parametrize("name", LOST)
def test_what_is_lost_is_a_line_of_the_result(name):
    """And no problem is solved, or counted, twice."""
    module, case, lost, line = LOST[name]
    whole = Given(solved)
    assert module.run(case, whole).unconverged == ()
    assert len({identity(problem) for problem in whole.seen}) == len(whole.seen)
    found = module.run(case, Given(solved, lost)).unconverged
    assert len(found) == 1 and found[0].startswith(line), found


@pytest.mark.parametrize(
    ("module", "case", "lost"),
    [
        (force_spectrum, replace(FORCE, heights=(0.1,), strips=3, refined=3), one_strip(1, 0.1, 4)),
        (force_spectrum, replace(FORCE, heights=(0.1,), refined=3), one_strip(2, 0.1, 8)),
        (model_selection, TRIALS, lambda _: True),
        (spectrum, spectrum.WheelSpectrum(parameters=False), lambda p: hasattr(p, "track")),
        (distance, distance.WheelDistance(), lambda p: p.track == "part"),
        (half_space, replace(STRIPS_3D, strips=3), the(STRIPS_3D.strips_of()[half_space.STRIPS][0])),
        # no strip may be lost that tells an error bar
        *(
            (half_space, STRIPS_3D, the(STRIPS_3D.strips_of()[which][-1]))
            for which in (half_space.FINER, half_space.LOOSE, half_space.TIGHT)
        ),
    ],
)
def test_too_little_left_is_no_evidence(module, case, lost):
    def outcome(problem, gone):
        return solved(problem, gone) | ({"failed": np.array(99.0)} if gone and hasattr(problem, "track") else {})

    with pytest.raises(NotConvergedError) as caught:
        module.run(case, Given(outcome, lost))
    assert caught.value.unconverged


def test_a_declared_case_hands_on_what_is_lost():
    study = Study(title="t", method="", series=lambda result: [], claims=())
    assert study.evidence(Outcomes(None, {}, ("strip 3",))).unconverged == ("strip 3",)


def test_a_method_that_fails_on_the_clock_is_not_converged_and_a_refusal_is_an_answer():
    """Once for all of its quantities."""
    failed = f"{FAILED}: ConvergenceError: residual 1"
    statuses = {BEM: failed, MDR: FINISHED, LOOSE: f"{OUT_OF_RANGE}: no"}
    points = [
        SimpleNamespace(scene="sphere", method=method, setting="8 cells", status=status)
        for method, status in statuses.items()
        for _ in range(2)
    ]
    assert failure_messages(points) == (f"sphere: {BEM}, 8 cells: {failed}",)


# --- solves that are cut short ---


@pytest.fixture
def indent(monkeypatch):
    """Presses a surface load by load, with another path of contacts."""
    problem, path = PUNCH.surface(0.7, 0, 8), bem3d.indent
    assert rough_punch.press_surface(problem)["failed"] == 0

    def pressed(other):
        monkeypatch.setattr(bem3d, "indent", lambda *args, **settings: other(path, *args, **settings))
        return problem, rough_punch.press_surface(problem)

    return pressed


def test_a_load_that_does_not_converge_has_no_value_at_all(indent):
    """Neither stiffness nor area, approach or gap; the others have all of them."""

    def stubborn(path, half_space, gap, *, forces, **settings):
        for i, force in enumerate(forces):
            yield from path(half_space, gap, forces=[force], **settings, max_iterations=1 if i == 2 else 500)

    problem, found = indent(stubborn)
    assert found["failed"] == 1
    for name in ("stiffness", "area", "approach", "gap"):
        assert np.flatnonzero(np.isnan(found[name])).tolist() == [2]
    assert found["residual"][2] > problem.tolerance
    (line,) = rough_punch.describe_failures([problem], [found])
    assert line.startswith("surface 0, H = 0.7, 8² cells, Fbar = 0.464: residual")


def test_a_stiffness_that_does_not_converge_loses_its_load(indent):
    def unfrozen(path, *args, **settings):
        for i, contact in enumerate(path(*args, **settings)):
            yield replace(contact, frozen=replace(contact.frozen, converged=i != 1))

    _, found = indent(unfrozen)
    assert found["failed"] == 1 and np.isnan(found["stiffness"][1])


def test_wheels_that_do_not_repeat_themselves_are_counted(monkeypatch):
    scene, left = replace(TABLE, distance=0.05, springs=20), np.array([0, 1, 2e-3, 0.0])
    rides = wheel_on_springs.WheelEnsemble(scene=scene, count=4, groups=2, track="steady-state", seed=1)
    monkeypatch.setattr(wheel_on_springs, "periodic_motion", lambda *_, start, **__: (*start, left))
    assert wheel_on_springs.simulate_ensemble(rides)["failed"] == 2
    assert wheel_on_springs.STEADY_TOLERANCE < 1e-3
