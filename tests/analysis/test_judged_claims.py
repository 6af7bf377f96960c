"""Claims and ranges: one counterexample contradicts, no mean of both signs agrees, no identity is evidence."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.seeded import catches
from validation.analysis import series, statistics
from validation.analysis.evidence import OF_NUMBERS, ClaimStatus, Evidence, JudgedClaim, Number, Role, Verdict
from validation.analysis.series import root_mean_square, worst
from validation.analysis.statistics import Estimate, student

AGREE, DIFFER, UNDECIDED = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE
OFF = {AGREE: (0.0, 0.0), DIFFER: (5.0, 0.0), UNDECIDED: (1.0, 0.5)}
"""Difference and half-width of a number with each verdict, within a tolerance of one."""
verdicts = st.lists(st.sampled_from(OF_NUMBERS), min_size=1, max_size=6)


def point(value, sample=0.0, at=1.0, **changes):
    given = {"quantity": "level", "model": "m", "where": {"q a": at}, "reference": 0.0, "tolerance": 1.0, "unit": "dB"}
    return Number(
        **given | {"value": value, "sample": sample, "source": "s", "reason": "r", "role": Role.FINDING} | changes
    )


def points_with(found):
    return tuple(point(*OFF[verdict], at=float(i)) for i, verdict in enumerate(found))


def claim(numbers, **changes):
    return JudgedClaim(claim="It is so.", answer="It is.", numbers=tuple(numbers), **changes)


def evidence(numbers, claims, **changes):
    texts = {"title": "t", "method": "m", "conclusions": (), "captions": {}, "tables": ()} | changes
    return Evidence(**texts, numbers=tuple(numbers), claims=tuple(claims))


def holds_unless_it_differs(claim):
    """A claim whose numbers are undecided taken for one that holds."""
    return ClaimStatus.REFUTED if claim.count(Verdict.OUTSIDE) else ClaimStatus.SUPPORTED


@catches("an undecided number taken for one that confirms").at(
    "validation.analysis.evidence.JudgedClaim.status", property(holds_unless_it_differs)
)
@given(verdicts)
def test_one_counterexample_contradicts_and_nothing_undecided_holds(found):
    """Of a claim that things agree, and of one that they differ."""
    for confirmed, refuted in ((AGREE, DIFFER), (DIFFER, AGREE)):
        status = claim(points_with(found), confirmed_by=confirmed).status
        assert (status is ClaimStatus.REFUTED) == (refuted in found)
        assert (status is ClaimStatus.SUPPORTED) == (set(found) == {confirmed})


claim_status = JudgedClaim.status.fget


@catches("limits taken at their word", inside=Verdict.INCONCLUSIVE, status=ClaimStatus.REFUTED).at(
    "validation.analysis.evidence.JudgedClaim.status",
    property(lambda claim: ClaimStatus.LIMITED if claim.inside else claim_status(claim)),
)
@pytest.mark.parametrize(("inside", "status"), [(AGREE, ClaimStatus.LIMITED), (UNDECIDED, ClaimStatus.REFUTED)])
def test_limits_hold_only_where_all_inside_agrees(inside, status):
    numbers = points_with([inside, DIFFER])
    assert claim(numbers, limits="below 1", inside=numbers[:1]).status is status


@pytest.mark.parametrize(
    "wrong",
    [
        {"numbers": ()},
        {"numbers": (point(0.0, role=Role.IDENTITY),)},
        {"confirmed_by": UNDECIDED},
        {"limits": "below 1"},
        {"inside": (point(0.0),)},
        {"limits": "below 1", "inside": (point(0.0, at=7.0),)},
    ],
)
def test_a_claim_that_nothing_tests_is_refused(wrong):
    with pytest.raises(ValueError, match="It is so"):
        claim(**{"numbers": (point(0.0),)} | wrong)


def test_a_case_claims_only_what_its_own_numbers_test():
    mine, other = point(0.0), point(0.0, at=2.0)
    assert evidence([mine], [claim([mine])]).claims[0].status is ClaimStatus.SUPPORTED
    with pytest.raises(ValueError, match="q a = 2"):
        evidence([mine], [claim([other])])


@given(verdicts)
def test_a_range_has_the_verdict_of_its_worst_point(found):
    verdict = worst(points_with(found)).verdict
    assert verdict is (DIFFER if DIFFER in found else UNDECIDED if UNDECIDED in found else AGREE)


WORST = [
    # of two that differ the one that is surest to, of two that do not the one that may yet
    ([point(5.0, 0.1, at=1.0), point(6.0, 4.0, at=2.0)], 1.0),
    ([point(0.8, 0.1, at=1.0), point(0.5, 0.45, at=2.0)], 2.0),
    # beside the tolerance of each
    ([point(0.5, at=1.0), point(1.2, at=2.0, tolerance=3.0)], 1.0),
    ([point(5.0, at=1.0), point(6.0, at=2.0, tolerance=3.0)], 1.0),
    # one that is undecided beside one that agrees with a wider interval; the end that is farther out
    ([point(0.95, 0.1, at=1.0), point(0.0, 0.9, at=2.0)], 1.0),
    ([point(6.0, 2.0, at=1.0), point(3.0, 0.4, at=2.0)], 1.0),
]


@catches("the farthest point for the worst", *WORST[0]).at(
    f"{__name__}.worst", lambda points: max(points, key=lambda p: abs(p.difference))
)
@pytest.mark.parametrize(("points", "at"), WORST)
def test_the_worst_point_is_the_farthest_beyond_its_tolerance_with_its_interval(points, at):
    assert worst(points).where["q a"] == worst(points[::-1]).where["q a"] == at


def mean_of_the_range(points):
    """The signed mean over a range, in which signs cancel."""
    return replace(series.worst(points), value=float(np.mean([p.difference for p in points])))


@catches("the mean of a range for its worst point").at(f"{__name__}.worst", mean_of_the_range)
def test_a_mean_of_both_signs_agrees_where_the_range_does_not():
    points = [point(8.0, 0.1, at=1.0), point(-8.0, 0.1, at=2.0)]
    assert np.mean([p.difference for p in points]) == 0.0
    assert worst(points).verdict is DIFFER
    rms = root_mean_square(points, tolerance=3.0, reason="r")
    assert (rms.value, rms.reference, rms.sample) == (pytest.approx(8.0), 0.0, pytest.approx(0.1))
    assert rms.verdict is DIFFER


def about_its_mean(points, tolerance, reason):
    """The scatter over a range, of which a constant difference is no part."""
    found = series.root_mean_square(points, tolerance, reason)
    return replace(found, value=float(np.std([point.difference for point in points])))


@catches("a root mean square about the mean").at(f"{__name__}.root_mean_square", about_its_mean)
@given(st.lists(st.tuples(st.floats(-9, 9), st.floats(-2, 2)), min_size=1, max_size=8))
def test_the_interval_of_a_root_mean_square_holds_whenever_those_of_its_points_do(pairs):
    """Errors as large as the half-widths allow, of any signs."""
    points = [point(true + error, abs(error), at=float(i)) for i, (true, error) in enumerate(pairs)]
    rms = root_mean_square(points, tolerance=1.0, reason="r")
    true = math.sqrt(np.mean([t**2 for t, _ in pairs]))
    assert abs(rms.value - true) <= rms.sample * (1 + 1e-9) + 1e-9


@catches("the interval of one point for all of a range").at(
    "validation.analysis.statistics.Estimate.half_width_among",
    lambda one, points: statistics.student(one.samples - 1) * one.error,
)
def test_intervals_of_a_range_hold_at_once():
    """Of seven means of ten, drawn with a known answer: all hold in 95 % of the draws; each for itself in 70 %."""
    rng = np.random.default_rng(5)
    drawn = rng.standard_normal((4000, 7, 10))
    off = np.abs(drawn.mean(axis=2)) * math.sqrt(10) / drawn.std(axis=2, ddof=1)
    among = Estimate(0.0, 1.0, 10).half_width_among(7)
    assert np.mean((off <= among).all(axis=1)) == pytest.approx(0.955, abs=0.012)
    assert Estimate(0.0, 1.0, 10).half_width_among(1) == pytest.approx(student(9))


def test_a_headline_belongs_to_a_figure_of_its_case():
    with pytest.raises(ValueError, match="two"):
        evidence([], [], captions={"one": "Axes."}, headlines={"two": "Springs"})
