"""The springs along a periodic track, the wheel above them, and which it may touch over a block of positions."""

import math

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, finite_array, positive, stiffness_of_springs
from mdr.diagnostics import SpringContactWarning, diagnose_units, diagnose_wheel

MOST_SPRINGS = 2**28
"""To each side of a wheel: more would take gigabytes and hours."""


class SpringTrack:
    """Heights of the springs along the track, and the wheel."""

    def __init__(self, height: ArrayLike, spacing: float, radius: float, modulus: float):
        self.height = finite_array("height", height, ndim=1)
        self.spacing, self.radius = positive("spacing", spacing), positive("radius", radius)
        self.modulus = positive("modulus", modulus)
        self.spring = stiffness_of_springs("spacing", self.modulus, self.spacing)
        self._profile = np.empty(0)

    @property
    def points(self) -> int:
        """Springs of the track."""
        return self.height.size

    def diagnose(self, approach: float) -> tuple[SpringContactWarning, ...]:
        """Diagnostics of the contact of the smooth wheel."""
        if not approach > 0:
            return ()
        units = diagnose_units(approach=approach, radius=self.radius)
        return (*diagnose_wheel(2 * math.sqrt(self.radius * approach) / self.spacing), *units)

    def longer_than(self, contact: float) -> None:
        """Refuse a track that the wheel covers as a whole."""
        length = self.height.size * self.spacing
        if length <= contact:
            raise ValueError(f"height must be longer than the contact, {contact:.6g} m, got a track of {length:.6g} m")

    def wheel(self, j: int | FloatArray) -> float | FloatArray:
        """x^2 / R of the wheel, j springs from its middle."""
        return (j * self.spacing) ** 2 / self.radius

    def profile(self, reach: int) -> FloatArray:
        """`wheel` of 0, 1 .. reach, kept; each by itself, since an array is not squared to the same last digit."""
        if self._profile.size <= reach:
            more = range(self._profile.size, max(reach + 1, 2 * self._profile.size))
            self._profile = np.concatenate([self._profile, [self.wheel(j) for j in more]])
        return self._profile

    def distance(self, level: float) -> float:
        """Springs to each side, and parts of one, at which the wheel's profile is so high."""
        return math.sqrt(max(level, 0.0)) * math.sqrt(self.radius) / self.spacing

    def reach(self, level: float) -> int:
        """Springs to each side at which the wheel's profile stays below a level; -1 where nowhere."""
        if level <= 0:
            return -1
        about = self.distance(level)
        if not about < MOST_SPRINGS:
            raise ValueError(
                f"spacing must be larger, or height, radius and load smaller: the wheel overlaps heights to "
                f"{about:.3g} springs on each side, more than {MOST_SPRINGS}"
            )
        j = int(about)
        # by the profile as it is rounded, not by its root
        while self.wheel(j) >= level:
            j -= 1
        while self.wheel(j + 1) < level:
            j += 1
        return j


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
