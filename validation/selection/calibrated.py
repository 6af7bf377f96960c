"""Where the errors that models claim were measured: outside of it a model is out of range."""

import math
from collections.abc import Mapping

Conditions = Mapping[str, float]
Ranges = Mapping[str, tuple[float, float]]

SLACK = 1e-9
"""By which a scene may lie beyond an end, relative: the rounding of its units."""


def outside(conditions: Conditions, ranges: Ranges) -> str:
    """The first condition beyond the range in which the error was measured, in words; empty where none is.

    A range that a scene has no condition for, as the Hurst exponent of measured heights, says nothing of it.
    """
    for name, (low, high) in ranges.items():
        value = conditions.get(name, low)
        if not low * (1 - SLACK) <= value <= high * (1 + SLACK):
            span = f"from {low:g} on" if math.isinf(high) else f"from {low:g} to {high:g}"
            return f"{name} = {value:.3g}, its error was measured {span} alone"
    return ""
