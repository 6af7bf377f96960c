"""Two reduced models on the rough strips of boundary elements: springs that read the surface, the pressed layer."""

import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.engine.engine import Outcome
from validation.simulation.reduced_models import Reduced, pressed_layer, springs_that_read
from validation.simulation.rolling_strip import Strip

FloatArray = NDArray[np.float64]

READ, LAYER = "springs that read the surface", "pressed layer"
MODELS: Mapping[str, tuple[Callable[[FloatArray, float], Reduced], int]] = {
    READ: (springs_that_read, 1),
    LAYER: (pressed_layer, 2),
}
"""With the cells to a contact radius, of which the layer needs one in two."""


def roll_reduced(strip: Strip) -> Outcome:
    """Force over that of Hertz along the strip, by model."""
    return {model: _force(strip, model) for model in MODELS}


def cells_of(strip: Strip, model: str) -> int:
    """To a contact radius."""
    return math.ceil(strip.cells / MODELS[model][1])


def _force(strip: Strip, model: str) -> FloatArray:
    cells, solve = cells_of(strip, model), MODELS[model][0]
    with warnings.catch_warnings():
        # what fewer cells change is small beside what the models leave
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        return solve(replace(strip, cells=cells).surface(), 1 / cells).force


def over_boundary_elements(model: str, found: list[Outcome], strip: Strip, beside: Outcome, bands: Bands) -> Outcome:
    """Levels of a model, and those of boundary elements in the place of linear theory's; strip: any of them."""
    mine = waves(np.array([one[model] for one in found]), spacing=1 / cells_of(strip, model))
    return {"level": levels(mine, bands), "linear level": beside["level"]}
