"""The rules by which mutants are made: every one is other code that runs, and none is missed that should be there."""

import ast
from pathlib import Path

import pytest

from tests.mutation.mutants import mutants_of, mutated

ROOT = Path(__file__).parents[2]

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


REACHES = ("min(self.most - 1, 0)", "max(self.most + 1, 0)", "max(self.most - 2, 0)", "None")
SUMS = ("...", "total -= x[i] ** 2", "total += x[i] * 2", "total += x[i] ** 3")
CONDITIONS = (
    *("not (not x[i] < SLACK and i)", "not x[i] < SLACK or i", "not not x[i] < SLACK and i"),
    *("not x[i] <= SLACK and i", "not x[i] >= SLACK and i"),
)


def changes(scope=None):
    return [mutant.change for mutant in mutants_of("one.py", SOURCE) if scope in (None, mutant.scope)]


def test_each_change_stands_where_it_is_made():
    assert changes("") == ["SLACK = 0.5 -> SLACK = 1.0", "def area(x, *, sides=2): -> def area(x, *, sides=3):"]
    assert changes("Load") == ["most: int | None = 7 -> most: int | None = 8"]
    assert set(changes("Load.reach")) == {
        "if self.most is None: -> if self.most is not None:",
        *(f"return max(self.most - 1, 0) -> return {new}" for new in REACHES),
        "…turn max(self.most - 1, 0) -> …turn max(self.most - 1, 1)",
    }
    assert set(changes("area")) == {
        "total = 0.0 -> total = 1.0",
        *(f"x[i] = -x[i] -> {new}" for new in ("...", "x[i] = +x[i]")),
        *(f"if not x[i] < SLACK and i: -> if {new}:" for new in CONDITIONS),
        *(f"total += x[i] ** 2 -> {new}" for new in SUMS),
        "continue -> ...",
        "return total -> return None",
    }


def test_defaults_are_felt_in_their_function_and_constants_by_their_name():
    slack, sides = [mutant for mutant in mutants_of("one.py", SOURCE) if not mutant.scope]
    assert slack.name == "SLACK"
    lines = SOURCE.splitlines()
    assert [lines[i - 1].strip() for i in (sides.lines[0], sides.lines[-1])] == ["total = 0.0", "return total"]


@pytest.mark.parametrize("path", ["mdr/rolling.py", "bem3d/projected_cg.py", "bem3d/diagnostics.py"])
def test_every_mutant_is_other_code_that_can_be_compiled(path):
    source = (ROOT / path).read_text()
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
