"""The regions of an acceleration spectrum, found by rule: peak, jump, slope, oscillation, floor and break.

omega: frequencies of a record, evenly spaced from the first [rad/s]; density: A of (14.17) at these.
"""

import math

import numpy as np

from validation.analysis.statistics import FloatArray

OUTSTANDING = 40.0
"""Over the median, what is no noise: of thousands of lines of noise the largest is about ten times the median."""
LOBE, PROMINENT = 3, 5.0
"""Lines from a tone beyond which Hann's window shows nothing of it; a peak is so many times what lies there."""
OCTAVE_PARTS = 12
"""Bands to an octave in which a jump is looked for."""


def peak(omega: FloatArray, hann: FloatArray, below: float) -> float:
    """Frequency of the largest line below some frequency, between the lines of a spectrum with Hann's window [rad/s].

    The lines of a vibration with Hann's window have amplitudes in the ratio r = (1 + e) / (2 - e) where it lies e of a
    line's distance from the largest to its larger neighbour: e = (2 r - 1) / (r + 1). Source: Grandke, IEEE Trans.
    Instrum. Meas. 32 (1983). NaN where it does not stand out of what lies beside it.
    """
    inside = int(np.searchsorted(omega, below))
    if inside < 1:
        return math.nan
    top = int(np.argmax(hann[:inside]))
    beside = np.concatenate([hann[max(top - 2 * LOBE, 0) : max(top - LOBE, 0)], hann[top + LOBE : top + 2 * LOBE]])
    if hann[top] < PROMINENT * np.median(beside):
        return math.nan
    side = 1 if top == 0 or hann[top + 1] > hann[top - 1] else -1
    ratio = math.sqrt(hann[top + side] / hann[top])
    return float(omega[top] + side * omega[0] * (2 * ratio - 1) / (ratio + 1))


def jump(omega: FloatArray, density: FloatArray, above: float, upto: float) -> float:
    """Frequency at which the spectrum rises most steeply between two frequencies [rad/s].

    Where the means of both adjacent twelfths of an octave differ most; then, between the lines there, where it first
    exceeds half of the level behind: a window puts that at the edge of a band.
    """
    edges = above * 2 ** (np.arange(0, math.log2(upto / above), 1 / OCTAVE_PARTS))
    borders = np.searchsorted(omega, edges)
    borders = borders[np.concatenate([[True], np.diff(borders) > 0])]
    means = np.add.reduceat(density, borders)[:-1] / np.diff(borders)
    # over two bands, since the jump may lie within one
    i = int(np.argmax(np.log(means[2:] / means[:-2])))
    level, first = means[i + 2] / 2, borders[i]
    rise = first + int(np.argmax(density[first : borders[i + 3]] > level))
    part = math.log(level / density[rise - 1]) / math.log(density[rise] / density[rise - 1])
    return float(omega[rise - 1] + part * omega[0])


def compensated_band_means(
    omega: FloatArray, density: FloatArray, first: float, last: float, period: float, exponent: float
) -> tuple[FloatArray, FloatArray]:
    """Centres of bands of one period of the oscillation, from first to last, and means of A omega^-exponent."""
    borders = np.searchsorted(omega, np.arange(first, last * (1 + 1e-12), period))
    sums = np.add.reduceat(np.append(density * omega**-exponent, 0.0), borders)[:-1]
    return (omega[borders[:-1]] + omega[borders[1:] - 1]) / 2, sums / np.diff(borders)


def slope(omega: FloatArray, density: FloatArray, first: float, last: float, period: float) -> float:
    """d ln A / d ln omega by least squares over bands of one period of the oscillation [-].

    Of what is left when the slope itself is taken out, since a mean over a steep band lies near its beginning.
    """
    exponent = 0.0
    for _ in range(20):
        centres, means = compensated_band_means(omega, density, first, last, period, exponent)
        exponent += (rest := float(np.polyfit(np.log(centres), np.log(means), 1)[0]))
        if abs(rest) < 1e-9:
            break
    return exponent


def oscillation_period(omega: FloatArray, density: FloatArray, first: float, last: float, least: int) -> float:
    """Period over omega of the oscillation that the spectrum has about a power law [rad/s].

    The Fourier transform of ln A over omega, less its straight line over ln omega, with Hann's window, has a line at
    the time that the wheel takes to pass over its own contact, 2 a / v_0 = 2 pi / period; its place between lines as in
    `peak`. ln sin^2 x = -2 ln 2 - 2 sum_k cos(2 k x) / k: its first harmonic is the largest.
    least: periods to the range, fewer are taken for what is left of the slope. NaN where no line stands out of noise.
    """
    inside = (omega >= first) & (omega <= last)
    log, x = np.log(density[inside]), np.log(omega[inside])
    if x.size // 4 <= least:
        return math.nan
    rest = log - np.polyval(np.polyfit(x, log, 1), x)
    w = np.sin(np.pi * np.arange(x.size) / x.size) ** 2
    line = np.abs(np.fft.rfft(rest * w)) ** 2
    top = least + int(np.argmax(line[least : x.size // 4]))
    if line[top] < OUTSTANDING * np.median(line[least : x.size // 4]):
        return math.nan
    side = 1 if line[top + 1] > line[top - 1] else -1
    ratio = math.sqrt(line[top + side] / line[top])
    turns = top + side * (2 * ratio - 1) / (ratio + 1)
    return float(x.size * omega[0] / turns)


def floor_level(omega: FloatArray, density: FloatArray, first: float, last: float, time_step: float) -> float:
    """B of the floor B (dt / 2)^2 / sin^2(omega dt / 2), B / omega^2 for small steps, over a range [x^2 / s]."""
    inside = (omega >= first) & (omega <= last)
    shape = (2 * np.sin(omega[inside] * time_step / 2) / time_step) ** 2
    return float(np.mean(density[inside] * shape))


def power_level(
    omega: FloatArray, density: FloatArray, first: float, last: float, period: float, exponent: float
) -> float:
    """P of P omega^exponent, the geometric mean over bands of one period of the oscillation."""
    _, means = compensated_band_means(omega, density, first, last, period, exponent)
    return float(np.exp(np.mean(np.log(means))))


def crossing(power: float, exponent: float, floor: float) -> float:
    """Where P omega^exponent meets B omega^-2: the break [rad/s]."""
    return math.pow(power / floor, 1 / (-exponent - 2))
