"""What lasts and is no roughness in measured lines: steps, runs of equal values, clipping, noise of a sensor."""

import math
from collections.abc import Sequence
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
FOOT, ABOVE_NOISE, MOST_OF_FOOT = 0.05, 3.0, 0.15
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
        distances = tuple(distance for distance in points if 4 * distance < line.size)
        floor, scales, heights, least = np.full(line.size, STEP_OF_SENSOR * step), [], [], list[float]()
        for distance in distances:
            left, right = (line - side for side in _sides(line, distance))
            height = np.where(left * right > 0, np.sign(left) * np.minimum(np.abs(left), np.abs(right)), 0.0)
            around, overall = scale_of((left + right) / 2, max(round(STRETCH / spacing), PERIODS * distance))
            if distance <= 2:
                around = np.minimum(around, BURST * overall)
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
        foot = max(FOOT * size, min(ABOVE_NOISE * float(self.scales[0, i]), MOST_OF_FOOT * size))
        beyond = np.flatnonzero(over <= foot) + first
        before, behind = beyond[beyond < i], beyond[beyond > i]
        first = int(before[-1]) + 1 if before.size else first
        last = int(behind[0]) - 1 if behind.size else last
        more = (last - first + 1) // 5
        return max(0, min(i, first) - more), min(self.line.size - 1, max(i, last) + more)

    def named(self, measured: FloatArray, first: int, last: int) -> Outlier:
        """The outlier between two points: its largest deviation from the line with its sign [m].

        `margin`: this over the least deviation that is found at its width.
        """
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


STEP = 8.0
"""Of a step over the scale of differences at its distance."""
APART = 1, 2, 4, 8, 16
"""Points over which a step may go."""
MEAN = 0.1
"""Of a line to both sides of a step that corrugation hides [m]: longer than waves of corrugation."""
LASTS, OF_STEP = 20, 0.6
"""Points to both sides whose medians are a step apart, and share of it, at the least."""
MOST_STEPS = 20
LONG_RUN, OF_USUAL, ELEVENTH, FAR_LONGER = 8, 3.0, 11, 10.0
"""Points of a run of equal values, at the least, and over the length of the eleventh longest, since crests have some;
over that, where nothing else tells a run from a crest."""
ROUNDED, JUMP = 0.01, 3.0
"""Share of neighbours that are equal, from which on a line is rounded coarsely; a run that begins or ends with a jump
of so many steps of the sensor, or usual differences of neighbours, is no crest of it, and is compared with the length
of nineteen of twenty runs."""
CLIPPED, CROWDED, SHORT_RUN = 10, 4.0, 3
"""Points at the largest or smallest value, at the least, and over those at each of the next three; of runs that half of
them have."""
NEAR_END = 0.05
"""Of the span of a line: the next value to that at which it is clipped."""
BENDS, DRIFTS = 4, 15.0
"""Degree of a drift, and its rms over that of the rest, at the least. Of 300 clean lines of Hurst exponents up to 1,
with waves as long as the line, the largest is 10; a drift of 15 times changes levels by some tenths of a decibel."""
NOISE, ROUGH, LAGS = 4.0, 0.5, 20
"""Correlation of points up to so far apart, of a line that is noise, at the most, in standard deviations of that of
independent points; of a rough line, at the least."""


def runs_of(line: FloatArray) -> tuple[Outlier, ...]:
    """Runs of equal values, and those at an end of the range at which a line is clipped."""
    starts = np.flatnonzero(np.concatenate([[True], np.diff(line) != 0]))
    lengths = np.diff(np.append(starts, line.size))
    step, ends = sensor_step(line), _clipped_at(line, starts, lengths)
    if starts.size == 1:
        return ()
    usual_step = max(step, float(np.quantile(np.abs(np.diff(line)), SHARE)) / OF_NORMAL)
    equal = 1 - lengths.size / line.size
    usual, longest = float(np.quantile(lengths, 0.95)), float(np.sort(lengths)[-ELEVENTH:][0])
    runs = []
    for first, length in zip(starts.tolist(), lengths.tolist(), strict=True):
        value, last = float(line[first]), first + length - 1
        if value in ends:
            runs.append(Outlier("clipping", first, last, value))
        elif length >= max(LONG_RUN, OF_USUAL * usual):
            jumps = [abs(line[i] - line[j]) for i, j in ((first, first - 1), (last, last + 1)) if 0 <= j < line.size]
            fine = equal - length / line.size < ROUNDED and length >= OF_USUAL * longest
            jumped = equal >= ROUNDED and max(jumps, default=0.0) > JUMP * usual_step
            if fine or jumped or length >= FAR_LONGER * longest:
                runs.append(Outlier("run", first, last, value))
    return tuple(runs)


def _clipped_at(line: FloatArray, starts: NDArray[np.intp], lengths: NDArray[np.intp]) -> set[float]:
    """The largest or the smallest value, where many points have it, in runs, and few the next ones."""
    values, counts = np.unique(line, return_counts=True)
    ends = set[float]()
    for order in (1, -1):
        value, count = values[::order], counts[::order]
        near = value.size > 4 and abs(value[1] - value[0]) < NEAR_END * abs(value[-1] - value[1])
        runs = lengths[line[starts] == value[0]]
        lasting = 2 * runs[runs >= SHORT_RUN].sum() > count[0]
        if near and lasting and count[0] >= CLIPPED and count[0] > CROWDED * count[1:4].max():
            ends.add(float(value[0]))
    return ends


def without_steps(line: FloatArray, spacing: float, sensor: float) -> tuple[FloatArray, tuple[Outlier, ...]]:
    """A line without its steps, the part behind each moved, and these, the largest first; at most `MOST_STEPS`.

    sensor: the step to which the line was rounded as it was measured [m].
    """
    steps, clean = list[Outlier](), line
    while len(steps) < MOST_STEPS:
        step = _largest_step(clean, spacing, sensor) or _hidden_step(clean, spacing, sensor)
        if step is None:
            break
        moved = clean.copy()
        moved[step.last :] -= step.size
        between = np.zeros(line.size, dtype=bool)
        between[step.first + 1 : step.last] = True
        clean = interpolated(moved, between)
        steps.append(step)
    return clean, tuple(steps)


def _largest_step(line: FloatArray, spacing: float, sensor: float) -> Outlier | None:
    """Of those that last to both sides; its first and last point are the ends of the flank."""
    best, floor, height = None, STEP_OF_SENSOR * sensor, 0.0
    slope = float(np.median(np.diff(line)))
    for width in (width for width in APART if line.size > 4 * LASTS):
        jump = line[width:] - line[:-width] - width * slope
        around, _ = scale_of(jump, max(round(STRETCH / spacing), PERIODS * width))
        scale = np.maximum(around, floor)
        for i in np.argsort(-np.abs(jump) / np.maximum(scale, 1e-300))[:LASTS].tolist():
            size = float(jump[i])
            if abs(size) <= STEP * scale[i]:
                break
            before, behind = line[max(0, i - LASTS) : i + 1], line[i + width : i + width + LASTS]
            rise = slope * (width + (before.size + behind.size) / 2 - 1)
            lasts = np.sign(size) * (np.median(behind) - np.median(before) - rise) > OF_STEP * abs(size)
            # the same step over a longer distance is no higher, but for the slope of the line
            if lasts and abs(size) > 1.2 * height:
                best, height = Outlier("step", i, i + width, size, spread=float(2 * scale[i])), abs(size)
                break
    return best


def _hidden_step(line: FloatArray, spacing: float, sensor: float) -> Outlier | None:
    """One that corrugation hides: it stands out of differences of the means over `MEAN` to both sides of a flank."""
    width, mean = APART[-1], round(MEAN / spacing)
    if mean <= LASTS or line.size < 4 * (width + 2 * mean):
        return None
    total = np.cumsum(np.append(0.0, line))
    means = (total[mean:] - total[:-mean]) / mean
    slope = float(np.median(np.diff(line)))
    jump = means[mean + width - 1 :] - means[: -(mean + width - 1)] - (mean + width - 1) * slope
    scale, _ = scale_of(jump, max(round(STRETCH / spacing), PERIODS * mean))
    scale = np.maximum(scale, STEP_OF_SENSOR * sensor)
    i = int(np.argmax(np.abs(jump) / np.maximum(scale, 1e-300)))
    size = float(jump[i])
    if abs(size) <= STEP * scale[i]:
        return None
    # the flank is where most of it rises within the fewest points
    part = line[i : i + 2 * mean + width] * np.sign(size)
    for width in APART:
        rise = part[width:] - part[:-width]
        if rise.max() >= AS_HIGH * abs(size):
            break
    first = max(i + int(rise.argmax()) - width // 4, 0)
    return Outlier(
        "step", first, min(first + width + 2 * (width // 4), line.size - 1), size, spread=2 * float(scale[i])
    )


def drift_of(line: FloatArray) -> tuple[FloatArray, float]:
    """The part of a line that bends as a polynomial of the degree `BENDS` does [m], and its rms over that of the rest.

    The straight line through it is no part: it is subtracted in any case.
    """
    at = np.linspace(-1.0, 1.0, line.size)
    straight = np.polynomial.Polynomial.fit(at, line, 1)(at)
    bend = np.polynomial.Polynomial.fit(at, line, BENDS)(at) - straight
    return np.asarray(bend), float(bend.std() / max(float((line - straight - bend).std()), 1e-300))


def noise_among(lines: Sequence[FloatArray]) -> list[int]:
    """Of lines, the numbers of those that are noise of a sensor without a surface, where others are rough.

    Neighbouring points have nothing in common there.
    """
    correlation = [_correlation(line) for line in lines]
    if not any(value > ROUGH for value in correlation):
        return []
    return [i for i, value in enumerate(correlation) if value < NOISE / math.sqrt(lines[i].size)]


def _correlation(line: FloatArray) -> float:
    """The largest of points up to so far apart; one of a line that is too short to tell."""
    if line.size < 50 * LAGS:
        return 1.0
    power = np.abs(np.fft.rfft(line - line.mean(), 2 * line.size)) ** 2
    autocorrelation = np.fft.irfft(power)[: LAGS + 1]
    return float(np.abs(autocorrelation[1:]).max() / autocorrelation[0]) if autocorrelation[0] > 0 else 1.0


def points_of(outliers: tuple[Outlier, ...], size: int) -> NDArray[np.bool_]:
    """The points of a line that these have."""
    points = np.zeros(size, dtype=bool)
    for outlier in outliers:
        points[outlier.first : outlier.last + 1] = True
    return points
