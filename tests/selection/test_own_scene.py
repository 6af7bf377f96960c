"""What somebody reports of a scene: several quantities, sweeps over a value, seconds beside errors, five curves."""

import csv
import json
from dataclasses import replace
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

import validation
from tests.selection.planted_answers import planted
from tests.selection.test_model_hierarchy import Fake, Finding
from tests.selection.test_what_compare_says import compared
from validation.__main__ import main
from validation.analysis.contents import as_csv
from validation.report import compared as figures
from validation.report.compared_seconds import figure_over_seconds
from validation.report.compared_sweep import draw_sweep
from validation.report.style import CURVES
from validation.selection import scene_model
from validation.selection.compare import compare_quantities
from validation.selection.contact_force import contact_force
from validation.selection.exported import levels_of_models
from validation.selection.reasons import grouped
from validation.selection.side_by_side import shown_models
from validation.selection.speed_accuracy import speed_and_accuracy
from validation.selection.summary import findings, summary
from validation.selection.swept import swept_values
from validation.simulation.rail_models import ContactFilter

RAIL = validation.load_scene("rail")
CLOSED = ["linear, ellipse", "linear, on the line", "Remington"]


def solved(scene, **settings):
    return validation.compare(scene, "contact-filter", "1 dB", models=CLOSED, **settings)


def test_both_quantities_of_a_rail_are_solved_once():
    asked, found, quantities = [], ContactFilter.find, ("contact-filter", "equivalent-roughness")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ContactFilter, "find", lambda model, *given: asked.append(model.name) or found(model, *given))
        both = compare_quantities(RAIL, quantities, "1 dB", 0, solve_all=False, models=CLOSED)
    assert sorted(asked) == sorted(CLOSED)
    alone = validation.compare(RAIL, "equivalent-roughness", "1 dB", models=CLOSED)
    assert validation.to_json(both["equivalent-roughness"]) == validation.to_json(alone)
    a3, level = (one.value for one in both.values())
    assert level == pytest.approx(a3 + np.array(RAIL.levels.levels))
    text = findings(list(both.values()))
    assert text.count("what became of it") == 1 and text.count("L_eq = L_r + A3") == 1
    assert all(f"\n{quantity} by linear, ellipse" in text for quantity in both)


@pytest.mark.slow
def test_the_command_takes_several_quantities(tmp_path, capsys):
    table, picture = tmp_path / "out.csv", tmp_path / "out.svg"
    words = ["compare", "rail", "--quantity", "contact-filter, equivalent-roughness", "--tolerance", "1 dB"]
    assert main([*words, "--csv", str(table), "--figure", str(picture), "--json", str(tmp_path / "out.json")]) == 0
    assert "contact-filter, equivalent-roughness within 1 dB" in capsys.readouterr().out
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [row["quantity"] for row in rows[::35]] == ["contact-filter", "equivalent-roughness"]
    found = json.loads((tmp_path / "out.json").read_text())
    assert [one["unit"] for one in found] == ["dB", "dB re 1 µm"]
    with pytest.raises(SystemExit):
        main(["compare", "rail", "--quantity", "contact-filter,loudness"])
    assert "got 'loudness'" in capsys.readouterr().err


def test_a_reason_is_told_once():
    """Whatever models it is of: `compare rail --all` had one clause fifteen times."""
    text = " ".join(summary(solved(RAIL)).split())
    assert text.count("h' a_x / d = 0.092 of waves") == 1
    assert "Remington: its error is largest at 12.5 mm: 8.3 dB off linear, ellipse" in text


@pytest.mark.parametrize(
    ("reasons", "found"),
    [
        ({"a": "why", "b": "why"}, [(("a", "b"), "why")]),
        (
            {"a": "at 16 mm: of all of them", "b": "at 8 mm: 3 dB off; of all of them", "c": "other"},
            [(("a",), "at 16 mm"), (("a", "b"), "of all of them"), (("b",), "at 8 mm: 3 dB off"), (("c",), "other")],
        ),
        ({"a": "cells: 8", "b": "surfaces: 8"}, [(("a",), "cells: 8"), (("b",), "surfaces: 8")]),
    ],
)
def test_clauses_have_the_names_of_all_that_have_them(reasons, found):
    assert list(grouped(reasons)) == found


def test_a_sweep_has_the_values_in_the_unit_of_the_first():
    def values(*texts):
        return [(one.value, one.unit) for one in swept_values("wheel.load", texts, "scene")]

    assert values("5 kN", "500 N", "1e4N") == [(5.0, "kN"), (0.5, "kN"), (10.0, "kN")]
    assert values("0.5", "1") == [(0.5, ""), (1.0, "")]
    assert values("10 um", "0.02 mm") == [(10.0, "um"), (20.0, "um")]
    assert values("ridges", "0.5") == [("ridges", ""), ("0.5", "")]
    assert swept_values("wheel.load", ["5 kN"], "scene")[0].label == "wheel.load [kN]"


def swept_rail():
    loads = swept_values("wheel.load", ["25 kN", "50 kN", "100 kN"], RAIL.name)
    return [replace(solved(replace(RAIL, load=1e3 * of.value)), swept=of) for of in loads]


@pytest.mark.slow
def test_a_sweep_is_a_line_a_model_over_the_swept_value():
    """In the bands that change most; each with the band of its error."""
    found = swept_rail()
    figure = Figure()
    draw_sweep(figure.subfigures(), found, 5)
    panels = [axes for axes in figure.subfigs[0].axes if axes.lines]
    assert len(panels) == 4 and {axes.get_xlabel() for axes in panels} == {"wheel.load [kN]"}
    sums = {line.get_label(): line.get_ydata() for line in panels[0].lines}
    assert sums["Remington"] == pytest.approx([contact_force(one).total("Remington") for one in found])
    for axes in panels[1:]:
        lines = {line.get_label(): line for line in axes.lines if not line.get_label().startswith("_")}
        assert sorted(lines) == sorted(CLOSED)
        wave = float(axes.get_title(loc="left").removesuffix(" mm"))
        at = int(np.argmin(abs(found[0].wavelength_mm - wave)))
        for name, line in lines.items():
            ones = [next(one for one in each.models if one.name == name) for each in found]
            assert line.get_xdata().tolist() == [25.0, 50.0, 100.0]
            values = [each.value_of(one)[at] for each, one in zip(found, ones, strict=True)]
            assert line.get_ydata() == pytest.approx(values)
        assert len(axes.collections) == len(CLOSED)


def test_a_sweep_of_two_scenes_is_a_line_a_scene_and_a_value_may_come_twice():
    loads = swept_values("punch.load", ["5 kN", "1 kN", "5 kN"], "one")
    found = [
        replace(compared(Finding(value=(1.0 + i + 10 * j,))), swept=replace(of, scene=scene))
        for j, scene in enumerate(("one", "other"))
        for i, of in enumerate(loads)
    ]
    figure = Figure()
    draw_sweep(figure.subfigures(), found, 5)
    (axes,) = figure.subfigs[0].axes
    lines = {line.get_label(): line for line in axes.lines}
    assert lines["one"].get_xdata().tolist() == [1.0, 5.0, 5.0] == lines["other"].get_xdata().tolist()
    assert (lines["one"].get_ydata().tolist(), lines["other"].get_ydata().tolist()) == ([2, 1, 3], [12, 11, 13])


def test_a_sweep_of_numbers_has_one_panel_and_text_its_names():
    names = swept_values("rail.across", ["ridges", "isotropic"], "punch")
    found = [replace(compared(Finding(value=(2.0 + i,))), swept=of) for i, of in enumerate(names)]
    figure = Figure()
    draw_sweep(figure.subfigures(), found, 5)
    (axes,) = figure.subfigs[0].axes
    assert [label.get_text() for label in axes.get_xticklabels()] == ["ridges", "isotropic"]
    assert axes.lines[0].get_ydata().tolist() == [2.0, 3.0]


@pytest.mark.slow
def test_the_swept_value_is_a_column_of_the_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["--sweep", "wheel.load=2 kN,4905 N", "--csv", "out.csv", "--json", "out.json", "--figure", "out.svg"]
    assert main(["compare", "rolling_wheel", "--tolerance", "10%", "--workers", "1", *words]) == 0
    rows = list(csv.DictReader((tmp_path / "out.csv").read_text().splitlines()))
    told = [(row["swept"], float(row["swept_value"]), row["swept_unit"]) for row in rows]
    assert told == [("wheel.load", 2.0, "kN"), ("wheel.load", 4.905, "kN")]
    found = json.loads((tmp_path / "out.json").read_text())
    assert [(one["swept"], one["swept_value"], one["swept_unit"]) for one in found] == told


@pytest.mark.slow
def test_seconds_are_those_of_all_solves_that_a_model_needs():
    """A clock on which each realisation takes a second; what another grid has solved counts, too."""
    ticks = count()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene_model, "time", SimpleNamespace(perf_counter=lambda: float(next(ticks))))
        found = validation.compare(validation.load_scene("rough_punch"), tolerance=0.9, solve_all=True)
    for one in found.selection.solved:
        surfaces = int(one.reason.split("surfaces: ")[1]) if "surfaces" in one.reason else 1
        compared_with = one.model.sampling.compared * len(one.model.references)
        assert found.seconds_of(one) == surfaces + compared_with
    table = {
        row["model"]: row["seconds"] for row in csv.DictReader(as_csv(levels_of_models(found)).decode().split("\n"))
    }
    assert {name: float(cell) for name, cell in table.items()} == {
        one.name: found.seconds_of(one) for one in found.selection.solved
    }
    assert "    took  what became of it" in summary(found)


def test_without_all_no_second_enters_a_file():
    found = solved(RAIL)
    assert not found.timed and all(np.isnan(found.seconds_of(one)) for one in found.models)
    assert validation.to_json(found) == validation.to_json(solved(RAIL))
    assert "seconds" not in validation.to_csv(found) and "took" not in summary(found)
    assert {one["seconds"] for one in json.loads(validation.to_json(found))["models"]} == {None}


def test_accuracy_is_the_distance_from_the_reference_with_both_errors():
    """10 % above it, errors of 10 and 1 %: between 0 and 22 %, as decibels add."""
    models = [
        Finding(name="cheap", parts=(0.1, 0, 0), value=(2.2,)),
        Finding(name="dear", parts=(0.01, 0, 0), value=(2.0,)),
    ]
    table = speed_and_accuracy(compared(*models, solve_all=True))
    cheap, dear = (table.where(model=name) for name in ("cheap", "dear"))
    assert (cheap["unit"][0], cheap["error"][0]) == ("%", pytest.approx(10.0))
    assert cheap["low"][0] == 0.0 and cheap["high"][0] == pytest.approx(10 + 11.0)
    assert dear["is_reference"][0] and dear["high"][0] == pytest.approx(1.0) and np.isnan(dear["error"][0])


def test_accuracy_of_a_filter_is_the_largest_difference_that_counts():
    found = solved(RAIL)
    table = speed_and_accuracy(found)
    reference = found.value_of(next(one for one in found.models if one.name == "linear, ellipse"))
    for one in found.selection.solved[1:]:
        counted = reference > -15
        worst = abs(found.value_of(one) - reference)[counted].max()
        assert table.where(model=one.name)["error"][0] == pytest.approx(worst)


def test_a_distance_in_decibels_has_the_errors_of_its_band_and_the_reference_that_of_its_worst():
    """Closed filters have neither grid nor sample: both errors add, in the band in which the models are farthest."""
    found = solved(RAIL)
    table, (reference, *others) = speed_and_accuracy(found), found.selection.solved
    counted = found.value_of(reference) > -15
    own = table.where(model=reference.name)
    assert (own["unit"][0], own["is_reference"][0]) == ("dB", True)
    assert own["high"][0] == pytest.approx(found.errors_of(reference)[counted].max())
    for one in others:
        off = np.abs(found.value_of(one) - found.value_of(reference))
        at = int(np.argmax(np.where(counted, off, -1)))
        half = found.errors_of(one)[at] + found.errors_of(reference)[at]
        row = table.where(model=one.name)
        assert row["high"][0] == pytest.approx(off[at] + half) and row["low"][0] == pytest.approx(
            max(off[at] - half, 0)
        )


def test_speed_and_accuracy_are_drawn_for_one_scene_whose_models_were_timed(tmp_path, capsys):
    out = tmp_path / "out.svg"
    words = ["compare", "rail", "--models", "linear, ellipse,Remington", "--over", "seconds"]
    assert main([*words, "--tolerance", "1 dB", "--figure", str(out)]) == 0
    assert out.read_bytes().startswith(b"<?xml") and "took" in capsys.readouterr().out
    for refused, said in (
        (words, "--over seconds must have --figure"),
        (["compare", "rail", "--over", "seconds", "--figure", str(out)], "--all or --models"),
        ([*words, "--figure", str(out), "--sweep", "wheel.load=20 kN,50 kN"], "one quantity of one scene, got 2"),
    ):
        assert main(refused) == 2
        assert said in capsys.readouterr().err
    with pytest.raises(ValueError, match="needs models that were solved"):
        figure_over_seconds(compared(Fake(failed="lost"), solve_all=True), "svg")


def test_five_curves_at_the_most_are_told_apart_in_colour_and_in_grey():
    found = planted("rail", "contact-filter")
    assert len(found.selection.solved) > 5
    axes = Figure().subplots()
    figures._spectra(axes, figures._shown([found])[1])
    lines = [line for line in axes.lines if line.get_label()[0] != "_"]
    assert len(lines) == 5 == len({line.get_color() for line in lines})
    assert len({(line.get_linestyle(), line.get_marker()) for line in lines}) == 5
    assert f"and {len(found.selection.solved) - 5} more" in axes.get_legend().get_title().get_text()
    assert lines[0].get_label() == f"{found.model}, selected"
    assert len(CURVES) == figures.MOST


def test_the_curves_are_selected_reference_mdr_and_the_nearest():
    """Of numbers: 2.1 is nearer to the selected 2.2 than 1.5."""
    models = [
        Finding(name="far", parts=(0.15, 0, 0), value=(1.5,)),
        Finding(name="near", parts=(0.15, 0, 0), value=(2.1,), claimed=0.5),
        Finding(name="poor", parts=(0.4, 0, 0), value=(9.0,), is_mdr=True),
        Finding(name="best", parts=(0.01, 0, 0), value=(3.0,)),
        Finding(name="springs", parts=(0.3, 0, 0), value=(7.0,), is_mdr=True),
    ]
    found = compared(replace(models[0], name="chosen", value=(2.2,)), *models, solve_all=True)
    assert shown_models(found) == ["chosen", "best", "springs", "near", "far", "poor"]
