"""What `report` prints: lines of 100 characters, a row a case, findings that are no failures, and how it ended."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from tests.report.remade import sections
from tests.report.test_claims import claim, section_of
from tests.seeded import catches
from validation.analysis.escapes import coloured
from validation.analysis.evidence import ClaimStatus, Role, Verdict, Whose
from validation.report.commands import run_cases
from validation.report.commands.arguments import Exit
from validation.report.commands.run_cases import (
    WIDTH,
    claims_text,
    closing_lines,
    heading_lines,
    lines_of,
    worst_number,
)

WITHIN, OUTSIDE, INCONCLUSIVE = Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE


def printed(of, status=Exit.MET, *, verbose=False):
    """All lines of a run in the quick size."""
    lines = [line for section in of for line in lines_of(section, verbose=verbose)]
    names = [section.name for section in of]
    return [*heading_lines(names, "quick", 2), *lines, *closing_lines(of, status, Path("out"), "about 2 hours")]


@catches("all claims without being asked for").at(
    "validation.report.commands.run_cases._is_refuted_statement", lambda claim: True
)
def test_the_committed_report_fits_into_seventy_lines_of_a_hundred_characters():
    lines = printed(sections())
    assert len(lines) <= 70 and max(map(len, lines)) <= WIDTH == 100
    every = printed(sections(), verbose=True)
    assert len(every) > 2 * len(lines) and max(map(len, every)) <= WIDTH


def test_a_row_counts_checks_and_claims():
    for section in sections():
        row = lines_of(section)[0]
        assert row.startswith(section.name)
        counts = re.match(r"\S+ +(?:(\d+) of (\d+)|none)((?: +\d+){3})?", row)
        if section.criteria:
            assert int(counts[2]) == section.criteria
        statuses = [claim.status for claim in section.claims]
        if statuses:
            supported, refuted, inconclusive = map(int, counts[3].split())
            assert supported + refuted + inconclusive == len(statuses)
            assert refuted == statuses.count(ClaimStatus.REFUTED)


@catches("a deviation within tolerance for one outside", verdicts=(WITHIN, OUTSIDE), worst=1).at(
    "validation.report.commands.run_cases.worst_number", lambda section: section.numbers[0]
)
@pytest.mark.parametrize(
    ("verdicts", "worst"), [((WITHIN, OUTSIDE), 1), ((OUTSIDE, INCONCLUSIVE), 0), ((WITHIN, INCONCLUSIVE, WITHIN), 1)]
)
def test_the_largest_deviation_is_of_a_number_outside_tolerance_first(verdicts, worst):
    section = section_of(claim(verdicts))
    assert run_cases.worst_number(section) is section.numbers[worst]


def test_a_difference_that_a_claim_states_is_no_deviation():
    assert worst_number(section_of(claim([OUTSIDE], confirmed_by=OUTSIDE))) is None


@pytest.mark.parametrize("whose", Whose)
def test_a_refuted_statement_of_others_is_a_finding_and_no_failure(whose):
    text = "\n".join(printed([section_of(claim([OUTSIDE], whose=whose))]))
    of_others = whose is not Whose.HYPOTHESIS
    assert (f"finding on {whose}, refuted: It is so. It is 1 to 9." in text) is of_others
    assert "not passed" not in text and "0 supported, 1 refuted, 0 inconclusive" in text


@catches("a failed check behind a green end", role=Role.CRITERION, status=Exit.CRITERION_FAILED).at(
    "validation.report.commands.run_cases._status_of", lambda sections: Exit.MET
)
@pytest.mark.parametrize(("role", "status"), [(Role.FINDING, Exit.MET), (Role.CRITERION, Exit.CRITERION_FAILED)])
def test_the_end_says_the_exit_status(role, status):
    section = section_of(claim([OUTSIDE]))
    numbers = tuple(replace(number, role=role) for number in section.numbers)
    section = replace(section, evidence=replace(section.evidence, numbers=numbers, claims=()))
    assert run_cases._status_of([section]) is status
    *_, last = printed([section], status)
    assert last == {0: "exit status 0: no checks in these cases", 1: "exit status 1: 1 of 1 checks not passed"}[status]


def test_claims_are_counted_with_those_within_limits():
    limited = replace(claim([WITHIN, OUTSIDE]), limits="below 1", inside=claim([WITHIN]).numbers)
    assert claims_text([claim([WITHIN]), limited, claim([OUTSIDE])]) == (
        "2 supported (1 within limits), 1 refuted, 0 inconclusive"
    )


class Terminal:
    """Standard output that is a terminal."""

    @staticmethod
    def isatty():
        return True


def test_colour_is_for_terminals_and_changes_no_word(monkeypatch):
    text = "x: outside tolerance\nexit status 0: all 3 checks passed"
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm")
    assert coloured(text) == text
    monkeypatch.setattr("sys.stdout", Terminal())
    assert coloured(text) != text and re.sub(r"\x1b\[\d+m", "", coloured(text)) == text
    monkeypatch.setenv("NO_COLOR", "1")
    assert coloured(text) == text
