"""A claim has the colour, words and counts of the numbers that test it; a run answers the statements of the book."""

import re
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markupsafe import Markup

from tests.report.remade import sections
from tests.report.test_printed import evidence_with, html_of, number
from tests.seeded import catches
from validation.analysis.claims import Claim
from validation.analysis.evidence import OF_NUMBERS, ClaimStatus, JudgedClaim, Role, Verdict, Whose
from validation.report import formats
from validation.report.chapter import ENTRIES, ERRATA, REMARKS, ChapterEntry, ChapterTest, answers, chapter_results
from validation.report.commands.run_cases import lines_of
from validation.report.contents import CASES, TIMED
from validation.report.section import Section, case_results, total_of

AGREE, DIFFER, UNDECIDED = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE
OFF = {AGREE: (0.0, 0.0), DIFFER: (9.0, 0.0), UNDECIDED: (0.1, 1.0)}
"""Difference and half-width of a number with each verdict."""
found = st.lists(st.sampled_from(OF_NUMBERS), min_size=1, max_size=5)


def numbers_with(verdicts, **changes):
    return tuple(
        number(1.0 + OFF[verdict][0], sample=OFF[verdict][1], quantity=f"y{i}", role=Role.FINDING, **changes)
        for i, verdict in enumerate(verdicts)
    )


def claim(verdicts, **changes):
    numbers = numbers_with(verdicts)
    return JudgedClaim(claim="It is so.", answer="It is 1 to 9.", numbers=numbers, **changes)


def section_of(*claims, name="geike"):
    numbers = tuple({n.label: n for claim in claims for n in claim.numbers}.values())
    return Section(name, CASES[name], "none", {}, evidence_with(numbers, claims=claims))


def badges(text):
    """Class and words of all badges."""
    return re.findall(r'<span class="verdict ([^"]*)">(.*?)</span>', text)


def summary(section):
    """The list of claims on the front page, and the head of the case, up to what is folded."""
    text = html_of(section)
    head = text.index(f'<section class="case" id="{section.name}"')
    return listed(text) + text[head : text.index("<details", head)]


def listed(text):
    claims = text.index('<h2 id="asked"')
    return text[claims : text.index("</section>", claims)]


WITHIN = {"limits": "below 1", "inside": numbers_with([AGREE])}

# --- no green badge above a refutation ---


@catches(
    "a refuted claim under a green badge",
    verdicts=[Verdict.WITHIN, Verdict.OUTSIDE],
    changes={},
    words="✗ refuted",
).at(
    "validation.report.formats.format_status", lambda status, **_: Markup('<span class="verdict holds">✓ holds</span>')
)
@pytest.mark.parametrize(
    ("verdicts", "changes", "words"),
    [
        ([AGREE, AGREE], {}, "✓ supported"),
        ([DIFFER], {"confirmed_by": DIFFER}, "✓ supported"),
        ([AGREE, DIFFER], {}, "✗ refuted"),
        ([AGREE], {"confirmed_by": DIFFER}, "✗ refuted"),
        ([AGREE, UNDECIDED], {}, "? inconclusive"),
        ([AGREE, DIFFER], WITHIN, "(✓) supported within limits"),
    ],
)
def test_a_status_has_its_word_and_sign(verdicts, changes, words):
    some = claim(verdicts, whose=Whose.BOOK, **changes)
    text = summary(section_of(some))
    assert badges(text) == 2 * [(some.status.replace(" ", "-"), words)]
    assert text.count("It is 1 to 9.") == 1
    assert lines_of(section_of(some), verbose=True)[1].endswith(f"{some.status}: It is so. It is 1 to 9.")


def test_the_front_page_lists_statements_of_the_book_and_of_the_field_alone():
    whose = [Whose.HYPOTHESIS, Whose.BOOK, Whose.LITERATURE, Whose.BOOK]
    some = [
        replace(claim([AGREE]), claim=f"Claim {i}.", whose=one, numbers=numbers_with([AGREE], model=f"m{i}"))
        for i, one in enumerate(whose)
    ]
    text = html_of(section_of(*some))
    assert re.findall(r"Claim \d", listed(text)) == ["Claim 1", "Claim 2", "Claim 3"]
    # with the address of each on the page of its chapter
    addresses = re.findall(r'href="exact.html#(claim-[^"]*)"', listed(text))
    assert len(set(addresses)) == 3 and all(f'id="{address}"' in text for address in addresses)


def test_every_status_is_known_without_colour():
    """A sign and a border of its own in the style of the page."""
    assert set(formats.STATUS_SYMBOL) == set(ClaimStatus) and len(set(formats.STATUS_SYMBOL.values())) == len(
        ClaimStatus
    )
    style = html_of(section_of(claim([AGREE]))).partition("</style>")[0]
    names = [status.replace(" ", "-") for status in ClaimStatus]
    borders = [re.search(rf"\.{name} {{[^}}]*border-style: (\w+)", style) for name in names]
    assert len({border[1] if border else "solid" for border in borders}) == len(names)


def test_each_claim_of_a_case_has_a_row_of_its_own():
    other = replace(claim([DIFFER]), claim="It is otherwise.", numbers=numbers_with([DIFFER], model="m"))
    section = section_of(replace(claim([AGREE]), whose=Whose.BOOK), replace(other, whose=Whose.LITERATURE))
    assert [name for name, _ in badges(listed(html_of(section)))] == ["supported", "refuted"]
    assert total_of([section, section]) == "claims: supported 2, refuted 2"
    assert "Claims: supported 1, refuted 1," in html_of(section)


def test_results_hold_every_claim():
    (row,) = case_results(section_of(claim([AGREE, DIFFER], **WITHIN)))["claims"]
    assert (row["status"], row["whose"], row["limits"]) == ("holds within limits", "findings of ours", "below 1")
    assert row["stated_by"] == "our hypothesis" and Whose(row["whose"]) is Whose.HYPOTHESIS
    assert row["verdicts"] == {"agree": 1, "differ": 1, "undecided": 0}
    assert (row["numbers"], row["inside"]) == (["y0", "y1"], ["y0"])


def test_a_case_without_a_result_has_no_status():
    failed = Section("geike", CASES["geike"], "none", {}, None, ("why",))
    assert {name for name, _ in badges(html_of(failed))} == {"no-result"}


def test_a_case_that_is_played_alone_has_neither_status_nor_numbers():
    text = html_of(Section("rail_sound", CASES["rail_sound"], "none", {}, evidence_with([])))
    assert badges(text) == [] and "Claim under test" not in text and "0 numbers" not in text


# --- the book ---


def test_every_equation_figure_and_table_of_the_chapter_has_an_entry():
    places = " ".join(entry.place for entry in ENTRIES)
    for place in (*(f"(14.{i})" for i in range(1, 21)), *(f"Fig. 14.{i}" for i in range(1, 6)), "Table 14.1"):
        assert place in places, place


def test_every_case_and_every_claim_of_a_timed_case_that_is_named_exists():
    """No test runs timed cases whole, as `test_a_case_gives_equal_bytes` runs all others and finds what is named."""
    for test in (test for entry in ENTRIES for test in entry.tests):
        keys = [claim.key for claim in (CASES | TIMED)[test.case].study.claims]
        assert not test.claim or test.claim in keys
        assert test.case in CASES or not test.quantity


def test_every_claim_has_a_key_of_its_own_in_its_case():
    for name, case in (CASES | TIMED).items():
        keys = [claim.key for claim in case.study.claims]
        assert all(keys) and len(set(keys)) == len(keys), name


def test_claims_of_a_report_from_before_there_were_keys_have_those_of_their_words():
    for section in sections():
        declared = [claim.key for claim in section.entry.study.claims]
        # a claim that a case no longer makes keeps its key until the report is remade
        written = [claim.key for claim in section.claims]
        assert {(section.name, key) for key in written if key not in declared} <= {("interface", "area-and-gap")}
        assert [key for key in written if key in declared] == [key for key in declared if key in written]
        assert all(claim.key for claim in section.claims)


def test_an_entry_is_tested_or_says_why_not_and_a_test_names_numbers_or_a_claim():
    assert all(bool(entry.tests) != bool(entry.untested) for entry in ENTRIES)
    assert not any(test.quantity and test.claim for entry in ENTRIES for test in entry.tests)


def entry(**test):
    return ChapterEntry(place="(14.1)", statement="So it is written.", tests=(ChapterTest(case="geike", **test),))


@given(found)
def test_a_statement_has_the_status_of_its_numbers(verdicts):
    """One by one: of the first alone, which nothing else moves."""
    section = section_of(claim(verdicts))
    (answer,) = answers(entry(quantity="y0"), [section])
    expected = {AGREE: ClaimStatus.SUPPORTED, DIFFER: ClaimStatus.REFUTED, UNDECIDED: ClaimStatus.INCONCLUSIVE}
    assert answer["outcome"] is expected[verdicts[0]] and answer["status"] == expected[verdicts[0]].earlier
    (whole,) = answers(entry(), [section])
    assert whole["outcome"] is section.claims[0].status
    assert whole["answer"] == "Tested as “It is so.” It is 1 to 9."


@catches("a statement of the book answered by numbers of another model", test={"quantity": "y0", "model": "m"}).at(
    "validation.report.chapter.Claim", lambda model, **more: Claim(**more)
)
@catches(
    "a statement of the book answered outside of its assumptions", test={"quantity": "y0", "where": {"h/d": 0.01}}
).at("validation.report.chapter.Claim", lambda where, **more: Claim(**more))
@pytest.mark.parametrize(
    "test",
    [
        {"quantity": "y9"},
        {"claim": "no such words"},
        {"quantity": "identity"},
        {"quantity": "y0", "model": "m"},
        {"quantity": "y0", "where": {"h/d": 0.01}},
    ],
)
def test_a_key_that_no_number_has_leaves_no_status(test):
    some = claim([AGREE])
    identity = number(quantity="identity", role=Role.IDENTITY)
    section = Section("geike", CASES["geike"], "none", {}, evidence_with([*some.numbers, identity], claims=[some]))
    (answer,) = answers(entry(**test), [section])
    assert answer == {"case": "geike", "status": None, "outcome": None, "answer": "This run has no number for it."}
    assert "no result" in formats.format_status(answer["outcome"])


def test_the_page_and_the_results_answer_the_book():
    """With links; a case that is not in the report has no answer."""
    section = section_of(claim([AGREE]))
    rows = chapter_results([section])
    assert {a["case"] for row in rows for a in row["answers"]} == {"geike"}
    assert all(row["answers"] or row["untested"] for row in rows)
    text = html_of(section)
    book = text[(begin := text.index('id="book"')) : text.index("<footer", begin)]
    assert book.count('<a href="exact.html#geike">geike</a>') == sum(len(row["answers"]) for row in rows)
    assert all(row["place"] in book for row in (*ERRATA, *REMARKS))
    assert chapter_results([section_of(claim([AGREE]), name="rail_sound")]) == []
