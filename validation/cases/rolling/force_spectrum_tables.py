"""Tables of rolling over isotropic roughness: what the figures are drawn from, and what the page prints."""

import math
from itertools import product

import numpy as np

from validation.analysis.evidence import Number, Table, VerdictCell, columns, number_with, numbers_with, table_of
from validation.analysis.statistics import POWER_DECIBEL, log_ratio_of_means, ratio_of_means
from validation.cases.rolling.force_spectrum import ForceSpectrum, RollingResult
from validation.cases.rolling.force_spectrum_levels import (
    LINEAR_1D,
    LINEAR_3D,
    MODELS,
    LevelsAtHeight,
    coherence,
    correlation,
    force_3d,
)
from validation.cases.rolling.force_spectrum_numbers import IN_RMS, LEVEL, place, regions
from validation.simulation.rolling_strip import HERTZ
from validation.simulation.track_spectrum import TrackSpectrum
from validation.theory.rolling import force_spectrum_1d, mean_force_spectrum_1d

Row = dict[str, object]


def levels(found: list[LevelsAtHeight]) -> Table:
    """A row a height and band: levels over (h/d)^2 and F_Hertz^2 in dB; models over boundary elements; coherence."""
    return table_of("levels", [row for mine in found for row in _levels(mine)])


def _levels(mine: LevelsAtHeight) -> list[Row]:
    case = mine.case
    edges, centres = case.bands.edges, case.bands.centres
    of_bem, of_springs = coherence(mine.bem), coherence(mine.springs)
    waves = case.bands.counts(2 * np.pi / case.length * np.arange(1, int(case.length * case.springs / 2)))
    rows: list[Row] = []
    for i, weights in enumerate(mine.single_bands):
        bem, grid = mine.bem_level(weights)
        as_rolled = log_ratio_of_means(mine.bem["level"], mine.bem["linear level"], weights)
        unit = POWER_DECIBEL * math.log(mine.linear[LINEAR_3D][i] / mine.height**2)
        row: Row = {
            "h/d": mine.height,
            "h' a/d": mine.slope,
            "q a": float(centres[i]),
            "from": edges[i],
            "to": edges[i + 1],
            "waves": float(waves[i] * np.isfinite(mine.bem["level"][:, i]).sum()),
            "bem3d [dB]": unit + POWER_DECIBEL * bem.value,
            "± sample [dB]": POWER_DECIBEL * bem.half_width,
            "± grid [dB]": POWER_DECIBEL * grid,
            "bem3d over linear 3D, not extrapolated [dB]": POWER_DECIBEL * as_rolled.value,
            "coherence of bem3d": float(of_bem[i]),
            "coherence of springs": float(of_springs[i]) if mine.linear[LINEAR_1D][i] > 0 else math.nan,
        }
        for model in MODELS:
            level = mine.model_level(model, weights)
            row[f"{model} [dB]"] = unit + POWER_DECIBEL * level.value
            row[f"{model} over bem3d [dB]"] = POWER_DECIBEL * (level.value - bem.value)
        rows.append(row)
    return rows


def summary(found: list[LevelsAtHeight]) -> Table:
    """A row a height: correlation with linear theory, variance, mean force, work."""
    return table_of("summary", [_summary(mine) for mine in found])


def _summary(mine: LevelsAtHeight) -> Row:
    bem, springs = mine.bem, mine.springs
    (of_bem, slope), (of_springs, slope_1d) = correlation(bem), correlation(springs)
    variance, variance_1d = (ratio_of_means(one["variance"], one["linear variance"]).value for one in (bem, springs))
    return {
        "h / d": mine.height,
        "h' a / d": _rounded(mine.slope),
        "bem3d: correlation with linear": round(of_bem, 4),
        "bem3d: slope": round(slope, 4),
        "springs: correlation with linear": round(of_springs, 4),
        "springs: slope": round(slope_1d, 4),
        "bem3d: variance over linear": round(variance, 4),
        "springs: variance over linear": round(variance_1d, 4),
        "bem3d: mean force over Hertz": round(float(np.nanmean(bem["mean"])), 5),
        "springs: mean force over Hertz": round(float(springs["mean"].mean()), 5),
        "applications a position": round(float(mine.result.forces[mine.height]["applications"].mean()), 2),
        "springs examined a position": round(float(springs["examined"].mean()), 1),
    }


def spectrum(result: RollingResult) -> Table:
    """Fig. 14.3: C_F over F_Hertz^2 a (h/d)^2, wave by wave, of the lowest roughness."""
    case, height = result.case, result.case.heights[0]
    springs, geike = result.mdr["geike", height], TrackSpectrum(case.spectrum, "geike")
    inside = (springs["wavenumber"] > case.first / 2) & (springs["wavenumber"] < case.last)
    q = springs["wavenumber"][inside]
    found = {
        "q a": q,
        "(14.12)": force_spectrum_1d(q, geike, contact_radius=1.0, modulus=1.0) / HERTZ**2,
        "(14.14)": mean_force_spectrum_1d(q, geike, modulus=1.0) / HERTZ**2,
        "linear 3D": force_3d(q, case.spectrum) / HERTZ**2,
        "springs": springs["spectrum"][inside] / height**2,
    }
    return Table("spectrum", columns(**found))


def forces(result: RollingResult) -> Table:
    """The force along a part of the first strip, boundary elements beside linear theory."""
    cells = result.case.cells
    points = min(12 * cells, round(result.case.length * cells))
    rows: list[Row] = [
        {"h/d": height, "x / a": i / cells, "bem3d": float(found["force"][i]), "linear 3D": float(found["linear"][i])}
        for height, found in result.forces.items()
        for i in range(points)
    ]
    return table_of("forces", rows)


def bands_within(case: ForceSpectrum, found: list[LevelsAtHeight]) -> Table:
    """In how many single one-third octaves each model lies within 1 and 3 dB of boundary elements."""
    inside = np.array(case.bands.edges[1:]) > case.first * (1 + 1e-9)
    rows: list[Row] = []
    for mine in found:
        row: Row = {"h / d": mine.height, "h' a / d": _rounded(mine.slope)}
        for model in MODELS:
            off = np.abs([mine.decibels_over_bem(model, weights) for weights in mine.single_bands])
            for where, some in (("in the band", inside), ("below the band", ~inside)):
                row[f"{model}, {where}"] = f"{(off[some] <= 1).sum()} and {(off[some] <= 3).sum()} of {some.sum()}"
        rows.append(row)
    return table_of("bands within 1 and within 3 dB of boundary elements", rows)


def judged_levels(found: list[LevelsAtHeight], numbers: list[Number]) -> Table:
    """A row a height and region: mean, root mean square and worst of each model over boundary elements."""
    rows: list[Row] = []
    for mine, region in product(found, regions(found[0].case)):
        row: Row = {"h / d": mine.height, "h' a / d": _rounded(mine.slope), "q a": f"{region[0]:g} to {region[1]:g}"}
        for model in MODELS:
            judged = numbers_with(numbers, None, f"{model} over bem3d", **place(mine.height, region))
            row[model] = _cell(mine.decibels_over_bem(model, mine.weights(region)), judged)
        rows.append(row)
    return table_of("mean, rms and worst one-third octave over boundary elements [dB]", rows)


def _cell(mean: float, judged: list[Number]) -> object:
    if not judged:
        return "no level"
    worst, rms = (number_with(judged, quantity) for quantity in (LEVEL, IN_RMS))
    at = worst.where["worst at"]
    return VerdictCell(f"{mean:+.1f}, {rms.value:.1f}, {worst.value:+.1f} at {at:.2g}", worst.verdict)


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
