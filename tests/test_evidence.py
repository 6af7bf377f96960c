"""Verdicts and statistics: intervals that cover, and verdicts that follow from them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.evidence import Number, Role, Table, Verdict
from validation.statistics import Estimate, estimate, log_mean, log_relative_deviation

reals = st.floats(-1e3, 1e3)
sizes = st.floats(0, 1e3)


def number(**changes):
    given = {"label": "x", "value": 1.0, "reference": 1.0, "source": "s", "tolerance": 0.1, "reason": "r", **changes}
    return Number(**given)


@given(value=reals, reference=reals, tolerance=sizes, grid=sizes, sample=sizes)
def test_verdicts_follow_from_the_interval(value, reference, tolerance, grid, sample):
    n = number(value=value, reference=reference, tolerance=tolerance, grid=grid, sample=sample)
    ends = [abs(value - reference) + side * (grid + sample) for side in (-1, 1)]
    expected = {
        Verdict.AGREE: ends[1] <= tolerance,
        Verdict.DIFFER: ends[0] > tolerance,
        Verdict.UNDECIDED: ends[0] <= tolerance < ends[1],
    }
    assert expected[n.verdict]
    assert sum(expected.values()) == 1


def test_a_criterion_must_agree_and_a_finding_need_not():
    assert number().met
    assert not number(value=2.0).met
    assert not number(sample=1.0).met
    assert number(value=2.0, role=Role.FINDING).met


@pytest.mark.parametrize("name", ["value", "reference", "tolerance", "grid", "sample"])
def test_numbers_are_finite(name):
    with pytest.raises(ValueError, match=name):
        number(**{name: np.nan})


def test_tables_have_columns_of_one_length():
    with pytest.raises(ValueError, match="one length"):
        Table("t", {"a": [1, 2], "b": [1]})
    assert Table("t", {"a": [1, 2, 1], "b": [4, 5, 6]}).where(a=1)["b"].tolist() == [4, 6]


@pytest.mark.parametrize("size", [12, 60])
@pytest.mark.parametrize("statistic", [log_mean, log_relative_deviation])
def test_intervals_cover_the_truth(size, statistic):
    """95 % nominal, 300 samples of a normal population: binomial error 1.3 %; small samples lack a few."""
    rng = np.random.default_rng(1)
    truth = {log_mean: 0.0, log_relative_deviation: np.log(0.2)}[statistic]
    hits = 0
    for _ in range(300):
        found = estimate(1 + 0.2 * rng.standard_normal(size), statistic, rng)
        hits += abs(found.value - truth) <= found.half_width
    assert 0.95 - 4 * 0.013 - 0.5 / size <= hits / 300 <= 0.95 + 4 * 0.013


@given(a=st.floats(0.01, 10), b=st.floats(0.01, 10), n=st.integers(3, 100), m=st.integers(3, 100))
def test_difference_of_estimates(a, b, n, m):
    apart = Estimate(3.0, a, n).minus(Estimate(1.0, b, m))
    assert apart.value == 2.0
    assert apart.error == pytest.approx(np.hypot(a, b))
    assert min(n, m) - 1 <= apart.samples <= n + m


@pytest.mark.parametrize("bad", [np.ones(2), np.ones((3, 3)), np.array([1.0, np.nan, 1.0]), np.array([1.0, -1.0, 2.0])])
def test_samples_are_positive_and_enough(bad):
    with pytest.raises(ValueError, match="samples"):
        estimate(bad, log_mean, np.random.default_rng(0))
