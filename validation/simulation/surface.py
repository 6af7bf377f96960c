"""Rough surfaces on a grid: drawn from a spectrum, or the one that was measured."""

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bem3d
from bem3d.checks import Spectrum
from validation.scenes.measured import MeasuredHeights
from validation.scenes.roughness import RoughSurface


def draw_surface(c2d: Spectrum, **settings: Any) -> NDArray[np.float64]:
    """`bem3d.rough_surface`, silent about few cells to a wave: grids are compared, and what they leave is measured."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        return bem3d.rough_surface(c2d, **settings)


def surface_on_grid(
    ground: RoughSurface, *, shape: tuple[int, int], spacing: float, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Heights at the centres of cells: a realisation with the rms height, or the mean of what was measured."""
    if isinstance(ground, MeasuredHeights):
        return ground.mean_over_cells(shape, spacing)
    return draw_surface(ground.c2d, shape=shape, spacing=spacing, rng=rng, rms=ground.rms)
