"""The A-weighted force of a wheel at a constant height, by each contact filter of a comparison."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from validation.advice.tolerance import NAMES, Columns
from validation.analysis.number_text import NONE, half_width_text, signed
from validation.analysis.spectra import energy_sum
from validation.engine.engine import FloatArray

LEVELS = (
    "L_r: roughness, A3: contact filter, L_eq = L_r + A3: equivalent roughness [dB re 1 µm]; L_FA: contact force, "
    "A-weighted [dB re 1 N]"
)


@dataclass(frozen=True, eq=False)
class ContactForce:
    """Force of a wheel that rolls at a constant height, by each filter: F = k times the equivalent displacement.

    levels: A-weighted at f = v / lambda in each band, dB re 1 N, by model, the chosen first; half_width: of the chosen
    [dB]; stiffness: k = 3 F / (2 d) of the smooth contact [N/m]; speed: [m/s]; span: of the bands, in words.
    """

    levels: Mapping[str, FloatArray]
    half_width: FloatArray
    stiffness: float
    speed: float
    span: str

    @property
    def chosen(self) -> str:
        return next(iter(self.levels))

    def total(self, model: str) -> float:
        """Sum over the bands in which a model has a level [dB(A) re 1 N]."""
        level = self.levels[model]
        finite = np.isfinite(level)
        return energy_sum(level[finite]) if finite.any() else math.nan

    def over_chosen(self, model: str) -> float:
        """The sum of another filter over that of the chosen, of bands that both have [dB]."""
        levels, chosen = self.levels[model], self.levels[self.chosen]
        both = np.isfinite(levels) & np.isfinite(chosen)
        return energy_sum(levels[both]) - energy_sum(chosen[both]) if both.any() else math.nan

    @property
    def error(self) -> float:
        """Half-width of the chosen sum, all bands off the same way, but for those of unknown error [dB]."""
        level = self.levels[self.chosen]
        sure = np.isfinite(level) & np.isfinite(self.half_width)
        return energy_sum(level[sure] + self.half_width[sure]) - energy_sum(level[sure]) if sure.any() else math.inf

    @property
    def unsure(self) -> float:
        """Share of the energy of the chosen in bands of unknown error."""
        level = self.levels[self.chosen]
        powers = 10 ** (level[np.isfinite(level)] / 10)
        return float(powers[~np.isfinite(self.half_width[np.isfinite(level)])].sum() / powers.sum())

    @property
    def shown(self) -> str:
        """The sum of the chosen, with its error."""
        return f"{self.total(self.chosen):.1f} {half_width_text(self.error)} dB(A) re 1 N"

    @property
    def change(self) -> str:
        """What another filter changes, in words."""
        changes = [change for model in self.levels if math.isfinite(change := self.over_chosen(model))]
        if not changes[1:]:
            return "no other filter was solved"
        ends = dict.fromkeys(signed(end, 1) for end in (min(changes[1:]), max(changes[1:])))
        return f"another filter changes the sum by {' to '.join(ends)} dB(A)"

    @property
    def sentences(self) -> tuple[str, str]:
        """The sum with its error, and what was weighted."""
        without = f", but for bands of unknown error, {100 * self.unsure:.2g} % of its energy" if self.unsure else ""
        missing = int((~np.isfinite(self.levels[self.chosen])).sum())
        left_out = f", but for {missing} without an answer" if missing else ""
        return (
            f"A-weighted contact force at {3.6 * self.speed:.4g} km/h: {self.shown} by {self.chosen}{without}; "
            f"{self.change}",
            "what is weighted: the force at a constant height, k times the equivalent displacement, whose level is "
            f"L_eq, with k = 3 F / (2 d) = {self.stiffness / 1e9:.3g} GN/m of the smooth contact, at f = v / lambda, "
            f"by the A-weighting of IEC 61672-1, summed over bands of {self.span}{left_out}; no mobility of "
            "wheel or track, no radiation",
        )

    @property
    def table(self) -> Columns:
        """A row a filter: its sum, and by how much that is over the chosen."""
        changes = [signed(self.over_chosen(model), 1) for model in self.levels if model != self.chosen]
        sums = [f"{self.total(model):.1f}" for model in self.levels]
        return {NAMES: list(self.levels), "sum [dB(A) re 1 N]": sums, "over the chosen [dB]": [NONE, *changes]}
