"""Models that are named are solved, and no others; those out of their range too, without an error."""

import math

import pytest

import validation
from tests.selection.test_model_hierarchy import Fake
from validation.__main__ import main
from validation.scenes.load import load_varied
from validation.selection.hierarchy import select_model
from validation.selection.named_models import models_named, names_in
from validation.selection.quantities import models_of
from validation.selection.summary import WIDTH, summary


def solved(scene, quantity, tolerance, models):
    found = validation.compare(validation.load_scene(scene), quantity, tolerance, models=models)
    assert max(map(len, summary(found).splitlines())) <= WIDTH
    return found, [one.name for one in found.selection.solved]


def test_short_names_are_mdr_and_the_grid_that_claims_the_tolerance():
    found, names = solved("rough_punch", "stiffness", 0.3, ["mdr", "bem"])
    assert names == ["springs", "boundary elements 64²"]
    assert [one.status for one in found.models if one.name not in names] == ["not asked"] * 3
    assert "side by side; differences from boundary elements 64²" in summary(found)


def test_a_model_that_was_not_asked_may_help():
    found, _ = solved("rough_punch", "stiffness", 0.1, ["fit"])
    assert not found.met
    assert "what would help: boundary elements 64², which was not asked and claims 5 %" in summary(found)


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (["springs"], ["springs"]),
        (["Linear filter, 3D", "mdr"], ["linear filter, 3D", "springs", "springs that read the surface"]),
        (["boundary elements, a = 12"], ["boundary elements, a = 12 cells"]),
        (["pressed", "boundary elements"], ["pressed layer", "boundary elements, a = 8 cells"]),
    ],
)
def test_models_have_their_names_and_beginnings(names, expected):
    models = models_of(validation.load_scene("rolling_wheel"), "force-spectrum", 0.4, 0)
    assert [model.name for model in models_named(models, names, 0.4)] == expected


def test_bem_are_the_boundary_elements_of_a_rail_too():
    models = models_of(validation.load_scene("rail"), "contact-filter", 0.1, 0)
    assert [model.name for model in models_named(models, "linear, ellipse, bem", 0.1)] == [
        "linear, ellipse",
        "boundary elements",
    ]


@pytest.mark.parametrize("names", ["boundary elements 12²", "", "mdr,,bem"])
def test_other_names_are_refused_with_those_that_there_are(names, capsys):
    assert main(["compare", "rolling_wheel", "--quantity", "force-spectrum", "--models", names]) == 2
    said = capsys.readouterr().err
    assert '"linear filter, 1D", "linear filter, 3D", "springs"' in said and "models must be mdr, bem or" in said


def test_a_beginning_of_several_names_is_refused_with_these(capsys):
    assert main(["compare", "rolling_wheel", "--quantity", "force-spectrum", "--models", "linear"]) == 2
    assert (
        'error: models: "linear" begins 2 names, "linear filter, 1D", "linear filter, 3D"\n' in capsys.readouterr().err
    )


def test_names_with_commas_stand_in_a_list_with_commas():
    known = ["linear filter, 1D", "springs", "boundary elements, a = 8 cells"]
    assert names_in("mdr,Linear filter,1D, springs", known) == ["mdr", "Linear filter, 1D", "springs"]


def test_a_scene_without_springs_says_so(capsys):
    assert main(["compare", "sphere", "--models", "mdr"]) == 2
    assert 'models of this scene, "closed form", got "mdr"' in capsys.readouterr().err


def test_a_model_out_of_its_range_is_solved_without_an_error():
    found, names = solved("table_14_1", "acceleration", 0.1, ["mdr", "linear filter, 3D"])
    assert names == ["linear filter, 3D", "springs"]
    assert {one.status for one in found.models} == {"out of range", "not asked"}
    assert (found.met, found.model, found.error) == (False, "", math.inf)
    text = summary(found)
    assert "no model has a known error" in text and "side by side" in text
    (row,) = [line for line in text.splitlines() if line.startswith("springs (MDR)")]
    assert "out of range" in row and "solved: its error is unknown" in row and "not solved" not in row
    assert all(math.isfinite(value) for one in found.selection.solved for value in found.value_of(one))


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


def test_a_scene_without_a_steady_answer_is_not_solved_out_of_range():
    """Waves that excite the resonance: the level grows with the distance, and belongs to no model."""
    scene = load_varied("table_14_1", "wheel.speed", "2 m/s")
    found = validation.compare(scene, "acceleration", solve_all=True)
    assert not found.selection.solved and {one.status for one in found.models} == {"out of range"}
