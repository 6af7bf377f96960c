"""What stands out of a mean spectrum of wheels with Hann's window: peak, jump, slope of region 3, its oscillation."""

import math

from validation.analysis import spectra as regions
from validation.analysis.statistics import FloatArray
from validation.scenes.rolling import RollingScene

PEAK, JUMP, SLOPE, PERIOD = NAMES = ("peak", "jump", "slope", "period")
THIRD_FIRST, THIRD_LAST, OSCILLATION_LAST = 1.1, 0.9, 0.5
"""Region 3 begins at this multiple of the jump, and ends at this of q_max v_0; the oscillation ends earlier, since
roughness at the edge of the contact smears it from the end."""
MIN_PERIODS = 3
PEAK_LAST, FREE_MASS = 1.5, 3.0
"""Over the eigenfrequency: a jump below the first is part of the peak; above the second the wheel moves as a free mass,
and power laws of the force are those of the acceleration."""


def third_region(scene: RollingScene, jump: float) -> tuple[float, float]:
    """Where region 3 is looked at, clear of its ends and of the resonance."""
    return max(THIRD_FIRST * jump, FREE_MASS * scene.eigenfrequency), THIRD_LAST * scene.cutoff


def features_of(scene: RollingScene, omega: FloatArray, hann: FloatArray) -> dict[str, float]:
    """Features that the band of the scene can hold: a jump above the peak, enough periods of the oscillation."""
    between, period = math.sqrt(scene.eigenfrequency * scene.jump), scene.oscillation_period
    has_jump = scene.jump > PEAK_LAST * scene.eigenfrequency
    values = {PEAK: regions.peak(omega, hann, between if has_jump else PEAK_LAST * scene.eigenfrequency)}
    if has_jump:
        values[JUMP] = regions.jump(omega, hann, between, 0.5 * scene.cutoff)
    first, last = third_region(scene, values.get(JUMP, scene.jump))
    if last - first >= MIN_PERIODS * period:
        values[SLOPE] = regions.slope(omega, hann, first, last, period)
        values[PERIOD] = regions.oscillation_period(omega, hann, first, OSCILLATION_LAST * scene.cutoff, MIN_PERIODS)
    return values
