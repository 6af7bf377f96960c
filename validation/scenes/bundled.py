"""The scenes that come with this package: a file each, beside this one."""

import re
import stat
from collections.abc import Collection, Iterator
from pathlib import Path

from validation.analysis.escapes import printable
from validation.engine.street import objects_of_houses

SCENES = Path(__file__).parent

COMMENTED = re.compile(r"^# (\w+ = |\[[\w.]+\]\s)")
"""The beginning of a line that would be one of the scene without its sign."""


HEADER = re.compile(r"^\[([\w.]+)\]")
"""The line with the name of a table."""


def bundled() -> tuple[str, ...]:
    """Names of the scenes that come with this package."""
    return tuple(sorted(_files()))


def _files() -> dict[str, Path]:
    """Path of each shipped scene by its name, scenes of the houses included."""
    folders = [SCENES, *(Path(next(iter(house.__path__))) for house in objects_of_houses("scenes"))]
    return {path.stem: path for folder in folders for path in folder.glob("*.toml")}


def path_of(scene: str | Path) -> Path:
    """The file of a scene: a path, or, without folder and without ".toml", the name of a shipped one.

    Raises ValueError for a name that none has.
    """
    name = str(scene)
    if name.endswith(".toml") or Path(name).name != name:
        return Path(name)
    if name not in bundled():
        name = printable(name)
        raise ValueError(f'scene must be a file, as "./{name}.toml", or one of {", ".join(bundled())}, got "{name}"')
    return _files()[name]


def line_for(key: str) -> str:
    """The line of a shipped scene for a key as "wheel.load", or for a table; empty where none has it.

    Where no scene has the key in this table, one that has it in another. A line of a table in comments counts, too.
    """
    fallback, name = "", key.rpartition(".")[2]
    for scene in bundled():
        for table, code in _lines_of(scene):
            if code == f"[{key}]" or (code.startswith(f"{name} = ") and ".".join(filter(None, (table, name))) == key):
                return code
            if code.startswith(f"{name} = "):
                fallback = fallback or code
    return fallback


def places_of(key: str, *, required: str, roots: Collection[str]) -> tuple[str, ...]:
    """Where shipped scenes have a key, "in [wheel]", or a table of that name, "as [rail.levels]".

    required: a table that those scenes must have; roots: where that is the top of a file, all tables there may be.
    """
    places: dict[str, None] = {}
    for scene in bundled():
        lines = [*_lines_of(scene)]
        tables = {part for table, _ in lines for part in (table, table.rpartition(".")[0])}
        if not (required in tables if required else all(table.partition(".")[0] in roots for table in tables if table)):
            continue
        for table, code in lines:
            if code.startswith(f"{key} = ") and table != required:
                places[f"in [{table}]"] = None
            elif table.rpartition(".")[2] == key:
                places[f"as [{table}]"] = None
    return tuple(places)


def _lines_of(scene: str) -> Iterator[tuple[str, str]]:
    """Each line with a value or the name of a table, those in comments too, and the table that it stands in."""
    table = ""
    for line in path_of(scene).read_text(encoding="utf-8").splitlines():
        code = COMMENTED.sub(r"\1", line).partition("  #")[0].strip()
        if header := HEADER.match(code):
            table = header[1]
        if code and not code.startswith("#"):
            yield table, code


KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
"""Words for files that are not regular, by their type."""


class SceneError(ValueError):
    """What is wrong with a scene file, and where it can be shown, the lines that would be right."""


def check_regular(name: str, path: Path, *, most: int) -> int:
    """The size of a regular file [bytes].

    Raises OSError for one that is not there, ValueError for a folder, a pipe or a device, and beyond so many bytes.
    """
    try:
        status = path.stat()
    except OSError as problem:
        raise type(problem)(f"{name} {printable(path)} cannot be read: {problem.strerror}") from None
    except ValueError as problem:  # of a name with a zero byte
        raise ValueError(f"{name} {printable(path)} cannot be read: {problem}") from None
    if not stat.S_ISREG(status.st_mode):
        kind = KINDS.get(stat.S_IFMT(status.st_mode), "something else")
        raise ValueError(f"{name} {printable(path)} must be a regular file, got {kind}")
    if status.st_size > most:
        raise ValueError(f"{name} {printable(path)} must have at most {most} bytes, got {status.st_size}")
    return status.st_size


def contents_of(name: str, path: Path, *, most: int) -> bytes:
    """All that a regular file holds. Raises OSError and ValueError as `check_regular`."""
    check_regular(name, path, most=most)
    try:
        with path.open("rb") as file:
            # some files of the system have no size before they are read
            contents = file.read(most + 1)
    except OSError as problem:
        raise type(problem)(f"{name} {printable(path)} cannot be read: {problem.strerror}") from None
    if len(contents) > most:
        raise ValueError(f"{name} {printable(path)} must have at most {most} bytes, got more")
    return contents
