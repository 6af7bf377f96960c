"""The houses beside the core that are there, and what each brings: found by name, so that any of them may be missing.

A house is a package of `validation`. It has a dictionary `COMMANDS`, what each command of its folder `commands` does,
and a dictionary `BRINGS`, by its use the place of what others find in it, "module:variable".
"""

from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from pkgutil import iter_modules, resolve_name
from types import ModuleType
from typing import Any

HOUSES = ("advice", "railway", "judging")
"""Names in the order of the street: each house may import those before it."""
ROOT = "validation"


@cache
def houses() -> tuple[str, ...]:
    """Names of the houses whose package is installed, in the order of the street."""
    return tuple(name for name in HOUSES if find_spec(f"{ROOT}.{name}"))


def places(use: str) -> tuple[str, ...]:
    """Where houses have what they bring for a use."""
    entries = (resolve_name(f"{ROOT}.{house}").BRINGS.get(use) for house in houses())
    return tuple(place for place in entries if place)


def objects_of_houses(use: str) -> list[Any]:
    """What houses bring for a use, in the order of the street; imported now."""
    return [resolve_name(place) for place in places(use)]


def files_of_houses(name: str) -> Iterator[Path]:
    """The file of a name that houses may have in their package, in the order of the street."""
    packages = (Path(str(resolve_name(f"{ROOT}.{house}").__file__)).parent for house in houses())
    return (package / name for package in packages if (package / name).exists())


def commands() -> dict[str, tuple[str, str]]:
    """Names of the commands of the houses: what each does, and its module."""
    return {
        name: (what, f"{ROOT}.{house}.commands.{name}")
        for house in houses()
        for name, what in resolve_name(f"{ROOT}.{house}").COMMANDS.items()
    }


def modules_in(folder: str) -> Iterator[ModuleType]:
    """The modules of a folder that houses may have, imported now."""
    for house in houses():
        if find_spec(f"{ROOT}.{house}.{folder}"):
            package = resolve_name(f"{ROOT}.{house}.{folder}")
            yield from (resolve_name(f"{package.__name__}.{module.name}") for module in iter_modules(package.__path__))
