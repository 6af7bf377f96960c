"""Verdicts by intervals, the ranges that they make, and the condition that the worst points share."""

import math

import pytest

from tests.judging.judged_points import INCONCLUSIVE, NO_RESULT, NOT_SERVED, OUTSIDE, WITHIN
from tests.seeded import catches
from validation.analysis.evidence import where_text
from validation.judging import judgement
from validation.judging.judgement import (
    DEVIATION,
    LEVEL,
    common_condition,
    judged_number,
    largest_deviations,
    missing_number,
    ranges_of,
    series_of,
    within_ranges,
)

verdict_of = judgement.verdict_of


def without_its_interval(apart, half, within, **_):
    return verdict_of(apart, 0.0, within)


@catches("a verdict without its interval", value=1.05, half=0.06, verdict=INCONCLUSIVE).at(
    "validation.judging.judgement.verdict_of", without_its_interval
)
@pytest.mark.parametrize(
    ("value", "half", "verdict"),
    [
        (1.05, 0.0, WITHIN),
        (0.95, 0.04, WITHIN),
        (1.05, 0.06, INCONCLUSIVE),
        (1.15, 0.06, INCONCLUSIVE),
        (1.15, 0.04, OUTSIDE),
        (0.85, 0.04, OUTSIDE),
        (0.0, 0.5, OUTSIDE),
    ],
)
def test_the_whole_interval_lies_inside_or_outside_of_the_tolerance(value, half, verdict):
    point = judged_number("k", {}, 2 * value, 2.0, half, 0.1)
    assert point.verdict == verdict
    assert point.difference == pytest.approx(value - 1)
    assert point.error == pytest.approx(value * half)


@catches("decibels of a power for those of an amplitude", apart=0.8, half=0.02, verdict=WITHIN).at(
    "validation.judging.judgement.decibels", lambda ratio: 10 * math.log10(1 + ratio)
)
@pytest.mark.parametrize(
    ("apart", "half", "verdict"), [(0.8, 0.02, WITHIN), (0.8, 0.03, INCONCLUSIVE), (-0.9, 0.07, OUTSIDE)]
)
def test_a_ratio_of_ten_per_cent_is_0_83_decibels_of_a_level(apart, half, verdict):
    assert judged_number("level", {}, 60 + apart, 60.0, half, 0.1, unit=LEVEL).verdict == verdict
    assert judged_number("level", {}, 61.0, 60.0, 0.0, 10 ** (1 / 20) - 1, unit=LEVEL).verdict == WITHIN


@pytest.mark.parametrize(
    ("value", "reference", "verdict"),
    [(0.0, 5e-4, WITHIN), (0.0, 2e-3, OUTSIDE), (6e-3, 5.5e-3, WITHIN), (0.2, 0.1, OUTSIDE)],
)
def test_deviations_below_one_per_cent_are_judged_by_their_absolute_difference(value, reference, verdict):
    """A tenth of one per cent at most."""
    assert judged_number("deviation", {}, value, reference, 0.0, 0.1, unit=DEVIATION).verdict == verdict


def points(verdicts, hurst=0.4):
    values = {"=": 1.0, "#": 2.0}
    return [
        judged_number("k", {"H": hurst, "Fbar": 10.0**i}, values[sign], 1.0, 0.0, 0.1)
        if sign in values
        else missing_number("k", {"H": hurst, "Fbar": 10.0**i}, NO_RESULT, "no number")
        for i, sign in enumerate(verdicts)
    ]


def test_neighbouring_points_of_one_verdict_are_a_range_whatever_their_order():
    found = ranges_of([*reversed(points("##=x=")), *points("=", hurst=0.7)])
    assert [(r.where["H"], r.along, r.start, r.stop, r.verdict) for r in found] == [
        (0.4, "Fbar", 1.0, 10.0, OUTSIDE),
        (0.4, "Fbar", 100.0, 100.0, WITHIN),
        (0.4, "Fbar", 1000.0, 1000.0, NO_RESULT),
        (0.4, "Fbar", 1e4, 1e4, WITHIN),
        (0.7, "Fbar", 1.0, 1.0, WITHIN),
    ]


def test_the_worst_points_are_the_farthest_and_say_what_they_share():
    """By the ratio: a tenth is as far as ten times."""
    mine = points("##====")
    assert [point.where["Fbar"] for point in largest_deviations([*mine, *points("x", 0.7)])] == [1.0, 10.0, 1.0]
    assert common_condition(largest_deviations(mine), mine) == "Fbar up to 10"
    assert common_condition(largest_deviations(points("====##")), points("====##")) == "Fbar from 10000 on"
    both = [*points("==="), *points("###", 0.7)]
    assert common_condition(largest_deviations(both), both) == "H = 0.7"
    far = [judged_number("k", {"H": h}, v, 1.0, 0.0, 0.1) for h, v in ((0.1, 0.05), (0.2, 10.0), (0.3, -1.0))]
    assert [point.where["H"] for point in largest_deviations(far)] == [0.3, 0.1, 0.2]
    assert largest_deviations(points("==")) == []
    unsure, sure = (
        judged_number("k", {"H": h}, v, 1.0, half, 0.1) for h, v, half in ((0.1, 1.66, 0.15), (0.2, 1.5, 0.0))
    )
    assert largest_deviations([unsure, sure]) == [sure, unsure]


def test_ranges_within_tolerance_are_those_of_all_series_or_of_the_values_on_which_they_depend():
    (series,) = series_of([*points("==#="), *points("=##=", 0.7)])
    found = within_ranges(series)
    assert dict(found.values) == {((1.0, 1.0), (1e3, 1e3)): ()} and (found.by, found.every) == ("", ["H"])
    (series,) = series_of([*points("==##"), *points("##==", 0.7), *points("##==", 1.0)])
    found = within_ranges(series)
    assert dict(found.values) == {((1.0, 10.0),): [0.4], ((1e2, 1e3),): [0.7, 1.0]}
    assert (found.by, found.every, found.numeric) == ("H", [], [])
    (series,) = series_of(points("####"))
    assert not within_ranges(series).values


def test_a_condition_with_a_unit_has_it_behind_its_value():
    where = {"wheel": "50 kN, 360 mm", "alpha": 8.0, "wavelength [mm]": 16.0}
    assert where_text(where) == "50 kN, 360 mm, alpha = 8, wavelength = 16 mm" and where_text({}) == ""


def test_a_point_without_a_number_has_its_reason():
    point = missing_number("k", {"H": 0.4}, NOT_SERVED, "too light", reference=2.0)
    assert (point.verdict, point.shown, point.reference) == (NOT_SERVED, "too light", 2.0)
    assert math.isnan(point.value) and math.isnan(point.difference)
    assert point.number is None
    with pytest.raises(ValueError, match="must be not served or no result, got within tolerance"):
        missing_number("k", {}, WITHIN, "")


def test_the_error_of_a_small_deviation_is_that_of_the_larger_of_both():
    """In parts of 1 %."""
    for value, reference in ((0.004, 0.008), (0.008, 0.004)):
        point = judgement.judged_number("deviation", {}, value, reference, 0.1, 0.1, unit=judgement.DEVIATION)
        assert point.error == pytest.approx(0.08)


def test_what_has_one_reference_that_is_one_by_chance_is_no_rule():
    points = [judgement.judged_number("level", {"q a": x}, 1.0, x, 0.0, 0.1) for x in (1.0, 2.0)]
    assert not judgement.series_of(points)[0][0].is_closed_form and judgement.series_of(points[:1])[0][0].is_closed_form


def test_what_is_no_number_neither_agrees_nor_differs():
    for value, half in ((math.nan, 0.01), (1.0, math.nan), (5.0, math.inf)):
        assert judgement.judged_number("force", {}, value, 1.0, half, 0.1).verdict == INCONCLUSIVE


def test_an_error_that_is_unknown_is_told_with_its_reason():
    point = judgement.judged_number("force", {}, 1.2, 1.0, math.inf, 0.1, reason="equal draws")
    assert point.shown == "+20 %, of unknown error: equal draws"


def test_a_judged_number_is_a_number_of_a_report():
    """The deviation, whose reference is zero, with the same verdict; grid and sample are apart."""
    where = {"H": 0.4, "Fbar": 0.1}
    for value, unit in ((2.1, "-"), (2.5, "-"), (2.2, "-"), (2.5, LEVEL)):
        point = judged_number("k", where, value, 2.0, 0.05, 0.1, unit=unit, grid=0.02)
        number = point.number
        assert (number.quantity, number.where, number.verdict) == ("k", where, point.verdict)
        assert (number.value, number.reference, number.unit) == (point.difference, 0.0, unit)
        assert number.grid == pytest.approx(0.4 * point.error) and number.uncertainty == pytest.approx(point.error)
    assert judgement.judged_number("k", where, 1.2, 1.0, math.inf, 0.1).number is None
