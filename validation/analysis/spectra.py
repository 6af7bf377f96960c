"""Power spectra of periodic tracks and of finite records, and their levels in bands, one-third octaves mostly."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.analysis.statistics import FloatArray

ComplexArray = NDArray[np.complex128]
Window = Literal["none", "hann"]

KILOHERTZ = 2 * math.pi * 1000
"""[rad/s], a centre of the usual one-third octaves of time."""


def one_third_octaves(first: float, last: float, centre: float = KILOHERTZ) -> FloatArray:
    """Edges of all bands that lie between two frequencies or wavenumbers, one of them with this centre."""
    low = math.ceil(3 * math.log2(first / centre) + 0.5 - 1e-9)
    high = math.floor(3 * math.log2(last / centre) - 0.5 + 1e-9)
    return np.asarray(centre * 2 ** ((np.arange(low, high + 2) - 0.5) / 3))


@dataclass(frozen=True)
class Bands:
    """One-third octaves of a wavenumber: edges (number of bands + 1,), each 2^(1/3) times the last."""

    edges: tuple[float, ...]

    @classmethod
    def around(cls, centre: float, first: float, last: float) -> "Bands":
        """All that lie between two wavenumbers, one of them with this centre."""
        return cls(tuple(one_third_octaves(first, last, centre).tolist()))

    @property
    def centres(self) -> FloatArray:
        """Geometric means of the edges."""
        edges = np.array(self.edges)
        return np.asarray(np.sqrt(edges[1:] * edges[:-1]))

    def on(self, length: float) -> "Bands":
        """These, if a track of that length has a wave in each; ValueError otherwise."""
        waves = 2 * np.pi / length * np.arange(1, int(self.edges[-1] * length / (2 * np.pi)) + 1)
        if (self.counts(waves) == 0).any():
            raise ValueError(f"length must be so large that each band has a wave, got {length:g} for {self.edges}")
        return self

    def sums(
        self, q: NDArray[np.floating], values: NDArray[np.floating | np.complexfloating]
    ) -> NDArray[np.complex128]:
        """Of the values, along the last axis, at the wavenumbers in each band."""
        inside = (q[:, np.newaxis] >= self.edges[:-1]) & (q[:, np.newaxis] < self.edges[1:])
        return np.asarray(values @ inside.astype(np.float64))

    def counts(self, q: NDArray[np.floating]) -> FloatArray:
        return self.sums(q, np.ones(q.size)).real


@dataclass(frozen=True, eq=False)
class Waves:
    """The waves of a periodic series above zero: wavenumber q [rad/m], and complex amplitudes c(q).

    x_j = sum_q c(q) exp(i q x_j) over positive and negative q, so that <x^2> - <x>^2 = 2 sum_{q > 0} |c|^2.
    The last wave of an even number of points is left out: it has no phase.
    """

    q: FloatArray
    amplitude: ComplexArray

    @property
    def spectrum(self) -> FloatArray:
        """C(q) = |c|^2 / dq, two-sided: <x^2> = int_{-inf}^{inf} C dq."""
        return np.asarray(np.abs(self.amplitude) ** 2 / self.q[0])


def waves(series: ArrayLike, *, spacing: float) -> Waves:
    """Of a series, or of several along the last axis, that are periodic and need no window."""
    x = np.asarray(series, dtype=np.float64)
    points = x.shape[-1]
    last = (points - 1) // 2
    q = 2 * np.pi / (points * spacing) * np.arange(1, last + 1)
    return Waves(q, np.fft.rfft(x, norm="forward")[..., 1 : last + 1])


def levels(found: Waves, bands: Bands) -> FloatArray:
    """int C dq over each band, of positive wavenumbers; bands along the last axis."""
    return bands.sums(found.q, np.abs(found.amplitude) ** 2).real


@dataclass(frozen=True, eq=False)
class RecordSpectra:
    """Spectra of finite records: omega, shape (frequencies,) [rad/s]; density: A, (frequencies, records) [x^2 s].

    Two-sided over f: <x^2> = sum A / T over positive and negative frequencies, (14.17).
    """

    omega: FloatArray
    density: FloatArray


def record_spectra(series: ArrayLike, *, time_step: float, window: Window = "none") -> RecordSpectra:
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
    return RecordSpectra(omega, density)


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
