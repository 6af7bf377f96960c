"""Options of all commands: each with one value is given once, none is given where nothing goes by it."""

import argparse
import os
from pathlib import Path

import pytest

from validation import __main__ as command
from validation.engine.engine import LOCAL
from validation.report.commands import arguments, run_cases

SCENE, FILE = "rail", "model.py"
POSITIONALS = {"compare": [SCENE], "sound": [SCENE], "judge": [FILE], "scene": [SCENE]}
WORDS = {
    "--tolerance": "5%",
    "--sweep": "wheel.load=1 kN,2 kN",
    "--only": "hertz",
    "--quantity": "stiffness",
    "--models": "bem",
    "--seconds": "0.1",
    "--realisations": "2",
}
"""A value of an option that is neither a whole number, a choice nor a text."""
REPEATABLE = {("report", "--only")}
"""By design: names of cases add up."""


def parser_of(name):
    """Of one command, with its options."""
    inner = command._CommandParser(prog=f"mdr-validation {name}")
    with pytest.raises(SystemExit):
        inner.parse_known_args(["--unknown"])
    return inner


def options():
    """Command and option, for each that takes a value."""
    for name in command.COMMANDS:
        yield from ((name, one) for one in parser_of(name)._actions if one.option_strings and one.nargs != 0)


def refused(capsys, words):
    with pytest.raises(SystemExit) as ended:
        command.main(words)
    assert ended.value.code == command.Exit.BAD_INPUT
    return capsys.readouterr().err.splitlines()[-1]


def test_an_option_with_one_value_is_given_once(capsys):
    every = [*options()]
    assert {name for name, _ in every} == set(command.COMMANDS) - {"cases", "scene"}
    assert len(every) > 40
    for name, option in every:
        (long, *_) = reversed(option.option_strings)
        if (name, long) in REPEATABLE:
            continue
        word = next(iter(option.choices)) if option.choices else WORDS.get(long, "1")
        for twice in ([long, word, long, word], [f"{long}={word}", long, word]):
            line = refused(capsys, [name, *POSITIONALS.get(name, []), *twice])
            assert f"argument {'/'.join(option.option_strings)}: must be given once, as {long} " in line
            assert line.endswith(", got it twice")


def test_a_second_value_behind_another_option_or_an_abbreviation_counts(capsys):
    for words in (
        ["compare", SCENE, "--sweep", "wheel.load=1 kN,2 kN", "--seed", "1", "--sweep", "wheel.radius=1 m,2 m"],
        ["compare", SCENE, "--tol", "1%", "--tolerance", "2%"],
        ["report", "--profile", "quick", "--workers", "1", "--profile", "full"],
    ):
        assert "must be given once, as --" in refused(capsys, words)


def test_names_of_cases_add_up(monkeypatch):
    asked = []
    monkeypatch.setattr(run_cases, "report", lambda arguments: asked.append(arguments.only) or command.Exit.MET)
    assert command.main(["report", "--only", "hertz", "--only", "geike", "limits"]) == command.Exit.MET
    assert asked == [[("hertz",), ("geike",), ("limits",)]]


def test_a_seed_of_its_own_each_time(monkeypatch):
    """What was given to one command is not remembered by the next."""
    seeds = []
    monkeypatch.setattr(run_cases, "report", lambda arguments: seeds.append(arguments.seed) or command.Exit.MET)
    for seed in ("1", "2"):
        assert command.main(["report", "--seed", seed]) == command.Exit.MET
    assert seeds == [1, 2]


def test_workers_are_bounded(monkeypatch, capsys):
    asked = []
    monkeypatch.setattr(run_cases, "report", lambda arguments: asked.append(arguments.workers) or command.Exit.MET)
    for cores, most in ((2, 16), (64, 256), (None, 16)):
        monkeypatch.setattr(os, "cpu_count", lambda cores=cores: cores)
        assert command.main(["report", "--workers", str(most)]) == command.Exit.MET
        line = refused(capsys, ["report", "--workers", str(most + 1)])
        assert line.endswith(f"argument --workers: must be at most {most}, got {most + 1}")
        for name in ("sound", "compare", "calibrate"):
            assert "must be at most" in refused(capsys, [name, *POSITIONALS.get(name, []), "--workers", "1000000"])
    assert asked == [16, 256, 16]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("report --executor dask://a:1 --workers 2", "--workers must be left out beside --executor"),
        ("calibrate --show --workers 2", "--workers must be left out beside --show"),
        ("calibrate --model FILE --workers 2", "--workers must be left out beside --model FILE"),
    ],
)
def test_an_option_is_not_given_where_nothing_goes_by_it(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path(FILE).write_text("", encoding="utf-8")
    assert command.main(words.replace("FILE", FILE).split()) == command.Exit.BAD_INPUT
    told = capsys.readouterr()
    assert (told.out, told.err) == ("", f"error: {said}, where nothing goes by it\n".replace("FILE", FILE))


def test_the_same_options_are_taken_where_something_goes_by_them():
    given = argparse.Namespace(given=("--seed", "--workers"), executor=LOCAL)
    arguments.not_beside(given, "beside --show", "--punches")
    arguments.not_beside(argparse.Namespace(), "beside --show", "--seed")
    with pytest.raises(ValueError, match=r"^--seed must be left out beside --show, where nothing goes by it$"):
        arguments.not_beside(given, "beside --show", "--punches", "--seed")
