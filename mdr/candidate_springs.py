"""Which springs the wheels over a block of positions may touch: all to a distance, and those that stand out beyond."""

import numpy as np

from mdr.checks import FloatArray
from mdr.spring_track import SpringTrack

MAX_WORK_SHARE = 0.5
"""Springs that stand out are looked at by themselves where that leaves so little of the work, or less."""
COST_OF_AN_OUTLIER = 16
"""A spring that stands out costs so many times as much as a neighbour, measured."""
ROUNDING = 4 * float(np.finfo(np.float64).eps)


class Near:
    """Springs that may touch a wheel over a block of positions, none of them lower than a level.

    heights: of the neighbours, `reach` beyond the first and the last position; springs, apart: which springs of the
    unrolled track stand out, and their heights: they may touch from farther away, up to `farthest`, -1 where none can;
    lowest, highest: of all springs so near that the highest of the track could touch there.
    """

    def __init__(self, track: SpringTrack, block: slice, approach: float, *, most: int | None = None):
        """For approaches up to this one; most: springs to each side that count, all by default."""
        self.track, self.block = track, block
        wide = max(track.reach(approach + float(track.height.max())), 0)
        wide = wide if most is None else min(wide, most)
        heights = track.height.take(np.arange(block.start - wide, block.stop + wide), mode="wrap")
        self.lowest, self.highest = float(heights.min()), float(heights.max())
        self.farthest = min(track.reach(approach + self.highest), wide)
        reach, level = self._divided(heights, approach)
        self.reach = max(reach, 0)
        self.heights = heights[wide - self.reach : heights.size - wide + self.reach]
        standing_out = np.flatnonzero(heights > level)
        self.springs, self.apart = standing_out + (block.start - wide), heights[standing_out]

    @property
    def columns(self) -> int:
        """Springs of each position, its own at least."""
        return 2 * self.reach + 1 + int(self.springs.size)

    def _divided(self, heights: FloatArray, approach: float) -> tuple[int, float]:
        """The distance to which all springs are looked at, and the height above which one stands out."""
        most = min(2 * self.farthest // COST_OF_AN_OUTLIER, heights.size)
        if most < 1:
            return self.farthest, self.highest
        highest = np.sort(np.partition(heights, heights.size - most)[heights.size - most :])[::-1]
        track = self.track
        # the square root scales with the level, so that one distance is enough
        unit = track.distance(1.0)
        work = 2 * unit * np.sqrt(np.maximum(approach + highest, 0.0)) + COST_OF_AN_OUTLIER * np.arange(most)
        best = int(work.argmin())
        if work[best] > MAX_WORK_SHARE * 2 * self.farthest:
            return self.farthest, self.highest
        level = float(highest[best])
        beyond_rounding = approach + level + ROUNDING * (abs(approach) + abs(level))
        return min(track.reach(beyond_rounding), self.farthest), level

    def offsets(self) -> np.ndarray:
        """Of the springs that stand out from each position, shape (positions, springs)."""
        return np.asarray(self.springs - np.arange(self.block.start, self.block.stop)[:, np.newaxis])

    def beyond(self, offsets: np.ndarray) -> np.ndarray:
        """Whether they are not among the neighbours, and may touch."""
        distance = np.abs(offsets)
        return np.asarray((distance > self.reach) & (distance <= self.farthest))
