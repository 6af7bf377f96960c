"""What a solve that was cut short leaves: no value, and a count."""

import functools
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from validation.cases.punch import fractal_punch
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling.ridges import RollingOverRidges
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.simulation import ridges, rolling_strip, rough_punch
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.limits_of_half_space import Grid, press_grid
from validation.simulation.track_spectrum import self_affine

PUNCH = fractal_punch.FractalPunch(
    hursts=(0.7,), cells=8, surfaces=((0, 4, 4, 4, 0),), profiles=3, fine_profiles=2, decades=(-1, 0)
)


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
    waves = RollingOverRidges(length=8, shortest=4.0).ridges
    rolled = ridges.RidgesTrack(ridges=waves, method="bem3d", cells=4)
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
