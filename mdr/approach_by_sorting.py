"""The approach at which springs bear a force, by sorting: each position has a load curve of its own."""

from dataclasses import dataclass

import numpy as np

from mdr.checks import FloatArray
from mdr.spring_track import Near, SpringTrack

MOST_NUMBERS = 2**21
"""Springs times positions that are sorted at once."""
ROUNDING = 16 * float(np.finfo(np.float64).eps)


@dataclass(frozen=True, eq=False)
class Borne:
    """Approach of each position [m], springs in contact, and springs looked at."""

    approach: FloatArray
    pressed: FloatArray
    looked: FloatArray | float


def by_sorting(track: SpringTrack, block: slice, wanted: float, d: float) -> Borne:
    """Approaches at which sum_j max(d - x_j^2 / R + h_j, 0) is as wanted, over a block of positions.

    The springs in contact are the highest n; the next one joins at the force sum_j (z_j - z_{n+1}), z = h - x^2 / R,
    which grows with n. So a sort finds n, and with it the approach: nothing is iterated, and there is nothing to end.
    """
    deepest = _deepest(track, block, wanted, d)
    near = Near(track, block, float(deepest.max()))
    positions = block.stop - block.start
    if near.columns * positions > MOST_NUMBERS and positions > 1:
        middle = block.start + positions // 2
        first = by_sorting(track, slice(block.start, middle), wanted, d)
        second = by_sorting(track, slice(middle, block.stop), wanted, d)
        both = ((first.approach, second.approach), (first.pressed, second.pressed), (first.looked, second.looked))
        return Borne(*(np.concatenate(pair) for pair in both))
    return borne_by(_levels(near), wanted)


def borne_by(levels: FloatArray, wanted: float) -> Borne:
    """The same for springs whose levels h - x^2 / R are given, shape (positions, springs)."""
    positions, springs = levels.shape
    level = -np.sort(-levels, axis=1)
    highest = level[:, :1]
    # a spring so far down never touches: the highest alone would bear the force before
    below = np.minimum(highest - level, 2 * wanted)
    met = np.cumsum(np.arange(1, springs) * np.diff(below, axis=1), axis=1)
    pressed = 1 + np.count_nonzero(met < wanted, axis=1)
    in_contact = np.arange(springs) < pressed[:, np.newaxis]
    overlap = (wanted + np.where(in_contact, below, 0.0).sum(axis=1)) / pressed
    return Borne(overlap - highest[:, 0], pressed.astype(np.float64), np.full(positions, float(springs)))


def _deepest(track: SpringTrack, block: slice, wanted: float, d: float) -> FloatArray:
    """Approaches that are deep enough: as the highest spring would have it alone, or the nearest, all in contact."""
    near = Near(track, block, -float(track.height[block].min()), most=track.points // 2)
    level = _levels(near)
    nearest = min(int(track.distance(d)), near.reach)
    middle = level[:, near.reach - nearest : near.reach + nearest + 1]
    alone, together = wanted - level.max(axis=1), (wanted - middle.sum(axis=1)) / middle.shape[1]
    return np.asarray(np.minimum(alone, together) + ROUNDING * (wanted + np.abs(level[:, near.reach])))


def _levels(near: Near) -> FloatArray:
    """h - x^2 / R of all springs that may touch, shape (positions, columns); neighbours first, in their order."""
    reach, profile = near.reach, near.track.profile(max(near.farthest, 0))
    across = np.abs(np.arange(-reach, reach + 1))
    neighbours = np.lib.stride_tricks.sliding_window_view(near.heights, 2 * reach + 1) - profile[across]
    offsets = near.offsets()
    distance = np.minimum(np.abs(offsets), near.farthest)
    apart = np.where(near.beyond(offsets), near.apart - profile[distance], -np.inf)
    return np.concatenate([neighbours, apart], axis=1)
