"""How a run ends before its time: requests to terminate, which raise an exception, and workers that are lost.

And how its processes end with it, however it ends: kill -9 leaves no time to end them.
"""

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

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
    ours = [number for number, handler in before.items() if handler is signal.SIG_DFL]
    try:
        for number in ours:
            signal.signal(number, _raise_terminated)
        yield
    finally:
        for number in ours:
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
