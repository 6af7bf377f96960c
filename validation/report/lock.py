"""One run at a time in a folder: the lock of the operating system, and beside it a file that names its holder."""

import fcntl
import os
import socket
import stat
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path

from validation.engine.files import with_path_in_errors

LOCK = ".mdr-validation.lock"
"""The file, there while a run writes, and after one that was killed."""
KIND = "mdr-validation lock"


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """No other run writes a report into the folder meanwhile.

    The system gives its lock back when a process ends, however it ends, so a file without a lock is that of a run that
    was killed; unless the run was on another host, whose locks may not be seen from here.
    Raises ValueError where another run is at work, or may be, and where there are no locks; OSError, which names the
    file, where it cannot be written.
    """
    path = folder / LOCK
    while (handle := _taken(path)) is None:
        pass
    try:
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(handle)


def _taken(path: Path) -> int | None:
    """The file, locked and signed; None where its last holder has removed it meanwhile."""
    folder, host = path.parent, socket.gethostname()
    with ExitStack() as given_up:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o644)
        given_up.callback(os.close, handle)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            _, holder = _signature(handle, path)
            said = f"{folder} is being written by {holder or 'another run'}: wait for it, or name another folder"
            raise ValueError(said) from None
        except OSError as error:
            raise ValueError(f"{folder} must be on a file system that has locks: {error.strerror}") from None
        try:
            if not os.path.samestat(os.fstat(handle), path.lstat()):
                return None
        except FileNotFoundError:
            return None
        signed, holder = _signature(handle, path)
        if signed not in ("", host):
            what_to_do = f"wait for it, or remove {path} if it is over"
            raise ValueError(f"{folder} is being written by {holder}, on another host: {what_to_do}")
        since = datetime.now().astimezone().isoformat(" ", timespec="seconds")
        with with_path_in_errors(path):
            os.ftruncate(handle, 0)
            os.pwrite(handle, f"{KIND}\n{host}\nprocess {os.getpid()} on {host} since {since}\n".encode(), 0)
        given_up.pop_all()
    return handle


def _signature(handle: int, path: Path) -> tuple[str, str]:
    """Host of a run and the run in words, empty before it has signed. Raises ValueError for a file that is no lock."""
    plain = stat.S_ISREG(os.fstat(handle).st_mode)
    text = os.pread(handle, 4096, 0).decode(errors="replace") if plain else "no plain file"
    kind, *signed = text.split("\n")
    if text and (kind != KIND or len(signed) != 3):
        raise ValueError(f"{path} is not the lock of a run: move it away, or name another folder")
    return (signed[0], signed[1]) if text else ("", "")
