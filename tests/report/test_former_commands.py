"""Commands of version 0.3 that still work, with a note."""

import pytest

from validation import __main__ as command
from validation.report.commands import run_cases


@pytest.mark.parametrize("name", ["benchmark", "race"])
def test_the_solver_benchmark_by_both_names(name, monkeypatch, tmp_path, capsys):
    asked = []
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(run_cases, "build", lambda names, **settings: asked.append((names, settings["out"])) or [])
    assert command.main([name]) == command.Exit.MET
    ((cases, out),) = asked
    assert (cases, str(out)) == (["race"], f"reports/{name}-quick")
    note = "note: `race` is named `benchmark` now; the former name works for one release\n"
    assert capsys.readouterr().err == note * (name == "race")


def test_the_help_lists_the_current_name_alone(capsys):
    with pytest.raises(SystemExit):
        command.main(["--help"])
    listed = capsys.readouterr().out
    assert "benchmark" in listed and "race" not in listed


def test_the_former_name_has_the_same_options(capsys):
    shown = {}
    for name in ("benchmark", "race"):
        with pytest.raises(SystemExit):
            command.main([name, "--help"])
        shown[name] = capsys.readouterr().out.replace(name, "NAME")
    assert "--solver" in shown["race"] and shown["race"].split() == shown["benchmark"].split()
