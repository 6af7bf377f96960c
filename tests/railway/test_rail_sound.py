"""The force of a wheel at a constant height: Geike's spectrum, linear theory, parts and grids."""

from dataclasses import replace

import numpy as np
import pytest

import mdr
from tests.seeded import catches
from validation.railway.problems import equivalent_displacement
from validation.railway.problems.equivalent_displacement import geike_track, linear_displacement
from validation.railway.problems.rail_sound import HeldWheel, roll_held_wheel, samples_of, sounding_strip
from validation.railway.problems.rail_strip import line_of
from validation.railway.theory.transverse_structure import IsotropicGround
from validation.scenes.load import load_scene
from validation.simulation.model_names import BEM, LINE, LINEAR, SPRINGS_THAT_READ

RAIL = load_scene("rail")
RATE, SAMPLES = 24000, 720


def strip(cells=6, offset=0.0, samples=SAMPLES):
    scene = replace(RAIL, roughness=RAIL.levels.raised(offset))
    return sounding_strip(scene, across="isotropic", samples=samples, rate=RATE, cells=cells, seed=3)


def held(model, strip, first=0, last=None):
    last = strip.shape[0] if last is None else last
    return roll_held_wheel(HeldWheel(strip=strip, model=model, first=first, last=last, tolerance=1e-6))["force"]


def test_a_strip_takes_its_time_and_is_the_same_on_every_grid():
    coarse, fine = strip(4), strip(6)
    assert coarse.length == fine.length == pytest.approx(SAMPLES / RATE * RAIL.speed, rel=1e-12)
    assert coarse.width == fine.width >= 12 * RAIL.contact.along
    signals = [samples_of(held(LINEAR, rough), SAMPLES) for rough in (coarse, fine)]
    # the middle lies between cells, and heights there are exact: what differs is rounding
    np.testing.assert_allclose(*_without_shift(signals, coarse, fine), atol=1e-6 * np.abs(signals[0]).max())


def _without_shift(signals, *strips):
    """Cell centres begin half a cell behind the origin, which differs from grid to grid."""
    f = np.fft.rfftfreq(SAMPLES, 1 / RATE)
    for signal, rough in zip(signals, strips, strict=True):
        yield np.fft.irfft(np.fft.rfft(signal) * np.exp(-1j * np.pi * f * rough.spacing / RAIL.speed), SAMPLES)


@catches("the line trace taken for Geike's spectrum").at(
    f"{__name__}.geike_track", lambda strip: equivalent_displacement.linear_displacement(strip, LINE)
)
def test_geikes_track_has_his_spectrum_and_the_phases_of_the_line():
    """C_1D / C_line = pi k C_2D / C_line of the continuous ground; of a strip, sums over k_y are 5 % off at most."""
    rough = strip()
    line = np.fft.rfft(linear_displacement(rough, LINE))
    track = np.fft.rfft(geike_track(rough))
    k = 2 * np.pi * np.fft.rfftfreq(rough.shape[0], rough.spacing)
    inside = (k > 1.02 * rough.ground.first) & (k < 0.8 * rough.ground.last)
    ground = IsotropicGround(line_of(RAIL), q_max=rough.ground.last)
    expected = mdr.geike(k[inside], ground.c2d) / ground.line_power(k[inside])
    ratio = track[inside] / line[inside]
    np.testing.assert_allclose(ratio.imag, 0, atol=1e-9)
    np.testing.assert_allclose(ratio.real**2, expected, rtol=0.05)
    assert np.abs(track[k < 0.99 * rough.ground.first]).max() < 1e-9 * np.abs(track).max()


def springs_on_middle_line(height, *, spacing, **wheel):
    return mdr.roll(height[:, height.shape[1] // 2], spacing=spacing[0], **wheel)


@catches("springs that read one line of the surface").at("mdr.roll_surface", springs_on_middle_line)
def test_springs_that_read_a_smoother_rail_are_linear_theory():
    """While all springs touch they differ by discretisation alone, 3 %."""
    rough = strip(offset=-40.0)
    read, linear = (samples_of(held(model, rough), SAMPLES) for model in (SPRINGS_THAT_READ, LINEAR))
    assert np.abs(read - linear).max() < 0.03 * np.abs(linear).max()


def test_samples_are_those_of_the_waves_of_a_force_less_its_mean():
    """A force of two waves at any number of instants of its period."""

    def waves(count):
        phase = 2 * np.pi * np.arange(count) / count
        return 300 * np.cos(3 * phase) - 40 * np.sin(7 * phase)

    np.testing.assert_allclose(samples_of(5e4 + waves(50), 64), waves(64), atol=1e-6)


@pytest.mark.slow
def test_boundary_elements_are_the_same_in_parts():
    """To the residual, over the force."""
    rough = strip(4, samples=400)
    whole, part = held(BEM, rough, 0, 12), held(BEM, rough, 6, 12)
    np.testing.assert_allclose(part, whole[6:], rtol=1e-4)
    assert abs(whole.mean() / RAIL.load - 1) < 0.1
