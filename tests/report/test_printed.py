"""What is printed belongs to its data: cells of pages and files, words and signs of verdicts, numbers in sentences."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis.contents import as_csv, as_written
from validation.analysis.evidence import (
    OF_NUMBERS,
    Evidence,
    Number,
    Role,
    Table,
    Verdict,
    VerdictCell,
)
from validation.analysis.number_text import plus_minus
from validation.report import drawing, formats, page
from validation.report.contents import CASES
from validation.report.section import Section, case_results, numbers_table

# --- the page, files ---


def number(value=1.0, **changes):
    settings = {"reference": 1.0, "source": "s", "tolerance": 0.1, "reason": "r", "unit": "dB", **changes}
    return Number(**{"quantity": "x", "value": value, **settings})


def evidence_with(numbers, page_tables=(), claims=()):
    return Evidence(
        title="t",
        method="c",
        numbers=tuple(numbers),
        tables=(Table("t", {"x": [1.0]}),),
        conclusions=(),
        captions={},
        page_tables=tuple(page_tables),
        claims=tuple(claims),
    )


ABOUT = {
    **dict.fromkeys(("python", "system", "processor", "cores", "workers"), ""),
    **{part: {} for part in ("libraries", "seeds", "kept", "seconds", "timed")},
    **{"version": "1.2.3", "commit": "abc1234"},
}


def html_of(*sections, **about):
    """The front page, and those of the chapters."""
    pages = page.pages(sections, "full", {**ABOUT, **about}, None)
    return pages.pop("index.html").decode() + "".join(chapter.decode() for chapter in pages.values())


def test_rows_of_the_file_and_of_the_results_are_the_numbers():
    numbers = [
        number(1.234567, reference=1.2, tolerance=0.5, grid=0.0123, sample=0.0456, quantity="agrees"),
        number(-3.5, reference=2.5, tolerance=0.25, grid=0.031, quantity="differs", unit="rad/s"),
        number(7.25, reference=7.0, tolerance=0.5, sample=0.9, quantity="open", unit="-", role=Role.FINDING),
    ]
    table = numbers_table(numbers)
    rows = case_results(Section("geike", CASES["geike"], "none", {}, evidence_with(numbers)))["numbers"]
    for name in ("verdict", "unit", "role", "value", "reference", "difference", "grid", "sample", "tolerance"):
        expected = [getattr(number, name) for number in numbers]
        assert table[name].tolist() == [row["outcome" if name == "verdict" else name] for row in rows] == expected
    assert [row["verdict"] for row in rows] == ["agree", "differ", "undecided"]
    assert [row["outcome"] for row in rows] == ["within tolerance", "outside tolerance", "inconclusive"]
    assert [row["met"] for row in rows] == [True, False, None]


@catches("two signs of verdicts exchanged").at(
    "validation.report.formats.SYMBOL", dict(zip(OF_NUMBERS, "≠✓?", strict=True))
)
def test_every_verdict_has_its_word_and_sign():
    assert dict(zip(OF_NUMBERS, "✓≠?", strict=True)) == formats.SYMBOL
    assert dict(zip(OF_NUMBERS, "=≠?", strict=True)) == drawing.SIGN
    for verdict, symbol in formats.SYMBOL.items():
        assert formats.format_cell(VerdictCell("+3 %", Verdict(verdict), "more")) == (
            f'+3 %<br><span class="verdict {verdict.css}">{symbol} {verdict}</span>; more'
        )
    assert formats.format_cell("<a> & b") == "&lt;a&gt; &amp; b" and formats.format_cell(0.123456) == "0.1235"


def test_an_interval_is_empty_where_nothing_scatters_and_comes_back():
    table = Table("t", {"low": [1.0, 2.5, math.nan], "value": [2.0, 2.5, math.nan], "high": [3.0, 2.5, math.nan]})
    assert as_csv(table, drawn=True).decode().splitlines() == ["low,value,high", "1,2,3", ",2.5,", ",,"]
    for name, column in as_written(table).columns.items():
        np.testing.assert_array_equal(column, table[name])


# --- words ---


@pytest.mark.parametrize(
    ("value", "half", "text"),
    [
        (12640.4, 110.0, "12640 ± 110"),
        (12640.4, 0.0, "12640"),
        (1.5, 1.04, "1.5 ± 1.0"),
        (1.0, 2e-9, "1 ± 2e-09"),
        (1.0, 2.4e-6, "1.0000000 ± 0.0000024"),
        (1.0, 2.4e-7, "1 ± 2.4e-07"),
        (-0.04, 1.5, "0.0 ± 1.5"),
    ],
)
def test_values_with_intervals_of_all_sizes(value, half, text):
    assert plus_minus(value, half) == text


def test_a_number_in_a_sentence():
    n = number(1.25, reference=1.0, tolerance=0.5, grid=0.02, sample=0.03)
    assert n.sentence == "x = 1.25 dB ± 0.05 dB, within tolerance: reference 1 dB, tolerance 0.5 dB"
    assert replace(n, unit="-").sentence == "x = 1.25 ± 0.05, within tolerance: reference 1, tolerance 0.5"
