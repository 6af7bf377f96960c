"""Bursts of noise, hidden steps and wide pits of measured lines: named, and what they change is in the error."""

import math

import numpy as np
import pytest

from tests.railway.test_line_outliers import POINTS, UM, X, fractal, levels, lines, rail
from tests.seeded import catches
from validation.analysis.spectra import NominalBands
from validation.railway.scenes import line_edits, line_steps
from validation.railway.scenes.line_edits import EditedLine, bursts_of, edited, left_by_bursts
from validation.railway.scenes.line_steps import Outlier

FIRST, LAST = 3000, 4500
"""Points of a burst, an eighth of a line."""


def noise(colour, seed):
    """Of rms 1, white, or blue, or with waves about 8 mm long alone."""
    rng = np.random.default_rng(seed)
    white = rng.standard_normal(LAST - FIRST + 1)
    if colour == "white":
        return white[1:]
    if colour == "blue":
        return np.diff(white) / math.sqrt(2)
    k = np.fft.rfftfreq(LAST - FIRST, 1e-3)
    ground = np.fft.irfft(np.fft.rfft(white[1:]) * np.exp(-((np.log(np.maximum(k, 1) * 8e-3) / 0.6) ** 2)))
    return ground / ground.std()


def noisy(colour, rms, seed, line=None):
    height = rail(seed) if line is None else line.copy()
    height[FIRST:LAST] += rms * noise(colour, seed + 100)
    return height


def kinds(line, spacing=1e-3):
    return [outlier.kind for outlier in EditedLine.of(UM * line, spacing).outliers]


def the_burst(height):
    bursts = EditedLine.of(height, 1e-3).of_kind("burst")
    assert len(bursts) == 1
    return bursts[0]


BURSTS = [(colour, rms) for colour in ("white", "blue", "ground") for rms in (1.0, 5.0, 60.0)]


right_bursts_of = line_edits.bursts_of


def where_it_is_raised(line, measured, spacing, sensor):
    return right_bursts_of(line, line, spacing, sensor)


@catches("bursts of noise that nobody finds", colour="white", rms=5.0).at(
    "validation.railway.scenes.line_edits.bursts_of", lambda *_: ()
)
@catches("no error of a burst that is named", colour="ground", rms=5.0).at(
    "validation.railway.scenes.line_edits.EditedLine.of_bursts", lambda line, bands: np.zeros(len(bands))
)
@catches("a burst all of whose points are spikes", colour="white", rms=60.0).at(
    "validation.railway.scenes.line_edits.bursts_of", where_it_is_raised
)
@pytest.mark.parametrize(("colour", "rms"), BURSTS)
def test_a_burst_is_named_where_it_is_and_is_in_the_error(colour, rms):
    for seed in (21, 22):
        height = UM * noisy(colour, rms, seed)
        measured = lines(height)
        burst = the_burst(height)
        # windows are a twentieth of the line
        assert abs(burst.first - FIRST) < 620 and abs(burst.last - LAST) < 620
        assert burst.size == pytest.approx(UM * rms, rel=0.5)
        off = np.array(measured.levels.levels) - levels(UM * rail(seed))
        errors = np.array(measured.levels.errors)
        assert off.max() > 3
        assert np.mean(np.abs(off) <= errors + 0.01) >= 0.95 and np.max(np.abs(off) - errors) < 1
        # it says how much, and not that nothing is known: long waves are known
        assert rms > 10 or np.median(errors[:6]) < 2


@pytest.mark.parametrize("base", ["fractal", "corrugated"])
def test_a_burst_on_other_lines_is_named(base):
    line = fractal(0.7, 4) if base == "fractal" else rail(4) + 15.0 * np.sin(2 * np.pi * X / 0.05)
    assert "burst" in kinds(noisy("white", 5.0, 4, line))


@catches("long windows alone").at("validation.railway.scenes.line_edits.PARTS", (20,))
def test_a_burst_over_an_eightieth_of_a_line_is_named():
    line = rail(6)
    line[7000:7150] += 1.5 * np.random.default_rng(6).standard_normal(150)
    burst = the_burst(UM * line)
    assert burst.first <= 7025 and burst.last >= 7125


def test_spikes_of_a_burst_are_part_of_it_and_others_are_not():
    line = noisy("white", 60.0, 21)
    line[9000] += 80.0
    edited_line = EditedLine.of(UM * line, 1e-3)
    assert [outlier.kind for outlier in edited_line.outliers] == ["burst", "spike"] and edited_line.outliers[
        1
    ].first == 9000
    assert (edited_line.clean[FIRST:LAST] == UM * line[FIRST:LAST]).all()


def parts(seed, factor):
    """Roughness that is rougher by a factor in a quarter of the line, beyond ends of 0.2 m."""
    return rail(seed) * (1 + (factor - 1) / (1 + np.exp((abs(X - 5.0) - 1.5) / 0.1)))


@catches("no part of a line may be rougher than the others", factor=2.0).at(
    "validation.railway.scenes.line_edits.NATURAL", 1.0
)
@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_a_part_that_is_twice_as_rough_is_no_burst(factor):
    for seed in range(3):
        assert kinds(parts(seed, factor)) == []


def test_a_part_that_is_four_times_as_rough_is():
    assert "burst" in kinds(parts(21, 4.0))


@catches("a corrugation taken for a burst").at("validation.railway.scenes.line_edits.NEIGHBOURS", 1)
def test_a_corrugation_of_a_part_is_no_burst():
    """Of 20 dB, in a third octave and its neighbours."""
    for seed, wavelength in enumerate((0.02, 0.03, 0.05, 0.08)):
        line = rail(seed)
        k = np.fft.rfftfreq(POINTS, 1e-3)
        gain = 1 + 9 * np.exp(-((np.log(np.maximum(k, 1e-3) * wavelength) / 0.2) ** 2))
        raised = np.fft.irfft(np.fft.rfft(line) * gain, POINTS)
        assert kinds(line + (raised - line) / (1 + np.exp((abs(X - 5.0) - 1.0) / 0.1))) == []


@catches("bands compared as if they had no scatter", spacing=2e-3).at(
    "validation.railway.scenes.line_edits.Windows._over",
    lambda windows, p: windows.powers > np.median(windows.powers, axis=0),
)
@pytest.mark.parametrize("spacing", [0.5e-3, 1e-3, 2e-3])
def test_right_lines_of_any_length_have_no_burst(spacing):
    """Of chi^2 statistics alone: white noise, and a self-affine line, of 2 to 50 m."""
    for length in (2, 5, 20, 50):
        points = round(length / spacing)
        white = np.random.default_rng(points).standard_normal(points)
        walk = np.fft.irfft(np.fft.rfft(white) / np.maximum(np.arange(points // 2 + 1), 5.0) ** 1.1, points)
        for line in (white, walk / walk.std()):
            assert bursts_of(UM * line, UM * line, spacing, 0.0) == ()


@catches("what a burst adds over all windows, and not over those without it").at(
    "validation.railway.scenes.line_edits.Windows.touched", lambda windows, bursts: np.arange(windows.starts.size) < 1
)
def test_what_a_burst_adds_is_that_of_its_part_of_a_white_line():
    """sin^4 of the place is the weight of a point in a spectrum through Hann's window; its mean is 3/8."""
    rng = np.random.default_rng(8)
    line = rng.standard_normal(40000)
    line[10000:14000] *= 5.0
    at = (np.arange(40000) + 0.5) / 40000
    expected = 24 * np.sum(np.sin(np.pi * at[10000:14000]) ** 4) / (0.375 * 40000)
    bands = NominalBands().within(0.05, 0.0025)
    added, half_width = left_by_bursts(line, 1e-3, (Outlier("burst", 10000, 13999, 1.0),), bands)
    assert added == pytest.approx(np.full(len(bands), expected), rel=0.4)
    assert added.mean() == pytest.approx(expected, rel=0.15)
    # of independent waves beside their mean in both: 4 sqrt(2 / nu) of this band of the line at the most
    assert (half_width > 0).all() and half_width[-1] < 0.6


@catches("a line of which half is a burst").at("validation.railway.scenes.line_edits.MOST_OF_LINE", 1.0)
def test_a_line_with_a_burst_over_more_than_a_third_has_no_error():
    line = rail(21)
    line[2000:6500] += 5.0 * np.random.default_rng(1).standard_normal(4500)
    measured = lines(UM * line)
    assert set(measured.levels.errors) == {math.inf} and "noisy in" in measured.levels.fault


def test_a_note_on_a_burst_has_its_size_length_and_place_and_says_what_to_do():
    edits = edited(UM * noisy("white", 5.0, 21)[:, np.newaxis], 1e-3)
    (note,) = edits.notes([0.0])
    assert note.startswith("the line has 1 burst of noise of ") and "rms in short waves, up to " in note
    assert " long, at 2" in note and "measure it again, or cut it out" in note


def test_a_burst_that_is_kept_is_in_the_error_as_one_that_is_not():
    height = UM * noisy("white", 5.0, 21)
    assert lines(height, "keep").levels.errors == pytest.approx(lines(height).levels.errors)


# Steps and pits that roughness hides


@catches("steps that corrugation hides", flank=14).at(
    "validation.railway.scenes.line_steps._hidden_step", lambda *_: None
)
@pytest.mark.parametrize("flank", [8, 10, 14])
def test_a_step_with_a_flank_in_a_corrugated_line_is_named(flank):
    for seed in (1, 2, 3):
        clean = rail(seed) + 20.0 * np.sin(2 * np.pi * X / 0.06 + seed)
        line = clean + 150.0 * np.interp(np.arange(POINTS), [6000, 6000 + flank], [0.0, 1.0])
        measured = lines(UM * line)
        steps = EditedLine.of(UM * line, 1e-3).of_kind("step")
        assert steps
        assert min(step.first for step in steps) <= 6000 + flank // 2 <= max(step.last for step in steps)
        assert all(5970 < step.first < step.last < 6050 for step in steps)
        assert sum(step.size for step in steps) == pytest.approx(150e-6, rel=0.2)
        off = np.abs(np.array(measured.levels.levels) - levels(UM * clean))
        assert np.max(off - np.array(measured.levels.errors)) < 0.5


@catches("pits wider than 0.1 m that are not seen", wide=180).at(
    "validation.railway.scenes.line_steps.DISTANCES", line_steps.DISTANCES[:10]
)
@pytest.mark.parametrize("wide", [50, 100, 180])
def test_wide_shallow_pits_are_named(wide):
    for seed in (1, 2, 3):
        clean = rail(seed)
        line = clean.copy()
        for middle in (2000, 5000, 9000):
            line[middle - wide // 2 : middle - wide // 2 + wide] -= 50.0 * np.hanning(wide)
        measured = lines(UM * line)
        assert kinds(line) == ["pit"] * 3
        off = np.abs(np.array(measured.levels.levels) - levels(UM * clean))
        assert np.max(off - np.array(measured.levels.errors)) < 0.5
