"""Limits of boundary elements on spheres, a = d = R = 1 and E* = 1: few cells, images, edges, a strip, one bad cell."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import bem3d
from validation.cases.limits.sweep import FloatArray, Limit, Point, call_and_record_warnings, swept
from validation.engine.engine import Outcome

HERTZ = 4 / 3
LATTICE = 3.900265
"""-4 zeta(1/2) beta(1/2): the sum of 1 / |n| over a square lattice but for its origin, less its mean; Borwein et al.,
Lattice Sums Then and Now, chapter 1."""
LONE_CELL = math.pi / (4 * math.asinh(1.0))
"""k / (E* dx) of one square cell, by Love."""
RESIDUAL = 1e-6
"""The default of `bem3d.solve`."""

CELLS = Limit(
    name="cells",
    method="BEM",
    title="contact of few cells",
    parameter="cells in the contact, π (a/dx)²",
    error="stiffness, rms over places",
    reference="Hertz, k = 2 E* a",
    condition="0.3 / √cells = tolerance: the error of a flat punch, an upper bound",
    failing_side="below",
    tolerance=0.05,
    factor=4.0,
    warned=True,
)
IMAGES = Limit(
    name="images",
    method="BEM, periodic",
    title="images, no padding",
    parameter="period L / a",
    error="approach under a force",
    reference="free space, the same cells",
    condition="1.655 a / L = tolerance: 3.9003 F / (π E* L) of all images and the mean plane",
    failing_side="below",
    tolerance=0.05,
    factor=1.25,
    derived=True,
)
EDGE = Limit(
    name="edge",
    method="BEM",
    title="edge of the grid",
    parameter="side of the grid / 2 a",
    error="force at an approach",
    reference="the same cells on a wider grid",
    condition="side = 2 a: beyond the edge there is no pressure",
    failing_side="below",
    tolerance=1e-3,
    factor=1.2,
    derived=True,
    warned=True,
)
STRIP = Limit(
    name="strip",
    method="BEM, rolling",
    title="narrow strip",
    parameter="width of the strip / 2 a",
    error="force at an approach",
    reference="the same cells on a wider strip",
    condition="width = 2 a: the contact must end within the strip",
    failing_side="below",
    tolerance=0.01,
    factor=1.2,
    derived=True,
    warned=True,
)
SPIKE = Limit(
    name="spike",
    method="BEM",
    title="one bad cell",
    parameter="height of the spike / d",
    error="force at an approach",
    reference="the sphere without the bad cell",
    condition="0.891 E* dx H = F: by Love's formula the bad cell alone carries the force of the sphere",
    failing_side="above",
    tolerance=0.1,
    factor=2.0,
    warned=True,
)


@dataclass(frozen=True, kw_only=True)
class Spheres:
    """Spheres on coarser cells, in smaller periods, on smaller grids and strips, with one spike.

    coarse: a / dx; places: of the sphere on a cell, along its diagonal; periods: L / a, of `fine` cells to a; sides: of
    grids and strips in cells, `finer` of them to a; heights: of the spike over d.
    """

    coarse: tuple[float, ...] = (0.5, 0.8, 1.2, 1.5, 1.8, 2.1, 2.4, 3.4, 4.8, 6.8, 9.6)
    places: int = 8
    periods: tuple[int, ...] = (4, 8, 16, 24, 32, 40, 64)
    fine: int = 4
    sides: tuple[int, ...] = (6, 10, 13, 14, 15, 16, 17, 18, 20, 24, 32)
    finer: int = 8
    heights: tuple[float, ...] = (0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 4.0, 7.0, 10.0, 15.0, 30.0, 100.0, 1e3)

    def sweep(self) -> Outcome:
        sweeps = sweep_cells, sweep_period, sweep_grid_side, sweep_strip_width, sweep_spike
        return {name: values for sweep in sweeps for name, values in sweep(self).items()}


def sphere(cells: int, spacing: float, place: float = 0.0) -> FloatArray:
    """Gap of the sphere over a grid, so many cells aside of its middle along both axes."""
    x = (np.arange(cells) - (cells - 1) / 2 - place) * spacing
    return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)


def half_space(cells: int, spacing: float, *, periodic: bool = False) -> bem3d.HalfSpace:
    """E* = 1."""
    return bem3d.HalfSpace(shape=(cells, cells), spacing=spacing, modulus=1.0, periodic=periodic)


def sweep_cells(problem: Spheres) -> Outcome:
    """Stiffness on few cells against Hertz; messages are those of the first place."""

    def point(cells: float) -> Point:
        side = 2 * math.ceil(1.3 * cells) + 4
        squares, messages = 0.0, []
        for place in (np.arange(problem.places) + 0.5) / (2 * problem.places):
            gap = sphere(side, 1 / cells, float(place))
            contact, message = call_and_record_warnings(
                partial(bem3d.solve, half_space(side, 1 / cells), gap, approach=1.0)
            )
            assert contact is not None
            squares += (contact.stiffness() / 2 - 1) ** 2 / problem.places
            messages.append(message)
        return math.sqrt(squares), messages[0]

    threshold = (0.3 / CELLS.tolerance) ** 2
    return swept(CELLS, np.pi * np.array(problem.coarse) ** 2, [point(cells) for cells in problem.coarse], threshold)


def sweep_period(problem: Spheres) -> Outcome:
    """Approach under the force of Hertz in a period, against the same cells in free space."""
    dx = 1 / problem.fine

    def point(period: int) -> Point:
        cells = period * problem.fine
        gap = sphere(cells, dx)
        free = bem3d.solve(half_space(cells, dx), gap, force=HERTZ)
        imaged, message = call_and_record_warnings(
            partial(bem3d.solve, half_space(cells, dx, periodic=True), gap, force=HERTZ)
        )
        assert imaged is not None
        return abs(imaged.approach / free.approach - 1), message

    threshold = LATTICE * HERTZ / math.pi / IMAGES.tolerance
    return swept(IMAGES, problem.periods, [point(period) for period in problem.periods], threshold)


def sweep_grid_side(problem: Spheres) -> Outcome:
    """Force on smaller and smaller grids."""
    dx = 1 / problem.finer
    # an odd grid has a cell below the middle of the sphere, an even one has none
    wide = (4 * problem.finer, 4 * problem.finer + 1)
    true = [bem3d.solve(half_space(side, dx), sphere(side, dx), approach=1.0).force for side in wide]

    def point(side: int) -> Point:
        press = partial(bem3d.solve, half_space(side, dx), sphere(side, dx), approach=1.0)
        contact, message = call_and_record_warnings(press)
        assert contact is not None
        return abs(contact.force / true[side % 2] - 1), message

    return swept(EDGE, np.array(problem.sides) * dx / 2, [point(side) for side in problem.sides], 1.0)


def sweep_strip_width(problem: Spheres) -> Outcome:
    """Force on smooth strips as wide as those grids, rolled over for two cells."""
    dx, length = 1 / problem.finer, 4 * problem.finer

    def roll(width: int) -> bem3d.Rolling:
        flat = np.zeros((length, width))
        return bem3d.roll(flat, spacing=dx, radius=1.0, modulus=1.0, approach=1.0, positions=2)

    true = roll(length).force[-1]

    def point(width: int) -> Point:
        rolled, message = call_and_record_warnings(partial(roll, width))
        return math.inf if rolled is None else float(abs(rolled.force[-1] / true - 1)), message

    return swept(STRIP, np.array(problem.sides) * dx / 2, [point(width) for width in problem.sides], 1.0)


def sweep_spike(problem: Spheres) -> Outcome:
    """Force with a cell in the middle that is too high."""
    dx, side = 1 / problem.finer, 2 * math.ceil(1.5 * problem.finer) + 1
    body, gap, middle = half_space(side, dx), sphere(side, dx), side // 2
    true = bem3d.solve(body, gap, approach=1.0).force

    def point(height: float) -> Point:
        spiked = gap.copy()
        spiked[middle, middle] -= height
        contact, message = call_and_record_warnings(
            partial(bem3d.solve, body, spiked, approach=1.0, tolerance=RESIDUAL)
        )
        assert contact is not None
        return abs(contact.force / true - 1), message

    return swept(SPIKE, problem.heights, [point(height) for height in problem.heights], HERTZ / (LONE_CELL * dx))
