"""The ensembles of Fig. 14.1 against slow answers on the same roughness, and their error bars against known changes."""

from dataclasses import replace

import numpy as np
import pytest

import bem3d
import mdr
from tests.oracles import approach_by_least_squares, dense_operator, spring_sum
from validation.cases import fractal_punch, fractal_punch_evidence
from validation.cases.fractal_punch import FractalPunch, Profiles, Surface
from validation.ensemble import generator
from validation.evidence import Verdict
from validation.statistics import log_mean, log_relative_deviation, paired_change

CASE = FractalPunch(
    hursts=(0.7,), cells=8, surfaces=8, profiles=40, points=64, refined=4, decades=(-1, 0), reported=(0.1, 1.0)
)
# the band that the case should draw from, written out: 2 pi / L to four cells a wave, L = 1
SPECTRUM = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * 2 * np.pi, rms=CASE.height)


def test_surfaces_are_pressed_as_they_stand():
    """Approach and stiffness of the dense solution: a bump raises the force, h = 1e-3 exactly, F = Fbar h."""
    half_space = bem3d.HalfSpace(shape=(8, 8), spacing=1 / 8, modulus=1.0)
    surface = Surface(case=CASE, hurst=0.7, realisation=3, cells=8, forces=(0.1, 1.0))
    found = fractal_punch.press_surface(surface)
    height = bem3d.rough_surface(
        SPECTRUM.c2d, shape=(8, 8), spacing=1 / 8, rng=generator(CASE.seed, 2, 700, 3), rms=CASE.height
    )
    assert height.std() == pytest.approx(1e-3, rel=1e-12)
    for i, force in enumerate((0.1, 1.0)):
        approach = approach_by_least_squares(half_space, -height, force * 1e-3)
        assert found["approach"][i] == pytest.approx(approach, abs=1e-4 * (approach + height.max()))
        pressed = bem3d.solve(half_space, -height, approach=approach, tolerance=1e-10).pressure > 0
        cells = np.flatnonzero(pressed)
        dense = np.linalg.solve(dense_operator(half_space)[np.ix_(cells, cells)], np.ones(cells.size)).sum() / 64
        assert found["stiffness"][i] == pytest.approx(dense, rel=1e-5)
        assert found["area"][i] == pytest.approx(cells.size / 64)


@pytest.mark.parametrize("length", [1.0, 1.1523])
def test_profiles_are_those_of_geikes_spectrum(length):
    """Every one of them pressed spring by spring at the approach found: the force asked for, and its stiffness."""
    found = fractal_punch.press_profiles(Profiles(case=CASE, hurst=0.7, points=64, length=length))
    for i in range(CASE.profiles):
        height = mdr.rough_profile(
            lambda q: mdr.geike(q, SPECTRUM.c2d),
            length=1.0,
            points=64,
            rng=generator(CASE.seed, 1, 700, i),
            rms=CASE.height,
        )
        for j, force in enumerate(CASE.forces):
            expected = spring_sum(height, length, 1.0, found["approach"][i, j])
            assert expected == pytest.approx((force * 1e-3, found["stiffness"][i, j]), rel=1e-9)


def test_no_realisation_is_counted_twice():
    result = fractal_punch.run(CASE)
    for outcome in (result.ensembles[0].bem, result.ensembles[0].mdr):
        assert np.unique(outcome["approach"][:, 0]).size == outcome["approach"].shape[0]


def synthetic(*, change=1.0, apart=1.0, surfaces=500, spread=0.1):
    """Ensembles with known statistics: springs `apart` times as wide in deviation, finer cells `change` as stiff."""
    case = replace(CASE, surfaces=surfaces, profiles=surfaces)
    rng = np.random.default_rng(0)
    force = case.height * np.array(case.forces)

    def outcome(deviation):
        noise = rng.standard_normal(surfaces)
        stiffness = (1 + deviation * (noise - noise.mean()) / noise.std(ddof=1))[:, np.newaxis] * np.sqrt(force)
        return {"stiffness": stiffness, "approach": 2 * force / stiffness, "area": stiffness}

    bem, springs = outcome(spread), outcome(apart * spread)
    levels = [int(np.argmin(np.abs(np.array(case.forces) - f))) for f in case.reported]
    fine = {name: change * values[: case.refined, levels] for name, values in bem.items()}
    ensemble = fractal_punch.Ensemble(0.7, bem, fine, springs, springs, springs)
    return fractal_punch_evidence.evidence(fractal_punch.FractalPunchResult(case, [ensemble], ()))


def numbers(evidence, name):
    return [n for n in evidence.numbers if n.label.startswith(f"{name} at") and n.role == "finding"]


def test_a_change_of_the_grid_reaches_its_error_bar():
    """Five per cent stiffer on cells half as wide: 20 lg 1.05 dB, twice at first order, and no change of deviation."""
    evidence = synthetic(change=1.05)
    for n in numbers(evidence, "mean stiffness"):
        assert n.grid == pytest.approx(2 * 20 * np.log10(1.05), rel=1e-6)
    for n in numbers(evidence, "relative deviation"):
        assert n.grid == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize(
    ("apart", "surfaces", "verdict"),
    [(1.0, 500, Verdict.AGREE), (2.0, 500, Verdict.DIFFER), (1.3, 8, Verdict.UNDECIDED)],
)
def test_verdicts_on_known_deviations(apart, surfaces, verdict):
    """Equal deviations agree, a factor two (6 dB) differs, and eight surfaces decide nothing."""
    evidence = synthetic(apart=apart, surfaces=surfaces)
    for n in numbers(evidence, "relative deviation"):
        assert n.verdict is verdict
        assert n.value == pytest.approx(20 * np.log10(apart), abs=0.02)


def test_a_factor_lost_in_the_force_is_a_missed_criterion(monkeypatch):
    """Boundary elements pressed with half, or a hundredth, of the force: stiffness and load curve no longer fit."""
    case = replace(CASE, decades=(-1, 1), cells=16)
    indent = bem3d.indent
    for factor in (1.0, 0.5, 0.01):
        monkeypatch.setattr(
            bem3d, "indent", lambda *args, forces, factor=factor, **more: indent(*args, forces=factor * forces, **more)
        )
        numbers = fractal_punch_evidence.evidence(fractal_punch.run(case)).numbers
        slope = next(n for n in numbers if n.label.startswith("bem3d: slope"))
        assert slope.met == (factor == 1.0)


def test_error_of_a_paired_change():
    """The scatter of the change, propagated, against the spread of what many samples of pairs measure."""
    rng = np.random.default_rng(0)
    for statistic in (log_mean, log_relative_deviation):
        changes, errors = [], []
        for _ in range(300):
            coarse = 1 + 0.2 * rng.standard_normal(40)
            fine = coarse * np.exp(0.02 * rng.standard_normal(40))
            change, error = paired_change(fine[:20], coarse[:20], coarse, statistic)
            changes.append(change)
            errors.append(error)
        # the standard deviation of 300 values is known to 4 %, the gradient of 20 or 40 values to some 10 %
        assert np.mean(errors) == pytest.approx(np.std(changes), rel=0.2)


def test_reported_forces_are_among_the_levels():
    with pytest.raises(ValueError, match="reported"):
        FractalPunch(reported=(0.15,))
