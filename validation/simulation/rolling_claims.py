"""The errors that cheap models of a rolling wheel claim, and the scenes on which those were measured."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np

from validation.engine.engine import FloatArray
from validation.scenes.rolling import RollingScene
from validation.simulation.calibrated_range import beyond_envelope, beyond_spectrum, counted, lost_contact
from validation.simulation.calibration import calibrated
from validation.simulation.method import Resolution
from validation.simulation.model import ErrorEstimate, Function, Model, Target, model
from validation.simulation.rolling_quantity import QuantityName
from validation.simulation.sampling import distance

Rule = tuple[float, float, float]

LINEAR_RMS: Rule = (1.2, 0.05, 0.002)
"""Of linear theory."""
FORCE_RMS, MOVING_RMS = "force-rms", "acceleration-rms"
"""The quantity whose errors are those of the rms; Geike's rule keeps the variance of the force. That of a wheel that
moves."""
MEASURED_SCATTER = 0.5
"""Of the levels of one track about those of all that have its spectrum."""
NODE = 4.5e-4
"""Seconds that a quadrature across the track takes, about."""


def of_a_wheel(scene: object, quantity: str) -> bool:
    return isinstance(scene, RollingScene) and quantity in get_args(QuantityName)


@dataclass(frozen=True, kw_only=True)
class RollingClaim:
    """The error of a model below boundary elements: a rule in bands, and another in the rms.

    bands, rms: a sum over the contact that linear theory loses, h/d, and one; moving: in the rms of the acceleration, a
    sum over the contact lost, (h/d)^2 times what the resonance adds to the force, whose frequency falls with the
    height, q a of the longest wave above it, whose level springs miss, and one: what the reference leaves. They are
    envelopes of what was measured beside boundary elements on random scenes, for scenes beyond the calibration.
    on_bands, on_rms: what else the error rests on; own: error of one measured track about all that have its spectrum;
    of_spectrum: whether the model knows a surface by its spectrum alone; sample: the tolerance over what realisations
    leave of it; size, most: of what is drawn at once, and what there may be of that; too_large: how much is needed.
    """

    bands: Rule
    rms: Rule = LINEAR_RMS
    moving: tuple[float, float, float, float] | None = None
    on_bands: str = ""
    on_rms: str = ""
    own: float = MEASURED_SCATTER
    of_spectrum: bool = True
    sample: float = math.inf
    size: Callable[[Target, Resolution], float] = lambda target, resolution: 0.0
    most: float = math.inf
    too_large: str = ""

    def model(self, **declared: Any) -> Callable[[Function], Model]:
        """Decorator of a function that has this claim, unless it is declared otherwise."""
        own = {"claim": self.estimate, "shape": self.shape, "left_out": self.left_out, "serves": of_a_wheel}
        return model(**{**own, **declared})

    def estimate(self, model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
        quantity, ground = target.rolling, target.scene.ground
        beyond = beyond_spectrum(ground) if self.of_spectrum else str(ground.not_gaussian())
        if reason := beyond or quantity.no_answer:
            return ErrorEstimate.out_of_range(reason)
        if not (expected := calibrated(model, target)).in_range:
            expected = self._by_envelope(target, expected.reason)
        if not expected.in_range:
            return expected
        if (size := self.size(target, resolution)) > self.most:
            return ErrorEstimate.out_of_range(f"{self.too_large.format(size)}, more than {self.most:.2g}")
        own = self.own if ground.is_single else 0.0
        scatters = f"one track scatters {own:.0%} about the mean of its spectrum" if own else ""
        rests_on = scatters, self.on_rms if quantity.name == FORCE_RMS else self.on_bands, expected.reason
        reason = "; ".join(filter(None, rests_on))
        return ErrorEstimate(model=expected.model + own, sample=target.tolerance / self.sample, reason=reason)

    def shape(self, target: Target) -> float:
        """What the error goes with."""
        quantity, (lost, ratio) = target.rolling, _causes(target)
        if self.moving and target.quantity == MOVING_RMS:
            longest = quantity.longest_moving * target.scene.contact_radius
            return float(np.dot(self.moving, (lost, ratio**2 * (quantity.amplification - 1), longest, 1.0)))
        return float(np.dot(self.rms if target.quantity == FORCE_RMS else self.bands, (lost, ratio, 1.0)))

    def _by_envelope(self, target: Target, why: str) -> ErrorEstimate:
        """why: the scene is not one of the table."""
        if reason := beyond_envelope(target.rolling):
            return ErrorEstimate.out_of_range(reason)
        lost, ratio = _causes(target)
        height = "h/d, by the resonance" if target.rolling.amplification > 1 else "h/d"
        named = counted({"loss of contact by linear theory": lost, height: ratio})
        return ErrorEstimate(model=self.shape(target), reason=f"an envelope, not calibrated ({why}): {named}")

    def left_out(self, target: Target, value: FloatArray) -> float:
        """Error of bands in which measured heights have next to no waves: what linear theory leaves out fills them.

        That is h/d of the level of all bands, in each of them.
        """
        return filled(target, value, 1.0) if target.scene.ground.is_single else 0.0


def _causes(target: Target) -> tuple[float, float]:
    """The share of the contact that linear theory loses, and h/d, by the resonance."""
    return lost_contact(target.scene), target.scene.roughness_ratio * target.rolling.amplification


def filled(target: Target, value: FloatArray, share: float) -> float:
    """Error of quiet bands that have so much more: a share of h/d of the level of all bands."""
    if value.size == 1:
        return 0.0
    other = share * target.scene.roughness_ratio * float(np.linalg.norm(value))
    return distance(np.hypot(value, other), value)
