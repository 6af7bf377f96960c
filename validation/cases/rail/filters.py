"""Contact filters of the field for a wheel on a rail, in dB over nominal wavelengths and in dB(A) over a speed.

Beside them the published one, CNOSSOS-EU: an overlay, which knows nothing of a scene.
"""

from functools import cache, lru_cache
from pathlib import Path
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.analysis.nominal_bands import NominalBands
from validation.analysis.sound import a_weighting, energy_sum
from validation.analysis.statistics import FloatArray
from validation.scenes.level_files import curve
from validation.scenes.rail import RailScene
from validation.simulation.equivalent_displacement import geike_power, transfer_of
from validation.simulation.model_names import LINEAR_GEIKE
from validation.simulation.rail_strip import StatedAcross, line_of, strip_bands, structure_of
from validation.theory.contact_filters import remington_filter
from validation.theory.elliptic_contact import EllipticContact

TABLE, HEADER = Path(__file__).with_name("cnossos_a3_2021.csv"), 3
SOURCE = "CNOSSOS-EU, Table G-2 in the edition of (EU) 2021/1226"
T = TypeVar("T", bound=np.generic)
FOLLOWED, LEAST = -13.0, -0.1
"""dB: below the first the table is no linear filter, above the second it is rounded to nothing."""
STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
REMINGTON = "Remington, alpha = 1"
ACROSS: dict[str, StatedAcross] = {"ridges": "ridges", "isotropic ground": "isotropic"}
"""Both ends of what may lie across."""
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


MASKED = {(RailWheel(50, 920), 40.0)}
"""-1.3 dB in all transcriptions, where its neighbours -1.1 and -3.5 suggest -2.1: perhaps a misprint."""


@cache
def columns_of_table() -> dict[RailWheel, dict[float, float]]:
    """A3 [dB] by wheel and nominal wavelength [mm]."""
    found: dict[RailWheel, dict[float, float]] = {}
    for load, diameter, wavelength, a3 in np.loadtxt(TABLE, delimiter=",", skiprows=HEADER).tolist():
        found.setdefault(RailWheel(load, diameter), {})[wavelength] = a3
    return found


def a3_of_table(wheel: RailWheel) -> FloatArray:
    """From 2000 to 0.8 mm [dB]."""
    return np.array(list(columns_of_table()[wheel].values()))


def compared(wheel: RailWheel) -> NDArray[np.bool_]:
    """The wavelengths at which a filter is compared with the table: -13 to -0.1 dB, and none that is masked."""
    return np.array(
        [FOLLOWED <= a3 <= LEAST and (wheel, mm) not in MASKED for mm, a3 in columns_of_table()[wheel].items()]
    )


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


@lru_cache(maxsize=512)
def linear_filter(
    scene: RailScene, model: str, across: StatedAcross, contact: EllipticContact | None = None
) -> FloatArray:
    """A3 of a linear model over the bands of the levels [dB]: int |H|^2 C_line dq over int C_line dq.

    contact: another one in place of that of the scene. Of Geike's rule it is that of isotropic ground, whatever lies
    across.
    """
    bands, line, contact = scene.levels.bands, line_of(scene), contact or scene.contact
    axes = contact.semi_axes
    if model == REMINGTON:
        q, dq = bands.quadrature()
        power = line(q) * dq
        passed = power * remington_filter(q, radius=float(np.sqrt(axes[0] * axes[1])), alpha=1.0)
        return decibel(passed.sum(axis=1) / power.sum(axis=1))
    if model == LINEAR_GEIKE:
        return decibel(geike_power(line, contact, bands.edges))
    transfer = transfer_of(model, contact)
    return decibel(structure_of(across, line).band_power(line, transfer, edges=bands.edges, semi_axes=axes))


def counted(a3: FloatArray) -> NDArray[np.bool_]:
    """All bands that are longer than the first below -15 dB."""
    return np.logical_and.accumulate(a3 > COUNTED)


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
    """dB(A): levels and filter at f = v / lambda, A-weighted and summed over all bands; speed [km/h].

    The force that a contact spring of constant stiffness bears, k times the equivalent roughness: no mobility of wheel
    or track, no radiation. Of use as a difference between filters alone.
    """
    frequency = speed / 3.6 / scene.levels.bands.wavelengths
    return energy_sum(np.array(scene.levels.levels) + a3 + a_weighting(frequency))


def over_in_decibel_a(scene: RailScene, mine: FloatArray, reference: FloatArray) -> list[float]:
    return [weighted_level(scene, mine, v) - weighted_level(scene, reference, v) for v in SPEEDS]
