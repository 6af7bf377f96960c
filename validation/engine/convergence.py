"""NotConvergedError: a solve that has not converged is never a success."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

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
