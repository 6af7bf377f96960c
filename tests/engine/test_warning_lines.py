"""Warnings in a terminal are one line without a path, in this process and in its workers."""

import subprocess
import sys
import warnings

import pytest

from validation.engine.workers import as_one_line, one_line_warnings

COMMAND = """
import sys, warnings
from pathlib import Path
from validation import __main__ as command
from validation.engine.workers import Workers
def warned(message):
    warnings.warn(message)
def warns(arguments):
    warnings.warn("first\\nthing")
    with Workers({workers}) as workers:
        workers.submit(warnings.warn, "second thing").result()
    return 0
import validation.report.commands.scene as scene
scene.describe = lambda parser: parser.set_defaults(command=warns)
sys.exit(command.main(["scene"]))
"""


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_a_command_prints_one_line_a_warning(workers):
    words = [sys.executable, "-c", COMMAND.format(workers=workers)]
    found = subprocess.run(words, capture_output=True, encoding="utf-8", check=True)
    assert found.stderr.splitlines() == ["warning: first thing", "warning: second thing"]


def test_the_form_of_python_is_restored():
    before = warnings.formatwarning
    with one_line_warnings():
        assert warnings.formatwarning is as_one_line
    assert warnings.formatwarning is before
