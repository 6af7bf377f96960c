"""Heights that somebody else measured: real numbers, known everywhere."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

BY_HAND = "cut out a part that is known, or fill them in from their neighbours"
"""What to do about points without data where nothing here does it."""


def real_numbers(height: ArrayLike) -> FloatArray:
    """Real numbers, NaN where they are masked."""
    try:
        values = np.asarray(height)
    except ValueError:
        raise ValueError("heights must be a regular array of numbers, got rows of different length") from None
    if values.dtype.kind not in "fiu":
        raise TypeError(f"heights must be real numbers, got dtype {values.dtype}")
    numbers = values.astype(np.float64)
    if isinstance(height, np.ma.MaskedArray):
        numbers[np.ma.getmaskarray(height)] = np.nan
    return numbers


def check_not_infinite(values: FloatArray) -> None:
    """Raises ValueError for heights that are infinite."""
    if (infinite := np.isinf(values)).any():
        raise ValueError(
            f"heights must be finite, got {_counted(infinite, 'infinite')}: a point without data is nan, not infinite"
        )


def check_known(values: FloatArray, advice: str = BY_HAND) -> None:
    """Raises ValueError for points without data. advice: the end of the sentence."""
    if (unknown := np.isnan(values)).any():
        found = _counted(unknown, "without data (NaN or masked)")
        raise ValueError(f"heights must be known everywhere, got {found}: {advice}")


def _counted(places: NDArray[np.bool_], what: str) -> str:
    count, first = int(places.sum()), np.argwhere(places)[0].tolist()
    return f"{count} of {places.size} ({100 * count / places.size:.3g} %) {what}, the first at {first}"


def known_heights(height: ArrayLike) -> FloatArray:
    """Real numbers, all of them there. Raises ValueError for masked ones and ones that are not finite, or TypeError."""
    values = real_numbers(height)
    check_not_infinite(values)
    check_known(values)
    return values
