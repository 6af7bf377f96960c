"""Negative controls: each fault is seeded on purpose, and the test that `catches` it must fail by an assertion."""

import functools
import importlib
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, settings

from tests.seeded import FAULTS

ROOT = Path(__file__).parents[1]
for path in sorted((ROOT / "tests").rglob("test_*.py")):
    if "from tests.seeded import" in path.read_text(encoding="utf-8"):
        importlib.import_module(".".join(path.relative_to(ROOT).with_suffix("").parts))


def test_each_fault_has_a_name_of_its_own():
    names = [fault.what for fault in FAULTS]
    assert sorted(names) == sorted(set(names))


def test_targets_are_there():
    for fault in FAULTS:
        assert list(fault.places()), fault.what


def parametrized(test) -> Iterator[tuple[list[str], list[tuple]]]:
    """Names of arguments, and the rows of values with which pytest runs a test, mark by mark."""
    for mark in getattr(test, "pytestmark", ()):
        if mark.name == "parametrize":
            names, rows = mark.args
            names = names.replace(" ", "").split(",") if isinstance(names, str) else list(names)
            yield names, [tuple(row) if len(names) > 1 else (row,) for row in rows]


def is_same(value, other):
    """Arrays and NaN by what they hold."""
    if isinstance(value, np.ndarray | float) and isinstance(other, np.ndarray | float | int):
        return np.array_equal(value, other, equal_nan=True)
    return value == other


def is_in_the_suite(fault):
    """Whether pytest runs the test, with these arguments and without a fault: there it must pass."""
    test = fault.test
    left = dict(inspect.signature(test).bind(*fault.row, **fault.arguments).arguments)
    for names, rows in parametrized(test):
        values = tuple(left.pop(name) for name in names)
        if not any(all(map(is_same, values, row)) for row in rows):
            return False
    return not left and getattr(sys.modules[test.__module__], test.__name__) is test


def test_tests_that_catch_faults_are_those_of_the_suite():
    assert [fault.what for fault in FAULTS if not is_in_the_suite(fault)] == []


def stop_at_the_first_failure(test, monkeypatch):
    """A property that is refuted is refuted: no smaller example, and no other one, is looked for."""
    if hasattr(test, "hypothesis"):
        own = test._hypothesis_internal_use_settings
        quick = settings(own, phases=[Phase.explicit, Phase.generate], report_multiple_bugs=False, database=None)
        monkeypatch.setattr(test, "_hypothesis_internal_use_settings", quick)


@pytest.fixture
def nothing_remembered():
    """What the project keeps of earlier calls is neither taken nor left: it would outlive the fault."""
    forget()
    yield
    forget()


def forget():
    for name, module in list(sys.modules.items()):
        if name.partition(".")[0] in ("mdr", "bem3d", "validation", "tests"):
            for value in vars(module).values():
                if isinstance(value, functools._lru_cache_wrapper):
                    value.cache_clear()


@pytest.mark.slow
@pytest.mark.usefixtures("nothing_remembered")
@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.what)
def test_the_decorated_test_catches(fault, monkeypatch):
    fault.seed(monkeypatch)
    stop_at_the_first_failure(fault.test, monkeypatch)
    with pytest.raises(AssertionError):
        fault.run()
