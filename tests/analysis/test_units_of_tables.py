"""A table has the unit of what it shows."""

import math

import pytest

from tests.seeded import catches
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
