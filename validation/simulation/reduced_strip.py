"""All reduced models of a wheel over the same rough strip, beside boundary elements."""

import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

import bem3d
import mdr
from validation.analysis.spectra import Bands, Waves, cross_levels, levels, waves
from validation.engine.engine import FloatArray, Outcome
from validation.simulation import reduced_models as reduced
from validation.simulation.pressed_layer import Reduced, roll_on_layer
from validation.simulation.rolling_strip import Strip
from validation.simulation.track_spectrum import PiecewisePowerLaw

Solve = Callable[[FloatArray, float], Reduced]

READ, LAYER, LINE = "springs that read the surface", "pressed layer", "springs on a line"
LINEAR, BED, COARSE_LAYER = "linear theory, 3D", "one-sided bed (DPRS)", "pressed layer, 1/2 of the cells"
JUDGE, COARSE, COARSEST = (
    "boundary elements",
    "boundary elements, 1/2 of the cells",
    "boundary elements, 1/3 of the cells",
)
MODELS: Mapping[str, tuple[Solve, int]] = {
    JUDGE: (reduced.boundary_elements, 1),
    LINE: (reduced.springs_on_a_line, 1),
    LINEAR: (reduced.linear_theory, 1),
    READ: (reduced.springs_that_read, 1),
    "their radius by the mean force": (reduced.radius_by_the_mean_force, 1),
    "one-sided in two dimensions": (reduced.one_sided_in_two_dimensions, 1),
    BED: (reduced.one_sided_bed, 1),
    "two scales, Persson": (reduced.two_scales_by_persson, 1),
    "two scales, short waves pressed": (reduced.two_scales_pressed, 1),
    "weights of some positions": (reduced.frozen_weights, 1),
    LAYER: (roll_on_layer, 1),
    COARSE_LAYER: (roll_on_layer, 2),
    COARSE: (reduced.boundary_elements, 2),
    COARSEST: (reduced.boundary_elements, 3),
}
"""With the cells to a contact radius, of which it has one in so many."""
FOLLOWING = {READ: READ, LAYER: COARSE_LAYER}
"""Two that follow boundary elements where linear theory ends, as they are called there: the layer needs few cells."""


def bands_of(spectrum: PiecewisePowerLaw) -> Bands:
    """One-third octaves from the longest wave on, whole octaves of them."""
    first, last = spectrum.edges[0], spectrum.edges[-1]
    return Bands(tuple(first * 2 ** (k / 3) for k in range(3 * math.floor(math.log2(last / first) + 1e-9) + 1)))


def roll_by_all(strip: Strip) -> Outcome:
    """Models in the order of `MODELS`: level in each band, cross level with boundary elements, mean force, and work.

    level, cross (complex): (models, bands), of the force over that of Hertz; mean, work of the whole strip: (models,);
    failed: models with a contact that did not converge, which have no force.
    """
    bands = bands_of(strip.scene.spectrum)
    rolled = [_roll(strip, solve, coarser) for solve, coarser in MODELS.values()]
    of_waves = [
        _waves(one.force, coarser / strip.cells, bands)
        for one, (_, coarser) in zip(rolled, MODELS.values(), strict=True)
    ]
    cross = np.array([cross_levels(one, of_waves[0], bands) for one in of_waves])
    return {
        "level": np.array([levels(one, bands) for one in of_waves]),
        "cross": np.stack([cross.real, cross.imag]),
        "mean": np.array([one.force.mean() for one in rolled]),
        "work": np.array([one.work for one in rolled]),
        "failed": np.array(float(sum(math.isnan(one.work) for one in rolled))),
    }


def roll_reduced(strip: Strip) -> Outcome:
    """Force over that of Hertz along the strip, of those that follow boundary elements."""
    return {model: _solve(strip, *MODELS[of]).force for model, of in FOLLOWING.items()}


def over_boundary_elements(model: str, found: list[Outcome], strip: Strip, beside: Outcome, bands: Bands) -> Outcome:
    """Levels of such a model, and those of boundary elements in the place of linear theory's; strip: any of them."""
    spacing = 1 / _cells(strip, MODELS[FOLLOWING[model]][1])
    mine = waves(np.array([one[model] for one in found]), spacing=spacing)
    return {"level": levels(mine, bands), "linear level": beside["level"]}


def _cells(strip: Strip, coarser: int) -> int:
    """To a contact radius."""
    return math.ceil(strip.cells / coarser)


def _solve(strip: Strip, solve: Solve, coarser: int) -> Reduced:
    cells = _cells(strip, coarser)
    with warnings.catch_warnings():
        # what fewer cells change is compared, or small beside what the models leave
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        return solve(replace(strip, cells=cells).surface(), 1 / cells)


def _roll(strip: Strip, solve: Solve, coarser: int) -> Reduced:
    try:
        return _solve(strip, solve, coarser)
    except bem3d.ConvergenceError:
        return Reduced(np.full(round(strip.scene.length * _cells(strip, coarser)), math.nan), math.nan)


def _waves(force: FloatArray, spacing: float, bands: Bands) -> Waves:
    """Of a force at the centres of cells, from the beginning of the strip on, up to the last band."""
    found = waves(force, spacing=spacing)
    known = found.q < bands.edges[-1]
    return Waves(found.q[known], (found.amplitude * np.exp(-0.5j * found.q * spacing))[known])
