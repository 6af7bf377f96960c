"""What may be asked of a scene: a quantity, its unit, and how it is judged."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class SceneQuantity:
    """A quantity that scenes have.

    key: in scripts, on the command line and in files; unit: of its amplitude; reference: of its decibels, in SI units;
    in_bands: whether it is a level in each one-third octave, else one number; of_motion: whether the wheel has to move;
    by_worst_band: whether a tolerance holds in each band that counts, else over the root mean square of all;
    counted_above: level above which a band counts [dB].
    """

    key: str
    unit: str
    reference: float = 1.0
    in_bands: bool = False
    of_motion: bool = False
    by_worst_band: bool = False
    counted_above: float = -math.inf

    def __str__(self) -> str:
        return self.key


STIFFNESS = SceneQuantity("stiffness", "N/m")
FORCE_RMS = SceneQuantity("force-rms", "N")
FORCE_SPECTRUM = SceneQuantity("force-spectrum", "N", in_bands=True)
ACCELERATION = SceneQuantity("acceleration", "m/s²", in_bands=True, of_motion=True)
ACCELERATION_RMS = SceneQuantity("acceleration-rms", "m/s²", of_motion=True)
PRESSED = (STIFFNESS,)
ROLLING = (FORCE_RMS, FORCE_SPECTRUM)
MOVING = (ACCELERATION, ACCELERATION_RMS)
