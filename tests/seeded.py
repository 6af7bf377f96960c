"""Seeded faults: mistakes that a physicist makes, as decorators of the tests that must catch them."""

import functools
import inspect
import math
import pkgutil
import types
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import pytest

Test = Callable[..., Any]


@dataclass(frozen=True)
class Times:
    """What is right, a function, a property or a number, with a factor on its value."""

    factor: float

    def of(self, right: Any) -> Any:
        if isinstance(right, float):
            return self.factor * right
        inner = getattr(right, "fget", None) or getattr(right, "func", None)
        return property(scaled(inner, self.factor)) if inner else scaled(right, self.factor)


@dataclass(frozen=True)
class SeededFault:
    """what: is wrong, the name of the fault; test: that must catch it, with a row of arguments and others by name;
    targets: dotted names that have the value `wrong` while it is seeded.
    """

    what: str
    test: Test
    targets: tuple[str, ...]
    wrong: Any
    row: tuple[Any, ...]
    arguments: dict[str, Any]

    def places(self) -> Iterator[tuple[Any, str, Any]]:
        """Object, attribute and right value of each target; an attribute that is not there raises AttributeError."""
        for target in self.targets:
            place, _, name = target.rpartition(".")
            owner = pkgutil.resolve_name(place)
            yield owner, name, inspect.getattr_static(owner, name)

    def seed(self, monkeypatch: pytest.MonkeyPatch) -> None:
        for owner, name, right in self.places():
            monkeypatch.setattr(owner, name, self.wrong.of(right) if isinstance(self.wrong, Times) else self.wrong)

    def run(self) -> None:
        self.test(*self.row, **self.arguments)


FAULTS: list[SeededFault] = []
"""Of all files of tests that are imported."""


@dataclass(frozen=True)
class Seed:
    """The name of a fault, and arguments of the test that must catch it."""

    what: str
    row: tuple[Any, ...]
    arguments: dict[str, Any]

    def at(self, target: str | tuple[str, ...], wrong: Any) -> Callable[[Test], Test]:
        """target: dotted name of the attribute where it is looked up, or several; wrong: its value while the fault is
        seeded, another function or number, or `Times` a factor on what is right.
        """
        targets = (target,) if isinstance(target, str) else target

        def decorator(test: Test) -> Test:
            FAULTS.append(SeededFault(self.what, test, targets, wrong, self.row, self.arguments))
            return test

        return decorator


def catches(what: str, /, *row: Any, **arguments: Any) -> Seed:
    """A fault that the decorated test must catch: `@catches("what is wrong", argument=value).at(target, wrong)`.

    what: is wrong, unique; row, arguments: of a parametrized test, as pytest has them.
    """
    return Seed(what, row, arguments)


def catches_root_of_two(what: str, target: str, /, *row: Any, **arguments: Any) -> Callable[[Test], Test]:
    """Two faults: a root of two that is lost, and one that is gained, where h' or g is computed."""

    def decorator(test: Test) -> Test:
        for change, factor in (("lost", math.sqrt(0.5)), ("gained", math.sqrt(2))):
            catches(f"a root of two {change} in {what}", *row, **arguments).at(target, Times(factor))(test)
        return test

    return decorator


def module_with(module: types.ModuleType, **wrong: Any) -> types.SimpleNamespace:
    """A module with some names changed."""
    return types.SimpleNamespace(**{**vars(module), **wrong})


def scaled(function: Callable[..., Any], factor: float) -> Callable[..., Any]:
    """The same function with a factor on its result."""

    @functools.wraps(function)
    def wrong(*args: Any, **kwargs: Any) -> Any:
        return factor * function(*args, **kwargs)

    return wrong


E_FOR_E_STAR = 1 - (1 / 3) ** 2
