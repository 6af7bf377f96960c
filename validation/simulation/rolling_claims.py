"""The errors that cheap models of a rolling wheel claim, and the scenes on which those were measured."""

from dataclasses import replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.scenes.rolling import RollingScene
from validation.simulation.calibrated_range import (
    HEIGHT,
    HURST,
    LONG,
    RATIO,
    SHORT,
    Ranges,
    beyond_spectrum,
    counted,
    lost_contact,
    outside,
    rolling_conditions,
)
from validation.simulation.calibration import calibrated
from validation.simulation.method import Resolution
from validation.simulation.model import ErrorEstimate, Model, Target
from validation.simulation.rolling_quantity import RollingQuantity
from validation.simulation.sampling import distance

FloatArray = NDArray[np.float64]
Rule = tuple[float, float, float]
MovingRule = tuple[float, float, float, float]
LINEAR_BANDS: Rule = (2.0, 0.5, 0.015)
LINEAR_RMS: Rule = (1.2, 0.05, 0.002)
GEIKE_BANDS: Rule = (2.0, 0.5, 0.55)
FED_BANDS: Rule = (0.0, 0.6, 0.45)
SPRINGS_RMS: Rule = (1.0, 0.1, 0.002)
READ_BANDS: Rule = (1.8, 0.4, 0.02)
READ_RMS: Rule = (0.8, 0.05, 0.004)
LAYER_BANDS: Rule = (0.0, 0.1, 0.12)
LAYER_RMS: Rule = (0.02, 0.03, 0.005)
"""Errors of linear theory, of that with Geike's spectrum in one dimension, of springs, of springs that read the
surface, and of the pressed layer, in bands and in the rms: a
sum over the contact that linear theory loses, h/d, and one. Envelopes of what was measured beside boundary elements on
random scenes, for scenes that are not in the table of the calibration."""
LINEAR_MOVING: MovingRule = (1.2, 3.0, 0.0, 0.008)
SPRINGS_MOVING: MovingRule = (0.5, 0.0, 0.06, 0.02)
"""The same in the rms of the acceleration, of linear theory and of springs: a sum over the contact lost, (h/d)^2 times
what the resonance adds to the force, whose frequency falls with the height, q a of the longest wave above it, whose
level springs miss, and one: what the reference leaves."""
FORCE_RMS = "force-rms"
"""The quantity whose errors are those of the rms; Geike's rule keeps the variance of the force."""
MOVING_RMS = "acceleration-rms"
SECOND_ORDER = 0.1
"""Of h/d times the level of all bands: what the loss of contact puts into each band that linear theory finds quiet."""
MEASURED_SCATTER = 0.5
"""Of the levels of one track about those of all that have its spectrum."""
FORMULA, NODE, SPRING, CELL, POSITION = 1.0e-4, 4.5e-4, 6.0e-7, 2.0e-8, 1.0e-3
"""Seconds that a formula at a node takes, a quadrature across the track there, a position on springs, a cell in an
application, what else a contact, about."""
RANGES: Ranges = {HEIGHT: (0, 1), LONG: (0, 2), SHORT: (0, 40), RATIO: (2, 64), HURST: (0.2, 1.2)}
"""Scenes for which the errors above hold: drawn ones were rolled with h/d from 0.003, q a of the longest wave from
0.2 and bands up to a factor 20 wide. Longer waves only move the contact, which linear theory knows; that it holds
in wider bands is taken from Table 14.1 alone."""


class CheapRollingModel(Model):
    """A model below boundary elements: its error is a rule in bands, and another in the rms.

    bands, rms, moving: the rules, of a moving wheel that in bands where there is no other; on_bands, on_rms: what else
    the error rests on; own: error of one measured track about all that have its spectrum.
    """

    bands: ClassVar[Rule]
    rms: ClassVar[Rule] = LINEAR_RMS
    moving: ClassVar[MovingRule | None] = None
    on_bands: ClassVar[str] = ""
    on_rms: ClassVar[str] = ""
    own: ClassVar[float] = MEASURED_SCATTER

    def serves(self, scene: object, quantity: str) -> bool:
        return isinstance(scene, RollingScene) and quantity != "stiffness"

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        quantity, single = target.rolling, target.scene.ground.is_single
        if reason := self.beyond(target) or quantity.no_answer:
            return ErrorEstimate.out_of_range(reason)
        expected = calibrated(self, target)
        if not expected.in_range:
            expected = self._by_envelope(target, expected.reason)
        if not expected.in_range:
            return expected
        reasons = [self.on_rms if quantity.name == FORCE_RMS else self.on_bands, expected.reason]
        own = self.own if single else 0.0
        if own:
            reasons.insert(0, f"one track scatters {own:.0%} about the mean of its spectrum")
        return replace(expected, model=expected.model + own, reason="; ".join(filter(None, reasons)))

    def shape(self, target: Target) -> float:
        if self.moving and target.quantity == MOVING_RMS:
            return float(np.dot(self.moving, (*_causes_of_moving(target.rolling), 1.0)))
        return float(np.dot(self.rms if target.quantity == FORCE_RMS else self.bands, (*_causes(target.rolling), 1.0)))

    def _by_envelope(self, target: Target, why: str) -> ErrorEstimate:
        """why: the scene is not one of the table."""
        quantity = target.rolling
        scene = target.scene
        longest = scene.ground.q_min * scene.contact_radius
        conditions = {**rolling_conditions(quantity), LONG: longest, HEIGHT: scene.roughness_ratio}
        if reason := outside(conditions, RANGES):
            return ErrorEstimate.out_of_range(reason)
        lost, ratio = _causes(quantity)
        height = "h/d, by the resonance" if quantity.amplification > 1 else "h/d"
        named = counted({"loss of contact by linear theory": lost, height: ratio})
        return ErrorEstimate(model=self.shape(target), reason=f"an envelope, not calibrated ({why}): {named}")

    def beyond(self, target: Target) -> str:
        """Why the model cannot know this surface; empty where it can."""
        return beyond_spectrum(target.scene.ground)

    def left_out(self, target: Target, value: FloatArray) -> float:
        """Error of bands in which measured heights have next to no waves: what linear theory leaves out fills them.

        That is h/d of the level of all bands, in each of them.
        """
        return filled(target, value, 1.0) if target.scene.ground.is_single else 0.0


def _causes(quantity: RollingQuantity) -> tuple[float, float]:
    """The share of the contact that linear theory loses, and h/d, by the resonance."""
    return lost_contact(quantity.scene), quantity.scene.roughness_ratio * quantity.amplification


def _causes_of_moving(quantity: RollingQuantity) -> tuple[float, float, float]:
    """The share of the contact lost, (h/d)^2 times what the resonance adds, and q a of the longest wave that counts."""
    lost, ratio = _causes(quantity)
    return lost, ratio**2 * (quantity.amplification - 1), quantity.longest_moving * quantity.scene.contact_radius


def filled(target: Target, value: FloatArray, share: float) -> float:
    """Error of quiet bands that have so much more: a share of h/d of the level of all bands."""
    if value.size == 1:
        return 0.0
    other = share * target.scene.roughness_ratio * float(np.linalg.norm(value))
    return distance(np.hypot(value, other), value)
