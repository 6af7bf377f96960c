"""Error bars on populations with a known answer: each kind covers the truth in 95 of 100, and says what it is of.

Shares are held to four standard deviations of a binomial count. Seeds are fixed.
"""

import math

import numpy as np
import pytest
from scipy import stats

from tests.analysis.intervals import covered, ends, holds
from tests.cases.test_limits import STEEP
from validation.analysis.statistics import (
    Estimate,
    at_level,
    jackknife_error,
    log_mean,
    log_relative_deviation,
    mean_estimate,
    ratio_of_means,
    sample,
)
from validation.cases.limits.limits import threshold
from validation.cases.limits.sweeps import Sweep
from validation.cases.selection.model_selection_study import clopper_pearson
from validation.simulation.free_vibration import fit_drift
from validation.simulation.probing import swept

# --- of a mean, of a ratio, of a difference ---


@pytest.mark.parametrize("size", [2, 3, 5, 30])
def test_the_interval_of_a_mean_is_students(size):
    rng = np.random.default_rng(size)
    assert holds(covered(lambda: ends(mean_estimate(3 + 0.5 * rng.standard_normal(size))), 3.0))


@pytest.mark.parametrize("size", [3, 6, 20])
def test_the_interval_of_a_ratio_of_means_is_students(size):
    """x = 2 y + noise: what they share drops out, and n - 1 degrees of freedom are left. y scatters as forces do."""
    rng = np.random.default_rng(size)

    def drawn():
        y = 5 * rng.lognormal(0, 0.3, size)
        return ends(ratio_of_means(2 * y + rng.standard_normal(size), y))

    assert holds(covered(drawn, 2.0))


def test_lost_realisations_count_neither_in_a_mean_nor_in_a_ratio():
    x, y = np.array([1.0, 2.0, np.nan, 4.5]), np.array([2.0, 3.0, 100.0, 5.0])
    for one, other in (
        (mean_estimate(x), mean_estimate(x[[0, 1, 3]])),
        (ratio_of_means(x, y), ratio_of_means(x[[0, 1, 3]], y[[0, 1, 3]])),
    ):
        assert one == other
        assert one.samples == 3
    assert ratio_of_means(x, y).value == pytest.approx(7.5 / 10)


def test_what_values_share_with_their_references_is_no_error_of_their_ratio():
    y = np.random.default_rng(0).lognormal(0, 0.5, 8)
    assert ratio_of_means(3 * y, y).error < 1e-15


@pytest.mark.parametrize(("sizes", "spreads"), [((4, 30), (1.0, 0.1)), ((5, 6), (1.0, 1.0)), ((3, 40), (0.3, 1.0))])
def test_the_interval_of_a_difference_is_that_of_welch(sizes, spreads):
    rng = np.random.default_rng(sizes[0])

    def drawn():
        one, other = (
            mean_estimate(m + s * rng.standard_normal(n)) for m, s, n in zip((5, 2), spreads, sizes, strict=True)
        )
        return ends(one.minus(other))

    assert holds(covered(drawn, 3.0), short=0.01, wide=0.02)


def test_an_error_that_is_not_known_stays_unknown():
    both = Estimate(1.0, 0.1, 9).minus(Estimate(1.0, math.nan, 4))
    assert math.isnan(both.error) and both.samples == 4


def test_estimates_without_error_have_no_interval():
    assert Estimate(2.0, 0.0, 3).minus(Estimate(1.0, 0.0, 4)).half_width == 0.0


def test_a_half_width_is_students_of_its_error():
    assert Estimate(5.0, 0.3, 8).half_width == pytest.approx(stats.t.interval(0.95, 7, scale=0.3)[1])


# --- resampled, left out ---


@pytest.mark.parametrize("size", [3, 4, 6, 12])
def test_the_bootstrap_has_the_standard_error_of_a_mean(size):
    """s / sqrt(n), of the sample at hand; 999 resamples know it to 2.2 %, forty samples of them to 0.4 %."""
    rng = np.random.default_rng(size)

    def over_exact():
        draws = 1 + 0.2 * rng.standard_normal((size, 1))
        return sample(draws, rng).estimate(at_level(0, lambda mean, _: mean)).error / (
            draws.std(ddof=1) / math.sqrt(size)
        )

    assert np.mean([over_exact() for _ in range(40)]) == pytest.approx(1, abs=4 * 0.022 / math.sqrt(40))


@pytest.mark.slow
@pytest.mark.parametrize(("size", "short"), [(3, 0.0), (6, 0.02)])
def test_the_bootstrap_covers_in_small_samples(size, short):
    """Of pairs of grids there are few."""
    rng = np.random.default_rng(size)

    def drawn():
        return ends(sample(1 + 0.2 * rng.standard_normal((size, 1)), rng).estimate(at_level(0, log_mean)))

    assert holds(covered(drawn, 0.0, trials=300), trials=300, short=short)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "sigma"), [(12, 0.3), (40, 0.3)])
def test_the_bootstrap_covers_log_normal_populations(size, sigma):
    """Skewed: a few are lacking, more of them of the deviation."""
    rng = np.random.default_rng(size)
    truth = {log_mean: sigma**2 / 2, log_relative_deviation: math.log(math.expm1(sigma**2)) / 2}
    draws = [sample(rng.lognormal(0, sigma, (size, 1)), rng) for _ in range(200)]
    for statistic, short in ((log_mean, 0.0), (log_relative_deviation, 0.06)):
        found_ = iter([ends(one.estimate(at_level(0, statistic))) for one in draws])
        share = covered(lambda found_=found_: next(found_), truth[statistic], trials=200)
        assert holds(share, trials=200, short=short)


def test_leaving_out_one_is_the_standard_error_of_a_mean():
    x = np.random.default_rng(0).standard_normal((7, 3))
    without = [np.delete(x, i, axis=0).mean(axis=0) for i in range(7)]
    np.testing.assert_allclose(jackknife_error(without), x.std(axis=0, ddof=1) / math.sqrt(7), rtol=1e-12)


# --- straight lines, shares, borders ---


def test_the_drift_of_an_energy_covers_its_truth():
    rng = np.random.default_rng(0)
    place = (np.arange(10) + 0.5) / 10
    assert holds(covered(lambda: ends(fit_drift(2 * place + 0.1 * rng.standard_normal(10))), 2.0))


@pytest.mark.slow
@pytest.mark.parametrize(("share", "size"), [(0.95, 60), (0.95, 200), (0.5, 20)])
def test_the_interval_of_a_share_is_that_of_clopper_and_pearson(share, size):
    """Summed over all counts: it holds the truth in 95 of 100 at least, and misses it by no more than 2.5 a side."""
    counts = np.arange(size + 1)
    chance = stats.binom.pmf(counts, size, share)
    low, high = np.array([clopper_pearson(np.arange(size) < n) for n in counts]).T
    below, above = chance[share > high].sum(), chance[share < low].sum()
    assert below <= 0.025 and above <= 0.025
    assert below + above >= 0.005


def test_where_a_limit_is_crossed_is_known_to_its_steps():
    """y = x^2 crosses 4 at 2; the interval of the place is in octaves, and grows with the steps of the sweep."""

    def crossed(steps):
        x = np.geomspace(0.25, 8.0, steps)
        (number,) = threshold(Sweep.of(STEEP, swept(x, x**2, [""] * steps))).numbers
        return number

    fine, coarse = crossed(41), crossed(9)
    for number in (fine, coarse):
        assert abs(number.value) <= number.grid + 1e-9
    assert coarse.grid == pytest.approx(5 * fine.grid, rel=0.01)
