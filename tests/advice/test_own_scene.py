"""What somebody reports of a scene: several quantities, sweeps over a value, seconds beside errors, five curves."""

import csv
import json
from dataclasses import replace
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import Fake, Finding, compared, planted
from tests.seeded import catches
from validation.__main__ import main
from validation.advice import compare, scene_model
from validation.advice.compare import SceneProblem, swept_values
from validation.advice.figure import MOST, errors_over_seconds, figure_over_seconds, panels_of
from validation.advice.summary import findings, in_full, summary
from validation.advice.table import shown_models, speed_and_accuracy
from validation.railway.problems.rail_models import ContactFilter
from validation.report.style import styles_of

RAIL = validation.load_scene("rail")
CLOSED = ["linear, ellipse", "linear, on the line", "Remington"]


def solved(scene, **settings):
    return validation.compare(scene, quantity="contact-filter", tolerance="1 dB", models=CLOSED, **settings)


real_models_of = compare.models_of


@catches("a rail solved anew for each quantity").at(
    "validation.advice.compare.models_of", lambda *given, **named: real_models_of(*given[:4], **named)
)
@pytest.mark.slow
def test_both_quantities_of_a_rail_are_solved_once():
    asked, found, quantities = [], ContactFilter.find, ("contact-filter", "equivalent-roughness")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ContactFilter, "find", lambda model, *given: asked.append(model.name) or found(model, *given))
        both = SceneProblem(RAIL, quantities, "1 dB", models=CLOSED).compared()
    assert sorted(asked) == sorted(CLOSED)
    alone = validation.compare(RAIL, quantity="equivalent-roughness", tolerance="1 dB", models=CLOSED)
    assert validation.to_json(both["equivalent-roughness"]) == validation.to_json(alone)
    a3, level = (one.value for one in both.values())
    assert level == pytest.approx(a3 + np.array(RAIL.levels.levels))
    text = findings(list(both.values()), in_full)
    assert text.count("  status\n") == 1 and text.count("L_eq = L_r + A3") == 1
    assert "\nboth in " in text and ", by linear, ellipse, " in text


@catches("solves of one quantity taken for those of another").at(
    "validation.scenes.rolling.RollingScene.shares_solves", True
)
def test_quantities_of_a_wheel_have_solves_of_their_own():
    keys, settings = ("force-spectrum", "force-rms"), {"models": ["linear filter, 1D"]}
    try:
        both = SceneProblem(validation.load_scene("rolling_wheel"), keys, 0.5, **settings).compared()
    except KeyError as missing:
        raise AssertionError("a quantity that the solves of another do not have") from missing
    for key in keys:
        alone = validation.compare(validation.load_scene("rolling_wheel"), quantity=key, tolerance=0.5, **settings)
        assert both[key].model and validation.to_json(both[key]) == validation.to_json(alone)


@catches("a sweep with values in units of their own").at(
    "validation.advice.compare.quantity", lambda name, text, dimension: float(compare.NUMBER.fullmatch(text)[1])
)
def test_a_sweep_has_the_values_in_the_unit_of_the_first():
    def values(*texts):
        return [(one.value, one.unit) for one in swept_values("wheel.load", texts, "scene")]

    assert values("5 kN", "500 N", "1e4N") == [(5.0, "kN"), (0.5, "kN"), (10.0, "kN")]
    assert values("0.5", "1") == [(0.5, ""), (1.0, "")]
    assert values("10 um", "0.02 mm") == [(10.0, "um"), (20.0, "um")]
    assert values("ridges", "0.5") == [("ridges", ""), ("0.5", "")]
    assert swept_values("wheel.load", ["5 kN"], "scene")[0].label == "wheel.load [kN]"


def test_a_sweep_of_two_scenes_is_a_line_a_scene_over_the_swept_value():
    loads = swept_values("punch.load", ["5 kN", "1 kN", "5 kN"], "one")
    found = [
        replace(compared(Finding(value=(1.0 + i + 10 * j,))), swept=replace(of, scene=scene))
        for j, scene in enumerate(("one", "other"))
        for i, of in enumerate(loads)
    ]
    title, ((panel, table),) = panels_of(found)
    assert title == "stiffness" and [curve.label for curve in panel.curves] == ["one", "other"]
    for name, values in (("one", [2, 1, 3]), ("other", [12, 11, 13])):
        rows = table.where(model=name)
        assert rows["punch.load [kN]"].tolist() == [1.0, 5.0, 5.0] and rows["value"].tolist() == values


def test_texts_of_a_sweep_stand_in_their_order():
    ways = swept_values("rail.lateral_structure", ["ridges", "isotropic", "0.5"], "one")
    _, ((panel, table),) = panels_of([replace(compared(Finding(value=(1.0,))), swept=of) for of in ways])
    assert panel.log == "" and table[panel.x].tolist() == ["ridges", "isotropic", "0.5"]


def test_a_sweep_of_spectra_has_the_sound_power_and_the_bands_that_change_most_each_with_an_axis_of_its_own():
    loads = swept_values("wheel.load", ["20 kN", "50 kN", "300 kN"], "Wheel")
    found = [replace(planted("rail", "contact-filter", error=0.05), swept=of) for of in loads]
    title, ((power, _), (bands, table)) = panels_of(found)
    count = len(found[0].selection.solved)
    assert title == f"Wheel: contact-filter; {MOST} curves of {count}, all are in the CSV"
    assert power.y == "A-weighted [dB re 1 pW]" and power.own_y and bands.own_y and bands.log == power.log == "x"
    waves = table["wavelength [mm]"].tolist()
    assert bands.facet == "wavelength [mm]" and len(set(waves)) == 3 and waves == sorted(waves, reverse=True)
    assert len(bands.curves) == MOST and all(curve.band for curve in bands.curves)


def of_its_own_grid(model, count, compared=0):
    return sum(model.shared[model.model, model.resolution].seconds[:count])


@catches("seconds without those of the grids that tell the error").at(
    "validation.advice.scene_model.SceneModel.seconds_of", of_its_own_grid
)
@pytest.mark.slow
def test_seconds_are_those_of_all_solves_that_a_model_needs():
    """A clock on which each realisation takes a second; what another grid has solved counts, too."""
    ticks = count()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene_model, "time", SimpleNamespace(perf_counter=lambda: float(next(ticks))))
        found = validation.compare(validation.load_scene("rough_punch"), tolerance=0.9, solve_all=True)
    for one in found.selection.solved:
        surfaces = int(one.reason.split("surfaces: ")[1]) if "surfaces" in one.reason else 1
        assert found.seconds_of(one) == surfaces + one.model.sampling.compared * len(one.model.references)
    rows = csv.DictReader(validation.to_csv(found).splitlines())
    assert {row["model"]: float(row["seconds"]) for row in rows} == {
        one.name: found.seconds_of(one) for one in found.selection.solved
    }


def test_without_all_no_second_enters_a_file():
    found = solved(RAIL)
    assert not found.timed and all(np.isnan(found.seconds_of(one)) for one in found.models)
    assert validation.to_json(found) == validation.to_json(solved(RAIL))
    assert "seconds" not in validation.to_csv(found) and "took" not in summary(found)
    assert {one["seconds"] for one in json.loads(validation.to_json(found))["models"]} == {None}


def test_a_distance_of_numbers_is_in_the_unit_of_the_tolerance():
    """10 % above the reference, errors of 10 and 1 %, as decibels add."""
    cheap, dear = (Finding(name=f"{value}", parts=(e, 0, 0), value=(value,)) for value, e in ((2.2, 0.1), (2.0, 0.01)))
    table = speed_and_accuracy(compared(cheap, dear, solve_all=True))
    assert table["unit"].tolist() == ["%"] * 2 and table["error"] == pytest.approx([10.0, np.nan], nan_ok=True)
    assert table["low"] == pytest.approx([0.0, np.nan], nan_ok=True) and table["high"] == pytest.approx([21.0, 1.0])


@catches("a distance from the reference where nothing is left to hear").at(
    "validation.advice.table.counted_bands", lambda comparison, one: np.full(comparison.value_of(one).size, True)
)
@catches("decibels of a power as those of an amplitude").at(
    "validation.advice.table.decibels", lambda error: 10 * np.log10(1 + error)
)
def test_a_distance_in_decibels_has_the_errors_of_its_band_and_the_reference_that_of_its_worst():
    """Of the bands that count, that in which models are farthest; without grid and sample both errors add there."""
    found = solved(RAIL)
    table, (reference, *others) = speed_and_accuracy(found), found.selection.solved
    counted = found.value_of(reference) > -15
    own = table.where(model=reference.name)
    assert (own["unit"][0], own["is_reference"][0]) == ("dB", True)
    assert own["high"][0] == pytest.approx(found.errors_of(reference)[counted].max())
    for one in others:
        off = np.where(counted, np.abs(found.value_of(one) - found.value_of(reference)), 0)
        at = int(np.argmax(off))
        half = found.errors_of(one)[at] + found.errors_of(reference)[at]
        (row,) = (
            list(of) for of in zip(*(table.where(model=one.name)[x] for x in ("error", "low", "high")), strict=True)
        )
        assert row == pytest.approx([off[at], max(off[at] - half, 0), off[at] + half])


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


@catches("curves in the order of their cost").at(
    "validation.advice.figure.shown_models", lambda found: [one.name for one in found.models]
)
def test_five_curves_at_the_most_are_told_apart_in_colour_and_in_grey():
    found = planted("rail", "contact-filter")
    title, ((panel, _),) = panels_of([found])
    styles = styles_of([curve.model for curve in panel.curves]).values()
    assert len(found.selection.solved) > len(styles) == MOST == len({style["color"] for style in styles})
    assert len({(style["linestyle"], style["marker"]) for style in styles}) == MOST
    assert panel.curves[0].label == f"{found.model}, selected" and title.endswith("all are in the CSV")
    assert [curve.band for curve in panel.curves] == [True] + [False] * 4


def test_a_spectrum_has_an_axis_of_frequencies_where_all_curves_have_one_speed():
    rail = planted("rail", "contact-filter")
    _, ((panel, table),) = panels_of([rail])
    assert panel.above == ("frequency [Hz]", pytest.approx(1e3 * rail.scene.speed)) and panel.downward
    assert table["wavelength [mm]"].tolist() == table["wavelength_mm"].tolist()
    fast = replace(rail, scene=replace(rail.scene, name="fast", speed=2 * rail.scene.speed))
    _, ((panel, table),) = panels_of([rail, fast])
    assert panel.above is None and [curve.label for curve in panel.curves] == [rail.scene.name, "fast"]


def test_numbers_have_a_row_a_model_and_the_interval_of_the_selected_one():
    found = compared(Finding(name="a"), Finding(name="b", claimed=0.5), solve_all=True)
    title, ((panel, table),) = panels_of([found, replace(found, quantity="force-rms")][:1])
    assert (title, panel.x, table["row"].tolist()) == ("punch: stiffness", "stiffness [N/m]", ["a,\nselected", "b"])
    assert [(curve.model, curve.style) for curve in panel.curves] == [((), ""), ("a", "interval")]
    _, ((panel, table),) = panels_of([found, found])
    assert [name.strip("\N{ZERO WIDTH SPACE}") for name in table["row"]] == ["punch", "punch"]
    assert len(set(table["row"])) == 2 and len(panel.curves) == 1
    _, ((panel, _),) = panels_of([compared(Fake(failed="lost"))])
    assert panel.title == "no model has a result with a known error" and not panel.curves


def test_errors_over_seconds_are_points_with_names_and_a_tolerance():
    cheap, dear = (Finding(name=f"{value}", parts=(e, 0, 0), value=(value,)) for value, e in ((2.2, 0.1), (2.0, 0.01)))
    panel, table = errors_over_seconds(compared(cheap, dear, solve_all=True))
    assert [curve.label for curve in panel.curves] == ["2.2, selected", "2.0, its own error"]
    assert table["value"] == pytest.approx([10.0, 1.0]) and panel.limits == {"tolerance, 20 %": pytest.approx(20.0)}
    assert table["low"][0] == panel.ylim[0] == pytest.approx(1.0 / 1.6)


def test_the_curves_are_selected_reference_mdr_and_the_nearest():
    """Of numbers: 2.1 is nearer to the selected 2.2 than 1.5."""
    models = [
        Finding(name="far", parts=(0.15, 0, 0), value=(1.5,)),
        Finding(name="near", parts=(0.15, 0, 0), value=(2.1,), claimed=0.5),
        Finding(name="poor", parts=(0.4, 0, 0), value=(9.0,), is_mdr=True),
        Finding(name="best", parts=(0.01, 0, 0), value=(2.3,)),
        Finding(name="springs", parts=(0.3, 0, 0), value=(7.0,), is_mdr=True),
    ]
    found = compared(replace(models[0], name="chosen", value=(2.2,)), *models, solve_all=True)
    assert shown_models(found) == ["chosen", "best", "springs", "near", "far", "poor"]


def test_names_of_the_last_release_work_and_name_the_new_ones():
    comparison = compared(Fake(claimed=0.1))
    with pytest.warns(FutureWarning, match=r"Comparison\.asked is Comparison\.scene_quantity now"):
        assert comparison.asked is comparison.scene_quantity
    with pytest.warns(FutureWarning, match="claimed of a model is predicted_error now"):
        assert comparison.models[0].claimed == comparison.models[0].predicted_error == 0.1
