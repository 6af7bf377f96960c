"""Solves that end as no solve should: apart from the tests, so that their workers import little."""

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from validation.benchmarks.isolation import isolated_process


@dataclass(frozen=True)
class Job:
    number: int
    folder: str


def die_at_once(job):
    """The first ends well, the others as the system ends a process that wants too much memory."""
    if job.number > 0:
        while not list(Path(job.folder).rglob("*.npz")):
            time.sleep(0.02)
        os.kill(os.getpid(), signal.SIGKILL)
    return {"value": np.ones(1)}


def stay(job):
    """Says which process it is, and never ends, but the first."""
    if job.number > 0:
        (Path(job.folder) / f"{os.getpid()}.pid").touch()
        time.sleep(600)
    return {"value": np.ones(1)}


def stay_alone(job):
    """In a process of its own, as what is timed."""
    with isolated_process() as lane:
        return lane.submit(stay, job).result()


def lose_alone(job):
    with isolated_process() as lane:
        return lane.submit(os._exit, 1).result()
