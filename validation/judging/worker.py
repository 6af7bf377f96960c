"""Functions of others: a file is run as a program in a process of its own, and what it does wrong is said in words."""

import os
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any

from validation.engine.workers import ONE_THREAD
from validation.judging.registry import KINDS, Caller, Failed, FloatArray, Offered
from validation.judging.replies import SHOWN, Reply, called, has_forked, number
from validation.judging.source_files import digest_of_all, digest_of_bytes, file_of, in_order
from validation.judging.worker_main import MUTE, SERVING, Channel, ForeignBytesError
from validation.judging.worker_main import OthersError as OthersError

SECONDS, LOADING = 10.0, 60.0
"""In which a call, and the import of a file, must end."""
LOST = 3
"""After so many calls without an answer a function is not asked any more."""
ROOT = Path(__file__).parents[2]
MARK = "MDR_VALIDATION_PROCESS"
"""Of the environment of a file's process, and of all that it starts."""


@dataclass
class Called(Caller):
    """An offered function, in this process or by a visitor.

    printed: the first of what it printed; forked: whether a process that it forked came back with an answer, which
    nobody took; replies: to the last calls; longest: arguments of the slowest answer.
    """

    offered: Offered[..., Any]
    visitor: "Visitor | None" = None
    printed: str = field(default="", init=False, repr=False)
    forked: bool = field(default=False, init=False, repr=False)
    replies: list[Reply] = field(default_factory=list, init=False, repr=False)
    longest: dict[str, Any] = field(default_factory=dict, init=False, repr=False)
    _seconds: float = field(default=0.0, init=False, repr=False)

    @property
    def warned(self) -> str:
        """The first warning of the last calls."""
        return next((reply.warned for reply in self.replies if reply.warned), "")

    @property
    def changed(self) -> str:
        """The file, or what it reads, that was changed since it was first run; nothing where none was."""
        return self.visitor.changed if self.visitor else ""

    def calls(self, name: str, values: Sequence[Any], arguments: Mapping[str, Any]) -> list[FloatArray | Failed]:
        if self.visitor:
            self.replies, printed, forked = self.visitor.calls(self.offered, name, values, arguments)
        else:
            with redirect_stdout(StringIO()) as text:
                self.replies = [called(self.offered, {**arguments, name: value}) for value in values]
            printed, forked = text.getvalue(), has_forked()
        self.printed = self.printed or " ".join(printed.split())[:SHOWN]
        self.forked = self.forked or forked
        for value, reply in zip(values, self.replies, strict=True):
            if reply.seconds > self._seconds and not isinstance(reply.value, Failed):
                self._seconds, self.longest = reply.seconds, {**arguments, name: value}
        return [reply.value for reply in self.replies]


class Visitor:
    """A file in a process of its own, which is ended where a call hangs, and started again, also for each function.

    offered: what it offers, whose functions are not here; sources: the file, and the modules and data that it has had
    from its folder. Raises OthersError where the file is broken or offers nothing, OSError where it cannot be read.
    """

    def __init__(self, path: Path, *, seconds: float = SECONDS):
        if SERVING:
            raise OthersError("a file that is judged must not judge files itself: put that under `if __name__ == ...`")
        self.path, self.seconds, self._lost = path.absolute(), seconds, list[Offered[..., Any]]()
        self._digests: dict[Path, bytes] = {}
        self._mark, self._begun, self._asked, self._serves = (
            secrets.token_hex(8),
            time.time(),
            0,
            list[Offered[..., Any]](),
        )
        self.path.read_bytes()
        self.offered = self._start()

    def __enter__(self) -> "Visitor":
        return self

    def __exit__(self, *error: object) -> None:
        self._end()

    def callers(self) -> list[Called]:
        """One of each function."""
        return [Called(each, self) for each in self.offered]

    @property
    def sources(self) -> tuple[Path, ...]:
        return in_order(self._digests)

    @property
    def digest(self) -> str:
        """Of the bytes of the file, and of all modules and data that it has from its folder, as it first had them."""
        return digest_of_all(self._digests[path] for path in self.sources)

    @property
    def changed(self) -> str:
        """The first of these files that is no longer what it was; nothing where all are."""
        return next((path.name for path in self.sources if digest_of_bytes(path) != self._digests[path]), "")

    def calls(
        self, offered: Offered[..., Any], name: str, values: Sequence[Any], arguments: Mapping[str, Any]
    ) -> tuple[list[Reply], str, bool]:
        """What it says for each value of one argument, what was printed, and whether a fork of it came back."""
        passed = {each: arguments[each] for each in offered.asks if each in arguments}
        replies: list[Reply] = []
        printed, forked = "", False
        while len(replies) < len(values):
            left = len(values) - len(replies)
            if self._lost.count(offered) >= LOST:
                lost = Reply(Failed(f"no answer, {LOST} times: not asked any more", late=True))
                return replies + [lost] * left, printed, forked
            try:
                self._serve(offered)
            except OthersError as error:
                return replies + [Reply(Failed(f"cannot be run again: {error}"))] * left, printed, forked
            try:
                self._asked += 1
                request = self._asked, self.offered.index(offered), passed, name, values[len(replies) :]
                self._channel.send(request, self.seconds)
                for position in range(left):
                    reply, text, has_returned = self._answer((self._asked, position))
                    where = {**passed, name: values[len(replies)]}
                    replies.append(
                        _checked(reply, offered, {each: where[each] for each in offered.asks if each in where})
                    )
                    printed, forked = printed or text, forked or has_returned
            except TimeoutError:
                self._end()
                self._lost.append(offered)
                replies.append(Reply(Failed(f"no answer within {self.seconds:g} s", late=True)))
            except (EOFError, OSError) as error:
                self._lost.append(offered)
                replies.append(Reply(Failed(self._how(error))))
        return replies, printed, forked

    def _answer(self, number: tuple[int, int]) -> tuple[Reply, str, bool]:
        """To the call of that number: one to another call is none."""
        until = time.monotonic() + self.seconds
        while True:
            message = self._channel.receive(max(until - time.monotonic(), 0.0))
            if not isinstance(message, tuple) or len(message) != 5:
                raise ForeignBytesError("no reply")
            answers, reply, printed, sources, forked = message
            if answers == number and isinstance(reply, Reply):
                self._note(sources)
                return reply, str(printed), bool(forked)

    def _note(self, sources: Sequence[Path]) -> None:
        for path in sources:
            if path not in self._digests:
                self._digests[path] = digest_of_bytes(path)

    def _serve(self, offered: Offered[..., Any]) -> None:
        """Have a process that has called no other function. Raises OthersError where the file is another one now."""
        if self._process.poll() is None and self._serves in ([], [offered]):
            self._serves = [offered]
            return
        self._end()
        code = (path for path in self.sources if path.suffix == ".py" or path == self.path.resolve())
        if path := next((path for path in code if digest_of_bytes(path) != self._digests[path]), None):
            raise OthersError(f"{path.name} was changed since it was first run")
        again = self._start()
        if [(each.kind, each.name, each.asks) for each in again] != [(o.kind, o.name, o.asks) for o in self.offered]:
            self._end()
            raise OthersError(f"{self.path.name} offers other functions than at first")
        self._serves = [offered]

    def _start(self) -> list[Offered[..., Any]]:
        """A process of the file, and what it offers."""
        self._serves = []
        self._channel, theirs = Channel.pair()
        life, self._life = os.pipe()
        arguments = f"{theirs.fileno()}, {life}, {self._begun!r}"
        words = [sys.executable, "-P", "-c", f"from {SERVE} import serve; serve({arguments})", str(self.path)]
        folders = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
        with theirs:
            self._process = subprocess.Popen(
                words,
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(folders), MARK: self._mark},
                pass_fds=[theirs.fileno(), life],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        os.close(life)
        try:
            message = self._channel.receive(LOADING)
        except TimeoutError:
            message = f"is not read within {LOADING:g} s"
        except (EOFError, OSError) as error:
            message = self._how(error)
        if isinstance(message, str):
            self._end()
            raise OthersError(f"{self.path.name}: {message}")
        declared, sources = message
        self._note(sources)
        return [Offered(kind, name, _elsewhere, asks, options) for kind, name, asks, options in declared]

    def _how(self, error: Exception) -> str:
        """How a process ended that does not answer any more; one that has closed its files is ended."""
        if not isinstance(error, ForeignBytesError):
            with suppress(subprocess.TimeoutExpired):
                status = self._process.wait(self.seconds)
                self._end()
                if status != MUTE:
                    return f"ended its process {f'by signal {-status}' if status < 0 else f'with status {status}'}"
        self._end()
        return "wrote into the files of its process, or closed them, by which it answers"

    def _end(self) -> None:
        """And all that it has started, also what has left its group."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        end_marked(f"{MARK}={self._mark}")
        self._channel.close()
        with suppress(OSError):
            os.close(self._life)
            self._life = -1


SERVE = "validation.judging.worker_main"


def _checked(reply: Reply, offered: Offered[..., Any], arguments: Mapping[str, Any]) -> Reply:
    """With numbers that are as they must be, whatever has become of numpy where they come from."""
    if isinstance(reply.value, Failed):
        return reply
    return reply._replace(value=number(reply.value, KINDS[offered.kind].shapes(arguments)))


def end_marked(mark: str) -> None:
    """End all processes that have this entry in the environment with which they began, where the system lists those."""
    for _ in range(LOST):
        ids = [int(entry.name) for entry in Path("/proc").glob("[0-9]*") if _has_mark(entry, mark)]
        for process in ids:
            with suppress(ProcessLookupError, PermissionError):
                os.kill(process, signal.SIGKILL)
        if not ids:
            return


def _has_mark(entry: Path, mark: str) -> bool:
    try:
        return mark.encode() in (entry / "environ").read_bytes().split(b"\0")
    except OSError:
        return False


def _elsewhere(**_: Any) -> None:
    raise NotImplementedError("the function is in another process")


@contextmanager
def visited(model: object) -> Iterator[list[Called]]:
    """What a file offers, or an installed package under that name, or the one function that is given.

    Raises TypeError for what is neither, OthersError for a file that cannot be judged.
    """
    if isinstance(model, str | Path):
        with file_of(model) as path, Visitor(path) as visitor:
            yield visitor.callers()
    elif isinstance(model, Offered):
        yield [Called(model)]
    else:
        raise TypeError(f"model must be a function with a decorator, as @stiffness_model, or a file, got {model!r}")


def offered_in(path: Path) -> list[Offered[..., Any]]:
    """What a file offers, in its order. Raises OthersError in one sentence, OSError where it cannot be read."""
    with Visitor(path) as visitor:
        return visitor.offered
