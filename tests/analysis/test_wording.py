"""Words change sides with their numbers: planted verdicts, signs and statuses."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.analysis.test_judged_claims import claim, evidence, point, points_with, verdicts
from validation.analysis.evidence import Verdict
from validation.analysis.wording import (
    by_status,
    by_verdict,
    decibels,
    farthest_off,
    highest_and_lowest_off,
    joint_verdict,
    sentence,
    share,
    title,
    too_loud,
)

AGREE, DIFFER, UNDECIDED = Verdict.AGREE, Verdict.DIFFER, Verdict.UNDECIDED


@given(verdicts)
def test_one_that_differs_decides_and_one_that_is_open_prevents_agreement(found):
    expected = DIFFER if DIFFER in found else UNDECIDED if UNDECIDED in found else AGREE
    assert joint_verdict(points_with(found)) is expected
    assert by_verdict(points_with(found), agree="agree", differ="differ", undecided="undecided") == expected


def test_nothing_has_no_verdict():
    with pytest.raises(ValueError, match="got none"):
        joint_verdict([])


@pytest.mark.parametrize(
    ("found", "said"),
    [
        ([AGREE, AGREE], "It is"),
        ([AGREE, DIFFER], "It is (below 1)"),
        ([DIFFER, AGREE], "It is not"),
        ([UNDECIDED, UNDECIDED], "It may be"),
    ],
)
def test_the_words_of_a_claim_are_those_of_its_status(found, said):
    numbers = points_with(found)
    limits = {"limits": "below 1", "inside": numbers[:1]} if found[0] is AGREE else {}
    assert by_status(claim(numbers, **limits), holds="It is", fails="It is not", undecided="It may be") == said


def test_only_what_differs_is_off_and_each_sign_has_its_own():
    high, higher, low, agreeing, open_ = (point(v, s, at=v) for v, s in ((3, 0), (5, 0), (-4, 0), (0.5, 0), (9, 9)))
    assert highest_and_lowest_off([high, low, agreeing, higher, open_]) == [higher, low]
    assert highest_and_lowest_off([low, agreeing]) == [low]
    assert highest_and_lowest_off([agreeing, open_]) == []
    assert farthest_off([high, low, agreeing, open_]) is low
    assert farthest_off([agreeing, open_]) is open_


@given(st.floats(0.1, 50))
def test_a_level_above_is_loud_and_below_quiet(decibels):
    assert too_loud(decibels) == f"{decibels:.1f} dB too loud"
    assert too_loud(-decibels) == f"{decibels:.1f} dB too quiet"


def test_counts_and_sentences():
    assert share(points_with([DIFFER, AGREE, DIFFER]), DIFFER) == "2 of 3"
    assert sentence("one thing", "", "another") == "One thing; another."
    assert title("one thing", "another") == "One thing; another"
    assert sentence() == title() == ""


def test_a_headline_belongs_to_a_figure_of_its_case():
    shown = {"captions": {"one": "Axes."}, "headlines": {"one": "Springs are 3 dB too loud"}}
    assert evidence([], [], **shown).headlines == shown["headlines"]
    with pytest.raises(ValueError, match="two"):
        evidence([], [], captions={"one": "Axes."}, headlines={"two": "Springs"})


@pytest.mark.parametrize(
    ("value", "half_width", "said"),
    [
        (0.24, 0.51, "+0.2 ± 0.5 dB"),
        (-1.26, 0.04, "-1.3 dB"),
        (-0.04, 0.01, "less than 0.05 dB"),
        (-0.04, 0.3, "+0.0 ± 0.3 dB"),
    ],
)
def test_a_level_has_an_interval_where_there_is_one(value, half_width, said):
    assert decibels(point(value, half_width)) == said
