"""Scene files: TOML tables, each value by its own reader, everything else refused by name."""

import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from mdr.border import count, finite
from validation.quantities import quantity

Reader = Callable[[str, object], Any]

SCENES = Path(__file__).parent / "scenes"


def shipped() -> tuple[str, ...]:
    """Names of the scenes that come with this package."""
    return tuple(sorted(path.stem for path in SCENES.glob("*.toml")))


def path_of(scene: str | Path) -> Path:
    """The file of a scene: a path, or, without folder and without ".toml", the name of a shipped one.

    Raises ValueError for a name that none has.
    """
    name = str(scene)
    if name.endswith(".toml") or Path(name).name != name:
        return Path(name)
    if name not in shipped():
        raise ValueError(f'scene must be a file, as "./{name}.toml", or one of {", ".join(shipped())}, got "{name}"')
    return SCENES / f"{name}.toml"


def tables_of(path: Path) -> dict[str, Any]:
    """What a scene file holds. Raises OSError for files that cannot be read, ValueError where they are not TOML."""
    try:
        # with or without the mark that some editors put in front
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as problem:
        raise type(problem)(f"scene {path} cannot be read: {problem.strerror}") from None
    except ValueError as problem:
        raise ValueError(f"scene {path} must be valid TOML, got: {problem}") from None


def table(readers: Mapping[str, Reader], optional: tuple[str, ...], name: str, given: object) -> dict[str, Any]:
    """Each value of a table by its own reader; no key unknown, none missing but what is optional."""
    if not isinstance(given, dict):
        raise ValueError(f"{name} must be a table, got {given!r}")
    full = {key: f"{name}.{key}" if name else key for key in (*given, *readers)}
    for key in given:
        if key not in readers:
            raise ValueError(f"{full[key]} is unknown, {name or 'a scene'} must be made of {', '.join(readers)}")
    for key in readers:
        if key not in given and key not in optional:
            raise ValueError(f"{full[key]} is missing, {name or 'a scene'} must have it")
    return {key: read(full[key], given[key]) for key, read in readers.items() if key in given}


def plain(read: Reader, name: str, given: object) -> Any:
    """A value without unit. In a file a wrong type is a wrong value, too."""
    try:
        return read(name, given)
    except TypeError as problem:
        raise ValueError(str(problem)) from None
    except OverflowError:
        raise ValueError(f"{name} must be finite, got a number of {len(str(given))} digits") from None


def named(name: str, given: object) -> str:
    """A text that is not blank."""
    if not isinstance(given, str) or not given.strip():
        raise ValueError(f"{name} must be a text that is not blank, got {given!r}")
    return given


def contact_modulus(name: str, given: object) -> float:
    """E* = E / (1 - nu^2) of a table with both, the other body being rigid [Pa]."""
    material = table({"youngs_modulus": PRESSURE, "poisson_ratio": NUMBER}, (), name, given)
    nu = material["poisson_ratio"]
    if not 0 <= nu <= 0.5:
        raise ValueError(f"{name}.poisson_ratio must lie in [0, 0.5], got {nu}")
    return float(material["youngs_modulus"] / (1 - nu**2))


LENGTH, MASS, FORCE, PRESSURE, SPEED = (
    partial(quantity, dimension=dimension, positive=True)
    for dimension in ("length", "mass", "force", "pressure", "speed")
)
NUMBER, WHOLE = partial(plain, finite), partial(plain, partial(count, least=1))
