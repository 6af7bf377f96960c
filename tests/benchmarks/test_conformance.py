"""`pytest --pyargs validation.conformance` on functions of a file: right ones pass, wrong ones have an example."""

import subprocess
import sys

import numpy as np
import pytest

OWN = """
import numpy as np
from validation.benchmarks.judging.discrete import ContactProblem, pressed

def solve(gap, spacing, modulus, force):
    problem = ContactProblem(gap=gap, spacing=spacing, modulus=modulus, periodic=False, force=force)
    return pressed(problem, 1e-5, force=force * (1.01 if gap.size > 3 else 1)).pressure

def rule(q, roughness):
    return np.pi * q * roughness.c2d(q)
"""


def conformance(folder, text, *words):
    (folder / "own.py").write_text(text)
    told = [*["-q", "--pyargs", "validation.conformance", "--contact-solver", "own.py:solve"], *words]
    return subprocess.run([sys.executable, "-m", "pytest", *told], cwd=folder, capture_output=True, text=True)


@pytest.mark.slow
def test_what_is_right_passes_and_what_is_wrong_fails_with_the_smallest_example(tmp_path):
    run = conformance(tmp_path, OWN, "--mapping", "own.py:rule", "-k", "conditions or superposition or rule")
    assert run.returncode == 1 and "1 failed, 2 passed" in run.stdout
    assert "force balance, 0.01 off: force not held" in run.stdout
    gap = next(line for line in run.stdout.splitlines() if "gap = np.array(" in line).partition("= ")[2]
    assert eval(gap.rstrip("\\"), {"np": np}).size == 4
