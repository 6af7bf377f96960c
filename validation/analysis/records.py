"""(14.17): spectra of accelerations that are recorded for a finite time, with or without a window; their bands."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Window = Literal["none", "hann"]


@dataclass(frozen=True, eq=False)
class Record:
    """Spectra of records: omega, shape (frequencies,) [rad/s]; density: A, shape (frequencies, records) [x^2 s].

    Two-sided over f: <x^2> = sum A / T over positive and negative frequencies, (14.17).
    """

    omega: FloatArray
    density: FloatArray


def spectra(series: ArrayLike, *, time_step: float, window: Window = "none") -> Record:
    """A = |FFT(x)|^2 dt^2 / T, over the mean square of the window.

    series: x, shape (steps, records); window: "none", the rectangle of (14.17), whose side lobes fall as omega^-1 in
    amplitude; "hann", sin^2(pi t / T), whose fall as omega^-3. Frequency zero is left out.
    Source: Popov and Hess, (14.17).
    """
    x = np.asarray(series, dtype=np.float64)
    steps = len(x)
    if window == "hann":
        w = np.sin(np.pi * np.arange(steps) / steps) ** 2
        x = math.sqrt(8 / 3) * w[:, np.newaxis] * x
    density = np.asarray(np.abs(np.fft.rfft(x, axis=0)[1:]) ** 2 * time_step / steps, dtype=np.float64)
    omega = np.asarray(2 * np.pi / (steps * time_step) * np.arange(1, len(density) + 1), dtype=np.float64)
    return Record(omega, density)


def band_levels(omega: FloatArray, density: FloatArray, edges: ArrayLike) -> FloatArray:
    """int A df over each band of positive frequencies, along the first axis of the density; NaN without any."""
    borders = np.searchsorted(omega, np.asarray(edges, dtype=np.float64))
    # each band is summed by itself: of running sums, those far below earlier ones would be lost
    ended = np.concatenate([density, np.zeros((1, *density.shape[1:]))])
    found = np.add.reduceat(ended, borders, axis=0)[:-1] * omega[0] / (2 * np.pi)
    found[borders[1:] == borders[:-1]] = np.nan
    return np.asarray(found)


def band_means(omega: FloatArray, density: FloatArray, edges: ArrayLike) -> FloatArray:
    """The mean of A in each band: its level over its width in f that the frequencies of the record fill."""
    borders = np.searchsorted(omega, np.asarray(edges, dtype=np.float64))
    count = np.maximum(np.diff(borders), 1)
    width = count * omega[0] / (2 * np.pi)
    levels = band_levels(omega, density, edges)
    return np.asarray(levels / width.reshape(-1, *[1] * (levels.ndim - 1)))


def one_third_octaves(first: float, last: float) -> FloatArray:
    """Edges of all bands that lie between two frequencies, one of them with the centre 2 pi 1000 Hz [rad/s]."""
    centre = 2 * math.pi * 1000
    low = math.ceil(3 * math.log2(first / centre) + 0.5 - 1e-9)
    high = math.floor(3 * math.log2(last / centre) - 0.5 + 1e-9)
    return np.asarray(centre * 2 ** ((np.arange(low, high + 2) - 0.5) / 3))
