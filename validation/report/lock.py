"""One run at a time in a folder: the lock of the operating system, and beside it a file that names its holder."""

import fcntl
import json
import os
import socket
import stat
from collections.abc import Iterator
from contextlib import contextmanager
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
    handle = _taken(path)
    try:
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(handle)


def _taken(path: Path) -> int:
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o644)
        try:
            if _held(handle, path):
                return handle
        except BaseException:
            os.close(handle)
            raise
        os.close(handle)


def _held(handle: int, path: Path) -> bool:
    """Lock the file and sign it; False where its last holder has removed it meanwhile."""
    foreign = ValueError(f"{path} is not the lock of a run: move it away, or name another folder")
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        raise foreign
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise ValueError(
            f"{path.parent} is being written by {_holder(_content(handle))}: wait for it, or name another folder"
        ) from None
    except OSError as error:
        raise ValueError(f"{path.parent} must be on a file system that has locks: {error.strerror}") from None
    try:
        if not os.path.samestat(os.fstat(handle), path.lstat()):
            return False
    except FileNotFoundError:
        return False
    content = _content(handle)
    if content:
        signed = _signature(content)
        if signed is None:
            raise foreign
        if signed["host"] != socket.gethostname():
            raise ValueError(
                f"{path.parent} is being written by {_holder(content)}, on another host: wait for it, or remove {path} "
                "if it is over"
            )
    since = datetime.now().astimezone().isoformat(" ", timespec="seconds")
    signature = {"kind": KIND, "host": socket.gethostname(), "process": os.getpid(), "since": since}
    with with_path_in_errors(path):
        os.ftruncate(handle, 0)
        os.pwrite(handle, json.dumps(signature).encode(), 0)
    return True


def _content(handle: int) -> bytes:
    return os.pread(handle, 4096, 0)


def _signature(content: bytes) -> dict[str, object] | None:
    """Host, process and time of the run that wrote a lock; None where the content is no lock."""
    try:
        signature = json.loads(content)
    except (ValueError, RecursionError):
        return None
    if not isinstance(signature, dict) or signature.get("kind") != KIND:
        return None
    return {name: signature.get(name) for name in ("host", "process", "since")}


def _holder(content: bytes) -> str:
    signed = _signature(content)
    if signed is None:
        return "another run"
    return f"process {signed['process']} on {signed['host']} since {signed['since']}"
