"""What results have in common: arrays of their own, read-only, and the numbers in the line that each prints."""

from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

from mdr.checks import FloatArray

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


def span(values: float | FloatArray, unit: str) -> str:
    """A number, or the smallest and the largest of an array, with the unit: "499..567 N"."""
    array = np.asarray(values)
    if array.ndim == 0:
        return f"{short(float(array), 4)} {unit}"
    if array.size == 0:
        return "none"
    lowest, highest = short(float(array.min()), 3), short(float(array.max()), 3)
    return f"{lowest} {unit}" if lowest == highest else f"{lowest}..{highest} {unit}"


def line(text: str) -> str:
    """What a result prints, cut from 100 characters on."""
    return text if len(text) < 100 else f"{text[:95]}...{text[-1]}"


def short(value: float, digits: int) -> str:
    """So many digits, and no zeros in the exponent: 1.23e-6."""
    return f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")
