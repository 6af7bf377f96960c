"""What scripts of other people rely on: names of `validation`, the result of a comparison, the command beside it."""

import ast
import copy
import csv
import inspect
import io
import pickle
import re
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import bem3d
import mdr
import validation
from tests.seeded import catches
from validation.__main__ import main
from validation.advice.compare import Comparison
from validation.advice.hierarchy import Candidate, Selection
from validation.advice.scene_model import Answer
from validation.advice.tolerance import Tolerance
from validation.analysis.series import Series
from validation.engine.street import HOUSES
from validation.scenes.rolling import RollingQuantity
from validation.simulation.method import Resolution
from validation.simulation.model import Cost, ErrorEstimate

SPHERE = validation.load_scene("sphere")
SPECTRUM = {"quantity": "force-spectrum", "tolerance": 0.3}


@cache
def spectrum():
    return validation.compare(validation.load_scene("rolling_wheel"), **SPECTRUM)


@pytest.mark.parametrize("name", validation.__all__)
def test_every_name_is_there(name):
    assert getattr(validation, name) is not None
    assert name in dir(validation)
    assert validation.MODULES[name].split(".")[0] in {"analysis", "report", "benchmarks", "scenes", *HOUSES}


def test_the_stub_says_the_same():
    stub = ast.parse(Path(validation.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    imports = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    said = {name.asname: node.module.removeprefix("validation.") for node in imports for name in node.names}
    assert said == validation.MODULES


def test_completion_shows_the_face_alone():
    assert {name for name in dir(validation) if not name.startswith("__")} == set(validation.MODULES)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="module 'validation' has no attribute 'compute'"):
        _ = validation.compute


def test_importing_the_face_imports_nothing_else():
    line = "import sys, validation; print([m for m in sys.modules if m == 'numpy' or m.startswith('validation.')])"
    assert (
        subprocess.run([sys.executable, "-c", line], capture_output=True, encoding="utf-8", check=True).stdout == "[]\n"
    )


def test_a_number_comes_in_si_units_with_its_relative_error():
    result = validation.compare(SPHERE, tolerance=0.01)
    assert (result.quantity, result.model, result.met, result.unit) == ("stiffness", "closed form", True, "N/m")
    assert type(result.value) is float and result.value == pytest.approx(SPHERE.stiffness)
    assert (result.error, result.wavenumbers.size) == (0.0, 0)
    (first,) = (model for model in result.models if model.name == "closed form")
    assert (first.status, first.error, first.reason) == ("accepted", 0.0, "exact for a smooth body")
    assert first.cost > 0


@catches("a level of the face without its logarithm").at(
    "validation.advice.compare.Comparison.is_level", property(lambda result: False)
)
def test_levels_come_in_decibels():
    result = spectrum()
    answer = result.selection.best.answer
    assert result.unit == "dB re 1 N"
    assert 10 ** (result.value / 20) == pytest.approx(answer.value)
    assert 10 ** (result.error / 20) == pytest.approx(1 + answer.error)
    bands = RollingQuantity(result.scene, "force-spectrum").bands
    assert result.wavenumbers.tolist() == bands.centres.tolist()


def comparison(status, *, failed="", quantity="stiffness"):
    class Model:
        name, kind, is_mdr = "model", "model", False

        def cost(self):
            return Cost(work=1, seconds=2.0)

    cost, estimate = Cost(work=1, seconds=1.0), ErrorEstimate(model=0.1, reason="why")
    answer = Answer(value=np.array([2.0]), cost=cost, model=0.3, failed=failed)
    scene = SPHERE if quantity == "stiffness" else validation.load_scene("rolling_wheel")
    return Comparison(scene, quantity, Selection(0.2, (Candidate(Model(), status, "why", estimate, answer),)))


@catches("a tolerance of the face that is always met").at(
    "validation.advice.hierarchy.Selection.met", property(lambda selection: True)
)
def test_a_missed_tolerance_leaves_the_best_value():
    result = comparison("not accurate enough")
    assert (result.met, result.model, result.value, result.error) == (False, "model", 2.0, 0.3)
    assert (result.models[0].status, result.models[0].cost) == ("not accurate enough", 2.0)


@pytest.mark.parametrize("quantity", ["stiffness", "force-spectrum"])
def test_without_an_answer_there_is_no_number(quantity):
    result = comparison("failed", failed="why", quantity=quantity)
    assert (result.met, result.model, result.error) == (False, "", np.inf)
    assert np.isnan(result.value).all()
    assert result.wavenumbers.size == 0


@pytest.mark.parametrize(
    ("arguments", "error", "sentence"),
    [
        (("sphere",), TypeError, "scene must be what load_scene returns, got str"),
        (
            (SPHERE, {"quantity": "force-rms"}),
            ValueError,
            "quantity must be one of stiffness for scene 'Smooth sphere'",
        ),
        ((SPHERE, 0.0), ValueError, "tolerance must be"),
        ((SPHERE, "10 dBa"), ValueError, "tolerance must be as .* got '10 dBa'"),
        ((SPHERE, {"seed": -1}), ValueError, "seed must be at least 0, got -1"),
        ((SPHERE, {"seed": 0.5}), TypeError, "seed must be a whole number, got 0.5"),
        ((SPHERE, "10 %", 1), TypeError, "compare takes scene and tolerance by place, .* got 3 places"),
    ],
)
def test_bad_input_is_refused_in_one_sentence(arguments, error, sentence):
    places = [argument for argument in arguments if not isinstance(argument, dict)]
    named = next((argument for argument in arguments if isinstance(argument, dict)), {})
    with pytest.raises(error, match=sentence):
        validation.compare(*places, **named)


@catches("a tolerance in the second place that is not read").at(
    "validation.advice.compare.tolerance_of", lambda tolerance: Tolerance(0.1)
)
def test_a_tolerance_stands_in_the_second_place():
    scene = validation.load_scene("rolling_wheel")
    for text, relative in (("3 %", 0.03), ("1 dB", 10 ** (1 / 20) - 1), (0.2, 0.2)):
        result = validation.compare(scene, text, quantity="force-spectrum", models="linear filter, 3D")
        assert result.tolerance.relative == pytest.approx(relative) and result.quantity == "force-spectrum"
    assert list(inspect.signature(validation.compare).parameters)[:3] == ["scene", "tolerance", "quantity"]


def test_a_quantity_in_the_second_place_works_for_one_release():
    scene, models = validation.load_scene("rolling_wheel"), "linear filter, 1D"
    for places in (("force-spectrum",), ("force-spectrum", "1 dB"), ("force-spectrum", 0.2, 3), (None, 0.2)):
        named = dict(zip(("quantity", "tolerance", "seed"), places, strict=False))
        with pytest.warns(FutureWarning, match="compare takes a tolerance in second place now"):
            earlier = validation.compare(scene, *places, models=models)
        assert validation.to_json(earlier) == validation.to_json(validation.compare(scene, **named, models=models))
    with pytest.warns(FutureWarning), pytest.raises(ValueError, match="quantity must be one of force-rms"):
        validation.compare(scene, "loudness")


@pytest.mark.parametrize("name", ["nowhere", 5])
def test_a_scene_that_is_not_there_is_refused_with_those_that_are(name):
    sentence = f'^scene must be a file, as "./{name}.toml", or one of rail, rolling_wheel, .*sphere'
    with pytest.raises(ValueError, match=sentence):
        validation.load_scene(name)


def test_the_command_prints_the_summary(capsys):
    words = ["compare", "rolling_wheel", "--quantity", SPECTRUM["quantity"], "--tolerance", "30%", "--verbose"]
    assert main(words) == 0
    assert capsys.readouterr().out == f"{validation.summary(spectrum())}\n"


@catches("a table whose rows have the half-width of another part of the error").at(
    "validation.advice.compare.Comparison.error_parts_of",
    lambda result, candidate: dict.fromkeys(("model", "grid", "sample"), 7.0),
)
def test_a_table_has_the_numbers_with_their_error_and_the_scene():
    result = spectrum()
    rows = result.table()
    assert {type(cell) for row in rows for cell in row.values()} <= {float, int, str, bool, type(None)}
    assert [row["model"] for row in rows if row["selected"]] == [result.model] * result.wavenumbers.size
    assert {row["model"] for row in rows} == {candidate.name for candidate in result.models}
    selected = {name: np.array([row[name] for row in rows if row["selected"]]) for name in rows[0]}
    assert selected["value"] == pytest.approx(result.value)
    assert selected["wavelength_mm"].tolist() == result.wavelength_mm.tolist()
    parts = [selected[f"error_{name}"] for name in ("model", "grid", "sample")]
    assert np.isclose(parts[0] + np.hypot(*parts[1:]), selected["error"]).all()
    scene = result.scene
    asked = {"scene": scene.name, "scene.load": scene.load, "scene.ground.rms": scene.ground.rms, "tolerance": 0.3}
    assert all(row | asked == row and row["status"] for row in rows)
    assert all(row["seconds"] > 0 for row in rows if row["solved"])
    written = [row for row in csv.DictReader(validation.to_csv(result).splitlines()) if row["selected"] == "True"]
    assert [float(row["error_model"]) for row in written] == pytest.approx(parts[0])
    assert {float(row["scene.load"]) for row in written} == {scene.load}


@pytest.mark.parametrize("through", [copy.copy, copy.deepcopy, lambda result: pickle.loads(pickle.dumps(result))])
@catches("a model that is pickled without its grid", copy.deepcopy).at(
    "validation.advice.scene_model.SceneModel.__getstate__",
    lambda model: {**vars(model), "shared": {}, "resolution": Resolution()},
)
def test_a_comparison_is_copied_and_pickled_whole(through):
    result = validation.compare(validation.load_scene("rough_punch"), models=["fit", "mdr"])
    other = through(result)
    assert validation.to_json(other) == validation.to_json(result)
    assert validation.summary(other) == validation.summary(result)
    assert [model.model.resolution for model in other.models] == [model.model.resolution for model in result.models]
    assert pickle.loads(pickle.dumps(other)).model == result.model
    assert not any(model.model.shared for model in other.models) or through is copy.copy


def test_a_judgement_is_copied_and_pickled_whole():
    @validation.stiffness_model("flat punch")
    def flat(side, modulus):
        return 1.1523 * modulus * side

    judgement = validation.judge(flat)
    for other in (copy.copy(judgement), copy.deepcopy(judgement), pickle.loads(pickle.dumps(judgement))):
        assert (other.as_dict(), other.summary()) == (judgement.as_dict(), judgement.summary())


PUNCH = validation.load_scene("rough_punch")
NAMED = validation.stiffness_model("a model whose name is much longer than what a line has room for, by far and away")
LONG = NAMED(lambda load, side: 1.0)


@cache
def judgement():
    return validation.judge(NAMED(lambda side, modulus: 1.1523 * modulus * side))


def printed():
    """One of each kind that a person prints."""
    result, judged, punch = spectrum(), judgement(), validation.compare(PUNCH, models=["fit", "mdr"])
    body = bem3d.HalfSpace(shape=(32, 32), spacing=1e-5 / 3, modulus=1e11 / 3, periodic=True, planning="measure")
    x = (np.arange(32) - 15.5) * 1e-5 / 3
    contact = bem3d.solve(replace(body, periodic=False), (x[:, None] ** 2 + x**2) / 0.02, approach=1e-7 / 3)
    curve = mdr.load_curve(x**2 / 3, length=1e-3 / 3, modulus=1e11 / 3)
    track = bem3d.Track(height=np.outer(x, x) / 3, spacing=1e-5 / 3, radius=1 / 3, modulus=1e11 / 3)
    return [
        *(validation.load_scene(name) for name in ("sphere", "rolling_wheel", "rail", "table_14_1", "rough_wheel")),
        *(PUNCH, replace(PUNCH, name="n" * 300), PUNCH.material, PUNCH.ground, PUNCH.ground.spectrum),
        validation.MeasuredHeights(height=np.outer(x, x), spacing=(1e-5 / 3, 1e-5 / 7)),
        *(result, comparison("failed"), replace(result, scene=replace(result.scene, name="n" * 300))),
        *(item for found in (result, punch) for item in (found.models, *found.models, found.selection)),
        *(model.model for model in punch.models),
        *(model.model.model for model in punch.models),
        *(judged, judged.numbers[0], judged.ranges[0], judged.tolerance, LONG),
        *(body, contact, contact.problem, bem3d.solve_fixed_area(contact.problem.half_space, contact.pressure > 0)),
        *(track, curve, curve.at_approach(1e-9 / 3), mdr.press_sphere(radius=1 / 3, modulus=1e11 / 3, force=1 / 3)),
        mdr.SelfAffine(hurst=1 / 3, q_min=1e3 / 3, q_max=1e6 / 3, rms=1e-6 / 3),
        *(validation.CASES["geike"], *validation.problems()),
        Series("a quantity of which much is to be read [dB]", "a model", np.ones(300), along="x [mm]", at=np.ones(300)),
        validation.load_scene("rail").roughness,
    ]


@catches("a result that prints all that it holds").at(
    "validation.scenes.scene.SceneDefaults.__repr__", lambda scene: f"{vars(scene)}"
)
def test_a_result_prints_one_line():
    for thing in printed():
        line = repr(thing)
        assert len(line) < 100 and line.isprintable() and " at 0x" not in line, line
    assert repr(spectrum()).startswith("Comparison('Rolling wheel': force-spectrum, 9 bands ± ")
    assert (
        repr(comparison("accepted")) == "Comparison('Smooth sphere': stiffness = 2 N/m ± 30 % by 'model', within 20 %)"
    )
    assert "outside tolerance" in repr(judgement())


@catches("a name that is markup").at("validation.analysis.contents.escape", str)
def test_a_notebook_shows_the_answer_and_a_small_table_without_markup_of_others():
    scene = replace(PUNCH, name="<script>alert(1)</script>")
    result = validation.compare(scene, models=["fit", "mdr"])
    for thing, first in ((scene, ""), (result, "stiffness = "), (judgement(), "a model whose name")):
        html = thing._repr_html_()
        assert "<script" not in html
        body = ElementTree.fromstring(html)
        answer, table = body.find("p/strong").text, body.find("table")
        assert first in answer
        assert 2 <= len(table.findall("tr")) <= 13
        # neither black on black nor white on white
        assert not re.search(r"(background|color: (?!inherit)|#[0-9a-f]{3})", html)
    assert "&lt;script&gt;" in result._repr_html_() and "not asked" in result._repr_html_()


@catches("a figure in the place of the axes of a user").at("validation.report.drawing.Axes", type("Axes", (), {}))
def test_results_are_drawn_on_axes_of_a_user():
    result = spectrum()
    numbers = validation.compare(PUNCH, models=["fit", "mdr"])
    for thing in (result, numbers, comparison("failed"), judgement()):
        axis = Figure().add_subplot()
        try:
            assert thing.plot(axis) is axis and axis.get_title(loc="left")
        except TypeError as error:
            raise AssertionError from error
        with pytest.raises(TypeError, match="ax must be an Axes of matplotlib, or None for a new figure, got Figure"):
            thing.plot(Figure())
    axis = Figure().add_subplot()
    levels = result.plot(axis).lines[0].get_ydata()
    assert levels == pytest.approx(result.value) and axis.get_ylabel() == "force-spectrum [dB re 1 N]"


def test_a_name_of_a_user_is_no_formula_in_a_figure():
    result = replace(spectrum(), scene=replace(spectrum().scene, name=r"$\frac{$ 5 $"))
    axis = result.plot(Figure().add_subplot())
    axis.figure.savefig(io.BytesIO())
    assert r"$\frac{$ 5 $" in axis.get_title(loc="left")


def test_without_axes_there_is_a_new_figure(monkeypatch):
    monkeypatch.setattr(pyplot, "subplots", lambda **_: (None, Figure().add_subplot()))
    assert isinstance(spectrum().plot(), Axes) and isinstance(judgement().plot(), Axes)


def test_a_case_runs_from_its_settings():
    case = validation.CASES["geike"]
    assert case.evidence(case.run(case.quick)).numbers
