"""Smooth series through values that scatter: straight lines stay, lone values lose their weight, slopes have errors."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation.railway.scenes import isotropic_line
from validation.railway.scenes.isotropic_line import FEWEST, graduated, scatter_of

LINE = 12.0 - 1.7 * np.arange(35)
EVEN = np.ones(35)


def slopes(values, reach):
    """From each value to the one later by `reach`, or to the last, by a loop."""
    last = len(values) - 1
    pairs = [(min(i, last - 1), min(min(i, last - 1) + reach, last)) for i in range(last + 1)]
    return np.array([(values[j] - values[i]) / (j - i) for i, j in pairs])


def test_a_straight_line_is_its_own_graduation():
    smooth = graduated(LINE, np.linspace(0.1, 5, 35), least=1e-3)
    np.testing.assert_allclose(smooth.values, LINE, atol=1e-8)
    np.testing.assert_allclose(smooth.hat @ LINE, LINE, atol=1e-8)
    assert smooth.scatter == 1e-3


@catches("lone values that keep their weight", first=10, count=3).at(
    "validation.railway.scenes.isotropic_line.LONE", 1e3
)
@pytest.mark.parametrize(("first", "count"), [(0, 1), (17, 1), (10, 3), (15, 4), (34, 1)])
def test_lone_values_lose_their_weight(first, count):
    series = LINE.copy()
    series[first : first + count] += 6.0
    np.testing.assert_allclose(graduated(series, EVEN, least=1.0).values, LINE, atol=1e-3)


@catches("values that stand out weighed by Huber's rule").at(
    "validation.railway.scenes.isotropic_line.REDESCENDING", -1
)
def test_a_value_weighs_by_tukeys_biweight_of_its_deviation():
    """The graduation solves its own normal equations, W (y - z) = 10 B' B z, w = w0 (1 - (deviation / 3 s)^2)^2."""
    rng = np.random.default_rng(2)
    series, weights = LINE + rng.standard_normal(35), rng.uniform(0.5, 2, 35)
    series[12] += 4.0
    smooth = graduated(series, weights, least=0.1)
    deviation = np.sqrt(weights) * (series - smooth.values) / smooth.scatter
    biweight = weights * np.clip(1 - (deviation / 3) ** 2, 0, None) ** 2
    bends = np.convolve(np.diff(smooth.values, 2), [1, -2, 1])
    np.testing.assert_allclose(biweight * (series - smooth.values), 10 * bends, atol=1e-5)
    assert np.abs(deviation).max() > 2 and (biweight < 0.5 * weights).sum() >= 2


@catches("one standard error of a slope").at("validation.railway.scenes.isotropic_line.Graduation.quantile", 1.0)
def test_errors_of_slopes_cover_those_of_a_line_with_known_scatter():
    """95 % of all slopes, within three standard errors of as many independent stretches of seven values."""
    rng, inside, widths = np.random.default_rng(4), [], []
    weights = np.linspace(0.5, 2.0, 35)
    for _ in range(60):
        smooth = graduated(LINE + 2.0 * rng.standard_normal(35) / np.sqrt(weights), weights, least=0.1)
        off = np.abs(slopes(smooth.values, 5) + 1.7)
        inside.append(np.mean(off <= smooth.slope_error(5)))
        widths.append(np.median(smooth.slope_error(5) / off))
    assert abs(np.mean(inside) - 0.95) <= 3 * math.sqrt(0.95 * 0.05 / (60 * 5))
    assert np.median(widths) < 6


def of_equal_weights(smooth):
    return replace(smooth, of_values=np.ones(len(smooth.values)))


slope_error = isotropic_line.Graduation.slope_error


@catches("slopes whose errors have equal weights").at(
    "validation.railway.scenes.isotropic_line.Graduation.slope_error",
    lambda smooth, reach: slope_error(of_equal_weights(smooth), reach),
)
def test_errors_of_slopes_are_those_of_series_that_scatter_by_their_weights():
    """Of ten thousand series through the same hat, drawn with a hundred times the variance at one end."""
    rng, weights = np.random.default_rng(7), np.geomspace(0.03, 3.0, 35)
    smooth = graduated(LINE, weights, least=1.0)
    drawn = (rng.standard_normal((10_000, 35)) / np.sqrt(weights)) @ smooth.hat.T
    spread = slopes(drawn.T, 5).std(axis=1)
    # a standard deviation of so many is known to 0.7 %
    np.testing.assert_allclose(smooth.slope_error(5) / (smooth.quantile * smooth.scatter), spread, rtol=0.03)
    assert spread[0] > 2 * spread[-6]


def test_few_values_are_left_as_they_are():
    for count in range(1, FEWEST):
        series = np.array([3.0, -1.0, 4.0, 1.0, 5.0])[:count]
        smooth = graduated(series, np.ones(count), least=1.0)
        assert smooth.values.tolist() == series.tolist() and smooth.scatter == 0.0
        assert not smooth.slope_error(5).any()


def test_scatter_is_that_of_second_differences():
    rng = np.random.default_rng(0)
    many = 0.7 * rng.standard_normal(20001) + np.linspace(0, 900, 20001)
    assert scatter_of(many) == pytest.approx(0.7, rel=0.02)
    assert scatter_of(LINE) < 1e-12 and scatter_of([1.0, 5.0]) == 0.0
    # to and fro by one: all second differences are four
    assert scatter_of([1.0, -1.0] * 8) == pytest.approx(4 / 0.6745 / math.sqrt(6), rel=1e-3)
