"""What lies across the track of a rough line: how its waves cross it, and the mean of a filter over them.

A line sees the wave (k_x, k_y) as one of k_x. Of all waves with the same k_x, a contact filter H(k_x, k_y) lets pass
the mean of abs(H)^2, weighted by their power. Wavenumbers in rad/m; filters as in `contact_filters`.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.theory.closed_forms import positive
from validation.theory.half_space import gauss_legendre, on_panels

FloatArray = NDArray[np.float64]

LEAST_FALL, MOST_FALL = 1.0, 20.0
"""Exponents beyond the shortest wave at the least and at the most: C ~ 1/q has the same level in each one-third octave,
and of a spectrum that falls by 19 dB a band nothing is left there."""
LINE_NODES = 12
"""Of Gauss and Legendre, on a panel."""
WIDEST = 1.3
"""Largest ratio of both ends of a panel, on which a power law is a polynomial to rounding."""


@dataclass(frozen=True)
class LineSpectrum:
    """C_line(q) = c_i (q / q_i)^(-p_i) between the wavenumbers q_i [rad/m] at which it has the densities c_i [m^3].

    The first law continues to longer waves, the last to shorter ones, where it falls as 1/q at the least and as q^-20
    at the most: all integrals over short waves have an end. wavenumbers: two or more, ascending, positive; densities:
    positive.
    """

    wavenumbers: tuple[float, ...]
    densities: tuple[float, ...]

    def __post_init__(self) -> None:
        q, c = np.array(self.wavenumbers), np.array(self.densities)
        if q.ndim != 1 or q.size < 2 or not (np.isfinite(q).all() and q[0] > 0 and (np.diff(q) > 0).all()):
            raise ValueError(f"wavenumbers must be two or more, positive and ascending, got {self.wavenumbers}")
        if c.shape != q.shape or not (np.isfinite(c).all() and (c > 0).all()):
            raise ValueError(f"densities must be positive, one a wavenumber, got {self.densities}")

    @classmethod
    def through(cls, wavenumbers: ArrayLike, densities: ArrayLike) -> "LineSpectrum":
        """Of arrays."""
        q, c = (np.asarray(each, dtype=np.float64).tolist() for each in (wavenumbers, densities))
        return cls(tuple(q), tuple(c))

    def steeper(self, by: float) -> "LineSpectrum":
        """The same with exponents p_i + by, and with its density at the first wavenumber."""
        q = np.array(self.wavenumbers)
        return LineSpectrum.through(q, np.array(self.densities) * (q / q[0]) ** -by)

    def from_wavenumber(self, q: float) -> "LineSpectrum":
        """The same with a first point at q, where that is less than the first; to it the line does not fall."""
        if q >= self.wavenumbers[0]:
            return self
        return LineSpectrum((q, *self.wavenumbers), (max(float(self(q)), self.densities[0]), *self.densities))

    @cached_property
    def exponents(self) -> FloatArray:
        """p_i, between the points and beyond the last."""
        # bounded beyond the last point alone: measured levels may rise or fall by more between two bands
        between = -np.diff(np.log(self.densities)) / np.diff(np.log(self.wavenumbers))
        return np.append(between, np.clip(between[-1], LEAST_FALL, MOST_FALL))

    def __call__(self, q: ArrayLike) -> FloatArray:
        """C_line of wavenumbers q of any sign [m^3]."""
        k = np.abs(np.asarray(q, dtype=np.float64))
        # before the first point its law goes on
        law = np.clip(np.searchsorted(self.wavenumbers, k, side="right") - 1, 0, None)
        start, density = np.array(self.wavenumbers)[law], np.array(self.densities)[law]
        return np.asarray(density * (k / start) ** -self.exponents[law])

    def isotropic(self, s: ArrayLike) -> FloatArray:
        """C_2D(s) = -(1/pi) int_s^inf C_line'(q) dq / sqrt(q^2 - s^2), Abel's inverse of the line trace [m^4].

        Over k = sqrt(q^2 - s^2) the end point is regular, dq / k = dk / q; the last law has a beta integral. Negative
        where no isotropic surface has such a line: where a spectrum rises too steeply with q. s: positive, any shape.
        """
        radial = np.asarray(s, dtype=np.float64)
        flat = radial.ravel()
        integral = sum((self._of_piece(flat, i) for i in range(len(self.wavenumbers) - 1)), self._of_last(flat))
        return np.asarray(integral / math.pi).reshape(radial.shape)

    def _of_piece(self, s: FloatArray, law: int) -> FloatArray:
        """p c int q^(-p-2) dk over one of the laws; the first begins at s."""
        low, high = self.wavenumbers[law : law + 2]
        # lines show a wave of the surface at q <= s: a law that ends below s adds nothing
        reached = s < high
        start = s[reached] if law == 0 else np.maximum(low, s[reached])
        panels = 1 + math.ceil(math.log(high / min(float(start.min(initial=high)), low)) / math.log(WIDEST))
        ends = np.geomspace(start, high, panels + 1)
        # panels by the ratio of q, where the law is smooth, nodes in k, where the end point is; q = s may round below
        k = np.sqrt(np.maximum(ends**2 - s[reached] ** 2, 0.0))
        node, weight = gauss_legendre(LINE_NODES)
        half = np.diff(k, axis=0)[:, np.newaxis] / 2
        q = np.hypot(s[reached], k[:-1, np.newaxis] + half * (1 + node[:, np.newaxis]))
        integral = np.zeros_like(s)
        integral[reached] = np.sum(half * weight[:, np.newaxis] * self._falling(law, q) / q, axis=(0, 1))
        return integral

    def _of_last(self, s: FloatArray) -> FloatArray:
        """p c int_{max(s, q_n)}^inf q^(-p-1) / sqrt(q^2 - s^2) dq = p c s^(-p-1) B((p+1)/2, 1/2; s^2/q^2) / 2."""
        last = len(self.wavenumbers) - 1
        p = float(self.exponents[-1])
        # u = 1 from the last point on, where the integral begins at s itself
        u = np.minimum(s / self.wavenumbers[last], 1.0) ** 2
        beta = special.beta((p + 1) / 2, 0.5) * special.betainc((p + 1) / 2, 0.5, u)
        return np.asarray(self._falling(last, s) * beta / 2)

    def _falling(self, law: int, q: FloatArray) -> FloatArray:
        """-C_line' = p c_i (q / q_i)^-p / q of one of the laws."""
        p = self.exponents[law]
        return np.asarray(p * self.densities[law] * (q / self.wavenumbers[law]) ** -p / q)


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

    @abstractmethod
    def coherence(self, q: ArrayLike, separation: float) -> FloatArray:
        """int C(q, k_y) cos(k_y s) dk_y / int C(q, k_y) dk_y of two lines a distance s apart [-]; the shape of q.

        It is real: their heights have the cross spectrum C_line times it. q: along the track, positive; separation: s,
        zero or positive [m].
        """

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
        # over the sum of the same nodes: an error of the quadrature of C_line cancels
        return float(power @ self.mean_square(q, transfer, semi_axis=semi_axes[1]) / power.sum())


@dataclass(frozen=True)
class Ridges(TransverseStructure):
    """All lines are alike, k_y = 0."""

    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        along = np.asarray(q, dtype=np.float64)
        return np.asarray(transfer(along, np.zeros_like(along)) ** 2)

    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        return 1

    def coherence(self, q: ArrayLike, separation: float) -> FloatArray:
        return np.ones_like(np.asarray(q, dtype=np.float64))


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

    def coherence(self, q: ArrayLike, separation: float) -> FloatArray:
        """sin(alpha q s) / (alpha q s)."""
        return np.asarray(np.sinc(self.alpha * np.asarray(q, dtype=np.float64) * separation / math.pi))

    def _slopes(self, wave: FloatArray, semi_axis: float) -> tuple[FloatArray, FloatArray]:
        """Nodes k_y / k_x and weights over half of the band: the same for all waves, or of short ones a row a wave."""
        # power and filter are even in t = k_y / k_x: half of the range is enough
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
        # between points C_2D is nearly a power of q, a line of logarithms; constant below the first of the table
        density = np.exp(np.interp(np.log(q), np.log(table_q), np.log(table_c)))
        # behind the last point by the law of the line, one power steeper in two dimensions
        beyond = np.maximum(q / table_q[-1], 1.0) ** -(self.line.exponents[-1] + 1)
        return np.asarray(np.where(q <= self.q_max, density * beyond, 0.0))

    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        along = np.asarray(q, dtype=np.float64)[..., np.newaxis]
        k, dk = self._across(along, semi_axis)
        power, density = self.line_power(along[..., 0]), self.c2d(np.hypot(along, k))
        # a filter that does not see k_y lets the waves beyond the last panel pass as those at its end
        beyond = np.maximum(power - density @ (2 * dk), 0.0) * transfer(along, k[-1:])[..., 0] ** 2
        return np.asarray(((transfer(along, k) ** 2 * density) @ (2 * dk) + beyond) / power)

    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        return int(self._across(np.asarray(q, dtype=np.float64), semi_axis)[0].size)

    def coherence(self, q: ArrayLike, separation: float) -> FloatArray:
        """To 1e-3."""
        along = np.asarray(q, dtype=np.float64)
        if separation == 0:
            return np.ones_like(along)
        k, dk = self._across(along, separation)
        density = self.c2d(np.hypot(along[..., np.newaxis], k))
        return np.asarray(density @ (2 * dk * np.cos(k * separation)) / self.line_power(along))

    def _across(self, along: FloatArray, semi_axis: float) -> tuple[FloatArray, FloatArray]:
        """k_y and its weights."""
        # one set of nodes for all waves of a band: the longest has the sharpest C_2D, the shortest the farthest end
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
        return np.array([self._cut_line(wavenumber) for wavenumber in along.ravel()]).reshape(along.shape)

    def _cut_line(self, q: float) -> float:
        """int C_2D dk over waves up to q_max."""
        # no filter, and so no period
        k, dk = gauss(_panels_across(q, math.sqrt(max(self.q_max**2 - q**2, 0.0)), math.inf))
        return 2 * float(dk @ self.c2d(np.hypot(q, k)))


@dataclass(frozen=True)
class BandedStructure(TransverseStructure):
    """Another structure in each band along the track.

    edges: of the bands, ascending, (bands + 1,) [rad/m]; structures: one a band. Longer and shorter waves have that of
    the first and of the last band.
    """

    edges: tuple[float, ...]
    structures: tuple[TransverseStructure, ...]

    def __post_init__(self) -> None:
        if len(self.edges) != len(self.structures) + 1 or not (np.diff(self.edges) > 0).all():
            raise ValueError(
                f"edges must ascend, one more than structures, got {len(self.edges)} for {len(self.structures)}"
            )

    def _numbers(self, q: ArrayLike) -> NDArray[np.intp]:
        """Of the band of each wavenumber."""
        return np.searchsorted(self.edges[1:-1], np.asarray(q, dtype=np.float64), side="right")

    def _in_each(self, q: ArrayLike, value: Callable[[TransverseStructure, FloatArray], FloatArray]) -> FloatArray:
        along = np.asarray(q, dtype=np.float64)
        numbers, values = self._numbers(along), np.empty_like(along)
        for number in np.unique(numbers).tolist():
            inside = numbers == number
            values[inside] = value(self.structures[number], along[inside])
        return values

    def mean_square(self, q: ArrayLike, transfer: Filter, *, semi_axis: float) -> FloatArray:
        return self._in_each(q, lambda own, along: own.mean_square(along, transfer, semi_axis=semi_axis))

    def waves_across(self, q: ArrayLike, *, semi_axis: float) -> int:
        along = np.asarray(q, dtype=np.float64)
        numbers = self._numbers(along)
        each = [(self.structures[n], along[numbers == n]) for n in np.unique(numbers).tolist()]
        counts: list[int] = [own.waves_across(of_own, semi_axis=semi_axis) for own, of_own in each]
        return max(counts)

    def coherence(self, q: ArrayLike, separation: float) -> FloatArray:
        return self._in_each(q, lambda own, along: own.coherence(along, separation))


def has_isotropic_surface(line: LineSpectrum) -> bool:
    """Whether an isotropic surface has this line: where its spectrum nowhere rises too steeply with q."""
    return bool((_tabulated(line)[1] > 0).all())


def _along(first: float, last: float, semi_axis: float) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers along in a band, and their weights."""
    if first * semi_axis > FAR_ALONG:
        # of a filter with many periods in the band a few stand for all
        panels = 1 + math.ceil(math.log(last / first) / GROWTH)
        return _periods(np.geomspace(first, last, panels + 1), math.pi / semi_axis)
    return gauss(np.linspace(first, last, 2 + math.floor((last - first) * semi_axis / math.pi)))


def _far_across(q: float, end: float, period: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights from zero on, of all periods of a filter up to ``FAR``, and then of some of them."""
    # all periods near k_y = 0, where the filter is largest; of an array by the shortest, so that all have these nodes
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
    # the line's own points too: C_2D has kinks there
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
