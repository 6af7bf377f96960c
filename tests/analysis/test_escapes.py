"""Texts of users where they leave, and names of folders made of them: as data, and never as what a program acts on."""

import csv
import io
import json
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.seeded import catches
from validation.analysis import contents
from validation.analysis.contents import LONGEST_NAME, as_csv, as_json, folder_names
from validation.analysis.escapes import cell_text, is_printable, printable
from validation.analysis.evidence import Table

HOSTILE = "\x1b[2J\x07\r\u202eabc\u2066\u200b\udc80\x9b"
KINDS = {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}
"""Of Unicode: controls, formats (the direction of writing among them), halves of characters, and what is unknown."""


@given(st.text(st.characters()))
def test_a_printable_text_has_no_character_that_acts_and_all_others(text):
    kept = printable(text)
    assert {unicodedata.category(c) for c in kept}.isdisjoint(KINDS)
    assert is_printable(kept) and (kept == text) == is_printable(text)
    assert printable("a\n" + text, lines=True) == "a\n" + "\n".join(map(printable, text.split("\n")))


FORMULAS = [
    "=1+1",
    '=HYPERLINK("http://x")',
    "+1",
    "-1-1",
    "@SUM(A1)",
    "\t=1",
    "\r=1",
    " =1",
    "\uff1d1",
    "-2+3+cmd|' /C calc'!A0",
]


@catches("a cell that a spreadsheet computes", text="=1+1").at(
    "validation.analysis.contents.cell_text", contents.printable
)
@pytest.mark.parametrize("text", FORMULAS)
def test_a_text_that_a_spreadsheet_computes_is_quoted_in_every_cell_and_header(text):
    contents = as_csv(Table("it", {text: [text, "a"], "number": [-1.5, 2.0], "-": ["-", "="]})).decode()
    header, first, second = csv.reader(io.StringIO(contents))
    assert header[0] == first[0] == "'" + printable(text) and second[0] == "a"
    # numbers stay numbers, and a sign alone is none
    assert (first[1:], second[1:]) == (["-1.5", "-"], ["2", "="])


@given(st.text(st.characters()))
def test_a_cell_is_one_line_and_begins_with_nothing_that_computes(text):
    cell = cell_text(text)
    assert "\n" not in cell and is_printable(cell)
    assert len(cell) < 2 or cell.lstrip()[:1] not in set("=+-@\uff1d\uff0b\uff0d\uff20")


def test_tables_of_our_own_figures_stay_as_they_are():
    table = Table("it", {"model": ["-2 H - 3", "+0.1 / +0.2"], "value": [1.0, 2.0]})
    assert as_csv(table, drawn=True) == b"model,value\n-2 H - 3,1\n+0.1 / +0.2,2\n"


@catches("JSON as Python writes it").at(
    "validation.analysis.contents.json_text", lambda value: json.dumps(value, ensure_ascii=False)
)
@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_json_reads_back_and_has_no_character_that_acts(text):
    contents = as_json({text: [text, {"deep": {"deeper": {"deepest": text}}}]}).decode()
    assert json.loads(contents) == {text: [text, {"deep": {"deeper": {"deepest": text}}}]}
    assert is_printable(contents.replace("\n", ""))


def test_halves_of_characters_are_written_as_escapes():
    assert as_json({"a": HOSTILE}).count(b"\\udc80") == 1
    assert b"\\udc80" in as_csv(Table("it", {"a": [HOSTILE]}))


NAMES = [
    (["law (1)", "law [1]", "Law_1"], ["law_1", "law_1-2", "Law_1-3"]),
    (["con", "Aux.txt", "COM1", "lpt\u00b9", "console"], ["_con", "_Aux.txt", "_COM1", "_lpt\u00b9", "console"]),
    (["...", "/", "..", "a.", " a"], ["model", "model-2", "model-3", "a", "a-2"]),
    (["\u00e9", "e\u0301", "\u00c9"], ["\u00e9", "\u00e9-2", "\u00c9-3"]),
    (["stra\u00dfe", "STRASSE", "\ufb01t", "fit"], ["stra\u00dfe", "STRASSE-2", "\ufb01t", "fit-2"]),
    (["a", "a-2", "A", "a"], ["a", "a-2", "A-3", "a-4"]),
    (["../../etc/passwd", "C:\\x", "a\x00b"], ["etc_passwd", "C_x", "a_b"]),
]


@catches("folders that upper case alone tells apart", *NAMES[0]).at("validation.analysis.contents._as_stored", str)
@catches("folders with names of devices", *NAMES[1]).at("validation.analysis.contents.RESERVED", set())
@pytest.mark.parametrize(("texts", "names"), NAMES)
def test_names_of_folders_are_valid_and_apart_on_every_file_system(texts, names):
    assert folder_names(texts) == names


@given(st.lists(st.text(st.characters(exclude_categories=["Cs"]), max_size=300), max_size=6))
def test_names_of_folders_are_apart_short_and_of_one_part(texts):
    names = folder_names(texts)
    assert len({unicodedata.normalize("NFKC", name).casefold() for name in names}) == len(texts) == len(names)
    for name in names:
        assert 0 < len(name.encode()) <= LONGEST_NAME and not set(name) & set('<>:"/\\|?*\0')
        assert name.strip(" .") == name
