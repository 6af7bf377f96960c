"""What lasts and is no roughness in measured lines: steps, runs of equal values, clipping, noise of a sensor."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from validation.analysis.statistics import FloatArray
from validation.railway.scenes.line_outliers import (
    AS_HIGH,
    OF_NORMAL,
    PERIODS,
    SHARE,
    STEP_OF_SENSOR,
    STRETCH,
    Outlier,
    interpolated,
    scale_of,
    sensor_step,
)

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
    found = []
    for first, length in zip(starts.tolist(), lengths.tolist(), strict=True):
        value, last = float(line[first]), first + length - 1
        if value in ends:
            found.append(Outlier("clipping", first, last, value))
        elif length >= max(LONG_RUN, OF_USUAL * usual):
            jumps = [abs(line[i] - line[j]) for i, j in ((first, first - 1), (last, last + 1)) if 0 <= j < line.size]
            fine = equal - length / line.size < ROUNDED and length >= OF_USUAL * longest
            jumped = equal >= ROUNDED and max(jumps, default=0.0) > JUMP * usual_step
            if fine or jumped or length >= FAR_LONGER * longest:
                found.append(Outlier("run", first, last, value))
    return tuple(found)


def _clipped_at(line: FloatArray, starts: NDArray[np.intp], lengths: NDArray[np.intp]) -> set[float]:
    """The largest or the smallest value, where many points have it, in runs, and few the next ones."""
    values, counts = np.unique(line, return_counts=True)
    found = set[float]()
    for order in (1, -1):
        value, count = values[::order], counts[::order]
        near = value.size > 4 and abs(value[1] - value[0]) < NEAR_END * abs(value[-1] - value[1])
        runs = lengths[line[starts] == value[0]]
        lasting = 2 * runs[runs >= SHORT_RUN].sum() > count[0]
        if near and lasting and count[0] >= CLIPPED and count[0] > CROWDED * count[1:4].max():
            found.add(float(value[0]))
    return found


def without_steps(line: FloatArray, spacing: float, sensor: float) -> tuple[FloatArray, tuple[Outlier, ...]]:
    """A line without its steps, the part behind each moved, and these, the largest first; at most `MOST_STEPS`.

    sensor: the step to which the line was rounded as it was measured [m].
    """
    found, clean = list[Outlier](), line
    while len(found) < MOST_STEPS:
        one = _largest_step(clean, spacing, sensor) or _hidden_step(clean, spacing, sensor)
        if one is None:
            break
        moved = clean.copy()
        moved[one.last :] -= one.size
        between = np.zeros(line.size, dtype=bool)
        between[one.first + 1 : one.last] = True
        clean = interpolated(moved, between)
        found.append(one)
    return clean, tuple(found)


def _largest_step(line: FloatArray, spacing: float, sensor: float) -> Outlier | None:
    """Of those that last to both sides; its first and last point are the ends of the flank."""
    best, floor, height = None, STEP_OF_SENSOR * sensor, 0.0
    slope = float(np.median(np.diff(line)))
    for apart in (one for one in APART if line.size > 4 * LASTS):
        jump = line[apart:] - line[:-apart] - apart * slope
        around, _ = scale_of(jump, max(round(STRETCH / spacing), PERIODS * apart))
        scale = np.maximum(around, floor)
        for i in np.argsort(-np.abs(jump) / np.maximum(scale, 1e-300))[:LASTS].tolist():
            size = float(jump[i])
            if abs(size) <= STEP * scale[i]:
                break
            before, behind = line[max(0, i - LASTS) : i + 1], line[i + apart : i + apart + LASTS]
            rise = slope * (apart + (before.size + behind.size) / 2 - 1)
            lasts = np.sign(size) * (np.median(behind) - np.median(before) - rise) > OF_STEP * abs(size)
            # the same step over a longer distance is no higher, but for the slope of the line
            if lasts and abs(size) > 1.2 * height:
                best, height = Outlier("step", i, i + apart, size, spread=float(2 * scale[i])), abs(size)
                break
    return best


def _hidden_step(line: FloatArray, spacing: float, sensor: float) -> Outlier | None:
    """One that corrugation hides: it stands out of differences of the means over `MEAN` to both sides of a flank."""
    apart, mean = APART[-1], round(MEAN / spacing)
    if mean <= LASTS or line.size < 4 * (apart + 2 * mean):
        return None
    total = np.cumsum(np.append(0.0, line))
    means = (total[mean:] - total[:-mean]) / mean
    slope = float(np.median(np.diff(line)))
    jump = means[mean + apart - 1 :] - means[: -(mean + apart - 1)] - (mean + apart - 1) * slope
    scale, _ = scale_of(jump, max(round(STRETCH / spacing), PERIODS * mean))
    scale = np.maximum(scale, STEP_OF_SENSOR * sensor)
    i = int(np.argmax(np.abs(jump) / np.maximum(scale, 1e-300)))
    size = float(jump[i])
    if abs(size) <= STEP * scale[i]:
        return None
    # the flank is where most of it rises within the fewest points
    part = line[i : i + 2 * mean + apart] * np.sign(size)
    for apart in APART:
        rise = part[apart:] - part[:-apart]
        if rise.max() >= AS_HIGH * abs(size):
            break
    first = max(i + int(rise.argmax()) - apart // 4, 0)
    return Outlier(
        "step", first, min(first + apart + 2 * (apart // 4), line.size - 1), size, spread=2 * float(scale[i])
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
    if not any(one > ROUGH for one in correlation):
        return []
    return [i for i, one in enumerate(correlation) if one < NOISE / math.sqrt(lines[i].size)]


def _correlation(line: FloatArray) -> float:
    """The largest of points up to so far apart; one of a line that is too short to tell."""
    if line.size < 50 * LAGS:
        return 1.0
    power = np.abs(np.fft.rfft(line - line.mean(), 2 * line.size)) ** 2
    found = np.fft.irfft(power)[: LAGS + 1]
    return float(np.abs(found[1:]).max() / found[0]) if found[0] > 0 else 1.0


def points_of(found: tuple[Outlier, ...], size: int) -> NDArray[np.bool_]:
    """The points of a line that these have."""
    points = np.zeros(size, dtype=bool)
    for one in found:
        points[one.first : one.last + 1] = True
    return points
