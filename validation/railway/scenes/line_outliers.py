"""Spikes, pits and dropouts of a measured line: points that stand out of both sides far more than the line itself does.

EN 15610 removes narrow upward spikes, which are dirt, by straight lines (7.2), and has a wheel of R = 0.375 m roll over
pits (7.3): both concern what is narrower than that wheel, h > w^2 / (8 R) = w^2 / 3 m for a height h and a width w. Its
curvature of 10 um/mm^2 is that of a smooth rail sampled at 1 mm. Here the scale is that of the line itself, so that the
roughness of a rough rail is no spike, and a spike of 10 um of a smooth rail is one.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import FloatArray

STANDS_OUT = 6.5
"""Prominence of an outlier over the scale of the line. The largest of 420 clean lines of 15000 points is 5.1: smooth,
rough, corrugated, of Hurst exponents 0.3 to 1, as they are and rounded to 0.1 and 1 um."""
WIDE, OF_WIDE = 12e-3, 0.85
"""Distance [m] beyond which so much of that stands out: a line of 50 m has some 1e4 such places, and normal heights are
as far out with a probability of 4e-8 each."""
DISTANCES = 1e-3 * np.array([1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96])
"""To both sides [m]: wider than the last is a wave, and no outlier."""
STRETCH, PERIODS = 0.3, 30
"""Of a line that has one scale: metres, and distances, at the least."""
SHARE, OF_NORMAL = 0.6, 0.8416
"""Of the deviations that are smaller than the scale, and this in standard deviations of normal ones: outliers in less
than a third of a stretch change it little."""
BURST = 10.0
"""Scale of neighbouring points in one stretch over that of the line, at the most: beyond, the sensor is at fault."""
STEP_OF_SENSOR = 0.45
"""Scale of a line that is rounded, over the step to which it is: two of them are no outlier."""
FOOT, NOISE, MOST_OF_FOOT = 0.05, 3.0, 0.15
"""Height at which an outlier ends, over its own; over the scale of neighbouring points; over its own, at the most."""
AS_HIGH = 0.85
"""Of its largest prominence: the smallest distance that has so much of it is taken for its extent."""
ROUNDS = 40
"""Searches of a line, at the most."""
FEWEST = 40
"""Points of a line, below which nothing stands out of it."""


@dataclass(frozen=True)
class Outlier:
    """Of a line: the kind, the first and the last of its points, its height [m], and that over what is just found.

    kind: "spike", "pit", "dropout", "run", "clipping" or "step"; spread: half-width of 95 % of a step [m].
    """

    kind: str
    first: int
    last: int
    size: float
    margin: float = np.inf
    spread: float = 0.0


def interpolated(line: FloatArray, replaced: NDArray[np.bool_]) -> FloatArray:
    """A line with straight lines in place of some of its points."""
    if replaced.all() or not replaced.any():
        return line
    at = np.arange(line.size)
    return np.asarray(np.interp(at, at[~replaced], line[~replaced]))


def sensor_step(line: FloatArray) -> float:
    """The least difference of two values [m], of those that repeat where most do: that to which a line was rounded."""
    values, counts = np.unique(line, return_counts=True)
    several = counts > 1
    # outliers may be rounded otherwise
    steps = np.diff(values[several] if 2 * counts[several].sum() > line.size else values)
    steps = steps[steps > 1e-9 * float(np.ptp(line))]
    return float(steps.min()) if steps.size else 0.0


def scale_of(values: FloatArray, stretch: int) -> tuple[FloatArray, float]:
    """Robust standard deviation about zero of each point's stretch or that of a neighbour, the larger, and of all."""
    parts = np.array_split(np.abs(values), max(1, values.size // stretch))
    own = np.array([np.quantile(part, SHARE) for part in parts]) / OF_NORMAL
    around = np.maximum(own, np.maximum(np.append(own[0], own[:-1]), np.append(own[1:], own[-1])))
    return np.repeat(around, [part.size for part in parts]), float(np.quantile(np.abs(values), SHARE) / OF_NORMAL)


def without_outliers(line: FloatArray, spacing: float, sensor: float) -> tuple[FloatArray, tuple[Outlier, ...]]:
    """A line [m] with straight lines in place of its spikes and pits, and these, in the order of their places.

    The narrowest are taken out first, since what lies between two of them stands out, too; then the line is searched
    again, until none is left. sensor: the step to which the line was rounded as it was measured [m].
    """
    replaced = np.zeros(line.size, dtype=bool)
    if line.size < FEWEST:
        return line, ()
    clean = line
    for _ in range(ROUNDS):
        prominent = _Prominent.of(clean, spacing, sensor)
        new = np.zeros(line.size, dtype=bool)
        for i in prominent.narrowest():
            if not new[max(0, i - 1) : i + 2].any():
                first, last = prominent.extent(i)
                new[first : last + 1] = True
        if not new.any():
            break
        replaced |= new
        clean = interpolated(line, replaced)
    ends = np.flatnonzero(np.diff(np.concatenate([[0], replaced.astype(np.int8), [0]]))).reshape(-1, 2)
    return clean, tuple(prominent.named(line, first, behind - 1) for first, behind in ends.tolist())


@dataclass(frozen=True, eq=False)
class _Prominent:
    """Of each point of a line: its height over both sides where it stands out, zero elsewhere [m].

    by_distance: the same for each distance; distances: in points; scales: of the line at each of these [m]; least:
    prominence over them of what stands out.
    """

    line: FloatArray
    height: FloatArray
    by_distance: FloatArray
    distances: tuple[int, ...]
    scales: FloatArray
    least: tuple[float, ...]

    @classmethod
    def of(cls, line: FloatArray, spacing: float, step: float) -> "_Prominent":
        points = dict.fromkeys(max(1, round(distance / spacing)) for distance in DISTANCES)
        distances = tuple(one for one in points if 4 * one < line.size)
        floor, scales, heights, least = np.full(line.size, STEP_OF_SENSOR * step), [], [], list[float]()
        for distance in distances:
            left, right = (line - side for side in _sides(line, distance))
            height = np.where(left * right > 0, np.sign(left) * np.minimum(np.abs(left), np.abs(right)), 0.0)
            around, whole = scale_of((left + right) / 2, max(round(STRETCH / spacing), PERIODS * distance))
            if distance <= 2:
                around = np.minimum(around, BURST * whole)
            # a wave as long as the distance is not seen at it, and a longer distance has no smaller scale
            floor = np.maximum(np.maximum(around, floor), 1e-12 * float(np.abs(line).max()))
            scales.append(floor)
            least.append(STANDS_OUT * (OF_WIDE if distance * spacing > WIDE else 1.0))
            heights.append(np.where(np.abs(height) > least[-1] * floor, height, 0.0))
        by_distance = np.array(heights)
        at = np.abs(by_distance).argmax(axis=0)
        return cls(line, by_distance[at, np.arange(line.size)], by_distance, distances, np.array(scales), tuple(least))

    @property
    def distance(self) -> NDArray[np.intp]:
        """The smallest at which a point is about as prominent as it is [points]."""
        high = np.abs(self.by_distance) >= AS_HIGH * np.abs(self.height)
        return np.asarray(np.array(self.distances)[high.argmax(axis=0)])

    def narrowest(self) -> list[int]:
        """Points that stand out over the smallest distance at which any does, or over twice that, the highest first."""
        out = np.flatnonzero(self.height)
        distance = self.distance[out]
        narrow = out[distance <= 2 * distance.min(initial=self.line.size)]
        return narrow[np.argsort(-np.abs(self.height[narrow]))].tolist()  # type: ignore[no-any-return]

    def extent(self, i: int) -> tuple[int, int]:
        """Around a point that stands out: as far as the line is above the chord of both sides, and a fifth more."""
        height, size = float(self.height[i]), abs(float(self.height[i]))
        distance = int(self.distance[i])
        first, last = max(0, i - distance), min(self.line.size - 1, i + distance)
        at = np.arange(first, last + 1)
        over = (self.line[at] - np.interp(at, [first, last], self.line[[first, last]])) * np.sign(height)
        foot = max(FOOT * size, min(NOISE * float(self.scales[0, i]), MOST_OF_FOOT * size))
        beyond = np.flatnonzero(over <= foot) + first
        before, behind = beyond[beyond < i], beyond[beyond > i]
        first = int(before[-1]) + 1 if before.size else first
        last = int(behind[0]) - 1 if behind.size else last
        more = (last - first + 1) // 5
        return max(0, min(i, first) - more), min(self.line.size - 1, max(i, last) + more)

    def named(self, measured: FloatArray, first: int, last: int) -> Outlier:
        """What was replaced of a line, of which this is left: its height, over what is just found of its width."""
        off = (measured - self.line)[first : last + 1]
        size = float(off[np.abs(off).argmax()])
        wide = np.array(self.distances) > (last - first) / 2
        scale = float(self.scales[int(wide.argmax()) if wide.any() else -1, (first + last) // 2])
        least = self.least[int(wide.argmax()) if wide.any() else -1]
        margin = abs(size) / max(least * scale, 1e-300)
        return Outlier("spike" if size > 0 else "pit", first, last, size, margin)


def _sides(line: FloatArray, distance: int) -> tuple[FloatArray, FloatArray]:
    """The points so far before and behind each; beyond an end those of the line turned about it."""
    ends = [line[0], line[-1]]
    if distance > 2:
        # about where an end is expected, which itself may stand out
        ends = [_expected(line[1:7]), _expected(line[-2:-8:-1])]
    first, last = 2 * ends[0] - line[distance:0:-1], 2 * ends[1] - line[-2 : -distance - 2 : -1]
    more = np.concatenate([first, line, last])
    return more[: line.size], more[2 * distance :]


def _expected(following: FloatArray) -> float:
    """Of the point before six others."""
    near, far = float(np.median(following[:3])), float(np.median(following[3:]))
    return near + 2 / 3 * (near - far)
