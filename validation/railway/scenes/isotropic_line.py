"""The line of isotropic ground that is nearest to levels, and what levels that scatter leave of it.

Levels of measured lines scatter from band to band, and Abel's inverse takes their differences: hardly any isotropic
surface has them as they are. Levels that rise too steeply, or stand out of their neighbours, no isotropic surface has.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.analysis.statistics import FloatArray
from validation.railway.scenes.graduation import graduated, scatter_of
from validation.railway.scenes.roughness_levels import MICROMETRE, RoughnessLevels, line_of_powers
from validation.railway.theory.line_spectrum import LineSpectrum
from validation.railway.theory.transverse_structure import has_isotropic_surface

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
    """line: of isotropic ground; whole: the same with the levels that stand out above it.

    smoother: the line smoothed twice more; slope_error: 95 % half-width of the exponent of q in each band [-]; scatter:
    of the levels about a smooth line [dB]; apart: of each level from the line [dB]; stands_out: bands in which no
    isotropic ground has the level.
    """

    line: LineSpectrum
    whole: LineSpectrum
    smoother: LineSpectrum
    slope_error: FloatArray
    scatter: float
    apart: FloatArray
    stands_out: NDArray[np.bool_]

    @property
    def as_it_is(self) -> bool:
        """Whether isotropic ground has the levels."""
        return self.line is self.whole


def isotropic_line(levels: RoughnessLevels, weights: ArrayLike) -> IsotropicLine:
    """Levels as they are where isotropic ground has them and they scatter by no more than whole decibels; else smooth.

    weights: of the levels, as the number of their waves but for a factor. A band whose level rises too steeply for
    isotropic ground, or stands out of its neighbours, is no part of the line.
    """
    bands, given = levels.bands, np.array(levels.levels)
    line, none = levels.c_line, np.zeros(len(bands))
    if has_isotropic_surface(line) and scatter_of(given) <= WHOLE_DECIBELS:
        return IsotropicLine(line, line, line, none, 0.0, none, none > 0)

    def of(some: FloatArray) -> LineSpectrum:
        return line_of_powers(bands, MICROMETRE**2 * 10 ** (some / 10))

    smooth = graduated(given, weights, least=LEAST_SCATTER)
    line, smoother = (_falling(of(some)) for some in (smooth.values, smooth.hat @ smooth.hat @ smooth.values))
    ground = 10 * np.log10(bands.powers_of_spectrum(line) / MICROMETRE**2)
    apart, scatter = given - ground, smooth.scatter / np.sqrt(smooth.of_values)
    too_steep = np.abs(smooth.values - ground) > LEAST_SCATTER
    out = too_steep | (np.abs(apart) > np.maximum(STANDS_OUT * scatter, HALF_POWER))
    whole = of(np.where(out & (apart > 0), given, ground))
    rms = float(np.sqrt(np.mean(apart[~out] ** 2))) if not out.all() else 0.0
    return IsotropicLine(line, whole, smoother, smooth.slope_error(REACH), rms, apart, out)


def _falling(line: LineSpectrum) -> LineSpectrum:
    """The line itself where isotropic ground has it, else one that nowhere rises: at its top to longer waves."""
    if has_isotropic_surface(line):
        return line
    density = np.array(line.densities)
    top = int(np.argmax(density))
    density[:top] = density[top]
    return LineSpectrum.through(line.wavenumbers, np.minimum.accumulate(density))
