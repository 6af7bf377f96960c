"""Numbers and tables of the input spectrum: linear theory, springs beside boundary elements, the punches."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.statistics import (
    POWER_DECIBEL,
    Estimate,
    Sample,
    at_level,
    log_mean,
    nearest,
    paired_samples,
    sample,
)
from validation.cases.rolling.force_spectrum_levels import ROUNDING, level_1d, level_3d, over_exact, ratio_of_pairs
from validation.cases.rolling.force_spectrum_numbers import ONE_DECIBEL, REASON
from validation.cases.rolling.input_spectrum import RollingInput, RollingInputResult
from validation.engine.engine import random_generator
from validation.simulation.rolling_strip import BOOTSTRAP
from validation.simulation.track_spectrum import INPUT_SPECTRA, InputSpectrum

FloatArray = NDArray[np.float64]
Row = dict[str, object]

NAMES: dict[InputSpectrum, str] = {
    "geike": "Geike's spectrum",
    "line": "line trace",
    "rolling": "rolling-equivalent spectrum",
}
FORD_THOMPSON = 3.0
"""dB in one-third octaves: how near springs come to a 3D analysis. Ford and Thompson, J. Sound Vib. 293 (2006)."""
IN_BAND, WORST = "mean level in the band", "worst one-third octave but that of q a = π"
STIFFNESS = "mean stiffness of punches"
LINEAR, ONE_SIDED = "linear springs over linear 3D", "springs over bem3d"


def linear_bands(case: RollingInput) -> Table:
    """A row a spectrum and band: (14.12) over linear theory in 3D by input [dB], minus infinity where it is zero."""
    rows: list[Row] = []
    for name, spectrum in case.spectra.items():
        edges, inside, exact = case.bands.edges, case.inside(spectrum), level_3d(spectrum, case.bands)
        with np.errstate(divide="ignore", invalid="ignore"):
            errors = {rule: POWER_DECIBEL * np.log(level_1d(spectrum, rule, case.bands) / exact) for rule in NAMES}
        rows += [
            {
                "spectrum": name,
                "q a": float(case.bands.centres[i]),
                "in the band": bool(inside[i]),
                "first zero": bool(edges[i] < math.pi < edges[i + 1]),
                **{f"{NAMES[rule]} [dB]": float(errors[rule][i]) for rule in NAMES},
            }
            for i in case.below_the_end(spectrum)
        ]
    return table_of("bands", rows)


def linear_numbers(bands: Table, name: str) -> list[Number]:
    """The mean over the bands in that of a spectrum, and the worst of all bands but that of the first zero."""

    def number(quantity: str, rule: InputSpectrum, value: float, tolerance: float, reason: str) -> Number:
        return Number(
            quantity=quantity,
            model=LINEAR,
            where={"spectrum": name, "input": NAMES[rule]},
            value=value,
            reference=0.0,
            source="linear theory in 3D, by quadrature",
            tolerance=tolerance,
            unit="dB",
            reason=reason,
            role=Role.FINDING,
        )

    mine, numbers = bands.where(spectrum=name), []
    for rule in INPUT_SPECTRA:
        errors = mine[f"{NAMES[rule]} [dB]"]
        numbers.append(number(IN_BAND, rule, float(errors[mine["in the band"]].mean()), ONE_DECIBEL, REASON))
        worst = float(np.abs(errors[~mine["first zero"]]).max())
        if math.isfinite(worst):
            numbers.append(number(WORST, rule, worst, FORD_THOMPSON, "3 dB: Ford and Thompson (2006)"))
    return numbers


def bands_within(case: RollingInput, bands: Table) -> Table:
    """How many of the one-third octaves lie within 3 dB, by spectrum and input."""
    rows: list[Row] = []
    for name in case.spectra:
        mine = bands.where(spectrum=name)
        row: Row = {"spectrum": name}
        for rule in INPUT_SPECTRA:
            near = np.abs(mine[f"{NAMES[rule]} [dB]"]) <= FORD_THOMPSON
            for part, where in (("in the band", mine["in the band"]), ("below the band", ~mine["in the band"])):
                row[f"{NAMES[rule]}, {part}"] = f"{int(near[where].sum())} of {int(where.sum())}"
        rows.append(row)
    return table_of("within 3 dB", rows)


@dataclass(frozen=True)
class InputLevels:
    """Levels over one surface and height, of boundary elements and of springs with one input spectrum."""

    result: RollingInputResult
    spectrum: str
    height: float
    rule: InputSpectrum

    @cached_property
    def _samples(self) -> tuple[Sample, Sample]:
        """Springs; boundary elements and linear theory on the same surfaces, in pairs."""
        case, bem = self.result.case, self.result.bem[self.spectrum, self.height]
        springs = np.maximum(self.result.mdr[self.spectrum, self.height, self.rule]["level"], ROUNDING)
        key = list(case.spectra).index(self.spectrum), case.heights.index(self.height), INPUT_SPECTRA.index(self.rule)
        of_bem, of_springs = (random_generator(case.seed, BOOTSTRAP, *key, part) for part in (0, 1))
        return sample(springs, of_springs), paired_samples(bem["linear level"], bem["level"], of_bem)

    def both(self, weights: FloatArray) -> tuple[Estimate, Estimate]:
        """ln of springs and of boundary elements over linear theory in 3D."""
        (springs, pairs), case = self._samples, self.result.case
        exact = self.height**2 * level_3d(case.spectra[self.spectrum], case.bands)
        return over_exact(springs, exact, weights), ratio_of_pairs(pairs, weights)

    @property
    def number(self) -> Number:
        """Springs over boundary elements, in the mean over the bands in that of the spectrum."""
        inside = self.result.case.inside(self.result.case.spectra[self.spectrum])
        return difference(
            *self.both(inside / inside.sum()),
            quantity=IN_BAND,
            model=ONE_SIDED,
            where={"spectrum": self.spectrum, "h/d": self.height, "input": NAMES[self.rule]},
            source="bem3d, relative to linear theory on the same surfaces",
            tolerance=ONE_DECIBEL,
            reason=REASON,
        )


def rolled_bands(result: RollingInputResult, levels: list[InputLevels]) -> Table:
    """A row a spectrum, height and band: springs over boundary elements by input [dB]."""
    case, rows = result.case, []
    for name, height in result.bem:
        mine = [one for one in levels if (one.spectrum, one.height) == (name, height)]
        for i in case.below_the_end(case.spectra[name]):
            row: Row = {"spectrum": name, "h/d": height, "q a": float(case.bands.centres[i])}
            for one in mine:
                springs, bem = one.both(np.eye(len(case.bands.centres))[i])
                apart = springs.minus(bem)
                row[f"{NAMES[one.rule]} [dB]"] = POWER_DECIBEL * apart.value
                row[f"{NAMES[one.rule]} ± [dB]"] = POWER_DECIBEL * apart.half_width
            rows.append(row)
    return table_of("rolled", rows)


def stiffness_ratio(result: RollingInputResult, rule: InputSpectrum, force: int) -> Estimate:
    """ln of the mean stiffness of punches, springs over boundary elements, at the force of that index."""
    seed, springs = result.case.seed, result.profiles[rule]["stiffness"]
    of_springs = sample(springs, random_generator(seed, BOOTSTRAP, 90, INPUT_SPECTRA.index(rule)))
    of_bem = sample(result.punches["stiffness"], random_generator(seed, BOOTSTRAP, 91))
    return of_springs.estimate(at_level(force, log_mean)).minus(of_bem.estimate(at_level(force, log_mean)))


def punch_number(result: RollingInputResult, rule: InputSpectrum) -> Number:
    """The mean stiffness at Fbar = 0.1, as a part."""
    apart = stiffness_ratio(result, rule, nearest(result.case.forces, 0.1))
    return Number(
        quantity=STIFFNESS,
        model=ONE_SIDED,
        where={"Fbar": 0.1, "input": NAMES[rule]},
        value=math.expm1(apart.value),
        reference=0.0,
        source=f"bem3d on {result.case.punch_cells}² cells",
        tolerance=0.1,
        reason="10 %: grid error of Fig. 14.1 at this force",
        sample=math.exp(apart.value) * apart.half_width,
        role=Role.FINDING,
    )


def punches(result: RollingInputResult) -> Table:
    """The mean stiffness of springs over boundary elements, by input and force."""
    rows: list[Row] = []
    for rule in INPUT_SPECTRA:
        for level, force in enumerate(result.case.forces):
            middle, low, high = (math.exp(value) for value in stiffness_ratio(result, rule, level).interval)
            rows.append({"input": NAMES[rule], "Fbar": force, "mdr over bem3d": middle, "low": low, "high": high})
    return table_of("punches", rows)
