"""What is asked of a wheel on a rail: the contact filter in base-ten one-third octaves, or the equivalent roughness.

A3 = 10 lg of the band power of the equivalent displacement over that of the line roughness [dB]. What lies across the
line decides it: where the scene leaves that out, ridges and isotropic ground are both ends of the answer.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import NominalBands, assessed_bands
from validation.engine.engine import FloatArray
from validation.railway.problems.equivalent_displacement import transfer_of
from validation.railway.problems.rail_power import RailPower, asks_for_power
from validation.railway.problems.rail_strip import (
    LateralBands,
    OneAcross,
    StatedAcross,
    line_of,
    lost_contact_number,
    structure_of,
)
from validation.railway.scenes.level_files import MICROMETRE
from validation.railway.scenes.rail import CONTACT_FILTER, COUNTED, RailScene
from validation.railway.theory.line_coherence import LARGEST, LateralEstimate
from validation.railway.theory.transverse_structure import Filter, IsotropicGround, LineSpectrum, TransverseStructure
from validation.simulation.model_names import LINEAR

RAIL_QUANTITIES = tuple(map(str, RailScene.quantities))
GRID = np.geomspace(0.05, LARGEST, 24)
"""alpha at which filters are compared, between the ends of what was measured."""
TILT = 0.3
"""Of the exponent of a line, over which A3 changes in proportion."""
OF_SMOOTHING = 3.0
"""Error of a smooth line over what smoothing it twice more changes. With a corrugation of 10 dB in five bands 96 to
98 % of the bands of power laws are inside, by which it was chosen; over ground that bends, 91 % of the five bands."""


@dataclass(frozen=True)
class RailQuantity:
    """A quantity of a scene, its bands, and linear theory of the ellipse on the stated ground.

    longest: number of the first band, None for that of the roughness; longer waves continue its first power law.
    """

    scene: RailScene
    name: str
    longest: int | None = None

    @property
    def bands(self) -> NominalBands:
        """Those of the roughness, and longer ones."""
        own = self.scene.levels.bands
        return own if self.longest is None else NominalBands(self.longest, own.shortest)

    @cached_property
    def ends(self) -> tuple[StatedAcross, ...]:
        """What lies across, or both ends of what may: also where levels stand out of the isotropic ground stated.

        Of parallel lines the ends are those of the measured structure, band by band, the quieter filter last.
        """
        if self.scene.measured_structure is not None:
            return self._measured_ends(self.scene.measured_structure)
        if self.scene.lateral_structure is None or self.stands_out.any():
            return "ridges", "isotropic"
        return (self.scene.lateral_structure,)

    def _measured_ends(self, estimates: Sequence[LateralEstimate]) -> tuple[LateralBands, LateralBands]:
        """Of what may lie across in each band, with the loudest and with the quietest filter of linear theory."""
        # longer waves have the structure of the longest that was measured
        longer = len(self.bands) - len(estimates)
        estimates = [estimates[0]] * longer + list(estimates)
        alphas, transfer = GRID.tolist(), transfer_of(LINEAR, self.scene.contact)
        own = [self._of_ground(structure_of(alpha, self.line), self.line, transfer) for alpha in alphas]
        of_grid = np.array([self._of_ground(structure_of("ridges", self.line), self.line, transfer), *own])
        isotropic = self._of_ground(structure_of("isotropic", self.line), self.line, transfer)
        grid, chosen = np.array([0.0, *alphas]), list[tuple[OneAcross, OneAcross]]()
        for i, estimate in enumerate(estimates):
            between = grid[(grid > estimate.low) & (grid < estimate.high)]
            may_be: list[OneAcross] = [_named(alpha) for alpha in (estimate.low, *between.tolist(), estimate.high)]
            a3 = np.interp([estimate.low, *between, estimate.high], grid, of_grid[:, i]).tolist()
            if estimate.isotropic:
                may_be, a3 = [*may_be, "isotropic"], [*a3, isotropic[i]]
            chosen.append((may_be[int(np.argmax(a3))], may_be[int(np.argmin(a3))]))
        edges = tuple(self.bands.edges.tolist())
        loud, quiet = zip(*chosen, strict=True)
        return LateralBands(edges, loud), LateralBands(edges, quiet)

    @property
    def stands_out(self) -> NDArray[np.bool_]:
        """Bands whose level no isotropic ground has, where it may be isotropic.

        Its oblique waves would be seen in longer bands, which have too little for them: they are less oblique.
        """
        isotropic, flags = self.scene.isotropic, np.zeros(len(self.bands), dtype=bool)
        if isotropic is not None:
            flags[-len(isotropic.stands_out) :] = isotropic.stands_out
        return flags

    @cached_property
    def line(self) -> LineSpectrum:
        """C_line of the nearest ground that can be as stated."""
        line = line_of(self.scene)
        return line if self.longest is None else line.from_wavenumber(float(self.bands.edges[0]))

    @cached_property
    def structures(self) -> tuple[TransverseStructure, ...]:
        """One an end."""
        return tuple(structure_of(across, self.line) for across in self.ends)

    @cached_property
    def evaluations(self) -> int:
        """Waves of a closed filter, over all bands and grounds."""
        axes = self.scene.contact.semi_axes
        return sum(ground.evaluations(edges=self.bands.edges, semi_axes=axes) for ground in self.structures)

    @cached_property
    def no_answer(self) -> str:
        """Why no model has one: no wave of the contact's length, or no band that counts; empty where one may have."""
        if self.scene.levels.fault:
            return f"the roughness is not known: {self.scene.levels.fault}"
        if reason := self.scene.no_answer(self.name):
            return reason
        try:
            _ = self.lost
        except ValueError as reason:
            return f"{reason}, which decide whether contact is lost: the roughness has {self.bands.span}"
        return "" if self.counted(self.linear.mean(axis=0)).any() else self.none_counts

    @property
    def none_counts(self) -> str:
        """Why a filter without a band in which the tolerance counts is no answer."""
        return (
            f"no band has A3 above {COUNTED:g} dB, where the tolerance counts: the roughness has waves of "
            f"{self.bands.span}, the contact is {2e3 * self.scene.contact.along:.3g} mm long; levels of longer waves "
            "would count"
        )

    @cached_property
    def linear(self) -> FloatArray:
        """A3 of the half-space under an ellipse that keeps its size, (ends, bands) [dB]."""
        return self.filtered(transfer_of(LINEAR, self.scene.contact))

    def filtered(self, transfer: Filter) -> FloatArray:
        """A3 of a linear filter on the stated ground, (ends, bands) [dB]."""
        return self.between(np.array([self._of_ground(ground, self.line, transfer) for ground in self.structures]))

    def between(self, ends: FloatArray) -> FloatArray:
        """Of values at both ends, (ends, bands), those of isotropic ground where it is stated and has the level."""
        both = self.scene.lateral_structure is None or len(ends) == 1
        return ends if both else np.where(self.stands_out, ends, ends[-1])

    def _of_ground(self, ground: TransverseStructure, line: LineSpectrum, transfer: Filter) -> FloatArray:
        """Band powers of the filtered roughness relative to those of the line [dB]."""
        axes = self.scene.contact.semi_axes
        return np.asarray(10 * np.log10(ground.band_power(line, transfer, edges=self.bands.edges, semi_axes=axes)))

    @cached_property
    def half_width(self) -> FloatArray:
        """Half of the difference of both ends in each band; zero where the ground is stated and can be [dB]."""
        return np.asarray(np.ptp(self.linear, axis=0) / 2)

    @cached_property
    def left_by_ground(self) -> FloatArray:
        """Half-width that what lies across, a smoothed line, and faults of measured lines leave in each band [dB]."""
        return self.half_width + self.smoothing_error + self.left_by_faults

    @property
    def left_by_faults(self) -> FloatArray:
        """Half-width that faults of measured lines leave of the roughness, and so of what a filter leaves of it [dB].

        A3 itself is a ratio and changes less: this is an upper bound for it. Longer bands have that of the first.
        """
        errors = np.array(self.scene.levels.errors or (0.0,) * len(self.scene.levels.levels))
        return np.concatenate([np.full(len(self.bands) - errors.size, errors[0]), errors])

    @cached_property
    def smoothing_error(self) -> FloatArray:
        """95 % half-width of A3 over isotropic ground that levels leave which scatter [dB].

        By the error of the slopes of the smooth line, and `OF_SMOOTHING` times what smoothing it twice more changes:
        bends of the levels were smoothed before, and what stands out of five bands together is in part taken for
        ground. Zero of levels that are smooth.
        """
        isotropic = self.scene.isotropic
        if isotropic is None or isotropic.as_it_is:
            return np.zeros(len(self.bands))
        if not self.may_be_isotropic.any():
            return np.zeros(len(self.bands))
        lines = self.line, self.line.steeper(TILT), isotropic.smoother
        transfer = transfer_of(LINEAR, self.scene.contact)
        own, tilted, smoother = (self._of_ground(IsotropicGround(line), line, transfer) for line in lines)
        error = np.abs(tilted - own) / TILT * isotropic.slope_error + OF_SMOOTHING * np.abs(smoother - own)
        return np.asarray(np.where(self.may_be_isotropic, error, 0.0))

    @property
    def may_be_isotropic(self) -> NDArray[np.bool_]:
        """Bands in which an end of what may lie across is isotropic ground."""
        of_ends = [end.across if isinstance(end, LateralBands) else (end,) * len(self.bands) for end in self.ends]
        return np.asarray(np.any([[own == "isotropic" for own in end] for end in of_ends], axis=0))

    @cached_property
    def wave(self) -> FloatArray:
        """q a_x of each band."""
        return self.bands.centres * self.scene.contact.along

    @cached_property
    def lost(self) -> float:
        """h' a_x / d, h' of the waves that strips have."""
        return lost_contact_number(self.scene)

    def counted(self, a3: FloatArray) -> NDArray[np.bool_]:
        """Bands in which the tolerance counts; of sound power all, by their share in the sum."""
        return np.isfinite(a3) if asks_for_power(self.name) else assessed_bands(a3, COUNTED)

    def largest_error(self, a3: FloatArray, error: FloatArray) -> float:
        """The largest of the errors of A3 in bands that count, or what they leave of the sum of sound power [dB].

        Infinite where no band counts.
        """
        if asks_for_power(self.name):
            return RailPower(self.scene, a3).error_of_total(error)
        counted = error[self.counted(a3)]
        return float(counted.max()) if counted.size else math.inf

    def worst_band(self, a3: FloatArray, error: FloatArray) -> int:
        """Where the error is largest, of sound power by the share of the band in the sum."""
        if asks_for_power(self.name):
            known = np.where(np.isfinite(error), error, 0.0)
            return int(np.argmax(RailPower(self.scene, a3).shares * known))
        return int(np.argmax(np.where(self.counted(a3), error, -1.0)))

    def amplitude(self, a3: FloatArray) -> FloatArray:
        """Of A3 in dB: the ratio of amplitudes, the root mean square of the equivalent roughness [m], or the root of
        the sound power over 1 pW in bands of frequency [-]."""
        if asks_for_power(self.name):
            return RailPower(self.scene, a3).amplitude
        if self.name == str(CONTACT_FILTER):
            return np.asarray(10 ** (a3 / 20))
        return np.asarray(MICROMETRE * 10 ** ((a3 + self.scene.levels.levels) / 20))


def _named(alpha: float) -> OneAcross:
    """All lines alike by their name."""
    return alpha or "ridges"
