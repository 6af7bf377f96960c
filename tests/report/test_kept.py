"""A report that makes one case anew keeps the others as they were made."""

import json
from dataclasses import replace

import pytest

from tests.report.test_command_line import SMALL
from validation import __main__ as command
from validation.report.contents import CASES


@pytest.fixture(autouse=True)
def _small(monkeypatch, without_figures):
    for name in ("hertz", "geike"):
        monkeypatch.setitem(CASES, name, replace(CASES[name], quick=SMALL[name]))


def report(out, *words):
    return command.main(["report", "--out", str(out), "--workers", "1", *words])


def refused(capsys, said, out, *words):
    assert report(out, *words) == command.Exit.BAD_INPUT
    assert said in capsys.readouterr().err


def of(folder, file):
    return json.loads((folder / file).read_text())


def test_the_other_case_is_kept(tmp_path):
    assert report(tmp_path, "--only", "hertz", "geike") == command.Exit.MET
    first, made = of(tmp_path, "results.json"), of(tmp_path, "provenance.json")
    assert report(tmp_path, "--only", "geike", "--keep", "--seed", "5") == command.Exit.MET
    second, about = of(tmp_path, "results.json"), of(tmp_path, "provenance.json")
    assert list(second["cases"]) == ["hertz", "geike"]
    assert second["cases"]["hertz"] == first["cases"]["hertz"]
    assert second["cases"]["geike"] != first["cases"]["geike"]
    assert about["kept"] == {"hertz": made["commit"]}
    assert about["seconds"]["hertz"] == made["seconds"]["hertz"]
    assert f"kept as made at commit {made['commit']}: hertz" in (tmp_path / "index.html").read_text()
    assert report(tmp_path, "--only", "geike") == command.Exit.MET
    assert list(of(tmp_path, "results.json")["cases"]) == ["geike"]


def test_what_cannot_be_kept_is_refused(tmp_path, capsys):
    refused(capsys, "--keep needs an earlier report", tmp_path / "none", "--only", "geike", "--keep")
    assert not (tmp_path / "none").exists()
    refused(capsys, "--keep is for --only", tmp_path / "none", "--keep")
    assert report(tmp_path, "--only", "hertz") == command.Exit.MET
    refused(capsys, "needs the profile of the report", tmp_path, "--only", "geike", "--keep", "--profile", "full")
    old = of(tmp_path, "results.json")
    del old["cases"]["hertz"]["title"]
    (tmp_path / "results.json").write_text(json.dumps(old))
    refused(capsys, "cannot keep hertz: 'title'", tmp_path, "--only", "geike", "--keep")
