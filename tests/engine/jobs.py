"""Solves that end as no solve should: apart from the tests, so that their workers import little."""

import fcntl
import os
import signal
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from validation.benchmarks.timing import isolated_process


@dataclass(frozen=True)
class Job:
    number: int
    folder: str


def case_of(solve, folder):
    """A case that is nothing but these solves."""
    # not in workers, which have no need of it
    from validation.report.contents import CASES

    def run(case, engine):
        return engine.map(solve, [Job(i, str(folder)) for i in range(3)])

    return replace(CASES["hertz"], run=run)


def die_at_once(job):
    """The first ends well, the others as the system ends a process that wants too much memory."""
    if job.number > 0:
        while not list(Path(job.folder).rglob("*.npz")):
            time.sleep(0.02)
        os.kill(os.getpid(), signal.SIGKILL)
    return {"value": np.ones(1)}


def live_in(folder):
    """A file of this process, locked from when it is there to the end of the process, however that comes."""
    begun = Path(folder) / f"{os.getpid()}.begun"
    fcntl.flock(os.open(begun, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC), fcntl.LOCK_EX)
    begun.rename(begun.with_suffix(".pid"))


def alive_in(folder):
    """The processes that have a file there and have not ended; one that has and is not waited for counts as ended."""
    found = []
    for path in Path(folder).glob("*.pid"):
        handle = os.open(path, os.O_RDWR | os.O_CLOEXEC)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            found.append(int(path.stem))
        finally:
            os.close(handle)
    return found


def stay(job):
    """Says which process it is, and never ends, but the first."""
    if job.number > 0:
        live_in(job.folder)
        time.sleep(600)
    return {"value": np.ones(1)}


def stay_alone(job):
    """In a process of its own, as what is timed."""
    with isolated_process() as lane:
        return lane.submit(stay, job).result()


def lose_alone(job):
    with isolated_process() as lane:
        return lane.submit(os._exit, 1).result()
