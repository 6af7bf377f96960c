"""The scripts of `validation/examples`: each runs, asserts its result, and draws one picture."""

import ast
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import validation

EXAMPLES = Path(validation.__file__).parent / "examples"
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.py"))
LONG = {"large_face", "own_draws", "own_filter", "own_model", "own_solver", "rolling_spectrum"}
"""Most of a minute: the documentation runs them, as all others, and fails where one fails."""
SECONDS = {"sphere", "own_rail", "own_lines"}
"""Those that take next to none; the others are slow."""


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name in SECONDS else pytest.mark.slow) for name in NAMES if name not in LONG],
)
def test_an_example_asserts_its_result_and_draws_a_picture(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    assert capsys.readouterr().out
    (picture,) = (path for path in tmp_path.iterdir() if path.suffix in {".png", ".svg", ".pdf"})
    assert picture.name == f"{name}.png"
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_every_example_can_fail():
    for name in NAMES:
        tree = ast.parse((EXAMPLES / f"{name}.py").read_text(encoding="utf-8"))
        assert any(isinstance(node, ast.Assert) for node in ast.walk(tree)), name


@pytest.mark.slow
def test_a_wrong_result_ends_an_example(tmp_path):
    """The assertions of an example are those of a test: with E for E* a sphere is not that of Hertz."""
    wrong = (EXAMPLES / "sphere.py").read_text(encoding="utf-8").replace("modulus=modulus)", "modulus=0.9 * modulus)")
    (tmp_path / "sphere.py").write_text(wrong, encoding="utf-8")
    run = subprocess.run([sys.executable, "sphere.py"], cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert "AssertionError" in run.stderr
