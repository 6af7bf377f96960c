"""Cheap models of a rolling wheel, linear filters and springs, and the errors that they claim."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from validation.advice.calibration import beyond_envelope, beyond_spectrum, calibrated, counted, lost_contact
from validation.engine.engine import FloatArray
from validation.scenes.measured_heights import OBLONG
from validation.scenes.rolling import QUANTITIES, RollingQuantity
from validation.simulation.method import Resolution, Result, distance
from validation.simulation.model import Cost, ErrorEstimate, Function, Model, Target, model
from validation.simulation.model_names import FILTER_1D, FILTER_3D, SPRINGS
from validation.simulation.rolling_levels import (
    FINE,
    LEAST,
    RollingGrid,
    by_linear_theory,
    on_springs,
    springs_to_a_radius,
    strip_of,
)

Rule = tuple[float, float, float]

LINEAR_RMS: Rule = (1.2, 0.05, 0.002)
"""Of linear theory."""
FORCE_RMS, MOVING_RMS = "force-rms", "acceleration-rms"
"""The quantity whose errors are those of the rms; Geike's rule keeps the variance of the force. That of a wheel that
moves."""
MEASURED_SCATTER = 0.5
"""Of the levels of one track about those of all that have its spectrum."""
NODE = 1.5e-4
"""Seconds that a quadrature across the track takes, about."""
FORMULAS, FORMULA = 1e-4, 6e-6
"""Seconds that formulas take at the least, and one at a node, about."""
WIDE = 4000.0
"""q a beyond which a quadrature across takes longer: its panels go with q a."""
SECOND_ORDER = 0.1
"""Of h/d times the level of all bands: what the loss of contact puts into each band that linear theory finds quiet."""
TRACKS = 60
MOST_ON_TRACKS = 2**27
"""Springs that are drawn at once at the most, which take up to four gigabytes."""
SPRING = 1.0e-6
"""Seconds that a position on springs takes, about."""


def of_a_wheel(scene: Any, quantity: str) -> bool:
    return scene.kind == "wheel" and quantity in QUANTITIES


@dataclass(frozen=True, kw_only=True)
class RollingClaim:
    """The error of a model below boundary elements: a rule in bands, and another in the rms.

    bands, rms: a sum over the contact that linear theory loses, h/d, and one; moving: in the rms of the acceleration, a
    sum over the contact lost, (h/d)^2 times what the resonance adds to the force, whose frequency falls with the
    height, q a of the longest wave above it, whose level springs miss, and one: what the reference leaves. They are
    envelopes of what was measured beside boundary elements on random scenes, for scenes beyond the calibration.
    on_bands, on_rms: what else the error rests on; own: error of one measured track about all that have its spectrum;
    of_spectrum: whether the model knows a surface by its spectrum alone.
    """

    bands: Rule
    rms: Rule = LINEAR_RMS
    moving: tuple[float, float, float, float] | None = None
    on_bands: str = ""
    on_rms: str = ""
    own: float = MEASURED_SCATTER
    of_spectrum: bool = True

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
        scatter_of_one = self.own if ground.is_single else 0.0
        scatters = f"one track scatters {scatter_of_one:.0%} about the mean of its spectrum" if scatter_of_one else ""
        rests_on = scatters, self.on_rms if quantity.name == FORCE_RMS else self.on_bands, expected.reason
        reason = "; ".join(filter(None, rests_on))
        return ErrorEstimate(model=expected.model + scatter_of_one, reason=reason)

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
    missing_level = share * target.scene.roughness_ratio * float(np.linalg.norm(value))
    return distance(np.hypot(value, missing_level), value)


ON_A_LINE = RollingClaim(
    bands=(2.0, 0.5, 0.55),
    on_bands="Geike's rule does not keep levels along a track",
    on_rms="Geike's rule keeps the variance of the force",
)
ON_HALF_SPACE = RollingClaim(bands=(2.0, 0.5, 0.015), moving=(1.2, 3.0, 0.0, 0.008), own=0.0, of_spectrum=False)


def formulas(target: Target, resolution: Resolution) -> Cost:
    nodes = target.rolling.nodes
    return Cost(work=nodes, seconds=FORMULAS + FORMULA * nodes)


@ON_A_LINE.model(name=FILTER_1D, setting="Geike's spectrum", cost=formulas)
def linear_filter_1d(target: Target, resolution: Resolution) -> FloatArray:
    """(14.12). Exact over ridges; over isotropic ground in the variance of the force alone."""
    return target.rolling.expected(one_dimensional=True)


def quadratures(target: Target, resolution: Resolution) -> Cost:
    nodes, wide = target.rolling.nodes, target.rolling.q_max * target.scene.contact_radius
    return Cost(work=nodes, seconds=NODE * nodes * max(1.0, wide / WIDE))


def claim(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """Ridges lose contact where waves in all directions do not: as much again as the gradient g a/d is left."""
    expected, ground = ON_HALF_SPACE.estimate(model, target, resolution), target.scene.ground
    if not ground.is_single or ground.texture <= OBLONG:
        return expected
    gradient = ground.gradient * target.scene.contact_radius / target.scene.approach
    reason = f"{expected.reason}; heights are anisotropic, rms gradient g a/d = {gradient:.2g}"
    return replace(expected, model=expected.model + gradient, reason=reason)


def left_out(target: Target, value: FloatArray) -> float:
    """Of measured heights also what cells twice as long change; of drawn ones what fills their quiet bands."""
    if not target.scene.ground.is_single:
        return filled(target, value, SECOND_ORDER)
    return ON_HALF_SPACE.left_out(target, value) + distance(value, _of_heights(target.rolling, 1))


@ON_HALF_SPACE.model(
    name=FILTER_3D,
    setting="a contact that keeps its radius",
    # the rms of the force over drawn ground is that of one dimension
    serves=lambda scene, quantity: of_a_wheel(scene, quantity) and (quantity != FORCE_RMS or scene.ground.is_single),
    cost=quadratures,
    claim=claim,
    left_out=left_out,
)
def linear_filter_3d(target: Target, resolution: Resolution) -> Result:
    """On the half-space; of measured heights, on themselves."""
    quantity, heights = target.rolling, target.scene.ground.is_single
    value = _of_heights(quantity) if heights else quantity.expected(one_dimensional=False)
    failed = "" if (value > 0).all() else "the heights have no waves in some band"
    return Result({quantity.name: value}, failed=failed)


def _of_heights(quantity: RollingQuantity, finer: int = 2) -> FloatArray:
    """On cells so many times finer than boundary elements need at the least."""
    a = quantity.scene.contact_radius
    cells = finer * max(LEAST, math.ceil(FINE * quantity.q_max * a / (2 * math.pi)))
    return by_linear_theory(quantity, strip_of(quantity, cells, 0, 0), a / cells)


def positions(target: Target, resolution: Resolution) -> Cost:
    """Of all tracks, and what linear theory expects."""
    work = TRACKS * RollingGrid.of(target.rolling, 1).along * resolution.size
    nodes = 0 if target.quantity == FORCE_RMS else target.rolling.nodes
    return Cost(work=work, seconds=SPRING * work + NODE * nodes)


ON_TRACKS = RollingClaim(
    bands=(0.0, 0.6, 0.45),
    rms=(1.0, 0.1, 0.002),
    moving=(0.5, 0.0, 0.06, 0.02),
    on_bands="springs have the right level only in the mean over bands",
)


def on_tracks(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """The tracks leave a tenth of the tolerance, if they fit into memory."""
    expected, needed = ON_TRACKS.estimate(model, target, resolution), positions(target, resolution).work
    if not expected.in_range:
        return expected
    if needed > MOST_ON_TRACKS:
        reason = f"{TRACKS} tracks need {needed:.2g} springs, more than {MOST_ON_TRACKS:.2g}"
        return ErrorEstimate.out_of_range(reason)
    return replace(expected, sample=target.tolerance / 10)


@ON_TRACKS.model(
    name=SPRINGS,
    setting=f"{TRACKS} tracks",
    resolutions=lambda target: (Resolution(size=springs_to_a_radius(target.rolling)),),
    cost=positions,
    claim=on_tracks,
    charted=False,
    is_mdr=True,
)
def springs(target: Target, resolution: Resolution) -> Result:
    """One-sided springs: the mean of logarithms over tracks."""
    expected = target.rolling.expected(one_dimensional=target.quantity == FORCE_RMS)
    change = on_springs(target.rolling, TRACKS, target.seed)
    failed = "" if np.isfinite(change).all() else "a wheel lifted off farther than the sums are exact for"
    return Result({target.quantity: expected * np.exp(change)}, count=len(change), failed=failed)
