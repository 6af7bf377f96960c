"""Realisations of a rough surface: the random numbers of each, and how many must have converged."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np


def random_generator(seed: int, *key: int) -> np.random.Generator:
    """The random numbers of one realisation, independent of all others and of the process that draws them.

    seed: of the whole run, zero or positive; key: address of the realisation, whole numbers.
    """
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=key)))


FEWEST = 3
"""Converged realisations that an error bar needs."""


class NotConvergedError(RuntimeError):
    """Too little has converged for any evidence; `unconverged` lists what has not."""

    def __init__(self, message: str, unconverged: Sequence[str] = ()):
        super().__init__(message)
        self.unconverged = tuple(unconverged)

    def __reduce__(self) -> tuple[Any, ...]:
        return NotConvergedError, (str(self), self.unconverged)


def require_realisations(**counts: int) -> None:
    """Raise ValueError where a count of realisations, by the name of its setting, is too small for an error bar."""
    for name, count in counts.items():
        if count < FEWEST:
            raise ValueError(f"{name} must be at least {FEWEST}, got {count}")


@contextmanager
def as_not_converged() -> Iterator[None]:
    """Turn the exception of an iteration, known by its `history`, into NotConvergedError, whichever method it is of."""
    try:
        yield
    except Exception as error:
        if hasattr(error, "history"):
            raise NotConvergedError(str(error)) from error
        raise
