"""A contact filter as a column of the table of CNOSSOS-EU, for tools that map noise."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import Table
from validation.analysis.nominal_bands import LONGEST, NominalBands
from validation.scenes.rail import RailScene
from validation.selection.compare import Comparison
from validation.selection.scene_model import SceneModel
from validation.simulation.model import Target
from validation.simulation.rail_models import RailModel, rail_quantity

FloatArray = NDArray[np.float64]


def filter_table(comparison: Comparison) -> Table:
    """A row a nominal wavelength from 2000 to 0.8 mm: load of one wheel, its diameter, A3 to a tenth of a decibel.

    Waves longer than those of the scene have the closed filter of the model, of a one-sided one that of its linear
    twin; shorter ones are NaN. Raises ValueError for any other quantity, and where no model has an answer.
    """
    scene, best = comparison.scene, comparison.selection.best
    if not isinstance(scene, RailScene) or comparison.quantity != "contact-filter":
        raise ValueError(f"--cnossos is for the quantity contact-filter of a rail, got {comparison.quantity}")
    if best is None:
        raise ValueError("--cnossos needs a contact filter, got none: no model has a result")
    bands, own = NominalBands(), scene.levels.bands
    a3 = np.full(len(bands), np.nan)
    first = bands.longest - own.longest
    if first and isinstance(best.model, SceneModel) and isinstance(best.model.model, RailModel):
        a3[:first] = of_longer_waves(best.model.model, best.model.target)[:first]
    a3[first : first + len(own)] = comparison.value
    return Table(
        "contact-filter",
        {
            "wheel_load_kN": [scene.load / 1e3] * len(bands),
            "wheel_diameter_mm": [2e3 * scene.radius] * len(bands),
            "wavelength_mm": (1e3 * bands.nominal).tolist(),
            # no minus in front of a zero
            "a3_dB": (a3.round(1) + 0.0).tolist(),
        },
    )


def of_longer_waves(model: RailModel, target: Target) -> FloatArray:
    """A3 of the linear filter in all bands from 2000 mm to the last of the roughness [dB]."""
    asked = replace(rail_quantity(target), longest=LONGEST)
    return np.asarray(model.filter.closed(asked).mean(axis=0))
