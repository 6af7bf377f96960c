"""Numbers at the points of a range as one number: the worst point, or the root mean square. No mean hides a sign."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from validation.analysis.evidence import Number, Place, Verdict


def worst(points: Sequence[Number], parameter: str) -> Number:
    """The point whose verdict is that of the whole range: differ if one differs, agree only if all agree.

    points: of one quantity and one model, the parameter in their `where`; parameter: a name there, which becomes the
    range from end to end, with "worst at" beside it. That all intervals hold at once is up to the points: see
    `Estimate.half_width_among`. Raises ValueError without points.
    """
    _refuse_none(points)
    differing = [point for point in points if point.verdict is Verdict.DIFFER]
    point = max(
        differing or points, key=lambda p: abs(p.difference) + (-1 if differing else 1) * p.uncertainty - p.tolerance
    )
    return replace(point, where=_range(points, parameter, point) | {"worst at": point.where[parameter]})


def root_mean_square(points: Sequence[Number], parameter: str, tolerance: float, reason: str) -> Number:
    """sqrt(mean (value - reference)^2) over the points, beside zero.

    Its half-widths are the root mean squares of theirs: by the triangle inequality no less than the interval has,
    however the errors of the points depend on each other. Raises ValueError without points.
    """
    _refuse_none(points)

    def rms(name: str) -> float:
        return math.sqrt(np.mean([getattr(point, name) ** 2 for point in points]))

    return replace(
        points[0],
        quantity=f"rms of {points[0].quantity}",
        where=_range(points, parameter, points[0]),
        value=rms("difference"),
        reference=0.0,
        tolerance=tolerance,
        reason=reason,
        grid=rms("grid"),
        sample=rms("sample"),
    )


def _range(points: Sequence[Number], parameter: str, point: Number) -> dict[str, Place]:
    """The conditions of a point, with the range of all in place of its own parameter."""
    ends = [end for p in points for end in _ends(p.where[parameter])]
    return {**point.where, parameter: (min(ends), max(ends))}


def _ends(place: Place) -> tuple[float, ...]:
    if isinstance(place, str):
        raise ValueError(f"points of a range must have a parameter with values, got {place!r}")
    return place if isinstance(place, tuple) else (place,)


def _refuse_none(points: Sequence[Number]) -> None:
    if not points:
        raise ValueError("points of a range must be one at least, got none")
