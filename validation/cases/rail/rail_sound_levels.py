"""Levels of the sounds of a rail: A-weighted, in three ranges and in one-third octaves, and over boundary elements."""

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import Table, table_of
from validation.analysis.sound import a_weighting, filtered, powers_of_blocks
from validation.analysis.spectra import KILOHERTZ, Bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknifed
from validation.cases.rail.rail_sound import LABELS, RailSoundResult
from validation.simulation.equivalent_displacement import BEM

FloatArray = NDArray[np.float64]

WEIGHTED, LOW = "A-weighted", "below the band"
LONG, SHORT = "in waves longer than the contact", "in waves shorter than the contact"
SILENT = -30.0
"""dB over boundary elements; a model that is quieter still counts as this."""
LOWEST, FEWEST_WAVES = 20.0, 5
"""First frequency of one-third octaves [Hz], and waves of a period below it."""
SHOWN = 0.02
"""Seconds of the waveforms that are drawn."""
LEAST = -40.0
"""dB re 1 N: of 0.01 N, a tenth of the last digit of the samples."""


class SoundLevels:
    """Of one result."""

    def __init__(self, result: RailSoundResult):
        self.result, self.case = result, result.case

    @cached_property
    def frequency(self) -> FloatArray:
        """Of the waves of a period [Hz]."""
        return np.asarray(np.fft.rfftfreq(self.case.samples, 1 / self.case.rate))

    @cached_property
    def gains(self) -> dict[str, FloatArray]:
        """A-weighting, and the three ranges: 1 inside, 0 outside."""
        f, (first, last) = self.frequency, self.case.band
        ranges = {LOW: (0.0, first), LONG: (first, self.case.of_contact), SHORT: (self.case.of_contact, last)}
        weight = 10 ** (a_weighting(np.maximum(f, f[1])) / 20)
        inside = {name: ((f > low) & (f < high)).astype(np.float64) for name, (low, high) in ranges.items()}
        return {WEIGHTED: weight, **{name: gain for name, gain in inside.items() if gain.any()}}

    def level(self, model: str, part: str | None = None) -> float:
        """dB re 1 N; of all frequencies where no part is named."""
        signal = self.result.signal(model)
        return decibels(float(np.mean((signal if part is None else filtered(signal, self.gains[part])) ** 2)))

    def share(self, model: str, part: str) -> float:
        """Of the mean square of the force [%]."""
        return 100 * 10 ** ((self.level(model, part) - self.level(model)) / 10)

    def over(self, model: str, part: str, reference: str = BEM) -> tuple[Estimate, float]:
        """Level over that of the reference on the same strip, and what the grid leaves of it, to first order [dB]."""
        coarse, fine = self.case.cells
        found, before = (self._ratio(model, reference, part, cells) for cells in (fine, coarse))
        return found, abs(found.value - before.value) * coarse / (fine - coarse)

    def _ratio(self, model: str, reference: str, part: str, cells: int) -> Estimate:
        """By the jackknife over pieces of the strip."""
        powers = [
            powers_of_blocks(filtered(self.result.signals[name, cells], self.gains[part]), self.case.blocks)
            for name in (model, reference)
        ]

        def ratio(rows: FloatArray) -> FloatArray:
            mine, other = rows.sum(axis=0)
            return np.atleast_1d(max(decibels(mine / other), SILENT))

        return jackknifed(ratio, np.stack(powers, axis=1))[0]

    @cached_property
    def bands(self) -> Bands:
        """One-third octaves of frequency, in rad/s."""
        first = max(LOWEST, FEWEST_WAVES * self.case.rate / self.case.samples)
        return Bands.around(KILOHERTZ, 2 * math.pi * first, 2 * math.pi * min(self.case.band[1], self.case.rate / 2))

    def in_bands(self, model: str) -> FloatArray:
        """dB re 1 N."""
        found = waves(self.result.signal(model), spacing=1 / self.case.rate)
        return np.array([decibels(2 * power) for power in levels(found, self.bands)])

    def bands_table(self) -> Table:
        """A row a band; a level below that of the samples' last digit is left empty."""
        columns: dict[str, list[object]] = {"f [Hz]": (self.bands.centres / (2 * math.pi)).tolist()}
        for model in self.case.sounding:
            found = self.in_bands(model)
            columns[f"{LABELS[model]} [dB re 1 N]"] = np.where(found > LEAST, np.round(found, 2), np.nan).tolist()
        return Table("levels", columns)

    def sounds_table(self) -> Table:
        """A row a model: its levels, and over boundary elements where these are heard."""
        rows = []
        for model in self.case.sounding:
            row: dict[str, object] = {
                "model": LABELS[model],
                "level [dB re 1 N]": round(self.level(model), 2),
                "A-weighted [dB re 1 N]": round(self.level(model, WEIGHTED), 2),
                "largest [N]": round(float(np.abs(self.result.signal(model)).max()), 1),
                "full scale [N]": self.result.full_scale,
                "samples a second": self.case.rate,
            }
            if BEM in self.case.sounding:
                found, grid = self.over(model, WEIGHTED)
                row |= {
                    "A-weighted over boundary elements [dB]": round(found.value, 2),
                    "± [dB]": round(found.half_width + grid, 2),
                }
            rows.append(row)
        return table_of("sounds", rows)

    def frequencies_table(self) -> Table:
        """Ends of the ranges."""
        names = ("first wave of the band", "last wave of the band", "wave as long as the contact")
        return Table("frequencies", {"what": names, "f [Hz]": (*self.case.band, self.case.of_contact)})

    def samples_table(self) -> Table:
        """A column a model, to a tenth of a newton."""
        return Table(
            "samples",
            {column_of(model): np.round(self.result.signal(model), 1).tolist() for model in self.case.sounding},
        )

    def waveforms_table(self) -> Table:
        """The first samples, at their times."""
        shown = {name: column[: round(SHOWN * self.case.rate)] for name, column in self.samples_table().columns.items()}
        time = 1000 * np.arange(len(next(iter(shown.values())))) / self.case.rate
        return Table("waveforms", {"t [ms]": time.tolist(), **shown})


def column_of(model: str) -> str:
    """Of the table of samples."""
    return f"{LABELS[model]} [N]"


def decibels(power: float) -> float:
    """-300 dB where there is none."""
    return POWER_DECIBEL * math.log(max(power, 1e-30))
