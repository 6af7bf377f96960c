"""The scene of a wheel on a real rail: two radii, roughness as levels of a line, and what lies across."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from mdr.checks import positive
from validation.scenes.material import Material, check_modulus
from validation.scenes.measured import MeasuredHeights
from validation.scenes.reader import nonblank_text
from validation.scenes.roughness_levels import RoughnessLevels
from validation.scenes.units import in_unit
from validation.theory.elliptic_contact import EllipticContact, elliptic_contact

Across = Literal["ridges", "isotropic"] | float | None
"""What lies across a measured line: ridges; isotropic ground; waves with |k_y| < alpha k_x; None: nobody knows."""

MAX_PRESSURE = 4e9
"""Largest pressure [Pa] that a half-space of steel is asked for."""
WIDE = 0.1
"""Semi-axis of the contact over the radius along it: beyond it the bodies are no half-spaces."""


@dataclass(frozen=True, kw_only=True)
class RailScene:
    """A wheel that rolls along a rail with rough surfaces.

    Parameters
    ----------
    name : str
        One line of text.
    radius : float
        Rolling radius of the wheel [m].
    load : float
        Static load of one wheel [N].
    modulus : float
        Contact modulus E* [Pa].
    roughness : RoughnessLevels or MeasuredHeights
        Of wheel and rail together: levels of a line, or heights whose first axis is along the track.
    transverse_radius, crown_radius : float or None, optional
        Radii of wheel and rail across the track [m], None where straight; one of the two is given.
    speed, mass : float or None, optional
        Of the wheel [m/s], [kg]. Without a speed there are wavelengths alone, without a mass no dynamic wheel.
    material : Material or None, optional
        What E* is made of, None where only ``modulus`` is known.
    across : "ridges", "isotropic", float or None, optional
        What lies across a line: ridges, isotropic ground, or waves with abs(k_y) < alpha k_x. None: ridges and
        isotropic ground, as both ends.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range; the message names the key of a scene file.
    """

    name: str
    radius: float
    load: float
    modulus: float
    roughness: RoughnessLevels | MeasuredHeights
    transverse_radius: float | None = None
    crown_radius: float | None = None
    speed: float | None = None
    mass: float | None = None
    material: Material | None = None
    across: Across = None

    def __post_init__(self) -> None:
        nonblank_text("name", self.name)
        for key in ("wheel.radius", "wheel.load"):
            positive(key, getattr(self, key.partition(".")[2]))
        for key in ("wheel.transverse_radius", "rail.crown_radius", "wheel.speed", "wheel.mass"):
            if (value := getattr(self, key.partition(".")[2])) is not None:
                positive(key, value)
        positive("modulus", self.modulus)
        check_modulus(self.modulus, self.material)
        if self.transverse_radius is None and self.crown_radius is None:
            raise ValueError(
                "rail.crown_radius or wheel.transverse_radius must be given: both bodies are straight across"
            )
        if not isinstance(self.roughness, RoughnessLevels | MeasuredHeights):
            raise TypeError(
                f"roughness must be RoughnessLevels or MeasuredHeights, got {type(self.roughness).__name__}"
            )
        if self.across not in ("ridges", "isotropic", None):
            positive("rail.across", self.across)

    @property
    def radii(self) -> tuple[float, float]:
        """(along, across) of both bodies together, their curvatures added [m]."""
        curvature = sum(1 / radius for radius in (self.transverse_radius, self.crown_radius) if radius is not None)
        return self.radius, 1 / curvature

    @cached_property
    def contact(self) -> EllipticContact:
        """Of the smooth bodies under the static load."""
        return elliptic_contact(self.radii, modulus=self.modulus, force=self.load)

    @property
    def levels(self) -> RoughnessLevels:
        """Levels of one line along the track."""
        if isinstance(self.roughness, MeasuredHeights):
            raise NotImplementedError("levels of measured heights")
        return self.roughness

    def frequency(self, wavelength: float) -> float:
        """f = v / lambda [Hz], NaN without a speed."""
        return math.nan if self.speed is None else self.speed / wavelength

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        return tuple(self._doubts())

    def _doubts(self) -> Iterator[str]:
        contact = self.contact
        if contact.pressure > MAX_PRESSURE:
            yield (
                f"the largest pressure is {contact.pressure / 1e9:.3g} GPa, more than {MAX_PRESSURE / 1e9:g} GPa: steel "
                "yields; is wheel.load that of one wheel?"
            )
        for side, semi_axis, radius in (
            ("along", contact.along, self.radii[0]),
            ("across", contact.across, self.radii[1]),
        ):
            if semi_axis > WIDE * radius:
                yield (
                    f"the contact is wider than the crown of the bodies: {semi_axis / radius:.3g} of the radius {side}, "
                    f"{in_unit(radius, 'length')}, more than a tenth: no half-space."
                )
