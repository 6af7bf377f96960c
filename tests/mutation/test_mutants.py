"""The rules by which mutants are made: every one is other code that runs, and none is missed that should be there."""

import ast
from pathlib import Path

import pytest

from tests.mutation.mutants import mutants_of, mutated

SOURCE = '''"""A module of 3 lines."""
from math import pi

SLACK = 0.5


class Load:
    """Of 2 numbers."""

    most: int | None = 7

    @property
    def reach(self) -> int | None:
        """As far as 1."""
        if self.most is None:
            return None
        return max(self.most - 1, 0)


def area(x, *, sides=2):
    total = 0.0
    for i in range(sides):
        x[i] = -x[i]
        if not x[i] < SLACK and i:
            total += x[i] ** 2
            continue
    return total
'''
CHANGES = {
    "": ["SLACK = 0.5 -> SLACK = 1.0", "def area(x, *, sides=2): -> def area(x, *, sides=3):"],
    "Load": ["most: int | None = 7 -> most: int | None = 8"],
    "Load.reach": [
        "if self.most is None: -> if self.most is not None:",
        *(f"return max(self.most - 1, 0) -> return {new}" for new in ("min(self.most - 1, 0)", "None")),
        *(f"return max(self.most - 1, 0) -> return max(self.most {new}, 0)" for new in ("+ 1", "- 2")),
        "…turn max(self.most - 1, 0) -> …turn max(self.most - 1, 1)",
    ],
    "area": [
        *["total = 0.0 -> total = 1.0", "continue -> ...", "return total -> return None"],
        *(f"x[i] = -x[i] -> {new}" for new in ("...", "x[i] = +x[i]")),
        *(f"if not x[i] < SLACK and i: -> if not {new}:" for new in ("(not x[i] < SLACK and i)", "x[i] < SLACK or i")),
        *(f"if not x[i] < SLACK and i: -> if not {new} and i:" for new in ("not x[i] < SLACK", "x[i] <= SLACK")),
        "if not x[i] < SLACK and i: -> if not x[i] >= SLACK and i:",
        *(f"total += x[i] ** 2 -> {new}" for new in ("...", "total -= x[i] ** 2")),
        *(f"total += x[i] ** 2 -> total += x[i] {new}" for new in ("* 2", "** 3")),
    ],
}


def test_each_change_stands_where_it_is_made():
    found = [(mutant.scope, mutant.change) for mutant in mutants_of("one.py", SOURCE)]
    assert sorted(found) == sorted((scope, change) for scope, changes in CHANGES.items() for change in changes)


def test_defaults_are_felt_in_their_function_and_constants_by_their_name():
    slack, sides = [mutant for mutant in mutants_of("one.py", SOURCE) if not mutant.scope]
    assert slack.name == "SLACK"
    lines = SOURCE.splitlines()
    assert [lines[i - 1].strip() for i in (sides.lines[0], sides.lines[-1])] == ["total = 0.0", "return total"]


@pytest.mark.parametrize("path", ["mdr/rolling.py", "bem3d/projected_cg.py", "bem3d/diagnostics.py"])
def test_every_mutant_is_other_code_that_can_be_compiled(path):
    source = (Path(__file__).parents[2] / path).read_text(encoding="utf-8")
    plain, found = ast.unparse(ast.parse(source)), mutants_of(path, source)
    assert len(found) > 30
    for mutant in found[:: len(found) // 8]:
        code = mutated(mutant, source)
        assert code != plain
        compile(code, path, "exec")


def test_a_mutant_of_another_source_is_refused():
    last = mutants_of("one.py", SOURCE)[-1]
    with pytest.raises(ValueError, match="there is no mutant"):
        mutated(last, "x = 1")
