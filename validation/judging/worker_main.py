"""The process of a file of somebody else: it runs the file, then answers through a channel until nobody asks."""

import fcntl
import importlib.util
import os
import pickle
import resource
import secrets
import signal
import socket
import struct
import sys
import tempfile
import time
from contextlib import suppress
from functools import partial
from importlib.machinery import SourceFileLoader
from pathlib import Path
from typing import IO, Any

from validation.engine.workers import end_after
from validation.judging.registry import DECORATED, KINDS, Offered
from validation.judging.replies import SHOWN, called, has_forked, raised
from validation.judging.source_files import OPENED, sources_of, watch_opened

TOKEN = 16
"""Bytes."""
HEAD = struct.Struct(f"!{TOKEN}sQ")
"""Before each object: the token, and its size."""


class ForeignBytesError(OSError):
    """Something else has written into the channel."""


class Channel:
    """One end of a pair of sockets. Raises OSError where the end is no longer what it was, as after `os.closerange`."""

    def __init__(self, end: socket.socket, token: bytes):
        self._end, self._token, self._file = end, token, os.fstat(end.fileno())

    @classmethod
    def pair(cls) -> tuple["Channel", socket.socket]:
        """An end, and the other one, from which `at` makes a channel."""
        end, other = socket.socketpair()
        channel = cls(end, secrets.token_bytes(TOKEN))
        end.sendall(channel._token)
        return channel, other

    @classmethod
    def at(cls, handle: int) -> "Channel":
        """The other end, by its file descriptor."""
        end = socket.socket(fileno=handle)
        return cls(end, _read(end, TOKEN, None))

    def send(self, message: object, seconds: float | None = None) -> None:
        """Raises TimeoutError where the other side reads too slowly, OSError where it is gone."""
        contents = pickle.dumps(message, pickle.HIGHEST_PROTOCOL)
        if not os.path.samestat(self._file, os.fstat(self._end.fileno())):
            raise ForeignBytesError("the file descriptor of the channel is another file now")
        self._end.settimeout(seconds)
        self._end.sendall(HEAD.pack(self._token, len(contents)) + contents)

    def receive(self, seconds: float | None = None) -> Any:
        """Raises TimeoutError after that time, EOFError at the end, ForeignBytesError for what `send` did not write."""
        until = None if seconds is None else time.monotonic() + seconds
        token, size = HEAD.unpack(_read(self._end, HEAD.size, until))
        if token != self._token:
            raise ForeignBytesError("bytes without the token")
        contents = _read(self._end, size, until)
        try:
            return pickle.loads(contents)
        # an object may do anything when it is read
        except Exception as error:
            raise ForeignBytesError("an object that cannot be read") from error

    def close(self) -> None:
        self._end.close()


def _read(end: socket.socket, size: int, until: float | None) -> bytes:
    """So many bytes. until: of the monotonic clock."""
    contents = bytearray()
    while len(contents) < size:
        left = None if until is None else until - time.monotonic()
        if left is not None and left <= 0:
            raise TimeoutError
        end.settimeout(left)
        part = end.recv(min(size - len(contents), 1 << 20))
        if not part:
            raise EOFError
        contents += part
    return bytes(contents)


SERVING: list[Path] = []
"""The file whose functions this process has, where it is the other one."""
LIMITS = {resource.RLIMIT_DATA: os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2, resource.RLIMIT_CORE: 0}
"""Of memory half of what the machine has: beyond it there is a MemoryError, and the system ends nothing else."""
MUTE = 117
"""Exit status of a process that cannot answer, since a function has closed its files."""


class OthersError(ValueError):
    """A file cannot be judged, in one sentence."""


def serve(handle: int, life: int, begun: float) -> None:
    """Load the file that the command line names, then answer.

    handle: of the channel; life: of a pipe whose other end is closed when the process ends that asks; begun: when the
    first process of this file began.
    """
    channel, path, process = Channel.at(handle), Path(sys.argv[1]), os.getpid()
    SERVING.append(path)
    _end_with(life)
    for kind, most in LIMITS.items():
        with suppress(OSError, ValueError):
            resource.setrlimit(kind, (most, resource.getrlimit(kind)[1]))
    watch_opened(begun)
    with tempfile.TemporaryFile() as printed:
        for stream in (1, 2):
            os.dup2(printed.fileno(), stream)
        place = os.fstat(printed.fileno())
        try:
            offered = loaded(path)
        except OthersError as error:
            loading: object = str(error)
        else:
            loading = [(each.kind, each.name, each.asks, each.options) for each in offered], sources_of(path)
        if os.getpid() != process:
            os._exit(0)
        channel.send(loading)
        with suppress(EOFError):
            while not isinstance(loading, str):
                number, index, arguments, name, values = channel.receive()
                for position, value in enumerate(values):
                    before = len(sys.modules), len(OPENED)
                    reply = called(offered[index], {**arguments, name: value}, path)
                    sources = sources_of(path) if (len(sys.modules), len(OPENED)) != before else ()
                    message = (number, position), reply, _printed(printed, place), sources, has_forked()
                    try:
                        channel.send(message)
                    except OSError:
                        os._exit(MUTE)


def _end_with(life: int) -> None:
    """This process and those that it starts end where the other end of the pipe is closed, as by a kill of the process
    that asks: the system kills them, or where it has no such signal, as on macOS, a thread that waits."""
    if not hasattr(fcntl, "F_SETSIG"):
        end_after(partial(os.read, life, 1))
        return
    with suppress(OSError):
        fcntl.fcntl(life, fcntl.F_SETOWN, -os.getpgrp())
        fcntl.fcntl(life, fcntl.F_SETSIG, signal.SIGKILL)
        fcntl.fcntl(life, fcntl.F_SETFL, fcntl.fcntl(life, fcntl.F_GETFL) | os.O_ASYNC)


def _printed(file: IO[bytes], place: os.stat_result) -> str:
    """What was written into the file since it was empty, the first of it; it is emptied.

    place: of the file, whose descriptor may be another file's where a function has closed it.
    """
    with suppress(Exception):
        sys.stdout.flush()
    try:
        status = os.fstat(file.fileno())
        if not os.path.samestat(status, place) or not status.st_size:
            return ""
        file.seek(0)
        text = file.read(4 * SHOWN)
        file.seek(0)
        file.truncate()
    except OSError:
        return ""
    return text.decode(errors="replace")


def loaded(path: Path) -> list[Offered[..., Any]]:
    """Run the file as a program whose folder can be imported; it is imported under its own name where that is free."""
    sys.path.insert(0, str(path.parent))
    name = path.stem if path.stem not in sys.modules else "_judged"
    loader = SourceFileLoader(name, str(path))
    spec = importlib.util.spec_from_loader(name, loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise OthersError(raised(error, path)) from None
    imported = {id(value) for value in vars(module).values()}
    offered = [each for names, each in DECORATED if names is vars(module) or id(each) in imported]
    if not offered:
        raise OthersError(f"no function has a decorator, which is one of @{', @'.join(KINDS)}")
    names = [each.name for each in offered]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise OthersError(f"two functions are offered as {twice!r}")
    return offered
