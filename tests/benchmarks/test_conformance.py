"""`pytest --pyargs validation.conformance` on functions of a file: right ones pass, a wrong one has an example."""

import subprocess
import sys

import pytest

OWN = """
import bem3d
import numpy as np

def solve(gap, spacing, modulus, force):
    half_space = bem3d.HalfSpace(shape=gap.shape, spacing=spacing, modulus={modulus})
    return bem3d.solve(half_space, gap, force=force, indenter_ends_at_edge=True).pressure

def rule(q, roughness):
    return np.pi * q * roughness.c2d(q) ** {power}
"""


ANY = """
from hypothesis import Phase, settings

settings.register_profile("any", phases=[Phase.explicit, Phase.generate], database=None)
settings.load_profile("any")
"""
"""The first example that fails: none smaller, which costs a hundred solves."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("modulus", "power", "status", "said"),
    [("modulus", 1, 0, "2 passed"), ("modulus / 0.91", 2, 1, "gap = np.array([[")],
)
def test_a_wrong_function_fails_with_an_example(tmp_path, modulus, power, status, said):
    (tmp_path / "own.py").write_text(OWN.format(modulus=modulus, power=power))
    (tmp_path / "any_example.py").write_text(ANY)
    words = "-p any_example --pyargs validation.conformance --contact-solver own.py:solve --mapping own.py:rule -k"
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *words.split(), "tension or linear"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert run.returncode == status
    assert said in run.stdout
