"""Columns of the data have a unit and a meaning."""

import csv

import pytest

from tests.report.remade import REFERENCE
from tests.report.test_page import section_of
from tests.seeded import catches
from validation.analysis.contents import as_csv, from_csv
from validation.analysis.evidence import Table
from validation.report.columns import COLUMNS, columns_file, described

FILES = sorted(path for path in (REFERENCE / "data").glob("*.csv") if path.name != COLUMNS)

EARLIER = "across-up_to_which_alpha_one_line_is_enough.csv: "
"""A table that the case no longer makes; it goes when the reference report is remade."""


def header(path):
    with path.open(encoding="utf-8", newline="") as file:
        return next(csv.reader(file))


def test_every_column_of_the_reference_report_has_a_meaning():
    without = []
    for path in FILES:
        case, _, name = path.stem.partition("-")
        rows = described(case, Table(name, {column: [] for column in header(path)}))
        without += [f"{path.name}: {column}" for _, column, _, meaning in rows if not meaning]
    assert len(FILES) > 100 and without and all(cell.startswith(EARLIER) for cell in without)


def test_a_column_that_nobody_explains_has_no_meaning():
    assert list(described("geike", Table("t", {"nobody knows [m]": [1.0]}))) == [("*", "nobody knows [m]", "m", "")]


@catches("data without units").at("validation.report.columns.header_of", lambda table: list(table.columns))
def test_values_have_the_unit_of_their_table():
    rows = list(described("rolling", Table("rms force, judged", {"h/d": [1.0], "value": [2.0], "low": [1.0]}, "dB")))
    of_rms = "square root of the ensemble mean of the variance, over that of boundary elements"
    assert rows[1] == ("rolling-rms_force_judged.csv", "value [dB]", "dB", f"{of_rms}, the worst point of the range")
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


@catches("a mean that is called nothing", *("fractal_punch", "mean stiffness, judged", "ensemble mean")).at(
    "validation.report.columns._MEANINGS", {}
)
@pytest.mark.parametrize(
    ("case", "table", "words"),
    [
        ("fractal_punch", "mean stiffness", "ensemble mean"),
        ("fractal_punch", "mean stiffness, judged", "ensemble mean"),
        ("fractal_punch", "k / (E* L)", "ensemble mean"),
        ("fractal_punch", "relative deviation", "0 where all springs of all profiles touch"),
        ("fractal_punch", "relative deviation, judged", "verdicts alone count a deviation below 1 % as 1 %"),
        ("interface", "stiffness", "ensemble mean"),
        ("interface", "mean gap over that of boundary elements", "ensemble mean"),
        ("interface", "contact area over that of boundary elements", "corrected"),
        ("interface", "mean gap over h", "empty where a model"),
        ("rolling", "rms force", "ensemble mean"),
        ("rolling", "roughness found in a one-third octave", "empty where none is found"),
        ("across", "largest alpha for one line", "searched from 0.05 to 8"),
        ("across", "shortest wave within 1 dB of boundary elements [mm]", "empty where the longest"),
        ("across", "nearest to boundary elements", "searched from 0.05 to 20"),
        ("rail_sound", "level in one-third octaves", "empty below -40 dB"),
        ("wheel_stability", "error of the period", "empty of theory below 1e-8"),
        ("limits", "springs: the last asperity", "the place where the figure draws them"),
        ("limits", "boundary elements: edge of the grid", "the place where the figure draws them"),
        ("limits", "observed threshold over the predicted one", "the end of the sweep"),
    ],
)
def test_a_value_says_what_it_is_the_mean_of_and_where_it_has_none(case, table, words):
    """What a figure, a search or rounding leaves out of the data is named with them."""
    columns = {"value": [1.0], "low": [1.0], "high": [1.0]}
    (meaning,) = (says for _, column, _, says in described(case, Table(table, columns)) if column == "value")
    assert words in meaning
    assert meaning.endswith("the worst point of the range") is table.endswith(", judged")
