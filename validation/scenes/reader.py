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
from validation.analysis.spectra import Detrend
from validation.scenes.bundled import SceneError, contents_of, line_for, places_of
from validation.scenes.printable import is_printable, printable, quoted, shortened
from validation.scenes.units import Dimension, quantity

Reader = Callable[[str, object], Any]

MOST_BYTES, LONGEST_LINE = 100_000, 1000
"""Of a scene file. Keys of thousands of parts, all on one line, would take minutes to parse."""
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
        raise ValueError(f"scene {printable(path)} must be valid TOML, got: {_wrong(contents, problem)}") from None


def _wrong(contents: bytes, problem: Exception) -> str:
    """What is wrong with a file that is no TOML, and what would be right, without its own words."""
    if isinstance(problem, RecursionError | UnicodeDecodeError):
        return "values nested too deep" if isinstance(problem, RecursionError) else "no text in UTF-8"
    got = printable(problem)
    if "Cannot overwrite" in got or "twice" in got:
        return f"{got}: a key or a table is given twice"
    at = AT_LINE.search(got)
    line = contents.decode("utf-8-sig").splitlines()[int(at[1]) - 1 : int(at[1])] if at else []
    if line and UNQUOTED.match(line[0]):
        return f'{got}: a value with a unit stands in quotation marks, as: load = "50 kN"'
    return got


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


def table(readers: Mapping[str, Reader], optional: tuple[str, ...], name: str, given: object) -> dict[str, Any]:
    """Read each value of a table by its own reader. ValueError for an unknown key, or a missing one that is needed."""
    if not isinstance(given, dict):
        raise ValueError(f"{name} must be a table, got {shortened(given)}")
    full = {key: f"{name}.{key}" if name else key for key in (*given, *readers)}
    for key in given:
        if key not in readers:
            unknown, right = printable(full[key]), _meant(key, name, readers)
            raise ValueError(f"{unknown} is unknown, {name or 'a scene'} must be made of {', '.join(readers)}{right}")
    for key in readers:
        if key not in given and key not in optional:
            raise ValueError(f"{full[key]} is missing, {name or 'a scene'} must have it{_as_line(full[key])}")
    return {key: read(full[key], given[key]) for key, read in readers.items() if key in given}


def one_of(given: dict[str, Any], name: str, keys: tuple[str, ...], *, least: int = 1) -> Any:
    """The value of one of these keys. ValueError for more of them, or fewer than the least."""
    found = [key for key in keys if key in given]
    if not least <= len(found) <= 1:
        raise ValueError(f"{name} must have one of {', '.join(keys)}, got {' and '.join(found) or 'none'}")
    return given[found[0]] if found else None


def _meant(key: str, name: str, readers: Collection[str]) -> str:
    """What an unknown key of a table may have been: one in other letters, one of another table, a similar one."""
    in_table = {one.casefold(): one for one in readers}
    if (same := in_table.get(key.casefold())) or not (places := places_of(key, beside=name, roots=readers)):
        meant = [same] if same else difflib.get_close_matches(key.casefold(), [*readers], 1)
        return _as_line(f"{name}.{meant[0]}" if name else meant[0]) or f", as {meant[0]}" if meant else ""
    return f"; {key} stands {' or '.join(places)}"


def _as_line(key: str) -> str:
    """A line that would be right."""
    line = line_for(key)
    return f", as: {line}" if line else ""


def without_unit(read: Reader, name: str, given: object) -> Any:
    """Read a value without unit. A wrong type is a ValueError here: in a file it is a wrong value."""
    if isinstance(given, (dict, list)):
        raise ValueError(f"{name} must be a number, got {shortened(given)}")
    try:
        return read(name, given)
    except TypeError as problem:
        raise ValueError(str(problem)) from None
    except OverflowError:
        raise ValueError(f"{name} must be finite, got a number of {len(str(given))} digits") from None


def nonblank_text(name: str, given: object) -> str:
    """Check a text: one line, not blank, printable."""
    if not isinstance(given, str) or not given.strip():
        raise ValueError(f"{name} must be a text that is not blank, got {shortened(given)}")
    if not is_printable(given):
        raise ValueError(f"{name} must be one line without control characters, got {shortened(given)}")
    return given


def yes_or_no(name: str, given: object) -> bool:
    if not isinstance(given, bool):
        raise ValueError(f"{name} must be true or false, got {shortened(given)}, as: {name.rpartition('.')[2]} = true")
    return given


def one_word(name: str, given: object, *, words: tuple[str, ...]) -> str:
    """Check one of some words."""
    if given not in words:
        raise ValueError(f"{name} must be one of {', '.join(map(quoted, words))}, got {shortened(given)}")
    return str(given)


def _number_or(dimension: Dimension, name: str, given: object) -> float:
    """A number, or a text with its unit."""
    return quantity(name, given, dimension) if isinstance(given, str) else float(NUMBER(name, given))


LENGTH, MASS, FORCE, PRESSURE, SPEED = (
    partial(quantity, dimension=dimension, positive=True)
    for dimension in ("length", "mass", "force", "pressure", "speed")
)
NUMBER, POSITIVE, WHOLE = (partial(without_unit, read) for read in (finite, positive, partial(count, least=1)))
DECIBELS: Reader = partial(_number_or, "level")
_LENGTHS = "radius diameter transverse_radius crown_radius side distance longest shortest spacing"
VALUES: dict[str, Reader] = {
    **dict.fromkeys(_LENGTHS.split(), LENGTH),
    **{"load": FORCE, "axle_load": FORCE, "mass": MASS, "speed": SPEED, "youngs_modulus": PRESSURE},
    **{"pressure": PRESSURE, "contact_modulus": PRESSURE, "poisson_ratio": NUMBER, "alpha": POSITIVE, "springs": WHOLE},
    **{"wheels_per_axle": WHOLE, "damping": partial(_number_or, "share of critical")},
    "detrend": partial(one_word, words=get_args(Detrend)),
    **{"name": nonblank_text, "file": nonblank_text, "curve": nonblank_text, "fill": yes_or_no, "crop": yes_or_no},
}
"""How the value of a key is read that is the same in all tables which have it."""


def values(*keys: str) -> dict[str, Reader]:
    """How each of these keys is read."""
    return {key: VALUES[key] for key in keys}
