"""Threads of this process, which share out independent blocks of work."""

import os
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import lru_cache
from typing import Generic, TypeVar

Block = TypeVar("Block")
Buffers = TypeVar("Buffers")


def cores() -> int:
    """Cores that this process may use."""
    # not every system says which
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Team(Generic[Buffers]):
    """The calling thread and others, each with buffers of its own.

    buffers: those of each thread; where there are no others, no thread is started.
    """

    def __init__(self, buffers: Sequence[Buffers]):
        self._buffers = buffers
        self._others: list[Future[None]] = []

    def share(self, work: Callable[[Buffers, Block], None], blocks: Sequence[Block]) -> None:
        """work(buffers, block) for each block, in any order; returns when all is done.

        After an exception, such as that of Ctrl-C, no further block is begun.
        """
        # an exception may have ended the wait for them
        wait(self._others)
        left, self._others = iter(blocks), []

        def part(buffers: Buffers) -> None:
            for block in left:
                work(buffers, block)

        caller, *others = self._buffers
        try:
            for buffers in others:
                self._others.append(_pool(len(others), os.getpid()).submit(part, buffers))
            part(caller)
        finally:
            deque(left, maxlen=0)
            for other in self._others:
                # one that has not begun has nothing left to do
                other.cancel() or other.result()


@lru_cache
def _pool(threads: int, process: int) -> ThreadPoolExecutor:
    """Threads of a process: after a fork those of its parent are not there."""
    return ThreadPoolExecutor(threads, thread_name_prefix=f"bem3d-{process}")
