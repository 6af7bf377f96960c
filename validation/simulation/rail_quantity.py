"""What is asked of a wheel on a rail: the contact filter in base-ten one-third octaves, or the equivalent roughness.

A3 = 10 lg of the band power of the equivalent displacement over that of the line roughness [dB]. What lies across the
line decides it: where the scene leaves that out, ridges and isotropic ground are both ends of the answer.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from validation.analysis.nominal_bands import NominalBands
from validation.scenes.rail import RailScene
from validation.simulation.equivalent_displacement import LINEAR, LINEAR_MODELS
from validation.simulation.rail_ground import StatedAcross, line_of, lost_contact_number, smoothed_error, structure_of
from validation.theory.line_spectrum import LineSpectrum
from validation.theory.transverse_structure import Filter, TransverseStructure

FloatArray = NDArray[np.float64]
RailQuantityName = Literal["contact-filter", "equivalent-roughness"]

RAIL_QUANTITIES: tuple[RailQuantityName, ...] = ("contact-filter", "equivalent-roughness")
COUNTED = -15.0
"""A3 [dB] above which the tolerance counts: below it nothing is left to hear, and models differ by decibels."""
MICROMETRE = 1e-6


@dataclass(frozen=True)
class RailQuantity:
    """A quantity of a scene, its bands, and linear theory of the ellipse on the stated ground."""

    scene: RailScene
    name: RailQuantityName

    @property
    def bands(self) -> NominalBands:
        """Those of the roughness."""
        return self.scene.levels.bands

    @property
    def ends(self) -> tuple[StatedAcross, ...]:
        """What lies across, or both ends of what may."""
        return ("ridges", "isotropic") if self.scene.across is None else (self.scene.across,)

    @cached_property
    def line(self) -> LineSpectrum:
        return line_of(self.scene)

    @cached_property
    def structures(self) -> tuple[TransverseStructure, ...]:
        """One an end; ValueError where no isotropic surface has such a line."""
        return tuple(structure_of(across, self.line) for across in self.ends)

    @cached_property
    def unreal(self) -> str:
        """Why the stated ground cannot be, or has no wave of the contact's length; empty where all is well."""
        try:
            _ = self.structures, self.lost
        except ValueError as reason:
            return str(reason)
        return ""

    @cached_property
    def linear(self) -> FloatArray:
        """A3 of the half-space under an ellipse that keeps its size, (ends, bands) [dB]."""
        return self.filtered(LINEAR_MODELS[LINEAR](self.scene.contact))

    def filtered(self, transfer: Filter) -> FloatArray:
        """A3 of a linear filter on the stated ground, (ends, bands) [dB]."""
        axes, edges = (self.scene.contact.along, self.scene.contact.across), self.bands.edges
        powers = [ground.band_power(self.line, transfer, edges=edges, semi_axes=axes) for ground in self.structures]
        return np.asarray(10 * np.log10(powers))

    @cached_property
    def half_width(self) -> FloatArray:
        """Half of the difference of both ends in each band; zero where the ground is stated [dB]."""
        return np.asarray(np.ptp(self.linear, axis=0) / 2)

    @cached_property
    def left_by_ground(self) -> FloatArray:
        """Half-width that what lies across, and a line that was smoothed for it, leave in each band [dB]."""
        return self.half_width + smoothed_error(self.scene)

    @cached_property
    def wave(self) -> FloatArray:
        """q a_x of each band."""
        return self.bands.centres * self.scene.contact.along

    @cached_property
    def lost(self) -> float:
        """h' a_x / d, h' of the waves that strips have."""
        return lost_contact_number(self.scene)

    def counted(self, a3: FloatArray) -> NDArray[np.bool_]:
        """Bands in which the tolerance counts."""
        return a3 > COUNTED

    def amplitude(self, a3: FloatArray) -> FloatArray:
        """Of A3 in dB: the ratio of amplitudes, or the root mean square of the equivalent roughness [m]."""
        levels = np.array(self.scene.levels.levels) if self.name == "equivalent-roughness" else 0.0
        unit = MICROMETRE if self.name == "equivalent-roughness" else 1.0
        return np.asarray(unit * 10 ** ((a3 + levels) / 20))
