"""`judge` of a file with a contact solver: its exit status, and what a person reads."""

import json

import pytest

from tests.judging.judged_points import NO_RESULT, OUTSIDE, WITHIN
from validation.__main__ import main
from validation.judging.solvers import checks as solvers

HEAD = """
import bem3d
from validation import contact_solver

@contact_solver("mine", residual=1e-4)
def solve(gap, spacing, modulus, force, tolerance):
"""
SOLVE = """
    half_space = bem3d.HalfSpace(shape=gap.shape, spacing=spacing, modulus={modulus})
    return bem3d.solve(half_space, gap, force=force, tolerance=tolerance, indenter_ends_at_edge=True).pressure
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "status", "said"),
    [
        (SOLVE.format(modulus="modulus"), 0, "contact solver, right in all 162 checks"),
        (SOLVE.format(modulus="modulus / 0.91"), 1, "the answer for 1.099 times the modulus"),
        ("    print('hello')\n" + SOLVE.format(modulus="modulus"), 0, "  printing, any: printed 'hello'\n"),
        ("    raise ArithmeticError('no luck')", 3, "raised ArithmeticError: no luck"),
    ],
)
def test_a_solver_ends_with_what_it_is(tmp_path, capsys, monkeypatch, body, status, said):
    """Its times are a list of their own: they are no verdicts."""
    monkeypatch.setattr(solvers, "GRIDS", (24,))
    (tmp_path / "mine.py").write_text(HEAD + body, encoding="utf-8")
    out = tmp_path / "out"
    assert main(["judge", str(tmp_path / "mine.py"), "--out", str(out)]) == status
    printed = capsys.readouterr().out
    assert said in printed and ("24²" in printed) == (status != 3)
    written = json.loads((out / "judgement.json").read_text(encoding="utf-8"))
    assert {point["outcome"] for point in written["verdicts"]} <= {WITHIN, OUTSIDE, NO_RESULT}
    assert [set(time) for time in written.get("times", [])] == [{"cells", "seconds", "bem3d"}] * (status != 3)
    times = out / "costs.csv"
    assert times.exists() == (status != 3) and (
        status == 3 or times.read_text(encoding="utf-8").startswith("cells,seconds,bem3d\n24,")
    )
