"""A fault, and wrongs that more than one room uses."""

import functools
import inspect
import types
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Times:
    """What is right, a function, a property or a number, with a factor on its value."""

    factor: float

    def of(self, right):
        if isinstance(right, float):
            return self.factor * right
        inner = getattr(right, "fget", None) or getattr(right, "func", None)
        return property(scaled(inner, self.factor)) if inner else scaled(right, self.factor)


@dataclass(frozen=True)
class Fault:
    """What is wrong, and what stands under a name in one place or several while it is."""

    what: str
    places: tuple = ()
    name: str = ""
    wrong: object = None

    def at(self, place, name, wrong):
        return replace(self, places=place if isinstance(place, tuple) else (place,), name=name, wrong=wrong)

    def plant(self, monkeypatch):
        for place in self.places:
            right = inspect.getattr_static(place, self.name)
            wrong = self.wrong.of(right) if isinstance(self.wrong, Times) else self.wrong
            monkeypatch.setattr(place, self.name, wrong)


def module_with(module, **wrong):
    """A module with some names changed."""
    return types.SimpleNamespace(**{**vars(module), **wrong})


def scaled(function, factor):
    """The same function with a factor on its result."""

    @functools.wraps(function)
    def wrong(*args, **kwargs):
        return factor * function(*args, **kwargs)

    return wrong


E_FOR_E_STAR = 1 - (1 / 3) ** 2
