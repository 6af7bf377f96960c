"""The code that decides whether a stored result is still good."""

import subprocess
import sys
from functools import cache, partial
from importlib import import_module

import pytest

from validation.engine import sources
from validation.engine.sources import modules_behind, version_behind

PUNCH = "validation.simulation.rough_punch"


@pytest.fixture
def edited(monkeypatch):
    """A function that changes the bytes of a file in the eyes of the digests; what they know of others stays known."""

    def edit(path, old, new):
        assert old in path.read_bytes()
        monkeypatch.setattr(
            sources, "_source", lambda p: p.read_bytes().replace(old, new) if p == path else p.read_bytes()
        )
        for name in ("_code", "_file_digest"):
            monkeypatch.setattr(sources, name, anew(getattr(sources, name), path))
        for name in ("version_of", "modules_behind"):
            monkeypatch.setattr(sources, name, cache(getattr(sources, name).__wrapped__))

    def anew(known, path):
        return lambda p: (getattr(known, "__wrapped__", known) if p == path else known)(p)

    return edit


def test_a_punch_rests_on_both_methods_and_on_no_page():
    behind = modules_behind(PUNCH)
    assert {PUNCH, "bem3d.solver", "bem3d", "mdr.foundation", "validation.simulation.surface"} <= behind
    assert not [name for name in behind if name.startswith(("validation.advice", "validation.cases"))]
    assert not [name for name in sources.modules() if ".report" in name]
    # problems go through the engine, and what draws their random numbers stands beside it
    assert not {"validation.engine.engine", "validation.engine.progress"} & behind
    assert "validation.engine.realisations" in behind


IMPORTS = ("import validation", "from validation import compare", "import importlib\nimportlib.import_module('math')")


@pytest.mark.parametrize(("number", "text"), [*enumerate(IMPORTS)])
def test_a_solve_that_uses_the_face_or_imports_by_name_rests_on_everything(number, text, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / f"any_import_{number}.py").write_text(text, encoding="utf-8")
    behind = modules_behind(import_module(f"any_import_{number}").__name__)
    assert "validation.advice.compare" in behind
    assert number < 2 or behind >= set(sources.modules()) - {sources.ENGINE}


def test_every_import_of_the_running_code_is_found():
    """Python's own list of what a fresh interpreter has loaded, beside what is read from the source."""
    code = f"import sys, {PUNCH}; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    loaded = {name for name in run.stdout.split() if name.split(".")[0] in sources.PACKAGES}
    left = {name for name in loaded - modules_behind(PUNCH) if not name.startswith("validation.engine")}
    assert not left
    assert len(loaded) > 20


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "old", "new", "changes"),
    [
        ("bem3d.solver", b"import", b"import sys, ", True),
        ("validation.engine.realisations", b"return ", b"return 2 * ", True),
        ("validation.analysis.spectra", b"def ", b"def other_", True),
        ("validation.analysis.spectra", b"def ", b"def  ", False),
        ("validation.cases.punch.bandwidth_study", b"def ", b"def other_", False),
        ("validation.simulation.rough_punch", b"def ", b"def other_", True),
        ("validation.simulation.rough_punch", b'"""A rigid', b'"""Another word: a rigid', False),
        ("validation.simulation.rough_punch", b"\n\n", b"\n# a comment\n\n", False),
        ("validation.advice.summary", b"def ", b"def other_", False),
    ],
)
def test_results_are_as_good_as_the_code_behind_them(edited, module, old, new, changes):
    solves = PUNCH, "validation.simulation.rolling_strip"
    before = [version_behind(solve, None) for solve in solves]
    edited(sources.modules()[module], old, new)
    assert ([version_behind(solve, None) for solve in solves] != before) is changes


def test_the_classes_of_a_problem_count(problems):
    """A scene may come from a module that the solve does not import."""
    plain = version_behind("validation.theory.rolling", None)
    assert version_behind("validation.theory.rolling", problems[0]) != plain
    assert version_behind("validation.theory.rolling", {"key": (problems[0],)}) != plain


@pytest.mark.slow
def test_data_beside_a_module_that_asks_for_its_place_counts(edited):
    table = sources.modules()["validation.advice.calibration"].with_name("calibration.csv")
    before = version_behind("validation.advice.calibration", None)
    edited(table, b"measured", b"guessed")
    assert version_behind("validation.advice.calibration", None) != before


def test_the_code_of_a_user_counts(tmp_path, monkeypatch):
    """A solve in a script of one's own: results of an earlier text of it are not taken for new ones."""
    found = []
    monkeypatch.syspath_prepend(str(tmp_path))
    for factor in (2, 3):
        name = f"own_solve_{factor}"
        (tmp_path / f"{name}.py").write_text(
            f"def solve(problem):\n    return {{'value': {factor} * problem}}\n", encoding="utf-8"
        )
        found.append(version_behind(import_module(name).__name__, 1))
    assert found[0] != found[1]


@pytest.mark.parametrize("version", [lambda name: sources.version_of((name,)), partial(version_behind, problem=None)])
def test_a_solve_without_source_is_refused(version):
    with pytest.raises(RuntimeError, match="the source of nowhere is not to be found"):
        version("nowhere")


@pytest.mark.slow
def test_what_is_left_out_of_a_version_does_not_count(edited):
    without = ("validation.scenes", "validation.simulation.surface")
    some, whole = (sources.version_of((PUNCH,), left_out) for left_out in (without, ()))
    edited(sources.modules()["validation.simulation.surface"], b"def ", b"def other_")
    assert sources.version_of((PUNCH,), without) == some
    assert sources.version_of((PUNCH,)) != whole
