"""Titles of figures that are read from tables and charts: planted values, and the words that follow from them."""

import numpy as np

from tests.benchmarks.test_fronts import CHART
from validation.analysis.evidence import Table
from validation.benchmarks.solvers import evidence as solvers
from validation.benchmarks.work_precision import evidence as precision


def test_a_step_is_compared_with_plain_sums_on_the_finest_springs():
    rates = {"a/dx": [25, 25, 100, 100], "wheel-steps a second": [9, 9, 60, 20], "plain sums a second": [1, 1, 10, 10]}
    title = solvers._over_plain_sums(Table("wheel", {name: np.array(values) for name, values in rates.items()}))
    assert title.startswith("With 100 springs to a radius a step is 2 to 6 times as fast")


def test_work_and_clock_are_counted_where_both_have_a_cheapest_method():
    """On the chart the plain iteration takes less work than boundary elements and more time, at 10 % and at 3 %."""
    without = [p for p in CHART if p.method != "plain"]
    assert "in 3 of 5 cases" in precision._by_work([CHART])
    assert "in 8 of 10 cases" in precision._by_work([CHART, without])
