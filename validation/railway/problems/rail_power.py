"""Sound power of a wheel on a rail by a contact filter, and what errors of the filter leave of it.

Errors are carried band by band: of wavelength to bands of frequency, and from there to the sum in dB(A). All bands are
taken to be off the same way, which is an upper bound.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from validation.engine.engine import FloatArray
from validation.railway.scenes.rail import SOUND_POWER, RailScene
from validation.railway.theory.sound_power import in_frequency, weighted_total, weighting

SMALL = 1e-3
"""Change of a band [dB], of which the change of the sum is taken."""


@dataclass(frozen=True, eq=False)
class RailPower:
    """scene: with a speed; a3: contact filter in the bands of its roughness [dB]."""

    scene: RailScene
    a3: FloatArray

    @cached_property
    def level(self) -> FloatArray:
        """L_W of wheel and track together, one-third octaves of frequency [dB re 1 pW]; NaN without roughness."""
        return self.by_filter(self.a3)

    @property
    def weighted(self) -> FloatArray:
        """A-weighted [dB(A) re 1 pW]."""
        return np.asarray(self.level + weighting())

    @property
    def total(self) -> float:
        """Sum of the A-weighted energies [dB(A) re 1 pW]."""
        return weighted_total(self.level)

    def by_filter(self, a3: FloatArray) -> FloatArray:
        """As `level`, by another filter."""
        scene = self.scene
        assert scene.speed is not None  # or there is no sound power
        equivalent = in_frequency(scene.roughness_levels + a3, scene.levels.bands.nominal, scene.speed)
        return np.asarray(equivalent + scene.sound_transfer.of_both)

    def half_widths(self, error: FloatArray) -> FloatArray:
        """Of each band of frequency, of half-widths of A3 [dB]; infinite where one of these is."""
        return np.asarray(self.by_filter(self.a3 + error) - self.level)

    def error_of_total(self, error: FloatArray) -> float:
        """Half-width of the sum, of half-widths of A3 [dB].

        Waves shorter than all of known error pass between nothing and what the filter lets pass of the last of those at
        the most. Infinite where no error is known, or none of a longer wave.
        """
        known = np.flatnonzero(np.isfinite(error))
        if not known.size or known.size <= known[-1]:
            return math.inf
        last = int(known[-1])
        most, least = self.a3 + error, self.a3 - error
        most[last + 1 :] = np.maximum(self.a3[last + 1 :], most[last])
        least[last + 1 :] = -np.inf
        ends = [weighted_total(self.by_filter(a3)) for a3 in (most, least)]
        return float(np.abs(np.array(ends) - self.total).max())

    @cached_property
    def shares(self) -> FloatArray:
        """Share of each band of wavelength in the A-weighted sum [-]."""
        louder = np.eye(self.a3.size) * SMALL
        changes = np.array([weighted_total(self.by_filter(self.a3 + change)) for change in louder]) - self.total
        return np.asarray(changes / max(changes.sum(), 1e-300))

    @property
    def amplitude(self) -> FloatArray:
        """Root of the sound power over 1 pW in each band [-]."""
        return np.asarray(10 ** (self.level / 20))


def asks_for_power(quantity: str) -> bool:
    return quantity == str(SOUND_POWER)
