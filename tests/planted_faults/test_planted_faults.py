"""Negative controls: each fault is planted on purpose, and the named test must catch it."""

import functools
import importlib
import inspect
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, settings

from tests.planted_faults.wrong import Fault

HELPERS = {"__init__", "test_planted_faults", "wrong"}
NAMES = sorted({path.stem for path in Path(__file__).parent.glob("*.py")} - HELPERS)
ROOMS = [importlib.import_module(f"tests.planted_faults.{name}") for name in NAMES]


def planted(rows) -> Iterator[tuple[str, tuple[Fault, Callable]]]:
    """Each fault by what is wrong, with the test above it."""
    named_test = None
    for row in rows:
        if isinstance(row, Fault):
            yield row.what, (row, named_test)
        else:
            named_test = row


FAULTS = dict(row for room in ROOMS for row in planted(room.FAULTS))


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


def is_in_the_suite(named_test):
    """Whether pytest runs a named test, with these arguments and without a fault: there it must pass."""
    test = getattr(named_test, "func", named_test)
    given = inspect.signature(test).bind(*getattr(named_test, "args", ()), **getattr(named_test, "keywords", {}))
    left = dict(given.arguments)
    for names, rows in parametrized(test):
        values = tuple(left.pop(name) for name in names)
        if not any(all(map(is_same, values, row)) for row in rows):
            return False
    return not left and getattr(sys.modules[test.__module__], test.__name__) is test


def test_named_tests_are_those_of_the_suite():
    assert [fault for fault, (_, named_test) in FAULTS.items() if not is_in_the_suite(named_test)] == []


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
@pytest.mark.parametrize("fault", FAULTS)
def test_a_named_test_catches(fault, monkeypatch):
    planted_fault, named_test = FAULTS[fault]
    planted_fault.plant(monkeypatch)
    stop_at_the_first_failure(getattr(named_test, "func", named_test), monkeypatch)
    with pytest.raises(AssertionError):
        named_test()
