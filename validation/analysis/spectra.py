"""Power spectra of periodic tracks, their levels in one-third octaves, and how alike two of them are."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


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


@dataclass(frozen=True)
class Bands:
    """One-third octaves: edges (number of bands + 1,), each 2^(1/3) times the last."""

    edges: tuple[float, ...]

    @classmethod
    def around(cls, centre: float, first: float, last: float) -> "Bands":
        """All that lie between two wavenumbers, one of them with this centre."""
        low = math.ceil(3 * math.log2(first / centre) + 0.5 - 1e-9)
        high = math.floor(3 * math.log2(last / centre) - 0.5 + 1e-9)
        return cls(tuple(centre * 2 ** ((i - 0.5) / 3) for i in range(low, high + 2)))

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
        """How many of the wavenumbers lie in each."""
        return self.sums(q, np.ones(q.size)).real


def levels(found: Waves, bands: Bands) -> FloatArray:
    """int C dq over each band, of positive wavenumbers; bands along the last axis."""
    return bands.sums(found.q, np.abs(found.amplitude) ** 2).real


def cross_levels(found: Waves, other: Waves, bands: Bands) -> ComplexArray:
    """sum of c conj(c') over each band: with both `levels`, all that the coherence takes."""
    return bands.sums(found.q, found.amplitude * np.conj(other.amplitude))
