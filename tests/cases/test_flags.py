"""A flag that something did not converge, in the outcome of a case: a line of its result, or its end."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from validation.analysis.study import Outcomes, Study
from validation.benchmarks.timing import FAILED, FINISHED, OUT_OF_RANGE
from validation.benchmarks.work_precision.case import lost
from validation.benchmarks.work_precision.problem import BEM, LOOSE, MDR, POLONSKY_KEER
from validation.cases.limits import limits
from validation.cases.punch import bandwidth, fractal_punch, mdr_limits, normalisation
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import input_spectrum as rolling_input
from validation.cases.rolling import ridges
from validation.cases.selection import model_selection as ladder
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import spectrum as wheel
from validation.engine.convergence import NotConvergedError
from validation.simulation import rolling_strip, rough_punch
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.limits_of_half_space import Grid
from validation.simulation.probing import swept
from validation.simulation.ridges import RidgesTrack


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
    if isinstance(problem, RidgesTrack):
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
    return swept(np.ones(3), np.ones((2, 3)), [""] * 3, measured=[1.0, 1.0], imbalance=0.0, failed=2.0 * lost)


def test_a_solve_that_is_lost_in_a_sweep_is_a_line_of_the_result():
    case = limits.Limits(grids=(32, 64), tolerances=(1e-2, 1e-4))
    assert limits.run(case, Given(swept_through, lambda _: False)).unconverged == ()
    first = limits.LIMITS[0].problem(case)
    assert limits.run(case, Given(swept_through, lambda p: p == first)).unconverged == ("rough strips: 2",)
    grid = next(g for g in case.on_grids()["judged"] if g.solver == "solve_polonsky_keer")
    lost = limits.run(case, Given(swept_through, lambda p: p == grid)).unconverged
    assert lost == (f"{grid.scene}, {grid.cells}² cells, solve_polonsky_keer to {grid.tolerances[-1]:g}",)


def test_a_reference_that_fails_is_a_line_of_the_result():
    case = ladder.CalibrationTest(punches=2, spheres=1, rolling=0, wheels=0)
    gone = case.trials[1]
    assert ladder.run(case, Given(pressed, lambda p: p == gone)).unconverged == (f"{gone.kind} {gone.number}",)
    with pytest.raises(NotConvergedError):
        ladder.run(case, Given(pressed, lambda _: True))


def test_a_declared_case_hands_on_what_is_lost():
    study = Study(title="t", method="", series=lambda result: [], claims=())
    assert study.evidence(Outcomes(None, {}, ("strip 3",))).unconverged == ("strip 3",)


def points(**statuses):
    return [
        SimpleNamespace(scene="sphere", method=line, setting="8 cells", status=status)
        for line, status in statuses.items()
        for _ in range(2)
    ]


def test_a_method_that_fails_on_the_clock_is_not_converged_and_a_refusal_is_an_answer():
    """Once for all of its quantities; the textbook's iteration is there to be seen failing."""
    failed = f"{FAILED}: ConvergenceError: residual 1"
    statuses = {BEM: failed, MDR: FINISHED, LOOSE: f"{OUT_OF_RANGE}: no", POLONSKY_KEER: failed}
    assert lost(points(**statuses)) == (f"sphere: {BEM}, 8 cells: {failed}",)


def test_every_problem_of_a_case_is_its_own():
    """No realisation is solved, or counted, twice."""
    for run, case, _, _ in LOST.values():
        given = Given(pressed, lambda _: False)
        run(case, given)
        assert len({repr(problem) for problem in given.seen}) == len(given.seen)
