"""Bursts of noise in measured lines: parts in which the levels of short bands are far above those of all other parts.

As of a loose sensor, of a weld that is roughly ground, or of electrical noise. A line is cut into windows that overlap
by half, each seen through Hann's window. P_wb is the mean square of the heights in one-third octave b of window w. A
band of K waves has about nu = 2 K / (35/18) degrees of freedom there, so that P_wb over the median of all windows is
chi^2_nu over its median, but for what the line itself changes along the track. A window is part of a burst where each
of m neighbouring bands, `NEIGHBOURS`, or `OF_SHORT` where all are of `SHORT` waves, has

P_wb / median_w P_wb > `NATURAL` * quantile(chi^2_nu, 1 - p) / median(chi^2_nu), p^m = `FALSE` / (windows * bands).

Corrugation raises fewer neighbouring bands than that, or longer waves, and stays.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from validation.analysis.nominal_bands import SHORTEST, NominalBands
from validation.analysis.statistics import FloatArray
from validation.railway.scenes.line_outliers import Outlier

PARTS = 20, 80
"""Of a line that are as long as a window; what is left by a burst is known from the longer ones."""
FEWEST_POINTS, FEWEST_WINDOWS = 100, 12
"""Of a window, and of a line: with fewer no burst is looked for."""
WAVES, FEWEST_WAVES = 4, 2
"""Of a window in a band, at the least: where a burst is looked for, since those of a corrugation leak into the bands
beside it, and where what a burst adds is found."""
OF_HANN = 35 / 18
"""Waves over independent ones: the mean of the fourth power of Hann's window over the square of that of the second."""
NATURAL = 4.0
"""Power of a part of a line over that of the median, as of roughness that differs by a factor of 2 in rms."""
NEIGHBOURS = 5
"""Bands, half a decade. Those of a part with a corrugation of 20 dB are fewer."""
SHORT, OF_SHORT = 10e-3, 3
"""Nominal wavelength [m]: no corrugation has waves as short, and fewer bands are a burst."""
FALSE = 1e-3
"""Probability that a line of which parts are as rough as `NATURAL` has a burst."""
LEAST = 1e-10
"""Power in a band over that of the differences of all points: with less the windows leak."""
LONGEST = 3
"""Bands from which a burst is carried on to those of longer waves than windows have."""
OF_WHITE = 10**-0.3
"""Power of white noise in so many bands over that in as many of shorter waves."""
LITTLE = 0.25
"""Share of a burst in the power of a band of such waves, at the most, of which it is known."""
MOSTLY = 0.5
"""Of the points of a burst that are spikes and pits, from which on it is one without those that are left."""
MOST_OF_LINE = 1 / 3
"""Of the windows: beyond, the others are too few to tell what a burst changes."""


@dataclass(frozen=True, eq=False)
class Windows:
    """Of a line: the first point of each, their points, and the mean square in bands, (windows, bands) [m^2].

    freedom: nu of each band; floor: mean squares below which the step of the sensor or leakage is seen [m^2].
    """

    starts: NDArray[np.intp]
    points: int
    powers: FloatArray
    bands: NominalBands
    freedom: FloatArray
    floor: FloatArray

    @classmethod
    def of(cls, line: FloatArray, spacing: float, sensor: float, parts: int, waves: int = WAVES) -> "Windows | None":
        """None where a line is too short. sensor: the step to which it was rounded [m]; waves: in a band.

        Spectra are those of the differences of neighbours, which hardly leak, over |2 sin(q spacing / 2)|^2.
        """
        points = max(line.size // parts, FEWEST_POINTS)
        starts = np.append(np.arange(0, line.size - 1 - points, max(1, points // 2)), line.size - 1 - points)
        if starts[0] < 0 or starts.size < FEWEST_WINDOWS:
            return None
        steps = np.diff(line)
        steps = steps - steps.mean()
        window = np.sin(np.pi * (np.arange(points) + 0.5) / points) ** 2 * np.sqrt(8 / 3)
        cut = np.lib.stride_tricks.sliding_window_view(steps, points)[starts]
        squares = 2 * np.abs(np.fft.rfft(window * cut, axis=1)[:, 1:] / points) ** 2
        response = (2 * np.sin(np.pi * np.arange(1, squares.shape[1] + 1) / points)) ** 2
        bands = _bands(points * spacing, spacing, waves)
        if bands is None:
            return None
        ends = np.searchsorted(2 * np.pi * np.arange(1, squares.shape[1] + 1) / (points * spacing), bands.edges)
        summed = np.cumsum(np.concatenate([np.zeros((starts.size, 1)), squares / response], axis=1), axis=1)
        count = np.diff(ends)
        leaks = np.diff(np.cumsum(np.append(0.0, 1 / response))[ends]) * LEAST * float(steps.var())
        rounding = sensor**2 / 12 * count * 2 / points
        freedom = np.maximum(2 * count / OF_HANN, 1.0)
        return cls(starts, points, np.diff(summed[:, ends]), bands, freedom, np.maximum(leaks, rounding))

    @property
    def raised(self) -> NDArray[np.bool_]:
        """Bands of windows that are part of a burst."""
        found = np.zeros(self.powers.shape, dtype=bool)
        short = int(np.argmax(np.append(self.bands.nominal, 0.0) <= SHORT * (1 + 1e-9)))
        for count, first in ((NEIGHBOURS, 0), (OF_SHORT, short)):
            over = self._over((FALSE / self.powers.size) ** (1 / count))[:, first:]
            for i in range(over.shape[1] - count + 1):
                found[:, first + i : first + i + count] |= over[:, i : i + count].all(axis=1, keepdims=True)
        return found

    @property
    def excess(self) -> FloatArray:
        """Mean square of each window that is part of a burst, over the median in the bands of the burst [m^2].

        Windows beside them are part of it as far as their powers there are more than half of `NATURAL` of the median,
        in the geometric mean.
        """
        raised, usual = self.raised, np.maximum(np.median(self.powers, axis=0), self.floor)
        bands, inside = raised.any(axis=0), raised.any(axis=1)
        if not inside.any():
            return np.zeros(inside.size)
        ratio = np.log(np.maximum(self.powers, 1e-300) / np.maximum(usual, 1e-300))[:, bands]
        number, _ = scipy.ndimage.label(inside | (ratio.mean(axis=1) > np.log(NATURAL / 2)))
        burst = np.isin(number, number[inside])
        return np.where(burst, np.maximum(self.powers - usual, 0.0)[:, bands].sum(axis=1), 0.0)

    def _over(self, p: float) -> NDArray[np.bool_]:
        """Bands of windows with more power than a part as rough as `NATURAL` has but for a probability."""
        chi2 = scipy.stats.chi2
        most = NATURAL * chi2.isf(p, self.freedom) / chi2.median(self.freedom)
        return np.asarray(self.powers > most * np.maximum(np.median(self.powers, axis=0), self.floor))

    def touched(self, bursts: tuple[Outlier, ...]) -> NDArray[np.bool_]:
        """Windows that have points of bursts."""
        ends = self.starts + self.points
        return np.asarray(np.any([(self.starts <= one.last) & (ends > one.first) for one in bursts], axis=0))


def _bands(window: float, spacing: float, waves: int) -> NominalBands | None:
    """One-third octaves of so many waves in a window and of 2.5 points a wave, at the least; None for too few."""
    share = 10**0.05 - 10**-0.05
    try:
        bands = NominalBands().within(min(2.0, window * share / waves), max(10 ** (SHORTEST / 10), 2.5 * spacing))
    except ValueError:
        return None
    return bands if len(bands) >= OF_SHORT else None


def bursts_of(line: FloatArray, measured: FloatArray, spacing: float, sensor: float) -> tuple[Outlier, ...]:
    """Of a line without other outliers [m], in the order of their places; their size is the rms of what is raised.

    measured: the same line with its spikes and pits [m], many of which may be those of a burst: it goes as far as they
    raise the windows beside it, and where most of its points are replaced it is a burst without these.
    """
    square, replaced = _squares(line, spacing, sensor), line != measured
    if not square.any() and replaced.mean() < MOSTLY / max(PARTS):
        return ()
    both = np.maximum(square, _squares(measured, spacing, sensor))
    number, count = scipy.ndimage.label(both > 0)
    found = []
    for (part,) in scipy.ndimage.find_objects(number, count):
        if square[part].any() or replaced[part].mean() > MOSTLY:
            found.append(Outlier("burst", part.start, part.stop - 1, float(np.sqrt(both[part].max()))))
    return tuple(found)


def _squares(line: FloatArray, spacing: float, sensor: float) -> FloatArray:
    """`Windows.excess` of the windows of a point, the largest [m^2]."""
    square = np.zeros(line.size)
    for parts in PARTS:
        if (windows := Windows.of(line, spacing, sensor, parts)) is not None:
            excess = windows.excess
            for i in np.flatnonzero(excess):
                inside = slice(windows.starts[i], windows.starts[i] + windows.points + 1)
                square[inside] = np.maximum(square[inside], excess[i])
    return square


def left_by_bursts(
    line: FloatArray, spacing: float, bursts: tuple[Outlier, ...], bands: NominalBands
) -> tuple[FloatArray, FloatArray]:
    """What bursts add to the mean square in each band, over that without them, and the half-width of 95 % of this.

    R_b - 1, where R_b is the mean of P_wb with the weight of each window in the spectrum of the whole line, sin^4, over
    that of windows without bursts. Its standard deviation is that of P_wb among these, or sqrt(2 / nu) of P_wb where it
    is larger, times the root of the sum of the squares of the differences of both weights.

    In bands of longer waves than windows have, the burst is taken for noise whose power falls from band to band as in
    the longest that they have, no faster than that of white noise; it is its own half-width. Where this is more than
    `LITTLE` of a band, R_b is the largest of these. To all come the products of waves of both, 2 sqrt(4 (R_b - 1) / nu)
    of a band of the whole line.

    Raises ValueError for a line in which no burst can be, or that has nothing else.
    """
    windows = Windows.of(line, spacing, 0.0, PARTS[0], FEWEST_WAVES)
    if windows is None or (inside := windows.touched(bursts)).all():
        raise ValueError(f"bursts must be those of a part of the line, got {len(bursts)} in {line.size} points")
    at = (windows.starts + windows.points / 2) / line.size
    all_of_it, rest = np.sin(np.pi * at) ** 4, (~inside).astype(np.float64)
    all_of_it, rest = all_of_it / all_of_it.sum(), rest / rest.sum()
    without = np.maximum(rest @ windows.powers, 1e-300)
    scatter = np.maximum(windows.powers[~inside].std(axis=0) / without, np.sqrt(2 / windows.freedom))
    ratio = np.maximum(all_of_it @ windows.powers / without - 1, 0.0)
    own, most = bands.powers_of_records(line, spacing=spacing), float(ratio[:LONGEST].max())
    power = [max(float(np.mean((ratio * without)[i : i + LONGEST])), 1e-300) for i in (0, LONGEST)]
    fall = min(max(power[0] / power[1], OF_WHITE), 1.0) if len(ratio) > LONGEST else 1.0
    beyond = np.maximum(np.array(bands.numbers) - windows.bands.longest + LONGEST // 2, 0)
    share = power[0] * fall ** (beyond / LONGEST) / own
    little = share < LITTLE
    added = np.where(little, share / (1 - np.minimum(share, LITTLE)), most)
    half_width = np.where(little, added, 0.0)
    shorter = np.searchsorted(-np.array(bands.numbers), -windows.bands.longest)
    known = slice(max(0, windows.bands.longest - bands.longest), None)
    added[shorter:] = ratio[known][: len(bands) - shorter]
    half_width[shorter:] = 2 * (scatter * np.sqrt(np.sum((all_of_it - rest) ** 2)))[known][: len(bands) - shorter]
    freedom = np.maximum(2 / OF_HANN * np.diff(bands.edges) / (2 * np.pi) * line.size * spacing, 1.0)
    return added, half_width + 4 * np.sqrt(added / freedom)
