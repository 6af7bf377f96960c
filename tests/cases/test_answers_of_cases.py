"""Answers of cases on planted numbers: no strip or scene is chosen, no worst band stands without its interval."""

from tests.analysis.test_judged_claims import point
from validation.analysis.evidence import ClaimStatus
from validation.cases.punch.mdr_limits import DEVIATION, STUDY
from validation.cases.rolling import reduced_models as reduced


def strip(slope, value, half):
    return point(value, half, quantity=reduced.OFF, model=reduced.READ, where={"h' a/d": slope})


AT_LIMIT = reduced.STUDY.claims[2]


def test_strips_on_both_sides_of_a_limit_count():
    """0.687 is as near to 1 / sqrt(2) as 0.728: the strip that is open there keeps the claim open."""
    judged = AT_LIMIT.judged([strip(0.571, 1.5, 0.6), strip(0.728, 2.7, 0.6), strip(0.687, 1.6, 1.0), strip(1.9, 6, 2)])
    assert {number.where["h' a/d"] for number in judged.numbers} == {0.687, 0.728}
    assert judged.status is ClaimStatus.OPEN


def test_where_no_strip_is_at_the_limit_the_roughest_below_it_counts():
    (one,) = AT_LIMIT.numbers([strip(0.2, 3.0, 0.1), strip(0.8, 3.0, 0.1)])
    assert one.where["h' a/d"] == 0.8


def test_a_ratio_that_says_nothing_is_not_quoted_as_the_largest():
    """From few surfaces 7.7 dB may be 11 dB wide: what is quoted is the ratio that differs, with its interval."""
    numbers = [point(7.7, 11.0, quantity=DEVIATION), point(-8.4, 4.4, quantity=DEVIATION, at=2.0)]
    (claim,) = (claim for claim in STUDY.claims if claim.quantity == DEVIATION)
    assert claim.judged(numbers).answer == "No: 0.38 times (0.23 to 0.63) at q a = 2 (0 of 2 agree)."
