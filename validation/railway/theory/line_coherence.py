"""Lateral structure of a rough rail from the coherence of parallel lines, in one-third octaves of wavelength.

Two lines a distance s apart have the coherence rho(s) = int C(k_x, k_y) cos(k_y s) dk_y / int C(k_x, k_y) dk_y:
sin(alpha k_x s) / (alpha k_x s) where waves have equal power at abs(k_y) < alpha k_x; 1 where all lines are alike; that
of C_2D where the surface is isotropic. alpha is found band by band, with its 95 % interval.

In a band of n independent waves the coherence of all pairs of lines of one distance is r = sum Re(Z_i* Z_j) / sum
(abs(Z_i)^2 + abs(Z_j)^2) / 2. z = artanh r is compared for each distance: Q(alpha) = sum (z - artanh rho)^2 / var z.
alpha lies where Q is less than its minimum plus 3.84 kappa, kappa the variance of the sum over that of independent
distances. Variances are those of quadratic forms in Gaussian lines: n cov(r_s, r_t) = tr(A_s R A_t R), R the matrix of
coherences, A_s its pairs less rho times its powers. Source: Bendat and Piersol, Random Data, for z; Varin, Reid and
Firth, Statistica Sinica 21 (2011) 5, for kappa.

Lines are taken to have no noise of their own and to begin at the same place: noise and shifts lower the coherence, and
alpha is too large.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from validation.analysis.spectra import NominalBands
from validation.railway.theory.transverse_structure import IsotropicGround, Ridges, TransverseStructure, WaveBand

FloatArray = NDArray[np.float64]

LARGEST = 10.0
"""alpha that stands for all larger ones."""
ALPHAS = np.concatenate([[0.0], np.geomspace(0.02, LARGEST, 160)])
TAPERED = 0.1
"""Share of a line over which it is faded in and out."""
INCOHERENT = 1e-3
"""Share of the power that may be noise: coherence is not known more closely than that."""
QUANTILE, MISFIT = 3.841, 9.21
"""95 % of chi square with one degree of freedom; 99 % with two, beyond which a structure does not fit."""
NODES = 16
"""Wavenumbers of a band at which coherence is computed, at the most."""
FEWEST = 3.0
"""Independent waves of a band, at the least."""
FARTHEST_SHIFT, CLEAR = 0.1, 5.0
"""Shift of a line along the track that is looked for [m]; by how many standard deviations of noise its correlation is
larger than without it."""
FIRST_ZERO = math.pi
"""alpha k s of the first zero of the coherence: of larger ones it tells nothing."""

Kind = Literal["between", "at most", "at least", "not determined"]


@dataclass(frozen=True)
class LateralEstimate:
    """alpha in one band, by lines. alpha: most likely; low, high: its 95 % interval, 0 to ``LARGEST``, which stand for
    all lines alike and for any larger value; isotropic: whether isotropic ground is among what the lines may be of;
    waves: independent ones in the band.
    """

    alpha: float
    low: float
    high: float
    isotropic: bool
    waves: float

    @property
    def kind(self) -> Kind:
        """Which ends of the interval the lines tell."""
        if self.low > 0:
            return "between" if self.high < LARGEST else "at least"
        return "at most" if self.high < LARGEST else "not determined"


UNKNOWN = LateralEstimate(math.nan, 0.0, LARGEST, True, 0.0)


@dataclass(frozen=True, eq=False)
class ParallelLines:
    """heights: (points, lines) [m]; spacing: of the points [m]; positions: of the lines, ascending [m].

    Raises ValueError for less than two lines.
    """

    heights: FloatArray
    spacing: float
    positions: Sequence[float]

    def __post_init__(self) -> None:
        if self.heights.ndim != 2 or self.heights.shape[1] != len(self.positions) or len(self.positions) < 2:
            raise ValueError(f"heights must be of two lines or more, one a position, got shape {self.heights.shape}")

    @cached_property
    def apart(self) -> FloatArray:
        """Distance of each line from each [m]."""
        return np.abs(np.subtract.outer(self.positions, self.positions)).round(9)

    @cached_property
    def separations(self) -> FloatArray:
        """The distances of pairs of lines, each once, ascending [m]."""
        return np.unique(self.apart[np.triu_indices(len(self.positions), 1)])

    @cached_property
    def forms(self) -> tuple[FloatArray, FloatArray]:
        """Quadratic forms of the cross power and of the mean power of all pairs of each separation."""
        of_pairs = self.apart == self.separations[:, np.newaxis, np.newaxis]
        of_pairs[:, np.arange(len(self.positions)), np.arange(len(self.positions))] = False
        powers = np.zeros(of_pairs.shape)
        powers[:, np.arange(len(self.positions)), np.arange(len(self.positions))] = of_pairs.sum(axis=1) / 2
        return of_pairs / 2, powers

    @cached_property
    def _spectra(self) -> tuple[FloatArray, NDArray[np.complex128], float]:
        """Wavenumbers, waves of the differences of each line, and independent waves over their number.

        Differences have a level spectrum, of which long waves do not leak into short ones.
        """
        steps = np.diff(scipy.signal.detrend(self.heights, axis=0), axis=0)
        taper = scipy.signal.windows.tukey(len(steps), TAPERED)
        waves = np.fft.rfft(taper[:, np.newaxis] * steps, axis=0)
        independent = np.sum(taper**2) ** 2 / (len(steps) * np.sum(taper**4))
        q = np.asarray(2 * math.pi * np.fft.rfftfreq(len(steps), self.spacing), dtype=np.float64)
        return q, waves, float(independent)

    @cached_property
    def shifts(self) -> FloatArray:
        """By how much each line is ahead of the first along the track, zero where that is not clear [m].

        Where the correlation of the differences is largest within 0.1 m, and clearly larger than at zero.
        """
        _, waves, _ = self._spectra
        powers = np.sqrt(np.sum(np.abs(waves) ** 2, axis=0))
        correlation = np.fft.irfft(waves[:, :1].conj() * waves, len(self.heights) - 1, axis=0)
        correlation = correlation * (len(self.heights) - 1) / (2 * powers[0] * powers)
        reach = min(math.floor(FARTHEST_SHIFT / self.spacing), (len(self.heights) - 2) // 2)
        lags = np.arange(-reach, reach + 1)
        best = lags[np.argmax(correlation[lags], axis=0)]
        over = correlation[best, np.arange(best.size)] - correlation[0]
        clear = over > CLEAR / math.sqrt(len(self.heights))
        return np.asarray(np.where(clear, best * self.spacing, 0.0))

    def estimates(self, bands: NominalBands, isotropic: IsotropicGround | None) -> tuple[LateralEstimate, ...]:
        """One a band; nothing is known of lines that are shifted along the track.

        isotropic: the ground that the lines may be of; None where none has their spectrum.
        """
        if self.shifts.any():
            return (UNKNOWN,) * len(bands)
        return tuple(self._estimate(first, last, isotropic) for first, last in pairwise(bands.edges.tolist()))

    def _estimate(self, first: float, last: float, isotropic: IsotropicGround | None) -> LateralEstimate:
        all_q, all_waves, independent = self._spectra
        inside = (all_q >= first) & (all_q < last)
        count = independent * float(inside.sum())
        if count < FEWEST:
            return UNKNOWN
        band = BandOfLines.of_waves(self, all_q[inside], all_waves[inside], count)
        return band.estimate(isotropic)


@dataclass(frozen=True, eq=False)
class BandOfLines:
    """One band of parallel lines. q, weights: wavenumbers and their shares of the power; r: coherence by separation;
    waves: independent ones.
    """

    lines: ParallelLines
    q: FloatArray
    weights: FloatArray
    r: FloatArray
    waves: float

    @classmethod
    def of_waves(
        cls, lines: ParallelLines, q: FloatArray, waves: NDArray[np.complex128], independent: float
    ) -> "BandOfLines":
        """Of all waves of a band, which are put together at ``NODES`` wavenumbers."""
        cross, power = lines.forms
        products = np.einsum("ki,kj->ij", waves, waves.conj()).real
        r = np.tensordot(cross, products, 2) / np.tensordot(power, products, 2)
        groups = np.array_split(np.arange(q.size), min(NODES, q.size))
        weights = np.array([float(np.sum(np.abs(waves[group]) ** 2)) for group in groups])
        nodes = np.array([float(q[group].mean()) for group in groups])
        return cls(lines, nodes, weights / weights.sum(), np.asarray(r), independent)

    @cached_property
    def centre(self) -> float:
        """Mean wavenumber [rad/m]."""
        return float(self.weights @ self.q)

    def estimate(self, isotropic: IsotropicGround | None) -> LateralEstimate:
        """What alpha may be, and whether the ground may be isotropic."""
        of_alpha = [self.misfit(WaveBand(alpha) if alpha else Ridges()) for alpha in ALPHAS.tolist()]
        q = np.array([misfit for misfit, _, _ in of_alpha])
        best = int(np.argmin(q))
        kappa = self._dependence(of_alpha, best)
        of_isotropic = math.inf if isotropic is None else self.misfit(isotropic)[0]
        least = min(float(q[best]), of_isotropic)
        if least > MISFIT * kappa:
            return LateralEstimate(float(ALPHAS[best]), 0.0, LARGEST, True, self.waves)
        low, high = _where_below(q, float(q[best]) + QUANTILE * kappa)
        is_far = high * self.centre * float(self.lines.separations[0]) >= FIRST_ZERO
        return LateralEstimate(
            alpha=float(ALPHAS[best]),
            low=low,
            high=LARGEST if is_far else high,
            isotropic=is_far or of_isotropic <= least + QUANTILE * kappa,
            waves=self.waves,
        )

    def misfit(self, structure: TransverseStructure) -> tuple[float, FloatArray, FloatArray]:
        """Q of a structure, artanh of its coherences and their covariances."""
        separations, (cross, power) = self.lines.separations, self.lines.forms
        rho = np.array([self.weights @ structure.coherence(self.q, s) for s in separations.tolist()])
        apart = np.concatenate([[0.0], separations])
        of_pairs = np.concatenate([[1.0], rho])[np.searchsorted(apart, self.lines.apart - 1e-10)]
        forms = (cross - rho[:, np.newaxis, np.newaxis] * power) @ of_pairs
        norm = np.einsum("mij,ji->m", power, of_pairs)
        covariance = np.einsum("mij,nji->mn", forms, forms) / self.waves / np.outer(norm, norm)
        # noise of its own keeps every coherence from 1
        kept = 1 - INCOHERENT
        slope = kept / (1 - (kept * rho) ** 2)
        covariance = covariance * np.outer(slope, slope) + np.diag((slope * INCOHERENT / 2) ** 2)
        z = np.arctanh(kept * rho)
        off = np.arctanh(kept * self.r) - z
        return float(np.sum(off**2 / np.diag(covariance))), z, covariance

    def _dependence(self, of_alpha: Sequence[tuple[float, FloatArray, FloatArray]], best: int) -> float:
        """kappa: variance of the estimate over that of independent separations; their number at the ends of alpha."""
        if not 0 < best < len(of_alpha) - 1:
            return float(self.r.size)
        slope = of_alpha[best + 1][1] - of_alpha[best - 1][1]
        covariance = of_alpha[best][2]
        weighted = slope / np.diag(covariance)
        information = float(slope @ weighted)
        return float(weighted @ covariance @ weighted) / information if information > 0 else float(self.r.size)


def _where_below(q: FloatArray, limit: float) -> tuple[float, float]:
    """The least and the largest alpha at which Q is a limit, by straight lines between points."""
    below = np.flatnonzero(q <= limit)
    ends = []
    for inside, outside in ((int(below[0]), int(below[0]) - 1), (int(below[-1]), int(below[-1]) + 1)):
        if not 0 <= outside < q.size:
            ends.append(float(ALPHAS[inside]))
            continue
        share = (limit - q[inside]) / (q[outside] - q[inside])
        ends.append(float(ALPHAS[inside] + share * (ALPHAS[outside] - ALPHAS[inside])))
    return ends[0], ends[1]


def in_words(estimates: Sequence[LateralEstimate], bands: NominalBands) -> str:
    """A clause for the bands of each kind: the median of alpha and the ends of all intervals.

    Or one end, or "not determined". Then the bands in which isotropic roughness is possible.
    """
    clauses = []
    for kind in dict.fromkeys(estimate.kind for estimate in estimates):
        of_kind = [estimate for estimate in estimates if estimate.kind == kind]
        low, high = min(estimate.low for estimate in of_kind), max(estimate.high for estimate in of_kind)
        middle = float(np.median([estimate.alpha for estimate in of_kind]))
        alpha = {
            "between": f"alpha = {middle:.2g} ({low:.2g} to {high:.2g})",
            "at most": f"alpha at most {high:.2g}",
            "at least": f"alpha at least {low:.2g}",
            "not determined": "not determined",
        }[kind]
        clauses.append(f"{alpha} at {bands.names([estimate.kind == kind for estimate in estimates])}")
    may_be = [estimate.isotropic and estimate.kind != "not determined" for estimate in estimates]
    return "; ".join([*clauses, *([f"isotropic ground is possible at {bands.names(may_be)}"] if any(may_be) else [])])
