"""What functions of the face take: one comparison or a list; names of models in one text, or as an index."""

import csv
import json

import pytest

import validation
from tests.selection.planted_answers import Fake, Finding, compared, punch


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
    assert "scene" not in validation.to_csv(TWO[0]).splitlines()[0]


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
