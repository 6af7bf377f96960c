"""Titles of figures that are read from tables and charts: planted values, and the words that follow from them."""

import numpy as np

from tests.benchmarks.test_fronts import CHART
from validation.analysis.evidence import Table
from validation.benchmarks.solvers import evidence as solvers
from validation.benchmarks.work_precision import evidence as precision
from validation.cases.wheel import spectrum_evidence


def springs(compression):
    """Four inside of Hertz's contact, one at each side of it."""
    x = np.array([-1.1, -0.9, -0.2, 0.2, 0.9, 1.1])
    return Table("springs", {"x / a": x, "compression / d": np.array(compression)})


def test_the_contact_of_a_moment_is_counted_inside_of_that_of_hertz():
    pressure = Table("pressure", {"p / p0": np.array([0.0, np.nan, 1.3])})
    full, half = springs([0.0, 0.1, 1.0, 0.9, 0.2, 0.0]), springs([0.5, 0.0, 1.0, 0.9, 0.0, 0.5])
    titles = [spectrum_evidence._touching([one, pressure])["wheel-contact"] for one in (full, half)]
    assert ["100 % of the springs" in titles[0], "50 % of the springs" in titles[1]] == [True, True]
    assert titles[0].endswith("is 1.30 times Hertz's")


def test_a_step_is_compared_with_plain_sums_on_the_finest_springs():
    rates = {"a/dx": [25, 25, 100, 100], "wheel-steps a second": [9, 9, 60, 20], "plain sums a second": [1, 1, 10, 10]}
    title = solvers._over_plain_sums(Table("wheel", {name: np.array(values) for name, values in rates.items()}))
    assert title.startswith("With 100 springs to a radius a step is 2 to 6 times as fast")


def test_work_and_clock_are_counted_where_both_have_a_cheapest_method():
    """On the chart the plain iteration takes less work than boundary elements and more time, at 10 % and at 3 %."""
    without = [p for p in CHART if p.method != "plain"]
    assert "in 3 of 5 cases" in precision._by_work([CHART])
    assert "in 8 of 10 cases" in precision._by_work([CHART, without])
