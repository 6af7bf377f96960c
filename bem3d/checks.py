"""What is checked where values enter: one clear sentence, or a value that can be trusted."""

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]
BoolArray = NDArray[np.bool_]
Spectrum = Callable[[FloatArray], FloatArray]
Loads = Sequence[float] | FloatArray
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


def fraction(name: str, value: object) -> float:
    """A number strictly between zero and one."""
    number = finite(name, value)
    if not 0 < number < 1:
        raise ValueError(f"{name} must lie between 0 and 1, both excluded, got {number}")
    return number


def count(name: str, value: object, *, least: int = 1) -> int:
    """A whole number of at least ``least``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name} must be a whole number, got {value!r}")
    if value < least:
        raise ValueError(f"{name} must be at least {least}, got {value}")
    return int(value)


def boolean(name: str, value: object) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, got {value!r}")
    return bool(value)


def grid_shape(shape: object) -> tuple[int, int]:
    """Cells along both axes."""
    if not isinstance(shape, (Sequence, np.ndarray)) or isinstance(shape, str) or len(shape) != 2:
        raise ValueError(f"shape must be two whole numbers (nx, ny), got {shape!r}")
    return count("shape[0]", shape[0]), count("shape[1]", shape[1])


def grid_spacing(spacing: object) -> tuple[float, float]:
    """Cell sides (dx, dy) from one number or two."""
    return positive_pair("spacing", spacing, "(dx, dy)")


def positive_pair(name: str, value: object, parts: str) -> tuple[float, float]:
    """Two numbers above zero, from one or two."""
    if not isinstance(value, (Sequence, np.ndarray)) or isinstance(value, str) or np.ndim(value) == 0:
        both = positive(name, value)
        return both, both
    if len(value) != 2:
        raise ValueError(f"{name} must be one number or two {parts}, got {value!r}")
    return positive(f"{name}[0]", value[0]), positive(f"{name}[1]", value[1])


def field(name: str, values: ArrayLike, shape: tuple[int, int]) -> FloatArray:
    """Finite real values on the cells of a grid."""
    given = _real(name, values, f"shape {shape}")
    if given.shape != shape:
        raise ValueError(f"{name} must have shape {shape}, got {given.shape}")
    return _finite(name, given)


def finite_row(name: str, values: ArrayLike, size: int) -> FloatArray:
    """So many finite real values."""
    given = _real(name, values, f"shape ({size},)")
    if given.shape != (size,):
        raise ValueError(f"{name} must have shape ({size},), got shape {given.shape}")
    return _finite(name, given)


def strip(name: str, values: ArrayLike) -> FloatArray:
    """Finite real values on the cells of a grid of any shape."""
    given = _real(name, values, "shape (nx, ny)")
    if given.ndim != 2 or given.size == 0:
        raise ValueError(f"{name} must have shape (nx, ny) with cells along both axes, got shape {given.shape}")
    return _finite(name, given)


def _real(name: str, values: ArrayLike, shape: str) -> np.ndarray:
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise ValueError(
            f"{name} must have a value everywhere, got {int(np.ma.getmaskarray(values).sum())} masked ones"
        )
    try:
        given = np.asarray(values)
    except ValueError:
        raise ValueError(f"{name} must have {shape}, got rows of different length") from None
    if given.dtype.kind not in "fiu":
        raise TypeError(f"{name} must hold real numbers, got dtype {given.dtype}")
    return given


def _finite(name: str, given: np.ndarray) -> FloatArray:
    array = given.astype(np.float64, copy=False)
    if not np.isfinite(array).all():
        broken = np.count_nonzero(~np.isfinite(array))
        raise ValueError(f"{name} must be finite, got {broken} NaN or infinite values out of {array.size}")
    return array


def callable_spectrum(name: str, value: object) -> Spectrum:
    """A callable C(q), or TypeError; an object that has one by this name is told apart from it."""
    if not callable(value):
        instead = f", give its .{name}" if hasattr(value, name) else ""
        raise TypeError(f"{name} must be a callable {name}(q), got {type(value).__name__}{instead}")
    return value


def density(name: str, values: ArrayLike, shape: tuple[int, ...]) -> FloatArray:
    """Values of a power spectral density: one a wavenumber, finite, nowhere negative."""
    array = np.asarray(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"{name} must return one value a wavenumber, got shape {array.shape} for {shape}")
    if not (np.isfinite(array) & (array >= 0)).all():
        raise ValueError(f"{name} must be finite and nowhere negative, got {array.min()} to {array.max()}")
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
