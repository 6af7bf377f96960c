"""Models of a file or of an installed package in `compare`: every place for a result, and no failure that stays."""

import json
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import validation
from tests.judging.test_own_models import FILE, PUNCH, ROUGH, answers, series, stored, written
from tests.seeded import catches
from validation.__main__ import main
from validation.advice.calibration import SCATTER, MeasuredErrors
from validation.advice.hierarchy import REFUSALS
from validation.engine.engine import Engine
from validation.judging import own_models
from validation.judging.own_models import ChangedError, calibrated, models_in
from validation.simulation.method import Resolution
from validation.simulation.model import Target

OWN = '@validation.stiffness_model("{name}")\ndef {name}(load, side, modulus, roughness):\n    return {law}\n'
LAW = "1 / (0.48 * roughness.rms / load + 1 / (1.1523 * modulus * side))"
ASKED = {
    "alone": [],
    "several": ["sphere"],
    "swept": ["--sweep", "punch.load=20 N,50 N"],
    "named": ["--models", "mine"],
    "all": ["--all"],
}
FILES = ["--json", "j.json", "--csv", "c.csv", "--figure", "f.svg"]


@pytest.fixture
def here(monkeypatch):
    """A working folder with a model, and few answers beside which it is measured."""
    with stored((PUNCH, answers())) as folder:
        (folder / "mine.py").write_text("import validation\n" + OWN.format(name="mine", law=LAW), encoding="utf-8")
        monkeypatch.setattr("validation.advice.compare.LONGEST_BEYOND_RANGE", 0.0)
        yield folder


@pytest.mark.slow
@pytest.mark.parametrize(
    ("asked", "store"), [*((name, []) for name in ASKED), ("swept", ["--store", "kept"]), ("alone", ["--store", "new"])]
)
def test_a_report_of_models_of_ones_own_is_written_and_written_again(asked, store, here):
    own = ["--models-from", "mine.py", "--tolerance", "60%", "--workers", "1"]
    words = ["compare", "rough_punch", *ASKED[asked], *own]
    for _ in range(2):
        assert main([*words, *store, "--report", "new", *FILES]) == 0
    found = json.loads((here / "new/comparison.json").read_text(encoding="utf-8"))
    first = found if isinstance(found, dict) else found[0]
    assert "mine" in [model["model"] for model in first["models"]]
    assert (here / "j.json").read_bytes() == (here / "new/comparison.json").read_bytes()
    assert not (here / "reports").exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["sphere", "--models-from", "mine.py"], "no model of your own has stiffness"),
        (
            ["rough_punch", "--models-from", "none.py"],
            "a Python file, or a name of `judge --list`, got none.py: No such",
        ),
        (["rough_punch", "--models-from", "broken.py"], "broken.py: ZeroDivisionError"),
        (["rough_punch", "--models-from", "mine.py", "--models", "yours"], "models must be"),
        (["rough_punch", "--models-from", "mine.py", "--cnossos", "c.txt"], "--cnossos is for"),
        (["rough_punch", "--models-from", "mine.py", "--json", "new/x.json"], "which is in the folder of --report"),
        (["rough_punch", "--models-from", "mine.py", "--csv", "new/data/levels.csv"], "is in the folder of --report"),
    ],
)
@pytest.mark.slow
def test_bad_input_leaves_no_folder(words, said, here, capsys):
    (here / "broken.py").write_text("1 / 0\n", encoding="utf-8")
    before = sorted(here.rglob("*"))
    assert main(["compare", *words, "--report", "new"]) == 2
    assert said in capsys.readouterr().err
    assert sorted(here.rglob("*")) == before


def test_a_failure_while_a_model_is_measured_does_not_refuse_the_next_run(here, monkeypatch):
    """The folder has its list before anything is stored in it."""
    words = ["compare", "rough_punch", "--models-from", "mine.py", "--models", "mine", "--tolerance", "60%"]

    def lost(*_):
        raise KeyboardInterrupt

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("validation.advice.commands.compare.compare_scenes", lost)
        patch.setattr("validation.advice.commands.compare.SceneProblem.compared", lost)
        assert main([*words, "--report", "new"]) == 130
    assert list((here / "new/realisations").iterdir())
    assert main([*words, "--report", "new"]) == 0


@pytest.fixture
def package(here, monkeypatch):
    """An installed one that offers a model by entry points, one of them with the name of a model of the package."""
    folder = here / "site-packages"
    about = folder / "contact_pack-1.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: contact-pack\nVersion: 1\n", encoding="utf-8")
    (about / "entry_points.txt").write_text(
        "[mdr_validation.models]\nseries = contact_pack.laws:theirs\nfit = contact_pack.laws\n", encoding="utf-8"
    )
    (folder / "contact_pack").mkdir()
    (folder / "contact_pack/__init__.py").write_text("", encoding="utf-8")
    monkeypatch.syspath_prepend(folder)
    monkeypatch.setenv("PYTHONPATH", str(folder))

    def offers(law):
        text = "import validation\nfrom contact_pack.constants import HALF\n" + OWN.format(name="theirs", law=law)
        (folder / "contact_pack/laws.py").write_text(text, encoding="utf-8")
        (folder / "contact_pack/constants.py").write_text("HALF = 0.48\n", encoding="utf-8")
        return folder / "contact_pack"

    return offers


@pytest.mark.slow
def test_an_installed_model_is_compared_and_calibrated_by_its_name(package, here, capsys):
    package(LAW)
    words = ["compare", "rough_punch", "--models-from", "series", "--models", "theirs", "--tolerance", "60%"]
    assert main([*words, "--json", "o.json"]) == 0
    assert json.loads((here / "o.json").read_text(encoding="utf-8"))["model"] == "theirs"
    assert "contact_pack" not in sys.modules
    assert main(["calibrate", "--model", "series"]) == 0
    assert "theirs" in capsys.readouterr().out
    # a file of that name goes before
    (here / "series").write_text("1 / 0\n", encoding="utf-8")
    assert main(words) == 2


def test_a_digest_goes_by_the_bytes_and_not_by_the_folder_of_an_entry_point(tmp_path):
    found = set()
    for before, after in (("a", "b"), ("b", "a")):
        for folder, name, text in (
            (before, "entry point 'x' (y)", "import y"),
            (after, "y.py", "1"),
            (after, "z.py", "2"),
        ):
            (tmp_path / folder).mkdir(exist_ok=True)
            (tmp_path / folder / name).write_text(text, encoding="utf-8")
        files = [tmp_path / before / "entry point 'x' (y)", tmp_path / after / "y.py", tmp_path / after / "z.py"]
        found.add(own_models.digest_of(sorted(files)))
    assert len(found) == 1
    (tmp_path / "a/y.py").write_text("2", encoding="utf-8")
    (tmp_path / "a/z.py").write_text("1", encoding="utf-8")
    assert own_models.digest_of(sorted(files)) not in found


@pytest.mark.slow
def test_errors_of_an_installed_model_are_kept_by_the_bytes_of_its_package(package):
    folder = package(LAW)
    first, again = (models_in("series")[0].digest for _ in range(2))
    (folder / "constants.py").write_text("HALF = 0.5\n", encoding="utf-8")
    assert first == again != models_in("series")[0].digest
    (folder / "of_no_use.py").write_text("OTHER = 1\n", encoding="utf-8")
    (folder / "constants.py").write_text("HALF = 0.48\n", encoding="utf-8")
    assert models_in("series")[0].digest == first


@pytest.mark.slow
def test_a_file_that_is_changed_while_its_models_are_compared_ends_the_command(here):
    """Before a call, after one, and while it is measured: its claim would be that of another model."""
    path = written(here)
    own = models_in(path)[0]
    target = Target(own_models.load_scene("rough_punch"), "stiffness")
    assert own.model().prepare(target, Resolution())(0)().values["stiffness"].size == 1
    (here / "own_constants.py").write_text("HALF = 0.5\n", encoding="utf-8")
    with pytest.raises(ChangedError, match=r"mine.py, or what it reads, was changed while its models were compared"):
        own.called()
    written(here)
    (here / "mine.py").write_text(
        FILE.replace("square *", f"(open({str(path)!r}, 'a').write('#'), square)[1] *"), encoding="utf-8"
    )
    own = models_in(path)[0]
    with pytest.raises(ChangedError):
        own.model().prepare(target, Resolution())(0)()
    own = models_in(path)[0]
    with pytest.raises(ChangedError):
        calibrated(own, [PUNCH], Engine(store=here / "store"))
    assert not (here / "store").exists()
    assert main(["compare", "rough_punch", "--models-from", str(path), "--models", "mine"]) == 2


@catches("one measured surface without its scatter").at(
    "validation.scenes.measured_heights.MeasuredHeights.is_single", False
)
def test_a_claim_for_one_measured_surface_has_its_scatter_about_the_mean():
    height = np.random.default_rng(4).normal(size=(32, 32)) * 1e-6
    one = replace(ROUGH, ground=validation.MeasuredHeights(height=height, spacing=(ROUGH.size / 32,) * 2))
    far = replace(one, load=10 * ROUGH.modulus * ROUGH.size * one.ground.rms)
    drawn = replace(ROUGH, load=10 * ROUGH.modulus * ROUGH.size * ROUGH.ground.rms)

    @validation.stiffness_of_surface("of the surface")
    def of_the_surface(height, load, modulus):
        return load * modulus

    measured = MeasuredErrors(("F / (E* h L)",), np.linspace(-3, 2, 30)[:, np.newaxis], np.full(30, 0.1), np.ones(30))
    left = []
    for function, scene in ((series, drawn), (series, far), (of_the_surface, far)):
        (own,) = own_models.of_functions([function], ROUGH, "stiffness")
        own = replace(own, errors={PUNCH: own_models.OwnErrors("", measured, 1.0)})
        target = Target(scene, "stiffness")
        model = own.model()
        expected = model.estimate(target, Resolution())
        left.append(expected.model if expected.in_range else expected.reason)
    assert left[1] - left[0] == pytest.approx(2 * SCATTER) and left[2] == pytest.approx(left[0])


@catches("a file that is changed while it is compared").at(
    "validation.judging.own_models.OwnModel.check_unchanged", lambda own: None
)
def test_a_file_that_is_changed_is_seen_before_it_is_called():
    tmp_path = Path(tempfile.mkdtemp())
    (tmp_path / "mine.py").write_text("1\n", encoding="utf-8")
    (tmp_path / "data.txt").write_text("2\n", encoding="utf-8")
    sources = tuple(sorted(tmp_path.iterdir()))
    about = {"digest": own_models.digest_of(sources), "path": tmp_path / "mine.py", "sources": sources}
    own = own_models.OwnModel("stiffness_model", "mine", (), **about)

    def said():
        try:
            own.check_unchanged()
        except own_models.ChangedError as error:
            return str(error)

    assert said() is None
    (tmp_path / "data.txt").write_text("3\n", encoding="utf-8")
    assert said() is not None
    with pytest.raises(own_models.ChangedError, match=r"mine\.py, or what it reads, was changed while its models were"):
        own.called()
    assert not isinstance(own_models.ChangedError("a row of the table"), REFUSALS)
