"""The code that decides whether a stored result is still good."""

import subprocess
import sys
from importlib import import_module

import pytest

from validation.engine import sources
from validation.engine.sources import modules_behind, version_behind

PUNCH = "validation.simulation.rough_punch"


@pytest.fixture
def edited(monkeypatch):
    """A function that changes the bytes of a file in the eyes of the digests."""

    def edit(path, old, new):
        read = sources._source.__wrapped__
        assert old in read(path)
        monkeypatch.setattr(sources, "_source", lambda p: read(p).replace(old, new) if p == path else read(p))
        for digest in (sources._meaning, sources._of_modules, sources._names, sources._tree, sources.modules_behind):
            digest.cache_clear()

    yield edit
    for digest in (sources._meaning, sources._of_modules, sources._names, sources._tree, sources.modules_behind):
        digest.cache_clear()


def test_a_punch_rests_on_both_methods_and_on_no_page():
    behind = modules_behind(PUNCH)
    assert {PUNCH, "bem3d.solver", "bem3d", "mdr.foundation", "validation.simulation.surface"} <= behind
    assert not [name for name in behind if name.startswith(("validation.selection", "validation.cases"))]
    assert not [name for name in sources._modules() if ".report" in name]


def test_every_import_of_the_running_code_is_found():
    """Python's own list of what a fresh interpreter has loaded, beside what is read from the source."""
    code = f"import sys, {PUNCH}; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name for name in run.stdout.split() if name.split(".")[0] in sources.NUMERICS}
    left = {name for name in loaded - modules_behind(PUNCH) if not name.startswith("validation.engine")}
    assert not left
    assert len(loaded) > 20


def test_the_engine_changes_no_result():
    """Problems go through it, and what draws their random numbers stands beside it."""
    behind = modules_behind(PUNCH)
    assert not {"validation.engine.engine", "validation.engine.progress", "validation.engine.stored"} & behind
    assert "validation.engine.random_numbers" in behind


def test_a_module_that_lists_a_package_rests_on_its_modules():
    behind = modules_behind("validation.simulation.model")
    models = {name for name in sources._modules() if name.startswith("validation.simulation.models.")}
    assert len(models) > 5
    assert models <= behind
    assert not [name for name in behind if name.startswith("validation.selection")]


def test_a_solve_that_uses_the_face_rests_on_everything(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    for number, line in enumerate(("import validation", "from validation import compare")):
        (tmp_path / f"by_face_{number}.py").write_text(f"{line}\n")
        assert modules_behind(import_module(f"by_face_{number}").__name__) >= {"validation.selection.compare"}


def test_a_module_that_imports_by_name_rests_on_everything(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "by_name.py").write_text("from importlib import import_module\n\nimport_module('math')\n")
    assert modules_behind(import_module("by_name").__name__) >= set(sources._modules()) - {sources.ENGINE}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "old", "new", "changes"),
    [
        ("bem3d.solver", b"import", b"import sys, ", True),
        ("validation.simulation.rough_punch", b"def ", b"def other_", True),
        ("validation.simulation.rough_punch", b'"""A rigid', b'"""Another word: a rigid', False),
        ("validation.simulation.rough_punch", b"\n\n", b"\n# a comment\n\n", False),
        ("validation.selection.summary", b"def ", b"def other_", False),
    ],
)
def test_results_are_as_good_as_the_code_behind_them(edited, module, old, new, changes):
    before = version_behind(PUNCH, None)
    edited(sources._modules()[module], old, new)
    assert (version_behind(PUNCH, None) != before) is changes


def test_the_classes_of_a_problem_count(problems):
    """A scene may come from a module that the solve does not import."""
    plain = version_behind("validation.theory.wheel", None)
    assert version_behind("validation.theory.wheel", problems[0]) != plain
    assert version_behind("validation.theory.wheel", {"key": (problems[0],)}) != plain


@pytest.mark.slow
def test_data_beside_a_module_that_asks_for_its_place_counts(edited):
    table = sources._modules()["validation.simulation.calibration"].with_name("calibration.csv")
    before = version_behind("validation.simulation.calibration", None)
    edited(table, b"measured", b"guessed")
    assert version_behind("validation.simulation.calibration", None) != before


def test_the_code_of_a_user_counts(tmp_path, monkeypatch):
    """A solve in a script of one's own: results of an earlier text of it are not taken for new ones."""
    found = []
    monkeypatch.syspath_prepend(str(tmp_path))
    for factor in (2, 3):
        name = f"own_solve_{factor}"
        (tmp_path / f"{name}.py").write_text(f"def solve(problem):\n    return {{'value': {factor} * problem}}\n")
        found.append(version_behind(import_module(name).__name__, 1))
    assert found[0] != found[1]


def test_a_solve_without_source_is_refused():
    with pytest.raises(RuntimeError, match="the source of nowhere is not to be found"):
        version_behind("nowhere", None)


SPRINGS = "validation.simulation.models.pressed"
LEFT_OUT = ("validation.scenes", "validation.simulation.models", "validation.simulation.calibration", "mdr.formatting")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "old", "new", "same"),
    [
        ("mdr.foundation", b"import numpy as np", b"import numpy as np  # of arrays", True),
        ("mdr.foundation", b"import numpy as np", b"import numpy as np\nTWO = 2", False),
        ("mdr.foundation", b"return f", b"return 'springs' + f", True),
        ("mdr.foundation", b"from mdr.formatting import span", b"from mdr.formatting import pair, span", True),
        ("mdr.formatting", b"def span", b"def wide_span", True),
        ("mdr.rolling_surface", b"def ", b"def other_", True),
        ("mdr.spectrum", b"def ", b"def other_", False),
        ("validation.simulation.models.rolling", b"def ", b"def other_", True),
        (SPRINGS, b"def ", b"def other_", False),
    ],
)
def test_the_version_of_a_model_is_that_of_the_code_behind_its_numbers(edited, module, old, new, same):
    """Not of what prints, nor of functions of the method that it does not use."""
    version = sources.version_of((SPRINGS,), LEFT_OUT)
    edited(sources._modules()[module], old, new)
    assert (sources.version_of((SPRINGS,), LEFT_OUT) == version) is same


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        ("import mdr\nmdr.load_curve", False),
        ("from mdr import load_curve", False),
        ("import mdr as springs\nsprings.load_curve", True),
        ("import mdr\nprint(mdr)", True),
        ("import mdr\nmdr.Wheels", True),
    ],
)
def test_of_a_method_the_modules_count_whose_names_are_used(tmp_path, monkeypatch, text, whole):
    """All of them where that cannot be read from the source."""
    monkeypatch.syspath_prepend(str(tmp_path))
    name = f"own_{abs(hash(text))}"
    (tmp_path / f"{name}.py").write_text(text)
    import_module(name)
    behind = modules_behind(name, by_names=True)
    assert "mdr.foundation" in behind
    assert ("mdr.rolling_surface" in behind) is whole


def test_a_version_of_nothing_is_refused():
    with pytest.raises(RuntimeError, match="the source of nowhere is not to be found"):
        sources.version_of(("nowhere",))
