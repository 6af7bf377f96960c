"""Contact filters of the field for a wheel on a rail, in dB over nominal wavelengths, and in dB(A) over a speed."""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.analysis.sound import a_weighting, energy_sum
from validation.cases.rail.published import RailWheel
from validation.scenes.level_files import curve
from validation.scenes.rail import RailScene
from validation.simulation.equivalent_displacement import geike_power, transfer_of
from validation.simulation.model_names import LINEAR_GEIKE
from validation.simulation.rail_strip import StatedAcross, line_of, structure_of
from validation.theory.contact_filters import remington_filter
from validation.theory.elliptic_contact import EllipticContact

FloatArray = NDArray[np.float64]

STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
REMINGTON = "Remington, alpha = 1"
ACROSS: dict[str, StatedAcross] = {"ridges": "ridges", "isotropic ground": "isotropic"}
"""Both ends of what may lie across."""
COUNTED = -15.0
"""dB of A3: shorter waves, from the first band below on, are no gate: one-third octaves move by decibels there."""
SPEEDS = (60.0, 80.0, 120.0, 160.0, 250.0)
"""km/h."""


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
    """Of one filter over another, at each of SPEEDS [dB(A)]."""
    return [weighted_level(scene, mine, v) - weighted_level(scene, reference, v) for v in SPEEDS]
