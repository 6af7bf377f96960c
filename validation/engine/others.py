"""Functions of others: a file is run as a program in a process of its own, and what it does wrong is said in words."""

import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import dataclass, field
from importlib.machinery import SourceFileLoader
from io import StringIO
from multiprocessing.connection import Connection, Pipe
from pathlib import Path
from typing import IO, Any

from validation.engine.installed import file_of
from validation.engine.offered import DECORATED, KINDS, Caller, Failed, FloatArray, Offered
from validation.engine.read_files import OPENED, digest_of, sources_of, watch_opened
from validation.engine.replies import SHOWN, Reply, called, raised
from validation.engine.termination import end_with_parent
from validation.engine.workers import ONE_THREAD

SECONDS, LOADING = 10.0, 60.0
"""In which a call, and the import of a file, must end."""
LOST = 3
"""After so many calls without an answer a function is not asked any more."""
SERVING: list[Path] = []
"""The file whose functions this process has, where it is the other one."""
ROOT = Path(__file__).parents[2]


class OthersError(ValueError):
    """A file cannot be judged, in one sentence."""


@dataclass
class Called(Caller):
    """An offered function, in this process or by a visitor.

    printed: the first of what it printed; replies: to the last calls; longest: arguments of the slowest answer.
    """

    offered: Offered
    visitor: "Visitor | None" = None
    printed: str = field(default="", init=False, repr=False)
    replies: list[Reply] = field(default_factory=list, init=False, repr=False)
    longest: dict[str, Any] = field(default_factory=dict, init=False, repr=False)
    _seconds: float = field(default=0.0, init=False, repr=False)

    @property
    def warned(self) -> str:
        """The first warning of the last calls."""
        return next((reply.warned for reply in self.replies if reply.warned), "")

    def calls(self, name: str, values: Sequence[Any], arguments: Mapping[str, Any]) -> list[FloatArray | Failed]:
        if self.visitor:
            self.replies, printed = self.visitor.calls(self.offered, name, values, arguments)
        else:
            with redirect_stdout(StringIO()) as text:
                self.replies = [called(self.offered, {**arguments, name: value}) for value in values]
            printed = text.getvalue()
        self.printed = self.printed or " ".join(printed.split())[:SHOWN]
        for value, reply in zip(values, self.replies, strict=True):
            if reply.seconds > self._seconds and not isinstance(reply.value, Failed):
                self._seconds, self.longest = reply.seconds, {**arguments, name: value}
        return [reply.value for reply in self.replies]


class Visitor:
    """A file in a process of its own, which is ended where a call hangs, and started again.

    offered: what it offers, whose functions are not here; sources: the file, and the modules and data that it has had
    from its folder. Raises OthersError where the file is broken or offers nothing, OSError where it cannot be read.
    """

    def __init__(self, path: Path, *, seconds: float = SECONDS):
        if SERVING:
            raise OthersError("a file that is judged must not judge files itself: put that under `if __name__ == ...`")
        self.path, self.seconds, self._lost = path.absolute(), seconds, list[Offered]()
        self.sources: tuple[Path, ...] = ()
        self.path.read_bytes()
        self._start()

    def __enter__(self) -> "Visitor":
        return self

    def __exit__(self, *error: object) -> None:
        self._end()

    def callers(self) -> list[Called]:
        """One of each function."""
        return [Called(one, self) for one in self.offered]

    @property
    def digest(self) -> str:
        """Of the bytes of the file, and of all modules and data that it has from its folder."""
        return digest_of(self.sources)

    def calls(
        self, offered: Offered, name: str, values: Sequence[Any], arguments: Mapping[str, Any]
    ) -> tuple[list[Reply], str]:
        """What it says for each value of one argument, and what was printed."""
        given = {one: arguments[one] for one in offered.asks if one in arguments}
        found: list[Reply] = []
        printed = ""
        while len(found) < len(values):
            if self._lost.count(offered) >= LOST:
                lost = Reply(Failed(f"no answer, {LOST} times: not asked any more", late=True))
                return found + [lost] * (len(values) - len(found)), printed
            if self._process.poll() is not None:
                self._start()
            try:
                self._pipe.send((self.offered.index(offered), given, name, values[len(found) :]))
                for _ in values[len(found) :]:
                    one, text = self._answer()
                    found.append(one)
                    printed = printed or text
            except TimeoutError:
                self._end()
                self._lost.append(offered)
                found.append(Reply(Failed(f"no answer within {self.seconds:g} s", late=True)))
            except (EOFError, OSError):
                self._lost.append(offered)
                found.append(Reply(Failed(f"ended its process{self._how()}")))
        return found, printed

    def _answer(self) -> tuple[Reply, str]:
        if not self._pipe.poll(self.seconds):
            raise TimeoutError
        found, printed, sources = self._pipe.recv()
        self.sources = tuple(sorted({*self.sources, *sources}))
        return found, printed

    def _start(self) -> None:
        self._pipe, theirs = Pipe()
        serving = f"from {__name__} import serve; serve({theirs.fileno()}, {os.getpid()})"
        words = [sys.executable, "-P", "-c", serving, str(self.path)]
        folders = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
        self._process = subprocess.Popen(
            words,
            env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(folders)},
            pass_fds=[theirs.fileno()],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        theirs.close()
        try:
            found = self._pipe.recv() if self._pipe.poll(LOADING) else f"is not read within {LOADING:g} s"
        except (EOFError, OSError):
            found = f"ended its process{self._how()}"
        if isinstance(found, str):
            self._end()
            raise OthersError(f"{self.path.name}: {found}")
        declared, sources = found
        self.sources = tuple(sorted({*self.sources, *sources}))
        if not hasattr(self, "offered"):
            self.offered = [Offered(kind, name, _elsewhere, asks, options) for kind, name, asks, options in declared]

    def _how(self) -> str:
        self._process.wait()
        status = self._process.returncode
        return f" by signal {-status}" if status < 0 else f" with status {status}"

    def _end(self) -> None:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        self._pipe.close()


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


def offered_in(path: Path) -> list[Offered]:
    """What a file offers, in its order. Raises OthersError in one sentence, OSError where it cannot be read."""
    with Visitor(path) as visitor:
        return visitor.offered


def serve(handle: int, parent: int) -> None:
    """The other process: load the file that the command line names, then answer until nobody asks, or can ask."""
    end_with_parent(parent)
    pipe, path = Connection(handle), Path(sys.argv[1])
    SERVING.append(path)
    watch_opened()
    with tempfile.TemporaryFile() as printed:
        for stream in (1, 2):
            os.dup2(printed.fileno(), stream)
        try:
            offered = _loaded(path)
            pipe.send(([(one.kind, one.name, one.asks, one.options) for one in offered], sources_of(path)))
        except OthersError as error:
            pipe.send(str(error))
            return
        with suppress(EOFError):
            while True:
                index, arguments, name, values = pipe.recv()
                for value in values:
                    before = len(sys.modules), len(OPENED)
                    found = called(offered[index], {**arguments, name: value})
                    sources = sources_of(path) if (len(sys.modules), len(OPENED)) != before else ()
                    pipe.send((found, _printed(printed), sources))


def _printed(file: IO[bytes]) -> str:
    """What was written into the file since it was empty, the first of it; it is emptied."""
    sys.stdout.flush()
    if not os.fstat(file.fileno()).st_size:
        return ""
    file.seek(0)
    text = file.read(4 * SHOWN)
    file.seek(0)
    file.truncate()
    return text.decode(errors="replace")


def _loaded(path: Path) -> list[Offered]:
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
    imported = {id(one) for one in vars(module).values()}
    found = [one for names, one in DECORATED if names is vars(module) or id(one) in imported]
    if not found:
        raise OthersError(f"no function has a decorator, which is one of @{', @'.join(KINDS)}")
    names = [one.name for one in found]
    if twice := next((one for one in names if names.count(one) > 1), None):
        raise OthersError(f"two functions are offered as {twice!r}")
    return found
