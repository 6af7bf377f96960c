"""A contact filter as a column of the table of CNOSSOS-EU, for tools that map noise."""

import math

from validation.analysis.evidence import Table
from validation.analysis.nominal_bands import NominalBands
from validation.scenes.rail import RailScene
from validation.selection.compare import Comparison

PASSES = 0.05
"""A3 [dB] of a wave that is 0.0 in the table."""


def filter_table(comparison: Comparison) -> Table:
    """A row a nominal wavelength from 2000 to 0.8 mm: load of one wheel, its diameter, A3 to a tenth of a decibel.

    Waves longer than those of the scene pass, 0 dB, where the longest of these do, to a tenth of a decibel; others that
    the scene has not are NaN. Raises ValueError for any other quantity, and where no model has an answer.
    """
    scene = comparison.scene
    if not isinstance(scene, RailScene) or comparison.quantity != "contact-filter":
        raise ValueError(f"--cnossos is for the quantity contact-filter of a rail, got {comparison.quantity}")
    if comparison.selection.best is None:
        raise ValueError("--cnossos needs a contact filter, got none: no model has a result")
    known = dict(zip(scene.levels.bands.numbers, comparison.value.tolist(), strict=True))
    bands = NominalBands()
    longer = 0.0 if abs(known[max(known)]) < PASSES else math.nan
    a3 = [known.get(n, longer if n > max(known) else math.nan) for n in bands.numbers]
    count = len(a3)
    return Table(
        "contact-filter",
        {
            "wheel_load_kN": [scene.load / 1e3] * count,
            "wheel_diameter_mm": [2e3 * scene.radius] * count,
            "wavelength_mm": (1e3 * bands.nominal).tolist(),
            # no minus in front of a zero
            "a3_dB": [round(decibels, 1) + 0.0 for decibels in a3],
        },
    )
