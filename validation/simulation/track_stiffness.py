"""Stiffness along a track at constant load: boundary elements at each position, and springs in contact."""

import math
import warnings
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.engine.engine import Outcome
from validation.simulation.rolling_strip import HERTZ, Strip, Tracks, crop_to_reach

FloatArray = NDArray[np.float64]
SMOOTH = 2.0
"""Stiffness 2 E* a of the smooth wheel, a = E* = 1."""


@dataclass(frozen=True, kw_only=True)
class LoadedStrip:
    """One rough strip under a wheel of constant load."""

    strip: Strip
    bands: Bands


def roll_loaded_strip(problem: LoadedStrip) -> Outcome:
    """Boundary elements: `moments` of k = dF/dd at a constant contact area, over 2 E* a; failed: positions."""
    strip, spacing = problem.strip, 1 / problem.strip.cells
    height = np.ascontiguousarray(crop_to_reach(strip.surface(), spacing))
    wheel = bem3d.RollingContact(
        bem3d.Track(height=height, spacing=spacing, radius=1.0, modulus=1.0), tolerance=strip.tolerance
    )
    stiffness = np.array([tangent_stiffness(wheel, position) for position in range(len(height))]) / SMOOTH
    return {**moments(stiffness, spacing, problem.bands), "failed": np.array(float(np.isnan(stiffness).sum()))}


def tangent_stiffness(wheel: bem3d.RollingContact, position: int) -> float:
    """Of the contact under the load of Hertz over one cell of the track; NaN where it does not converge."""
    if not wheel.carry(position, HERTZ).converged:
        return math.nan
    _, _, pressure = wheel.pressure()
    body = half_space(pressure.shape, wheel.track.spacing)
    return bem3d.solve_fixed_area(body, pressure > 0, tolerance=1e-3).stiffness


@cache
def half_space(shape: tuple[int, int], spacing: float) -> bem3d.HalfSpace:
    """Frames along a track have few shapes."""
    return bem3d.HalfSpace(shape=shape, spacing=spacing, modulus=1.0)


def roll_loaded_tracks(tracks: Tracks) -> Outcome:
    """One-sided springs: `moments` of the stiffness along each track."""
    spacing = 1 / tracks.springs
    with warnings.catch_warnings():
        # the smooth contact has springs enough, which is what the warning is about
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        rolled = [mdr.roll(h, spacing=spacing, radius=1.0, modulus=1.0, force=HERTZ) for h in tracks.heights()]
    return moments(np.array([one.stiffness for one in rolled]) / SMOOTH, spacing, tracks.bands)


def moments(stiffness: FloatArray, spacing: float, bands: Bands) -> Outcome:
    """Mean and variance along a track, and the level int C_k dq in each band; along the last axis."""
    return {
        "mean": np.asarray(stiffness.mean(axis=-1)),
        "variance": np.asarray(stiffness.var(axis=-1)),
        "level": levels(waves(stiffness, spacing=spacing), bands),
    }
