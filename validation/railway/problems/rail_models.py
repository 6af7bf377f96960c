"""Contact filters of a wheel on a rail as models: what each finds in bands, and the errors that it claims.

Linear theory of the ellipse was measured beside boundary elements on strips of the same ground; the error of any other
model is its difference from linear theory and that of linear theory. What is not known of the ground comes on top.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.advice.scene_model import Answer, SceneModel
from validation.advice.tolerance import relative
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL
from validation.engine.engine import FloatArray, Outcome
from validation.railway.problems.equivalent_displacement import RolledRail, log_over, roll_rail, transfer_of
from validation.railway.problems.rail_power import RailPower, asks_for_power
from validation.railway.problems.rail_quantity import RAIL_QUANTITIES, RailQuantity
from validation.railway.problems.rail_strip import RailStrip, StatedAcross, positions_along, strip_bands, strip_of
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.railway.scenes.rail import COUNTED, ProfiledRail, RailScene
from validation.scenes.measured_heights import MeasuredHeights
from validation.simulation.method import Resolution, Result, Values
from validation.simulation.model import Cost, ErrorEstimate, Model, Target, model
from validation.simulation.model_names import LINEAR, twin_of

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
CLOSED, EVALUATION, ITEM, DRAWN = 4e-2, 5e-8, 1e-4, 3e-7
"""Seconds of a closed filter on one ground at the least, and of a wave of it; of a position on springs, and of a cell
of a strip that is drawn and filtered, about."""


@dataclass(frozen=True, kw_only=True)
class ContactFilter:
    """A contact filter in bands: a linear one, whose mean over the stated ground is a quadrature, or a one-sided one.

    That is its linear twin on the stated ground, and on strips what it is over the twin. closed: A3 of the linear
    filter or of the twin, (ends, bands) [dB]; seconds: that a position of a strip takes, about; finer: springs to a
    cell, for which a strip is drawn on finer cells, too; is_reference: of the errors of all others; across: what lies
    across on its strips, None for what is stated.
    """

    name: str
    closed: Callable[[RailQuantity], FloatArray]
    seconds: float = ITEM
    finer: int = 1
    is_reference: bool = False
    across: StatedAcross | None = None

    @property
    def on_strips(self) -> bool:
        """Whether it is one-sided, and has a linear twin."""
        return twin_of(self.name) != self.name

    def serves(self, scene: Any, quantity: str) -> bool:
        served = scene.kind == "rail" and quantity in RAIL_QUANTITIES
        return served and (self.across is None or scene.lateral_structure in (self.across, None))

    def find(self, quantity: RailQuantity, seed: int) -> Values:
        """a3: in the middle of both ends where the ground is not stated; model, grid, sample: half-widths of 95 % [dB].

        model: infinite in bands of which no error is known.
        """
        at_ends = self.closed(quantity)
        over, grid, sample = np.zeros((3, *at_ends.shape))
        if self.on_strips:
            inside = in_strips(quantity)
            for i, across in enumerate(quantity.ends):
                coarse, fine = (
                    self.over_twin(quantity.scene, self.across or across, cells, seed) for cells in (COARSE, FINE)
                )
                over[i, inside], sample[i, inside] = fine
                grid[i, inside] = OF_FINE * np.abs(fine[0] - coarse[0])
            at_ends = quantity.between(at_ends + over)
        a3, left = at_ends.mean(axis=0), {"grid": grid.max(axis=0), "sample": sample.max(axis=0)}
        return {"a3": a3, "model": self.model_error(quantity, a3), **left}

    def over_twin(self, scene: RailScene, across: StatedAcross, cells: int, seed: int) -> FloatArray:
        """The model over its linear twin on the same strips, in their bands, and what the sample leaves of it [dB]."""
        strips = [strip_of(scene, across, cells, i, seed) for i in range(STRIPS)]
        outcomes = [self.roll(scene, strip) for strip in strips]
        bands = Bands(tuple(strip_bands(scene).edges.tolist()))
        if any(outcome["failed"] for outcome in outcomes):
            return np.full((2, len(bands.centres)), np.nan)
        estimates = log_over(self.name, twin_of(self.name), outcomes, strips[0].spacing, bands)
        return np.asarray(POWER_DECIBEL * np.array([(estimate.value, estimate.half_width) for estimate in estimates]).T)

    def roll(self, scene: RailScene, strip: RailStrip) -> Outcome:
        """Tracks along a strip of this model and of its twin, by their names [m]; failed: positions without any.

        With the profile across where the scene has one, which boundary elements alone know.
        """
        profile = scene.profile if self.is_reference and isinstance(scene, ProfiledRail) else None
        return roll_rail(RolledRail(strip=strip, models=(self.name,), profile=profile))

    def model_error(self, quantity: RailQuantity, a3: FloatArray) -> FloatArray:
        """Half-width that model and ground leave in each band, infinite for a radius in place of a profile [dB].

        The reference has none of its own; bands that a strip has not are linear theory, with its error, of a profile
        unknown for shorter waves.
        """
        profiled = isinstance(quantity.scene, ProfiledRail)
        if profiled and not self.is_reference:
            return np.full_like(a3, np.inf)
        own, left = linear_error(quantity), quantity.left_by_ground
        if not self.is_reference:
            return np.asarray(np.abs(a3 - quantity.linear.mean(axis=0)) + own + left)
        inside = in_strips(quantity)
        if profiled:
            own = np.where(np.arange(inside.size) > np.flatnonzero(inside).max(), np.inf, own)
        return np.where(inside, 0.0, own) + left

    def claim(self, model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
        """By the filter of the linear twin, before anything rolls."""
        quantity = rail_quantity(target)
        if reason := quantity.no_answer or self.beyond(quantity):
            return ErrorEstimate.out_of_range(reason)
        a3 = self.closed(quantity).mean(axis=0)
        error = self.model_error(quantity, a3)
        return ErrorEstimate(
            model=relative(quantity.largest_error(a3, error)),
            of_scene=relative(quantity.largest_error(a3, quantity.left_by_ground)),
            reason=reason_of(quantity, a3, error),
        )

    def beyond(self, quantity: RailQuantity) -> str:
        """Why no error is known; empty where one is, and for the reference."""
        if self.is_reference:
            return ""
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
        """Positions, and cells that are drawn: all strips on both grids, of springs on finer ones as well."""
        quantity = rail_quantity(target)
        ends = len(quantity.ends)
        closed = Cost(work=ends, seconds=max(CLOSED * ends, EVALUATION * quantity.evaluations))
        if not self.on_strips or quantity.no_answer:
            return closed  # nothing rolls
        shapes = [strip_of(quantity.scene, "ridges", cells, 0, 0).shape for cells in (COARSE, FINE)]
        positions = STRIPS * ends * sum(positions_along(quantity.scene, cells) for cells in (COARSE, FINE))
        drawn = STRIPS * ends * sum(along * across for along, across in shapes)
        drawn *= 1 if self.finer == 1 else 1 + self.finer**2
        return Cost(work=positions + drawn, seconds=closed.seconds + self.seconds * positions + DRAWN * drawn)

    def solve(self, target: Target, resolution: Resolution) -> Result:
        """Of all quantities that the scene has, by their names, and what `find` has."""
        quantity = rail_quantity(target)
        values = self.find(quantity, target.seed)
        names = [name for name in RAIL_QUANTITIES if not quantity.scene.no_answer(name)]
        all_of_them = {name: replace(quantity, name=name).amplitude(values["a3"]) for name in names}
        failed = "" if np.isfinite(values["a3"]).all() else "a contact along a strip did not converge"
        return Result({**all_of_them, **values}, failed=failed)


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class RailModel(Model):
    """filter: what it makes of a rail."""

    filter: ContactFilter


def rail_model(name: str, setting: str, *, is_mdr: bool = False, **of_filter: Any) -> RailModel:
    """of_filter: fields of `ContactFilter`; a linear filter of `LINEAR_MODELS` is known by the name of the model."""

    def linear(quantity: RailQuantity) -> FloatArray:
        return quantity.filtered(transfer_of(twin_of(name), quantity.scene.contact))

    contact_filter = ContactFilter(**{"name": name, "closed": linear, **of_filter})
    about = {"name": name, "setting": setting, "is_mdr": is_mdr, "charted": False, **IN_BANDS}
    plain = model(serves=contact_filter.serves, cost=contact_filter.cost, claim=contact_filter.claim, **about)(
        contact_filter.solve
    )
    return RailModel(filter=contact_filter, **vars(plain))


def rail_quantity(target: Target) -> RailQuantity:
    """What is asked; kept, since all models of a scene are asked the same."""
    return _kept(target.scene, target.quantity)


_kept = lru_cache(maxsize=8)(RailQuantity)


def linear_error(quantity: RailQuantity) -> FloatArray:
    """Of linear theory of the ellipse beside boundary elements, infinite for waves shorter than were measured [dB]."""
    wave = quantity.wave
    error = LINEAR_ERROR * np.minimum(1.0, wave) + PER_LOST_CONTACT * wave * quantity.lost
    return np.where(wave <= LARGEST_WAVE, error, np.inf)


def in_strips(quantity: RailQuantity) -> NDArray[np.bool_]:
    """Bands that a strip has."""
    return np.isin(quantity.bands.numbers, strip_bands(quantity.scene).numbers)


def reason_of(quantity: RailQuantity, a3: FloatArray, error: FloatArray) -> str:
    """The band in which the error is largest, and what it is due to there."""
    if not quantity.counted(a3).any():
        return quantity.none_counts
    at = quantity.worst_band(a3, error)
    measured = quantity.scene.measured_structure is not None
    spread = f"ridges and isotropic ground are ± {quantity.half_width[at]:.2g} dB apart"
    off, smoothing = abs(a3[at] - quantity.linear.mean(axis=0)[at]), quantity.smoothing_error[at]
    is_open, of_strips = quantity.scene.lateral_structure is None, strip_bands(quantity.scene).span
    faults = quantity.left_by_faults[at]
    causes = {
        f"outliers of the measured lines leave ± {faults:.2g} dB": faults > 0,
        f"lateral_structure is not given, {spread}": is_open and not measured,
        f"the lateral structure by the lines leaves ± {quantity.half_width[at]:.2g} dB": measured,
        f"no isotropic ground has this level, {spread}": quantity.stands_out[at] and not is_open,
        f"levels that scatter leave ± {smoothing:.2g} dB of isotropic ground": smoothing > 0,
        f"{off:.2g} dB off {LINEAR}, on this ground": off > LINEAR_ERROR,
        f"h' a_x / d = {quantity.lost:.2g} of waves of {of_strips}": True,
    }
    due = "; ".join(cause for cause, holds in causes.items() if holds)
    place = f"{1e3 * quantity.bands.nominal[at]:g} mm"
    return (
        f"{place} leaves most of its error: {due}"
        if asks_for_power(quantity.name)
        else (f"its error is largest at {place}: {due}")
    )


def answer_in_bands(scene_model: SceneModel) -> Answer:
    """Of one solve, which has all of its strips: the largest errors of the bands in which the tolerance counts, and
    those of each band."""
    (result,) = scene_model.first(scene_model.resolution, 1)
    if result.failed:
        return Answer(value=np.array([np.nan]), cost=scene_model.cost(), failed=result.failed)
    quantity, a3 = rail_quantity(scene_model.target), result.values["a3"]
    if asks_for_power(quantity.name):
        return answer_of_power(scene_model, quantity, result)
    counts = quantity.counted(a3)
    answer = Answer(
        value=result.values[quantity.name],
        cost=scene_model.cost(),
        counted=(
            f"the tolerance counts before the first band with A3 below {COUNTED:g} dB: {quantity.bands.names(counts)}"
            if counts.any()
            else quantity.none_counts
        ),
        counts=tuple(counts.tolist()),
        band_errors={name: result.values[name] for name in ("model", "grid", "sample")},
        seconds=scene_model.seconds_of(1),
    )
    error = answer.error_in_bands
    at = int(np.argmax(np.where(counts, error, -1.0)))
    grid, sample = (relative(float(answer.band_errors[name][at]) * counts[at]) for name in ("grid", "sample"))
    left = relative(quantity.largest_error(a3, error)) - math.hypot(grid, sample)
    reason = reason_of(quantity, a3, error) if np.isfinite(error).any() else ""
    return replace(answer, model=max(left, 0.0), grid=grid, sample=sample, reason=reason)


def answer_of_power(scene_model: SceneModel, quantity: RailQuantity, result: Result) -> Answer:
    """Levels in bands of frequency; the errors of the answer are those of the sum in dB(A)."""
    a3 = result.values["a3"]
    power, parts = RailPower(quantity.scene, a3), {name: result.values[name] for name in ("model", "grid", "sample")}
    model, grid, sample = (relative(power.error_of_total(part)) for part in parts.values())
    error = parts["model"] + np.hypot(parts["grid"], parts["sample"])
    return Answer(
        value=power.amplitude,
        cost=scene_model.cost(),
        model=model,
        grid=grid,
        sample=sample,
        counted=f"the tolerance is that of the sum, {power.total:.1f} dB(A) re 1 pW",
        counts=tuple(np.isfinite(power.level).tolist()),
        band_errors={name: power.half_widths(part) for name, part in parts.items()},
        reason=reason_of(quantity, a3, error) if np.isfinite(error).any() else "",
        seconds=scene_model.seconds_of(1),
    )


def what_would_state_the_ground(target: Target) -> str:
    """Keys of a scene file by which the ground leaves less open, and why."""
    quantity = rail_quantity(target)
    scene, stated = (
        quantity.scene,
        'lateral_structure = "ridges" in [rail], or a number alpha: waves with |k_y| < alpha k_x',
    )
    faults = quantity.left_by_faults
    if 2 * faults.max() > (quantity.left_by_ground - faults).max() and faults.max() > 0:
        return "a measurement without the outliers that the notes name, or a part of it that has none"
    if isinstance(scene.roughness, MeasuredHeights):
        return "a filter of this surface, by its own heights: of its lines both ends of what lies across are open"
    if scene.measured_structure is not None:
        return f"more or longer lines, or lines closer together for short waves; or {stated}"
    if scene.lateral_structure is None:
        return f'to tell what lies across the rail, as lateral_structure = "isotropic" or {stated.partition(" = ")[2]}'
    table = "rail.lines" if isinstance(scene.roughness, MeasuredLines) else "rail.levels"
    if not quantity.stands_out.any():
        return f"levels of more lines or of longer ones, which scatter less; or {stated}"
    rest = quantity.bands.nominal[~quantity.stands_out]
    long = quantity.stands_out[0] and rest.size
    cut = f'; or longest = "{1e3 * rest.max():g} mm" in [{table}]' if long else ""
    return f"{stated}{cut}, since no isotropic ground has the levels at {quantity.bands.names(quantity.stands_out)}"


IN_BANDS: Mapping[str, Any] = {"answer": answer_in_bands, "helps": what_would_state_the_ground}
"""What all models of a rail declare."""
