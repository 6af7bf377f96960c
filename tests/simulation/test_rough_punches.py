"""What the cases of rough punches rest on: draws, their heights and waves, and full contact."""

import math

import numpy as np
import pytest

from tests.oracles import rms_scatter_of_gaussian_draws
from tests.seeded import catches
from validation.simulation.rough_punch import METHODS, Profiles, PunchRoughness, Surface, press_profiles, press_surface
from validation.theory import closed_forms

FIXED, EACH, ENSEMBLE = ("fixed", "each"), ("gaussian", "each"), ("gaussian", "ensemble")
HEIGHT = 1e-3


def rough(hurst, way):
    amplitudes, normalised = way
    return PunchRoughness(hurst=hurst, waves=(1, 4), seed=141, amplitudes=amplitudes, normalised=normalised)


def draws(roughness, method, count):
    return [roughness.surface(16, i) if method == "bem3d" else roughness.profile(64, i) for i in range(count)]


@catches("rms of the ensemble for that of each", method="bem3d", hurst=1.0).at(
    "validation.simulation.rough_punch.PunchRoughness._normalised", lambda roughness, height: height
)
@catches("rms of each for that of the ensemble", method="mdr", hurst=1.0).at(
    "validation.simulation.rough_punch.PunchRoughness._normalised",
    lambda roughness, height: height * roughness.height / height.std(),
)
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


@pytest.mark.parametrize("first", [1, 4])
def test_no_wave_is_longer_than_the_band_says(first):
    rough = PunchRoughness(hurst=0.7, waves=(first, 8), seed=142)
    modes = np.rint(np.fft.fftfreq(32) * 32)
    power = np.abs(np.fft.fft2(rough.surface(32, 0))) ** 2
    waves = np.hypot(modes[:, np.newaxis], modes)
    inside = (waves > first - 1e-9) & (waves < 8 + 1e-9)
    assert power[~inside].max() < 1e-20 * power.max()
    assert power[inside].min() > 1e-6 * power.max()
    profile = np.abs(np.fft.rfft(rough.profile(256, 0))) ** 2
    assert np.flatnonzero(profile > 1e-12 * profile.max()).tolist() == list(range(first, 9))


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
