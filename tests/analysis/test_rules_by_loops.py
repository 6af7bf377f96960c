"""Regions of spectra, bands and weights, once more by loops over their lines; and their borders, one by one."""

import itertools
import math

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis import spectra, statistics
from validation.analysis import spectra as regions
from validation.analysis.spectra import Bands


def noise(seed, lines):
    return np.arange(1.0, lines + 1) * 0.5, np.random.default_rng(seed).exponential(1.0, lines)


# --- peak ---


def peak_by_loop(omega, hann, below):
    """The largest line below, if it is five times the median of those three to five away; by its neighbour."""
    lines = [i for i in range(len(omega)) if omega[i] < below]
    if not lines:
        return math.nan
    top = max(lines, key=lambda i: hann[i])
    beside = [hann[i] for i in range(len(omega)) if top - 6 <= i < top - 3 or top + 3 <= i < top + 6]
    if hann[top] < 5 * np.median(beside):
        return math.nan
    side = 1 if top == 0 or hann[top + 1] > hann[top - 1] else -1
    r = math.sqrt(hann[top + side] / hann[top])
    return (top + 1 + side * (2 * r - 1) / (r + 1)) * omega[0]


@pytest.mark.parametrize("top", [0, 1, 2, 3, 4, 5, 6, 7, 20])
@pytest.mark.parametrize("larger", ["before", "behind"])
def test_peak_by_a_loop(top, larger):
    """A line four to seven times the others, wherever it stands; lines at its sides, one larger; a large one above."""
    for seed in range(12):
        omega, hann = noise(seed, 60)
        hann[top] = hann[:40].max() + (0.5 + 0.5 * seed) * np.median(hann)
        for side, part in ((1, 0.6), (-1, 0.3)) if larger == "behind" else ((1, 0.3), (-1, 0.6)):
            if top + side >= 0:
                hann[top + side] = part * hann[top]
        hann[50] = 100.0
        # of many lines, of the first alone, and of none
        for below in (20.0, 1.5 * omega[0], omega[0], 0.1):
            found, expected = regions.peak(omega, hann, below), peak_by_loop(omega, hann, below)
            assert found == pytest.approx(expected, rel=1e-12, nan_ok=True)


def test_a_peak_five_times_what_lies_beside_it_stands_out():
    hann = np.ones(30)
    hann[12], hann[11] = 5.0, 1.25
    omega = np.arange(1.0, 31)
    assert regions.peak(omega, hann, 30.0) == pytest.approx(13.0)
    hann[12] = 4.999
    assert math.isnan(regions.peak(omega, hann, 30.0))


# --- jump ---


def jump_by_loop(omega, density, above, upto):
    """Twelfths of an octave, each of a line or more; the steepest over two of them; half of the level behind."""
    borders = []
    for i in range(math.ceil(12 * math.log2(upto / above) - 1e-12)):
        border = next(j for j in range(len(omega)) if omega[j] >= above * 2 ** (i / 12))
        if not borders or border > borders[-1]:
            borders.append(border)
    means = [density[a:b].mean() for a, b in itertools.pairwise(borders)]
    i = max(range(len(means) - 2), key=lambda i: means[i + 2] / means[i])
    level = means[i + 2] / 2
    j = next(j for j in range(borders[i], borders[i + 3]) if density[j] > level)
    part = math.log(level / density[j - 1]) / math.log(density[j] / density[j - 1])
    return (j + part) * omega[0]


@pytest.mark.parametrize("edge", [20.0, 31.0, 55.0, 90.0])
def test_jump_by_a_loop(edge):
    """Noise of little scatter that rises by a factor 50 over a tenth of its frequency."""
    for seed in range(8):
        omega = np.arange(1.0, 401) * 0.5
        rise = 1 / (1 + np.exp(-(omega - edge) / (0.02 * edge)))
        density = (0.02 + rise) * np.random.default_rng(seed).uniform(0.9, 1.1, 400)
        found = regions.jump(omega, density, edge / 3.1, 1.9 * edge)
        assert found == pytest.approx(jump_by_loop(omega, density, edge / 3.1, 1.9 * edge), rel=1e-12)
        assert found == pytest.approx(edge, rel=0.1)


# --- levels ---


def levelled_by_loop(omega, density, first, last, period, exponent):
    centres, means = [], []
    for i in range(math.floor((last - first) / period + 1e-9)):
        low, high = first + i * period, first + (i + 1) * period
        inside = [j for j in range(len(omega)) if low <= omega[j] < high]
        centres.append((omega[inside[0]] + omega[inside[-1]]) / 2)
        means.append(np.mean([density[j] * omega[j] ** -exponent for j in inside]))
    return np.array(centres), np.array(means)


@pytest.mark.parametrize(("first", "last", "period"), [(10.0, 20.0, 2.5), (10.2, 20.0, 2.5), (5.0, 30.0, 4.0)])
def test_levels_by_a_loop(first, last, period):
    """The last band may end just where the range does; and at the last line."""
    omega, density = noise(1, 60)
    for exponent in (0.0, -2.4):
        found = regions.compensated_band_means(omega, density, first, last, period, exponent)
        expected = levelled_by_loop(omega, density, first, last, period, exponent)
        np.testing.assert_allclose(found, expected, rtol=1e-12)
    power = regions.power_level(omega, density, first, last, period, -2.4)
    assert power == pytest.approx(math.exp(np.mean(np.log(expected[1]))))


def test_the_floor_is_taken_over_all_lines_of_its_range():
    """Both ends belong to it."""
    omega, density = noise(2, 60)
    inside = [j for j in range(60) if 8.0 <= omega[j] <= 21.0]
    assert omega[inside[0]] == 8.0 and omega[inside[-1]] == 21.0
    expected = np.mean([density[j] * (2 / 0.03 * math.sin(omega[j] * 0.015)) ** 2 for j in inside])
    assert regions.floor_level(omega, density, 8.0, 21.0, 0.03) == pytest.approx(expected)


# --- oscillation ---


def oscillating(lines, turns):
    """A sine of so many turns over the lines, about a power law, and a little noise."""
    omega = np.arange(1.0, 1 + lines)
    law = omega**-2.0 * np.exp(0.5 * np.cos(2 * np.pi * turns * np.arange(lines) / lines))
    return omega, law * np.exp(1e-3 * np.random.default_rng(0).standard_normal(lines))


@pytest.mark.parametrize(("lines", "finite"), [(12, False), (15, False), (96, True)])
def test_a_range_of_too_few_lines_has_no_period(lines, finite):
    """Four lines to a turn, and more turns than the fewest: 15 lines have three."""
    omega, density = oscillating(lines, 8.0 if finite else 3.0)
    assert math.isfinite(regions.oscillation_period(omega, density, 1.0, float(lines), 3)) == finite


def test_fewer_turns_than_the_fewest_are_what_is_left_of_the_slope():
    omega, density = oscillating(200, 4.0)
    assert regions.oscillation_period(omega, density, 1.0, 200.0, 3) == pytest.approx(50, rel=0.02)
    assert regions.oscillation_period(omega, density, 1.0, 200.0, 8) != pytest.approx(50, rel=0.1)


@pytest.mark.parametrize(("above", "finite"), [(36.0, False), (44.0, True)])
def test_a_line_forty_times_the_median_is_no_noise(above, finite, monkeypatch):
    """The transform itself is made up: one line so many times as large as all others."""
    lines = np.ones(101)
    lines[10], lines[11] = math.sqrt(above), 1.1
    monkeypatch.setattr(regions.np.fft, "rfft", lambda _: lines)
    found = regions.oscillation_period(np.arange(1.0, 201), np.ones(200), 1.0, 200.0, 3)
    assert math.isfinite(found) == finite


# --- bands ---


def both_edges(bands, q, values):
    inside = (q[:, np.newaxis] >= bands.edges[:-1]) & (q[:, np.newaxis] <= bands.edges[1:])
    return values @ inside.astype(complex)


@catches("a line at the upper edge of a band counted in it").at("validation.analysis.spectra.Bands.sums", both_edges)
def test_a_band_holds_its_lower_edge_and_not_its_upper():
    bands = Bands((1.0, 2.0, 4.0))
    q, values = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0]), np.array([1.0, 2, 4, 8, 16, 32, 64])
    assert bands.sums(q, values).tolist() == [6, 24]
    assert bands.counts(q).tolist() == [2, 2]
    np.testing.assert_allclose(bands.centres, [math.sqrt(2), math.sqrt(8)])


@pytest.mark.parametrize(("length", "fits"), [(1.0, True), (0.5, False), (0.25, False), (1.7, True)])
def test_a_track_has_a_wave_in_each_band_or_is_refused(length, fits):
    """Waves 2 pi m / L: of length 1 the first is just the lower edge of the first band."""
    bands = Bands(tuple(2 * math.pi * np.array([1.0, 1.9, 2.7])))
    if fits:
        assert bands.on(length) is bands
    else:
        with pytest.raises(ValueError, match=f"length must be so large that each band has a wave, got {length:g}"):
            bands.on(length)


@pytest.mark.parametrize(
    ("first", "last", "low", "high"), [(1.0, 8.0, 1, 8), (0.999, 8.001, 1, 8), (1.001, 7.99, 2, 7)]
)
def test_bands_around_a_centre_lie_between_their_ends(first, last, low, high):
    """A centre so that edges lie at 2^(i/3): those that touch the ends belong to it."""
    found = Bands.around(2 ** (1 / 6), first, last)
    edges = 2 ** (np.arange(10) / 3)
    expected = edges[(edges >= first * (1 - 1e-9)) & (edges <= last * (1 + 1e-9))]
    np.testing.assert_allclose(found.edges, expected)
    assert len(expected) == (10 if high == 8 else 8)


@pytest.mark.parametrize("points", [8, 9])
def test_waves_by_a_loop(points):
    """Those above zero and below the last of an even number; over the first of them, the density."""
    x = np.random.default_rng(points).standard_normal((2, points))
    found = spectra.waves(x, spacing=0.25)
    assert found.q.size == (points - 1) // 2
    for m, q in enumerate(found.q, 1):
        assert q == pytest.approx(2 * math.pi * m / (points * 0.25))
        c = (x * np.exp(-2j * math.pi * m * np.arange(points) / points)).sum(axis=1) / points
        np.testing.assert_allclose(found.amplitude[:, m - 1], c, atol=1e-14)
        np.testing.assert_allclose(found.spectrum[:, m - 1], np.abs(c) ** 2 / found.q[0])
    bands = Bands((found.q[0], found.q[2], 99.0))
    power = np.abs(found.amplitude) ** 2
    np.testing.assert_allclose(spectra.levels(found, bands).T, [power[:, :2].sum(axis=1), power[:, 2:].sum(axis=1)])


# --- statistics ---


def test_the_nearest_force_is_that_of_the_least_ratio():
    assert statistics.nearest((1.0, 10.0, 100.0), 3.0) == 0
    assert statistics.nearest((1.0, 10.0, 100.0), 3.3) == 1
    assert statistics.nearest((1.0, 10.0, 100.0), 40.0) == 2
