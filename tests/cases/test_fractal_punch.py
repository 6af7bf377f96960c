"""The ensembles of Fig. 14.1 against slow answers on the same roughness, and their error bars against known changes."""

import math
import types
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import bem3d
import mdr
from tests.oracles import approach_by_least_squares, dense_operator, spring_sum
from tests.seeded import catches, catches_root_of_two, module_with
from validation.analysis import statistics
from validation.analysis.case import Outcomes
from validation.analysis.evidence import Verdict, number_with, numbers_with
from validation.analysis.statistics import Resolved
from validation.cases.punch import fractal_punch
from validation.cases.punch.ensembles import APPLICATIONS, DEVIATION, MEAN, OVER, worked
from validation.cases.punch.fractal_punch import CONVEX, LONG, SLOPE, TREND, FractalPunch
from validation.cases.punch.fractal_punch_study import EXPONENT, LESS, STUDY
from validation.cases.rolling.force_spectrum import ForceSpectrum
from validation.engine.realisations import random_generator
from validation.simulation import rolling_strip, rough_punch
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import (
    STIFFNESS_ERROR,
    PunchRoughness,
    measure_faces,
    press_lightly,
    press_profiles,
    press_surface,
)

CASE = FractalPunch(
    hursts=(0.7,),
    cells=8,
    surfaces=((0, 0, 8, 6, 4),),
    profiles=40,
    fine_profiles=20,
    points=64,
    decades=(-1, 0),
    per_decade=1,
    tolerance=1e-5,
)
# the band that the case should draw from, written out: 2 pi / L to four cells a wave, L = 1
SPECTRUM = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * 2 * np.pi, rms=CASE.height)


def pressed_by(indent):
    """A fault that only the fractal punch sees: its own view of bem3d, with another path of contacts."""
    return types.SimpleNamespace(**{name: getattr(bem3d, name) for name in bem3d.__all__} | {"indent": indent})


def halves(forces):
    return [force / 2 for force in forces]


def gap_of_the_rigid_surface(surface):
    """As if the half-space did not yield."""
    outcome = rough_punch.press_surface(surface)
    return {**outcome, "gap": -outcome["approach"]}


@catches_root_of_two("the gradient of a drawn punch", "validation.simulation.rough_punch._gradient")
@catches("half of the force in Fig. 14.1").at(
    "validation.simulation.rough_punch.bem3d",
    pressed_by(lambda *args, forces, **more: bem3d.indent(*args, forces=halves(forces), **more)),
)
@catches("mean gap of a half-space that does not yield").at(f"{__name__}.press_surface", gap_of_the_rigid_surface)
def test_surfaces_are_pressed_as_they_stand():
    """Approach, stiffness and mean gap of the dense solution: a bump raises the force, h = 1e-3 exactly, F = Fbar h."""
    half_space = bem3d.HalfSpace(shape=(8, 8), spacing=1 / 8, modulus=1.0)
    found = press_surface(CASE.surface(0.7, 3, 8))
    height = bem3d.rough_surface(
        SPECTRUM.c2d, shape=(8, 8), spacing=1 / 8, rng=random_generator(CASE.seed, 2, 0, 3), rms=CASE.height
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
        assert found["stiffness"][i] == pytest.approx(stiffness, rel=5 * STIFFNESS_ERROR)
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


class LineForGeike(mdr.SelfAffine):
    c1d = mdr.SelfAffine.line


def line_for_geike(roughness):
    first, last = roughness.waves
    return LineForGeike(hurst=roughness.hurst, q_min=2 * np.pi * first, q_max=2 * np.pi * last, rms=roughness.height)


@catches("line trace for Geike in Fig. 14.1", length=1.0).at(
    "validation.simulation.rough_punch.PunchRoughness.spectrum", property(line_for_geike)
)
@pytest.mark.parametrize("length", [1.0, 1.1523])
def test_profiles_are_those_of_geikes_spectrum(length):
    """Every one of them pressed spring by spring at the approach found: force, stiffness and gap as asked for."""
    found = press_profiles(CASE.springs(0.7, 64, length, 40))
    for i in range(CASE.profiles):
        height = mdr.rough_profile(
            lambda q: mdr.geike(q, SPECTRUM.c2d),
            length=1.0,
            points=64,
            rng=random_generator(CASE.seed, 1, 0, i),
            rms=CASE.height,
        )
        for j, force in enumerate(CASE.forces):
            d = found["approach"][i, j]
            expected = spring_sum(height, length, 1.0, d)
            assert expected == pytest.approx((force * 1e-3, found["stiffness"][i, j]), rel=1e-9)
            assert found["gap"][i, j] == pytest.approx(np.maximum(-(height + d), 0).mean(), rel=1e-9, abs=1e-15)


@catches("every profile drawn twice").at(
    "validation.simulation.rough_punch.random_generator",
    lambda entropy, *key: random_generator(entropy, *key[:-1], key[-1] // 2),
)
def test_no_realisation_is_counted_twice():
    result = fractal_punch.run(CASE)
    for key in ((0.7, BEM, 8), (0.7, MDR, 64)):
        first = result[key]["approach"][:, 0]
        assert np.unique(first).size == first.size


LEVELS = replace(CASE, decades=(-1, 1), surfaces=((0, 0, 500, 500, 500),) * 2, per_decade=2)


def synthetic(
    *, fine=1.0, coarse=1.0, apart=1.0, surfaces=500, spread=0.1, at_forces=1.0, hursts=(0.7,), rise=0.0, own=0
):
    """Ensembles with known statistics: springs `apart` times as wide; cells half, twice as wide `fine`, `coarse`.

    at_forces: a factor of the springs' stiffness at each force; rise: d ln deviation / d H of the surfaces;
    own: whether each H has its own phases.
    """
    counts = ((0, 0, surfaces, surfaces, surfaces),) * 2
    case = replace(LEVELS, hursts=hursts, surfaces=counts, profiles=surfaces, fine_profiles=surfaces)
    force = case.height * np.array(case.forces)

    def outcome(rng, deviation, factors=1.0):
        """Exactly that relative deviation, around one."""
        noise = rng.standard_normal(surfaces)
        drawn = 1 + deviation * (noise - noise.mean()) / noise.std(ddof=1)
        stiffness = drawn[:, np.newaxis] * np.sqrt(force) * factors
        work = dict.fromkeys(("applications", "frozen applications"), np.ones_like(stiffness))
        return {"stiffness": stiffness, "approach": 2 * force / stiffness, "area": stiffness, **work}

    found = {}
    for hurst in hursts:
        rng = np.random.default_rng(round(own * 1000 * hurst))
        bem = outcome(rng, spread * math.exp(rise * (hurst - 0.7)))
        springs = outcome(rng, apart * spread, np.array(at_forces))
        for cells, factor in zip(case.grids[2:], (coarse, 1.0, fine), strict=True):
            found[hurst, BEM, cells] = bem | {"stiffness": factor * bem["stiffness"]}
        found |= {(hurst, method, n): springs for method in (MDR, LONG) for n in (case.points, 2 * case.points)}
    return STUDY.evidence(Outcomes(case, found))


def numbers(evidence, name):
    return numbers_with(evidence.numbers, name, OVER)


@catches("no grid error").at(
    "validation.analysis.statistics.Resolved.minus_independent",
    lambda a, b: Resolved(a.value.minus_independent(b.value), 0.0),
)
@catches("no extrapolation").at("validation.cases.punch.fractal_punch.extrapolate_to_zero", statistics.on_finest)
def test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar():
    """First order: 5 % stiffer on cells half as wide is 10 % at cells of no size. Cells twice as wide that are 10 %
    softer say the same but for what the logarithms differ by, and that is left. No change of the deviation."""
    evidence = synthetic(fine=1.05, coarse=1 / 1.1)
    left = 20 * abs(2 * np.log10(1.05) - np.log10(1.1))
    assert [n.value for n in numbers(evidence, MEAN)] == pytest.approx([-20 * 2 * np.log10(1.05)] * 2, abs=1e-3)
    solver = 20 / math.log(10) * 3 * STIFFNESS_ERROR
    for found, name, grid in (
        (evidence, MEAN, math.hypot(left, solver)),
        (evidence, DEVIATION, 6 * solver),
        (synthetic(fine=1.05), MEAN, math.hypot(20 * 2 * np.log10(1.05), solver)),
    ):
        assert [n.grid for n in numbers(found, name)] == pytest.approx([grid] * 2, abs=2e-5)


@catches("the mean of a decade for its worst force").at(
    "validation.analysis.series.worst",
    lambda points: replace(points[0], value=float(np.mean([p.difference for p in points]))),
)
def test_a_decade_is_judged_by_its_worst_force():
    """+20 % at one force and -20 % at the next: differ, though the mean is near zero; and no other decade."""
    evidence = synthetic(surfaces=4000, spread=0.01, at_forces=(1.2, 1 / 1.2, 1.0, 1.0, 1.0))
    low, high = numbers(evidence, MEAN)
    assert (low.verdict, high.verdict) == (Verdict.OUTSIDE, Verdict.WITHIN)
    assert abs(low.value) == pytest.approx(20 * np.log10(1.2), abs=0.01)
    assert low.where["worst at"] in (pytest.approx(0.1), pytest.approx(10**-0.5))


@catches("a third of the interval", apart=1.25, surfaces=60, verdict=Verdict.INCONCLUSIVE).at(
    "validation.analysis.statistics.student", lambda freedom, confidence=0.95: 2 / 3
)
@pytest.mark.parametrize(
    ("apart", "surfaces", "verdict"),
    [
        (1.0, 2000, Verdict.WITHIN),
        (1.25, 1000, Verdict.OUTSIDE),
        (1.25, 10, Verdict.INCONCLUSIVE),
        (1.0, 10, Verdict.INCONCLUSIVE),
        (1.25, 60, Verdict.INCONCLUSIVE),
        (2.0, 60, Verdict.OUTSIDE),
        (0.0, 1000, Verdict.OUTSIDE),
    ],
)
def test_verdicts_on_known_deviations(apart, surfaces, verdict):
    """25 % is found beyond 10 % with 1000 realisations and not with 60; springs without any deviation differ."""
    found = numbers(synthetic(apart=apart, surfaces=surfaces), DEVIATION)
    assert [n.verdict for n in found] == [verdict, verdict]
    assert not apart or [n.value for n in found] == pytest.approx([20 * np.log10(apart)] * 2, abs=0.3)


combined = statistics.combined


@catches("the order of the curves turned round").at(
    "validation.cases.punch.fractal_punch.combined", lambda weights, parts: combined(-np.abs(weights), parts)
)
def test_the_order_of_the_curves_is_found_or_shown_to_be_absent():
    """Deviations that rise by exp(0.5 H) are found to, though each of them is known to some 15 % alone."""
    for rise, own, order in ((0.5, 0, 1), (-0.5, 0, -1), (0.0, 1, 0), (0.1, 1, 0)):
        found = synthetic(surfaces=60, hursts=(0.4, 0.7, 1.0), rise=rise, own=own).table(TREND).where(model=BEM)
        np.testing.assert_allclose(found["value"], rise, atol=0.1)
        ends = np.sign(found["low"]), np.sign(found["high"])
        assert (np.where(ends[0] == ends[1], ends[0], 0) == [order] * 5).all()


def test_exponents_of_a_power_law():
    """Ensembles with k ~ F^0.5 on both sides: the exponent in each decade, and no difference."""
    evidence = synthetic(surfaces=60)
    values = [[n.value for n in numbers_with(evidence.numbers, EXPONENT, one)] for one in (LESS, BEM, MDR)]
    assert values == [pytest.approx([0, 0], abs=1e-9), pytest.approx([0.5]), []]
    for method in (BEM, MDR):
        np.testing.assert_allclose(evidence.table(SLOPE).where(model=method)["value"], 0.5, atol=1e-9)


DRAWN = PunchRoughness._drawn


@catches("other phases for every Hurst exponent").at(
    "validation.simulation.rough_punch.PunchRoughness._drawn",
    lambda mine, *of, **grid: DRAWN(replace(mine, common=False), *of, **grid),
)
@pytest.mark.slow
def test_hurst_exponents_have_common_phases():
    """Stiffnesses of one realisation go together for all H, so means over H keep the error of one; seeds of the bands
    are one; the trend of the deviation with H is found where single curves leave it open."""
    case = replace(CASE, hursts=(0.5, 1.0), surfaces=((0, 20, 20, 4, 0),))
    result = fractal_punch.run(case)
    low, high = (result[hurst, BEM, 8]["stiffness"][:, 1] for hurst in (0.5, 1.0))
    assert np.corrcoef(low, high)[0, 1] > 0.7


@pytest.mark.slow
def test_grids_share_their_surfaces_and_are_pressed_as_planned():
    """So many on each grid at each force; one realisation is nearly the same on all grids with its whole band."""
    case = replace(CASE, cells=16, decades=(-2, 0), surfaces=((0, 0, 8, 6, 4), (12, 10, 6, 4, 0)))
    result = fractal_punch.run(case)
    for cells in case.grids[1:]:
        counts = np.isfinite(result[0.7, BEM, cells]["stiffness"]).sum(axis=0)
        assert counts.tolist() == [case.counts(force).get(cells, 0) for force in case.forces]
    last = [result[0.7, BEM, cells]["stiffness"][:4, -1] for cells in (8, 16, 32)]
    np.testing.assert_allclose(last[1], last[2], rtol=0.05)
    assert (
        case.roughness(0.7, 4).waves == (1, 2) and case.roughness(0.7, 8).waves == (1, 4) == case.roughness(0.7).waves
    )
    assert result.unconverged == ()


@pytest.mark.slow
def test_a_factor_lost_in_the_force_is_a_missed_criterion(monkeypatch):
    """Boundary elements pressed with half, or a hundredth, of the force: stiffness and load curve no longer fit."""
    case = replace(CASE, decades=(-1, 1), cells=16, surfaces=((0, 8, 8, 4, 0),) * 2)
    indent = bem3d.indent
    for factor in (1.0, 0.5, 0.01):
        monkeypatch.setattr(
            bem3d, "indent", lambda *args, forces, factor=factor, **more: indent(*args, forces=factor * forces, **more)
        )
        numbers = STUDY.evidence(fractal_punch.run(case)).numbers
        assert number_with(numbers, CONVEX, BEM).met == (factor == 1.0)


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"cells": 12}, "cells"),
        ({"decades": (1, 1)}, "decades"),
        ({"decades": (-1, 1)}, "surfaces"),
        ({"surfaces": ((0, 0, 8, 4, 0),)}, "surfaces"),
        ({"surfaces": ((0, 9, 0, 8, 4),)}, "surfaces"),
        ({"fine_profiles": 999}, "fine_profiles"),
    ],
)
def test_a_case_that_contradicts_itself_is_refused(wrong, named):
    with pytest.raises(ValueError, match=named):
        replace(CASE, **wrong)


# --- which surfaces and springs share their random numbers ---


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
    case = ForceSpectrum(length=8.0, width=6.0)
    for height, cells in product((0.01, 1.0), (4, 8)):
        case.strips_of(height, cells)[2].surface()
    assert len(seen) == 4 and len(set(seen)) == 1
    seen = drawn_by(monkeypatch, rough_punch)
    for cells in (8, 16):
        one = CASE.surface(0.7, 2, cells)
        one.roughness.surface(one.cells, one.realisation)
    assert len(seen) == 2 and len(set(seen)) == 1


def test_springs_and_surfaces_draw_apart(monkeypatch):
    """No address of random numbers is used for two things."""
    seen, roughness = drawn_by(monkeypatch, rough_punch), CASE.roughness(0.7)
    for i in range(3):
        roughness.surface(8, i)
        roughness.profile(64, i)
    assert len(seen) == 6 == len(set(seen))


def test_work_counts_loads_alike():
    """Four surfaces under a light load and one under a heavy one: two loads, not five contacts."""
    light, heavy = np.full(4, 0.5), np.array([20.0, np.nan, np.nan, np.nan])
    work = np.stack([light, heavy], axis=1)
    outcome = {"applications": work, "frozen applications": np.zeros_like(work)}
    assert worked(64, 2048, [outcome])[APPLICATIONS] == pytest.approx([10.25])


# --- heights of more surfaces than are pressed ---

DRAWN_MANY = replace(CASE, cells=64, drawn=1200, surfaces=((60, 12, 8, 4, 0),), decades=(-1, 0))


def heights_of(case=DRAWN_MANY):
    return np.concatenate([measure_faces(part)["heights"] for part in case.faces(0.7)])


@catches("edges of a punch that carry no more than its middle").at(
    "validation.simulation.rough_punch.bem3d",
    module_with(bem3d, solve_fixed_area=lambda half_space, contact: types.SimpleNamespace(pressure=contact / 1.0)),
)
def test_heights_of_a_face_are_those_of_its_points():
    """Over h: means of the highest cells one by one; moments weighted by the pressure of a dense flat punch."""
    found, cells = heights_of(), 16
    assert found.shape == (1200, 6)
    dense = dense_operator(bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0))
    pressure = np.linalg.solve(dense, np.ones(cells**2))
    weight = pressure / pressure.sum()
    for i in (0, 7, 1100):
        height = DRAWN_MANY.roughness(0.7, cells).surface(cells, i).ravel() / DRAWN_MANY.height
        highest = sorted(height)[::-1]
        mean = weight @ height
        expected = [highest[0], np.mean(highest[:3]), np.mean(highest[:26])]
        expected += [mean, weight @ (height - mean) ** 2, weight @ (height - mean) ** 3]
        np.testing.assert_allclose(found[i], expected, rtol=1e-5, atol=1e-5)


right_mean = statistics.regression_mean


@catches("heights of other surfaces than those that are pressed").at(
    "validation.analysis.statistics.regression_mean",
    lambda values, controls: right_mean(values, np.roll(controls, 1, axis=0)),
)
@pytest.mark.slow
def test_the_mean_stiffness_of_a_real_ensemble_is_within_its_error_bar():
    """480 punches on 16^2 cells, of which 40 are taken at a time: the mean of all is covered in 90 to 99 of 100, with
    less than half of the variance of the plain mean."""
    rng, case = np.random.default_rng(4), replace(DRAWN_MANY, surfaces=((480, 12, 8, 4, 0),))
    stiffness = np.array([press_lightly(case.surface(0.7, i, 16))["stiffness"] for i in range(480)])
    heights = heights_of(case)[:480]
    for of_level in stiffness.T:
        covered, errors = [], []
        for _ in range(300):
            order = rng.permutation(480)
            mean = statistics.regression_mean(of_level[order[:40]], heights[order])
            covered.append(abs(mean.value - of_level.mean()) < mean.half_width)
            errors.append(mean.value - of_level.mean())
        assert 0.9 <= np.mean(covered) <= 0.99
        assert np.mean(np.square(errors)) < 0.5 * of_level.var(ddof=1) * (1 / 40 - 1 / 480)


@catches("a mean of Fig. 14.1 without the heights of more surfaces").at(
    "validation.cases.punch.fractal_punch.regression_mean", lambda values, controls: moments_of_all(values).mean
)
@pytest.mark.slow
def test_heights_of_more_surfaces_make_the_mean_of_all_grids_surer_and_leave_the_deviation():
    result = fractal_punch.run(DRAWN_MANY)
    without = Outcomes(result.case, {k: v for k, v in result.by_key.items() if k[1] != fractal_punch.HEIGHTS})
    surer, plain = (fractal_punch.PunchStatistics(one) for one in (result, without))
    for level in range(2):
        steps = [of.steps(0.7, BEM, MEAN, level) for of in (surer, plain)]
        assert steps[0][16].error < 0.8 * steps[1][16].error
        gains = [steps[0][cells].value - steps[1][cells].value for cells in (16, 32, 64)]
        assert max(gains) - min(gains) < 0.1 * max(map(abs, gains))
        assert all(abs(gain) < 3 * steps[1][16].error for gain in gains)
        deviations = [of.at(0.7, BEM, DEVIATION, level) for of in (surer, plain)]
        assert deviations[0].value.value == deviations[1].value.value
        assert deviations[0].value.half_width == pytest.approx(deviations[1].value.half_width)


def moments_of_all(values):
    return statistics.moments(values, np.isfinite(values))


def test_heights_are_measured_where_they_are_used():
    """In parts of 500; of no surface where the coarsest grid has none; of all that are pressed there at the least."""
    assert [(part.first, part.realisations) for part in DRAWN_MANY.faces(0.7)] == [(0, 500), (500, 500), (1000, 200)]
    assert DRAWN_MANY.controlled
    assert not CASE.controlled and not replace(DRAWN_MANY, drawn=0).controlled
    with pytest.raises(ValueError, match="drawn must be none or all surfaces of the coarsest grid at least, got 59"):
        replace(DRAWN_MANY, drawn=59)
