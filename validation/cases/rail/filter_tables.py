"""A3 of all models, in tables: in the bands of strips, beside the published table, and in dB(A)."""

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import Number, Table, table_of
from validation.analysis.statistics import POWER_DECIBEL
from validation.cases.rail.filters import (
    ACROSS,
    REMINGTON,
    SPEEDS,
    counted,
    linear_filter,
    scene_of,
    weighted_difference,
)
from validation.cases.rail.published import a3_of_table, columns_of_table, compared
from validation.cases.rail.rolled_filters import RIVALS, Key, RolledFiltersResult, spectral_models
from validation.simulation.equivalent_displacement import (
    BED,
    BEM,
    LINEAR,
    LINEAR_ON_LINE,
    LINEAR_ON_MEAN,
)
from validation.simulation.rail_ground import strip_bands
from validation.simulation.spectral_springs import twin_of

FloatArray = NDArray[np.float64]

FILTERS = (LINEAR, LINEAR_ON_LINE, LINEAR_ON_MEAN, BED, REMINGTON)


def a3(result: RolledFiltersResult, key: Key, model: str) -> FloatArray:
    """Of a model in the bands of the strips [dB]; of a one-sided one, that of its twin and what it is over it."""
    scene, across = result.case.scene(key), ACROSS[key[2]]
    first = scene.levels.bands.longest - strip_bands(scene).longest
    linear = linear_filter(scene, twin_of(model), across)
    known = linear[first : first + len(strip_bands(scene))]
    if model == twin_of(model):
        return known
    return known + POWER_DECIBEL * np.array([one.value for one in result.over_twin(key, model)])


def bands_table(result: RolledFiltersResult) -> Table:
    rows = []
    for key in result.case.keys:
        wheel, offset, name = key
        bands = strip_bands(result.case.scene(key))
        keep = counted(a3(result, key, LINEAR))
        grid = POWER_DECIBEL * result.left_by_grid(key, BEM, LINEAR)
        for model in (BEM, *FILTERS, *RIVALS, *spectral_models(key)):
            half = [POWER_DECIBEL * one.half_width for one in result.over_twin(key, BEM)] if model == BEM else None
            for i, value in enumerate(a3(result, key, model)):
                rows.append(
                    {
                        "wheel": wheel.label,
                        "offset [dB]": offset,
                        "across": name,
                        "model": model,
                        "wavelength [mm]": round(1000 * float(bands.nominal[i]), 2),
                        "A3 [dB]": float(value),
                        "± [dB]": float(half[i] + grid[i]) if half else 0.0,
                        "counted": bool(keep[i]),
                    }
                )
    return table_of("bands", rows)


def published_table() -> Table:
    rows = []
    for wheel in columns_of_table():
        scene = scene_of(wheel)
        ridges, isotropic = (linear_filter(scene, LINEAR, across) for across in ACROSS.values())
        for i, (wave, published) in enumerate(zip(scene.levels.bands.nominal, a3_of_table(wheel), strict=True)):
            rows.append(
                {
                    "wheel": wheel.label,
                    "wavelength [mm]": round(1000 * float(wave), 2),
                    "table [dB]": float(published),
                    "compared": bool(compared(wheel)[i]),
                    "ridges [dB]": float(ridges[i]),
                    "isotropic [dB]": float(isotropic[i]),
                }
            )
    return table_of("published", rows)


def rms_table(numbers: list[Number]) -> Table:
    pairs = dict.fromkeys((number.model, str(number.where["across"])) for number in numbers)
    return table_of(
        "rms difference from the published table",
        [
            {"model": model, "across": name}
            | {
                f"{number.where['wheel']} [dB]": round(number.value, 2)
                for number in numbers
                if number.model == model and number.where["across"] == name
            }
            for model, name in pairs
        ],
    )


def weighted_table(result: RolledFiltersResult) -> Table:
    scene = result.case.scene(result.case.keys[0])
    rows = []
    for model in FILTERS[1:]:
        for name in result.case.across:
            by_speed = weighted_difference(
                scene, linear_filter(scene, model, ACROSS[name]), linear_filter(scene, LINEAR, ACROSS[name])
            )
            rows.append(
                {"model": model, "across": name} | {f"{v:g} km/h [dB(A)]": round(by_speed(v), 2) for v in SPEEDS}
            )
    return table_of("A-weighted level over that with linear theory of the ellipse", rows)
