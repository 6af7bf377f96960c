"""Heights that somebody else measured: real numbers, known everywhere."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def real_numbers(height: ArrayLike) -> FloatArray:
    """Real numbers without a mask."""
    if isinstance(height, np.ma.MaskedArray) and np.ma.is_masked(height):
        raise ValueError(_undefined("masked", np.ma.getmaskarray(height)))
    try:
        values = np.asarray(height)
    except ValueError:
        raise ValueError("heights must be a regular array of numbers, got rows of different length") from None
    if values.dtype.kind not in "fiu":
        raise TypeError(f"heights must be real numbers, got dtype {values.dtype}")
    return values.astype(np.float64)


def _undefined(what: str, places: NDArray[np.bool_]) -> str:
    count, first = int(places.sum()), np.argwhere(places)[0].tolist()
    return (
        f"heights must be known everywhere, got {count} of {places.size} ({100 * count / places.size:.3g} %) {what}, "
        f"the first at {first}: cut out a part that is known, or fill them in from their neighbours"
    )


def known_heights(height: ArrayLike) -> FloatArray:
    """Real numbers, all of them there. Raises ValueError for masked ones and ones that are not finite, or TypeError."""
    values = real_numbers(height)
    if not np.isfinite(values).all():
        raise ValueError(_undefined("not finite", ~np.isfinite(values)))
    return values
