"""Where commands write: what would be replaced, or cannot be written, is refused before anything is computed."""

import pytest

from tests.judging.test_judge_command import SERIES
from validation.__main__ import main

JUDGE = "judge mine.py"
COMPARE = "compare sphere"
OWN = "must be a file of its own, got {path}, which"
WRONG = [
    (f"{JUDGE} --json mine.py", f"--json {OWN} is the model"),
    (f"{JUDGE} --csv ./far/../mine.py", f"--csv {OWN} is the model"),
    (f"{JUDGE} --json new/a --csv new/../new/a", f"--csv {OWN} --json writes"),
    (f"{JUDGE} --out new --csv new", f"--csv {OWN} is --out"),
    (f"{JUDGE} --json far", f"--json {OWN} is a folder"),
    (f"{JUDGE} --figure a.gif", "--figure must end in .svg, .png, .pdf, got {path}"),
    (f"{JUDGE} --csv mine.py/a.csv", "--csv must be a file in a folder that can be written, got {path}: Not a dir"),
    (f"{JUDGE} --out mine.py", "--out must be a folder that can be written, got {path}: Not a directory"),
    (f"{COMPARE} --csv far", f"--csv {OWN} is a folder"),
    (f"{COMPARE} --models-from mine.py --json mine.py", f"--json {OWN} is --models-from"),
    (f"{COMPARE} --models-from mine.py --figure mine.py", "--figure must end in .svg, .png, .pdf, got {path}"),
    (f"{COMPARE} --models-from mine.py --report mine.py", "--report must be a folder that can be written, got {path}"),
    ("calibrate --model mine.py --out mine.py", "--out must be a folder that can be written, got {path}: Not a dir"),
    (
        "benchmark --solver mine.py --out mine.py",
        "--out must be a folder that can be written, got {path}: Not a directory",
    ),
]


@pytest.fixture
def here(tmp_path, monkeypatch):
    """With a model that leaves a trace where it is run."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "far").mkdir()
    (tmp_path / "mine.py").write_text(f"open('was_run', 'w')\n{SERIES}", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(("words", "said"), WRONG)
def test_a_place_is_refused_before_anything_is_run_or_written(words, said, here, capsys):
    before = {path: path.is_file() and path.read_bytes() for path in here.rglob("*")}
    assert main(words.split()) == 2
    line = capsys.readouterr().err
    path = words.split()[-1].removeprefix("./")
    assert line.startswith(f"error: {said.format(path=path)}") and len(line.splitlines()) == 1
    assert {path: path.is_file() and path.read_bytes() for path in here.rglob("*")} == before


def test_a_folder_without_rights_is_refused(here, monkeypatch, capsys):
    monkeypatch.setattr("os.access", lambda path, mode: False)
    assert main([*JUDGE.split(), "--json", "far/a.json"]) == 2
    assert "--json must be a file in a folder that can be written, got far/a.json: Perm" in capsys.readouterr().err
