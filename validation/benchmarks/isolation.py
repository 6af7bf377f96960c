"""A process with one thread, isolated for what is to be timed, and its time."""

import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from types import TracebackType
from typing import ParamSpec, TypeVar

from validation.engine.termination import end_after

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")
P = ParamSpec("P")
T = TypeVar("T")


class IsolatedProcess(ProcessPoolExecutor):
    """Ended at once where an exception leaves it, since its result is not needed then."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            for process in list((self._processes or {}).values()):
                process.kill()
        super().__exit__(kind, error, trace)


def isolated_process() -> ProcessPoolExecutor:
    """A fresh process, which leaves an interruption to its parent."""
    spawn = multiprocessing.get_context("spawn")
    return IsolatedProcess(1, spawn, _begin)


def _begin() -> None:
    """In the process, before its first call."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None
    end_after(parent.join)


def timed(function: Callable[[], T]) -> tuple[T, float]:
    """Result and seconds."""
    begin = time.perf_counter()
    result = function()
    return result, time.perf_counter() - begin


@contextmanager
def one_thread() -> Iterator[None]:
    """Processes started meanwhile compute with one thread."""
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def alone(function: Callable[P, T], *arguments: P.args, **named: P.kwargs) -> T:
    """The result of a fresh process with one thread."""
    with one_thread(), isolated_process() as worker:
        return worker.submit(function, *arguments, **named).result()
