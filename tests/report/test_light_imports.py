"""What starts fast imports little: modules are counted in a fresh process, no clock is read."""

import os
import subprocess
import sys

import pytest

from validation.report.commands.report import WHEELS
from validation.scenes.load import bundled_with_track

HEAVY = {"matplotlib", "pyfftw", "joblib", "dask", "distributed", "jinja2", "scipy.optimize", "scipy.stats"}
"""Each takes a tenth of a second or more to import."""
UNASKED = {"validation.advice.calibrate", "validation.advice.exported"}
"""What `--verbose` and files take."""
PAGE = ("validation.report.build", "validation.report.contents", "validation.report.figures", "validation.cases")
COMMAND = """
import sys
from contextlib import suppress
from validation.__main__ import main
with suppress(SystemExit):
    main(sys.argv[1:])
"""


def modules_of(code, *words):
    """Names of the modules that are imported after this code."""
    printed = f"{code}\nimport sys\nprint('\\n' + ' '.join(sys.modules))"
    run = subprocess.run([sys.executable, "-c", printed, *words], capture_output=True, encoding="utf-8", check=True)
    return set(run.stdout.splitlines()[-1].split())


HELP = [[command, "--help"] for command in ("report", "precision", "benchmark", "race", "cases", "scene")]


@pytest.mark.parametrize("words", [["--help"], ["--version"], ["scene", "sphere"], *HELP])
def test_what_computes_nothing_imports_no_numerics(words):
    found = modules_of(COMMAND, *words)
    assert not found & {"numpy", "scipy", "mdr", "bem3d", *HEAVY}
    assert len(found) < 250


def test_the_help_of_report_names_all_wheels():
    """Without the numerics that their scenes import."""
    assert bundled_with_track() == WHEELS


@pytest.mark.parametrize("code", ["import bem3d", "import mdr", "from validation import compare, load_scene, summary"])
def test_packages_import_nothing_heavy(code):
    assert not modules_of(code) & HEAVY


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["sphere", "rough_punch"])
def test_a_closed_form_or_springs_need_no_boundary_elements(scene):
    found = modules_of(COMMAND, "compare", scene, "--tolerance", "50%")
    assert not found & HEAVY
    assert not found & UNASKED and not {name for name in found if name.startswith(PAGE)}


def test_a_command_sums_with_one_thread_as_workers_do():
    """Threads of BLAS change last bits: they are set before numpy is loaded."""
    code = f"{COMMAND}\nimport os\nprint(os.environ['OMP_NUM_THREADS'])"
    before = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    words = [sys.executable, "-c", code, "scene", "sphere"]
    run = subprocess.run(words, env=before, capture_output=True, encoding="utf-8", check=True)
    assert run.stdout.splitlines()[-1] == "1"
    code = "import sys, validation.__main__; print('numpy' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], env=before, capture_output=True, encoding="utf-8", check=True)
    assert run.stdout == "False\n"
