"""Signals that are heard: one scale for all, gains of waves, and pieces of equal length."""

import numpy as np
import pytest

from validation.analysis.spectra import (
    Sound,
    Sounds,
    a_weighting,
    common_full_scale,
    energy_sum,
    filtered,
    powers_of_blocks,
)


def test_what_is_left_over_is_in_no_piece():
    found = powers_of_blocks(np.array([1.0, -1.0, 2.0, 2.0, 0.0, 3.0, 100.0]), 3)
    np.testing.assert_allclose(found, [1.0, 4.0, 4.5])


@pytest.mark.parametrize(("peaks", "scale"), [((0.3, -471.2), 480.0), ((0.05, 0.01), 0.05), ((-1.01e-7,), 1.1e-7)])
def test_the_common_scale_is_the_next_number_of_two_digits(peaks, scale):
    assert common_full_scale(np.array([0.0, peak]) for peak in peaks) == pytest.approx(scale)


def test_silence_has_no_scale():
    with pytest.raises(ValueError, match="got silence alone"):
        common_full_scale([np.zeros(4), np.zeros(2)])


def test_each_wave_has_its_gain():
    """Of odd and even lengths: the mean by the first gain, a wave of three periods by the fourth."""
    for points in (16, 15):
        wave = np.cos(2 * np.pi * 3 * np.arange(points) / points + 0.3)
        gain = 10.0 ** np.arange(points // 2 + 1)
        np.testing.assert_allclose(filtered(7.0 + wave, gain), 7.0 + 1000 * wave, rtol=1e-9)


def test_two_sounds_of_one_name_are_refused():
    tracks = tuple(
        Sound(name=name, label=label, column=name, says="") for name, label in zip("bmb", "123", strict=True)
    )
    with pytest.raises(ValueError, match=r"got twice: b$"):
        Sounds(table="t", rate=8000, full_scale=1.0, repeats=1, heard="", tracks=tracks)


def test_the_weighting_is_zero_at_one_kilohertz_to_what_two_decibels_are_rounded():
    """A wrong digit of a corner, as 739.7 for 737.9 Hz, is 0.01 dB there, and no table to a tenth shows it."""
    assert a_weighting(1e3) == pytest.approx(0.0, abs=1e-3)


def test_the_energies_of_levels_add_up():
    """Ten equal levels are 10 dB more, and one of nothing adds nothing."""
    assert energy_sum([60.0] * 10) == pytest.approx(70.0)
    assert energy_sum([60.0, -300.0]) == pytest.approx(60.0)
