"""Boundary elements under a rolling wheel, over linear theory on the same strips, times what that expects."""

import math

import numpy as np

from validation.advice.models.rolling import of_a_wheel
from validation.engine.engine import FloatArray
from validation.simulation import rolling_levels as grids
from validation.simulation.method import Prepared, Resolution, Result, Solve, distance
from validation.simulation.model import Cost, ErrorEstimate, GridModel, Model, Target
from validation.simulation.model_names import BEM
from validation.simulation.rolling_levels import RollingGrid, on_boundary_elements

CELL, POSITION = 5.0e-8, 1.0e-3
"""Seconds that a cell takes in an application, its strip drawn, and what else a contact, about."""
STRIP_RMS, STRIP_BANDS = 0.35, 0.7
"""Scatter of one strip over linear theory on itself, over h/d: how many strips are expected."""
OF_FINE = 0.8
"""Error of the finer grid over its change of the coarser one, in the ratio 1.5, of second order."""
MOST_STRIPS = 32
MOST_ON_A_STRIP = 2**26
"""Cells that are drawn at once at the most; they take up to four gigabytes."""
COARSE = 2.5
"""Cells to the shortest wave on the coarse grid."""


def resolutions(target: Target) -> tuple[Resolution, ...]:
    """Cells to a contact radius; of measured heights on their points, where those are few enough."""
    ground = target.scene.ground
    if ground.is_single and len(sizes := grids.grids_of_points(ground, target.scene.contact_radius)) > 1:
        return tuple(Resolution(size=size) for size in sizes)
    radii = target.rolling.q_max * target.scene.contact_radius / (2 * math.pi)
    coarse = min(max(grids.LEAST, math.ceil(COARSE * radii)), grids.MOST_CELLS * 2 // 3)
    fine = min(max(math.ceil(1.5 * coarse), math.ceil(grids.FINE * radii)), grids.MOST_CELLS)
    return Resolution(size=coarse), Resolution(size=fine)


def references(target: Target, resolution: Resolution) -> tuple[Resolution, ...]:
    """The next coarser grid, of the coarsest the next finer one: each tells what the other leaves open."""
    sizes = resolutions(target)
    return (sizes[abs(sizes.index(resolution) - 1)],)


def scatter(target: Target) -> float:
    """Of one strip over linear theory on itself, about."""
    return float((STRIP_RMS if target.rolling.whole else STRIP_BANDS) * target.scene.roughness_ratio)


def cost(target: Target, resolution: Resolution) -> Cost:
    """Cells of the window times applications times positions of a strip: a contact a cell."""
    grid = RollingGrid.of(target.rolling, resolution.size)
    return Cost(work=grid.work, seconds=CELL * grid.work + POSITION * grid.along)


def least_sampling_error(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """The predicted error: of `MOST_STRIPS` strips, zero of measured heights, without a grid error.

    The grid error is estimated after the solve. Out of range where the scene has no answer or its grid is too large.
    """
    if reason := target.rolling.no_answer or _too_large(target):
        return ErrorEstimate.out_of_range(reason)
    return ErrorEstimate(
        sample=0.0 if target.scene.ground.is_single else scatter(target) / math.sqrt(MOST_STRIPS),
        reason=f"sampling error of {MOST_STRIPS} strips, without the grid error",
    )


def prepare(target: Target, resolution: Resolution) -> Prepared:
    """Over linear theory on the same strips, times what that expects; measured heights are rolled themselves."""
    quantity, cells = target.rolling, resolution.size
    expected = 1.0 if quantity.ground.is_single else quantity.expected(one_dimensional=False)
    work = RollingGrid.of(quantity, cells).work

    def read(change: FloatArray) -> Result:
        failed = "" if np.isfinite(change).all() else "a contact along a strip did not converge"
        return Result({quantity.name: expected * np.exp(change)}, work, failed=failed)

    return lambda strip: Solve(lambda: on_boundary_elements(quantity, cells, strip, target.seed), read)


def left_by_grid(
    target: Target, resolution: Resolution, values: FloatArray, other_grids: FloatArray
) -> tuple[float, str]:
    """By the first strip; of measured points, whose summits have edges, of first order in the length of a cell."""
    (other,) = references(target, resolution)
    change = distance(values[0], other_grids[0, 0])
    coarse, fine = sorted((other.size, resolution.size))
    of_fine = 1 / (fine / coarse - 1) if target.scene.ground.is_single else OF_FINE
    return change * (of_fine if resolution.size == fine else 1 + of_fine), (
        f"{_cells_to_a_wave(target, resolution):.2g} cells to the shortest wave; a = {other.size:.3g} cells change "
        f"the result by {change:.1%}; strips: {len(values)}"
    )


MODEL = GridModel(
    serves=of_a_wheel,
    label=lambda resolution: f"{BEM}, a = {resolution.size:.3g} cells",
    resolutions=resolutions,
    references=references,
    scatter=scatter,
    most=MOST_STRIPS,
    compared=1,
    cost=cost,
    claim=least_sampling_error,
    prepare=prepare,
    grid_error=left_by_grid,
)


def _too_large(target: Target) -> str:
    """Why no grid that fits into memory holds the waves; empty where one does."""
    coarse, *_, fine = resolutions(target)
    if (waves := _cells_to_a_wave(target, coarse)) < 2:
        return f"the shortest wave has {waves:.2g} cells on the finest grids that are offered, fewer than 2"
    grid = RollingGrid.of(target.rolling, fine.size)
    if grid.along * grid.across > MOST_ON_A_STRIP:
        return f"a strip needs {grid.along} x {grid.across} cells, more than {MOST_ON_A_STRIP:.2g}"
    return ""


def _cells_to_a_wave(target: Target, resolution: Resolution) -> float:
    return float(2 * math.pi * resolution.size / (target.rolling.q_max * target.scene.contact_radius))
