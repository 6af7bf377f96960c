"""Files that appear whole or not at all, and that are plain files."""

import errno
import os
import re
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PARTIAL_FILE = re.compile(r"\.mdr-validation-[a-z0-9_]{8}\.part")
"""The name of a file that a process is writing, or was writing when it was killed."""
_NAMES = ("ENOENT", "ENOTDIR", "EISDIR", "EEXIST", "EACCES", "EPERM", "EROFS", "ENAMETOOLONG", "ELOOP", "EINVAL")
ERRORS_OF_A_PATH = frozenset(getattr(errno, name) for name in _NAMES)
"""Errors that are due to the path; all others are due to the machine."""


def write_whole(path: Path, contents: bytes) -> None:
    """Write beside the place and rename: no reader ever sees half a file. Raises OSError, which names the place."""
    temporary = write_partial_file(path, contents)
    try:
        with with_path_in_errors(path):
            temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def write_partial_file(path: Path, contents: bytes) -> Path:
    """The contents in a file beside their place, to be renamed. Raises OSError, which names the place."""
    with with_path_in_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=".mdr-validation-", suffix=".part")
        temporary = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(contents)
            temporary.chmod(0o644)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    return temporary


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
