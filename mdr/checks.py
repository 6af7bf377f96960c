"""What is checked where values enter: one clear sentence, or a value that can be trusted."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Numbers = NDArray[Any] | Sequence[Any]
"""Several numbers, in any shape; one number is a float."""
Spectrum = Callable[[FloatArray], FloatArray]
OneOrTwo = float | tuple[float, float]
"""One number for both axes, or two."""


def finite(name: str, value: object) -> float:
    """A finite real number, or TypeError / ValueError."""
    if isinstance(value, (bool, str, bytes)):
        raise TypeError(f"{name} must be a real number, got {value!r}")
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a real number, got {value!r}") from None
    if not math.isfinite(number):
        raise ValueError(f"{name} must be finite, got {number}")
    return number


def positive(name: str, value: object) -> float:
    """A finite number above zero."""
    number = finite(name, value)
    if number <= 0:
        raise ValueError(f"{name} must be positive, got {number}")
    return number


def not_negative(name: str, value: object) -> float:
    """A finite number, zero allowed."""
    number = finite(name, value)
    if number < 0:
        raise ValueError(f"{name} must be zero or positive, got {number}")
    return number


def count(name: str, value: object, *, least: int) -> int:
    """A whole number of at least ``least``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name} must be a whole number, got {value!r}")
    if value < least:
        raise ValueError(f"{name} must be at least {least}, got {value}")
    return int(value)


def finite_array(name: str, values: ArrayLike, *, ndim: int | None = None, copy: bool = True) -> FloatArray:
    """Finite real numbers, of ``ndim`` axes and not empty where ``ndim`` is given; a copy, unless only read."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise ValueError(
            f"{name} must have a value everywhere, got {int(np.ma.getmaskarray(values).sum())} masked ones"
        )
    try:
        given = np.asarray(values)
    except ValueError:
        raise ValueError(f"{name} must be a regular array of numbers, got rows of different length") from None
    if given.dtype.kind not in "fiu":
        raise TypeError(f"{name} must hold real numbers, got dtype {given.dtype}")
    array = given.astype(np.float64, copy=copy)
    if ndim is not None and (array.ndim != ndim or array.size == 0):
        raise ValueError(f"{name} must have {ndim} axis and at least one value, got shape {array.shape}")
    broken = np.count_nonzero(~np.isfinite(array))
    if broken:
        raise ValueError(f"{name} must be finite, got {broken} NaN or infinite values out of {array.size}")
    return array


def number_or_array(values: FloatArray) -> float | FloatArray:
    """A float where there is no axis, as for one wavenumber, else the array."""
    return values if np.ndim(values) else float(values)


@contextmanager
def doubles(**given: object) -> Iterator[None]:
    """Arithmetic whose results must be numbers, see `held`; ValueError with what was given where they are not."""
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            yield
    except (OverflowError, ZeroDivisionError):
        known = {name: value for name, value in given.items() if value is not None}
        names, values = list(known), [_printed(value) for value in known.values()]
        raise ValueError(
            f"{_listed(names)} must give numbers that a double can hold, got {_listed(values)}: are the units right?"
        ) from None


def held(*results: float | FloatArray, positive: bool = False) -> None:
    """OverflowError where a result is no finite number, or where what must be positive has become zero."""
    for result in results:
        if not np.isfinite(result).all() or (positive and not np.all(np.asarray(result) > 0)):
            raise OverflowError


def _printed(value: object) -> str:
    if np.ndim(value) > 0:  # type: ignore[arg-type]
        return f"values up to {np.abs(np.asarray(value)).max():g}"
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)


def _listed(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def stiffness_of_springs(name: str, modulus: float, length: float, springs: int = 1) -> float:
    """E* dx of so many springs on a length, a number above zero, or ValueError."""
    stiffness = modulus * length / springs
    if not (math.isfinite(stiffness) and stiffness > 0):
        raise ValueError(f"modulus and {name} must give a finite stiffness, got {modulus} and {length}")
    return stiffness


def callable_spectrum(name: str, value: object) -> Spectrum:
    """A callable C(q), or TypeError; an object that has one by this name is told apart from it."""
    if not callable(value):
        instead = f", give its .{name}" if hasattr(value, name) else ""
        raise TypeError(f"{name} must be a callable {name}(q), got {type(value).__name__}{instead}")
    return value


def density(name: str, values: ArrayLike) -> FloatArray:
    """Values of a power spectral density: finite and nowhere negative."""
    array = finite_array(name, values)
    if (array < 0).any():
        raise ValueError(f"{name} must be nowhere negative, got {array.min()}")
    return array


def fits(name: str, value: object, needed: int) -> None:
    """MemoryError naming the argument that asks for so many bytes, where the machine does not give them."""
    try:
        # asked for and not touched, which takes no time
        np.empty(needed, dtype=np.uint8)
    except (MemoryError, ValueError):
        raise MemoryError(
            f"{name} must be smaller: {value} needs about {needed / 1e9:.3g} GB of memory, more than there is"
        ) from None
