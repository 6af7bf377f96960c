"""Answers of cases on planted numbers: no strip or scene is chosen, no worst band stands without its interval."""

import pytest

from tests.analysis.test_judged_claims import point
from validation.analysis.evidence import ClaimStatus
from validation.cases.punch.mdr_limits import DEVIATION, STUDY
from validation.cases.rolling import reduced_models as reduced
from validation.cases.wheel import half_space_evidence, spectrum_evidence
from validation.cases.wheel.half_space_levels import LINEAR_3D
from validation.cases.wheel.half_space_numbers import LEVEL, OVER_BEM
from validation.cases.wheel.spectrum_evidence import of_period


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


@pytest.mark.parametrize(
    ("moved", "status", "begins"),
    [
        (None, ClaimStatus.HOLDS, "Yes: found."),
        (point(0.2, at=2.0), ClaimStatus.HOLDS, "Yes: found; q a = 2: 0.2 beside 0 dB (agree"),
        (point(5.0, at=2.0), ClaimStatus.LIMITED, "Within limits (Table 14.1): found; q a = 2: 5 beside 0 dB (differ"),
    ],
)
def test_the_period_is_judged_for_the_worst_scene_too(moved, status, begins):
    judged = of_period(point(0.1), moved, "found", "Table 14.1")
    assert judged.status is status
    assert judged.answer.startswith(begins)


def test_the_break_of_the_worst_scene_has_a_claim():
    assert any("break" in claim for claim in spectrum_evidence.MOVED.values())


def test_the_worst_band_is_printed_with_its_interval():
    """It may lie nearer to the reference than the mean: then its interval is what makes it the worst."""
    model, where = OVER_BEM[LINEAR_3D], {"range": "region 3"}
    bands = [point(0.4, 0.1, model=model, quantity=LEVEL, where=where | {"band": i}) for i in (1.0, 2.0)]
    worst = point(0.03, 1.5, model=model, quantity=LEVEL, where=where)
    said = half_space_evidence.over_range(worst, bands, LINEAR_3D)
    assert said == "region 3 +0.4 dB in the mean, +0.0 ± 1.5 dB in the worst one-third octave"


def test_a_ratio_that_says_nothing_is_not_quoted_as_the_largest():
    """From few surfaces 7.7 dB may be 11 dB wide: what is quoted is the ratio that differs, with its interval."""
    numbers = [point(7.7, 11.0, quantity=DEVIATION), point(-8.4, 4.4, quantity=DEVIATION, at=2.0)]
    (claim,) = (claim for claim in STUDY.claims if claim.quantity == DEVIATION)
    assert claim.judged(numbers).answer == "No: 0.38 times (0.23 to 0.63) at q a = 2 (0 of 2 agree)."
