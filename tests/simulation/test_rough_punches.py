"""What the cases of rough punches rest on: draws and their heights, the roll-off, and what MDR does not model."""

import functools
import math
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from tests.oracles import dense_operator, rms_scatter_of_gaussian_draws
from validation.analysis.evidence import ClaimStatus, Verdict, numbers_with
from validation.analysis.study import Outcomes
from validation.cases.punch import mdr_limits
from validation.cases.punch.mdr_limits import AREA, EXPONENT, ROLL_OFF, MdrLimits
from validation.simulation.rough_punch import METHODS, Profiles, PunchRoughness, Surface, press_profiles, press_surface
from validation.theory import closed_forms

FIXED, EACH, ENSEMBLE = ("fixed", "each"), ("gaussian", "each"), ("gaussian", "ensemble")
HEIGHT = 1e-3
LIMITS = MdrLimits(roll_offs=(1, 4), cells=32, surfaces=6, refined=3, profiles=60, points=256)


def rough(hurst, way):
    amplitudes, normalised = way
    return PunchRoughness(hurst=hurst, waves=(1, 4), seed=141, amplitudes=amplitudes, normalised=normalised)


def draws(roughness, method, count):
    return [roughness.surface(16, i) if method == "bem3d" else roughness.profile(64, i) for i in range(count)]


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("hurst", [0.4, 1.0])
def test_heights_are_normalised_as_they_say(method, hurst):
    """Fixed amplitudes and those normalised each: h in every draw. Of the ensemble: h^2 in the mean of 2000, within
    four of its standard errors, and with the scatter of the waves that carry it, which 2000 draws tell to some 5 %."""
    for way in (FIXED, EACH):
        for height in draws(rough(hurst, way), method, 20):
            assert height.std() == pytest.approx(HEIGHT, rel=1e-12)
    squares = [(height.std() / HEIGHT) ** 2 for height in draws(rough(hurst, ENSEMBLE), method, 2000)]
    expected = rms_scatter_of_gaussian_draws(hurst, last=4, dimensions=2 if method == "bem3d" else 1)
    assert np.mean(squares) == pytest.approx(1, abs=4 * expected / math.sqrt(2000))
    assert np.std(squares) == pytest.approx(expected, rel=0.2)


@pytest.mark.parametrize("method", METHODS)
def test_the_two_gaussian_ways_draw_the_same_shapes(method):
    each, whole = (draws(rough(0.4, way), method, 5) for way in (EACH, ENSEMBLE))
    for height, other in zip(each, whole, strict=True):
        np.testing.assert_allclose(height, other * HEIGHT / other.std(), rtol=1e-12, atol=1e-18)


def test_normalisation_is_a_change_of_the_load():
    """A surface s times as high under Fbar is the same contact as under Fbar / s: kbar is homogeneous."""
    one = rough(0.4, EACH)
    surface = Surface(roughness=one, realisation=1, cells=16, forces=(0.1, 0.5), tolerance=1e-8)
    high = replace(surface, roughness=replace(one, height=2 * one.height), forces=(0.05, 0.25))
    # the same force on a surface twice as high is half of Fbar
    low, doubled = press_surface(surface), press_surface(replace(high, forces=(0.1, 0.5)))
    np.testing.assert_allclose(low["stiffness"], doubled["stiffness"], rtol=1e-5)
    np.testing.assert_allclose(2 * low["gap"], doubled["gap"], rtol=1e-5)
    assert press_surface(high)["stiffness"][0] < low["stiffness"][0]


@pytest.mark.parametrize("roll_off", [1, 4])
def test_no_wave_is_longer_than_the_roll_off_says(roll_off):
    rough = LIMITS.roughness(roll_off)
    modes = np.rint(np.fft.fftfreq(32) * 32)
    power = np.abs(np.fft.fft2(rough.surface(32, 0))) ** 2
    waves = np.hypot(modes[:, np.newaxis], modes)
    inside = (waves > roll_off - 1e-9) & (waves < 8 + 1e-9)
    assert power[~inside].max() < 1e-20 * power.max()
    assert power[inside].min() > 1e-6 * power.max()
    profile = np.abs(np.fft.rfft(rough.profile(256, 0))) ** 2
    assert np.flatnonzero(profile > 1e-12 * profile.max()).tolist() == list(range(roll_off, 9))


def test_a_heavy_load_closes_every_gap():
    """Full contact on coarse cells: area one, gap zero, stiffness of the flat punch of that grid; springs alike."""
    rough = PunchRoughness(hurst=0.7, waves=(1, 2), seed=3)
    surface = Surface(roughness=rough, realisation=0, cells=8, forces=(0.01, 100.0), tolerance=1e-8)
    found = press_surface(surface)
    assert found["area"].tolist()[1] == 1.0
    assert found["gap"][1] == pytest.approx(0, abs=1e-6 * rough.height)
    assert found["gap"][0] > 0.5 * rough.height
    # first order in the cell: -0.35 / n
    assert found["stiffness"][1] / closed_forms.SQUARE_PUNCH == pytest.approx(1 - 0.35 / 8, abs=0.02)
    springs = press_profiles(Profiles(roughness=rough, realisations=3, points=64, length=1.0, forces=(100.0,)))
    np.testing.assert_allclose(springs["area"], 1)
    np.testing.assert_allclose(springs["gap"], 0, atol=1e-12)


@functools.cache
def modes_under_the_punch(cells):
    """Compliances of the dense half-space, and what a uniform pressure has of each of its modes."""
    dense = dense_operator(bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0))
    compliances, vectors = np.linalg.eigh(dense)
    return compliances, vectors.sum(axis=0) ** 2 / cells**2


def stiffness_on_a_layer(kappas, cells):
    """k / (E* L) of a flat punch on a uniform layer: the dense half-space with 1 / kappa on its diagonal."""
    compliances, shares = modes_under_the_punch(cells)
    return np.array([np.sum(shares / (compliances + 1 / k)) for k in kappas])


def synthetic(exponent, *, refined=1.0):
    """Interfaces with kappa ~ F^exponent under the punch, the same in every draw but for some noise."""
    rng = np.random.default_rng(0)
    kappa = 0.5 * np.array(LIMITS.forces) ** exponent

    def outcome(stiffness, count):
        values = stiffness * (1 + 1e-3 * rng.standard_normal((count, 1)))
        work = {name: np.full(values.shape, 10.0) for name in ("applications", "frozen applications")}
        return {"stiffness": values, "area": values, "gap": values, "gradient": np.full(count, 1e-2), **work}

    found = {}
    for r in LIMITS.roll_offs:
        bem = found[r, LIMITS.cells] = outcome(stiffness_on_a_layer(kappa, LIMITS.cells), LIMITS.surfaces)
        found[r, LIMITS.finer] = {n: refined * v[: LIMITS.refined] for n, v in bem.items()}
        found[r, "mdr"] = outcome(1 / (1 / kappa + 1), LIMITS.profiles)
    return mdr_limits.CASE.evidence(Outcomes(LIMITS, found))


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [1.0, 0.8])
def test_the_exponent_of_the_interface_is_found_behind_the_punch(exponent):
    """For the roll-off that is wide enough, in both decades, by both methods; interpolation costs some 1e-3."""
    evidence = synthetic(exponent)
    found = numbers_with(evidence.numbers, EXPONENT)
    assert len(found) == 2 * 2
    for n in found:
        assert n.where[ROLL_OFF] == 4
        assert n.value == pytest.approx(exponent, abs=3e-3)
        assert n.verdict is (Verdict.AGREE if exponent == 1 else Verdict.DIFFER)
    proportional = [claim.status for claim in evidence.claims if "proportional" in claim.claim]
    assert proportional == 2 * [ClaimStatus.HOLDS if exponent == 1 else ClaimStatus.CONTRADICTED]


@pytest.mark.slow
def test_what_finer_cells_change_is_extrapolated_and_half_of_it_left_open():
    finer, plain = (numbers_with(synthetic(1.0, refined=factor).numbers, AREA) for factor in (1.05, 1.0))
    assert len(finer) == 2 * 2
    for n, same in zip(finer, plain, strict=True):
        assert n.value == pytest.approx(same.value - 2 * 20 * np.log10(1.05), abs=1e-6)
        assert n.grid == pytest.approx(20 * np.log10(1.05), rel=1e-6)
