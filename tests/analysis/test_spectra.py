"""Spectra of records and their bands against slow sums; the regions of a spectrum found again in synthetic ones."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.seeded import catches
from validation.analysis import spectra
from validation.analysis import spectra as regions

WINDOWS = ("none", "hann")
ROUNDING = 1e-12


def hann(steps):
    return (1 - np.cos(2 * np.pi * np.arange(steps) / steps)) / 2


def by_slow_sums(x, time_step, window):
    """|sum_n w_n x_n exp(-2 pi i j n / N)|^2 dt^2 / T over the mean of w^2, of j = 0, ..., N/2."""
    steps = len(x)
    n = np.arange(steps)
    w = hann(steps) if window == "hann" else np.ones(steps)
    waves = np.exp(-2j * np.pi * np.outer(np.arange(steps // 2 + 1), n) / steps)
    return np.abs(waves @ (w[:, np.newaxis] * x)) ** 2 * time_step**2 / (steps * time_step) / np.mean(w**2)


# --- (14.17) ----------------------------------------------------------------------------------------------------------


def weighed(factor):
    """(14.17) with a factor, of time step and window."""

    def wrong(series, *, time_step, window="none"):
        record = spectra_of_records(series, time_step=time_step, window=window)
        return replace(record, density=factor(time_step, window) * record.density)

    return wrong


spectra_of_records = spectra.record_spectra


@catches("dt for dt^2 in (14.17)", steps=31, window="none").at(
    "validation.analysis.spectra.record_spectra", weighed(lambda time_step, _: 1 / time_step)
)
@catches("one-sided spectrum of a record", steps=31, window="none").at(
    "validation.analysis.spectra.record_spectra", weighed(lambda *_: 2)
)
@catches("Hann without its mean square", steps=31, window="hann").at(
    "validation.analysis.spectra.record_spectra", weighed(lambda _, window: 3 / 8 if window == "hann" else 1)
)
@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("steps", [3, 8, 31, 32])
def test_spectra_by_slow_sums(steps, window):
    x, time_step = np.random.default_rng(steps).normal(size=(steps, 3)), 0.07
    record = spectra.record_spectra(x, time_step=time_step, window=window)
    slow = by_slow_sums(x, time_step, window)
    assert record.density == pytest.approx(slow[1:], abs=steps * ROUNDING * slow.max())
    assert record.omega == pytest.approx(2 * np.pi * np.arange(1, steps // 2 + 1) / (steps * time_step), rel=ROUNDING)


# --- bands ------------------------------------------------------------------------------------------------------------


@given(
    lines=st.integers(1, 40),
    records_=st.integers(0, 2),
    edges=st.lists(st.floats(0, 50), min_size=2, max_size=8).map(sorted),
    line=st.floats(0.01, 100),
)
def test_bands_by_a_loop(lines, records_, edges, line):
    """Half-open bands; sums of positive values, off by the rounding of the sum of all; NaN without any line."""
    omega = line * np.arange(1, lines + 1)
    density = np.random.default_rng(lines).exponential(size=(lines, records_) if records_ else lines)
    edges = line * np.array(edges)
    levels, means = (f(omega, density, edges) for f in (spectra.band_levels, spectra.band_means))
    assert levels.shape == means.shape == (len(edges) - 1, *density.shape[1:])
    for i in range(len(edges) - 1):
        inside = [j for j in range(lines) if edges[i] <= omega[j] < edges[i + 1]]
        if not inside:
            assert np.isnan(levels[i]).all()
            assert np.isnan(means[i]).all()
            continue
        total = sum(density[j] for j in inside)
        room = lines * ROUNDING * density.sum()
        assert levels[i] == pytest.approx(total * line / (2 * np.pi), abs=room * line)
        assert means[i] == pytest.approx(total / len(inside), abs=room)


@given(first=st.floats(1, 1e5), octaves=st.floats(0.7, 8))
def test_one_third_octaves_are_those_about_a_thousand_hertz(first, octaves):
    last = first * 2**octaves
    edges, step = spectra.one_third_octaves(first, last), 2 ** (1 / 3)
    assert edges[1:] / edges[:-1] == pytest.approx(np.full(edges.size - 1, step), rel=ROUNDING)
    numbers = 3 * np.log2(edges / (2 * np.pi * 1000)) + 0.5
    assert numbers == pytest.approx(np.rint(numbers), abs=1e-9)
    assert edges[0] >= first * (1 - 1e-9)
    assert edges[-1] <= last * (1 + 1e-9)
    # no other band fits
    assert edges[0] / step < first
    assert edges[-1] * step > last


# --- peak -------------------------------------------------------------------------------------------------------------


def hann_of_a_tone(place, phase, steps=4096, amplitude=1.0):
    x = amplitude * np.cos(2 * np.pi * place * np.arange(steps) / steps + phase)
    return spectra.record_spectra(x[:, np.newaxis], time_step=1.0, window="hann")


def leak(distance):
    """Of Hann's window, sin(pi d) / (pi d (1 - d^2)), over the main line of a tone midway, 8 / (3 pi)."""
    return 1 / (np.pi * distance * (distance**2 - 1)) * 3 * np.pi / 8


peak = spectra.peak


@catches("half a line on in the peak", place=30.5).at(
    "validation.analysis.spectra.peak", lambda omega, hann, below: peak(omega, hann, below) + omega[0] / 2
)
@pytest.mark.parametrize("place", [8.0, 8.2, 8.499, 8.501, 8.77, 30.5, 31.0, 200.35])
def test_peak_of_a_tone_between_lines(place):
    """Off by the mirror image, twice its frequency away: it changes r by up to 2 leaks of r, and e by 3 r / (r + 1)^2
    <= 3/4 of that; and by sines of pi d / N for their arguments, d <= 2."""
    for phase in np.linspace(0, 2 * np.pi, 7):
        record = hann_of_a_tone(place, phase)
        line = record.omega[0]
        error = 1.5 * leak(2 * place - 1.5) + (2 * np.pi / 4096) ** 2
        assert error < 1e-3
        assert regions.peak(record.omega, record.density[:, 0], 1.5) / line == pytest.approx(place, abs=error)


# --- jump -------------------------------------------------------------------------------------------------------------


def smoothed_step(edge, exponent, lines):
    """What Hann's window makes in the mean of omega^exponent above an edge, in lines, and nothing below."""
    fine = edge + (np.arange(20 * lines) + 0.5) / 20
    law = (fine / edge) ** exponent
    d = np.arange(1, lines + 1)[:, np.newaxis] - fine
    with np.errstate(divide="ignore", invalid="ignore"):
        kernel = np.where(np.abs(np.abs(d) - 1) < 1e-9, 0.25, (np.sinc(d) / (1 - d**2)) ** 2)
    return kernel @ law / 20 / 1.5


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [0.0, -2.4, -4.4])
@pytest.mark.parametrize("edge", [60.0, 60.3, 75.5, 90.8])
def test_jump_of_a_power_law_with_its_edge_between_lines(edge, exponent):
    """Half of a line, above a plateau 30 dB lower: a symmetric window has half of a flat level at the edge itself; the
    level three bands behind is lower by at most 2^(exponent / 4), 2.2, which the main lobe, 1.5 lines wide in power,
    has half a line earlier."""
    omega = np.arange(1.0, 401)
    density = smoothed_step(edge, exponent, 400)
    assert regions.jump(omega, density + 1e-3, edge / 3, edge * 3) == pytest.approx(edge, abs=0.5)
    # above nothing, a band on the flank of the lobe may rise more than that behind it: somewhere in the main lobe
    assert regions.jump(omega, density, edge / 3, edge * 3) == pytest.approx(edge, abs=2)


# --- region 3 ---------------------------------------------------------------------------------------------------------

PERIOD, LINE = 1.0, 1 / 150.37
FIRST, LAST = 0.62, 12.3


def law(exponent, period=PERIOD, last=14.0):
    """omega, and omega^exponent sin^2(pi omega / period)."""
    omega = LINE * np.arange(1, round(last / LINE))
    return omega, omega**exponent * np.sin(np.pi * omega / period) ** 2


def lever():
    """How much a fit of a slope makes of errors of its values: sum |x| / sum x^2."""
    omega, density = law(0.0)
    x = np.log(regions.compensated_band_means(omega, density, FIRST, LAST, PERIOD, 0.0)[0])
    x -= x.mean()
    return float(np.abs(x).sum() / (x**2).sum())


def slope_of_what_is_steep(omega, density, first, last, period):
    centres, means = spectra.compensated_band_means(omega, density, first, last, period, 0.0)
    return float(np.polyfit(np.log(centres), np.log(means), 1)[0])


@catches("slope of bands that are not levelled", hurst=0.7).at(
    "validation.analysis.spectra.slope", slope_of_what_is_steep
)
@pytest.mark.parametrize("hurst", [0.1, 0.4, 0.7, 1.0])
def test_slope_under_an_oscillation(hurst):
    """A band may have a line more or less than a period: its mean is off by as much as one line has of all of them."""
    omega, density = law(-2 * hurst - 3)
    room = lever() * LINE / PERIOD
    assert room < 0.01
    assert regions.slope(omega, density, FIRST, LAST, PERIOD) == pytest.approx(-2 * hurst - 3, abs=room)


@given(exponent=st.floats(-6, -2.5))
def test_slope_of_a_pure_power_law_is_exact(exponent):
    omega = LINE * np.arange(1, 2000)
    # flat where it is not looked at: sums over bands are differences of sums from the first line
    assert regions.slope(omega, np.maximum(omega, FIRST) ** exponent, FIRST, LAST, PERIOD) == pytest.approx(
        exponent, abs=1e-9
    )


@pytest.mark.parametrize("hurst", [0.4, 0.7, 1.0])
@pytest.mark.parametrize("period", [0.61, 1.0, 1.37])
def test_period_of_an_oscillation(hurst, period):
    """Off by harmonics: the second, half as large, is as many lines away as there are turns, and the mirror image twice
    as many; and by those harmonics which the lines see as the first, 1 / k of it, k + 1 and k - 1 lines to a period."""
    omega, density = law(-2 * hurst - 3, period)
    found = regions.oscillation_period(omega, density, FIRST, LAST, 3)
    turns = (LAST - FIRST) / period
    error = 1.5 * (0.5 * leak(turns - 1.5) + leak(2 * turns - 1.5) + 2 * LINE / period)
    assert error < 0.03 * turns
    assert turns * period / found == pytest.approx(turns, abs=error + 2 * LINE / period)


def test_noise_has_no_period():
    """Of forty spectra of one record each, whose lines are exponential; a thousand lines exceed 40 medians once in
    1e9 of them. The same noise under an oscillation hides it not."""
    rng, (omega, density) = np.random.default_rng(0), law(-4.4)
    for _ in range(40):
        noise = rng.exponential(size=omega.size)
        assert math.isnan(regions.oscillation_period(omega, omega**-4.4 * noise, FIRST, LAST, 3))
        assert regions.oscillation_period(omega, density * noise, FIRST, LAST, 3) == pytest.approx(PERIOD, rel=0.01)


@given(where=st.floats(1e-3, 1e6), exponent=st.floats(-6, -2.5), floor=st.floats(1e-9, 1e9))
def test_crossing_is_where_both_are_equal(where, exponent, floor):
    power = floor * where ** (-2 - exponent)
    found = regions.crossing(power, exponent, floor)
    assert found == pytest.approx(where, rel=1e-9)
    assert power * found**exponent == pytest.approx(floor * found**-2, rel=1e-9, abs=0)
