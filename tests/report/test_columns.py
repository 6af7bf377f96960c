"""Columns of the data have a unit and a meaning."""

import csv

import pytest

from tests.report.remade import REFERENCE
from tests.report.test_page import section_of
from validation.analysis.contents import as_csv, from_csv
from validation.analysis.evidence import Table
from validation.report.columns import COLUMNS, columns_file, described

FILES = sorted(path for path in (REFERENCE / "data").glob("*.csv") if path.name != COLUMNS)


def header(path):
    with path.open(encoding="utf-8", newline="") as file:
        return next(csv.reader(file))


def test_every_column_of_the_reference_report_has_a_meaning():
    without = []
    for path in FILES:
        case, _, name = path.stem.partition("-")
        rows = described(case, Table(name, {column: [] for column in header(path)}))
        without += [f"{path.name}: {column}" for _, column, _, meaning in rows if not meaning]
    assert len(FILES) > 100 and without == []


def test_a_column_that_nobody_explains_has_no_meaning():
    assert list(described("geike", Table("t", {"nobody knows [m]": [1.0]}))) == [("*", "nobody knows [m]", "m", "")]


def test_values_have_the_unit_of_their_table():
    rows = list(described("rolling", Table("rms force, judged", {"h/d": [1.0], "value": [2.0], "low": [1.0]}, "dB")))
    assert rows[1] == ("rolling-rms_force_judged.csv", "value [dB]", "dB", "rms force, the worst point of the range")
    assert rows[2][:3] == ("*", "low [dB]", "dB")
    assert rows[0][3] == "rms height of the roughness over the approach of the smooth body"


def test_what_means_the_same_in_all_files_has_one_row():
    lines = columns_file([section_of("geike"), section_of("hertz")]).decode().splitlines()
    assert lines[0] == "file,column,unit,meaning"
    assert sum(line.startswith("*,tolerance,") for line in lines) == 1
    assert sum("-numbers.csv,value," in line for line in lines) == 2


@pytest.mark.parametrize(
    ("table", "first"),
    [
        (Table("t", {"value": [1.5], "low": [1.0], "high": [2.0]}, "dB"), "value [dB],low [dB],high [dB]"),
        (Table("t", {"low [s]": [1.0], "high [s]": [2.0]}), "low [s],high [s]"),
    ],
)
def test_a_unit_stands_in_the_header_and_comes_back(table, first):
    text = as_csv(table).decode()
    assert text.splitlines()[0] == first
    assert from_csv("t", text) == table
