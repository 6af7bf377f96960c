"""Springs over an area: the highest ground of a surface without elastic coupling, beside which coupling shows."""

from dataclasses import dataclass

import numpy as np

from validation.engine.engine import FloatArray, Outcome
from validation.simulation.rough_punch import PunchRoughness


@dataclass(frozen=True, kw_only=True)
class RoughAreas:
    """So many realisations from the first on, on cells x cells; loads: overlaps, mean over the area, in rms heights."""

    roughness: PunchRoughness
    first: int
    realisations: int
    cells: int
    loads: tuple[float, ...]


def press_areas(areas: RoughAreas) -> Outcome:
    """Stiffness of each realisation at each load, E* = 1 a length, so the contact fraction: one sort a surface."""
    load = areas.roughness.height * np.array(areas.loads)
    last = areas.first + areas.realisations
    surfaces = (areas.roughness.surface(areas.cells, i) for i in range(areas.first, last))
    return {"stiffness": np.array([_fraction(surface.ravel(), load) for surface in surfaces])}


def _fraction(height: FloatArray, load: FloatArray) -> FloatArray:
    """Linear between the loads at which one more spring touches."""
    ordered = np.sort(height)[::-1]
    touching = np.arange(1, ordered.size + 1)
    overlap = (np.cumsum(ordered) - touching * ordered) / ordered.size
    return np.interp(load, overlap, touching / ordered.size)
