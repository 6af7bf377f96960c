"""Files that are given: regular ones, of bounded size."""

import stat
from pathlib import Path

from validation.scenes.printable import printable

KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
"""Of what is no regular file."""


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
