"""Error bars on populations with a known answer: each kind covers the truth in 95 of 100, and says what it is of.

Shares are held to four standard deviations of a binomial count. Seeds are fixed.
"""

import math

import numpy as np
import pytest
from scipy import stats

from tests.analysis.intervals import covered, ends, holds
from tests.cases.test_limits import STEEP
from tests.seeded import catches
from validation.advice.cases.model_selection_study import clopper_pearson
from validation.analysis.statistics import (
    Estimate,
    jackknifed,
    mean_estimate,
    ratio_of_means,
)
from validation.cases.limits.limits import threshold
from validation.cases.limits.sweeps import Sweep
from validation.simulation.free_vibration import fit_drift
from validation.simulation.limits import swept

# --- of a mean, of a ratio, of a difference ---


def of_one_tail(estimate):
    """The quantile of 90 %."""
    return float(stats.t.ppf(0.95, estimate.samples - 1)) * estimate.error


@catches("one tail of Student's t", size=2).at(
    "validation.analysis.statistics.Estimate.half_width", property(of_one_tail)
)
@catches("the normal quantile for Student's", size=5).at(
    "validation.analysis.statistics.student",
    lambda degrees, confidence=0.95: float(stats.norm.ppf((1 + confidence) / 2)),
)
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


@pytest.mark.parametrize(("sizes", "spreads"), [((4, 30), (1.0, 0.1)), ((5, 6), (1.0, 1.0)), ((3, 40), (0.3, 1.0))])
def test_the_interval_of_a_difference_is_that_of_welch(sizes, spreads):
    rng = np.random.default_rng(sizes[0])

    def drawn():
        one, other = (
            mean_estimate(m + s * rng.standard_normal(n)) for m, s, n in zip((5, 2), spreads, sizes, strict=True)
        )
        return ends(one.minus(other))

    assert holds(covered(drawn, 3.0), short=0.01, wide=0.02)


def test_an_error_that_is_not_known_stays_unknown_and_none_makes_no_interval():
    both = Estimate(1.0, 0.1, 9).minus(Estimate(1.0, math.nan, 4))
    assert math.isnan(both.error) and both.samples == 4
    assert Estimate(2.0, 0.0, 3).minus(Estimate(1.0, 0.0, 4)).half_width == 0.0


@catches("a jackknife without its n - 1", size=7).at(
    "validation.analysis.statistics.jackknife_error",
    lambda without: np.std(without, axis=0, ddof=1) / math.sqrt(len(without)),
)
@pytest.mark.parametrize("size", [7, 300])
def test_leaving_out_one_is_the_standard_error_of_a_mean(size):
    """Of each column, in as many as a hundred groups of realisations; lost ones count not."""
    x = np.random.default_rng(0).standard_normal((size + 1, 3))
    x[-1] = np.nan
    found, groups = jackknifed(lambda rows: rows.mean(axis=0), x), min(size, 100)
    means = x[:-1].reshape(groups, -1, 3).mean(axis=1)
    np.testing.assert_allclose([one.value for one in found], means.mean(axis=0), rtol=1e-9)
    np.testing.assert_allclose([one.error for one in found], means.std(axis=0, ddof=1) / math.sqrt(groups), rtol=1e-9)
    assert {one.samples for one in found} == {groups}


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
