"""One run at a time in a folder: the lock of the operating system, and beside it a file that names its holder."""

import fcntl
import json
import os
import socket
import stat
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import Any

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
            raise ValueError(
                f"{folder} is being written by {_holder(_signature(handle, path))}: wait for it, or name another folder"
            ) from None
        except OSError as error:
            raise ValueError(f"{folder} must be on a file system that has locks: {error.strerror}") from None
        try:
            if not os.path.samestat(os.fstat(handle), path.lstat()):
                return None
        except FileNotFoundError:
            return None
        signed = _signature(handle, path)
        if signed.get("host", host) != host:
            raise ValueError(
                f"{folder} is being written by {_holder(signed)}, on another host: wait for it, or remove {path} if it "
                "is over"
            )
        since = datetime.now().astimezone().isoformat(" ", timespec="seconds")
        signature = {"kind": KIND, "host": host, "process": os.getpid(), "since": since}
        with with_path_in_errors(path):
            os.ftruncate(handle, 0)
            os.pwrite(handle, json.dumps(signature).encode(), 0)
        given_up.pop_all()
    return handle


def _signature(handle: int, path: Path) -> dict[str, Any]:
    """Host, process and time of a run, empty before it has signed. Raises ValueError for a file that is no lock."""
    try:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            raise ValueError("no plain file")
        signature = json.loads(os.pread(handle, 4096, 0) or "{}")
        if signature and signature["kind"] != KIND:
            raise ValueError("of another kind")
        return {name: signature[name] for name in ("host", "process", "since")} if signature else {}
    except (ValueError, TypeError, LookupError, RecursionError):
        raise ValueError(f"{path} is not the lock of a run: move it away, or name another folder") from None


def _holder(signed: dict[str, Any]) -> str:
    said = "process {process} on {host} since {since}"
    return said.format(**signed) if signed else "another run"
