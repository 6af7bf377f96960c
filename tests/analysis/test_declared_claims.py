"""Claims on planted numbers: their members, limits and words change sides with the verdicts."""

from dataclasses import replace

import pytest
from hypothesis import given

from tests.analysis.test_judged_claims import point, points_with, verdicts
from validation.analysis.claims import (
    NOT_THIS_CURVE,
    Claim,
    Matrix,
    beside,
    decibels,
    off_by,
    per_cent,
    times,
    times_source,
)
from validation.analysis.evidence import ClaimStatus, Role, Verdict
from validation.analysis.series import Margin, Series
from validation.analysis.study import Outcomes, Study

AGREE, DIFFER, UNDECIDED = Verdict.AGREE, Verdict.DIFFER, Verdict.UNDECIDED
VALUE = {AGREE: (0.2, 0.1), DIFFER: (3.0, 0.1), UNDECIDED: (1.0, 0.3)}
"""dB and half-width of a number with each verdict within 1 dB."""


def number(verdict, quantity="level", model="m", **where):
    value, half = VALUE[verdict]
    return point(value, half, quantity=quantity, model=model, where=where)


def by_height(*verdicts, **key):
    return [number(verdict, **key, **{"h/d": 0.1 * 10**i}) for i, verdict in enumerate(verdicts)]


CLAIM = Claim(says="It is so.", short="It", quantity="level", along="h/d")


@pytest.mark.parametrize(
    ("verdicts", "status", "limits", "headline", "changes"),
    [
        ((AGREE, AGREE, AGREE), ClaimStatus.HOLDS, "", "agree within 1 dB", {}),
        ((AGREE, AGREE, DIFFER), ClaimStatus.LIMITED, "up to h/d = 1", "agree within 1 dB, up to h/d = 1", {}),
        ((AGREE, UNDECIDED, AGREE), ClaimStatus.LIMITED, "up to h/d = 0.1", "agree within 1 dB, up to h/d = 0.1", {}),
        ((DIFFER, AGREE, AGREE), ClaimStatus.CONTRADICTED, "", "+3.00 ± 0.10 dB at h/d = 0.1", {}),
        ((UNDECIDED, AGREE, AGREE), ClaimStatus.OPEN, "", "not decided within 1 dB", {}),
        ((DIFFER, DIFFER), ClaimStatus.HOLDS, "", "differ by more than 1 dB", {"differ": True}),
        ((AGREE, DIFFER), ClaimStatus.CONTRADICTED, "", "agree within 1 dB", {"differ": True, "along": ""}),
    ],
)
def test_status_limits_and_headline_follow_from_verdicts(verdicts, status, limits, headline, changes):
    claim = replace(CLAIM, **changes)
    judged = claim.judged(by_height(*verdicts))
    assert (judged.status, judged.limits) == (status, limits)
    assert claim.headline(judged) == f"It: {headline}"


@given(verdicts)
def test_limits_are_the_first_piece_of_a_range(found):
    """What agrees behind a counterexample is outside of the limits."""
    numbers = points_with(found)
    inside = Claim(says="It is so.", along="q a").judged(numbers).inside
    assert inside == (numbers[: len(inside)] if set(found) != {AGREE} else ())
    assert all(number.verdict is AGREE for number in inside)
    assert set(found) == {AGREE} or found[len(inside)] is not AGREE


def by_band(*verdicts):
    ends = ((1.0, 2.0), (2.0, 4.0), (4.0, 9.0))
    return [number(verdict, **{"q a": band}) for verdict, band in zip(verdicts, ends, strict=True)]


OF_QUANTITIES = [number(v, quantity=q) for q, v in (("height", DIFFER), ("gradient", AGREE), ("curvature", AGREE))]


@pytest.mark.parametrize(
    ("along", "numbers", "limits"),
    [
        ("-h/d", by_height(DIFFER, AGREE, AGREE), "from h/d = 1 on"),
        # one of several quantities ends them
        ("h/d", [*by_height(AGREE, AGREE), *by_height(AGREE, DIFFER, quantity="slope")], "up to h/d = 0.1"),
        ("q a", by_band(AGREE, AGREE, DIFFER), "up to q a = 4"),
        ("-q a", by_band(DIFFER, AGREE, AGREE), "from q a = 2 on"),
        ("-quantity", OF_QUANTITIES, "in curvature, gradient"),
    ],
)
def test_limits_from_the_last_value_on_or_along_quantities(along, numbers, limits):
    judged = Claim(says="It is so.", along=along).judged(numbers)
    assert (judged.status, judged.limits) == (ClaimStatus.LIMITED, limits)
    # no number of one quantity lies inside
    numbers = [*by_height(AGREE, DIFFER), *by_height(DIFFER, DIFFER, quantity="rms of level")[1:]]
    assert Claim(says="It is so.", along="h/d").judged(numbers).status is ClaimStatus.CONTRADICTED


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
    assert [str(cell) for cell in matrix.table([same]).columns["m"]] == ["+0.20 ± 0.10 dB: agree"]


@pytest.mark.parametrize(
    ("verdicts", "changes", "answer"),
    [
        ((AGREE, AGREE), {}, "Yes, within 1 dB: at worst +0.20 ± 0.10 dB at h/d = 0.1."),
        ((AGREE,), {}, "Yes, within 1 dB: +0.20 ± 0.10 dB at h/d = 0.1."),
        (
            (AGREE, DIFFER),
            {"along": "h/d"},
            "Yes up to h/d = 0.1, within 1 dB; beyond that +3.00 ± 0.10 dB at h/d = 1.",
        ),
        ((UNDECIDED, DIFFER), {}, "No: +3.00 ± 0.10 dB at h/d = 1, beyond 1 dB."),
        ((DIFFER,), {"no": NOT_THIS_CURVE}, "We do not get this curve: +3.00 ± 0.10 dB at h/d = 0.1, beyond 1 dB."),
        ((AGREE, UNDECIDED), {}, "Not decided within 1 dB: +1.00 ± 0.30 dB at h/d = 1."),
        ((DIFFER, DIFFER), {"differ": True}, "Yes, by more than 1 dB: at least +3.00 ± 0.10 dB at h/d = 0.1."),
        ((DIFFER, AGREE), {"differ": True}, "No: +0.20 ± 0.10 dB at h/d = 1, no more than 1 dB."),
    ],
)
def test_the_answer_is_one_sentence_of_the_number_that_decides(verdicts, changes, answer):
    """The size, where it is worst, and the limit, whatever else was measured."""
    assert Claim(says="It is so.", **changes).judged(by_height(*verdicts)).answer == answer


def placed(value, sample, where, **changes):
    return point(value, sample, **{"quantity": "level", "model": "m", "where": where} | changes)


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ([placed(3.0, 0.1, {"h/d": 1.0, "q a": (1.0, 4.0), "worst at": 2.0})], "+3.00 ± 0.10 dB at h/d = 1, q a = 2,"),
        (
            [placed(3.0, 0.1, {"band": "below it", "f [Hz]": (177.0, 1402.0)})],
            "+3.00 ± 0.10 dB, below it, f = 177 to 1402 Hz,",
        ),
        # of several models in its own margin: 0.3 of 0.1 is farther off than 3 dB of 2
        (
            [placed(v, 0.0, {"q a": 1.0}, model=m, tolerance=t) for v, m, t in ((3.0, "a", 2.0), (0.3, "b", 0.1))],
            "No: b +0.3 dB at q a = 1, beyond 0.1 dB.",
        ),
        # among those that agree the interval counts, too
        ([placed(0.5, 0.0, {"h/d": 1.0}), placed(0.2, 0.7, {"h/d": 2.0})], "at h/d = 2."),
    ],
)
def test_the_worst_point_is_named_with_its_place(numbers, said):
    assert said in Claim(says="It is so.").judged(numbers).answer


@pytest.mark.parametrize(
    ("printed", "number", "said"),
    [
        (decibels, point(0.24, 0.51), "+0.2 ± 0.5 dB"),
        (decibels, point(-1.26, 0.04), "-1.3 dB"),
        (decibels, point(-0.04, 0.01), "less than 0.05 dB"),
        (decibels, point(-0.04, 0.3), "+0.0 ± 0.3 dB"),
        (times, point(-6.0, 1.0), "0.5 times (0.45 to 0.56)"),
        (per_cent, point(1.0), "+12.2 % (+12.2 to +12.2)"),
        (per_cent, point(-40.0), "none left"),
        (off_by, point(1.0), "off by +1.0e+00 dB"),
        (times_source, point(0.5), "0.5 times that of s"),
        (beside, point(3.0, 0.1), "+3.00 ± 0.10 dB"),
        (beside, point(-0.5), "-0.5 dB"),
        (beside, point(0.0), "0 dB"),
        (beside, point(12520.0, 190.0, reference=12566.4, tolerance=377.0), "12520 ± 190 beside 12566 dB"),
        (beside, point(1234.5, reference=1234.5678, tolerance=1.0), "1234.5 beside 1234.57 dB"),
        (beside, point(1234.5, reference=1234.5678, tolerance=2.0), "1234.5 beside 1234.6 dB"),
    ],
)
def test_a_number_is_printed_as_its_quantity(printed, number, said):
    assert printed(number) == said


@pytest.mark.parametrize(
    ("columns", "found"),
    [
        ("model", {"a": ["+0.20 ± 0.10 dB: agree"] * 2, "b": ["+3.00 ± 0.10 dB: differ", "–"]}),
        # of several quantities, those that the matrix names
        ("quantity", {"level": ["+0.20 ± 0.10 dB: agree"] * 2, "slope": ["–", "–"]}),
    ],
)
def test_a_matrix_has_a_cell_for_each_number_with_its_verdict(columns, found):
    places = [("b", DIFFER, "ridges"), ("a", AGREE, "ridges"), ("a", AGREE, "ground")]
    numbers = [number(verdict, model=model, across=across) for model, verdict, across in places]
    matrix = Matrix(name="t", quantity=("level", "slope"), rows=("across",), columns=columns)
    table = matrix.table(numbers[columns == "quantity" :]).columns
    assert table.pop("across") == ("ridges", "ground")
    assert {name: [str(cell) for cell in cells] for name, cells in table.items()} == found
    assert list(matrix.table([]).columns) == ["across", *([] if columns == "model" else found)]


def test_a_study_prints_the_tables_that_it_names():
    one, other = (Series(name, "m", (2.0,)) for name in ("level", "slope"))
    study = Study(title="t", method="m", series=lambda _: [one, other], claims=(), printed=("slope",))
    assert [table.name for table in study.evidence(Outcomes(None, {})).page_tables] == ["slope"]


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
