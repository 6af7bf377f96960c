"""Worker processes of this machine: one queue for all that is at work, first come first served."""

import os
import signal
import threading
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from types import FrameType
from typing import ParamSpec, TypeVar

SIGNALS = (signal.SIGTERM, signal.SIGHUP)
RESUME_NOTE = "finished solves are kept, the same command goes on from there"


POLL = 0.2
"""Seconds between two looks at a parent."""


class WorkerLostError(RuntimeError):
    """A worker process has ended during a solve, so that the run cannot end; finished results are kept."""


class TerminatedError(KeyboardInterrupt):
    """A request to terminate this process; the handlers of control-C end the workers."""


@contextmanager
def terminable() -> Iterator[None]:
    """TerminatedError is raised here at the first request to end; a second one ends the process at once.

    A request that is ignored on purpose stays so (nohup), and outside of the main thread there are none.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in SIGNALS}
    unhandled = [number for number, handler in before.items() if handler is signal.SIG_DFL]
    try:
        for number in unhandled:
            signal.signal(number, _raise_terminated)
        yield
    finally:
        for number in unhandled:
            signal.signal(number, signal.SIG_DFL)


def _raise_terminated(number: int, frame: FrameType | None) -> None:
    for other in SIGNALS:
        if signal.getsignal(other) is _raise_terminated:
            signal.signal(other, signal.SIG_DFL)
    raise TerminatedError(signal.Signals(number).name)


def end_with_parent(parent: int) -> None:
    """This process is killed as soon as its parent, which has this id, has ended; returns at once.

    The children of the process that leads a group are killed with it. On all systems with POSIX processes; not while
    a library holds the lock of the interpreter.
    """

    def parent_has_ended() -> None:
        while os.getppid() == parent:
            time.sleep(POLL)

    end_after(parent_has_ended)


def end_after(waiting: Callable[[], object]) -> None:
    """This process is killed when the call, which waits in a thread, returns."""

    def wait_and_end() -> None:
        waiting()
        if os.getpgrp() == os.getpid():
            os.killpg(os.getpgrp(), signal.SIGKILL)
        os.kill(os.getpid(), signal.SIGKILL)

    threading.Thread(target=wait_and_end, name="end with the parent", daemon=True).start()


def as_one_line(message: Warning | str, *_: object, **__: object) -> str:
    """A warning without its source line, in place of `warnings.formatwarning`."""
    return f"warning: {' '.join(str(message).split())}\n"


@contextmanager
def one_line_warnings() -> Iterator[None]:
    """Warnings of this process take one line each while the block runs."""
    before = warnings.formatwarning
    warnings.formatwarning = as_one_line
    try:
        yield
    finally:
        warnings.formatwarning = before


P = ParamSpec("P")
R = TypeVar("R")

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Of a library in a worker: the workers together have all cores."""
IDLE = 300
"""Seconds after which a worker without work ends; all end with the process that started them."""
STARTING = threading.Lock()
AHEAD = 4
"""Jobs at once: while the last solves of one come to their end, or are evaluated, those of the next are at work."""


class Workers:
    """A number of processes; a context manager, whose exception ends them at once.

    One worker is this process itself. Raises WorkerLostError where one is killed.
    """

    def __init__(self, count: int):
        self.count = count
        self._over = False

    def __enter__(self) -> "Workers":
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if error is not None:
            self.end()
        if isinstance(error, BrokenExecutor):
            raise WorkerLostError(
                "a worker was killed, perhaps by the system for want of memory, which fewer workers need less of; "
                + RESUME_NOTE
            ) from None

    def submit(self, function: Callable[P, R], *arguments: P.args, **keywords: P.kwargs) -> Future[R]:
        """A call on a worker, or here and now where there is one alone; its error is that of the future."""
        if self._over:
            raise CancelledError("the workers have been ended")
        if self.count > 1:
            return self._pool().submit(function, *arguments, **keywords)
        future = Future[R]()
        try:
            future.set_result(function(*arguments, **keywords))
        except Exception as error:
            future.set_exception(error)
        return future

    def ahead(self, jobs: Sequence[Callable[[], R]]) -> Iterator[Future[R]]:
        """The jobs in their order, each as it is done, while the next are already at work in threads.

        Jobs that hand their work to these workers and wait for it; with one worker, one after the other.
        """
        if self.count == 1:
            yield from (self.submit(job) for job in jobs)
            return
        # an exception ends the workers first, so that no thread waits for them
        with ThreadPoolExecutor(AHEAD) as threads, self:
            begun = deque[Future[R]]()
            left = deque(jobs)
            while left or begun:
                while left and len(begun) < AHEAD:
                    begun.append(threads.submit(left.popleft()))
                begun[0].exception()
                yield begun.popleft()

    def end(self) -> None:
        """End all workers at once; nothing is submitted any more, and all that waits has failed."""
        self._over = True
        if self.count > 1:
            from joblib.externals.loky.backend.utils import kill_process_tree

            pool = self._pool()
            # the end of a pool, and in older versions that of a lost worker, stops at a future that was cancelled
            for item in list(pool._pending_work_items.values()):  # type: ignore[attr-defined]
                if item.future.cancelled():
                    item.future = Future()
            for process in list(pool._processes.values()):  # type: ignore[attr-defined]  # an executor of loky
                kill_process_tree(process)
            pool.shutdown(wait=True)

    def _pool(self) -> Executor:
        # two threads that import a package and a part of it at once find it half made
        with STARTING:
            from joblib.externals import loky  # where processes are needed: it takes a tenth of a second

            pool: Executor = loky.get_reusable_executor(
                max_workers=self.count,
                timeout=IDLE,
                env=ONE_THREAD,
                initializer=_begin,
                initargs=(os.getpid(),),
            )
        return pool


def _begin(parent: int) -> None:
    """Prepare a worker before its first call: warnings of one line, and an end with its parent."""
    warnings.formatwarning = as_one_line
    end_with_parent(parent)
