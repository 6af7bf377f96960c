"""Solves that leave a trace."""

import os
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from validation.engine.realisations import random_generator

ROOT = Path(__file__).parents[2]
# workers of their own find this file as the tests do
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}


@dataclass(frozen=True)
class Toy:
    number: int
    log: str


def toy(problem):
    """Leaves a trace each time it is computed."""
    with Path(problem.log).open("a", encoding="utf-8") as file:
        file.write(f"{problem.number}\n")
    return {"value": random_generator(5, problem.number).standard_normal(4)}


def other_toy(problem):
    return toy(problem)


def computed(log):
    return sorted(int(line) for line in Path(log).read_text(encoding="utf-8").split()) if Path(log).exists() else []


def same(outcomes, others):
    return all(np.array_equal(a[k], b[k], equal_nan=True) for a, b in zip(outcomes, others, strict=True) for k in a)


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


@dataclass(frozen=True)
class Slow:
    number: int
    log: str


def slow(problem):
    """Leaves a trace when it is finished."""
    time.sleep(0.2)
    found = toy(Toy(problem.number, problem.log))
    return {"value": found["value"], "failed": np.array(float(problem.number == 3))}


def gated(problem):
    """The later ones wait until they may."""
    wait_until(lambda: problem.number < 6 or Path(f"{problem.log}.go").exists())
    return toy(Toy(problem.number, problem.log))


HANG = 300
"""Seconds after which what has not happened will not happen."""


def wait_until(condition, *alive, over=None):
    """As long as the processes live that bring it about, nobody has called it off, and it is no hang."""
    begin = time.monotonic()
    while not condition() and not (over and over.is_set()):
        assert all(process.poll() is None for process in alive), "it ended before it happened"
        assert time.monotonic() < begin + HANG, "it has not happened"
        time.sleep(0.02)
