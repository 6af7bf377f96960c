"""Numbers and tables of the input spectrum: linear theory, springs beside boundary elements, the punches."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.over_range import root_mean_square, worst
from validation.analysis.statistics import POWER_DECIBEL, Estimate, log_ratio_of_means, nearest
from validation.cases.rolling.force_spectrum_levels import ROUNDING, level_1d, level_3d
from validation.cases.rolling.force_spectrum_numbers import (
    FORD_THOMPSON,
    LEVEL,
    ONE_DECIBEL,
    REPEATABLE,
    THREE_DECIBELS,
)
from validation.cases.rolling.input_spectrum import RollingInput, RollingInputResult
from validation.simulation.track_spectrum import INPUT_SPECTRA, InputSpectrum

FloatArray = NDArray[np.float64]
Row = dict[str, object]

NAMES: dict[InputSpectrum, str] = {
    "geike": "Geike's spectrum",
    "line": "line trace",
    "rolling": "rolling-equivalent spectrum",
}
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
    """(14.12) over linear theory in 3D in the band of a spectrum: the worst one-third octave, and the rms over all."""
    mine = bands.where(spectrum=name, **{"in the band": True})
    return [
        number
        for rule in INPUT_SPECTRA
        for number in judged(
            [
                Number(
                    quantity=LEVEL,
                    model=LINEAR,
                    where={"spectrum": name, "input": NAMES[rule], "q a": float(q)},
                    value=float(error),
                    reference=0.0,
                    source="linear theory in 3D, by quadrature",
                    tolerance=THREE_DECIBELS,
                    reason=FORD_THOMPSON,
                    unit="dB",
                    role=Role.FINDING,
                )
                for q, error in zip(mine["q a"], mine[f"{NAMES[rule]} [dB]"], strict=True)
            ]
        )
    ]


def judged(points: list[Number], alone: list[Number] | None = None) -> list[Number]:
    """The worst point; and the root mean square, of points whose intervals are those of one alone."""
    return [worst(points, "q a"), root_mean_square(alone or points, "q a", ONE_DECIBEL, REPEATABLE)]


def bands_within(case: RollingInput, bands: Table) -> Table:
    """How many of the one-third octaves lie within 3 dB, by spectrum and input."""
    rows: list[Row] = []
    for name in case.spectra:
        mine = bands.where(spectrum=name)
        row: Row = {"spectrum": name}
        for rule in INPUT_SPECTRA:
            near = np.abs(mine[f"{NAMES[rule]} [dB]"]) <= THREE_DECIBELS
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

    def both(self, weights: FloatArray) -> tuple[Estimate, Estimate]:
        """ln of springs and of boundary elements over linear theory in 3D."""
        case, bem = self.result.case, self.result.bem[self.spectrum, self.height]
        exact = self.height**2 * level_3d(case.spectra[self.spectrum], case.bands)
        springs = np.maximum(self.result.mdr[self.spectrum, self.height, self.rule]["level"], ROUNDING)
        pairs = log_ratio_of_means(bem["level"], bem["linear level"], weights)
        return log_ratio_of_means(springs, exact, weights), pairs

    @property
    def inside(self) -> NDArray[np.intp]:
        """Indices of the one-third octaves in the band of the spectrum."""
        return np.flatnonzero(self.result.case.inside(self.result.case.spectra[self.spectrum]))

    @property
    def mean(self) -> float:
        """Springs over boundary elements in the mean over the bands in that of the spectrum [dB]."""
        weights = np.eye(len(self.result.case.bands.centres))[self.inside].mean(axis=0)
        springs, bem = self.both(weights)
        return POWER_DECIBEL * (springs.value - bem.value)

    @property
    def numbers(self) -> list[Number]:
        """Springs over boundary elements in the band of the spectrum: the worst one-third octave, and the rms.

        The intervals of the worst ones hold at once for all spectra and heights.
        """
        return judged(self._points(self.inside.size * len(self.result.bem)), self._points(1))

    def _points(self, among: int) -> list[Number]:
        centres = self.result.case.bands.centres
        return [
            difference(
                *self.both(np.eye(centres.size)[band]),
                quantity=LEVEL,
                model=ONE_SIDED,
                where={
                    "spectrum": self.spectrum,
                    "h/d": self.height,
                    "input": NAMES[self.rule],
                    "q a": float(centres[band]),
                },
                source="bem3d, relative to linear theory on the same surfaces",
                tolerance=THREE_DECIBELS,
                reason=FORD_THOMPSON,
                among=among,
            )
            for band in self.inside
        ]


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
    weights = np.eye(len(result.case.forces))[force]
    springs, bem = (
        log_ratio_of_means(pressed["stiffness"], np.ones(weights.size), weights)
        for pressed in (result.profiles[rule], result.punches)
    )
    return springs.minus(bem)


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
