"""Contact filters of the field for a wheel on a rail, in dB over nominal wavelengths and in dB(A) of sound power.

Beside them the published one, CNOSSOS-EU: an overlay, which knows nothing of a scene. As far as we recall it came from
runs of distributed point reacting springs (DPRS), so that no model is ranked by it.
"""

import math
from collections.abc import Iterable
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.analysis.spectra import NominalBands, assessed_bands
from validation.analysis.statistics import FloatArray
from validation.railway.problems.equivalent_displacement import geike_power, transfer_of
from validation.railway.problems.rail_strip import (
    OneAcross,
    StatedAcross,
    Transfer,
    line_of,
    lines_across,
    mean_of_lines,
    strip_bands,
    structure_of,
)
from validation.railway.scenes.level_files import curve
from validation.railway.scenes.rail import RailScene
from validation.railway.theory.sound_power import in_frequency, weighted_total
from validation.simulation.model_names import BED, LINEAR_GEIKE, LINEAR_ON_LINE
from validation.theory.half_space import EllipticContact

OFFSET = "over ISO 3095 [dB]"
"""Of the levels of a rail over the limit curve."""
TABLE, HEADER = Path(__file__).parents[1] / "tables" / "cnossos_a3_2021.csv", 3
T = TypeVar("T", bound=np.generic)
STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
REMINGTON, REMINGTON_THERE = "Remington, alpha = 1", "Remington, alpha of the ground"
BED_WIDER, WIDER = "spring bed wider by 2/√3", 2 / math.sqrt(3)
"""Mean square radii: a bed of equal weights a^2 / 2, the flat punch, by which the half-space weighs, 2 a^2 / 3."""
LINES_APART, LINES_NEAR = "mean of lines 5 mm apart", "mean of lines 0.71 a_y apart"
APART, NEAR = 0.005, 1 / math.sqrt(2)
"""Of three lines: m as they are measured; over a_y, where they have the mean square distance a_y^2 / 3 of the punch."""
ACROSS: dict[str, OneAcross] = {"ridges": "ridges", "isotropic ground": "isotropic"}
"""Both ends of what may lie across."""
ALPHAS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
GROUNDS: dict[str, OneAcross] = {
    "ridges": "ridges",
    **{f"alpha = {alpha:g}": alpha for alpha in ALPHAS},
    "isotropic ground": "isotropic",
}
"""From one end to the other, waves with abs(k_y) < alpha k_x between."""
COUNTED = -15.0
"""dB of A3: shorter waves, from the first band below on, are no gate: one-third octaves move by decibels there."""
SPEEDS = (60.0, 80.0, 120.0, 160.0, 250.0)
"""km/h."""


class RailWheel(NamedTuple):
    """A column of the table: load of one wheel [kN] and diameter [mm]."""

    load: float
    diameter: float

    @property
    def label(self) -> str:
        return f"{self.load:g} kN, {self.diameter:g} mm"


@cache
def columns_of_table() -> dict[RailWheel, dict[float, float]]:
    """A3 [dB] by wheel and nominal wavelength [mm]."""
    columns: dict[RailWheel, dict[float, float]] = {}
    for load, diameter, wavelength, a3 in np.loadtxt(TABLE, delimiter=",", skiprows=HEADER, encoding="utf-8").tolist():
        columns.setdefault(RailWheel(load, diameter), {})[wavelength] = a3
    return columns


def scene_of(wheel: RailWheel, *, crown: float = 0.3, offset: float = 0.0, levels: str = "iso3095-2013") -> RailScene:
    """A conical wheel on a crowned rail [m], with levels of a bundled curve and so many dB more."""
    return RailScene(
        name=wheel.label,
        radius=wheel.diameter / 2000,
        load=1000 * wheel.load,
        modulus=STEEL,
        roughness=curve(levels).raised(offset),
        crown_radius=crown,
    )


def filter_of(model: str, contact: EllipticContact) -> tuple[Transfer, tuple[float, float]]:
    """H(k_x, k_y) of a linear model, and the lengths along and across [m] over which it oscillates."""
    along, across = contact.semi_axes
    if model in (LINES_APART, LINES_NEAR):
        springs = transfer_of(LINEAR_ON_LINE, contact)
        places = lines_across(3, APART if model == LINES_APART else NEAR * across)
        mean = mean_of_lines(places)
        return lambda k_x, k_y: springs(k_x, k_y) * mean(k_x, k_y), (along, max(across, places[-1]))
    if model == BED_WIDER:
        return filter_of(BED, replace(contact, along=WIDER * along, across=WIDER * across))
    if model == REMINGTON_THERE:
        radius = math.sqrt(along * across)
        return filter_of(BED, replace(contact, along=radius, across=radius))
    return transfer_of(model, contact), contact.semi_axes


@lru_cache(maxsize=4096)
def linear_filter(
    scene: RailScene, model: str, across: StatedAcross, contact: EllipticContact | None = None
) -> FloatArray:
    """A3 of a linear model over the bands of the levels [dB]: int |H|^2 C_line dq over int C_line dq.

    contact: another one in place of that of the scene. Remington's closed form is the bed on the circle of the same
    area over abs(k_y) < alpha k_x. Of Geike's rule it is that of isotropic ground, whatever lies across.
    """
    bands, line, contact = scene.levels.bands, line_of(scene), contact or scene.contact
    if model == LINEAR_GEIKE:
        return decibel(geike_power(line, contact, bands.edges))
    if model == REMINGTON:
        return linear_filter(scene, REMINGTON_THERE, 1.0, contact)
    transfer, axes = filter_of(model, contact)
    return decibel(structure_of(across, line).band_power(line, transfer, edges=bands.edges, semi_axes=axes))


def counted(a3: FloatArray) -> NDArray[np.bool_]:
    """All bands that are longer than the first below -15 dB."""
    return assessed_bands(a3, COUNTED)


def on_strips(scene: RailScene, values: NDArray[T]) -> NDArray[T]:
    """In those bands of a scene that its strips have."""
    bands = strip_bands(scene)
    first = scene.levels.bands.longest - bands.longest
    return values[first : first + len(bands)]


def millimetres(bands: NominalBands) -> FloatArray:
    """As they are named."""
    return np.round(1000 * bands.nominal, 2)


def decibel(power: ArrayLike) -> FloatArray:
    return np.asarray(10 * np.log10(power))


def weighted_level(scene: RailScene, a3: FloatArray, speed: float) -> float:
    """Sound power by a filter [dB(A) re 1 pW], per axle: L_eq + G-3a and G-3b, A-weighted and summed; speed [km/h]."""
    levels, transfer = scene.levels, scene.sound_transfer
    equivalent = in_frequency(np.array(levels.levels) + a3, levels.bands.nominal, speed / 3.6)
    return weighted_total(equivalent + transfer.of_both)


def over_in_decibel_a(
    scene: RailScene, a3: FloatArray, reference: FloatArray, speeds: Iterable[float] = SPEEDS
) -> list[float]:
    """Sound power by a filter over that by another at each speed [dB(A)]."""
    return [weighted_level(scene, a3, v) - weighted_level(scene, reference, v) for v in speeds]
