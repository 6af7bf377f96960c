"""Claims on planted numbers: their members, limits and words change sides with the verdicts."""

from dataclasses import replace
from itertools import takewhile

import pytest
from hypothesis import given

from tests.analysis.test_judged_claims import point, points_with, verdicts
from tests.seeded import catches
from validation.analysis import claim_text
from validation.analysis.case import Outcomes, Study
from validation.analysis.claim_text import (
    NOT_THIS_CURVE,
    AnswerPattern,
    Direction,
    HeadlinePattern,
    answer_pattern,
    headline_pattern,
)
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import OF_NUMBERS, ClaimStatus, Role, Verdict, Whose
from validation.analysis.number_text import decibels, enumeration
from validation.analysis.ranges import verdict_ranges
from validation.analysis.series import Margin, Series

AGREE, DIFFER, UNDECIDED = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE
VALUE = {AGREE: (0.2, 0.1), DIFFER: (3.0, 0.1), UNDECIDED: (1.0, 0.3)}
"""dB and half-width of a number with each verdict within 1 dB."""


def number(verdict, quantity="level", model="m", **where):
    value, half = VALUE[verdict]
    return point(value, half, quantity=quantity, model=model, where=where)


def by_height(*verdicts, **key):
    return [number(verdict, **key, **{"h/d": 0.1 * 10**i}) for i, verdict in enumerate(verdicts)]


CLAIM = Claim(says="It is so.", short="A model agrees with another", quantity="level", along="h/d")


def outcome_of(claim, numbers):
    return claim.outcome(claim.numbers(numbers))


@pytest.mark.parametrize(
    ("verdicts", "status", "limits", "worst"),
    [
        ((AGREE, AGREE, AGREE), ClaimStatus.SUPPORTED, (), 0.1),
        ((AGREE, AGREE, DIFFER), ClaimStatus.LIMITED, (0.1, 1.0), 10.0),
        # one tested point of a range is no range
        ((AGREE, UNDECIDED, AGREE), ClaimStatus.INCONCLUSIVE, (), 1.0),
        ((AGREE, DIFFER, DIFFER), ClaimStatus.REFUTED, (), 1.0),
        ((DIFFER, AGREE, AGREE), ClaimStatus.REFUTED, (), 0.1),
    ],
)
def test_status_limits_and_worst_place_follow_from_verdicts(verdicts, status, limits, worst):
    outcome, judged = outcome_of(CLAIM, by_height(*verdicts)), CLAIM.judged(by_height(*verdicts))
    assert (outcome.status, outcome.limits, outcome.worst_place) == (status, limits, {"h/d": worst})
    assert (judged.status, judged.inside) == (status, outcome.inside)
    assert bool(judged.limits) == bool(outcome.inside) == bool(limits)


def test_an_outcome_has_the_size_and_the_direction_of_the_number_that_decides():
    numbers = [point(value, 0.1, where={"q a": (1.0, 4.0), "worst at": 2.0}) for value in (-3.0, 0.5)]
    outcome = outcome_of(Claim(), numbers)
    assert (outcome.direction, outcome.size, outcome.half_width, outcome.tolerance) == (Direction.BELOW, 3.0, 0.1, 1.0)
    assert (outcome.worst_place, outcome.range) == ({"q a": 2.0}, (1.0, 4.0))
    assert not outcome.is_single and outcome.has_one_tolerance and outcome.labels == ()
    above, equal = (outcome_of(Claim(), [point(value)]) for value in (0.5, 0.0))
    assert (above.direction, equal.direction) == (Direction.ABOVE, Direction.EQUAL)
    assert above.is_single and above.range is None


def ranges_of_whatever_agrees(places, verdicts):
    return verdict_ranges(*zip(*sorted(zip(places, verdicts, strict=True), key=by_verdict), strict=True))


def by_verdict(row):
    return OF_NUMBERS.index(row[1])


@catches("limits of whatever agrees").at("validation.analysis.claims.verdict_ranges", ranges_of_whatever_agrees)
@given(verdicts)
def test_limits_are_the_first_piece_of_a_range(found):
    """What agrees behind a counterexample is outside of the limits."""
    numbers = points_with(found)
    inside = Claim(says="It is so.", along="q a").judged(numbers).inside
    assert inside == (numbers[: len(inside)] if set(found) != {AGREE} else ())
    assert all(number.verdict is AGREE for number in inside) and len(inside) != 1
    first = list(takewhile(lambda verdict: verdict is AGREE, found))
    assert len(inside) == (len(first) if 1 < len(first) < len(found) else 0)


@pytest.mark.parametrize(
    ("verdicts", "only_within", "inconclusive"),
    [
        ((AGREE, UNDECIDED, UNDECIDED, DIFFER), (0.1,), (1.0, 10.0)),
        ((AGREE, AGREE, UNDECIDED, DIFFER), (), (10.0,)),
        ((AGREE, UNDECIDED), (0.1,), ()),
        ((UNDECIDED, DIFFER), (), ()),
        ((AGREE, AGREE), (), ()),
    ],
)
def test_what_is_no_limit_is_within_tolerance_only_and_what_follows_is_inconclusive(
    verdicts, only_within, inconclusive
):
    outcome = outcome_of(CLAIM, by_height(*verdicts))
    assert (outcome.only_within, outcome.inconclusive) == (only_within, inconclusive)


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


@catches("a number without the condition taken for one beyond the limits", verdict=DIFFER, limits="").at(
    "validation.analysis.claims.Claim._without_place", lambda claim, numbers: []
)
@pytest.mark.parametrize(("verdict", "limits"), [(AGREE, "up to h/d = 1"), (DIFFER, ""), (UNDECIDED, "")])
def test_a_number_without_the_condition_must_agree_whatever_the_limits(verdict, limits):
    everywhere = number(verdict)
    judged = CLAIM.judged([*by_height(AGREE, AGREE), everywhere, number(DIFFER, **{"h/d": 9.0})])
    assert judged.status is (ClaimStatus.LIMITED if limits else ClaimStatus.REFUTED)
    assert judged.limits == limits and (everywhere in judged.inside) == (verdict is AGREE)


def test_a_number_without_the_condition_has_no_place_in_the_answer():
    """Whether it decides, or is inconclusive beside others at their places."""
    refuted = CLAIM.judged([*by_height(AGREE, AGREE), number(DIFFER), number(UNDECIDED, **{"h/d": 9.0})])
    assert refuted.answer == ("Refuted: +3.00 ± 0.10 dB, tolerance 1 dB; within tolerance only at h/d = 0.1 to 1.")
    numbers = [*by_height(AGREE, AGREE, UNDECIDED), number(UNDECIDED), number(DIFFER, **{"h/d": 90.0})]
    assert CLAIM.judged(numbers).answer == (
        "Refuted: +3.00 ± 0.10 dB at h/d = 90, tolerance 1 dB; within tolerance only at h/d = 0.1 to 1; "
        "inconclusive at h/d = 10."
    )


def in_their_order(numbers, name):
    return {n.where[name]: [other for other in numbers if other.where[name] == n.where[name]] for n in numbers}


@catches("limits along places as they come").at("validation.analysis.claims.by_place", in_their_order)
def test_limits_are_along_values_in_ascending_order():
    """Another quantity differs at 0.5, below the largest height at which the first agrees."""
    numbers = [*by_height(AGREE, AGREE, AGREE), *by_height(AGREE, quantity="slope")]
    numbers.append(number(DIFFER, quantity="slope", **{"h/d": 0.5}))
    judged = Claim(says="It is so.", along="h/d").judged(numbers)
    assert (judged.status, judged.limits) == (ClaimStatus.REFUTED, "")


@pytest.mark.parametrize(
    ("places", "limits", "rest"),
    [
        (("a", "b", 0.5, "d"), "from a to 0.5", "Supported for a, within 1 dB; inconclusive for b and 0.5; elsewhere "),
        ((0.5, "b", "c", "d"), "from 0.5 to c", "; within tolerance only at g = 0.5; inconclusive for b and c."),
    ],
)
def test_places_are_named_where_a_region_is_among_them(places, limits, rest):
    def judged(*verdicts):
        return Claim(along="g").judged([number(v, g=place) for v, place in zip(verdicts, places, strict=True)])

    assert judged(AGREE, AGREE, AGREE, DIFFER).limits == limits
    assert rest in judged(AGREE, UNDECIDED, UNDECIDED, DIFFER).answer


def test_limits_need_a_number_of_each_quantity():
    numbers = [*by_height(AGREE, DIFFER), *by_height(DIFFER, DIFFER, quantity="rms of level")[1:]]
    assert Claim(says="It is so.", along="h/d").judged(numbers).status is ClaimStatus.REFUTED


def test_a_claim_that_things_differ_is_confirmed_by_that():
    claim = Claim(says="They differ.", short="They differ", differ=True)
    judged = claim.judged(by_height(DIFFER, DIFFER))
    assert (judged.status, judged.confirmed_by) == (ClaimStatus.SUPPORTED, DIFFER)
    assert outcome_of(claim, [point(5.0), point(-2.0)]).number.value == -2.0
    alike = outcome_of(claim, by_height(AGREE, DIFFER))
    assert (alike.status, alike.worst_place, alike.differ) == (ClaimStatus.REFUTED, {"h/d": 0.1}, True)


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


def test_whose_statement_a_claim_is_is_checked_where_it_is_made():
    with pytest.raises(TypeError, match=r"^whose of the claim 'level' must be one of Whose\.BOOK, .*, got 'the book'$"):
        Claim(key="level", whose="the book")
    assert [Whose(whose.earlier) for whose in Whose] == list(Whose)


def test_an_identity_tests_no_claim_and_stands_in_a_matrix():
    same = replace(number(AGREE, across="ridges"), role=Role.IDENTITY)
    claim, matrix = Claim(says="It is so."), Matrix(name="t", quantity="level", rows=("across",), columns="model")
    assert claim.judged([same, *by_height(DIFFER)]).numbers == tuple(by_height(DIFFER))
    assert [str(cell) for cell in matrix.table([same]).columns["m"]] == ["+0.20 ± 0.10 dB: within tolerance"]


ANSWERS = {
    AnswerPattern.SUPPORTED: [
        ((AGREE, AGREE), {}, "Supported, within 1 dB: at worst +0.20 ± 0.10 dB at h/d = 0.1."),
        ((AGREE,), {}, "Supported, within 1 dB: +0.20 ± 0.10 dB at h/d = 0.1."),
    ],
    AnswerPattern.SUPPORTED_DIFFERENCE: [
        (
            (DIFFER, DIFFER),
            {"differ": True},
            "Supported, by more than 1 dB: the nearest is +3.00 ± 0.10 dB at h/d = 0.1.",
        )
    ],
    AnswerPattern.LIMITED: [
        (
            (AGREE, AGREE, UNDECIDED, DIFFER),
            {"along": "h/d"},
            "Supported up to h/d = 1, within 1 dB; inconclusive at h/d = 10; beyond that +3.00 ± 0.10 dB at h/d = 100.",
        )
    ],
    AnswerPattern.LIMITED_INCONCLUSIVE: [
        (
            (AGREE, AGREE, UNDECIDED),
            {"along": "h/d"},
            "Supported up to h/d = 1, within 1 dB; inconclusive beyond that: +1.00 ± 0.30 dB at h/d = 10.",
        )
    ],
    AnswerPattern.INCONCLUSIVE: [
        (
            (AGREE, UNDECIDED),
            {"along": "h/d"},
            "Inconclusive within 1 dB: +1.00 ± 0.30 dB at h/d = 1; within tolerance only at h/d = 0.1.",
        )
    ],
    AnswerPattern.REFUTED: [
        (
            (AGREE, UNDECIDED, UNDECIDED, DIFFER),
            {"along": "h/d"},
            "Refuted: +3.00 ± 0.10 dB at h/d = 100, tolerance 1 dB; within tolerance only at h/d = 0.1; "
            "inconclusive at h/d = 1 to 10.",
        ),
        (
            (DIFFER,),
            {"no": NOT_THIS_CURVE},
            "We do not get this curve: +3.00 ± 0.10 dB at h/d = 0.1, tolerance 1 dB.",
        ),
    ],
    AnswerPattern.REFUTED_DIFFERENCE: [
        ((DIFFER, AGREE), {"differ": True}, "Refuted: +0.20 ± 0.10 dB at h/d = 1, within 1 dB.")
    ],
}


@pytest.mark.parametrize(
    ("pattern", "verdicts", "changes", "answer"),
    [(pattern, *row) for pattern, rows in ANSWERS.items() for row in rows],
)
def test_the_answer_is_one_sentence_of_the_number_that_decides(pattern, verdicts, changes, answer):
    """The size, where it is worst, and the limit, whatever else was measured."""
    claim, numbers = Claim(says="It is so.", **changes), by_height(*verdicts)
    assert answer_pattern(outcome_of(claim, numbers)) is pattern
    assert claim.judged(numbers).answer == answer


def test_among_several_tolerances_the_answer_has_that_of_the_number_that_decides():
    """0.3 of 0.1 is farther off than 3 dB of 2; among several margins none stands for all."""
    refuted, supported = (
        [point(value, model=model, tolerance=tolerance) for value, model, tolerance in rows]
        for rows in (((3.0, "a", 2.0), (0.3, "b", 0.1)), ((1.0, "a", 2.0), (0.09, "b", 0.1)))
    )
    for numbers in (refuted, supported):
        outcome = outcome_of(Claim(), numbers)
        assert (outcome.labels, outcome.tolerance, outcome.has_one_tolerance) == (("b",), 0.1, False)
    assert answer_pattern(outcome) is AnswerPattern.SUPPORTED_BY_TOLERANCES
    answer = Claim().judged(supported).answer
    assert answer == "Supported: at worst +0.09 dB at q a = 1 (b), within 0.1 dB."
    assert {*ANSWERS, AnswerPattern.SUPPORTED_BY_TOLERANCES} == set(AnswerPattern)


AGREEMENT, OTHER = "A model agrees with another", "MDR is stiffer"
HEADLINES = {
    HeadlinePattern.SUPPORTED: ((AGREE, AGREE), OTHER, f"{OTHER}: at worst +0.20 ± 0.10 dB at h/d = 0.1"),
    HeadlinePattern.SUPPORTED_AGREEMENT: ((AGREE, AGREE), AGREEMENT, f"{AGREEMENT} within 1 dB"),
    HeadlinePattern.LIMITED: ((AGREE, AGREE, DIFFER), OTHER, f"{OTHER} up to h/d = 1"),
    HeadlinePattern.LIMITED_AGREEMENT: (
        (AGREE, AGREE, DIFFER),
        AGREEMENT,
        f"{AGREEMENT} within 1 dB up to h/d = 1",
    ),
    HeadlinePattern.REFUTED: ((DIFFER,), OTHER, f"Not so that {OTHER}: +3.00 ± 0.10 dB at h/d = 0.1"),
    HeadlinePattern.REFUTED_AGREEMENT: (
        (DIFFER,),
        AGREEMENT,
        "A model differs from another: +3.00 ± 0.10 dB at h/d = 0.1",
    ),
    HeadlinePattern.INCONCLUSIVE: (
        (UNDECIDED,),
        OTHER,
        f"Inconclusive whether {OTHER}: +1.00 ± 0.30 dB at h/d = 0.1",
    ),
    HeadlinePattern.INCONCLUSIVE_AGREEMENT: (
        (UNDECIDED,),
        AGREEMENT,
        "Inconclusive whether a model agrees with another within 1 dB: +1.00 ± 0.30 dB at h/d = 0.1",
    ),
}


@pytest.mark.parametrize("pattern", HeadlinePattern)
def test_a_headline_is_a_clause_with_the_tolerance_or_the_number_that_decides(pattern):
    verdicts, clause, headline = HEADLINES[pattern]
    claim, numbers = replace(CLAIM, short=clause), by_height(*verdicts)
    assert headline_pattern(outcome_of(claim, numbers), clause) is pattern
    assert claim.headline(claim.judged(numbers)) == headline


def test_a_clause_that_things_differ_is_no_agreement():
    """ "Agree with" in its clause is another verb's object: it is not turned, and has no tolerance."""
    for verdict, pattern in ((DIFFER, HeadlinePattern.SUPPORTED), (AGREE, HeadlinePattern.REFUTED)):
        outcome = outcome_of(replace(CLAIM, differ=True), by_height(verdict))
        assert headline_pattern(outcome, AGREEMENT) is pattern


def test_the_rest_of_a_range_lies_below_beyond_or_elsewhere():
    names = [number(v, g=g) for v, g in ((AGREE, "a"), (AGREE, "b"), (AGREE, "c"), (DIFFER, "d"))]
    rows = [
        ("below that", "-h/d", by_height(DIFFER, AGREE, AGREE)),
        ("beyond that", "h/d", by_height(AGREE, AGREE, DIFFER)),
        ("elsewhere", "-quantity", OF_QUANTITIES),
        ("elsewhere", "g", names[1:]),
        ("beyond that", "g", names),
    ]
    for text, along, numbers in rows:
        assert f"; {text} +3.00" in Claim(along=along).judged(numbers).answer


def test_among_those_that_agree_the_interval_counts_too():
    near, wide = (point(v, s, where={"h/d": at}) for v, s, at in ((0.5, 0.0, 1.0), (0.2, 0.7, 2.0)))
    assert outcome_of(Claim(), [near, wide]).number == wide


@pytest.mark.parametrize(
    ("where", "said"),
    [
        ({"h/d": 1.0, "q a": (1.0, 4.0), "worst at": 2.0}, " at h/d = 1, q a = 2"),
        ({"over ISO 3095 [dB]": 10.0}, " at 10 dB over ISO 3095"),
        ({"band": "below it", "f [Hz]": (177.0, 1402.0)}, ", below it, f = 177 to 1402 Hz"),
        ({}, ""),
    ],
)
def test_a_worst_point_is_at_its_place_and_names_follow_after_a_comma(where, said):
    answer = Claim(says="It is so.").judged([point(3.0, 0.1, quantity="level", model="m", where=where)]).answer
    assert answer == f"Refuted: +3.00 ± 0.10 dB{said}, tolerance 1 dB."


def test_numbers_are_printed_by_the_printer_of_the_claim():
    numbers = [point(3.0, 0.1)]
    assert "+3.0 ± 0.1 dB" in Claim(printed=decibels).judged(numbers).answer
    assert "+3.0 ± 0.1 dB" in (claim := Claim(short="c", printed=decibels)).headline(claim.judged(numbers))


def test_names_are_listed_apart_from_the_commas_that_they_have():
    assert [enumeration(["a"]), enumeration(["a", "b"]), enumeration(["a", "b", "c"])] == ["a", "a and b", "a, b and c"]
    assert enumeration(["a, 1", "b", "c"]) == "a, 1; b; c"


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


@pytest.mark.parametrize("keys", ["aab", "abb", "aba"])
def test_two_claims_of_one_key_are_refused(keys):
    """Others find a claim by its key; claims that nobody looks for have none, and their words may be the same."""
    with pytest.raises(ValueError, match=f"got twice: {max(keys, key=keys.count)}$"):
        Study(title="t", method="", series=lambda _: [], claims=[Claim(says=str(i), key=k) for i, k in enumerate(keys)])
    claims = Claim(says="It is so."), Claim(says="It is so."), Claim(key="a"), Claim(key="b")
    assert Study(title="t", method="", series=lambda _: [], claims=claims).claims == claims


@pytest.mark.parametrize(
    ("places", "text"),
    [
        ((0.1,), "at h/d = 0.1"),
        ((3.0, 1.0, 2.0), "at h/d = 1 to 3"),
        (((5.0, 10.0), (0.0, 5.0)), "at h/d = 0 to 10"),
        (((2.0, 2.0),), "at h/d = 2"),
    ],
)
def test_places_are_named_from_the_least_to_the_largest_whatever_their_order(places, text):
    outcome = outcome_of(CLAIM, by_height(AGREE))
    assert claim_text._places_text(outcome, places) == text
