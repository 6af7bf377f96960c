"""A wheel rolled over rough ground with one model, in levels: the values of the models of a rolling wheel."""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

import bem3d
import mdr
from validation.analysis.spectra import levels, waves
from validation.engine.engine import FloatArray
from validation.engine.realisations import random_generator
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingQuantity
from validation.simulation.contact_laws import BoundaryElementsLaw, ContactLaw, LinearLaw, SpringsLaw
from validation.simulation.method import too_few
from validation.simulation.motion import simulate_from_linear_motion
from validation.simulation.surface import draw_track, surface_on_grid
from validation.simulation.track_spectrum import InputSpectrum
from validation.simulation.wheel_on_half_space import crop_to_reach, linear_law_3d
from validation.simulation.wheel_on_springs import linear_law_1d
from validation.theory.rolling import linear_force

TRACKS, STRIPS = 1, 2
"""The spawn keys under which each kind of roughness draws."""
LONGEST, RADII = 8, 32
"""Longest waves, and contact radii, along a strip at least."""
ACROSS, WIDE = 3, 6
"""Longest waves, and contact radii, across a strip at least."""
SPRINGS = 32
"""Springs to a contact radius at least; there are four to the shortest wave."""
FINE, LEAST = 4.0, 8
"""Cells to the shortest wave on the fine grid, and to a contact radius at least on either."""
MOST_CELLS = 64
"""Cells to a contact radius on the finest grid that is offered."""
MOST_GRIDS, GROWTH = 3, 1.5
"""Grids of measured points, and the ratio of one to the next at the least."""


@dataclass(frozen=True)
class RollingGrid:
    """A grid along and across the track: spacing a / cells [m], cells along and across."""

    spacing: float
    along: int
    across: int
    cells: float

    @classmethod
    def of(cls, quantity: RollingQuantity, cells: float) -> "RollingGrid":
        """Long enough for some of the longest waves, or as long as what was measured, there and back.

        A dynamic wheel comes back in the middle of a turn of its resonance, where free vibration is least excited.
        """
        scene, ground = quantity.scene, quantity.ground
        a = scene.contact_radius
        spacing = a / cells
        if isinstance(ground, MeasuredHeights):
            long, wide = ground.sides
            along, across = (math.floor(side / spacing * (1 + 1e-9)) for side in (long, wide))
            return cls(spacing, 2 * along, across, cells)
        longest = 2 * math.pi / ground.q_min
        # whole radii, so that all grids draw the same surface
        length = max(LONGEST * longest, RADII * a)
        if quantity.dynamic:
            turn = 2 * math.pi * (scene.speed or 0.0) / scene.body.eigenfrequency
            length = (math.ceil(length / turn) + 0.5) * turn
        wide = max(ACROSS * longest, WIDE * a)
        along, across = (round(cells * math.ceil(side / a)) for side in (length, wide))
        return cls(spacing, along, across, cells)

    @property
    def work(self) -> float:
        """Cell applications of one strip: a window of three radii, doubled in free space."""
        return self.along * APPLICATIONS * (3 * self.cells) ** 2


APPLICATIONS = 7
"""Applications of the operator a position."""


def grids_of_points(heights: MeasuredHeights, contact_radius: float) -> tuple[float, ...]:
    """Cells to a contact radius, an odd number of them to each of the measured points.

    So each point is the middle of a cell on every grid: others miss its summit, each by another part of it.
    """
    points, odd = contact_radius / min(heights.spacing), 1
    grids: list[float] = []
    while len(grids) < MOST_GRIDS and odd * points <= MOST_CELLS:
        if odd * points >= LEAST:
            grids.append(odd * points)
        odd = 2 * math.ceil(GROWTH * odd / 2 - 0.5) + 1
    return tuple(grids)


def strip_of(quantity: RollingQuantity, cells: float, realisation: int, seed: int) -> FloatArray:
    """Heights at the centres of cells; drawn, or those that were measured, there and back [m]."""
    grid, ground = RollingGrid.of(quantity, cells), quantity.ground
    along = grid.along // 2 if ground.is_single else grid.along
    rng = random_generator(seed, STRIPS, realisation)
    surface = surface_on_grid(ground, shape=(along, grid.across), spacing=grid.spacing, rng=rng)
    return np.concatenate([surface, surface[::-1]]) if ground.is_single else surface


def by_linear_theory(quantity: RollingQuantity, surface: FloatArray, spacing: float) -> FloatArray:
    """Root mean square in each band along a strip, for a contact that keeps its radius."""
    force = linear_force(surface, spacing=spacing, **quantity.scene.body.smooth)
    return levels_of(quantity, force, spacing, quantity.transfer)


def by_boundary_elements(quantity: RollingQuantity, surface: FloatArray, spacing: float) -> FloatArray:
    """Root mean square in each band along a strip; NaN where a contact did not converge."""
    body = quantity.scene.body
    strip = crop_to_reach(surface, spacing, body)
    # the lower the roughness, the less its waves change the force, and the finer the residual
    tolerance = float(np.clip(1e-4 * quantity.scene.roughness_ratio, 1e-7, 3e-5))
    if quantity.dynamic:
        law = partial(BoundaryElementsLaw, body, [strip], spacing, tolerance=tolerance)
        return np.asarray(_acceleration_levels(quantity, law, linear_law_3d(body, surface, spacing), spacing)[0])
    rolling = bem3d.roll(strip, spacing=spacing, tolerance=tolerance, raise_on_failure=False, **body.smooth)
    if not rolling.converged.all():
        return np.full(len(quantity.bands.edges) - 1, np.nan)
    if few := too_few(float(np.median(rolling.area)) / spacing**2, "cells"):
        raise ValueError(few)
    return levels_of(quantity, rolling.force, spacing)


def on_boundary_elements(quantity: RollingQuantity, cells: float, realisation: int, seed: int) -> FloatArray:
    """ln of levels over those of linear theory on the same strip; of measured heights, of the levels themselves."""
    surface, spacing = strip_of(quantity, cells, realisation, seed), quantity.scene.contact_radius / cells
    log_levels = np.log(by_boundary_elements(quantity, surface, spacing))
    if quantity.ground.is_single:
        return log_levels
    return np.asarray(log_levels - np.log(by_linear_theory(quantity, surface, spacing)))


def on_springs(quantity: RollingQuantity, tracks: int, seed: int) -> FloatArray:
    """ln of levels of one-sided springs over what linear theory expects, (tracks, bands).

    Of the rms of the force, on tracks of Geike's spectrum and over the linear filter on them; else on tracks of
    the rolling spectrum, over the half-space.
    """
    body = quantity.scene.body
    height, spacing = _draw_tracks(quantity, tracks, seed)
    if quantity.dynamic:
        law, linear = partial(SpringsLaw, body, height, spacing), linear_law_1d(body, height, spacing)
        band_rms = _acceleration_levels(quantity, law, linear, spacing)
        return np.asarray(np.log(band_rms) - np.log(quantity.expected(one_dimensional=False)))
    wheel = {"spacing": spacing, **body.smooth}
    with warnings.catch_warnings():
        # how far a linear contact is off is what both are compared for
        warnings.simplefilter("ignore", mdr.LinearityWarning)
        band_rms = levels_of(quantity, np.array([mdr.roll(track, **wheel).force for track in height.T]), spacing)
        if quantity.name == "force-rms":
            filtered = np.array([mdr.roll(track, contact="linear", **wheel).force for track in height.T])
            return np.asarray(np.log(band_rms) - np.log(levels_of(quantity, filtered, spacing)))
    return np.asarray(np.log(band_rms) - np.log(quantity.expected(one_dimensional=False)))


def springs_to_a_radius(quantity: RollingQuantity) -> int:
    """Springs to a contact radius: four to the shortest wave, and 32 at least."""
    scene = quantity.scene
    return max(SPRINGS, math.ceil(4 * quantity.ground.q_max * scene.contact_radius / (2 * math.pi)))


def _draw_tracks(quantity: RollingQuantity, tracks: int, seed: int) -> tuple[FloatArray, float]:
    """Heights of so many tracks, (places, tracks), and the spacing of their springs [m]."""
    ground, a, springs = quantity.ground, quantity.scene.contact_radius, springs_to_a_radius(quantity)
    points, spacing = RollingGrid.of(quantity, 1).along * springs, a / springs
    rule: InputSpectrum = "geike" if quantity.name == "force-rms" else "rolling"
    draw = partial(draw_track, ground, rule, contact_radius=a, rms=ground.rms, length=points * spacing, points=points)
    return np.array([draw(rng=random_generator(seed, TRACKS, i)) for i in range(tracks)]).T, spacing


def _acceleration_levels(
    quantity: RollingQuantity, law: Callable[[], ContactLaw], linear: LinearLaw, spacing: float
) -> FloatArray:
    """Levels of wheels over one round, (wheels, bands), begun on the linear motion that repeats itself; NaN where lost.

    A contact did not converge, or a wheel flew so high that sums of springs would be rounded.
    """
    assert quantity.scene.speed is not None  # a dynamic quantity has a speed
    try:
        motion = simulate_from_linear_motion(law(), linear, spacing / quantity.scene.speed, len(linear.change))
    except (ArithmeticError, bem3d.ConvergenceError):
        return np.full((linear.change.shape[1], len(quantity.bands.edges) - 1), np.nan)
    return levels_of(quantity, motion.acceleration.T, spacing)


def levels_of(
    quantity: RollingQuantity,
    series: FloatArray,
    spacing: float,
    transfer: Callable[[FloatArray], FloatArray] | None = None,
) -> FloatArray:
    """sqrt(2 sum |c|^2) over each band, along the last axis of a series."""
    harmonics = waves(series, spacing=spacing)
    if transfer is not None:
        harmonics = type(harmonics)(harmonics.q, harmonics.amplitude * transfer(harmonics.q))
    return np.asarray(np.sqrt(2 * levels(harmonics, quantity.bands)))
