"""Multilevel estimates on populations whose answer is known: no bias, and intervals that hold as often as they say."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from tests.analysis.intervals import covered, ends, holds
from tests.seeded import catches, module_with
from validation.analysis import statistics
from validation.analysis.statistics import Linearised, log, moments, multilevel_moments, weighted_sum

SPREAD = 0.25
MEAN = math.exp(SPREAD**2 / 2)
RELATIVE = math.sqrt(math.expm1(SPREAD**2))
"""Of the logarithmic normal distribution exp(0.25 z), like the stiffness of a rough punch under a light force."""


def population(rng, sizes, correlations, coarse=0.1):
    """Nested realisations, coarse to fine: exp(s z) on the finest grid; coarser ones are correlated and off by 10 %."""
    z = rng.standard_normal(sizes[0])
    grids = [np.exp(SPREAD * z)]
    for correlation in correlations:
        z = correlation * z + math.sqrt(1 - correlation**2) * rng.standard_normal(sizes[0])
        grids.insert(0, np.exp((1 + coarse) * SPREAD * z + coarse))
    for grid, size in zip(grids, sizes, strict=True):
        grid[size:] = np.nan
    return grids


def finest(rng, sizes, correlations):
    return multilevel_moments(population(rng, sizes, correlations))[-1]


@catches("the quantile of 90 % for that of 95", sizes=(300, 60), correlations=(0.95,), at_least=0.93).at(
    "validation.analysis.statistics.student", lambda freedom, confidence=0.95: 1.6
)
@pytest.mark.parametrize(
    ("sizes", "correlations", "at_least"),
    [
        ((30,), (), 0.9),
        ((400,), (), 0.93),
        ((300, 60), (0.95,), 0.93),
        ((1500, 300, 60), (0.99, 0.95), 0.93),
        ((200, 100, 50), (0.5, 0.2), 0.93),
    ],
)
def test_intervals_hold_as_often_as_they_say(sizes, correlations, at_least):
    """95 %, within the noise of 400 trials, of the mean and of the deviation; a plain sample of 30 is too small."""
    rng = np.random.default_rng(1)
    trials = [finest(rng, sizes, correlations) for _ in range(400)]
    for found, true in (
        ([trial.log_mean for trial in trials], math.log(MEAN)),
        ([trial.log_relative_deviation for trial in trials], math.log(RELATIVE)),
    ):
        known = [x for x in found if math.isfinite(x.value)]
        assert len(known) >= 0.98 * len(found)
        held = np.mean([abs(x.value - true) < x.half_width for x in known])
        assert at_least <= held <= 0.98, (held, len(known))
        assert np.median([x.error for x in known]) == pytest.approx(np.std([x.value for x in known]), rel=0.3)


moments_with_step = statistics.Moments.with_step


def with_n(values, used):
    """Variances of samples that are too small by 1 / n."""
    found = multilevel_moments_of(values, used)
    return replace(found, variance=(1 - 1 / used.sum()) * found.variance)


multilevel_moments_of = statistics.moments


@catches("steps between grids taken the wrong way", sizes=(8, 4), correlations=(0.9,)).at(
    "validation.analysis.statistics.Moments.with_step", lambda mine, fine, coarse: moments_with_step(mine, coarse, fine)
)
@catches("variances with n", sizes=(8, 4), correlations=(0.9,)).at("validation.analysis.statistics.moments", with_n)
@pytest.mark.slow
@pytest.mark.parametrize(("sizes", "correlations"), [((8, 4), (0.9,)), ((20, 10, 5), (0.5, 0.2))])
def test_mean_and_variance_have_no_bias(sizes, correlations):
    """However few realisations, and however little the grids have in common: within 3.5 standard errors."""
    rng = np.random.default_rng(3)
    trials = [finest(rng, sizes, correlations) for _ in range(4000)]
    for found, true in (
        ([t.mean.value for t in trials], MEAN),
        ([t.variance.value for t in trials], (MEAN * RELATIVE) ** 2),
    ):
        assert abs(np.mean(found) - true) < 3.5 * np.std(found) / math.sqrt(len(found))


def test_one_grid_is_plain_sampling():
    values = np.random.default_rng(6).standard_normal(50) + 5
    (found,) = multilevel_moments([values])
    assert found.mean.value == pytest.approx(values.mean())
    assert found.variance.value == pytest.approx(values.var(ddof=1))
    assert found.mean.error == pytest.approx(values.std(ddof=1) / math.sqrt(50))


def test_what_is_lost_on_one_grid_counts_in_no_step():
    """A realisation without a coarse value is no part of the step; the others give it."""
    coarse, fine = np.array([1.0, 2.0, 4.0, np.nan, 3.0]), np.array([1.5, 2.5, 4.5, 9.0, np.nan])
    assert multilevel_moments([coarse, fine])[-1].mean.value == pytest.approx(2.5 + 0.5)


def shuffled(other):
    """The same error, of other realisations."""
    return replace(other, influence=other.influence[::-1])


@catches("the covariance of two grids lost").at(
    "validation.analysis.statistics.Linearised.__sub__", lambda mine, other: mine + -1.0 * shuffled(other)
)
def test_values_from_the_same_realisations_share_their_errors():
    rng = np.random.default_rng(7)
    x = multilevel_moments([rng.standard_normal(100) + 3])[0].mean
    assert (x - x).error == 0
    assert (x + x).error == pytest.approx(2 * x.error)
    assert x.minus_independent(x).error == pytest.approx(math.sqrt(2) * x.error)
    assert weighted_sum([0.25, 0.75], [x, x]).error == pytest.approx(x.error)
    assert x.minus_independent(2.0 * x).value == pytest.approx(-x.value)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_degrees_of_freedom_are_twice_the_square_of_the_mean_square_over_its_variance(scale):
    """One that shifts the value by ten and a hundred that shift it by one, and others that are not used; any unit."""
    influence = scale * np.concatenate([[10.0], np.ones(100), np.zeros(50)])
    assert Linearised(0.0, influence).freedom == pytest.approx(2 * 200**2 / (100**2 + 100 - 200**2 / 101))


@catches("no bias of the logarithm taken off").at(
    "validation.analysis.statistics.math", module_with(math, log1p=lambda relative: 0.0)
)
def test_the_bias_of_a_logarithm_is_half_of_its_variance():
    """E ln x = ln m - var(x) / 2 m^2 + ...: of a log-normal x with relative variance v, ln(1 + v) / 2 exactly."""
    found = log(Linearised(2.0, np.array([0.6, -0.8])))
    assert found.value == pytest.approx(math.log(2.0) + math.log(1 + 0.25) / 2)
    assert found.influence.tolist() == [0.3, -0.4]


@catches("degrees of freedom that two surfaces do not have").at(
    "validation.analysis.statistics.Linearised.freedom", property(lambda mine: math.inf)
)
def test_a_sample_of_two_has_one_degree_of_freedom():
    """Its two contributions are always alike, as if nothing scattered; the interval of the mean holds in 95 %."""
    drawn = np.random.default_rng(9).standard_normal((2000, 2))
    means = [moments(values, np.ones(2, dtype=bool)).mean for values in drawn]
    assert {mean.freedom for mean in means} == {1.0}
    assert np.mean([abs(mean.value) < mean.half_width for mean in means]) == pytest.approx(0.95, abs=0.015)


def test_no_deviation_is_minus_infinity_and_a_negative_variance_is_none():
    equal = moments(np.full(9, 1 / 3), np.ones(9, dtype=bool)).log_relative_deviation
    assert equal.value == -math.inf and equal.half_width == 0
    assert math.isnan(log(Linearised(-1.0, np.ones(3))).value)


right_student = statistics.student


@catches("intervals of single points for those of a range", points=25).at(
    "validation.analysis.statistics.student", lambda freedom, confidence=0.95: right_student(freedom)
)
@pytest.mark.parametrize("points", [1, 4, 25])
def test_intervals_that_hold_together_share_their_five_per_cent(points):
    """Bonferroni: each of so many misses in 0.05 / points, by Student's quantile of eight equal realisations."""
    found = Linearised(1.0, np.array([0.1, -0.1] * 4))
    expected = stats.t.ppf(1 - 0.05 / points / 2, 7) * 0.1 * math.sqrt(8)
    assert found.half_width_among(points) == pytest.approx(expected, rel=1e-4)


def test_what_a_realisation_contributes_to_a_variance_is_what_leaving_it_out_changes():
    values = np.array([0.3, 1.0, 2.2, 0.9, 5.0])
    found = moments(values, np.ones(5, dtype=bool)).variance
    changes = [np.var(values, ddof=1) - np.var(np.delete(values, i), ddof=1) for i in range(5)]
    np.testing.assert_allclose(found.influence / found.influence[4], np.array(changes) / changes[4], rtol=1e-9)


# --- a mean by regression on what more realisations are known of ---


right_regression = statistics.regression_mean


def scores(rng, drawn):
    """Three statistics of each realisation, and y, 2 in the mean: nearly linear in them, with scatter of its own."""
    x = rng.standard_normal((drawn, 3))
    return x, 2 + x @ [1.0, 0.7, 0.5] + 0.05 * (x[:, 0] ** 2 - 1) + 0.3 * rng.standard_normal(drawn)


def without_the_difference(values, controls):
    """The error of a mean by regression at the plain mean."""
    return replace(right_regression(values, controls), value=float(np.mean(values)))


@catches("a control variate that is not subtracted", size=30, drawn=3000).at(
    "validation.analysis.statistics.regression_mean", without_the_difference
)
@catches("degrees of freedom that a regression has used", size=12, drawn=3000).at(
    "validation.analysis.statistics.np", module_with(np, linalg=module_with(np.linalg, matrix_rank=lambda x: 0))
)
@catches("the mean of a control variate without its error", size=30, drawn=60).at(
    "validation.analysis.statistics.regression_mean",
    lambda values, controls: right_regression(values, np.tile(controls, (50, 1))),
)
@catches("a slope of the wrong sign", size=30, drawn=3000).at(
    "validation.analysis.statistics.regression_mean",
    lambda values, controls: right_regression(2 * values.mean() - values, controls),
)
@pytest.mark.parametrize(("size", "drawn"), [(12, 3000), (30, 60), (30, 3000), (200, 2000)])
def test_the_interval_of_a_mean_by_regression_holds(size, drawn):
    """Also where few have y, all have used degrees of freedom, or the statistics are known of few more."""
    rng = np.random.default_rng(size + drawn)

    def estimate():
        x, y = scores(rng, drawn)
        return ends(statistics.regression_mean(y[:size], x))

    assert holds(covered(estimate, 2.0), wide=0.01)


def test_a_mean_by_regression_has_the_scatter_that_is_left():
    """Of y alone 1.36^2; s^2 / n of the residuals, and the part that goes with x over all that are drawn."""
    x, y = scores(np.random.default_rng(2), 20000)
    found = statistics.regression_mean(y[:500], x)
    assert found.error == pytest.approx(math.sqrt(0.3075**2 / 500 + 1.74 / 20000), rel=0.1)
    assert found.error < 0.3 * moments(y[:500], np.ones(500, dtype=bool)).mean.error


def test_a_mean_by_regression_on_nothing_is_the_plain_mean():
    """Of few realisations, by statistics that do not scatter, and by none; and what has no statistics is not used."""
    y = np.array([1.0, 2.0, 4.0, 3.0] * 6)
    plain = moments(y, np.ones(24, dtype=bool)).mean
    for values, controls in ((y, np.ones((30, 2))), (y, np.arange(48.0).reshape(24, 2) // 48)):
        found = statistics.regression_mean(values, controls)
        assert (found.value, found.error) == pytest.approx((plain.value, plain.error))
    few = statistics.regression_mean(y[:8], np.arange(20.0).reshape(10, 2))
    assert (few.value, few.influence.size) == (y[:8].mean(), 10)
    beyond = statistics.regression_mean(np.append(y, 1e9), np.ones((24, 1)))
    assert beyond.value == pytest.approx(plain.value) and beyond.influence[-1] == 0


def test_lost_values_are_not_part_of_a_mean_by_regression():
    x, y = scores(np.random.default_rng(3), 40)
    lost = np.where(np.arange(40) % 4, y, np.nan)
    order = np.argsort(np.isnan(lost), kind="stable")
    one, other = right_regression(lost, x), right_regression(y[order][:30], x[order])
    assert (one.value, one.error) == pytest.approx((other.value, other.error))
