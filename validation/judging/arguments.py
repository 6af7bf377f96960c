"""Arguments as a function of somebody else gets them: copies, which are compared with the originals afterwards."""

import copy
import functools
import types
from collections.abc import Mapping
from typing import Any

import numpy as np

PLAIN = (bool, int, float, complex, str, bytes, type(None), types.FunctionType, types.BuiltinFunctionType, type)
"""Values that cannot be changed, or that a copy would share."""


def copy_of(value: Any) -> Any:
    """For one call. An array cannot be written; a generator of random numbers is itself: its state is to change."""
    if isinstance(value, (np.random.Generator, *PLAIN)):
        return value
    if isinstance(value, np.ndarray):
        array = value.copy()
        array.setflags(write=False)
        return array
    try:
        return copy.deepcopy(value)
    # an object of a program may have what cannot be copied, as an open file
    except Exception:
        return value


def as_argument(lent: Any) -> Any:
    """What the function is given: of an array a view, since a view of what cannot be written stays so."""
    return lent[...] if isinstance(lent, np.ndarray) else lent


def changed(arguments: Mapping[str, Any], lent: Mapping[str, Any]) -> str:
    """The first argument whose copy is no longer equal to it; nothing where all are."""
    return next((name for name, value in arguments.items() if not _same(value, lent[name], set())), "")


def classes_of(arguments: Mapping[str, Any]) -> dict[str, dict[type, dict[str, Any]]]:
    """What the classes of the arguments hold, by the name of the argument: methods may be changed there."""
    return {
        name: {of: _public(of) for of in type(value).__mro__ if of.__module__ != "builtins"}
        for name, value in arguments.items()
        if not isinstance(value, (*PLAIN, np.ndarray, np.generic, np.random.Generator))
    }


def restored(classes: Mapping[str, Mapping[type, Mapping[str, Any]]]) -> str:
    """The first argument whose class was changed since, which is put back; nothing where none was."""
    first = ""
    for name, kinds in classes.items():
        for of, before in kinds.items():
            now = _public(of)
            if now.keys() == before.keys() and all(now[key] is before[key] for key in now):
                continue
            first = first or name
            for key in now.keys() - before.keys():
                delattr(of, key)
            for key, value in before.items():
                setattr(of, key, value)
    return first


def _public(of: type) -> dict[str, Any]:
    return {name: value for name, value in vars(of).items() if not name.startswith("__") and name != "_abc_impl"}


def _same(value: Any, other: Any, seen: set[tuple[int, int]]) -> bool:
    """Equal in all that it holds; attributes that are new, as of a cache, are nobody's."""
    pair = id(value), id(other)
    if value is other or pair in seen:
        return True
    seen.add(pair)
    if type(value) is not type(other):
        return False
    if isinstance(value, np.ndarray):
        return bool(value.dtype == other.dtype and np.array_equal(value, other, equal_nan=value.dtype.kind in "fc"))
    if isinstance(value, float):
        return bool(value == other or (value != value and other != other))
    if isinstance(value, dict):
        return value.keys() == other.keys() and all(_same(value[key], other[key], seen) for key in value)
    if isinstance(value, list | tuple):
        return len(value) == len(other) and all(_same(*parts, seen) for parts in zip(value, other, strict=True))
    parts = _parts(value), _parts(other)
    if parts[0]:
        return all(name in parts[1] and _same(part, parts[1][name], seen) for name, part in parts[0].items())
    try:
        return bool(value == other) or isinstance(value, np.random.Generator) or not _compares(value)
    except Exception:
        return True


def _parts(value: Any) -> dict[str, Any]:
    """What an object holds, by name: of a method its object, of a partial its arguments."""
    if isinstance(value, functools.partial):
        return {"func": value.func, "args": value.args, "keywords": value.keywords}
    if isinstance(value, types.MethodType):
        return {"function": value.__func__, "self": value.__self__}
    slots = (name for of in type(value).__mro__ for name in _slots(of))
    return {**getattr(value, "__dict__", {}), **{name: getattr(value, name) for name in slots if hasattr(value, name)}}


def _slots(of: type) -> tuple[str, ...]:
    names = vars(of).get("__slots__", ())
    return (names,) if isinstance(names, str) else tuple(name for name in names if not name.startswith("__"))


def _compares(value: Any) -> bool:
    """Whether its class says when two are equal: else a copy never is."""
    return vars(object)["__eq__"] is not type(value).__eq__
