"""Curves of a declared figure belong to their rows: labels, bars, shifts, facets."""

import numpy as np
import pytest

from validation.analysis.chart import Chart, Curve, Map, Panel
from validation.analysis.evidence import Evidence, Table
from validation.analysis.study import Settings
from validation.report.drawing import draw

H, Q, MODELS = (0.1, 1.0), (1.0, 2.0, 4.0), ("bem", "mdr")
ROWS = [(h, model, q) for h in H for model in MODELS for q in Q]
VALUE = 1.0 + np.arange(len(ROWS))
TABLE = Table(
    "level",
    {
        **dict(zip(("h/d", "model", "q a"), map(list, zip(*ROWS, strict=True)), strict=True)),
        "value": VALUE.tolist(),
        "low": (VALUE - 0.1).tolist(),
        "high": (VALUE + 0.3).tolist(),
    },
)
EVIDENCE = Evidence(title="t", method="", numbers=(), tables=(TABLE,), conclusions=(), captions={})


def drawn(*curves, **settings):
    return draw(Chart("c", "", (Panel("q a", "y", curves, **settings),)), EVIDENCE).axes


def test_a_family_has_a_curve_for_each_value_with_its_label_and_shift():
    (axis,) = drawn(Curve("level", "mdr", by=("h/d",), down=2.0))
    lines = {line.get_label(): line.get_ydata() for line in axis.lines}
    np.testing.assert_array_equal(lines["h/d = 0.1"], [4, 5, 6])
    np.testing.assert_array_equal(lines["h/d = 1"], [8, 9, 10])


def test_bars_end_where_the_interval_ends():
    (axis,) = drawn(Curve("level", "bem", "bem", "b", of={"h/d": "first"}, bars=True))
    (container,) = axis.containers
    ends = [segment[:, 1] for segment in container.lines[2][0].get_segments()]
    np.testing.assert_allclose(ends, [[0.9, 1.3], [1.9, 2.3], [2.9, 3.3]])


def test_bars_of_a_family_stand_side_by_side():
    (axis,) = drawn(Curve("level", by=("model",), of={"h/d": "first"}, bars=True))
    first, second = (container.lines[0].get_xdata() for container in axis.containers)
    np.testing.assert_allclose(second, 1.03 * first)


def test_few_decades_of_a_logarithmic_axis_have_plain_numbers():
    (axis,) = drawn(Curve("level", "bem"), log="xy", ylim=(0.3, 3))
    assert [label.get_text() for label in axis.get_yticklabels()] == ["0.5", "1", "2"]


def test_facets_have_an_axis_each_with_their_rows_alone():
    axes = drawn(Curve("level", "bem", "exact", "b"), facet="h/d")
    assert [axis.get_title() for axis in axes] == ["h/d = 0.1", "h/d = 1"]
    np.testing.assert_array_equal(axes[1].lines[0].get_ydata(), [7, 8, 9])


def test_what_has_no_room_on_a_logarithmic_axis_is_not_drawn():
    zero = Table("level", {**{name: column[:3] for name, column in TABLE.columns.items()}, "value": [1.0, 0.0, 2.0]})
    (axis,) = draw(
        Chart("c", "", (Panel("q a", "y", (Curve("level", label="b"),), log="xy"),)),
        Evidence(title="t", method="", numbers=(), tables=(zero,), conclusions=(), captions={}),
    ).axes
    np.testing.assert_array_equal(axis.lines[0].get_ydata(), [1, np.nan, 2])


def test_verdicts_stand_over_their_ranges():
    judged = {"from": [1.0], "to": [4.0], "value": [2.0], "low": [1.5], "high": [2.5], "verdict": ["differ"]}
    tables = (TABLE, Table("level, judged", {"h/d": [0.1], "model": ["m"], **judged}))
    evidence = Evidence(title="t", method="", numbers=(), tables=tables, conclusions=(), captions={})
    panel = Panel("q a", "y", (Curve("level", "bem", label="b"),), judged="level", facet="h/d")
    first, second = draw(Chart("c", "", (panel,)), evidence).axes
    assert [text.get_text() for text in first.texts] == ["≠"] and first.texts[0].get_position()[0] == 2.0
    assert not second.texts


def test_the_cells_of_a_map_are_those_of_their_parameters():
    figure = draw(Chart("c", "", Map("level", "q a", "h/d", "model", "dB")), EVIDENCE)
    assert figure.axes[1].collections[0].get_array().reshape(2, 3).tolist() == [[4, 5, 6], [10, 11, 12]]


@pytest.mark.parametrize(("text", "found"), [("{c.x:.1f}", "2.0"), ("{c.many:g}", "1, 2 and 3"), ("{c.one}", "1")])
def test_settings_are_filled_into_a_text(text, found):
    case = type("C", (), {"x": 2.0, "many": (1.0, 2.0, 3.0), "one": (1,)})
    assert Settings().format(text, c=case) == found
