"""Numbers in the line that a result prints of itself."""

import numpy as np

from bem3d.checks import FloatArray


def span(values: float | FloatArray, unit: str) -> str:
    """A number, or the smallest and the largest of an array, with the unit: "499..567 N"."""
    array = np.asarray(values)
    if array.ndim == 0:
        return f"{short(float(array), 4)} {unit}"
    if array.size == 0:
        return "none"
    lowest, highest = short(float(array.min()), 3), short(float(array.max()), 3)
    return f"{lowest} {unit}" if lowest == highest else f"{lowest}..{highest} {unit}"


def pair(unit: str, along: float, across: float) -> str:
    """One number for both axes where they are equal, or two: "0.5 x 0.3 m"."""
    both = [short(along, 4), short(across, 4)]
    return f"{both[0]} {unit}" if along == across else f"{' x '.join(both)} {unit}"


def short(value: float, digits: int) -> str:
    """So many digits, and no zeros in the exponent: 1.23e-6."""
    return f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")
