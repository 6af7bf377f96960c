"""The ensembles of Fig. 14.1 against slow answers on the same roughness, and their error bars against known changes."""

import math
from dataclasses import replace

import numpy as np
import pytest

import bem3d
import mdr
from tests.oracles import approach_by_least_squares, dense_operator, spring_sum
from validation.analysis.evidence import Verdict, number_with, numbers_with
from validation.cases.punch import fractal_punch, fractal_punch_evidence
from validation.cases.punch.fractal_punch import Ensemble, FractalPunch, FractalPunchResult
from validation.cases.punch.fractal_punch_numbers import CONVEX
from validation.engine.engine import random_generator
from validation.simulation.rough_punch import press_profiles, press_surface

CASE = FractalPunch(
    hursts=(0.7,), cells=8, surfaces=8, profiles=40, points=64, refined=4, decades=(-1, 0), per_decade=1, tolerance=1e-5
)
# the band that the case should draw from, written out: 2 pi / L to four cells a wave, L = 1
SPECTRUM = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * 2 * np.pi, rms=CASE.height)


def test_surfaces_are_pressed_as_they_stand():
    """Approach, stiffness and mean gap of the dense solution: a bump raises the force, h = 1e-3 exactly, F = Fbar h."""
    half_space = bem3d.HalfSpace(shape=(8, 8), spacing=1 / 8, modulus=1.0)
    found = press_surface(CASE.surface(0.7, 3, 8))
    height = bem3d.rough_surface(
        SPECTRUM.c2d, shape=(8, 8), spacing=1 / 8, rng=random_generator(CASE.seed, 2, 700, 3), rms=CASE.height
    )
    assert height.std() == pytest.approx(1e-3, rel=1e-12)
    dense = dense_operator(half_space)
    for i, force in enumerate((0.1, 1.0)):
        approach = approach_by_least_squares(half_space, -height, force * 1e-3)
        overlap = approach + height.max()
        assert found["approach"][i] == pytest.approx(approach, abs=1e-4 * overlap)
        pressure = bem3d.solve(half_space, -height, approach=approach, tolerance=1e-10).pressure
        cells = np.flatnonzero(pressure > 0)
        stiffness = np.linalg.solve(dense[np.ix_(cells, cells)], np.ones(cells.size)).sum() / 64
        assert found["stiffness"][i] == pytest.approx(stiffness, rel=1e-5)
        assert found["area"][i] == pytest.approx(cells.size / 64)
        gap = dense @ pressure.ravel() - height.ravel() - approach
        # a residual of 1e-5 leaves so much of the overlap
        assert found["gap"][i] == pytest.approx(gap.mean(), abs=1e-4 * overlap)
        assert gap.min() > -1e-6 * overlap
    slope = np.gradient(np.pad(np.tile(bem3d_periodic(height), (3, 3)), 0), 1 / 512, axis=(0, 1))
    middle = np.s_[512:1024, 512:1024]
    assert found["gradient"] == pytest.approx(np.sqrt(np.mean(slope[0][middle] ** 2 + slope[1][middle] ** 2)), rel=1e-3)


def bem3d_periodic(height):
    """The same band-limited surface on 512 x 512 points: zeros appended to its spectrum."""
    n, m = len(height), 512
    spectrum = np.zeros((m, m), dtype=complex)
    k = np.rint(np.fft.fftfreq(n) * n).astype(int)
    spectrum[np.ix_(k, k)] = np.fft.fft2(height)
    return np.fft.ifft2(spectrum).real * (m / n) ** 2


@pytest.mark.parametrize("length", [1.0, 1.1523])
def test_profiles_are_those_of_geikes_spectrum(length):
    """Every one of them pressed spring by spring at the approach found: force, stiffness and gap as asked for."""
    found = press_profiles(CASE.springs(0.7, 64, length))
    for i in range(CASE.profiles):
        height = mdr.rough_profile(
            lambda q: mdr.geike(q, SPECTRUM.c2d),
            length=1.0,
            points=64,
            rng=random_generator(CASE.seed, 1, 700, i),
            rms=CASE.height,
        )
        for j, force in enumerate(CASE.forces):
            d = found["approach"][i, j]
            expected = spring_sum(height, length, 1.0, d)
            assert expected == pytest.approx((force * 1e-3, found["stiffness"][i, j]), rel=1e-9)
            assert found["gap"][i, j] == pytest.approx(np.maximum(-(height + d), 0).mean(), rel=1e-9, abs=1e-15)


def test_no_realisation_is_counted_twice():
    result = fractal_punch.run(CASE)
    for outcome in (result.ensembles[0].bem, result.ensembles[0].mdr):
        assert np.unique(outcome["approach"][:, 0]).size == outcome["approach"].shape[0]


LEVELS = replace(CASE, decades=(-1, 1), per_decade=2, refined_per_decade=1, light=10.0)


def drawn(rng, size, deviation):
    """Exactly that relative deviation, around one."""
    noise = rng.standard_normal(size)
    return 1 + deviation * (noise - noise.mean()) / noise.std(ddof=1)


def synthetic(*, fine=1.0, coarse=1.0, apart=1.0, surfaces=500, spread=0.1, case=LEVELS):
    """Ensembles with known statistics: springs `apart` times as wide; cells half, twice as wide `fine`, `coarse`."""
    case = replace(case, surfaces=surfaces, profiles=surfaces, refined=min(surfaces, case.refined))
    rng = np.random.default_rng(0)

    def outcome(deviation):
        force = case.height * np.array(case.forces)
        stiffness = drawn(rng, surfaces, deviation)[:, np.newaxis] * np.sqrt(force)
        return {"stiffness": stiffness, "approach": 2 * force / stiffness, "area": stiffness}

    def refined(factor):
        levels = np.isin(case.forces, case.refined_forces)
        return {name: factor * values[:, levels] for name, values in bem.items()}

    bem, springs = outcome(spread), outcome(apart * spread)
    counts = {"applications": np.ones(1), "frozen applications": np.ones(1)}
    bem |= {name: np.ones_like(bem["area"]) for name in counts}
    ensemble = Ensemble(0.7, bem, refined(coarse), refined(fine), springs, springs, springs)
    return fractal_punch_evidence.evidence(FractalPunchResult(case, [ensemble], ()))


def numbers(evidence, name):
    return numbers_with(evidence.numbers, name, "mdr over bem3d")


@pytest.mark.slow
def test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar():
    """First order: 5 % stiffer on cells half as wide and 10 % softer on cells twice as wide is 10 % at cells of no
    size, either way: only what the two logarithms differ by is left. No change of the deviation."""
    evidence = synthetic(fine=1.05, coarse=1 / 1.1)
    left = 20 * abs(2 * np.log10(1.05) - np.log10(1.1))
    for n in numbers(evidence, "mean stiffness"):
        assert n.value == pytest.approx(-20 * 2 * np.log10(1.05), abs=1e-6)
        assert n.grid == pytest.approx(left, abs=1e-6)
    for n in numbers(evidence, "relative deviation"):
        assert n.grid == pytest.approx(0, abs=1e-6)
    for n in numbers(synthetic(fine=1.05), "mean stiffness"):
        assert n.grid == pytest.approx(20 * 2 * np.log10(1.05), abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("apart", "surfaces", "verdict"),
    [
        (1.0, 8000, Verdict.AGREE),
        (1.15, 500, Verdict.DIFFER),
        (1.15, 10, Verdict.UNDECIDED),
        (1.0, 10, Verdict.UNDECIDED),
        (1.15, 60, Verdict.UNDECIDED),
        (2.0, 60, Verdict.DIFFER),
    ],
)
def test_verdicts_on_known_deviations(apart, surfaces, verdict):
    """A change of 15 % is found with 500 realisations and not with 10; agreement within 3 % takes some thousands."""
    evidence = synthetic(apart=apart, surfaces=surfaces)
    found = numbers(evidence, "relative deviation")
    assert len(found) == 2
    for n in found:
        assert n.verdict is verdict
        assert n.value == pytest.approx(20 * np.log10(apart), abs=1e-6)


@pytest.mark.slow
def test_so_many_realisations_would_decide():
    """Where 10 leave 15 % undecided, the number that is named decides, and a third of it does not."""
    few = numbers(synthetic(apart=1.15, surfaces=10), "relative deviation")[0]
    named = math.ceil(10 * few.sample_needed)
    # the interval of ten is known to some 20 %, and so is the number to some 40 %
    assert numbers(synthetic(apart=1.15, surfaces=2 * named), "relative deviation")[0].verdict is Verdict.DIFFER
    assert numbers(synthetic(apart=1.15, surfaces=named // 3), "relative deviation")[0].verdict is Verdict.UNDECIDED


def test_exponents_of_a_power_law():
    """Ensembles with k ~ F^0.5 on both sides: the exponent in each decade, and no difference."""
    evidence = synthetic(surfaces=60)
    decades = evidence.table("decades").where(quantity="exponent")
    np.testing.assert_allclose(decades["mdr"], 0.5, atol=1e-9)
    np.testing.assert_allclose(decades["bem3d"], 0.5, atol=1e-9)
    np.testing.assert_allclose(evidence.table("curves")["mdr exponent"], 0.5, atol=1e-9)


@pytest.mark.slow
def test_means_over_hurst_exponents():
    """Seven equal ensembles: the same difference, 1/sqrt(7) of the interval of the sample."""
    case = replace(CASE, hursts=(0.4, 0.7, 1.0), surfaces=40, refined=40)
    result = fractal_punch.run(case)
    evidence = fractal_punch_evidence.evidence(result)
    for quantity in ("mean stiffness", "relative deviation"):
        rows = evidence.table("decades").where(quantity=quantity)
        single, mean = np.isfinite(rows["H"]), np.isnan(rows["H"])
        assert rows["difference"][mean][0] == pytest.approx(rows["difference"][single].mean())
        assert rows["± sample"][mean][0] == pytest.approx(np.sqrt((rows["± sample"][single] ** 2).sum()) / 3, rel=0.05)


@pytest.mark.slow
def test_surfaces_without_a_heavy_load_on_other_grids():
    """Up to the light force all of them, beyond it the first few; what was not pressed is missing, and no failure."""
    case = replace(CASE, decades=(-2, 0), light=0.1)
    result = fractal_punch.run(case)
    for outcome in (result.ensembles[0].coarser, result.ensembles[0].finer):
        pressed = np.isfinite(outcome["stiffness"])
        assert pressed[:, :2].all()
        assert pressed[: case.refined].all() and not pressed[case.refined :, 2].any()
    assert result.unconverged == ()
    none = fractal_punch.run(replace(case, light=0.0))
    assert none.ensembles[0].finer["stiffness"].shape == (case.refined, 3)
    np.testing.assert_array_equal(
        none.ensembles[0].finer["stiffness"], result.ensembles[0].finer["stiffness"][: case.refined]
    )


@pytest.mark.slow
def test_a_factor_lost_in_the_force_is_a_missed_criterion(monkeypatch):
    """Boundary elements pressed with half, or a hundredth, of the force: stiffness and load curve no longer fit."""
    case = replace(CASE, decades=(-1, 1), cells=16)
    indent = bem3d.indent
    for factor in (1.0, 0.5, 0.01):
        monkeypatch.setattr(
            bem3d, "indent", lambda *args, forces, factor=factor, **more: indent(*args, forces=factor * forces, **more)
        )
        numbers = fractal_punch_evidence.evidence(fractal_punch.run(case)).numbers
        assert number_with(numbers, CONVEX, "bem3d").met == (factor == 1.0)


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"cells": 9}, "cells"),
        ({"cells": 4}, "cells"),
        ({"decades": (1, 1)}, "decades"),
        ({"per_decade": 3, "refined_per_decade": 2}, "refined_per_decade"),
        ({"refined_per_decade": 0}, "refined_per_decade"),
        ({"refined": 2}, "refined"),
        ({"refined": 9, "surfaces": 8}, "refined"),
    ],
)
def test_a_case_that_contradicts_itself_is_refused(wrong, named):
    with pytest.raises(ValueError, match=named):
        replace(CASE, **wrong)
