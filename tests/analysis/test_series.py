"""Numbers, tables and verdicts of planted series: worst points, root mean squares, intervals that hold at once."""

import math
import re

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis import series as declared
from validation.analysis.evidence import Role, Verdict
from validation.analysis.series import MARGINS, Estimates, Margin, Series, masked, numbers_of, single, spans, tables_of
from validation.analysis.statistics import Estimate, Interval, extrapolated, student

NEAR = Margin(tolerance=1.0, reason="r", source="s", rms=(0.5, "q"))
Q = (1.0, 2.0, 4.0)


def estimates(*values, error=0.0, samples=5):
    return Estimates(Estimate(value, error, samples) for value in values)


def series(*values, error=0.0, margin=NEAR, **changes):
    settings = {"along": "q", "at": Q[: len(values)], "margin": margin, **changes}
    return Series("level", "m", estimates(*values, error=error), **settings)


def test_a_range_is_judged_by_its_worst_point_and_by_the_rms():
    worst, rms = series(0.1, -3.0, 0.2).numbers
    assert (worst.value, worst.where, worst.verdict) == (-3.0, {"q": (1.0, 4.0), "worst at": 2.0}, Verdict.OUTSIDE)
    assert rms.quantity == "rms of level" and rms.value == pytest.approx(math.sqrt((0.01 + 9 + 0.04) / 3))
    assert (rms.tolerance, rms.reason) == (0.5, "q")


def test_intervals_of_all_points_and_of_all_ranges_hold_at_once():
    """By Bonferroni: 3 points of each of 4 ranges."""
    worst, rms = series(0.1, 0.2, 0.3, error=0.1, family=4).numbers
    assert worst.sample == pytest.approx(0.1 * student(4, 1 - 0.05 / 12))
    assert rms.sample == pytest.approx(0.1 * student(4, 1 - 0.05 / 4))
    worst, rms = series(0.1, 0.2, 0.3, error=0.1, family=7 / 3, rms_family=2).numbers
    assert worst.sample == pytest.approx(0.1 * student(4, 1 - 0.05 / 7))
    assert rms.sample == pytest.approx(0.1 * student(4, 1 - 0.05 / 2))


def test_an_interval_of_its_own_is_the_sample_of_a_number():
    """A share has no standard error; nothing widens its interval, and its reference is exact."""
    (number,) = Series("share", "", (Interval(0.9, 0.04),), reference=1.0, margin=NEAR, family=3).numbers
    assert (number.value, number.reference, number.sample, number.grid) == (0.9, 1.0, 0.04, 0.0)


def test_each_range_is_judged_by_itself_and_named():
    found = series(0.1, 0.2, 3.0, ranges=spans(Q, (1, 2), (2, 4)), margin=Margin(tolerance=1.0, reason="r")).numbers
    assert [(n.where["q"], n.verdict) for n in found] == [((1, 2), Verdict.WITHIN), ((2, 4), Verdict.OUTSIDE)]


def test_points_without_a_value_are_left_out_and_the_range_ends_before_them():
    (worst, _) = series(0.1, 0.2, -math.inf).numbers
    assert worst.where["q"] == (1.0, 2.0)
    assert series(0.1, math.nan, math.nan, fewest=2).numbers == []


@catches("a series without the error of its reference").at(
    "validation.analysis.statistics.Estimate.minus",
    lambda mine, other: Estimate(mine.value - other.value, mine.error, mine.samples),
)
def test_a_reference_with_an_error_widens_the_interval_and_one_without_does_not():
    margin = Margin(tolerance=1.0, reason="r")
    exact, sampled = (
        series(1.0, error=0.1, margin=margin, reference=reference).numbers[0]
        for reference in (estimates(0.5), estimates(0.5, error=0.1))
    )
    assert exact.difference == sampled.difference == 0.5
    assert exact.sample == pytest.approx(0.1 * student(4)) and sampled.sample > exact.sample


def test_a_change_to_finer_cells_is_what_the_grid_leaves():
    finer = estimates(0.1, error=0.02)
    value = estimates(1.0, error=0.05).extrapolate_to_zero(finer)
    (number, _) = Series("x", "m", value, along="q", at=(1.0,), grid=finer, scale=2.0, margin=NEAR, family=3).numbers
    expected, left = extrapolated(Estimate(1.0, 0.05, 5), finer[0], 3)
    assert number.value == pytest.approx(2 * expected.value) and number.grid == pytest.approx(2 * left)


def test_a_number_of_its_own_has_no_range():
    (number,) = Series(
        "x", "m", (2.0,), where={"h": 1.0}, reference=4.0, margin=Margin(tolerance=0.5, reason="r")
    ).numbers
    assert (number.value, number.where, number.verdict) == (2.0, {"h": 1.0}, Verdict.OUTSIDE)


@catches("a relative tolerance in the unit").at(
    f"{__name__}.Margin", lambda relative=False, **settings: declared.Margin(**settings)
)
def test_a_relative_margin_is_of_the_reference_and_a_criterion_has_a_finding_for_its_rms():
    margin = Margin(tolerance=0.1, reason="r", relative=True, role=Role.CRITERION, rms=(1.0, "q"))
    worst, rms = series(30.0, margin=margin, reference=20.0, scale=2.0).numbers
    assert worst.tolerance == pytest.approx(4.0)
    assert (worst.role, rms.role) == (Role.CRITERION, Role.FINDING)


def test_what_is_not_judged_is_in_the_table_alone():
    one, other = series(0.0, 1.0, error=0.1, margin=None, shown=math.exp, where={"h": 1.0}), series(2.0, margin=None)
    assert numbers_of([one, other]) == ()
    (table,) = tables_of([one, other])
    assert list(table.columns) == ["h", "model", "q", "value", "low", "high"]
    np.testing.assert_allclose(table["value"], [1, math.e, 2.0])
    assert table["high"][1] == pytest.approx(math.exp(1 + 0.1 * student(4))) and np.isnan(table["h"][2])


def test_ends_of_a_row_hold_sample_and_grid_and_ranges_have_a_table_of_their_own():
    one = series(1.0, -3.0, error=0.1, grid=(0.5, 0.25), margin=Margin(tolerance=1.0, reason="r"))
    points, judged = tables_of([one])
    np.testing.assert_allclose(points["low"], [1 - 0.5 - 0.1 * student(4), -3 - 0.25 - 0.1 * student(4)])
    assert judged.name == "level, judged"
    assert [judged[name].tolist() for name in ("from", "to", "value", "verdict")] == [
        [1.0],
        [2.0],
        [-3.0],
        ["outside tolerance"],
    ]


def test_a_series_has_a_value_at_each_point():
    with pytest.raises(ValueError, match="must have a value at each q"):
        series(1.0, 2.0, at=(1.0,))


def test_what_is_exact_has_no_sample_and_an_absolute_margin_knows_no_scale():
    margin = Margin(tolerance=0.3, reason="r").with_source("theory")
    (exact,) = Series("x", "m", (2.0,), reference=1.0, scale=5.0, grid=0.1, margin=margin).numbers
    assert (exact.value, exact.reference, exact.sample, exact.grid) == (10.0, 5.0, 0.0, 0.5)
    assert (exact.tolerance, exact.source) == (0.3, "theory")
    (alone,) = single("x", "m", 2.0, 0.1, "s", "r", where={"band": (1.0, 2.0)}).numbers
    assert (alone.where, alone.tolerance, alone.role) == ({"band": (1.0, 2.0)}, 0.1, Role.CRITERION)
    (table,) = tables_of([Series("x", "m", (2.0,), where={"band": (1.0, 2.0)})])
    assert table["band"].tolist() == ["1 to 2"]


def test_what_is_masked_is_judged_nowhere_and_kept_elsewhere():
    values = Estimates(Estimate(x, 0.1, 5) for x in (9.0, 0.1, 0.2))
    kept = masked(values, np.array([False, True, True]))
    assert math.isnan(kept[0].value) and kept[1:] == list(values[1:])
    (found,) = Series("x", "m", kept, along="q", at=(1.0, 2.0, 4.0), margin=Margin(tolerance=1.0, reason="r")).numbers
    assert found.where["q"] == (2.0, 4.0) and found.verdict is Verdict.WITHIN


def test_sums_and_ratios_of_estimates_are_taken_element_by_element():
    one, other = (Estimates(Estimate(x, 0.1, 5) for x in values) for values in ((1.0, 2.0), (0.5, 4.0)))
    assert (one + other).values.tolist() == [1.5, 6.0] and (one - other).values.tolist() == [0.5, -2.0]
    assert [x.error for x in one - other] == pytest.approx([0.1 * math.sqrt(2)] * 2)
    exact = Estimates.exact([1.0, 2.0])
    assert exact.values.tolist() == [1.0, 2.0] and [x.error for x in exact] == [0.0, 0.0]
    rows = np.array([[1.0, 8.0], [3.0, 8.0]])
    assert Estimates.ratios(rows, np.ones((2, 2))).values == pytest.approx(np.log([2.0, 8.0]))
    assert Estimates.ratios(rows, np.array([1.0, 4.0])).values == pytest.approx(np.log([2.0, 2.0]))
    assert Estimates.ratios(rows[:, 0], np.ones(2)).values == pytest.approx([math.log(2)])
    for pair in ((one, Estimates(other[:1])), (other[:1], one)):
        with pytest.raises(ValueError, match="zip"):
            Estimates(pair[0]) - Estimates(pair[1])


def test_ends_of_ranges_of_small_values_are_sharp():
    assert list(spans((1e-6, 2e-6, 4e-6), (2e-6, 3e-6))) == [(2e-6, 2e-6)]
    assert list(spans((2e-6, 4e-6), (1e-6, 3e-6), (5e-6, 6e-6))) == [(2e-6, 2e-6)]


@pytest.mark.parametrize("name", MARGINS)
def test_a_shared_margin_is_as_wide_as_its_reason_says(name):
    number, unit = re.match(r"([\d.]+) ?(%|dB)?", MARGINS[name].reason).groups()
    assert MARGINS[name].tolerance == pytest.approx(float(number) / (100 if unit == "%" else 1))
    assert MARGINS[name].relative is (name in ("peak", "jump", "period", "lift-off"))
