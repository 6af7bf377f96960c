"""Immutable results: they own their arrays, which are read-only."""

from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

Kept = TypeVar("Kept")


class ReadOnlyArrays:
    """For frozen dataclasses: arrays are copied and closed when one is made, copied or unpickled.

    A read-only array is not enough: an older view of it is still writable.
    """

    def __post_init__(self) -> None:
        for name in (field.name for field in fields(self)):  # type: ignore[arg-type]
            object.__setattr__(self, name, kept(getattr(self, name)))

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({name: kept(value) for name, value in state.items()})


def kept(value: Kept) -> Kept:
    """A read-only copy of an array; anything else as it is."""
    if not isinstance(value, np.ndarray):
        return value
    own = np.array(value, order="C")
    own.flags.writeable = False
    return own  # type: ignore[return-value]
