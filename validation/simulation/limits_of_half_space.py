"""Probes of boundary elements past their limits: spheres, a = d = R = 1 and E* = 1, and periodic waves."""

import math
from functools import partial

import numpy as np

import bem3d
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.simulation.probing import Point, Values, along, answered, message_of, recorded, swept
from validation.simulation.rough_punch import PunchRoughness

HERTZ = 4 / 3
LATTICE = 3.900265
"""-4 zeta(1/2) beta(1/2): the sum of 1 / |n| over a square lattice but for its origin, less its mean; Borwein et al.,
Lattice Sums Then and Now, chapter 1."""
LONE_CELL = math.pi / (4 * math.asinh(1.0))
"""k / (E* dx) of one square cell, by Love."""
RESIDUAL = 1e-6
"""The default of `bem3d.solve`."""


def sphere(cells: int, spacing: float, place: float = 0.0) -> FloatArray:
    """Gap of the sphere over a grid, so many cells aside of its middle along both axes."""
    x = (np.arange(cells) - (cells - 1) / 2 - place) * spacing
    return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)


def half_space(cells: int, spacing: float, *, periodic: bool = False) -> bem3d.HalfSpace:
    """A half-space of cells x cells, E* = 1."""
    return bem3d.HalfSpace(shape=(cells, cells), spacing=spacing, modulus=1.0, periodic=periodic)


@along
def few_cells(cells: float, places: int = 8) -> tuple[float, float, str]:
    """Stiffness on a / dx cells against Hertz, rms over places on a cell along its diagonal; messages of the first."""
    side, at = 2 * math.ceil(1.3 * cells) + 4, (np.arange(places) + 0.5) / (2 * places)
    gaps = [sphere(side, 1 / cells, float(place)) for place in at]
    solved = [answered(partial(bem3d.solve, half_space(side, 1 / cells), gap, approach=1.0)) for gap in gaps]
    error = math.sqrt(sum((contact.stiffness() / 2 - 1) ** 2 / places for contact, _ in solved))
    return math.pi * cells**2, error, solved[0][1]


@along
def images(period: int, fine: int = 4) -> tuple[float, float, str]:
    """Approach under the force of Hertz in a period L / a, against the same cells in free space."""
    cells, dx = period * fine, 1 / fine
    press = partial(bem3d.solve, gap=sphere(cells, dx), force=HERTZ)
    imaged, message = answered(partial(press, half_space(cells, dx, periodic=True)))
    return period, abs(imaged.approach / press(half_space(cells, dx)).approach - 1), message


@along
def grid_sides(side: int, finer: int = 8) -> tuple[float, float, str]:
    """Force on grids of fewer and fewer cells a side, against a wide grid."""
    # an odd grid has a cell below the middle of the sphere, an even one has none
    dx, wide = 1 / finer, 4 * finer + side % 2
    true = bem3d.solve(half_space(wide, dx), sphere(wide, dx), approach=1.0).force
    contact, message = answered(partial(bem3d.solve, half_space(side, dx), sphere(side, dx), approach=1.0))
    return side * dx / 2, abs(contact.force / true - 1), message


@along
def strip_widths(width: int, finer: int = 8) -> tuple[float, float, str]:
    """Force on smooth strips as wide as those grids, rolled over for two cells."""
    dx, length = 1 / finer, 4 * finer

    def roll(columns: int) -> float:
        flat = np.zeros((length, columns))
        rolled = bem3d.roll(flat, spacing=dx, radius=1.0, modulus=1.0, approach=1.0, positions=2)
        return float(rolled.force[-1])

    true, (force, message) = roll(length), recorded(partial(roll, width))
    return width * dx / 2, math.inf if force is None else abs(force / true - 1), message


def spikes(heights: Values, *, finer: int = 8) -> Outcome:
    """Force with a cell in the middle that is so many d too high; measured: E* / k of that cell alone, over d."""
    dx, side = 1 / finer, 2 * math.ceil(1.5 * finer) + 1
    body, gap, middle = half_space(side, dx), sphere(side, dx), side // 2
    true = bem3d.solve(body, gap, approach=1.0).force

    def point(height: float) -> Point:
        spiked = gap.copy()
        spiked[middle, middle] -= height
        contact, message = answered(partial(bem3d.solve, body, spiked, approach=1.0, tolerance=RESIDUAL))
        return abs(contact.force / true - 1), message

    return swept(heights, *zip(*map(point, heights), strict=True), measured=1 / (LONE_CELL * dx))


def rough_grids(cells: tuple[int, ...], *, resolved: int, seed: int, finest: int = 512, force: float = 1.5) -> Outcome:
    """Contact area of periodic rough surfaces under Fbar = F / (E* h L) against the finest grid, by cells to the
    shortest wave; messages are those of drawing the surface."""
    r, surfaces = PunchRoughness(hurst=0.7, waves=(1, 8), seed=seed), range(resolved)
    true = [_area(r, finest, i, force) for i in surfaces]

    def point(n: int) -> Point:
        draw = partial(bem3d.rough_surface, r.spectrum.c2d, shape=(n, n), spacing=1 / n, rms=r.height)
        message = message_of(partial(draw, rng=random_generator(r.seed)))
        squares = sum((_area(r, n, i, force) / true[i] - 1) ** 2 for i in surfaces)
        return math.sqrt(squares / len(true)), message

    return swept(np.array(cells) / r.waves[1], *zip(*map(point, cells), strict=True))


def _area(roughness: PunchRoughness, cells: int, realisation: int, force: float) -> float:
    """True contact area under the force; infinitely wrong where the grid cannot carry the surface."""
    height, _ = recorded(partial(roughness.surface, cells, realisation))
    if height is None:
        return math.inf
    press = partial(bem3d.solve, half_space(cells, 1 / cells, periodic=True), -height)
    return answered(partial(press, force=force * roughness.height, tolerance=1e-5))[0].area


def _wave(cells: int) -> tuple[bem3d.HalfSpace, FloatArray, FloatArray]:
    """A cosine wave of unit length and amplitude in line contact: half-space, gap and x."""
    x = (np.arange(cells) + 0.5) / cells - 0.5
    body = bem3d.HalfSpace(shape=(cells, 1), spacing=1 / cells, modulus=1.0, periodic=True)
    return body, 2 * np.sin(np.pi * x[:, np.newaxis]) ** 2, x


@along
def full_contact(load: float, cells: int = 128) -> tuple[float, float, str]:
    """Force at the approach that a mean pressure over p* has; from full contact on that is the mean gap."""
    body, gap, x = _wave(cells)
    force = load * math.pi * body.cell_area * x.size
    reference, _ = answered(partial(bem3d.solve, body, gap, force=force, tolerance=1e-9))
    approach = reference.approach if load < 1 else float(gap.mean())
    contact, message = recorded(partial(bem3d.solve, body, gap, approach=approach, tolerance=RESIDUAL))
    return load, math.inf if contact is None else abs(contact.force / force - 1), message


@along
def huge_forces(load: float, cells: int = 128) -> tuple[float, float, str]:
    """Waves of the pressure in full contact under a mean pressure over p*, rms over p*."""
    body, gap, x = _wave(cells)
    press = partial(bem3d.solve, body, gap, force=load * math.pi * body.cell_area * x.size, tolerance=RESIDUAL)
    contact, _ = answered(partial(press, raise_on_failure=False))
    waves = contact.pressure[:, 0] / math.pi - load - np.cos(2 * np.pi * x)
    return load, float(np.sqrt(np.mean(waves**2))), message_of(press)
