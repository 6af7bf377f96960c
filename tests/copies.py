"""Copies of the packages, for tests that change or delete a part of them."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def copied(folder, without=()):
    """The packages in a folder, without some of validation; a function that runs Python there and has its output."""
    for package in ("mdr", "bem3d", "validation"):
        left_out = without if package == "validation" else ()
        shutil.copytree(ROOT / package, folder / package, ignore=shutil.ignore_patterns("__pycache__", *left_out))
    environment = {**os.environ, "PYTHONPATH": str(folder), "OMP_NUM_THREADS": "1"}

    def run(*words, status=0):
        command = [sys.executable, *words]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False)
        assert done.returncode == status, done.stdout + done.stderr
        return done.stdout

    return run
