"""Ranges of equal verdict, and the conditions on which a verdict depends, and no others."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.analysis.test_declared_claims import number, outcome_of
from tests.seeded import catches
from validation.analysis import ranges
from validation.analysis.claim_text import alone_text, conditions_text
from validation.analysis.claims import Claim
from validation.analysis.evidence import OF_NUMBERS, Verdict
from validation.analysis.ranges import (
    SeparatingCondition,
    common_verdict,
    ends_of,
    separating_conditions,
    verdict_ranges,
    worst_place,
)
from validation.analysis.series import worst

AGREE, DIFFER, UNDECIDED = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE
HURSTS = (0.4, 0.7, 1.0)
LETTERS = {"a": AGREE, "d": DIFFER, "u": UNDECIDED}


def at(letter, **where):
    return number(LETTERS[letter], **where)


def by_hurst(letters, values=(0.4, 0.55, 0.7, 0.85, 1.0)):
    return [at(letter, H=h) for letter, h in zip(letters, values, strict=True)]


@given(st.lists(st.tuples(st.sampled_from(OF_NUMBERS), st.sampled_from("ab")), max_size=9))
def test_neighbours_of_one_verdict_are_one_range(rows):
    """All places, once each and in their order; no two neighbouring ranges have one verdict and one condition."""
    places = [float(i) for i in range(len(rows))]
    parts = verdict_ranges(places, [verdict for verdict, _ in rows], [condition for _, condition in rows])
    assert [place for part in parts for place in part.places] == places
    for part in parts:
        assert set(part.items(rows)) == {(part.verdict, part.split)} and part.items(places) == list(part.places)
        assert (part.start, part.stop) == (part.places[0], part.places[-1])
    pairs = [(part.verdict, part.split) for part in parts]
    assert all(pair != other for pair, other in pairwise(pairs))


def test_a_range_ends_where_its_places_do_and_a_region_has_no_ends():
    (part,) = verdict_ranges([(0.1, 1.0), (1.0, 10.0)], [AGREE, AGREE])
    assert (part.start, part.stop, part.split) == (0.1, 10.0, None)
    assert ends_of(2.0) == (2.0, 2.0)
    with pytest.raises(TypeError, match="ridges"):
        ends_of("ridges")
    with pytest.raises(ValueError, match="zip"):
        verdict_ranges([1.0, 2.0], [AGREE])


@given(st.lists(st.sampled_from("adu"), min_size=1))
def test_numbers_have_the_verdict_of_their_worst(letters):
    numbers = [at(letter) for letter in letters]
    assert common_verdict(numbers) is worst(numbers).verdict


def test_the_worst_place_stands_in_that_of_its_range():
    where = {"H": 1.0, "q a": (1.0, 4.0), "f": 2.0, "worst at": 3.0}
    assert list(worst_place(at("d", **where)).items()) == [("H", 1.0), ("q a", 3.0), ("f", 2.0)]


def separated(numbers, verdict, named=()):
    return {condition.name: condition.values for condition in separating_conditions(numbers, verdict, named)}


separate = ranges._separate


def always_a_range(name, parts):
    return (condition := separate(name, parts)) and replace(condition, is_range=True)


@catches(
    "exponents between those that differ named with them",
    letters="dadad",
    verdict=DIFFER,
    values=(0.4, 0.7, 1.0),
    is_range=False,
).at("validation.analysis.ranges._separate", always_a_range)
@pytest.mark.parametrize(
    ("letters", "verdict", "values", "is_range"),
    [
        ("aaaud", DIFFER, (1.0,), False),
        ("aaaud", UNDECIDED, (0.85,), False),
        ("aaaud", AGREE, (0.4, 0.55, 0.7), True),
        ("uaaaa", UNDECIDED, (0.4,), False),
        ("ddddu", DIFFER, (0.4, 0.55, 0.7, 0.85), True),
        ("daaad", DIFFER, (0.4, 1.0), False),
        ("ddaaa", DIFFER, (0.4, 0.55), False),
        ("dadad", DIFFER, (0.4, 0.7, 1.0), False),
    ],
)
def test_values_of_a_condition_that_alone_have_a_verdict_are_named(letters, verdict, values, is_range):
    expected = (SeparatingCondition("H", values, is_range),)
    assert separating_conditions(by_hurst(letters), verdict) == expected
    # in whichever order they come
    assert separating_conditions(by_hurst(letters)[::-1], verdict) == expected


def test_a_verdict_of_all_or_of_none_depends_on_no_condition():
    assert separating_conditions(by_hurst("ddddd"), DIFFER) == separating_conditions(by_hurst("aaaaa"), DIFFER) == ()


def test_more_than_four_values_are_named_as_a_range_or_not_at_all():
    values = tuple(float(i) for i in range(10))
    assert separated(by_hurst("dddddaaaaa", values), DIFFER) == {"H": values[:5]}
    assert separated(by_hurst("dadadadada", values), DIFFER) == {}


def test_one_value_has_the_verdict_of_its_worst_number():
    numbers = [at("a", H=0.4, q=1.0), at("d", H=0.4, q=2.0), at("a", H=1.0, q=1.0), at("a", H=1.0, q=2.0)]
    assert separated(numbers, DIFFER) == {"H": (0.4,), "q": (2.0,)}
    assert separated(numbers, DIFFER, ("H",)) == {"q": (2.0,)}


def test_a_value_does_not_have_a_verdict_that_its_worst_number_has_not():
    """One number that differs is enough against it, and one that is undecided keeps it from agreeing."""
    numbers = [at(letter, H=h, q=q) for letter, h, q in (("a", 0.4, 1.0), ("a", 0.4, 2.0), ("a", 1.0, 1.0))]
    for letter in "du":
        assert separated([*numbers, at(letter, H=1.0, q=2.0)], AGREE, ("q",)) == {"H": (0.4,)}
    undecided = [at("u", H=0.4, q=1.0), at("u", H=1.0, q=1.0), at("d", H=1.0, q=2.0)]
    assert separated(undecided, UNDECIDED, ("q",)) == {"H": (0.4,)}


def test_conditions_are_named_until_they_explain_the_verdict():
    """A second one that goes with the first, or a range over which a number is the worst, adds nothing."""
    numbers = [
        at(letter, H=h, load=10 * h, q=(1.0, 5 + h), **{"worst at": h}) for letter, h in (("a", 0.4), ("d", 1.0))
    ]
    assert separated(numbers, DIFFER) == {"H": (1.0,)}


def test_names_of_a_condition_are_values_in_the_order_of_the_numbers():
    wheels = ("50 kN, 920 mm", "50 kN, 360 mm", "25 kN, 920 mm")
    numbers = [at(letter, wheel=wheel) for letter, wheel in zip("ada", wheels, strict=True)]
    assert separated(numbers, DIFFER) == {"wheel": wheels[1:2]}
    assert separated(numbers, AGREE) == {"wheel": (wheels[0], wheels[2])}


@pytest.mark.parametrize(
    ("values", "is_range", "text"),
    [
        ((1.0,), False, "H = 1 alone"),
        ((0.4, 1.0), False, "H = 0.4 and 1"),
        ((0.4, 0.7, 1.0), False, "H = 0.4, 0.7 and 1"),
        ((0.4, 0.55, 0.7), True, "H = 0.4 to 0.7"),
        (("ridges",), False, "ridges alone"),
        (("50 kN, 920 mm", "50 kN, 360 mm", "b"), False, "50 kN, 920 mm; 50 kN, 360 mm and b"),
    ],
)
def test_a_condition_is_named_with_its_values(values, is_range, text):
    condition = SeparatingCondition("H", values, is_range)
    assert alone_text([condition]) == text and conditions_text([condition]) == text.removesuffix(" alone")


def test_several_conditions_are_alone_where_each_has_a_single_value():
    one, two = SeparatingCondition("H", (0.4,), False), SeparatingCondition("q", (1.0, 2.0), False)
    assert alone_text([one, one]) == "H = 0.4, H = 0.4 alone"
    assert alone_text([one, two]) == "H = 0.4, q = 1 and 2"
    assert alone_text([]) == conditions_text([]) == ""


def claimed(*rows):
    """A claim along F, up to which it may hold: a row of letters for the values of H at each F."""
    return [
        at(letter, H=h, F=float(i + 1))
        for i, letters in enumerate(rows)
        for letter, h in zip(letters, HURSTS, strict=True)
    ]


def test_limits_of_a_claim_name_the_condition_on_which_they_depend():
    claim = Claim(along="F")
    open_at = outcome_of(claim, claimed("aaa", "aaa", "uaa", "ddd"))
    assert (open_at.inconclusive, open_at.inconclusive_conditions[0].values) == ((3.0,), (0.4,))
    (condition,) = outcome_of(claim, claimed("aaa", "aaa", "aad")).conditions
    assert condition == SeparatingCondition("H", (1.0,), False)
    assert outcome_of(claim, claimed("aaa", "aaa", "ddd")).conditions == ()
    assert outcome_of(claim, claimed("ddu", "aaa")).conditions[0].values == (0.4, 0.7)
    # ranges that depend on other values each are named without any
    assert outcome_of(claim, claimed("aaa", "aaa", "uaa", "aau", "ddd")).inconclusive_conditions == ()
    answer = claim.judged(claimed("aaa", "aaa", "uaa", "add")).answer
    assert "inconclusive at F = 3 (H = 0.4 alone); beyond that" in answer and answer.endswith("(H = 0.7 and 1).")
