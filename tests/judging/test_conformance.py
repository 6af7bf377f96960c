"""`pytest --pyargs validation.conformance` on functions of a file: right ones pass, wrong ones have an example."""

import re
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import Phase

from validation.judging import pytest_properties as judged_by_pytest
from validation.judging.solvers.properties import PROPERTIES

OWN = """
import numpy as np
from validation.benchmarks.discrete import ContactProblem, pressed

def solve(gap, spacing, modulus, force):
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=False, force=force)
    return pressed(problem, 1e-5, force=force * (1.01 if gap.size > 3 else 1)).pressure

def rule(q, roughness):
    return np.pi * q * roughness.c2d(q)
"""


PEER = """
from validation.benchmarks import peers
from validation.benchmarks.discrete import ContactProblem
from validation import contact_solver

@contact_solver("a peer", periodic=True)
def solve(gap, spacing, modulus, periodic, tolerance, {load}):
    known = {{"force": 0.0, "{load}": {load}}}
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=periodic, **known)
    return peers.{solver}(problem, tolerance / 100)()[0]
"""


def conformance(folder, text, *words):
    (folder / "own.py").write_text(text, encoding="utf-8")
    told = [*["-q", "--pyargs", "validation.conformance", "--mdr-solver", "own.py:solve"], *words]
    return subprocess.run([sys.executable, "-m", "pytest", *told], cwd=folder, capture_output=True, encoding="utf-8")


@pytest.mark.parametrize(
    ("place", "sentence"),
    [
        ("own.py:nobody", "own.py has no function 'nobody' for @contact_solver"),
        ("own.py:rule", "'rule': q is unknown: @contact_solver may ask for gap, "),
        ("none.py:solve", "a function is named as FILE:NAME, and there is no file 'none.py' in 'none.py:solve'"),
        ("broken.py:solve", "broken.py: ZeroDivisionError: division by zero, line 1 of broken.py"),
    ],
)
def test_a_place_without_such_a_function_is_one_line_of_usage(place, sentence, tmp_path):
    (tmp_path / "broken.py").write_text("1 / 0", encoding="utf-8")
    run = conformance(tmp_path, OWN, "--mdr-solver", place)
    assert (run.returncode, run.stdout) == (pytest.ExitCode.USAGE_ERROR, "")
    assert run.stderr.startswith(f"ERROR: --mdr-solver: {sentence}") and run.stderr.count("\n") < 3


@pytest.mark.parametrize(("seconds", "examples"), [(0.1, 30), (2.0, 5), (60.0, 1)])
def test_a_function_that_is_slow_has_fewer_examples_and_that_is_said(seconds, examples, monkeypatch, recwarn):
    monkeypatch.setattr(judged_by_pytest, "repeat", lambda example, **_: [2 * seconds, seconds])
    found = judged_by_pytest.settings_for(list)
    assert (found.max_examples, Phase.shrink in found.phases) == (examples, examples == 30)
    assert [str(one.message) for one in recwarn] == (
        [f"{examples} of 30 examples, none made smaller: one takes {seconds:g} s"] if examples < 30 else []
    )


@pytest.mark.slow
def test_what_is_right_passes_and_what_is_wrong_fails_with_the_smallest_example(tmp_path):
    run = conformance(tmp_path, OWN, "--mdr-mapping", "own.py:rule", "-k", "conditions or superposition or rule")
    assert run.returncode == 1 and "1 failed, 2 passed" in run.stdout
    assert "force balance, deviation 0.01: force not held" in run.stdout and "warnings summary" not in run.stdout
    # of two rows it has two lines
    (gap,) = re.findall(r"gap = (np\.array\([^)]*\))", re.sub("^E ", "", run.stdout, flags=re.MULTILINE))[:1]
    assert eval(gap, {"np": np}).size == 4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("package", "solver", "load"),
    [("tamaas", "tamaas", "force"), ("ContactMechanics", "contact_mechanics", "approach")],
)
def test_the_solvers_of_other_packages_pass_where_they_are_installed(package, solver, load, tmp_path):
    pytest.importorskip(package)
    run = conformance(tmp_path, PEER.format(solver=solver, load=load), "-k", "solver", "--hypothesis-seed=0")
    assert run.returncode == 0 and f"{len(PROPERTIES)} passed" in run.stdout, run.stdout


SERVED = """
from validation import contact_solver
from validation.benchmarks.discrete import ContactProblem, pressed

def answer(gap, spacing, modulus, periodic, **load):
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=periodic, force=1.0)
    return pressed(problem, 1e-5, **load).pressure

@contact_solver("periodic alone", free=False, periodic=True)
def solve(gap, spacing, modulus, force):
    return answer(gap, spacing, modulus, True, force=force)

@contact_solver("both, by approach 1 % off", periodic=False)
def both(gap, spacing, modulus, force=None, approach=None):
    if force is not None:
        return answer(gap, spacing, modulus, False, force=force)
    return 1.01 * answer(gap, spacing, modulus, False, approach=approach)

@contact_solver("nine cells", cells=9)
def nine(gap, spacing, modulus, force):
    assert gap.size <= 9
    return answer(gap, spacing, modulus, False, force=force)

@contact_solver("square grids alone")
def square(gap, spacing, modulus, force):
    if gap.shape[0] != gap.shape[1]:
        raise NotImplementedError("square grids alone")
    return answer(gap, spacing, modulus, False, force=force)

@contact_solver("nothing")
def nothing(gap, force):
    raise NotImplementedError("not yet")
"""


@pytest.mark.parametrize(
    ("name", "tests", "said"),
    [
        ("solve", "conditions or superposition", "1 passed, 1 skipped"),
        ("both", "conditions", "1 failed"),
        ("nine", "conditions or shift", "1 passed, 1 skipped"),
        ("square", "conditions", "square grids alone"),
        ("nothing", "conditions", "1 skipped"),
    ],
)
def test_a_solver_is_tested_on_what_it_serves(name, tests, said, tmp_path):
    words = ["--mdr-solver", f"own.py:{name}", "-k", tests, "--hypothesis-seed=0"]
    run = conformance(tmp_path, SERVED, *words)
    assert said in run.stdout and ("failed" in run.stdout) == (name == "both"), run.stdout


OTHERS = """
def pytest_addoption(parser):
    for option in ("--mapping", "--solver", "--contact-solver"):
        parser.addoption(option)
"""


def test_options_of_other_projects_may_have_any_names(tmp_path):
    """Of a project whose conftest has options that ours were called before."""
    (tmp_path / "conftest.py").write_text(OTHERS, encoding="utf-8")
    (tmp_path / "test_theirs.py").write_text(
        "def test_theirs(pytestconfig):\n    assert pytestconfig.getoption('--mapping') == 'mine'\n", encoding="utf-8"
    )
    words = [sys.executable, "-m", "pytest", "-q", "--mapping", "mine", "--contact-solver=none"]
    run = subprocess.run(words, cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert run.returncode == 0 and "1 passed" in run.stdout, run.stdout + run.stderr


@pytest.mark.parametrize("words", [["--contact-solver", "none.py:solve"], ["--contact-solver=none.py:solve"]])
def test_old_names_of_options_are_read_with_the_tests_that_had_them(words, tmp_path):
    told = [sys.executable, "-m", "pytest", "-q", "--pyargs", "validation.conformance", *words]
    run = subprocess.run(told, cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert run.returncode == pytest.ExitCode.USAGE_ERROR
    assert "--mdr-solver: a function is named as FILE:NAME, and there is no file 'none.py'" in run.stderr
