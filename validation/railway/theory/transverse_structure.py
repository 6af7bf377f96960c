"""What lies across the track of a rough line: how its waves cross it, and the mean of a filter over them.

A line sees the wave (k_x, k_y) as one of k_x. Of all waves with the same k_x, a contact filter H(k_x, k_y) lets pass
the mean of abs(H)^2, weighted by their power. Wavenumbers in rad/m; filters as in `contact_filters`.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.railway.theory.line_spectrum import LineSpectrum
from validation.theory.closed_forms import positive
from validation.theory.half_space import gauss_legendre, on_panels

FloatArray = NDArray[np.float64]
Filter = Callable[[FloatArray, FloatArray], FloatArray]
"""H(k_x, k_y), even in k_y."""

NODES = 8
"""Of Gauss and Legendre, on a panel across, and on one along."""
GROWTH = 0.4
"""Width of a panel over the wavenumber there, at the most."""
FARTHEST = 16.0
"""Wavenumber across over that of the filter or of the wave, beyond which a filter leaves a part of 3e-4 at the most."""
FAR, FAR_ALONG = 100.0, 400.0
"""Wavenumber times semi-axis, across and along, beyond which a filter oscillates much faster than it falls: of many
periods a few are taken, each for those around it. Bands there are off by less than 0.05 dB, and below -45 dB."""
LEAST_SLOPE = 0.1
"""k_y / k_x over which a filter changes by its shape, about: of an ellipse that is ten times as wide as long."""
POINTS = 48
"""Of the table of C_2D, to a factor 10^0.1."""


class TransverseStructure(ABC):
    """The waves across a track that a line along it sees as one."""

    @abstractmethod
    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        """Mean of abs(H(q, k_y))^2 over the waves of a line's wavenumbers q > 0; the shape of q.

        semi_axis: of the contact across [m], over which the filter oscillates.
        """

    @abstractmethod
    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        """How many waves `mean_square` takes for each wavenumber."""

    def evaluations(self, *, edges: ArrayLike, semi_axes: tuple[float, float]) -> int:
        """How often `band_power` evaluates a filter: it goes with q a_x and q a_y up to 100, and no farther."""
        ends = np.asarray(edges, dtype=np.float64)
        bands = [_along(a, b, semi_axes[0])[0] for a, b in pairwise(ends)]
        return sum(q.size * self.waves_across(q, semi_axis=semi_axes[1]) for q in bands)

    def band_power(
        self, line: LineSpectrum, transfer: Filter, *, edges: ArrayLike, semi_axes: tuple[float, float]
    ) -> FloatArray:
        """int abs(H)^2 C_line dq over int C_line dq in each band between ascending wavenumbers along the track."""
        ends = np.asarray(edges, dtype=np.float64)
        return np.array([self._of_band(line, transfer, a, b, semi_axes) for a, b in pairwise(ends)])

    def _of_band(
        self, line: LineSpectrum, transfer: Filter, first: float, last: float, semi_axes: tuple[float, float]
    ) -> float:
        q, dq = _along(first, last, semi_axes[0])
        power = line(q) * dq
        return float(power @ self.mean_square(q, transfer, semi_axis=semi_axes[1]) / power.sum())


@dataclass(frozen=True)
class Ridges(TransverseStructure):
    """All lines are alike, k_y = 0."""

    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        along = np.asarray(q, dtype=np.float64)
        return np.asarray(transfer(along, np.zeros_like(along)) ** 2)

    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        return 1


@dataclass(frozen=True)
class WaveBand(TransverseStructure):
    """Equal power at abs(k_y) < alpha k_x, and none beyond: Remington's assumption. alpha: positive."""

    alpha: float

    def __post_init__(self) -> None:
        positive(alpha=self.alpha)

    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        wave = np.asarray(q, dtype=np.float64)[..., np.newaxis]
        t, dt = self._slopes(wave, semi_axis)
        return np.asarray(transfer(wave, wave * t) ** 2 @ dt / self.alpha)

    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        return int(self._slopes(np.asarray(q, dtype=np.float64)[..., np.newaxis], semi_axis)[1].size)

    def _slopes(self, wave: FloatArray, semi_axis: float) -> tuple[FloatArray, FloatArray]:
        """k_y / k_x and its weights; a period of the filter is another for each wave."""
        longest = float(wave.max(initial=0.0)) * self.alpha * semi_axis
        if min(self.alpha, 1.0) * float(wave.min(initial=np.inf)) * semi_axis > FAR:
            return _far_across(LEAST_SLOPE, self.alpha, math.pi / (wave * semi_axis))
        return gauss(np.linspace(0, self.alpha, 2 + math.ceil(max(longest / math.pi, 2 * self.alpha))))

    def density(self, along: ArrayLike, across: ArrayLike, line: LineSpectrum) -> FloatArray:
        """Two-sided C(k_x, k_y) = C_line / (2 alpha abs(k_x)) in the band, k_x not zero [m^4]."""
        k_x, k_y = (np.abs(np.asarray(k, dtype=np.float64)) for k in (along, across))
        return np.asarray(np.where(k_y < self.alpha * k_x, line(k_x) / (2 * self.alpha * k_x), 0.0))


@dataclass(frozen=True)
class IsotropicGround(TransverseStructure):
    """The isotropic surface whose lines have this spectrum, without its waves beyond q_max.

    The weight of k_y is C_2D(sqrt(q^2 + k_y^2)) over its integral, which is C_line(q) where there is no q_max. Raises
    ValueError where no isotropic surface has such a line.
    """

    line: LineSpectrum
    q_max: float = math.inf

    def __post_init__(self) -> None:
        if not self.q_max > 0:
            raise ValueError(f"q_max must be positive, got {self.q_max}")
        q, c2d = _tabulated(self.line)
        if (c2d <= 0).any():
            wave = 2 * math.pi / float(q[np.argmax(c2d <= 0)])
            raise ValueError(
                f"no isotropic surface has this line: its spectrum rises too steeply at waves of {1e3 * wave:.3g} mm"
            )

    def c2d(self, s: ArrayLike) -> FloatArray:
        """C_2D(s) from a table, to 1e-3, zero beyond q_max; s > 0, any shape [m^4]."""
        q = np.asarray(s, dtype=np.float64)
        table_q, table_c = _tabulated(self.line)
        found = np.exp(np.interp(np.log(q), np.log(table_q), np.log(table_c)))
        beyond = np.maximum(q / table_q[-1], 1.0) ** -(self.line.exponents[-1] + 1)
        return np.asarray(np.where(q <= self.q_max, found * beyond, 0.0))

    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        along = np.asarray(q, dtype=np.float64)[..., np.newaxis]
        k, dk = self._across(along, semi_axis)
        power, density = self.line_power(along[..., 0]), self.c2d(np.hypot(along, k))
        # a filter that does not see k_y lets the waves beyond the last panel pass as those at its end
        beyond = np.maximum(power - density @ (2 * dk), 0.0) * transfer(along, k[-1:])[..., 0] ** 2
        return np.asarray(((transfer(along, k) ** 2 * density) @ (2 * dk) + beyond) / power)

    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        return int(self._across(np.asarray(q, dtype=np.float64), semi_axis)[0].size)

    def _across(self, along: FloatArray, semi_axis: float) -> tuple[FloatArray, FloatArray]:
        """k_y and its weights."""
        least, largest, period = float(along.min()), float(along.max()), math.pi / semi_axis
        end = FARTHEST * max(largest, 1 / semi_axis)
        if least * semi_axis > FAR:
            return _far_across(least, end, np.array(period))
        return gauss(_panels_across(least, end, period))

    def line_power(self, q: ArrayLike) -> FloatArray:
        """C_line of the surface without its waves beyond q_max [m^3]."""
        along = np.asarray(q, dtype=np.float64)
        if math.isinf(self.q_max):
            return self.line(along)
        return np.array([self._cut_line(one) for one in along.ravel()]).reshape(along.shape)

    def _cut_line(self, q: float) -> float:
        """int C_2D dk over waves up to q_max."""
        k, dk = gauss(_panels_across(q, math.sqrt(max(self.q_max**2 - q**2, 0.0)), math.inf))
        return 2 * float(dk @ self.c2d(np.hypot(q, k)))


def has_isotropic_surface(line: LineSpectrum) -> bool:
    """Whether an isotropic surface has this line: where its spectrum nowhere rises too steeply with q."""
    return bool((_tabulated(line)[1] > 0).all())


def _along(first: float, last: float, semi_axis: float) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers along in a band, and their weights."""
    if first * semi_axis > FAR_ALONG:
        panels = 1 + math.ceil(math.log(last / first) / GROWTH)
        return _periods(np.geomspace(first, last, panels + 1), math.pi / semi_axis)
    return gauss(np.linspace(first, last, 2 + math.floor((last - first) * semi_axis / math.pi)))


def _far_across(q: float, end: float, period: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights from zero on, of all periods of a filter up to ``FAR``, and then of some of them."""
    least = float(period.min())
    near = FAR / math.pi * least
    k, dk = gauss(_panels_across(q, near, least))
    far, weight = _periods(_panels_across(q, end, math.inf, near), period)
    return np.concatenate([np.broadcast_to(k, (*far.shape[:-1], k.size)), far], axis=-1), np.concatenate([dk, weight])


def _panels_across(q: float, end: float, period: float, begin: float = 0.0) -> list[float]:
    """Ends of panels over k_y: as wide as C_2D(sqrt(q^2 + k_y^2)) and a filter that oscillates allow."""
    ends = [begin]
    while ends[-1] < end:
        ends.append(min(end, ends[-1] + min(GROWTH * math.hypot(q, ends[-1]), period)))
    return ends


@lru_cache(maxsize=64)
def _tabulated(line: LineSpectrum) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers from a tenth of the first to the last of the line, and C_2D there."""
    first, last = line.wavenumbers[0] / 10, line.wavenumbers[-1]
    between = np.geomspace(first, last, 1 + math.ceil(10 * POINTS * math.log10(last / first)))
    q = np.unique([*between, *line.wavenumbers])
    return q, line.isotropic(q)


def gauss(ends: Sequence[float] | FloatArray) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of Gauss and Legendre on all panels between ascending ends."""
    return on_panels(ends, NODES)


def _periods(ends: Sequence[float] | FloatArray, period: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of `gauss` on wide panels, each the mean over one period of an oscillation around it.

    period: short beside the panels; of an array each has its own nodes, (..., nodes).
    """
    node, weight = gauss_legendre(NODES)
    centre, wide = gauss(ends)
    around = centre[:, np.newaxis] + np.asarray(period, dtype=np.float64)[..., np.newaxis] / 2 * node
    return around.reshape(*around.shape[:-2], -1), np.outer(wide, weight / 2).ravel()
