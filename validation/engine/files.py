"""Files that appear whole or not at all, and that are plain files."""

import errno
import os
import re
import secrets
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TextIO

PARTIAL_FILE = re.compile(r"\.mdr-validation-[a-z0-9_]{8}\.part")
"""The name of a file that a process is writing, or was writing when it was killed."""
_NAMES = "ENOENT ENOTDIR EISDIR EEXIST EACCES EPERM EROFS ENAMETOOLONG ELOOP EINVAL ENXIO"
ERRORS_OF_A_PATH = frozenset(getattr(errno, name) for name in _NAMES.split())
"""Errors that are due to the path; all others are due to the machine."""


def place_in(folder: Path, name: str) -> Path:
    """Where a file stands whose name is UTF-8 on disk, whatever the encoding of the system."""
    return folder / os.fsdecode(name.encode())


def name_in(folder: Path, place: Path) -> str:
    """The name of a file of a folder, with /: the inverse of `place_in`."""
    return os.fsencode(place.relative_to(folder).as_posix()).decode(errors="replace")


def write_output(path: Path, contents: bytes) -> None:
    """Write where a user says: a plain file is replaced, with the mode and the owner that it has, or as the umask says.

    Links are followed. A device, a pipe, or the file that this program prints to is written into and stays what it is.
    Raises OSError, which names the path.
    """
    with with_path_in_errors(path):
        status = path.stat() if path.exists() else None
        if status and (stream := _stream_of(status)):
            stream.flush()
            _write_into(os.dup(stream.fileno()), contents)
        elif status and not stat.S_ISREG(status.st_mode):
            _write_into(os.open(path, os.O_WRONLY), contents)
        else:
            write_whole(Path(os.path.realpath(path)), contents, like=status)


def write_whole(path: Path, contents: bytes, *, like: os.stat_result | None = None) -> None:
    """Write beside the place and rename: no reader ever sees half a file. Raises OSError, which names the place.

    like: what it replaces, whose mode and owner it keeps.
    """
    with with_path_in_errors(path):
        temporary = write_partial_file(path, contents)
        with _remove_on_errors(temporary):
            if like:
                with suppress(PermissionError):
                    os.chown(temporary, like.st_uid, like.st_gid)
                temporary.chmod(stat.S_IMODE(like.st_mode))
            temporary.replace(path)


def write_partial_file(path: Path, contents: bytes) -> Path:
    """The contents in a file beside their place, to be renamed. Raises OSError, which names the place."""
    with with_path_in_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.parent / f".mdr-validation-{secrets.token_hex(4)}.part"
        handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
        with _remove_on_errors(temporary):
            _write_into(handle, contents)
    return temporary


def _write_into(handle: int, contents: bytes) -> None:
    """Write the contents to an open handle, and close it."""
    with os.fdopen(handle, "wb") as file:
        file.write(contents)


def _stream_of(file: os.stat_result) -> TextIO | None:
    """The stream of this program that writes to the same file, None where neither does."""
    for stream in (sys.stdout, sys.stderr):
        # what stands in their place may be no file
        with suppress(OSError, ValueError, AttributeError):
            if os.path.samestat(file, os.fstat(stream.fileno())):
                return stream
    return None


@contextmanager
def _remove_on_errors(temporary: Path) -> Iterator[None]:
    """Remove a temporary file where the block raises, an interruption included."""
    try:
        yield
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def read_plain(path: Path) -> bytes:
    """The content of a plain file. Raises OSError for anything else, without following a link or waiting for a pipe."""
    handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            raise OSError(errno.EINVAL, "not a plain file", str(path))
        with os.fdopen(handle, "rb", closefd=False) as file:
            return file.read()
    finally:
        os.close(handle)


def is_plain(path: Path) -> bool:
    """Whether the path is a plain file, and no link to one."""
    return path.is_file() and not path.is_symlink()


def is_there(path: Path) -> bool:
    """Whether the path exists, if only as a link to nothing."""
    return os.path.lexists(path)


@contextmanager
def with_path_in_errors(path: Path) -> Iterator[None]:
    """Errors of the system name this path: writing to a full disk would name none."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
