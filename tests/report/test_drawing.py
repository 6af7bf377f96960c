"""Curves of a declared figure belong to their rows: labels, bars, shifts, facets."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from validation.analysis.case import Settings
from validation.analysis.chart import STYLES, Chart, Curve, Panel, by_model
from validation.analysis.evidence import Evidence, Table
from validation.analysis.series import ENDS
from validation.report.drawing import FORMS, draw
from validation.report.style import styles_of

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


def drawn(*curves, tables=(TABLE,), **settings):
    return draw(Chart("c", "", (Panel("q a", "y", curves, **settings),)), replace(EVIDENCE, tables=tables)).axes


def test_a_family_has_a_curve_for_each_value_with_its_label_and_shift():
    (axis,) = drawn(Curve("level", "mdr", by=("h/d",), down=2.0))
    lines = {line.get_label(): line.get_ydata() for line in axis.lines}
    np.testing.assert_array_equal(lines["h/d = 0.1"], [4, 5, 6])
    np.testing.assert_array_equal(lines["h/d = 1"], [8, 9, 10])


def test_bars_of_a_family_stand_side_by_side():
    (axis,) = drawn(Curve("level", by=("model",), of={"h/d": "first"}, bars=True))
    first, second = (container.lines[0].get_xdata() for container in axis.containers)
    np.testing.assert_allclose(second, 1.03 * first)


@pytest.mark.parametrize(("low", "log", "first"), [(0.9, "x", 0.9), (-1.0, "xy", 0.1)])
def test_bars_end_where_the_interval_ends_and_a_decade_down_on_a_logarithmic_axis(low, log, first):
    table = Table("level", {**TABLE.rows(range(3)).columns, "low": [low, 1.9, 2.9]})
    (axis,) = drawn(Curve("level", style="marks", label="b", bars=True), tables=(table,), log=log)
    ends = [segment[:, 1] for segment in axis.containers[0].lines[2][0].get_segments()]
    np.testing.assert_allclose(ends, [[first, 1.3], [1.9, 2.3], [2.9, 3.3]])


def test_each_model_has_its_style_and_bars_where_it_has_an_interval():
    is_mdr = TABLE["model"] == "mdr"
    exact = {**TABLE.columns, **{end: np.where(is_mdr, VALUE, TABLE[end]).tolist() for end in ("low", "high")}}
    curves = by_model("level", {"mdr": "lines", "bem": "marks"}, bars=True)
    (axis,) = drawn(*curves, tables=(Table("level", exact),))
    assert [container.get_label() for container in axis.containers] == ["bem"]
    assert axis.get_legend_handles_labels()[1] == ["mdr", "bem"]


def test_markers_are_apart_and_ticks_are_plain_numbers_at_the_values_or_of_few_decades():
    (axis,) = drawn(
        Curve("level", "bem", "black", "b", of={"h/d": "first"}, marker_spacing=0.1),
        ticked=True,
        log="xy",
        ylim=(0.3, 3),
    )
    assert axis.lines[0].get_markevery() == 0.1
    ticks = [[label.get_text() for label in labels()] for labels in (axis.get_xticklabels, axis.get_yticklabels)]
    assert ticks == [["1", "2", "4"], ["0.3", "1", "3"]]


def test_a_family_has_one_style_in_all_facets():
    """Of models, each of which is in one facet alone."""
    first, second = drawn(Curve("level", by=("model", "h/d")), facet="h/d")
    colours = [line.get_color() for axis in (first, second) for line in axis.lines]
    assert len(set(colours)) == 4


def test_names_stand_at_the_ends_of_curves_that_are_apart_there():
    """Lowest first, outside of the panel."""
    (axis,) = drawn(Curve("level", by=("model",), of={"h/d": "first"}))
    assert [text.get_text() for text in axis.texts] == ["bem", "mdr"] and not axis.figure.legends
    assert all(text.xyann[0] > 1 for text in axis.texts)


def test_names_of_curves_of_which_one_ends_early_are_in_a_legend():
    early = Table("level", {**TABLE.columns, "q a": np.where(TABLE["model"] == "mdr", 1, 4) * TABLE["q a"]})
    (axis,) = drawn(Curve("level", by=("model",), of={"h/d": "first"}), tables=(early,), log="")
    assert not axis.texts and [text.get_text() for text in axis.figure.legends[0].get_texts()] == ["bem", "mdr"]


def names_of(axes):
    """At the ends of curves in each panel, and in the legend."""
    legends = axes[0].figure.legends
    ends = ([text.get_text() for text in axis.texts] for axis in axes)
    return [*ends], [text.get_text() for legend in legends for text in legend.get_texts()]


@pytest.mark.parametrize(
    ("models", "ends", "legend"),
    [
        (["bem"], [[]], ["bem"]),
        (["bem", "mdr"], [[], []], ["bem", "mdr"]),
        (["bem mdr", "mdr bem"], [[], ["bem", "mdr"]], []),
        # two rows of two: the last panel of the first row has room beside it
        (["bem", "bem mdr", "bem", "bem"], [[], ["bem", "mdr"], [], []], []),
        (["bem", "bem", "bem", "bem mdr"], [[], [], [], []], ["bem", "mdr"]),
    ],
)
def test_a_name_that_several_panels_have_stands_once(models, ends, legend):
    curves = (tuple(Curve("level", model, of={"h/d": "first"}) for model in names.split()) for names in models)
    chart = Chart("c", "", tuple(Panel("q a", "y", of_panel) for of_panel in curves))
    assert names_of(draw(chart, EVIDENCE).axes) == (ends, legend)


def test_names_of_curves_that_end_side_by_side_are_a_line_apart():
    """Nine points, in parts of the height of the panel."""
    rows = {"model": ["a", "b", "c", "d"], **{name: [1, 2, 2.01, 3] for name in ("value", "low", "high")}}
    table = Table("level", {name: [*column, *column] for name, column in rows.items()} | {"q a": [1.0] * 4 + [2.0] * 4})
    (axis,) = drawn(Curve("level", by=("model",)), tables=(table,))
    places = [text.xyann[1] for text in axis.texts]
    assert [text.get_text() for text in axis.texts] == ["a", "b", "c", "d"]
    assert np.diff(places).min() * axis.bbox.height == pytest.approx(9 * axis.figure.dpi / 72)


def test_a_family_of_two_columns_has_both_in_its_names():
    (axis,) = drawn(Curve("level", by=("h/d", "model")))
    labels = axis.get_legend_handles_labels()[1]
    for label, (h, model) in zip(labels, product(H, MODELS), strict=True):
        assert f"h/d = {h:g}" in label and model in label


def of_many(count, panels=1):
    """Axes of one figure of so many models in each panel, the spare places of its grid behind them."""
    names = [f"model {i}" for i in range(count)]
    rows = {"model": np.repeat(names, 2).tolist(), "q a": [1.0, 2.0] * count}
    table = Table("level", {**rows, **dict.fromkeys(("value", "low", "high"), np.repeat(range(1, count + 1), 2))})
    panel = Panel("q a", "y", (Curve("level", by=("model",)),))
    return names, draw(Chart("c", "", (panel,) * panels), replace(EVIDENCE, tables=(table,))).axes


@pytest.mark.parametrize("count", [6, 7])
def test_up_to_six_names_stand_at_the_ends_of_curves(count):
    names, axes = of_many(count)
    assert names_of(axes) == (([names], []) if count == 6 else ([[]], names))


def test_a_legend_of_more_than_fourteen_names_makes_the_figure_higher_by_its_rows():
    """Fourteen stand in the spare place of five panels on a grid of six; rows are twelve points high."""
    (names, few), (_, many) = of_many(14, panels=5), of_many(15, panels=5)
    assert not few[0].figure.legends and [text.get_text() for text in few[5].get_legend().get_texts()] == names
    (legend,) = many[0].figure.legends
    heights = [axes[0].figure.get_figheight() for axes in (few, many)]
    assert 72 * (heights[1] - heights[0]) == pytest.approx(12 * math.ceil(15 / legend._ncols))
    assert many[5].get_legend() is None


def test_a_model_has_its_colour_in_all_figures_and_two_of_a_kind_are_apart_in_grey():
    """Whatever stands beside it, and by the longest beginning of its name."""
    alone, other = (
        styles_of(["springs"])["springs"],
        styles_of(["boundary elements", "springs", "springs, Geike's rule"]),
    )
    assert alone == other["springs"] and alone["color"] == other["springs, Geike's rule"]["color"]
    two = styles_of(["springs, Geike's rule", "springs, rolling spectrum", "nothing known"])
    assert len({(style["marker"], style["linestyle"]) for style in two.values()}) == 3


def test_values_may_be_places_on_the_horizontal_axis_and_intervals_stand_alone():
    (axis,) = drawn(Curve("level", "bem", "guide", upright=True, of={"h/d": 0.1}))
    assert [line.get_xdata()[0] for line in axis.lines] == [1, 2, 3]
    (axis,) = drawn(Curve("level", "bem", "interval", of={"h/d": 0.1}))
    assert not axis.lines and {*axis.collections[0].get_paths()[0].vertices[:, 1]} >= {0.9, 1.3, 3.3}


def test_what_has_no_room_on_a_logarithmic_axis_is_not_drawn():
    zero = Table("level", {**TABLE.rows(range(3)).columns, "value": [1.0, 0.0, 2.0]})
    (axis,) = drawn(Curve("level", label="b"), tables=(zero,), log="xy")
    np.testing.assert_array_equal(axis.lines[0].get_ydata(), [1, np.nan, 2])


def test_verdicts_stand_over_their_ranges():
    judged = {"from": [1.0], "to": [4.0], "value": [2.0], "low": [1.5], "high": [2.5], "verdict": ["outside tolerance"]}
    tables = (TABLE, Table("level, judged", {"h/d": [0.1], "model": ["m"], **judged}))
    first, second = drawn(Curve("level", "bem", label="b"), tables=tables, judged="level", facet="h/d")
    assert [text.get_text() for text in first.texts] == ["≠"] and first.texts[0].get_position()[0] == 2.0
    assert not second.texts


def test_a_quantity_that_a_run_does_not_have_leaves_its_panel_empty():
    curves = Curve("level", "bem", label="b"), Curve("contrast", by=("model",), bars=True)
    for facet in ("", "h/d"):
        assert [line.get_label() for line in drawn(*curves, facet=facet)[0].lines] == ["b"]
    assert len(drawn(curves[1], facet="h/d")) == 1


def test_values_of_a_quantity_are_marked_by_the_names_of_their_models():
    marks = Table("marks", {"model": ["ω_eigen", "q_min v₀"], "value": [1.5, 3.0]})
    curves = Curve("level", "bem", label="b"), Curve("marks", style="guide", upright=True)
    (axis,) = drawn(*curves, tables=(TABLE, marks))
    assert {text.get_text(): text.get_position()[0] for text in axis.texts} == {"ω_eigen": 1.5, "q_min v₀": 3.0}
    assert Chart("c", "", (Panel("q a", "y", curves),)).tables == ("level", "marks")


def test_decades_are_those_below_the_largest_value_and_not_below_a_line_across_the_panel():
    small = Table("level", {**TABLE.columns, "value": (1e-6 * VALUE).tolist()})
    marked = Curve("level", "bem", "guide", "_", upright=True)
    (axis,) = drawn(Curve("level", label="b"), marked, tables=(small,), log="xy", decades=3.0)
    assert axis.get_ylim() == pytest.approx((1e-9 * VALUE[-1], 6e-6 * VALUE[-1]))


def test_panels_of_one_quantity_share_its_axis():
    """Up to the largest value of all, though a bound is given below."""
    panels = tuple(Panel("q a", "y", (Curve("level", model, "black", "b"),), ylim=(0, None)) for model in MODELS)
    first, second = draw(Chart("c", "", panels), EVIDENCE).axes
    assert first.get_ylim() == second.get_ylim()
    assert first.get_ylim()[0] == 0 and first.get_ylim()[1] > VALUE.max()
    assert (first.get_ylabel(), second.get_ylabel()) == ("y", "")


@pytest.mark.parametrize(
    ("text", "found"),
    [("{c.x:.1f}", "2.0"), ("{c.many:g}", "1, 2 and 3"), ("{c.one}", "1"), ("{c.small:SI}m", "2.5 µm")],
)
def test_settings_are_filled_into_a_text(text, found):
    case = type("C", (), {"x": 2.0, "many": (1.0, 2.0, 3.0), "one": (1,), "small": 2.5e-6})
    assert Settings().format(text, c=case) == found


def test_several_columns_have_an_axis_for_each_of_their_values():
    axes = drawn(Curve("level", label="b"), facet=("h/d", "model"), at=(1.5, 2.0, 99.0))
    named = zip("abcd", [f"h/d = {h:g}, {model}" for h in H for model in MODELS], strict=True)
    assert [axis.get_title(loc="left") for axis in axes[:4]] == [f"({letter}) {name}" for letter, name in named]
    np.testing.assert_array_equal(axes[3].lines[0].get_ydata(), [10, 11, 12])
    # a mark that the panel does not reach is not drawn
    assert [line.get_xdata()[0] for line in axes[3].lines[1:]] == [1.5, 2.0]


def test_a_curve_has_a_style_that_is_drawn():
    assert set(STYLES) == set(FORMS)
    with pytest.raises(ValueError, match=r"style of 'level' must be one of '', 'lines', .*, got 'nowhere'"):
        Curve("level", style="nowhere")


def test_a_column_that_is_nowhere_is_named_with_its_chart():
    with pytest.raises(ValueError, match="chart 'c' names 'nowhere', which is no column of its tables"):
        drawn(Curve("level", by=("nowhere",)))


def test_a_second_axis_above_has_a_constant_over_x():
    (axis,) = drawn(Curve("level", "mdr", label="b"), above=("f [Hz]", 100.0), downward=True)
    (above,) = axis.child_axes
    axis.figure.draw_without_rendering()
    assert above.get_xlabel() == "f [Hz]" and axis.get_xlim()[0] > axis.get_xlim()[1]
    assert sorted(above.get_xlim()) == pytest.approx(sorted(100 / x for x in axis.get_xlim()))
    assert [text.get_text() for text in above.get_xticklabels()] == [f"{tick:g}" for tick in above.get_xticks()]


def test_rows_have_their_names_from_the_top_and_the_interval_of_one_is_shaded():
    of = {"h/d": 0.1, "q a": 1.0}
    curves = Curve("level", by=("model",), of=of), Curve("level", "mdr", "interval", of=of)
    (axis,) = drawn(*curves, rows="model", log="")
    assert [text.get_text() for text in axis.get_yticklabels()] == ["bem", "mdr"] and axis.yaxis_inverted()
    points = [container.lines[0].get_xydata()[0].tolist() for container in axis.containers]
    assert points == [[1.0, 0], [4.0, 1]] and axis.patches[0].get_extents().width > 0
    segments = axis.containers[0].lines[2][0].get_segments()[0]
    np.testing.assert_allclose(segments, [[0.9, 0], [1.3, 0]])


def test_texts_of_the_horizontal_axis_are_equidistant_in_their_order():
    ways = Table("ways", {"way": ["b", "a", "b", "a"], "model": ["m", "m", "n", "n"], **dict.fromkeys(ENDS, [1.0] * 4)})
    (axis,) = draw(
        Chart("c", "", (Panel("way", "y", (Curve("ways", by=("model",)),), log=""),)), replace(EVIDENCE, tables=(ways,))
    ).axes
    assert [text.get_text() for text in axis.get_xticklabels()] == ["b", "a"]
    assert [line.get_xdata().tolist() for line in axis.lines] == [[0, 1], [0, 1]]


def test_a_panel_may_have_a_vertical_axis_of_its_own_a_height_and_a_column():
    panels = tuple(
        Panel("q a", "y", (Curve("level", model, "black", "b"),), own_y=True, height=2.0) for model in MODELS
    )
    axes = draw(Chart("c", "", panels, title="above", columns=1), EVIDENCE).axes
    assert axes[0].get_ylim() != axes[1].get_ylim() and axes[0].get_position().x0 == axes[1].get_position().x0
    assert axes[0].figure.get_suptitle() == "above" and axes[0].figure.get_figheight() < 4.5


def test_names_beside_points_do_not_cover_each_other_and_limits_are_in_the_legend():
    near = Table(
        "near", {"q a": [1.0, 1.01, 9.0], "model": ["a" * 20, "b" * 20, "c"], **dict.fromkeys(ENDS, [1.0] * 3)}
    )
    curves = [Curve("near", name, "marks", named=True) for name in near.columns["model"]]
    (axis,) = drawn(*curves, tables=(near,), log="xy", limits={"tolerance": 2.0})
    assert [text.get_text() for text in axis.texts] == near.columns["model"]
    shifts = {text.get_text()[0]: text.xyann for text in axis.texts}
    assert shifts["a"][1] != shifts["b"][1] and shifts["c"][0] < 0 < shifts["a"][0]
    assert [text.get_text() for text in axis.figure.legends[0].get_texts()] == ["tolerance"]
