"""The line of isotropic ground that is nearest to levels, and what levels that scatter leave of it.

Levels of measured lines scatter from band to band, and Abel's inverse takes their differences: hardly any isotropic
surface has them as they are. Levels that rise too steeply, or stand out of their neighbours, no isotropic surface has.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.analysis.statistics import FloatArray, student
from validation.railway.scenes.level_files import MICROMETRE, RoughnessLevels, line_of_powers
from validation.railway.theory.transverse_structure import LineSpectrum, has_isotropic_surface

STIFFNESS = 10.0
"""Of the graduation: half of a wave of 11 values is left, a decade of one-third octaves."""
FEWEST = 5
"""Values that tell scatter from a shape."""
OF_MEDIAN, EFFICIENCY = 1.4826, 0.37
"""Standard deviation of a Gaussian over its median deviation, and share of the values that this is worth."""
ROBUST, REDESCENDING, LONE = 10, 20, 3.0
"""Steps with Huber's weights and with Tukey's, and deviations beyond which a value has no weight at all."""


@dataclass(frozen=True, eq=False)
class Graduation:
    """values: smooth, shape (n,); hat: (n, n), from the series to them; scatter: of a value of weight one.

    A straight line is its own graduation. of_values: weights of the series, as given.
    """

    values: FloatArray
    hat: FloatArray
    scatter: float
    of_values: FloatArray

    @cached_property
    def quantile(self) -> float:
        """Of 95 %: Student's, of the degrees of freedom that a median deviation has."""
        free = EFFICIENCY * max(len(self.values) - float(np.trace(self.hat)), 1.0)
        return student(free)

    def slope_error(self, reach: int) -> FloatArray:
        """95 % half-width of the mean slope from each value to the one `reach` later, or to the last, shape (n,)."""
        last = len(self.values) - 1
        starts = np.minimum(np.arange(last + 1), last - 1)
        ends = np.minimum(starts + reach, last)
        spread = (self.hat[ends] - self.hat[starts]) / np.sqrt(self.of_values) / (ends - starts)[:, np.newaxis]
        return np.asarray(self.quantile * self.scatter * np.sqrt((spread**2).sum(axis=1)))


def graduated(series: ArrayLike, weights: ArrayLike, *, least: float) -> Graduation:
    """Whittaker's graduation: the least sum w (y - z)^2 + stiffness (second differences of z)^2, by robust weights.

    series: evenly spaced, shape (n,); weights: of its values, positive, as 1 / variance but for a factor; least: of the
    scatter of a value of weight one, positive: the less, the more a bend stands out. A value that stands out loses its
    weight, by Tukey's rule, from a start by Huber's. Fewer than `FEWEST` are left as they are, without scatter.
    Source: Whittaker, Proc. Edinburgh Math. Soc. 41 (1923) 63; Huber, Robust Statistics.
    """
    y, prior = np.asarray(series, dtype=np.float64), np.asarray(weights, dtype=np.float64)
    if len(y) < FEWEST:
        return Graduation(y, np.eye(len(y)), 0.0, prior)
    bent = np.diff(np.eye(len(y)), 2, axis=0)
    weight = prior
    for step in range(ROBUST + REDESCENDING + 1):
        hat = np.asarray(
            np.linalg.solve(np.diag(weight) + STIFFNESS * bent.T @ bent, np.diag(weight)), dtype=np.float64
        )
        deviation = np.sqrt(prior) * (y - hat @ y)
        free = max(len(y) - float(np.trace(hat)), 1.0)
        scatter = max(OF_MEDIAN * float(np.median(np.abs(deviation))) * np.sqrt(len(y) / free), least)
        off = np.abs(deviation) / scatter
        left = 1 / np.maximum(off, 1) if step < ROBUST else np.clip(1 - (off / LONE) ** 2, 1e-6, None) ** 2
        weight = prior * left
    return Graduation(hat @ y, hat, float(scatter), prior)


def scatter_of(series: ArrayLike) -> float:
    """Standard deviation of a series about any smooth one, by the median of its second differences."""
    y = np.asarray(series, dtype=np.float64)
    return OF_MEDIAN * float(np.median(np.abs(np.diff(y, 2)))) / 6**0.5 if len(y) > 2 else 0.0


WHOLE_DECIBELS = 0.3
"""Scatter of levels that are rounded to them [dB]: with no more, a line of isotropic ground is left as it is."""
LEAST_SCATTER = 1.0
"""Of levels that are smoothed [dB]."""
STANDS_OUT, HALF_POWER = 3.0, 3.0
"""Deviation of a level that stands out, in standard deviations, and the least [dB]: half of the power is another's."""
REACH = 5
"""Bands to shorter waves, by half a decade, over which isotropic ground takes the slope of the levels."""


@dataclass(frozen=True, eq=False)
class IsotropicLine:
    """line: of isotropic ground; with_peaks: the same with the levels that stand out above it.

    smoother: the line smoothed twice more; slope_error: 95 % half-width of the exponent of q in each band [-]; scatter:
    of the levels about a smooth line [dB]; deviation: of each level from the line [dB]; stands_out: bands in which no
    isotropic ground has the level.
    """

    line: LineSpectrum
    with_peaks: LineSpectrum
    smoother: LineSpectrum
    slope_error: FloatArray
    scatter: float
    deviation: FloatArray
    stands_out: NDArray[np.bool_]

    @property
    def as_it_is(self) -> bool:
        """Whether isotropic ground has the levels."""
        return self.line is self.with_peaks


def isotropic_line(levels: RoughnessLevels, weights: ArrayLike) -> IsotropicLine:
    """Levels as they are where isotropic ground has them and they scatter by no more than whole decibels; else smooth.

    weights: of the levels, as the number of their waves but for a factor. A band whose level rises too steeply for
    isotropic ground, or stands out of its neighbours, is no part of the line.
    """
    bands, level = levels.bands, np.array(levels.levels)
    line, none = levels.c_line, np.zeros(len(bands))
    if has_isotropic_surface(line) and scatter_of(level) <= WHOLE_DECIBELS:
        return IsotropicLine(line, line, line, none, 0.0, none, none > 0)

    def spectrum_of(values: FloatArray) -> LineSpectrum:
        return line_of_powers(bands, MICROMETRE**2 * 10 ** (values / 10))

    smooth = graduated(level, weights, least=LEAST_SCATTER)
    line, smoother = (
        _nowhere_rising(spectrum_of(values)) for values in (smooth.values, smooth.hat @ smooth.hat @ smooth.values)
    )
    ground = 10 * np.log10(bands.powers_of_spectrum(line) / MICROMETRE**2)
    deviation, scatter = level - ground, smooth.scatter / np.sqrt(smooth.of_values)
    too_steep = np.abs(smooth.values - ground) > LEAST_SCATTER
    out = too_steep | (np.abs(deviation) > np.maximum(STANDS_OUT * scatter, HALF_POWER))
    with_peaks = spectrum_of(np.where(out & (deviation > 0), level, ground))
    rms = float(np.sqrt(np.mean(deviation[~out] ** 2))) if not out.all() else 0.0
    return IsotropicLine(line, with_peaks, smoother, smooth.slope_error(REACH), rms, deviation, out)


def _nowhere_rising(line: LineSpectrum) -> LineSpectrum:
    """The line itself where isotropic ground has it, else one that nowhere rises: at its top to longer waves."""
    if has_isotropic_surface(line):
        return line
    density = np.array(line.densities)
    top = int(np.argmax(density))
    density[:top] = density[top]
    return LineSpectrum.through(line.wavenumbers, np.minimum.accumulate(density))
