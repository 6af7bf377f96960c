"""Power spectra of periodic tracks and of finite records, their levels in bands, and the sound of a record.

Bands are one-third octaves mostly; sounds are A-weighted, or columns of a table that are played with one gain.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Literal

import numpy as np
import scipy
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
        """Add up the values at the wavenumbers in each band: (..., waves) becomes (..., bands)."""
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
    """The harmonics of periodic series along the last axis, by an FFT without a window; spacing of points [m]."""
    x = np.asarray(series, dtype=np.float64)
    points = x.shape[-1]
    last = (points - 1) // 2
    q = 2 * np.pi / (points * spacing) * np.arange(1, last + 1)
    return Waves(q, np.fft.rfft(x, norm="forward")[..., 1 : last + 1])


def levels(spectrum: Waves, bands: Bands) -> FloatArray:
    """int C dq over each band, of positive wavenumbers; bands along the last axis."""
    return bands.sums(spectrum.q, np.abs(spectrum.amplitude) ** 2).real


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
    sums = np.add.reduceat(ended, borders, axis=0)[:-1] * omega[0] / (2 * np.pi)
    sums[borders[1:] == borders[:-1]] = np.nan
    return np.asarray(sums)


def band_means(omega: FloatArray, density: FloatArray, edges: ArrayLike) -> FloatArray:
    """The mean of A in each band: its level over its width in f that the frequencies of the record fill."""
    borders = np.searchsorted(omega, np.asarray(edges, dtype=np.float64))
    count = np.maximum(np.diff(borders), 1)
    width = count * omega[0] / (2 * np.pi)
    levels = band_levels(omega, density, edges)
    return np.asarray(levels / width.reshape(-1, *[1] * (levels.ndim - 1)))


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
    neighbours = np.concatenate([hann[max(top - 2 * LOBE, 0) : max(top - LOBE, 0)], hann[top + LOBE : top + 2 * LOBE]])
    if hann[top] < PROMINENT * np.median(neighbours):
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
    residuals = log - np.polyval(np.polyfit(x, log, 1), x)
    w = np.sin(np.pi * np.arange(x.size) / x.size) ** 2
    line = np.abs(np.fft.rfft(residuals * w)) ** 2
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
        for before, number in pairwise(numbers):
            name, last = _in_mm(nominal_wavelength(number)), _in_mm(nominal_wavelength(before))
            if number == before:
                raise ValueError(f"wavelengths must name each band once, got {name} twice")
            if number > before:
                raise ValueError(f"wavelengths must be sorted, got {name} behind {last}")
            if number < before - 1:
                missing = _in_mm(nominal_wavelength(before - 1))
                raise ValueError(f"wavelengths must name all bands between their ends, got no {missing} behind {last}")
        return cls(numbers[0], numbers[-1])

    @property
    def numbers(self) -> range:
        """The numbers n of the bands, centre wavelength 10^(n/10) m, descending."""
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
        """Name the bands where a mask is true, neighbours as one range: "2000 to 800, 31.5 mm", or "none"."""
        inside = np.flatnonzero(np.asarray(of, dtype=bool))
        if not inside.size:
            return "none"
        runs = np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1)
        ends = [[f"{1000 * self.nominal[i]:g}" for i in dict.fromkeys((run[0], run[-1]))] for run in runs]
        return f"{', '.join(' to '.join(each) for each in ends)} mm"

    @property
    def wavelengths(self) -> FloatArray:
        """Exact centres 10^(n/10) of the bands [m], descending."""
        return np.asarray(10 ** (np.array(self.numbers) / 10))

    @property
    def centres(self) -> FloatArray:
        """2 pi over the exact centres [rad/m], ascending."""
        return np.asarray(2 * np.pi / self.wavelengths)

    @property
    def edges(self) -> FloatArray:
        """The edges of the bands [rad/m], ascending, shape (bands + 1,)."""
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
        spectra = waves(window * heights, spacing=spacing)
        ends = spectra.q[0] * (np.arange(spectra.q.size + 1) + 0.5)
        powers = 2 * np.abs(spectra.amplitude) ** 2
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


def assessed_bands(level: FloatArray, above: float) -> NDArray[np.bool_]:
    """Mask of the bands before the first whose level is not above a limit, from the longest waves on [dB].

    Behind it a filter has zeros and rises again, and what is there comes of waves of other bands. NaN is no level: its
    band is not assessed, and those behind it may be.
    """
    return np.asarray(np.logical_and.accumulate(~(level <= above)) & ~np.isnan(level))


def a_weighting(frequency: ArrayLike) -> FloatArray:
    """A(f) [dB] of IEC 61672-1: 20 lg of the product of its four corner frequencies' factors, 0 at 1 kHz."""
    square = np.asarray(frequency, dtype=np.float64) ** 2
    low, middle, upper, high = 20.6**2, 107.7**2, 737.9**2, 12194.0**2
    gain = high * square**2 / ((square + low) * np.sqrt((square + middle) * (square + upper)) * (square + high))
    return np.asarray(20 * np.log10(gain) + 2.00)


def energy_sum(levels: ArrayLike) -> float:
    """10 lg of the sum of the powers of levels [dB]."""
    return float(10 * np.log10(np.sum(10 ** (np.asarray(levels) / 10))))


@dataclass(frozen=True, kw_only=True)
class Sound:
    """A column that is played. name: of its file; label: of its player; says: what is to be known beside it."""

    name: str
    label: str
    column: str
    says: str


@dataclass(frozen=True, kw_only=True)
class Sounds:
    """Sounds that are compared, so that they have one gain.

    table: of the samples, a column each; rate [1/s]; full_scale: what the largest number of a file stands for, in the
    unit of the columns; repeats: how often the samples, a period, are played; heard: what is heard, in sentences.
    Raises ValueError for two sounds of one name.
    """

    table: str
    rate: int
    full_scale: float
    repeats: int
    heard: str
    tracks: tuple[Sound, ...]

    def __post_init__(self) -> None:
        names = [sound.name for sound in self.tracks]
        if twice := {name for name in names if names.count(name) > 1}:
            raise ValueError(f"sounds must have names of their own, got twice: {', '.join(sorted(twice))}")


def common_full_scale(signals: Iterable[FloatArray]) -> float:
    """The least number of two digits that no sample of any signal exceeds."""
    peak = max(float(np.abs(signal).max()) for signal in signals)
    if not peak > 0:
        raise ValueError("signals must have a sample that is not zero, got silence alone")
    digit = 10.0 ** (math.floor(math.log10(peak)) - 1)
    return float(f"{math.ceil(peak / digit) * digit:.6g}")


def filtered(signal: FloatArray, gain: FloatArray) -> FloatArray:
    """A periodic signal whose waves have a gain each, from frequency zero on."""
    return np.asarray(np.fft.irfft(gain * np.fft.rfft(signal), signal.size))


def powers_of_blocks(signal: FloatArray, blocks: int) -> FloatArray:
    """Mean square of so many equal pieces; what is left over belongs to none."""
    complete_blocks = signal[: signal.size // blocks * blocks]
    return np.asarray(np.mean(complete_blocks.reshape(blocks, -1) ** 2, axis=1))
