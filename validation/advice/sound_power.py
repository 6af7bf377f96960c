"""What each contact filter of a comparison is worth to the ear: sound power of wheel and track, A-weighted.

Beside it, in files alone and for one release, the A-weighted force of a wheel at a constant height.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.advice.tolerance import NAMES, Columns
from validation.analysis.number_text import NONE, half_width_text, signed
from validation.analysis.spectra import energy_sum
from validation.engine.engine import FloatArray

LEVELS = "L_r: roughness, A3: contact filter, L_eq = L_r + A3: equivalent roughness [dB re 1 µm]"


@dataclass(frozen=True, eq=False)
class WeightedLevels:
    """levels: A-weighted, in each band, by model, the chosen first; NaN where a model has none."""

    levels: Mapping[str, FloatArray]

    @property
    def chosen(self) -> str:
        return next(iter(self.levels))

    def total(self, model: str) -> float:
        """Sum over the bands in which a model has a level [dB(A)]."""
        level = self.levels[model]
        finite = np.isfinite(level)
        return energy_sum(level[finite]) if finite.any() else math.nan

    def over_chosen(self, model: str) -> float:
        """The sum of another filter over that of the chosen, of bands that both have [dB]."""
        levels, chosen = self.levels[model], self.levels[self.chosen]
        both = np.isfinite(levels) & np.isfinite(chosen)
        return energy_sum(levels[both]) - energy_sum(chosen[both]) if both.any() else math.nan


@dataclass(frozen=True, eq=False)
class ContactForce(WeightedLevels):
    """Force of a wheel that rolls at a constant height, by each filter: F = k times the equivalent displacement.

    Its levels are A-weighted at f = v / lambda in each band [dB re 1 N]. A force has the wrong weight, also for
    differences of filters: its A-weighted energy lies at longer waves than that of sound power, `SoundPower`.
    """


@dataclass(frozen=True, eq=False, kw_only=True)
class SoundPower(WeightedLevels):
    """Sound power of wheel and track by each filter, A-weighted in one-third octaves of frequency [dB re 1 pW].

    error: half-width of 95 % of the sum of the chosen [dB]; speed: [m/s]; of: track, wheel and axles in words; missing:
    bands without roughness, in words, empty where there are none.
    """

    error: float
    speed: float
    of: str
    missing: str = ""

    @property
    def shown(self) -> str:
        """The sum of the chosen, with its error."""
        return f"{self.total(self.chosen):.1f} {half_width_text(self.error)} dB(A) re 1 pW"

    @property
    def change(self) -> str:
        """What another filter changes, in words."""
        changes = [change for model in self.levels if math.isfinite(change := self.over_chosen(model))]
        if not changes[1:]:
            return "no other filter was solved"
        ends = dict.fromkeys(map(partial(signed, digits=1), (min(changes[1:]), max(changes[1:]))))
        return f"another filter changes the sum by {' to '.join(ends)} dB(A)"

    @property
    def sentences(self) -> tuple[str, str]:
        """The sum with its error, and what was summed."""
        left_out = f", but for {self.missing} without roughness" if self.missing else ""
        return (
            f"sound power at {3.6 * self.speed:.4g} km/h: {self.shown} by {self.chosen}; {self.change}",
            f"what is summed: L_W = L_eq + G-3 in one-third octaves of frequency, f = v / lambda, 50 Hz to 10 kHz"
            f"{left_out}, track and wheel as energies, A-weighted by IEC 61672-1; G-3a and G-3b of CNOSSOS-EU "
            f"(2021/1226): {self.of}; they contain the mobilities of their own track and wheel",
        )

    @property
    def table(self) -> Columns:
        """A row a filter: its sum, and by how much that is over the chosen."""
        changes = [signed(self.over_chosen(model), 1) for model in self.levels if model != self.chosen]
        sums = [f"{self.total(model):.1f}" for model in self.levels]
        return {NAMES: list(self.levels), "sum [dB(A) re 1 pW]": sums, "over the chosen [dB]": [NONE, *changes]}
