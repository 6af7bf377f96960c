"""A table has the unit of what it shows."""

import math

import pytest

from tests.seeded import catches
from validation.analysis.contents import as_csv, from_csv
from validation.analysis.evidence import Table
from validation.analysis.quantity import Quantity
from validation.analysis.series import Series, tables_of


@catches("a ratio in decibels", quantity="ratio", changes={"unit": "dB", "shown": math.exp}, unit="").at(
    "validation.analysis.series.Series.shown_unit", property(lambda one: one.unit)
)
@pytest.mark.parametrize(
    ("quantity", "changes", "unit"),
    [
        ("level", {"unit": "dB"}, "dB"),
        ("ratio", {"unit": "dB", "shown": math.exp}, ""),
        ("force F [N]", {}, "N"),
        ("ratio", {}, ""),
    ],
)
def test_a_table_has_the_unit_of_what_it_shows(quantity, changes, unit):
    (table,) = tables_of([Series(quantity, "springs", (1.0,), **changes)])
    assert table.unit == table.rows([0]).unit == unit


def test_a_table_is_read_back_with_its_unit_its_texts_and_its_gaps():
    columns = {"model": ["a", "b"], "is_mdr": [True, False], "value": [1.5, 2.0], "low": [1.0, math.nan]}
    table = from_csv("t", as_csv(Table("t", {**columns, "high": [2.0, 3.0], "count": [1, 2]}, unit="N")).decode())
    assert table.unit == "N" and list(table.columns) == [*columns, "high", "count"]
    assert list(table.columns["model"]) == ["a", "b"] and list(table.columns["is_mdr"]) == [True, False]
    assert list(table.columns["high"]) == [2.0, 3.0] and list(table.columns["count"]) == [1, 2]


def test_a_key_that_no_file_name_has_is_refused():
    with pytest.raises(ValueError, match=r"^key must be a name as .*, got 'a b/c'$"):
        Quantity("a b/c")
