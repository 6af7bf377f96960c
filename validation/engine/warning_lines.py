"""Warnings of Python as one line of a terminal, without the path and the line of code that raised them."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager


def as_one_line(message: Warning | str, *_: object, **__: object) -> str:
    """In place of `warnings.formatwarning`."""
    return f"warning: {' '.join(str(message).split())}\n"


@contextmanager
def one_line_warnings() -> Iterator[None]:
    """In this process, for as long as it lasts."""
    before = warnings.formatwarning
    warnings.formatwarning = as_one_line
    try:
        yield
    finally:
        warnings.formatwarning = before
