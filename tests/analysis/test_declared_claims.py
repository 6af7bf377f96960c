"""Claims on planted numbers: their members, limits and words change sides with the verdicts."""

import math
from dataclasses import replace
from itertools import takewhile

import pytest
from hypothesis import given

from tests.analysis.test_judged_claims import point, points_with, verdicts
from tests.seeded import catches
from validation.analysis.claims import NOT_THIS_CURVE, Claim, Matrix
from validation.analysis.evidence import ClaimStatus, Role, Verdict
from validation.analysis.number_text import (
    decibels,
    decibels_rms,
    off_by,
    per_cent,
    times,
    times_source,
    with_reference,
)
from validation.analysis.series import Margin, Series
from validation.analysis.study import Outcomes, Study

AGREE, DIFFER, UNDECIDED = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE
VALUE = {AGREE: (0.2, 0.1), DIFFER: (3.0, 0.1), UNDECIDED: (1.0, 0.3)}
"""dB and half-width of a number with each verdict within 1 dB."""


def number(verdict, quantity="level", model="m", **where):
    value, half = VALUE[verdict]
    return point(value, half, quantity=quantity, model=model, where=where)


def by_height(*verdicts, **key):
    return [number(verdict, **key, **{"h/d": 0.1 * 10**i}) for i, verdict in enumerate(verdicts)]


CLAIM = Claim(says="It is so.", short="A model agrees with another", quantity="level", along="h/d")


@pytest.mark.parametrize(
    ("verdicts", "status", "limits", "headline"),
    [
        ((AGREE, AGREE, AGREE), ClaimStatus.SUPPORTED, "", "A model agrees with another within 1 dB"),
        (
            (AGREE, AGREE, DIFFER),
            ClaimStatus.LIMITED,
            "up to h/d = 1",
            "A model agrees with another within 1 dB up to h/d = 1",
        ),
        # one tested point of a range is no range
        (
            (AGREE, UNDECIDED, AGREE),
            ClaimStatus.INCONCLUSIVE,
            "",
            "Inconclusive whether a model agrees with another within 1 dB: +1.00 ± 0.30 dB at h/d = 1",
        ),
        (
            (AGREE, DIFFER, DIFFER),
            ClaimStatus.REFUTED,
            "",
            "A model differs from another: +3.00 ± 0.10 dB at h/d = 1",
        ),
        (
            (DIFFER, AGREE, AGREE),
            ClaimStatus.REFUTED,
            "",
            "A model differs from another: +3.00 ± 0.10 dB at h/d = 0.1",
        ),
    ],
)
def test_status_limits_and_headline_follow_from_verdicts(verdicts, status, limits, headline):
    judged = CLAIM.judged(by_height(*verdicts))
    assert (judged.status, judged.limits) == (status, limits)
    assert CLAIM.headline(judged) == headline


@catches("limits of whatever agrees").at("validation.analysis.claims.takewhile", filter)
@given(verdicts)
def test_limits_are_the_first_piece_of_a_range(found):
    """What agrees behind a counterexample is outside of the limits."""
    numbers = points_with(found)
    inside = Claim(says="It is so.", along="q a").judged(numbers).inside
    assert inside == (numbers[: len(inside)] if set(found) != {AGREE} else ())
    assert all(number.verdict is AGREE for number in inside) and len(inside) != 1
    first = list(takewhile(lambda verdict: verdict is AGREE, found))
    assert len(inside) == (len(first) if 1 < len(first) < len(found) else 0)


def by_band(*verdicts):
    ends = ((1.0, 2.0), (2.0, 4.0), (4.0, 9.0))
    return [number(verdict, **{"q a": band}) for verdict, band in zip(verdicts, ends, strict=True)]


OF_QUANTITIES = [number(v, quantity=q) for q, v in (("height", DIFFER), ("gradient", AGREE), ("curvature", AGREE))]


@pytest.mark.parametrize(
    ("along", "numbers", "limits"),
    [
        ("-h/d", by_height(DIFFER, AGREE, AGREE), "from h/d = 1 on"),
        # one of several quantities ends them
        (
            "h/d",
            [*by_height(AGREE, AGREE, AGREE), *by_height(AGREE, AGREE, DIFFER, quantity="slope")],
            "up to h/d = 1",
        ),
        ("q a", by_band(AGREE, AGREE, DIFFER), "up to q a = 4"),
        ("-q a", by_band(DIFFER, AGREE, AGREE), "from q a = 2 on"),
        ("-quantity", OF_QUANTITIES, "in curvature and gradient"),
        ("g", [number(v, g=g) for v, g in ((AGREE, "a"), (AGREE, "b"), (AGREE, "c"), (DIFFER, "d"))], "from a to c"),
    ],
)
def test_limits_from_the_last_value_on_or_along_quantities(along, numbers, limits):
    judged = Claim(says="It is so.", along=along).judged(numbers)
    assert (judged.status, judged.limits) == (ClaimStatus.LIMITED, limits)


def test_limits_need_a_number_of_each_quantity():
    numbers = [*by_height(AGREE, DIFFER), *by_height(DIFFER, DIFFER, quantity="rms of level")[1:]]
    assert Claim(says="It is so.", along="h/d").judged(numbers).status is ClaimStatus.REFUTED


def test_a_claim_that_things_differ_is_confirmed_by_that():
    claim = Claim(says="They differ.", short="They differ", differ=True)
    judged = claim.judged(by_height(DIFFER, DIFFER))
    assert judged.status is ClaimStatus.SUPPORTED
    assert claim.headline(judged) == "They differ: the nearest is +3.00 ± 0.10 dB at h/d = 0.1"
    alike = claim.judged(by_height(AGREE))
    assert claim.headline(alike) == "Not so that they differ: +0.20 ± 0.10 dB at h/d = 0.1"
    assert claim.judged(by_height(AGREE, DIFFER)).status is ClaimStatus.REFUTED


def test_a_matrix_has_a_column_for_each_quantity_that_it_names():
    matrix = Matrix(name="m", quantity=("level", "slope"), rows=("h/d",), columns="quantity")
    table = matrix.table(by_height(AGREE, DIFFER))
    assert list(table.columns) == ["h/d", "level", "slope"] and table.columns["slope"] == ["–", "–"]
    assert [cell.verdict for cell in table.columns["level"]] == [AGREE, DIFFER]
    assert matrix.table([]).columns == {"h/d": (), "level": [], "slope": []}


def test_members_are_chosen_by_quantity_model_and_conditions():
    numbers = [number(AGREE, model=m, across=a) for m in "ab" for a in ("ridges", "ground")] + by_height(
        AGREE, model="a"
    )

    def chosen(**choice):
        return [(n.model, *n.where.values()) for n in Claim(says="", **choice).numbers(numbers)]

    assert chosen(model="a", where={"across": ...}) == [("a", "ridges"), ("a", "ground")]
    assert chosen(model="a", where={"across": lambda across: across != "ridges"}) == [("a", "ground")]
    assert chosen(model=("a", "b"), where={"across": "ridges"}) == [("a", "ridges"), ("b", "ridges")]
    assert chosen(model="b", where={"across": float}) == [] and len(chosen(where={"h/d": float})) == 1
    both = ({"model": "b"}, {"where": {"h/d": 0.1}})
    assert chosen(either=both) == [("b", "ridges"), ("b", "ground"), ("a", 0.1)]


def test_an_identity_tests_no_claim_and_stands_in_a_matrix():
    same = replace(number(AGREE, across="ridges"), role=Role.IDENTITY)
    claim, matrix = Claim(says="It is so."), Matrix(name="t", quantity="level", rows=("across",), columns="model")
    assert claim.judged([same, *by_height(DIFFER)]).numbers == tuple(by_height(DIFFER))
    assert [str(cell) for cell in matrix.table([same]).columns["m"]] == ["+0.20 ± 0.10 dB: within tolerance"]


@pytest.mark.parametrize(
    ("verdicts", "changes", "answer"),
    [
        ((AGREE, AGREE), {}, "Supported, within 1 dB: at worst +0.20 ± 0.10 dB at h/d = 0.1."),
        ((AGREE,), {}, "Supported, within 1 dB: +0.20 ± 0.10 dB at h/d = 0.1."),
        (
            (AGREE, AGREE, DIFFER),
            {"along": "h/d"},
            "Supported up to h/d = 1, within 1 dB; beyond that +3.00 ± 0.10 dB at h/d = 10.",
        ),
        (
            (AGREE, AGREE, UNDECIDED, DIFFER),
            {"along": "h/d"},
            "Supported up to h/d = 1, within 1 dB; inconclusive at h/d = 10; beyond that +3.00 ± 0.10 dB at h/d = 100.",
        ),
        (
            (AGREE, UNDECIDED, UNDECIDED, DIFFER),
            {"along": "h/d"},
            "Refuted: +3.00 ± 0.10 dB at h/d = 100, tolerance 1 dB; within tolerance only at h/d = 0.1; "
            "inconclusive at h/d = 1 to 10.",
        ),
        (
            (AGREE, UNDECIDED),
            {"along": "h/d"},
            "Inconclusive within 1 dB: +1.00 ± 0.30 dB at h/d = 1; within tolerance only at h/d = 0.1.",
        ),
        ((UNDECIDED, DIFFER), {}, "Refuted: +3.00 ± 0.10 dB at h/d = 1, tolerance 1 dB."),
        (
            (DIFFER,),
            {"no": NOT_THIS_CURVE},
            "We do not get this curve: +3.00 ± 0.10 dB at h/d = 0.1, tolerance 1 dB.",
        ),
        ((AGREE, UNDECIDED), {}, "Inconclusive within 1 dB: +1.00 ± 0.30 dB at h/d = 1."),
        (
            (DIFFER, DIFFER),
            {"differ": True},
            "Supported, by more than 1 dB: the nearest is +3.00 ± 0.10 dB at h/d = 0.1.",
        ),
        ((DIFFER, AGREE), {"differ": True}, "Refuted: +0.20 ± 0.10 dB at h/d = 1, within 1 dB."),
    ],
)
def test_the_answer_is_one_sentence_of_the_number_that_decides(verdicts, changes, answer):
    """The size, where it is worst, and the limit, whatever else was measured."""
    assert Claim(says="It is so.", **changes).judged(by_height(*verdicts)).answer == answer


@pytest.mark.parametrize(
    ("numbers", "answer"),
    [
        # 0.3 of 0.1 is farther off than 3 dB of 2; among several margins none stands for all
        ([(3.0, "a", 2.0), (0.3, "b", 0.1)], "Refuted: +0.3 dB at q a = 1 (b), tolerance 0.1 dB."),
        ([(1.0, "a", 2.0), (0.09, "b", 0.1)], "Supported: at worst +0.09 dB at q a = 1 (b), within 0.1 dB."),
    ],
)
def test_the_answer_has_the_margin_of_the_number_that_decides(numbers, answer):
    points = [point(value, 0.0, model=model, tolerance=tolerance) for value, model, tolerance in numbers]
    assert Claim(says="It is so.").judged(points).answer == answer


def test_the_rest_of_a_range_lies_below_beyond_or_elsewhere():
    below, elsewhere = (Claim(says="", along=a).judged(by_height(DIFFER, AGREE, AGREE)).answer for a in ("-h/d", "h/d"))
    assert "; below that" in below and elsewhere.startswith("Refuted")
    assert "; elsewhere" in Claim(says="", along="-quantity").judged(OF_QUANTITIES).answer


def test_among_those_that_agree_the_interval_counts_too():
    near, wide = (point(v, s, where={"h/d": at}) for v, s, at in ((0.5, 0.0, 1.0), (0.2, 0.7, 2.0)))
    assert "h/d = 2" in Claim(says="It is so.").judged([near, wide]).answer


@pytest.mark.parametrize(
    ("where", "said"),
    [
        ({"h/d": 1.0, "q a": (1.0, 4.0), "worst at": 2.0}, " at h/d = 1, q a = 2"),
        ({"over ISO 3095 [dB]": 10.0}, " at 10 dB over ISO 3095"),
        ({"band": "below it", "f [Hz]": (177.0, 1402.0)}, ", below it, f = 177 to 1402 Hz"),
    ],
)
def test_a_worst_point_is_at_its_place_and_names_follow_after_a_comma(where, said):
    answer = Claim(says="It is so.").judged([point(3.0, 0.1, quantity="level", model="m", where=where)]).answer
    assert answer == f"Refuted: +3.00 ± 0.10 dB{said}, tolerance 1 dB."


@pytest.mark.parametrize(
    ("printed", "value", "half_width", "said"),
    [
        (decibels, 0.24, 0.51, "+0.2 ± 0.5 dB"),
        (decibels, -1.26, 0.04, "-1.3 dB"),
        (decibels, -0.04, 0.01, "less than 0.05 dB"),
        (decibels, -0.04, 0.3, "+0.0 ± 0.3 dB"),
        (decibels_rms, 2.49, 0.0, "2.5 dB rms"),
        (times, 51.0, 0.0, "350 times (350 to 350)"),
        (times, -6.0, 1.0, "0.5 times (0.45 to 0.56)"),
        (per_cent, 20 * math.log10(2), 0.0, "+100.0 %"),
        (per_cent, 1.0, 0.0, "+12.2 %"),
        (per_cent, -1.0, 0.5, "-10.9 ± 5.3 %"),
        (per_cent, -40.0, 0.0, "none left"),
        (off_by, 1.0, 0.0, "off by +1.0e+00 dB"),
        (times_source, 0.5, 0.0, "0.5 times that of s"),
        (with_reference, 3.0, 0.1, "+3.00 ± 0.10 dB"),
    ],
)
def test_a_number_is_printed_as_its_quantity(printed, value, half_width, said):
    assert printed(point(value, half_width)) == said


def test_a_reference_of_five_digits_has_no_exponent():
    assert with_reference(point(12520.0, 190.0, reference=12566.4, tolerance=377.0)) == "12520 ± 190 beside 12566 dB"


def test_a_matrix_has_a_cell_for_each_number_with_its_verdict():
    places = [("a", AGREE, "ridges"), ("a", AGREE, "ground"), ("b", DIFFER, "ridges")]
    numbers = [number(verdict, model=model, across=across) for model, verdict, across in places]
    table = Matrix(name="t", quantity="level", rows=("across",), columns="model").table(numbers)
    assert table.columns["across"] == ("ridges", "ground")
    assert [str(cell) for cell in table.columns["a"]] == ["+0.20 ± 0.10 dB: within tolerance"] * 2
    assert [str(cell) for cell in table.columns["b"]] == ["+3.00 ± 0.10 dB: outside tolerance", "–"]


def test_a_claim_that_no_number_tests_is_told():
    """A name that is misspelt takes no claim away without a word."""
    series = Series("level", "springs", (0.1,), margin=Margin(1.0, "r"))
    claims = Claim(says="It is so.", quantity="level"), Claim(says="It is not.", model="spring")
    found = Study(title="t", method="", series=lambda result: [series], claims=claims).evidence(Outcomes(None, {}))
    assert [claim.claim for claim in found.claims] == ["It is so."]
    assert found.conclusions == ("No number tests the claim: It is not.",)


def test_a_cell_says_how_many_times_the_sample_would_decide():
    """0.3 left beside 0.2 of room takes (0.3 / 0.2)² = 2.25; beside 0.02 of room, too many to say."""
    numbers = [point(value, 0.3, where={"H": h}) for h, value in (("a", 0.8), ("b", 0.98), ("c", 0.2))]
    cells = Matrix(name="t", quantity="level", rows=("H",), columns="model").table(numbers).columns["m"]
    assert [cell.after for cell in cells] == ["needs 2.3 times the sample", "", ""]


def test_a_matrix_of_models_has_no_column_of_a_quantity_and_a_study_prints_what_it_names():
    matrix = Matrix(name="t", quantity=("level", "slope"), rows=("h/d",), columns="model")
    assert list(matrix.table(by_height(AGREE)).columns) == ["h/d", "m"]
    one, other = (Series(name, "m", (2.0,)) for name in ("level", "slope"))
    study = Study(title="t", method="m", series=lambda _: [one, other], claims=(), printed=("slope",))
    assert [table.name for table in study.evidence(Outcomes(None, {})).page_tables] == ["slope"]


def test_a_number_is_printed_beside_its_reference_with_the_digits_of_its_tolerance():
    near = point(1234.5, reference=1234.5678, tolerance=1.0)
    assert [with_reference(replace(near, tolerance=t)) for t in (1.0, 2.0)] == [
        "1234.5 beside 1234.57 dB",
        "1234.5 beside 1234.6 dB",
    ]
    assert [with_reference(point(x)) for x in (0.5, 0.0, -0.5)] == ["+0.5 dB", "0 dB", "-0.5 dB"]
