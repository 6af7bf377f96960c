"""A verdict names the conditions on which it depends, and no others."""

import pytest

from tests.analysis.test_declared_claims import number
from tests.seeded import catches
from validation.analysis.claims import Claim, alone
from validation.analysis.evidence import Verdict

AGREE, DIFFER, UNDECIDED = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE
HURSTS = (0.4, 0.7, 1.0)
LETTERS = {"a": AGREE, "d": DIFFER, "u": UNDECIDED}


def at(letter, **where):
    return number(LETTERS[letter], **where)


def by_hurst(letters, values=(0.4, 0.55, 0.7, 0.85, 1.0)):
    return [at(letter, H=h) for letter, h in zip(letters, values, strict=True)]


@catches(
    "exponents between those that differ named with them", letters="dadad", verdict=DIFFER, said="H = 0.4, 0.7 and 1"
).at("validation.analysis.claims._in_a_row", lambda *_: True)
@pytest.mark.parametrize(
    ("letters", "verdict", "said"),
    [
        ("aaaud", DIFFER, "H = 1 alone"),
        ("aaaud", UNDECIDED, "H = 0.85 alone"),
        ("aaaud", AGREE, "H = 0.4 to 0.7"),
        ("uaaaa", UNDECIDED, "H = 0.4 alone"),
        ("ddddu", DIFFER, "H = 0.4 to 0.85"),
        ("daaad", DIFFER, "H = 0.4 and 1"),
        ("dadad", DIFFER, "H = 0.4, 0.7 and 1"),
        ("ddddd", DIFFER, ""),
        ("aaaaa", DIFFER, ""),
    ],
)
def test_values_of_a_condition_that_alone_have_a_verdict_are_named(letters, verdict, said):
    assert alone(by_hurst(letters), verdict) == said
    # in whichever order they come
    assert alone(by_hurst(letters)[::-1], verdict) == said


def test_one_value_has_the_verdict_of_its_worst_number():
    numbers = [at("a", H=0.4, q=1.0), at("d", H=0.4, q=2.0), at("a", H=1.0, q=1.0), at("a", H=1.0, q=2.0)]
    assert alone(numbers, DIFFER) == "H = 0.4, q = 2 alone"
    assert alone(numbers, DIFFER, ("H",)) == "q = 2 alone"


def test_a_value_does_not_have_a_verdict_that_its_worst_number_has_not():
    """One number that differs is enough against it, and one that is undecided keeps it from agreeing."""
    numbers = [at(letter, H=h, q=q) for letter, h, q in (("a", 0.4, 1.0), ("a", 0.4, 2.0), ("a", 1.0, 1.0))]
    assert alone([*numbers, at("d", H=1.0, q=2.0)], AGREE, ("q",)) == "H = 0.4 alone"
    assert alone([*numbers, at("u", H=1.0, q=2.0)], AGREE, ("q",)) == "H = 0.4 alone"
    undecided = [at("u", H=0.4, q=1.0), at("u", H=1.0, q=1.0), at("d", H=1.0, q=2.0)]
    assert alone(undecided, UNDECIDED, ("q",)) == "H = 0.4 alone"


def test_conditions_are_named_until_they_explain_the_verdict():
    """A second one that goes with the first, or a range over which a number is the worst, adds nothing."""
    numbers = [
        at(letter, H=h, load=10 * h, q=(1.0, 5 + h), **{"worst at": h}) for letter, h in (("a", 0.4), ("d", 1.0))
    ]
    assert alone(numbers, DIFFER) == "H = 1 alone"


def test_names_of_a_condition_stand_by_themselves():
    wheels = ("50 kN, 920 mm", "50 kN, 360 mm", "25 kN, 920 mm")
    numbers = [at(letter, wheel=wheel) for letter, wheel in zip("ada", wheels, strict=True)]
    assert alone(numbers, DIFFER) == "50 kN, 360 mm alone"
    assert alone(numbers, AGREE) == "50 kN, 920 mm and 25 kN, 920 mm"


def claimed(*rows):
    """A claim along F, up to which it may hold: a row of letters for the values of H at each F."""
    numbers = [
        at(letter, H=h, F=float(i + 1))
        for i, letters in enumerate(rows)
        for letter, h in zip(letters, HURSTS, strict=True)
    ]
    return Claim(along="F").saying("c").judged(numbers).answer


def test_limits_of_a_claim_name_the_condition_on_which_they_depend():
    assert "inconclusive at F = 3 (H = 0.4 alone); beyond that" in claimed("aaa", "aaa", "uaa", "ddd")
    assert "H = 1, F = 3 (H = 1 alone)" in claimed("aaa", "aaa", "aad")
    assert "(" not in claimed("aaa", "aaa", "ddd")
    assert "(H = 0.4 and 0.7)" in claimed("ddu", "aaa")
