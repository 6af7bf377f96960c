"""Thresholds of planted sweeps in octaves: on which side, by how much, and what is known where none is crossed."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.cases.test_limits import STEEP
from validation.analysis.evidence import Role, Verdict
from validation.cases.limits import limits
from validation.cases.limits.sweeps import Sweep

X = np.array([1.0, 2.0, 4.0, 8.0])


def swept(error, side="above", messages=("", "", "no", "no"), derived=False):
    """Past 2 the error must exceed 4, within a factor 1.5; they are told where they do."""
    judged = STEEP.judged._replace(derived=derived, warned=derived)
    limit = replace(STEEP, fails=STEEP.fails._replace(side=side), judged=judged)
    return Sweep(limit, X, np.array(error), 2.0, messages)


@pytest.mark.parametrize(
    ("error", "side", "octaves", "half"),
    [
        ([1.0, 2.0, 8.0, 9.0], "above", 0.5, 0.5),
        ([8.0, 2.0, 1.0, 1.0], "below", 0.5, 0.5),
        ([9.0, 9.0, 8.0, 2.0], "below", -1.5, 0.5),
        # none is crossed: it fails nowhere, or everywhere
        ([1.0, 1.0, 1.0, 1.0], "above", 2.0, 0.0),
        ([9.0, 9.0, 9.0, 9.0], "above", -1.0, 0.0),
        ([1.0, 1.0, 1.0, 1.0], "below", 1.0, 0.0),
        ([9.0, 9.0, 9.0, 9.0], "below", -2.0, 0.0),
        # it fails where it should not, and not where it should
        ([9.0, 1.0, 1.0, 1.0], "above", -1.0, 0.0),
        ([1.0, 1.0, 1.0, 9.0], "below", -2.0, 0.0),
    ],
)
def test_a_threshold_is_positive_where_it_fails_later(error, side, octaves, half):
    (number,) = limits.threshold(swept(error, side)).numbers
    assert (number.value, number.grid) == pytest.approx((octaves, half))
    assert number.tolerance == pytest.approx(math.log2(1.5)) and number.role is Role.FINDING


def test_what_follows_from_theory_alone_must_hold_and_all_warnings_count():
    right = swept([1.0, 2.0, 8.0, 9.0], derived=True)
    assert limits.threshold(right).numbers[0].role is Role.CRITERION
    (warned,) = limits.warnings(right).numbers
    assert (warned.value, warned.reference, warned.verdict) == (1.0, 1.0, Verdict.AGREE)
    assert (warned.role, warned.tolerance) == (Role.CRITERION, 0.0)
    (silent,) = limits.warnings(replace(right, messages=("", "", "", "no"))).numbers
    assert silent.value == pytest.approx(2 / 3) and silent.verdict is Verdict.DIFFER
    assert limits.warnings(swept([1.0, 2.0, 8.0, 9.0])).numbers[0].role is Role.FINDING


def test_a_limit_is_where_predicted_only_if_all_past_it_fail_and_its_message_is_the_nearest():
    assert swept([1.0, 2.0, 8.0, 9.0]).predicted and not swept([1.0, 2.0, 8.0, 1.0]).predicted
    assert swept([1.0, 2.0, 8.0, 9.0], messages=("early", "", "near", "far")).first_message == "near"
    assert swept([9.0, 2.0, 1.0, 1.0], "below", ("only", "", "", "far")).first_message == "only"
