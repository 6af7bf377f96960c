"""Threads of this process, which share out independent blocks of work."""

import os
from collections import deque
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from functools import lru_cache
from time import sleep
from typing import TypeVar

Block = TypeVar("Block")
Buffers = TypeVar("Buffers")
POLL = 1e-3
"""Seconds between two looks at threads whose blocks are to end."""


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
    # known by themselves and not by their futures, which an interrupt of their start would lose
    at_work: set[int] = set()

    def part(own: Buffers) -> None:
        try:
            for block in left:
                work(own, block)
        finally:
            deque(left, maxlen=0)

    def part_of_another_thread(number: int) -> None:
        at_work.add(number)
        try:
            part(buffers[number])
        finally:
            at_work.remove(number)

    others: list[Future[None]] = []
    try:
        for number in range(1, len(buffers)):
            others.append(_pool(len(buffers) - 1, os.getpid()).submit(part_of_another_thread, number))
        part(buffers[0])
        for other in others:
            # one that has not begun has nothing left to do
            other.cancel() or other.result()
    finally:
        _wait(left, at_work)


def _wait(left: Iterator[Block], at_work: Collection[int]) -> None:
    """Returns when no block is left and no thread is at work; raises then what interrupted it, the first of several."""
    interrupt: BaseException | None = None
    over = False
    while not over:
        try:
            deque(left, maxlen=0)
            # after an exception alone, and without a lock, which an interrupt could leave taken
            while at_work:
                sleep(POLL)
            over = True
        except BaseException as error:
            interrupt = interrupt or error
    if interrupt:
        raise interrupt


@lru_cache
def _pool(threads: int, process: int) -> ThreadPoolExecutor:
    """Threads of a process: after a fork those of its parent are not there."""
    return ThreadPoolExecutor(threads, thread_name_prefix=f"bem3d-{process}")
