"""What a sequence of finer grids tells: the order of an error, and the limit of a first-order sequence."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


def order(cells: Sequence[int], errors: ArrayLike) -> float:
    """Slope of ln |error| against ln of the cell size, by least squares."""
    return float(-np.polynomial.polynomial.polyfit(np.log(cells), np.log(np.abs(errors)), 1)[1])


def first_order_limit(values: NDArray[np.floating]) -> float:
    """Limit of a first-order sequence on doubled grids, from its last two members (Richardson)."""
    return float(2 * values[-1] - values[-2])
