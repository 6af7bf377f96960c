"""Threads of this process, which share out independent blocks of work."""

import os
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import lru_cache
from typing import TypeVar

Block = TypeVar("Block")
Buffers = TypeVar("Buffers")


def cores() -> int:
    """Cores that this process may use."""
    # not every system says which
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def share(work: Callable[[Buffers, Block], None], blocks: Sequence[Block], buffers: Sequence[Buffers]) -> None:
    """work(buffers, block) for each block, in any order; returns when all is done.

    buffers: those of each thread, the caller's first; where there are no others, no thread is started.
    After an exception in one of them, such as that of Ctrl-C, no further block is begun.
    """
    left = iter(blocks)

    def part(own: Buffers) -> None:
        try:
            for block in left:
                work(own, block)
        finally:
            deque(left, maxlen=0)

    caller, *more = buffers
    others: list[Future[None]] = []
    try:
        for own in more:
            others.append(_pool(len(more), os.getpid()).submit(part, own))
        part(caller)
        for other in others:
            # one that has not begun has nothing left to do
            other.cancel() or other.result()
    finally:
        wait([other for other in others if not other.cancel()])


@lru_cache
def _pool(threads: int, process: int) -> ThreadPoolExecutor:
    """Threads of a process: after a fork those of its parent are not there."""
    return ThreadPoolExecutor(threads, thread_name_prefix=f"bem3d-{process}")
