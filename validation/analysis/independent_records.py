"""How many independent records there are, where some are pieces of the same one."""

import math
from itertools import combinations

import numpy as np

from validation.analysis.statistics import Estimate, FloatArray, student

NEIGHBOURS, FLOOR, TAPER, CHANCE = 51, 1e-11, 0.1, 0.15
"""Waves over which a spectrum is averaged to whiten it; power below this part of the largest is none; share of a record
that is tapered at each end, so that no step leaks; correlation that independent records have by chance at one lag."""


def independent_records(records: FloatArray) -> float:
    """n^2 / sum over pairs of r_ij^2, with r_ij the largest correlation of two whitened records at any lag.

    The variance of a mean of n spectra is that of so many independent ones, since two periodograms correlate as the
    square of what their records share. A record that is shifted, scaled, upside down or backwards is the same.
    records: one a row, two at least.
    """
    count, points = records.shape
    rise = np.minimum((np.arange(points) + 0.5) / (TAPER * points), 1.0)
    taper = np.sin(np.pi / 2 * np.minimum(rise, rise[::-1])) ** 2
    spectra = np.fft.rfft(taper * (records - records.mean(axis=1, keepdims=True)), 2 * points)
    power = np.abs(spectra) ** 2
    kernel = np.full(neighbours := min(NEIGHBOURS, points), 1 / neighbours)
    smooth = np.array([np.convolve(one, kernel, mode="same") for one in power])
    white = np.where(power > FLOOR * power.max(axis=1, keepdims=True), spectra, 0.0)
    white /= np.sqrt(np.maximum(smooth, np.finfo(float).tiny))
    size = np.sqrt((np.abs(white) ** 2).sum(axis=1))
    white /= np.where(size > 0, size, 1.0)[:, np.newaxis]
    total = float(count)
    for one, other in combinations(white, 2):
        # twice as many lags as places: a shift by half a place is one of them
        lags = [np.fft.irfft(one * some, 4 * points) for some in (np.conj(other), other)]
        shared = min(max(float(np.abs(lag).max()) for lag in lags) * 2 * points, 1.0)
        total += 2 * shared**2 if shared > CHANCE else 0.0
    return float(count**2 / total)


def half_width(estimate: Estimate, records: float, among: int = 1) -> float:
    """Half of the 95 % interval of a mean over n records of which so many are independent; infinite for one record.

    Equal records hide their scatter: sum (x - mean)^2 / n is on average the variance times 1 - 1 / records, and the
    variance of the mean is the variance over the records. Student's quantile is that of them; among: how many intervals
    hold together, by Bonferroni.
    """
    count = estimate.samples
    if records >= count:
        return estimate.half_width_among(among)
    if records <= 1 + 1e-9:
        return math.inf
    quantile = student(records - 1, 1 - 0.05 / among)
    return quantile * math.sqrt((count - 1) / (records - 1)) * estimate.error
