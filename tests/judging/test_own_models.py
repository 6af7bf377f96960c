"""Models of somebody's own in `compare`: measured beside stored answers of boundary elements, and chosen by that."""

import json
import math
import tempfile
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mdr
import validation
from tests.advice.script import calibrate
from tests.seeded import catches, module_with
from validation.__main__ import main
from validation.advice import calibration
from validation.advice.calibration_scenes import OTHER_SEED, Answers, CalibrationScene, answers_in
from validation.advice.models import boundary_elements_pressed
from validation.engine.engine import Engine
from validation.judging import own_models, source_files
from validation.judging.own_models import OwnPart, calibrated, measure_own, models_in, result_of
from validation.railway.models import rail
from validation.railway.problems.rail_models import ContactFilter
from validation.simulation.indentation import height_of
from validation.simulation.method import distance
from validation.simulation.model import ErrorEstimate, Target, models_serving
from validation.theory.closed_forms import rough_punch_stiffness

PUNCH = ("punch", "stiffness")
SCENES, UNANSWERED, OPEN = 26, 3, 7
LEAVES = 0.01
"""Of every answer but one, of which it is not known."""
ROUGH = validation.load_scene("rough_punch")


@validation.stiffness_model("interface in series")
def series(load, side, modulus, roughness):
    return rough_punch_stiffness(side=side, modulus=modulus, force=load, height=roughness.rms)


def without_a_file():
    namespace = {"series": series}
    exec("def law(load, side, modulus, roughness):\n    return series(load, side, modulus, roughness)", namespace)
    return validation.stiffness_model("from nowhere")(namespace["law"])


def factor(number):
    """By which boundary elements are stiffer than the law, another one on each scene."""
    return math.exp(0.001 * (number + 1))


def answers(value: Callable[[CalibrationScene], np.ndarray] | None = None) -> Answers:
    """Of punches; value: of each realisation, factor times the law without one. One of the scenes has none."""
    found = []
    for number in range(SCENES):
        point = CalibrationScene(kind="punch", number=number, quantity="stiffness", seed=19)
        scene = point.scene
        law = rough_punch_stiffness(side=1.0, modulus=1.0, force=scene.load, height=scene.ground.rms)
        each = value(point) if value else np.full((8, 1), factor(number) * law)
        reference = np.array(math.inf if number == OPEN else LEAVES)
        about = {"each": each, "reference": reference, "failed": np.array(number == UNANSWERED)}
        found.append((point, {"value": each.mean(axis=0), **about}))
    return Answers.of(found, {"command": "python .ci/calibrate.py --answers --punches 26 --seed 19"})


@contextmanager
def stored(*groups):
    """These answers in the place of those of the package, in an empty working folder."""
    with pytest.MonkeyPatch.context() as patch, tempfile.TemporaryDirectory() as folder:
        patch.setattr(own_models, "answers_in", lambda: dict(groups))
        patch.chdir(folder)
        yield Path(folder)


scenes_of = Answers.scenes


def next_scenes(answers, group):
    return ((replace(point, number=point.number + 1), *rest) for point, *rest in scenes_of(answers, group))


@catches("the error of the next scene of the calibration").at(
    "validation.advice.calibration_scenes.Answers.scenes", next_scenes
)
def test_each_error_is_that_of_its_own_scene_and_no_less_than_the_answer_leaves():
    """So that a model that was fitted to the answers is not known to be nearer."""
    with stored((PUNCH, known := answers())):
        (own,) = own_models.of_functions([series], ROUGH, "stiffness")
        measured = own.errors[PUNCH].measured
    numbers = [number for number in range(SCENES) if number not in (UNANSWERED, OPEN)]
    apart = np.log([factor(number) for number in numbers])
    np.testing.assert_allclose(measured.errors, np.maximum(apart, LEAVES), rtol=1e-9)
    scenes = [CalibrationScene(kind="punch", number=number, quantity="stiffness", seed=19).scene for number in numbers]
    np.testing.assert_allclose(measured.points[:, 0], np.log10([scene.reduced_load for scene in scenes]))
    assert sorted({*known.number.tolist()} - {OPEN}) == numbers


def test_a_calibrated_function_is_chosen_like_any_other():
    with stored((PUNCH, answers())):
        found = validation.compare(ROUGH, models=[series, "fit"])
    chosen = found.models["interface in series"]
    assert found.model == "interface in series" and found.met and 0.001 < chosen.error < 0.1
    assert found.value == series(ROUGH.load, ROUGH.size, ROUGH.modulus, ROUGH.ground.spectrum)
    assert found.models["springs"].status == "not asked"


@catches("a claim that is a distance of logarithms", off=0.7).at(
    "validation.judging.own_models.math", module_with(math, expm1=float)
)
@pytest.mark.parametrize("off", [1.3, 0.7])
def test_a_law_that_is_wrong_by_thirty_per_cent_claims_that_and_is_not_chosen(off):
    """Of its own value: what is right lies inside."""

    def right(point):
        scene = point.scene
        return np.full((1, 1), series(scene.load, scene.size, scene.modulus, scene.ground.spectrum) / off)

    with stored((PUNCH, answers(right))):
        found = validation.compare(ROUGH, models=series)
    (alone,) = found.selection.solved
    assert alone.error == pytest.approx(max(off, 1 / off) - 1) and not found.met


@pytest.mark.parametrize(
    ("models", "said"),
    [
        ([], r"functions with a decorator, or left out for all, got \[\]"),
        (series.function, "functions with a decorator, or left out for all, got <function series"),
        ("", 'must be mdr, bem or names of models of this scene, .*, got ""'),
        ([series, "fit", series], "two functions are offered as 'interface in series'"),
    ],
)
def test_no_model_and_one_twice_are_refused_before_any_is_measured(models, said, monkeypatch):
    monkeypatch.setattr(own_models, "of_functions", None)
    with pytest.raises(ValueError, match=said):
        validation.compare(ROUGH, models=models)


@catches("a model without references that is chosen").at(
    "validation.judging.own_models.OwnModel._claim", lambda own, *_: ErrorEstimate(reason="none is known")
)
def test_without_references_an_error_is_unknown_and_nothing_is_chosen():
    with stored():
        found = validation.compare(ROUGH, models=series)
        (alone,) = found.selection.solved
    assert not found.met and found.model == "" and math.isinf(alone.error) and alone.status == "out of range"
    assert "no answers of boundary elements are stored" in alone.reason and alone.answer.value[0] > 0


@catches("a function without a file that is stored").at(
    "validation.judging.own_models._digest_of_file", lambda offered: "a file"
)
def test_a_function_without_a_file_is_neither_calibrated_nor_stored():
    with stored((PUNCH, answers())) as folder:
        (own,) = own_models.of_functions([without_a_file()], ROUGH, "stiffness")
        calibrated(own, [PUNCH], Engine(store=folder / "store"))
        assert own.errors == {} and list(folder.iterdir()) == []
        found = validation.compare(ROUGH, models=[without_a_file(), "springs"], tolerance=0.2)
    assert found.model == "springs" and "without a file" in found.models["from nowhere"].reason


def test_the_table_of_the_package_was_measured_beside_the_stored_answers():
    """The error of a closed form is how far it is from the answer, but for what the residuals of two solves leave."""
    stored = answers_in()
    assert {kind for kind, _ in stored} == {"punch", "sphere", "wheel", "rolling"}
    for group, found in stored.items():
        name = {"punch": "fit", "sphere": "closed form"}.get(group[0])
        rows = {int(row["number"]): row for row in calibration.rows_of(calibration.TABLE) if row["model"] == name}
        for point, value, each in found.scenes(group) if name else ():
            target = point.target()
            (form,) = (one for one in models_serving(target.scene, point.quantity) if one.name == name)
            mine = form.prepare(target, form.resolutions(target)[0])(0)().values[point.quantity]
            known = pytest.approx(float(rows[point.number]["error"]), rel=calibrate.SAME, abs=calibrate.LEFT)
            assert abs(math.log(mine / value[0])) == known
            assert each.mean(axis=0) == pytest.approx(value)


FILE = """
from pathlib import Path
from validation import stiffness_model

@stiffness_model("mine")
def mine(load, side, modulus, roughness):
    from own_constants import HALF
    square = float(Path(__file__).with_name("square.txt").read_text())
    return 1 / (HALF * roughness.rms / load + 1 / (square * modulus * side))

@stiffness_model("no number")
def no_number(load):
    return load * float("nan")

@stiffness_model("raises")
def raises(load):
    raise ValueError("too light")
"""


def written(folder, half=0.48, square=1.1523):
    (folder / "own_constants.py").write_text(f"HALF = {half}\n", encoding="utf-8")
    (folder / "square.txt").write_text(f"{square}\n", encoding="utf-8")
    (folder / "mine.py").write_text(FILE, encoding="utf-8")
    return folder / "mine.py"


def code_of(visitor):
    return source_files.digest_of(path for path in visitor.sources if path.suffix == ".py")


@catches("a key without the bytes of a module that the file loads").at(
    "validation.judging.worker.Visitor.digest", property(lambda visitor: source_files.digest_of([visitor.path]))
)
@catches("a key without the bytes of data that the file reads").at(
    "validation.judging.worker.Visitor.digest", property(code_of)
)
@catches("a key that is taken before a call loads a module").at(
    "validation.judging.own_models._probe", lambda called: None
)
@pytest.mark.slow
def test_the_key_has_the_bytes_of_modules_and_data_that_a_call_reads():
    with tempfile.TemporaryDirectory() as folder:
        constants = (0.48, 1.15), (0.48, 1.15), (0.5, 1.15), (0.48, 1.16)
        first, again, *others = (models_in(written(Path(folder), *some))[0].digest for some in constants)
    assert first == again and len({first, *others}) == 3


@pytest.mark.slow
def test_a_sweep_takes_what_is_stored_until_a_module_of_the_file_is_another(capsys):
    """What fails is a row with its reason, and the others go on."""
    with stored((PUNCH, answers())) as folder:
        words = ["compare", "rough_punch", "--models-from", str(written(folder)), "--workers", "1", "--json", "o.json"]
        sweep = ["--sweep", "punch.load=20 N,50 N", "--models", "mine,no number,raises"]
        kept = []
        for half in (0.48, 0.48, 0.5):
            written(folder, half)
            main([*words, *sweep])
            rows = {
                row["model"]: row for row in json.loads((folder / "o.json").read_text(encoding="utf-8"))[0]["models"]
            }
            kept.append(({path.name for path in (folder / "reports" / "compared").rglob("*.npz")}, rows))
    (first, rows), (second, same), (third, other) = kept
    assert len(first) == 5 and first == second and len(third - first) == 5 and rows == same
    assert rows["mine"]["status"] == "accepted" and other["mine"]["value"] != rows["mine"]["value"]
    assert rows["no number"]["status"] == rows["raises"]["status"] == "failed"
    assert "NaN" in rows["no number"]["reason"] and "too light" in rows["raises"]["reason"]
    printed = "".join(capsys.readouterr())
    assert "Traceback" not in printed
    # of three runs the second has what is kept, and says by what
    said = (
        "mine.py are those kept in reports/compared, by the bytes of the file and of what it has from its folder; env"
    )
    assert printed.count(said) == 1


@pytest.mark.slow
def test_the_errors_of_a_file_are_shown_and_why_there_are_none(capsys):
    with stored((PUNCH, answers())) as folder:
        assert main(["calibrate", "--model", str(written(folder))]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split()[:4] == ["punch", "stiffness", "mine", str(SCENES - 2)]
    assert [line.split('"')[1] for line in lines if "answers fewer than 20 scenes" in line] == ["no number", "raises"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["compare", "rough_punch", "--models-from", "none.py"], "none.py: No such file"),
        (["compare", "sphere", "--models-from", "mine.py"], "no model of your own has stiffness of scene"),
        (["compare", "rough_punch", "--models-from", "mine.py", "--models", "yours"], '"mine"'),
        (["compare", "rough_punch", "--models-from", "taken.py"], "must have a name that no other has"),
        (["compare", "rough_punch", "--models-from", "law.py"], "no function serves a scene, as @stiffness_model"),
        (["calibrate", "--model", "mine.py", "--install"], "--install must be given to .ci/calibrate.py"),
        (["calibrate", "--model", "mine"], "--model must be a Python file, or a name of"),
    ],
)
@pytest.mark.slow
def test_what_cannot_be_done_is_refused_in_one_sentence(words, said, capsys):
    with stored() as folder:
        written(folder)
        (folder / "taken.py").write_text(FILE.replace('"mine"', '"Fit"'), encoding="utf-8")
        (folder / "law.py").write_text(
            'from validation import contact_law\n@contact_law("law")\ndef law(approach):\n    return approach\n',
            encoding="utf-8",
        )
        assert main(words) == 2
    line = capsys.readouterr().err
    assert said in line and len(line.splitlines()) == 1


@validation.force_spectrum("on the line")
def on_the_line(q, contact_radius, modulus, roughness):
    return (2 * modulus * np.sin(q * contact_radius) / q) ** 2 * roughness.c1d(q)


@validation.profile_spectrum("Geike's")
def geikes(q, roughness):
    return mdr.geike(q, roughness.c2d)


@pytest.mark.parametrize("function", [on_the_line, geikes])
@pytest.mark.parametrize("quantity", ["force-rms", "force-spectrum", "acceleration"])
def test_levels_of_a_wheel_are_those_of_the_linear_filter(function, quantity):
    point = CalibrationScene(kind="rolling" if quantity[0] == "f" else "wheel", number=2, quantity=quantity, seed=19)
    (rows,) = result_of(own_models.Called(function), point.target(), 1).values[quantity]
    assert distance(rows, point.target().rolling.expected(one_dimensional=True)) < 1e-3


def test_springs_on_a_rule_are_those_of_the_package():
    """Both by Geike's rule, on a hundred profiles each."""
    target = Target(ROUGH, "stiffness")
    mine = result_of(own_models.Called(geikes), target, 100).values["stiffness"]
    (springs,) = (one for one in models_serving(target.scene, "stiffness") if one.is_mdr)
    theirs = springs.prepare(target, springs.resolutions(target)[0])(0)().values["stiffness"]
    assert abs(mine.mean() / theirs.mean() - 1) < 4 * mine.std() / mine.mean() / math.sqrt(100)


@catches("surfaces of another seed than those of the reference").at("validation.judging.own_models.OTHER_SEED", 0)
def test_surfaces_are_those_that_boundary_elements_have():
    """So that no scatter of the surfaces is left of an error."""

    @validation.stiffness_of_surface("by the highest")
    def by_the_highest(height):
        return 1 + 1e3 * np.abs(height[::8, ::8]).max()

    def solved(point):
        target = point.target(seed=OTHER_SEED)
        cells = round(boundary_elements_pressed.resolutions(target)[-1].size) // 2
        return np.array([[by_the_highest(height_of(target.scene, cells, i, target.seed))] for i in range(4)])

    few = answers(solved)
    with stored((PUNCH, few)):
        (own,) = own_models.of_functions([by_the_highest], ROUGH, "stiffness")
        outcome = measure_own(OwnPart(own, PUNCH, few.digest))
    assert (outcome["error"] == few.reference).all()


def as_reference(name, a3):
    return ContactFilter(name=name, closed=lambda quantity: a3, is_reference=True)


@catches("a filter of somebody's own that is the reference").at(
    ("validation.judging.own_models.filter_of", "validation.judging.own_models.filter_of"), as_reference
)
def test_a_filter_of_a_rail_claims_what_the_same_one_of_the_package_does():
    @validation.contact_filter("sinc")
    def sinc(k_x, a_x):
        return np.abs(np.sinc(k_x * a_x / math.pi))

    @validation.contact_filter("no number")
    def no_number(k_x):
        return math.nan * k_x

    names = [rail.LINEAR_LINE.name, rail.LINEAR_ELLIPSE.name]
    found = validation.compare(validation.load_scene("rail"), models=[sinc, no_number, *names])
    mine, theirs = (found.models[name] for name in ("sinc", rail.LINEAR_LINE.name))
    np.testing.assert_allclose(mine.answer.value, theirs.answer.value, rtol=1e-3)
    assert mine.error == pytest.approx(theirs.error, rel=0.01) and 0.4 < mine.error < 0.6
    assert found.model == rail.LINEAR_ELLIPSE.name and "NaN" in found.models["no number"].reason
