"""One-third octaves of wavelength as the field of rolling noise has them: base ten, named by nominal wavelengths.

Band n has the centre 10^(n/10) m and the edges 10^((n ± 1/2)/10) m, as IEC 61260-1 has frequencies; its nominal
wavelength, 31.5 mm for n = -15, is its name. Bands run from long waves to short ones.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike

from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import FloatArray

Detrend = Literal["none", "mean", "plane"]
"""What is subtracted from measured heights: nothing, their mean, or the plane of least squares, of a line its tilt."""
MANTISSAS = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)
"""Of nominal wavelengths, over a decade."""
LONGEST, SHORTEST = 3, -31
"""Numbers of the bands of 2000 and 0.8 mm, the ends of the tables of the field."""
OFF = 0.01
"""What a nominal wavelength differs from its centre, at the most: 1.6 beside 1.585."""
NODES = 32
"""Of Gauss and Legendre on half of a band: six turns of a filter."""


@dataclass(frozen=True)
class NominalBands:
    """Neighbouring bands, from the number of the longest waves down to that of the shortest."""

    longest: int = LONGEST
    shortest: int = SHORTEST

    def __post_init__(self) -> None:
        if not LONGEST >= self.longest >= self.shortest >= SHORTEST:
            raise ValueError(
                f"bands must be numbered from {LONGEST} down to {SHORTEST}, got {self.longest} to {self.shortest}"
            )

    @classmethod
    def named(cls, wavelengths: Sequence[float]) -> "NominalBands":
        """Those of nominal wavelengths [m], the longest first. ValueError where one is none, doubled or missing."""
        numbers = [band_number(wavelength) for wavelength in wavelengths]
        if not numbers:
            raise ValueError("wavelengths must name one band at least, got none")
        for before, here in pairwise(numbers):
            name, last = _in_mm(nominal_wavelength(here)), _in_mm(nominal_wavelength(before))
            if here == before:
                raise ValueError(f"wavelengths must name each band once, got {name} twice")
            if here > before:
                raise ValueError(f"wavelengths must be sorted, got {name} behind {last}")
            if here < before - 1:
                missing = _in_mm(nominal_wavelength(before - 1))
                raise ValueError(f"wavelengths must name all bands between their ends, got no {missing} behind {last}")
        return cls(numbers[0], numbers[-1])

    @property
    def numbers(self) -> range:
        """n of each band."""
        return range(self.longest, self.shortest - 1, -1)

    def __len__(self) -> int:
        return len(self.numbers)

    @property
    def nominal(self) -> FloatArray:
        """Nominal wavelengths, the names of the bands [m]."""
        return np.array([nominal_wavelength(n) for n in self.numbers])

    @property
    def span(self) -> str:
        """The names of the first and the last band, as "2000 to 0.8 mm"."""
        return f"{1000 * self.nominal[0]:g} to {1000 * self.nominal[-1]:g} mm"

    def names(self, of: ArrayLike) -> str:
        """Of the bands where a mask is true, neighbours together: "2000 to 800, 31.5 mm", or "none"."""
        inside = np.flatnonzero(np.asarray(of, dtype=bool))
        if not inside.size:
            return "none"
        runs = np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1)
        ends = [[f"{1000 * self.nominal[i]:g}" for i in dict.fromkeys((run[0], run[-1]))] for run in runs]
        return f"{', '.join(' to '.join(each) for each in ends)} mm"

    @property
    def wavelengths(self) -> FloatArray:
        """Exact centres 10^(n/10) [m]."""
        return np.asarray(10 ** (np.array(self.numbers) / 10))

    @property
    def centres(self) -> FloatArray:
        """2 pi over the exact centres [rad/m], ascending."""
        return np.asarray(2 * np.pi / self.wavelengths)

    @property
    def edges(self) -> FloatArray:
        """Of all bands [rad/m], ascending, one more than there are bands."""
        return np.asarray(2 * np.pi * 10 ** ((np.arange(len(self) + 1) - self.longest - 0.5) / 10))

    def within(self, longest: float, shortest: float) -> "NominalBands":
        """Those whose nominal wavelengths lie between two wavelengths [m]. ValueError where there are none."""
        inside = (self.nominal <= longest * (1 + 1e-9)) & (self.nominal >= shortest * (1 - 1e-9))
        numbers = np.array(self.numbers)[inside]
        if not numbers.size:
            raise ValueError(f"no band lies between the wavelengths {_in_mm(longest)} and {_in_mm(shortest)}")
        return NominalBands(int(numbers[0]), int(numbers[-1]))

    def powers_of_track(self, track: ArrayLike, *, spacing: float) -> FloatArray:
        """Mean square in each band of a periodic track [m^2], or of several along the last axis; bands come last.

        Raises ValueError where the track is too short for a wave in each band.
        """
        heights = np.asarray(track, dtype=np.float64)
        bands = Bands(tuple(self.edges.tolist())).on(heights.shape[-1] * spacing)
        return 2 * levels(waves(heights, spacing=spacing), bands)

    def powers_of_spectrum(self, c_line: Callable[[FloatArray], FloatArray]) -> FloatArray:
        """Mean square in each band, 2 int C_line dq [m^2], of a two-sided spectrum [m^3] smooth on halves of bands."""
        q, weight = self.quadrature()
        return np.asarray(2 * (weight * c_line(q)).sum(axis=-1))

    def slope_of_spectrum(self, c_line: Callable[[FloatArray], FloatArray]) -> float:
        """h', the rms slope along a line of the waves in all bands, h'^2 = 2 int q^2 C_line dq [-]; C_line as above."""
        return math.sqrt(float(self.powers_of_spectrum(lambda q: q**2 * c_line(q)).sum()))

    def powers_of_records(self, records: ArrayLike, *, spacing: float, detrend: Detrend = "plane") -> FloatArray:
        """Mean square in each band [m^2] of lines that do not repeat, along the last axis; bands come last.

        Each is seen through Hann's window, less its straight line of least squares, its mean, or nothing. Its density
        is even on each wave's share of the wavenumbers, of which a band may have a part.
        """
        heights = np.asarray(records, dtype=np.float64)
        if detrend != "none":
            heights = scipy.signal.detrend(heights, type="linear" if detrend == "plane" else "constant")
        points = heights.shape[-1]
        window = np.sin(np.pi * (np.arange(points) + 0.5) / points) ** 2 * math.sqrt(8 / 3)
        found = waves(window * heights, spacing=spacing)
        ends = found.q[0] * (np.arange(found.q.size + 1) + 0.5)
        powers = 2 * np.abs(found.amplitude) ** 2
        total = np.cumsum(np.concatenate([np.zeros((*powers.shape[:-1], 1)), powers], axis=-1), axis=-1)
        return np.diff(scipy.interpolate.interp1d(ends, total)(self.edges))

    def quadrature(self) -> tuple[FloatArray, FloatArray]:
        """Wavenumbers [rad/m] and weights of int dq over each band, both of shape (bands, nodes)."""
        node, weight = _gauss_legendre()
        half_band = math.log(10) / 20
        log_q = half_band / 2 * np.concatenate([node - 1, node + 1])
        q = self.centres[:, np.newaxis] * np.exp(log_q)
        return q, q * half_band / 2 * np.concatenate([weight, weight])


@cache
def _gauss_legendre() -> tuple[FloatArray, FloatArray]:
    """Nodes and weights on [-1, 1]."""
    return np.polynomial.legendre.leggauss(NODES)


def nominal_wavelength(number: int) -> float:
    """The name of band n as a wavelength [m]: 0.0315 for n = -15."""
    # of whole powers of ten in millimetres, so that 31.5 mm has the digits of 31.5
    return MANTISSAS[number % 10] * 10.0 ** (number // 10 + 3) / 1000


def band_number(wavelength: float) -> int:
    """n of the band that a nominal wavelength [m] names. ValueError where it names none."""
    if math.isfinite(wavelength) and wavelength > 0:
        number = round(10 * math.log10(wavelength))
        if LONGEST >= number >= SHORTEST and abs(wavelength / 10 ** (number / 10) - 1) < OFF:
            return number
    hint = ": is it in metres?" if 0 < wavelength < nominal_wavelength(SHORTEST) else ""
    raise ValueError(
        f"a wavelength must be nominal, of one-third octaves from {NominalBands().span}, got {_in_mm(wavelength)}{hint}"
    )


def _in_mm(wavelength: float) -> str:
    return f"{wavelength * 1000:g} mm"
