"""Boundary elements under a rough body: stiffness, contact area and gap, and what coarser grids say of their error."""

import math
import warnings
from typing import Any

import numpy as np

import bem3d
from validation.advice.calibration import SCATTER
from validation.engine.engine import FloatArray
from validation.scenes.indentation import IndentationScene
from validation.scenes.scene import CONTACT_AREA, INTERFACE, MEAN_GAP
from validation.simulation import indentation as face
from validation.simulation.indentation import ground_of, height_of, is_rough, side_of, sufficient_cells
from validation.simulation.method import FEWEST, STUDENT, Prepared, Resolution, Result, Solve, grid_error
from validation.simulation.model import Cost, ErrorEstimate, GridModel, Model, Target
from validation.simulation.model_names import BEM
from validation.simulation.pressed import cell_applications
from validation.simulation.rough_punch import STIFFNESS_ERROR, STIFFNESS_TOLERANCE

CELL, PRESS = 3.0e-8, 7e-3
"""Seconds that a cell takes in an application, its surface drawn, and what else a contact, about."""
RESIDUAL = 1e-4
SOLVER = 5 * STIFFNESS_ERROR
"""Relative error of the stiffness of one surface, by the residual of its fixed contact area."""
APPLICATIONS = 19
"""Of the operator, to a contact and its stiffness."""
SPHERE_SCATTER = 0.3
"""Relative deviation of the stiffness of one rough sphere, over h/d, about."""
EDGE = 0.35
"""Error of the stiffness of a flat square punch times its cells a side."""
SPLIT, MOST_SPLIT = 3, 1024
"""Parts of a measured point along each side, and cells a side of the grid of such parts at the most."""
OTHERS = 3.0
"""Changes by coarser grids over what they tell of a face whose points are split: of 64 faces at the edges of all ranges
the error then covers what splitting in eight changes in all, and linear interpolation between points in 62."""
LEFT_OF_CORRECTION = 0.25
"""Part of the correction of the contact area that it leaves open: `bem3d.Contact.corrected_area`."""
MOST = 1000
"""Surfaces that are drawn at the most."""


def is_solved(scene: Any, quantity: str) -> bool:
    """The stiffness of a rough body; contact area and mean gap of a rough punch."""
    of_interface = scene.kind == "punch" and scene.ground is not None and quantity in map(str, INTERFACE)
    return is_rough(scene, quantity) or of_interface


def resolutions(target: Target) -> tuple[Resolution, ...]:
    """Cells a side; measured heights on their own points alone, on a coarser grid the mean of these in each cell."""
    single, points = ground_of(target.scene).is_single, sufficient_cells(target.scene)
    finest = min(face.MANY_POINTS if single else face.MANY, points)
    sides = (finest,) if single else (finest // 4, finest // 2, finest)
    return tuple(on_grid(cells) for cells in sides if cells >= face.FEW)


def references(target: Target, resolution: Resolution) -> tuple[Resolution, ...]:
    """Each of half as many cells a side: two, of a single surface three; and the points of that, split."""
    single, cells = ground_of(target.scene).is_single, round(resolution.size)
    coarser = tuple(on_grid(cells // 2**i) for i in range(1, 4 if single else 3))
    on_points = single and cells == sufficient_cells(target.scene)
    return (*coarser, on_grid(SPLIT * cells)) if on_points and SPLIT * cells <= MOST_SPLIT else coarser


def scatter(target: Target) -> float:
    """Of one drawn surface, relative, about."""
    return SCATTER if target.scene.shape == "punch" else float(SPHERE_SCATTER * target.scene.roughness_ratio)


def cost(target: Target, resolution: Resolution) -> Cost:
    work = APPLICATIONS * resolution.size**2
    return Cost(work=work, seconds=CELL * work + PRESS)


def least_sampling_error(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """The predicted error: of `MOST` surfaces, half of the tolerance at least, zero of measured heights.

    Without a grid error, which is estimated after the solve. Out of range where the coarsest grid resolves no wave.
    """
    coarsest, ground = round(min(grid.size for grid in references(target, resolution))), ground_of(target.scene)
    if not ground.is_single and ground.q_min > face.shortest_held(target.scene, coarsest):
        reason = f"a grid of {coarsest}² cells, the reference of its grid error, resolves no wave"
        return ErrorEstimate.out_of_range(reason)
    least = max(target.tolerance / 2, STUDENT * scatter(target) / math.sqrt(MOST))
    reason = "sample only: the grid error is estimated from coarser grids after the solve"
    return ErrorEstimate(sample=0.0 if ground.is_single else least, reason=reason)


def prepare(target: Target, resolution: Resolution) -> Prepared:
    """Surfaces on cells x cells, with the waves that those carry."""
    scene, cells = target.scene, round(resolution.size)

    def solve(realisation: int) -> Result:
        result = pressed(scene, height_of(scene, cells, realisation, target.seed), resolution.residual)
        least = resolution.residual * ground_of(scene).rms
        if not result.failed and target.quantity == str(MEAN_GAP) and result.values[target.quantity] <= least:
            return Result({}, result.work, failed="the gap is closed: its mean is below the residual of the solve")
        return result

    return lambda realisation: Solve(lambda: solve(realisation), lambda result: result)


def pressed(scene: IndentationScene, height: FloatArray, residual: float) -> Result:
    """Under a rough face, of a sphere over r^2 / 2R, whose contact at the edge of the grid is none."""
    half_space = bem3d.HalfSpace(shape=height.shape, spacing=side_of(scene) / len(height), modulus=scene.modulus)
    gap, sphere = -height, scene.shape == "sphere"
    if sphere:
        x = ((np.arange(len(gap)) + 0.5) / len(gap) - 0.5) * side_of(scene)
        gap = gap + (x[:, np.newaxis] ** 2 + x**2) / (2 * scene.size)
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always", bem3d.ContactWarning)
        try:
            contact = bem3d.solve(half_space, gap, force=scene.load, tolerance=residual)
            fixed = bem3d.solve_fixed_area(half_space, contact.pressure > 0, tolerance=STIFFNESS_TOLERANCE)
        except bem3d.ConvergenceError:
            return Result({}, failed="a contact did not converge")
    work = cell_applications(contact, fixed)
    if sphere and any(issubclass(warning.category, bem3d.EdgeWarning) for warning in raised):
        return Result({}, work, failed="the contact reached the edge of the grid")
    values = {"stiffness": fixed.stiffness, "in contact": np.count_nonzero(contact.pressure)}
    if not sphere:
        values |= {str(CONTACT_AREA): contact.corrected_area, str(MEAN_GAP): contact.mean_gap}
    return Result({name: np.array(value) for name, value in values.items()}, work)


def left_by_grid(
    target: Target, resolution: Resolution, values: FloatArray, other_grids: FloatArray
) -> tuple[float, str]:
    """Of the changes of the logarithm from grid to grid, the same surfaces on each."""
    cells, compared = round(resolution.size), other_grids.shape[1]
    finer = [grid.size > cells for grid in references(target, resolution)]
    levels = np.log([values[:compared, 0], *other_grids[np.logical_not(finer), :, 0]])
    changes = levels[:-1] - levels[1:]
    if ground_of(target.scene).is_single:
        split = np.log(other_grids[finer, 0, 0] / values[0, 0])
        grid = grid_error_of_one(target.scene, cells, changes[:, 0], split)
        grid += hidden(target, resolution, values[0, 0])
    else:
        # the waves that a grid leaves out may hide the error at the edge of a punch in its change
        grid = max(grid_error(changes[1], changes[0]), edge_error(target.scene, cells))
    grid += left_by_correction(target, resolution)
    last = math.expm1(float(changes[0].mean()))
    reason = f"{cells}² cells change {cells // 2}² by {last:+.1%}, surfaces: {len(values)}"
    return grid + SOLVER, reason


MODEL = GridModel(
    serves=is_solved,
    label=lambda resolution: f"{BEM} {resolution.size:g}²",
    resolutions=resolutions,
    references=references,
    scatter=scatter,
    most=MOST,
    compared=FEWEST,
    cost=cost,
    claim=least_sampling_error,
    prepare=prepare,
    grid_error=left_by_grid,
)


def on_grid(cells: int) -> Resolution:
    """So many cells a side."""
    return Resolution(size=cells, residual=RESIDUAL)


def edge_error(scene: IndentationScene, cells: int) -> float:
    """Of the logarithm of the stiffness, by the edge of a punch in full contact; a sphere has no edge."""
    return EDGE / cells if scene.shape == "punch" else 0.0


def grid_error_of_one(scene: IndentationScene, cells: int, changes: FloatArray, split: FloatArray) -> float:
    """Where the points of the face are split, twice the largest change by that, by the edge of a punch, and a third
    of the changes by coarser grids, those before the last halved for each doubling since.

    The change by splitting is that of this face, but its sign may pass through zero; coarser grids have other summits.
    Else those changes themselves, with half as much again, and as much for each doubling that is left to the points.
    Where the last change is the largest, all of it is left; infinite, since the points are too many to be split.
    """
    last, *before = np.abs(changes)
    coarser = (last, before[0] / 2, before[1] / 4)
    if split.size:
        return float(2 * max(edge_error(scene, cells), *np.abs(split), *(change / OTHERS for change in coarser)))
    if last >= max(before):
        return math.inf if last > 0 else 0.0
    return float(1.5 * max(edge_error(scene, cells), *coarser) * (1 + math.log2(sufficient_cells(scene) / cells)))


def hidden(target: Target, resolution: Resolution, value: float) -> float:
    """What the mean over cells may hide: the change of the logarithm by the highest point of each in its place."""
    scene, cells = target.scene, round(resolution.size)
    highest = face.highest_of(scene, cells)
    if np.array_equal(highest, height_of(scene, cells, 0, target.seed)):
        return 0.0
    at_highest = pressed(scene, highest, resolution.residual)
    return math.inf if at_highest.failed else abs(math.log(float(at_highest.values[target.quantity]) / value))


def left_by_correction(target: Target, resolution: Resolution) -> float:
    """Of the logarithm of the contact area, by the first surface; zero of other quantities."""
    if target.quantity != str(CONTACT_AREA):
        return 0.0
    scene, cells = target.scene, round(resolution.size)
    values = pressed(scene, height_of(scene, cells, 0, target.seed), resolution.residual).values
    counted = float(values["in contact"]) * (side_of(scene) / cells) ** 2
    return LEFT_OF_CORRECTION * math.log(counted / float(values[target.quantity]))
