"""Objects between two processes: each whole, behind a token that nothing else writes, and within a time."""

import os
import pickle
import secrets
import socket
import struct
import time
from typing import Any

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
