"""Numbers at the points of a range as one number: the worst point, or the root mean square. No mean hides a sign."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from validation.analysis.evidence import Number, Verdict


def worst(points: Sequence[Number]) -> Number:
    """The point whose verdict is that of the whole range: differ if one differs, agree only if all agree.

    points: of one quantity and one model, one at least. That all intervals hold at once is up to the points: see
    `Estimate.half_width_among`.
    """
    differing = [point for point in points if point.verdict is Verdict.DIFFER]
    side = -1 if differing else 1
    return max(differing or points, key=lambda p: abs(p.difference) + side * p.uncertainty - p.tolerance)


def root_mean_square(points: Sequence[Number], tolerance: float, reason: str) -> Number:
    """sqrt(mean (value - reference)^2) over the points, one at least, beside zero.

    Its half-widths are the root mean squares of theirs: by the triangle inequality no less than the interval has,
    however the errors of the points depend on each other.
    """

    def rms(name: str) -> float:
        return math.sqrt(np.mean([getattr(point, name) ** 2 for point in points]))

    return replace(
        points[0],
        quantity=f"rms of {points[0].quantity}",
        value=rms("difference"),
        reference=0.0,
        tolerance=tolerance,
        reason=reason,
        grid=rms("grid"),
        sample=rms("sample"),
    )
