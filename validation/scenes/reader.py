"""Scene files: TOML tables, each value by its own reader, anything else is an error that names it."""

import difflib
import re
import tomllib
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path
from typing import Any, get_args

from mdr.checks import count, finite, positive
from validation.analysis.escapes import is_printable, printable, quoted, shortened
from validation.analysis.spectra import Detrend
from validation.scenes.bundled import SceneError, contents_of, line_for, places_of
from validation.scenes.units import Dimension, quantity

Reader = Callable[[str, object], Any]

MOST_BYTES, LONGEST_LINE = 100_000, 1000
"""Bounds of a scene file: keys of thousands of parts, all on one line, would take minutes to parse."""
AT_LINE = re.compile(r"at line (\d+)")
UNQUOTED = re.compile(r"\s*\w+\s*=\s*(?:[-+]?\d[\d.eE+-]*\s*[a-zA-Zµ%]|[“”„'‘’«])")
"""A number with a unit, or signs that are no quotation marks of TOML."""


def tables_of(path: Path) -> dict[str, Any]:
    """What a scene file holds.

    Raises OSError for files that cannot be read, ValueError where they are not TOML, too large or no regular files.
    """
    contents = contents_of("scene", path, most=MOST_BYTES)
    longest = max(map(len, contents.splitlines()), default=0)
    if longest > LONGEST_LINE:
        raise ValueError(f"scene {printable(path)} must have lines of at most {LONGEST_LINE} bytes, got {longest}")
    try:
        # with or without the mark that some editors put in front
        return tomllib.loads(contents.decode("utf-8-sig"))
    except (ValueError, RecursionError) as problem:
        raise ValueError(f"scene {printable(path)} must be valid TOML, got: {_toml_error(contents, problem)}") from None


def _toml_error(contents: bytes, problem: Exception) -> str:
    """Why a file is no TOML, and the line that would be right, without text of the file itself."""
    if isinstance(problem, RecursionError | UnicodeDecodeError):
        return "values nested too deep" if isinstance(problem, RecursionError) else "no text in UTF-8"
    message = printable(problem)
    if "Cannot overwrite" in message or "twice" in message:
        return f"{message}: a key or a table is given twice"
    location = AT_LINE.search(message)
    line = contents.decode("utf-8-sig").splitlines()[int(location[1]) - 1 : int(location[1])] if location else []
    if line and UNQUOTED.match(line[0]):
        return f'{message}: a value with a unit stands in quotation marks, as: load = "50 kN"'
    return message


@contextmanager
def errors_of(beginning: str, *, of: str = "", kind: type[ValueError] = ValueError) -> Iterator[None]:
    """Put a beginning, as a key, in front of the sentence of a ValueError. of: how such a sentence begins."""
    try:
        yield
    except ValueError as problem:
        raise kind(f"{beginning if str(problem).startswith(of) else ''}{problem}") from None


def errors_of_file(path: Path) -> AbstractContextManager[None]:
    """Put the name of a scene file in front of the sentence of a ValueError."""
    return errors_of(f"scene {printable(path)}: ", kind=SceneError)


def table(readers: Mapping[str, Reader], optional: tuple[str, ...], name: str, entries: object) -> dict[str, Any]:
    """Read each value of a table by its own reader. ValueError for an unknown key, or a missing one that is needed."""
    if not isinstance(entries, dict):
        raise ValueError(f"{name} must be a table, got {shortened(entries)}")
    full = {key: f"{name}.{key}" if name else key for key in (*entries, *readers)}
    for key in entries:
        if key not in readers:
            unknown, right = printable(full[key]), _suggestion(key, name, readers)
            raise ValueError(f"{unknown} is unknown, {name or 'a scene'} must be made of {', '.join(readers)}{right}")
    for key in readers:
        if key not in entries and key not in optional:
            raise ValueError(f"{full[key]} is missing, {name or 'a scene'} must have it{_example_line(full[key])}")
    return {key: read(full[key], entries[key]) for key, read in readers.items() if key in entries}


def value_of_one_key(entries: dict[str, Any], name: str, keys: tuple[str, ...], *, least: int = 1) -> Any:
    """The value of one of these keys. ValueError for more of them, or fewer than the least."""
    present = [key for key in keys if key in entries]
    if not least <= len(present) <= 1:
        raise ValueError(f"{name} must have one of {', '.join(keys)}, got {' and '.join(present) or 'none'}")
    return entries[present[0]] if present else None


def _suggestion(key: str, name: str, readers: Collection[str]) -> str:
    """A hint at the key that an unknown one may stand for: in other case, of another table, or a similar one."""
    in_table = {candidate.casefold(): candidate for candidate in readers}
    if (same := in_table.get(key.casefold())) or not (places := places_of(key, required=name, roots=readers)):
        similar = [same] if same else difflib.get_close_matches(key.casefold(), [*readers], 1)
        return _example_line(f"{name}.{similar[0]}" if name else similar[0]) or f", as {similar[0]}" if similar else ""
    return f"; {key} stands {' or '.join(places)}"


def _example_line(key: str) -> str:
    """The line of a shipped scene with this key, as the end of a message; empty where none has it."""
    line = line_for(key)
    return f", as: {line}" if line else ""


def without_unit(read: Reader, name: str, value: object) -> Any:
    """Read a value without unit. A wrong type is a ValueError here: in a file it is a wrong value."""
    if isinstance(value, (dict, list)):
        raise ValueError(f"{name} must be a number, got {shortened(value)}")
    try:
        return read(name, value)
    except TypeError as problem:
        raise ValueError(str(problem)) from None
    except OverflowError:
        raise ValueError(f"{name} must be finite, got a number of {len(str(value))} digits") from None


def nonblank_text(name: str, value: object) -> str:
    """Check a text: one line, not blank, printable."""
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"{name} must be a text that is not blank, got {shortened(value)}")
    if not is_printable(value):
        raise ValueError(f"{name} must be one line without control characters, got {shortened(value)}")
    return value


def yes_or_no(name: str, value: object) -> bool:
    """Check a bool, which TOML writes true or false."""
    if not isinstance(value, bool):
        raise ValueError(f"{name} must be true or false, got {shortened(value)}, as: {name.rpartition('.')[2]} = true")
    return value


def one_word(name: str, value: object, *, words: tuple[str, ...]) -> str:
    """Check one of some words."""
    if value not in words:
        raise ValueError(f"{name} must be one of {', '.join(map(quoted, words))}, got {shortened(value)}")
    return str(value)


def _number_or_quantity(dimension: Dimension, name: str, value: object) -> float:
    """A number without unit, or a text with a unit of the dimension, in SI units."""
    return quantity(name, value, dimension) if isinstance(value, str) else float(NUMBER(name, value))


LENGTH, MASS, FORCE, PRESSURE, SPEED = (
    partial(quantity, dimension=dimension, positive=True)
    for dimension in ("length", "mass", "force", "pressure", "speed")
)
NUMBER, POSITIVE, WHOLE = (partial(without_unit, read) for read in (finite, positive, partial(count, least=1)))
DECIBELS: Reader = partial(_number_or_quantity, "level")
_LENGTHS = "radius diameter transverse_radius crown_radius side distance longest shortest spacing"
VALUES: dict[str, Reader] = {
    **dict.fromkeys(_LENGTHS.split(), LENGTH),
    **{"load": FORCE, "axle_load": FORCE, "mass": MASS, "speed": SPEED, "youngs_modulus": PRESSURE},
    **{
        "pressure": PRESSURE,
        "contact_modulus": PRESSURE,
        "poisson_ratio": NUMBER,
        "lateral_ratio": POSITIVE,
        "springs": WHOLE,
    },
    **{"wheels_per_axle": WHOLE, "damping": partial(_number_or_quantity, "share of critical")},
    "detrend": partial(one_word, words=get_args(Detrend)),
    **{"name": nonblank_text, "file": nonblank_text, "curve": nonblank_text, "fill": yes_or_no, "crop": yes_or_no},
}
"""How the value of a key is read that is the same in all tables which have it."""


def values(*keys: str) -> dict[str, Reader]:
    """How each of these keys is read."""
    return {key: VALUES[key] for key in keys}
