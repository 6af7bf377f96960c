"""The rough face of a body that is pressed, on a grid: how large and how fine it must be, drawn or measured."""

import math
from functools import lru_cache, partial
from typing import Any

import numpy as np

from validation.engine.engine import FloatArray
from validation.engine.realisations import random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.roughness import RoughSurface
from validation.scenes.scene import STIFFNESS
from validation.simulation.surface import draw_surface
from validation.theory.half_space import on_panels
from validation.theory.rolling import rms_gradient

SURFACES = 2
"""The spawn key under which surfaces draw."""
FEW, MANY = 16, 512
"""Cells a side of the coarsest grid that is worth a solve, and of the finest that is offered to drawn heights."""
MANY_POINTS = 2048
"""Finest grid of measured heights, solved once and on their own points: a mean over cells hides their summits."""
WAVE = 8
"""Cells to the shortest wave on the finest grid."""
RADIUS = 16
"""Cells to the contact radius of a smooth sphere, on the finest grid."""
CONTACT = 16
"""Cells in the contact of a rough punch, on the finest grid."""
DEEPEST = 4.0
"""Heights of roughness, in rms, that a rough sphere may carry outside of its smooth contact."""
MARGIN = 16
"""Points beyond what a sphere may touch: two cells of a grid of an eighth as many a side."""
LATTICE = 512
"""Waves on a side up to which their mean square is summed one by one; shorter ones are an integral."""


def is_pressed(scene: Any, quantity: str) -> bool:
    """Whether a model of stiffness may have the quantity."""
    return scene.kind in ("sphere", "punch") and quantity == str(STIFFNESS)


def is_rough(scene: Any, quantity: str) -> bool:
    """Whether a model of the stiffness of a rough body may have the quantity."""
    return is_pressed(scene, quantity) and scene.ground is not None


def ground_of(scene: IndentationScene) -> RoughSurface:
    """The roughness of a body. Raises ValueError for a smooth one."""
    if scene.ground is None:
        raise ValueError("scene must be rough for this model")
    return scene.ground


def side_of(scene: IndentationScene) -> float:
    """Side of the model: that of the punch, or what a rough sphere may touch and the longest wave [m]."""
    if scene.shape == "punch":
        return scene.size
    ground = ground_of(scene)
    if isinstance(ground, MeasuredHeights):
        spacing, points = min(ground.spacing), len(ground.places[0])
        between = math.ceil(_reach(scene, ground) / spacing)
        # an even or odd number of cells as of points, so that these are the middles of those
        return min((between + (points - between) % 2) * spacing, *ground.sides)
    return max(2 * math.sqrt(2 * scene.size * (scene.approach + DEEPEST * ground.rms)), ground.longest)


def _reach(scene: IndentationScene, heights: MeasuredHeights) -> float:
    """Side of the square of all points that a sphere may touch, x^2 / 2R <= d - min h + h, min within r <= a [m].

    No deeper than that goes a sphere that would press a plane at the lowest point of its smooth contact. About it,
    cells of the coarsest grid on which its error is estimated.
    """
    x, y = (np.abs(end) for end in heights.places)
    squared = x[:, np.newaxis] ** 2 + y**2
    under = squared <= max(scene.contact_radius**2, float(squared.min()))
    deepest = scene.approach - float(heights.height[under].min())
    touched = squared <= 2 * scene.size * (deepest + heights.height)
    farthest = max(float(x[touched.any(axis=1)].max()), float(y[touched.any(axis=0)].max()))
    return 2 * (farthest + MARGIN * max(heights.spacing))


def sufficient_cells(scene: IndentationScene) -> int:
    """A power of two with eight cells to the shortest wave and 16 in contact; of measured heights, one to a point.

    In contact is a part 2 F / (E* g L^2) of a punch under a light load, g the rms gradient.
    Source: Hyun, Pei, Molinari, Robbins, Phys. Rev. E 70, 026117 (2004).
    """
    ground = ground_of(scene)
    if isinstance(ground, MeasuredHeights):
        return max(FEW, round(side_of(scene) / min(ground.spacing)))
    cells = WAVE * ground.q_max * side_of(scene) / (2 * math.pi)
    if scene.shape == "sphere":
        cells = max(cells, RADIUS * side_of(scene) / scene.contact_radius)
    else:
        gradient = rms_gradient(ground.c2d, edges=ground.edges)
        cells = max(cells, scene.size * math.sqrt(CONTACT * scene.modulus * gradient / (2 * scene.load)))
    return int(max(FEW, 2 ** math.ceil(math.log2(cells * (1 - 1e-9)))))


def shortest_held(scene: IndentationScene, cells: int) -> float:
    """Wavenumber of two cells to a wave [rad/m]."""
    return math.pi * cells / side_of(scene) * (1 + 1e-9)


def height_of(scene: IndentationScene, cells: int, realisation: int, seed: int) -> FloatArray:
    """Heights at the centres of cells: the same waves on every grid that holds them, or the measured ones [m].

    Of measured heights, the mean of their points in each cell; a point that is split is as high in all of its parts.
    """
    ground, side = ground_of(scene), side_of(scene)
    if isinstance(ground, MeasuredHeights):
        points = sufficient_cells(scene)
        if cells > points:
            parts = np.ones((cells // points, cells // points))
            return np.asarray(np.kron(height_of(scene, points, realisation, seed), parts), dtype=np.float64)
        return ground.mean_over_cells((cells, cells), side / cells)
    return _drawn(ground, shortest_held(scene, cells), cells, side, random_generator(seed, SURFACES, realisation))


def highest_of(scene: IndentationScene, cells: int) -> FloatArray:
    """The highest of the measured points in each cell, where the mean may hide a summit [m]."""
    heights, side = ground_of(scene), side_of(scene)
    assert isinstance(heights, MeasuredHeights)  # as asked
    highest = heights.mean_over_cells((cells, cells), side / cells)
    i, j = (np.floor((end / side + 0.5) * cells).astype(np.int64) for end in heights.places)
    inside = np.ix_((i >= 0) & (i < cells), (j >= 0) & (j < cells))
    i, j = np.broadcast_arrays(i[:, np.newaxis], j)
    np.maximum.at(highest, (i[inside], j[inside]), heights.height[inside])
    return highest


def _drawn(ground: RoughSurface, shortest: float, cells: int, side: float, rng: np.random.Generator) -> FloatArray:
    """The waves of a surface up to a wavenumber; the same waves on every grid."""
    draw = partial(draw_surface, shape=(cells, cells), spacing=side / cells, rng=rng)
    surface = draw(lambda q: np.where(np.abs(q) <= shortest, ground.c2d(q), 0.0))
    # the mean square of the whole band, less what is left out of it
    return np.asarray(surface * _rms_factor(ground, side))


@lru_cache(maxsize=64)
def _rms_factor(ground: RoughSurface, side: float) -> float:
    """Factor that gives the waves of the square the rms height of the scene [-].

    Raises ValueError where no wave of the band fits the side a whole number of times.
    """
    waves = ground.q_max * side / (2 * math.pi) * (1 + 1e-9)
    last = math.floor(min(waves, LATTICE))
    i = np.arange(-last, last + 1)
    q = 2 * np.pi / side * np.hypot(i[:, np.newaxis], i)
    if waves > LATTICE:
        q = q[q <= 2 * np.pi / side * LATTICE]
    mean_square = (2 * np.pi / side) ** 2 * float(ground.c2d(q[q > 0]).sum())
    if waves > LATTICE:
        # and 2 pi int C_2D q dq of shorter ones
        low = max(2 * np.pi / side * LATTICE, ground.q_min)
        q, weight = on_panels(np.geomspace(low, ground.q_max, 2 + math.ceil(math.log2(ground.q_max / low))), 24)
        mean_square += float(2 * np.pi * np.sum(weight * q * ground.c2d(q)))
    if not mean_square > 0:
        raise ValueError("no wave of the roughness fits the side a whole number of times")
    return ground.rms / math.sqrt(mean_square)
