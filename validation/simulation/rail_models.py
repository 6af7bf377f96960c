"""Contact filters of a wheel on a rail as models: what each finds in bands, and the errors that it claims.

Linear theory of the ellipse was measured beside boundary elements on strips of the same ground; the error of any other
model is its difference from linear theory and that of linear theory. What is not known of the ground comes on top.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL
from validation.engine.engine import Outcome
from validation.scenes.rail import ProfiledRail, RailScene
from validation.simulation.equivalent_displacement import LINEAR, LINEAR_MODELS, RolledRail, log_over, roll_rail
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Model, Target
from validation.simulation.rail_ground import StatedAcross, positions_along, strip_bands, strip_of
from validation.simulation.rail_quantity import RAIL_QUANTITIES, RailQuantity
from validation.simulation.rail_strip import RailStrip
from validation.simulation.spectral_springs import twin_of

FloatArray = NDArray[np.float64]

LINEAR_ERROR, PER_LOST_CONTACT = 0.2, 1.1
"""Error of linear theory beside boundary elements [dB]: 0.2 min(1, q a_x) + 1.1 q a_x h' a_x / d, an envelope of what
was measured: six strips each of both curves, from the limit of ISO 3095 to 20 dB above, loads of 25 to 100 kN, over
ridges, isotropic ground and alpha = 1; 475 of 480 bands are inside, the others within their sample error."""
MOST_LOST, LARGEST_WAVE, ASPECTS = 1.0, 9.5, (0.45, 1.9)
"""h' a_x / d, q a_x and a_y / a_x up to which that was measured."""
MEASURED_ON_STRIPS = (
    f"errors of models: measured beside boundary elements on strips, h' a_x / d of their waves up to {MOST_LOST:g}, "
    f"q a_x up to {LARGEST_WAVE:g}, a_y / a_x from {ASPECTS[0]:g} to {ASPECTS[1]:g}"
)
STRIPS = 6
FINE, COARSE = 12, 8
"""Cells to the smaller semi-axis."""
OF_FINE = 0.8
"""Error of the fine grid over its difference from the coarse one, of second order."""
CLOSED, EVALUATION, POSITION, ITEM = 2e-2, 5e-8, 4e-3, 1e-4
"""Seconds of a closed filter on one ground at the least, and of a wave of it; of a position of boundary elements, and
of one of springs, about."""


@dataclass(frozen=True, eq=False)
class FoundFilter:
    """A3 in each band, the middle of both ends where the ground is not stated, and half-widths of 95 % [dB].

    model: infinite in bands of which no error is known.
    """

    a3: FloatArray
    model: FloatArray
    grid: FloatArray
    sample: FloatArray


class RailModel(Model):
    """A contact filter in bands, by default a linear one whose mean over the stated ground is a quadrature."""

    charted: ClassVar = False

    @property
    def twin(self) -> str:
        """The name of the linear model of a one-sided one, and of that one's track; of any other its own."""
        return twin_of(self.name)

    def serves(self, scene: Any, quantity: str) -> bool:
        return isinstance(scene, RailScene) and quantity in RAIL_QUANTITIES

    def closed(self, quantity: RailQuantity) -> FloatArray:
        """A3 of the linear filter, of a one-sided model that of its linear twin, (ends, bands) [dB]."""
        return quantity.filtered(LINEAR_MODELS[self.twin](quantity.scene.contact))

    def find(self, quantity: RailQuantity, seed: int) -> FoundFilter:
        """Without a sample."""
        a3 = self.closed(quantity).mean(axis=0)
        return FoundFilter(a3, self.model_error(quantity, a3), np.zeros_like(a3), np.zeros_like(a3))

    def model_error(self, quantity: RailQuantity, a3: FloatArray) -> FloatArray:
        """Half-width that model and ground leave in each band, infinite for a radius in place of a profile [dB]."""
        if isinstance(quantity.scene, ProfiledRail):
            return np.full_like(a3, np.inf)
        apart = np.abs(a3 - quantity.linear.mean(axis=0))
        return np.asarray(apart + linear_error(quantity) + quantity.left_by_ground)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        quantity = rail_quantity(target)
        if reason := quantity.no_answer or self.beyond(quantity):
            return ErrorEstimate.out_of_range(reason)
        a3 = self.closed(quantity).mean(axis=0)
        error = self.model_error(quantity, a3)
        return ErrorEstimate(
            model=relative(worst(quantity, a3, error)),
            of_scene=relative(worst(quantity, a3, quantity.left_by_ground)),
            reason=reason_of(quantity, a3, error),
        )

    def beyond(self, quantity: RailQuantity) -> str:
        """Why no error is known; empty where one is."""
        if isinstance(quantity.scene, ProfiledRail):
            return f"errors were measured on two radii: {quantity.scene.stand_in}"
        contact = quantity.scene.contact
        aspect, counted = contact.across / contact.along, strip_bands(quantity.scene).span
        if quantity.lost > MOST_LOST:
            return f"h' a_x / d of waves of {counted} is {quantity.lost:.2g}: errors were measured up to {MOST_LOST:g}"
        if not ASPECTS[0] <= aspect <= ASPECTS[1]:
            return f"a_y / a_x is {aspect:.2g}: errors were measured from {ASPECTS[0]:g} to {ASPECTS[1]:g}"
        return ""

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        quantity = rail_quantity(target)
        ends = len(quantity.ends)
        seconds = max(CLOSED * ends, EVALUATION * evaluations(quantity))
        return Cost(work=ends, unit="closed filters", seconds=seconds)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        quantity = rail_quantity(target)
        work = self.cost(target, resolution).work

        def read(found: FoundFilter) -> Result:
            values = {"a3": found.a3, "model": found.model, "grid": found.grid, "sample": found.sample}
            both = {str(name): replace(quantity, name=name).amplitude(found.a3) for name in RAIL_QUANTITIES}
            failed = "" if np.isfinite(found.a3).all() else "a contact along a strip did not converge"
            return Result({**both, **values}, work, failed=failed)

        return lambda _: Solve(lambda: self.find(quantity, target.seed), read)


class RolledRailModel(RailModel):
    """A one-sided model on strips: its linear twin on the stated ground, and what it is over the twin on strips."""

    setting: ClassVar = f"{STRIPS} strips, constant load"
    cells: ClassVar = (COARSE, FINE)
    seconds: ClassVar = ITEM

    def roll(self, scene: RailScene, strip: RailStrip) -> Outcome:
        """Tracks along a strip of this model and of its twin, by their names [m]; failed: positions without any."""
        return roll_rail(RolledRail(strip=strip, models=(self.name,)))

    def grounds(self, quantity: RailQuantity) -> tuple[StatedAcross, ...]:
        """What lies across on the strips of each end."""
        return quantity.ends

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        quantity = rail_quantity(target)
        along = [positions_along(quantity.scene, cells) for cells in self.cells]
        positions = STRIPS * len(quantity.ends) * sum(along)
        return Cost(work=positions, unit="positions", seconds=self.seconds * positions)

    def find(self, quantity: RailQuantity, seed: int) -> FoundFilter:
        twin, inside = self.closed(quantity), in_strips(quantity)
        over, grid, sample = np.zeros((3, *twin.shape))
        for i, across in enumerate(self.grounds(quantity)):
            coarse, fine = (self.over_twin(quantity.scene, across, cells, seed) for cells in self.cells)
            over[i, inside], sample[i, inside] = fine
            grid[i, inside] = OF_FINE * np.abs(fine[0] - coarse[0])
        a3 = quantity.between(twin + over).mean(axis=0)
        return FoundFilter(a3, self.model_error(quantity, a3), grid.max(axis=0), sample.max(axis=0))

    def over_twin(self, scene: RailScene, across: StatedAcross, cells: int, seed: int) -> tuple[FloatArray, FloatArray]:
        """The model over its linear twin on the same strips, in their bands, and what the sample leaves of it [dB]."""
        strips = [strip_of(scene, across, cells, i, seed) for i in range(STRIPS)]
        outcomes = [self.roll(scene, strip) for strip in strips]
        bands = Bands(tuple(strip_bands(scene).edges.tolist()))
        if any(outcome["failed"] for outcome in outcomes):
            return np.full((2, len(bands.centres)), np.nan)  # type: ignore[return-value]
        found = log_over(self.name, self.twin, outcomes, strips[0].spacing, bands)
        values, errors = zip(*((one.value, one.half_width) for one in found), strict=True)
        return POWER_DECIBEL * np.array(values), POWER_DECIBEL * np.array(errors)


def rail_quantity(target: Target) -> RailQuantity:
    """What is asked; kept, since all models of a scene are asked the same."""
    return _rail_quantity(target.scene, target.quantity)


@lru_cache(maxsize=8)
def _rail_quantity(scene: RailScene, name: Any) -> RailQuantity:
    return RailQuantity(scene, name)


@lru_cache(maxsize=8)
def evaluations(quantity: RailQuantity) -> int:
    """Waves of a closed filter, over all bands and grounds."""
    axes = quantity.scene.contact.along, quantity.scene.contact.across
    return sum(ground.evaluations(edges=quantity.bands.edges, semi_axes=axes) for ground in quantity.structures)


def linear_error(quantity: RailQuantity) -> FloatArray:
    """Of linear theory of the ellipse beside boundary elements, infinite for waves shorter than were measured [dB]."""
    wave = quantity.wave
    error = LINEAR_ERROR * np.minimum(1.0, wave) + PER_LOST_CONTACT * wave * quantity.lost
    return np.where(wave <= LARGEST_WAVE, error, np.inf)


def in_strips(quantity: RailQuantity) -> NDArray[np.bool_]:
    """Bands that a strip has."""
    return np.isin(quantity.bands.numbers, strip_bands(quantity.scene).numbers)


def worst(quantity: RailQuantity, a3: FloatArray, error: FloatArray) -> float:
    """The largest error in bands that count [dB]; infinite where none does."""
    counted = error[quantity.counted(a3)]
    return float(counted.max()) if counted.size else math.inf


def relative(decibels: float) -> float:
    """Of an amplitude."""
    return float(10 ** (decibels / 20) - 1)


def reason_of(quantity: RailQuantity, a3: FloatArray, error: FloatArray) -> str:
    """The band in which the error is largest, and what it is due to there."""
    if not quantity.counted(a3).any():
        return quantity.none_counts
    at = int(np.argmax(np.where(quantity.counted(a3), error, -1.0)))
    causes = [f"h' a_x / d = {quantity.lost:.2g} of waves of {strip_bands(quantity.scene).span}"]
    if (apart := abs(a3[at] - quantity.linear.mean(axis=0)[at])) > LINEAR_ERROR:
        causes.insert(0, f"{apart:.2g} dB off {LINEAR}, on this ground")
    causes = [*ground_causes(quantity, at), *causes]
    return f"its error is largest at {1e3 * quantity.bands.nominal[at]:g} mm: {'; '.join(causes)}"


def ground_causes(quantity: RailQuantity, at: int) -> Iterator[str]:
    """What the ground leaves of the error in a band."""
    apart = f"ridges and isotropic ground are ± {quantity.half_width[at]:.2g} dB apart"
    if quantity.scene.across is None:
        yield f"across is not given, {apart}"
    elif quantity.stands_out[at]:
        yield f"no isotropic ground has this level, {apart}"
    if quantity.smoothing_error[at] > 0:
        yield f"levels that scatter leave ± {quantity.smoothing_error[at]:.2g} dB of isotropic ground"
