"""Surfaces and problems of cases: which share them, and which have their own."""

import pytest

from validation.cases.punch import fractal_punch
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.selection import model_selection as ladder
from validation.engine.random_numbers import random_generator
from validation.simulation import rolling_strip, rough_punch

PUNCH = fractal_punch.FractalPunch(
    hursts=(0.7,), cells=8, surfaces=((0, 4, 4, 4, 0),), profiles=3, fine_profiles=2, decades=(-1, 0)
)


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
