"""Models that are named are solved, and no others, in one text or as an index; what functions of the face take."""

import csv
import json
import math

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import Fake, Finding, compared, punch
from tests.seeded import catches
from validation.__main__ import main
from validation.advice.compare import SceneProblem
from validation.advice.hierarchy import select_model
from validation.advice.models_of_scene import models_named, models_of, quantities_of
from validation.advice.summary import WIDTH, summary
from validation.scenes.load import load_varied
from validation.simulation.model_names import SPRINGS_THAT_READ, label_of

SPECTRUM = "rolling_wheel --quantity force-spectrum"


def solved(scene, quantity, tolerance, models):
    found = validation.compare(validation.load_scene(scene), quantity=quantity, tolerance=tolerance, models=models)
    assert max(map(len, summary(found).splitlines())) <= WIDTH
    return found, [one.name for one in found.selection.solved]


def test_short_names_are_mdr_and_the_grid_that_claims_the_tolerance():
    found, names = solved("rough_punch", "stiffness", 0.3, ["mdr", "bem"])
    assert names == ["springs", "boundary elements 64²"]
    assert [one.status for one in found.models if one.name not in names] == ["not asked"] * 3
    assert "side by side; differences from boundary elements 64²" in summary(found)


@catches("dominated models among those that are offered", models=(), count=0).at(
    ("validation.advice.models_of_scene.BY_NAME", "validation.advice.compare.BY_NAME"), ()
)
@pytest.mark.parametrize(("models", "count"), [((), 0), (("Remington",), 0), ((SPRINGS_THAT_READ,), 1), (("mdr",), 1)])
def test_springs_that_read_the_surface_are_there_by_name_alone(models, count):
    rail = SceneProblem(validation.load_scene("rail"), ("contact-filter",), 0.3, models=models)
    for listed in rail.listed_and_solvable("contact-filter"):
        assert [one.kind for one in listed].count(SPRINGS_THAT_READ) == count


@pytest.mark.parametrize(
    ("scene", "quantity", "names", "expected"),
    [
        ("rolling_wheel", "force-spectrum", ["springs"], ["springs"]),
        (
            *("rolling_wheel", "force-spectrum", "Linear filter,3D, mdr"),
            ["linear filter, 3D", "springs"],
        ),
        ("rolling_wheel", "force-spectrum", ["boundary elements, a = 12"], ["boundary elements, a = 12 cells"]),
        (
            *("rolling_wheel", "force-spectrum", ["spr", "boundary elements"]),
            ["springs", "boundary elements, a = 8 cells"],
        ),
        ("rail", "contact-filter", "linear, ellipse, bem", ["linear, ellipse", "boundary elements"]),
    ],
)
def test_models_have_their_names_and_beginnings(scene, quantity, names, expected):
    models = models_of(validation.load_scene(scene), quantity, 0.4, 0, include_by_name=True)
    assert [model.name for model in models_named(models, names, 0.4)] == expected


@pytest.mark.parametrize(
    ("scene", "names", "said"),
    [
        (SPECTRUM, "mdr,,bem", '"linear filter, 1D", "linear filter, 3D", "springs"'),
        (SPECTRUM, "", "models must be mdr, bem or names of models of this scene"),
        (SPECTRUM, "linear", 'models: "linear" begins 2 names, "linear filter, 1D", "linear filter, 3D"\n'),
        ("sphere", "mdr", 'models must be mdr, bem or names of models of this scene, "closed form", got "mdr"'),
    ],
)
def test_other_names_are_refused_with_those_that_there_are(scene, names, said, capsys):
    assert main(["compare", *scene.split(), "--models", names]) == 2
    assert said in capsys.readouterr().err


def test_a_model_out_of_its_range_is_solved_without_an_error():
    found, names = solved("table_14_1", "acceleration", 0.1, ["mdr", "linear filter, 3D"])
    assert names == ["linear filter, 3D", "springs"]
    assert {one.status for one in found.models} == {"out of range", "not asked"}
    assert (found.met, found.model, found.error) == (False, "", math.inf)
    assert "no model has a known error" in summary(found)
    assert all(math.isfinite(value) for one in found.selection.solved for value in np.atleast_1d(found.value_of(one)))
    # waves that excite the resonance: the level grows with the distance, and belongs to no model
    endless = validation.compare(
        load_varied("table_14_1", "wheel.speed", "2 m/s"), quantity="acceleration", solve_all=True
    )
    assert not endless.selection.solved and {one.status for one in endless.models} == {"out of range"}


def test_a_model_that_fails_out_of_its_range_says_why():
    models = [
        Fake(claimed=math.inf, failed="lost"),
        Fake(claimed=math.inf, name="found", left=math.inf),
        Fake(claimed=math.inf),
    ]
    found = select_model(models, 0.1, solve_all=True, beyond=lambda model: model is not models[2])
    assert [(one.status, one.reason) for one in found.candidates] == [
        ("failed", "lost"),
        ("out of range", "leaves inf"),
        ("out of range", "claims inf"),
    ]
    assert [one.name for one in found.solved] == ["found"] and found.best is None and not found.met


def of(name="it", value=1.0, parts=(0.0, 0.0, 0.0)):
    models = Finding(name="springs", value=(value,), parts=parts), Fake(name="boundary elements 64²")
    return compared(*models, scene=punch(load=1.0, name=name))


TWO = [of("one", 1.0), of("two", 2.0)]


def test_a_list_becomes_a_list_of_objects():
    assert json.loads(validation.to_json(TWO)) == [json.loads(validation.to_json(one)) for one in TWO]
    assert json.loads(validation.to_json(TWO[:1])) == [json.loads(validation.to_json(TWO[0]))]


def test_a_list_becomes_one_table_with_its_scenes():
    rows = list(csv.DictReader(validation.to_csv(tuple(TWO)).splitlines()))
    assert [(row["scene"], row["value"], row["model"]) for row in rows] == [
        ("one", "1", "springs"),
        ("two", "2", "springs"),
    ]
    assert "scene" not in validation.to_csv(TWO[0]).splitlines()[0].split(",")


@pytest.mark.parametrize("write", [validation.to_json, validation.to_csv, validation.to_figure, validation.summary])
@pytest.mark.parametrize(
    ("given", "error"), [([], ValueError), ([TWO[0], 1], TypeError), ("text", TypeError), (None, TypeError)]
)
def test_what_is_no_comparison_is_refused(write, given, error):
    with pytest.raises(error, match="comparison must be "):
        write(given)


def test_a_model_is_found_by_its_name_or_the_beginning_of_it():
    models = TWO[0].models
    assert models["springs"] is models[0] is models["Spr"] and models["boundary"] is models[1] is models[-1]
    assert models[:1] == (models[0],) and len(models) == 2
    for name in ("nothing", "", " "):
        with pytest.raises(KeyError, match="models must be named by one of "):
            models[name]
    twins = compared(Fake(name="fit a"), Fake(name="fit b")).models
    with pytest.raises(KeyError, match='"fit a"'):
        twins["fit"]
    found = compared(Fake(name="springs"), Fake(name="springs that read the surface")).models
    assert found["springs"] is found[0] and found["springs that"] is found[1]


@pytest.mark.parametrize("names", [["mdr", 3], [None]])
def test_names_that_are_no_texts_are_refused(names):
    with pytest.raises(TypeError, match="models must be names, got "):
        validation.compare(validation.load_scene("rough_punch"), models=names)


@pytest.mark.parametrize(
    ("scene", "quantity", "names", "expected"),
    [
        ("rough_punch", "stiffness", "MDR, series model", ["fit", "springs"]),
        ("rough_punch", "stiffness", "BEM, 64 cells per side", ["boundary elements 64²"]),
        ("rolling_wheel", "force-spectrum", "linear half-space filter", ["linear filter, 3D"]),
        ("rolling_wheel", "force-spectrum", "1d linear filter, sin(ka)/(ka), bem", None),
        ("rolling_wheel", "force-spectrum", ["BEM, 8 cells per contact"], ["boundary elements, a = 8 cells"]),
        ("rail", "contact-filter", "MDR, Geike PSD", ["springs, Geike's rule"]),
        ("rail", "contact-filter", "MDR, rolling-equivalent PSD", ["springs, rolling spectrum"]),
        ("rail", "contact-filter", ["MDR, single line"], ["springs on the line"]),
        ("rail", "contact-filter", "MDR, cross-averaged line, 1D linear filter", None),
        ("rail", "contact-filter", "MDR, cross-averaged surface", ["springs that read the surface"]),
        ("rail", "contact-filter", "linear half-space filter", ["linear, ellipse"]),
        ("rail", "contact-filter", "DPRS (Winkler bed)", ["spring bed (DPRS), linear"]),
        ("rail", "contact-filter", "DPRS (Winkler bed), one-sided", ["spring bed (DPRS), one-sided"]),
        ("rail", "contact-filter", "Remington filter", ["Remington"]),
    ],
)
def test_labels_of_the_field_stand_for_the_printed_ones(scene, quantity, names, expected):
    models = models_of(validation.load_scene(scene), quantity, 0.4, 0, include_by_name=True)
    two = {
        "rolling_wheel": ["linear filter, 1D", "boundary elements, a = 8 cells"],
        "rail": ["linear, on the line", "springs on the mean across"],
    }
    assert [model.name for model in models_named(models, names, 0.4)] == (expected or two[scene])


@pytest.mark.parametrize("scene", ["rail", "rolling_wheel", "rough_punch", "table_14_1"])
def test_every_model_of_a_scene_has_a_label_of_its_own(scene):
    loaded = validation.load_scene(scene)
    models = [model for key in quantities_of(loaded) for model in models_of(loaded, key, 0.1, 0, include_by_name=True)]
    labels = {model.name: label_of(model.name) for model in models}
    assert len({label.lower() for label in labels.values()}) == len(labels)
    for model in models_of(loaded, quantities_of(loaded)[0], 0.1, 0, include_by_name=True):
        siblings = models_of(loaded, quantities_of(loaded)[0], 0.1, 0, include_by_name=True)
        chosen = {found.name for found in models_named(siblings, [label_of(model.name)], 0.1)}
        assert model.name in chosen and (len(chosen) == 1 or label_of(model.name) == "MDR")


@pytest.mark.parametrize(
    ("names", "note"),
    [
        ("series model", 'note: "series model" and "fit" are labels of one model; results have the latter.\n'),
        ("fit", 'note: "series model" and "fit" are labels of one model; results have the latter.\n'),
        ("mdr", ""),
    ],
)
def test_a_note_has_both_labels_of_a_model(names, note, capsys):
    assert main(["compare", "rough_punch", "--tolerance", "60%", "--models", names]) in (0, 3)
    assert "".join(line for line in capsys.readouterr().err.splitlines(keepends=True) if "note" in line) == note


def test_results_are_found_by_labels_of_the_field():
    found = compared(Fake(name="springs"), Fake(name="boundary elements 64²")).models
    assert found["MDR"] is found[0] and found["BEM, 64 cells per side"] is found[1]
