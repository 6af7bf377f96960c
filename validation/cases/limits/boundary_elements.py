"""Sweeps through the limits of boundary elements: one solve of each. Spheres have a = d = R = 1 and E* = 1."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.cases.limits.sweep import Limit, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.simulation.rough_punch import PunchRoughness
from validation.theory import closed_forms

FloatArray = NDArray[np.float64]

HERTZ = 4 / 3
LATTICE = 3.900265
"""-4 zeta(1/2) beta(1/2): the sum of 1 / |n| over a square lattice but for its origin, less its mean; Borwein et al.,
Lattice Sums Then and Now, chapter 1."""
LONE_CELL = math.pi / (4 * math.asinh(1.0))
"""k / (E* dx) of one square cell, by Love."""
RESIDUAL = 1e-6
"""What `bem3d.solve` asks for by default."""

WAVES = Limit(
    name="waves",
    method="BEM",
    title="waves of few cells",
    knob="cells to the shortest wave",
    error="contact area, rms over surfaces",
    against="64 cells to the shortest wave",
    condition="4 cells: the edges of contact are cells, 0.4 / cells by measurement",
    failing="below",
    tolerance=0.1,
    factor=1.5,
    warned=True,
)
CELLS = Limit(
    name="cells",
    method="BEM",
    title="contact of few cells",
    knob="cells in the contact, π (a/dx)²",
    error="stiffness, rms over places",
    against="Hertz, k = 2 E* a",
    condition="0.3 / √cells = tolerance, as for flat punches: the most there is to fear",
    failing="below",
    tolerance=0.05,
    factor=4.0,
    warned=True,
)
IMAGES = Limit(
    name="images",
    method="BEM, periodic",
    title="images, no padding",
    knob="period L / a",
    error="approach under a force",
    against="free space, the same cells",
    condition="1.655 a / L = tolerance: 3.9003 F / (π E* L) of all images and the mean plane",
    failing="below",
    tolerance=0.05,
    factor=1.25,
    derived=True,
)
EDGE = Limit(
    name="edge",
    method="BEM",
    title="edge of the grid",
    knob="side of the grid / 2 a",
    error="force at an approach",
    against="a grid wide enough, the same cells",
    condition="side = 2 a: beyond the edge nothing carries",
    failing="below",
    tolerance=1e-3,
    factor=1.2,
    derived=True,
    warned=True,
)
FULL = Limit(
    name="full contact",
    method="BEM, approach",
    title="full contact by approach",
    knob="mean pressure / p*",
    error="mean pressure at an approach",
    against="the pressure whose approach it is",
    condition="p* = π E* h / λ: the approach is the mean gap, whatever the pressure",
    failing="above",
    tolerance=0.01,
    factor=1.002,
    derived=True,
    warned=True,
)
HUGE = Limit(
    name="huge force",
    method="BEM, force",
    title="huge force, full contact",
    knob="mean pressure / p*",
    error="waves of the pressure / p*",
    against="p* cos(2π x / λ)",
    condition="tolerance / ε of floating point: a uniform pressure takes the digits of its waves",
    failing="above",
    tolerance=1e-5,
    factor=30.0,
    derived=True,
    warned=True,
)
SPIKE = Limit(
    name="spike",
    method="BEM",
    title="one bad cell",
    knob="height of the spike / d",
    error="force at an approach",
    against="the sphere without it",
    condition="0.891 E* dx H = F: the cell alone, as Love has it, carries what the sphere carries",
    failing="above",
    tolerance=0.1,
    factor=2.0,
    warned=True,
)
STRIP = Limit(
    name="strip",
    method="BEM, rolling",
    title="narrow strip",
    knob="width of the strip / 2 a",
    error="force at an approach",
    against="a strip wide enough, the same cells",
    condition="width = 2 a: the contact must end within the strip",
    failing="below",
    tolerance=0.01,
    factor=1.2,
    derived=True,
    warned=True,
)
LIMITS = (WAVES, CELLS, IMAGES, EDGE, STRIP, FULL, HUGE, SPIKE)


@dataclass(frozen=True, kw_only=True)
class Resolved:
    """Periodic rough surfaces on grids of so many cells a side, under one force Fbar = F / (E* h L)."""

    roughness: PunchRoughness
    cells: tuple[int, ...]
    finest: int
    surfaces: int
    force: float


@dataclass(frozen=True, kw_only=True)
class Spheres:
    """Spheres on coarser cells, in smaller periods, on smaller grids and strips, with one spike.

    coarse: a / dx; places: of the sphere on a cell, along its diagonal; periods: L / a, of `fine` cells to a; sides: of
    grids and strips in cells, `finer` of them to a; heights: of the spike over d.
    """

    coarse: tuple[float, ...]
    places: int
    periods: tuple[int, ...]
    fine: int
    sides: tuple[int, ...]
    finer: int
    heights: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class WaveUnderLoad:
    """A cosine wave in line contact on so many cells: mean pressures over p* about full contact, and far beyond."""

    cells: int
    loads: tuple[float, ...]
    huge: tuple[float, ...]


def resolve(problem: Resolved) -> Outcome:
    """Contact area under one force on each grid against the finest; what is said is said as the surface is drawn."""
    r, waves = problem.roughness, problem.roughness.waves[1]
    true = [_area(r, problem.finest, i, problem.force) for i in range(problem.surfaces)]
    errors, said = [], []
    for cells in problem.cells:
        _, words = call_and_record_warnings(partial(r.surface, cells, 0))
        found = [_area(r, cells, i, problem.force) for i in range(problem.surfaces)]
        errors.append(math.sqrt(sum((k / one - 1) ** 2 for k, one in zip(found, true, strict=True)) / len(true)))
        said.append(words)
    return swept("waves", np.array(problem.cells) / waves, errors, 4.0, said)


def _area(roughness: PunchRoughness, cells: int, realisation: int, force: float) -> float:
    """True contact area under the force; infinitely wrong where the grid cannot carry the surface."""
    height, _ = call_and_record_warnings(partial(roughness.surface, cells, realisation))
    if height is None:
        return math.inf
    body = half_space(cells, 1 / cells, periodic=True)
    contact, words = call_and_record_warnings(
        partial(bem3d.solve, body, -height, force=force * roughness.height, tolerance=1e-5)
    )
    if contact is None:
        raise ArithmeticError(words)
    return contact.area


def sphere(cells: int, spacing: float, place: float = 0.0) -> FloatArray:
    """Gap of the sphere over a grid, so many cells aside of its middle along both axes."""
    x = (np.arange(cells) - (cells - 1) / 2 - place) * spacing
    return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)


def half_space(cells: int, spacing: float, *, periodic: bool = False) -> bem3d.HalfSpace:
    """E* = 1."""
    return bem3d.HalfSpace(shape=(cells, cells), spacing=spacing, modulus=1.0, periodic=periodic)


def press_spheres(problem: Spheres) -> Outcome:
    """Few cells, images, the edge of the grid and of a strip, one bad cell."""
    return {
        **_few_cells(problem),
        **_images(problem),
        **_edge(problem),
        **_strip(problem),
        **_spike(problem),
    }


def _few_cells(problem: Spheres) -> Outcome:
    errors, said = [], []
    for cells in problem.coarse:
        side, heard_at = 2 * math.ceil(1.3 * cells) + 4, []
        squares = 0.0
        for place in (np.arange(problem.places) + 0.5) / (2 * problem.places):
            gap = sphere(side, 1 / cells, float(place))
            contact, words = call_and_record_warnings(
                partial(bem3d.solve, half_space(side, 1 / cells), gap, approach=1.0)
            )
            assert contact is not None
            squares += (contact.stiffness() / 2 - 1) ** 2 / problem.places
            heard_at.append(words)
        errors.append(math.sqrt(squares))
        said.append(heard_at[0])
    knob = np.pi * np.array(problem.coarse) ** 2
    return swept("cells", knob, errors, (0.3 / CELLS.tolerance) ** 2, said)


def _images(problem: Spheres) -> Outcome:
    errors, said, dx = [], [], 1 / problem.fine
    for period in problem.periods:
        cells = period * problem.fine
        gap = sphere(cells, dx)
        free = bem3d.solve(half_space(cells, dx), gap, force=HERTZ)
        imaged, words = call_and_record_warnings(
            partial(bem3d.solve, half_space(cells, dx, periodic=True), gap, force=HERTZ)
        )
        assert imaged is not None
        errors.append(abs(imaged.approach / free.approach - 1))
        said.append(words)
    border = LATTICE * HERTZ / math.pi / IMAGES.tolerance
    return swept("images", problem.periods, errors, border, said)


def _edge(problem: Spheres) -> Outcome:
    errors, said, dx = [], [], 1 / problem.finer
    # an odd grid has a cell below the middle of the sphere, an even one has none
    wide = (4 * problem.finer, 4 * problem.finer + 1)
    true = [bem3d.solve(half_space(side, dx), sphere(side, dx), approach=1.0).force for side in wide]
    for side in problem.sides:
        contact, words = call_and_record_warnings(
            partial(bem3d.solve, half_space(side, dx), sphere(side, dx), approach=1.0)
        )
        assert contact is not None
        errors.append(abs(contact.force / true[side % 2] - 1))
        said.append(words)
    return swept("edge", np.array(problem.sides) * dx / 2, errors, 1.0, said)


def _strip(problem: Spheres) -> Outcome:
    """Smooth strips as wide as those grids, rolled over for two cells."""
    errors, said, dx, length = [], [], 1 / problem.finer, 4 * problem.finer

    def roll(width: int) -> bem3d.Rolling:
        flat = np.zeros((length, width))
        return bem3d.roll(flat, spacing=dx, radius=1.0, modulus=1.0, approach=1.0, positions=2)

    true = roll(length).force[-1]
    for width in problem.sides:
        rolled, words = call_and_record_warnings(partial(roll, width))
        errors.append(math.inf if rolled is None else abs(rolled.force[-1] / true - 1))
        said.append(words)
    return swept("strip", np.array(problem.sides) * dx / 2, errors, 1.0, said)


def _spike(problem: Spheres) -> Outcome:
    """A cell in the middle that is too high."""
    dx, side = 1 / problem.finer, 2 * math.ceil(1.5 * problem.finer) + 1
    body, gap, middle = half_space(side, dx), sphere(side, dx), side // 2
    true = bem3d.solve(body, gap, approach=1.0).force
    errors, said = [], []
    for height in problem.heights:
        spiked = gap.copy()
        spiked[middle, middle] -= height
        contact, words = call_and_record_warnings(partial(bem3d.solve, body, spiked, approach=1.0, tolerance=RESIDUAL))
        assert contact is not None
        errors.append(abs(contact.force / true - 1))
        said.append(words)
    return swept("spike", problem.heights, errors, HERTZ / (LONE_CELL * dx), said)


def distance(found: FloatArray, true: FloatArray) -> float:
    """Relative difference in L2."""
    return float(np.sqrt(np.sum((found - true) ** 2) / np.sum(true**2)))


def press_waves(problem: WaveUnderLoad) -> Outcome:
    """A wave of unit length and amplitude: by the approach that a mean pressure has; by a huge force.

    iterations, L2: of the solve by force at the same mean pressures, and its error against Westergaard.
    """
    n = problem.cells
    body = bem3d.HalfSpace(shape=(n, 1), spacing=1 / n, modulus=1.0, periodic=True)
    x = (np.arange(n) + 0.5) / n - 0.5
    gap = 2 * np.sin(np.pi * x[:, np.newaxis]) ** 2
    return {**_by_approach(body, gap, x, problem.loads), **_by_force(body, gap, x, problem.huge)}


def _by_approach(body: bem3d.HalfSpace, gap: FloatArray, x: FloatArray, loads: tuple[float, ...]) -> Outcome:
    errors, said, by_force = [], [], []
    for load in loads:
        force = load * math.pi * body.cell_area * x.size
        known, _ = call_and_record_warnings(partial(bem3d.solve, body, gap, force=force, tolerance=1e-9))
        assert known is not None
        by_force.append((known.iterations, distance(known.pressure[:, 0], westergaard(x, load))))
        approach = known.approach if load < 1 else float(gap.mean())
        contact, words = call_and_record_warnings(
            partial(bem3d.solve, body, gap, approach=approach, tolerance=RESIDUAL)
        )
        errors.append(math.inf if contact is None else abs(contact.force / force - 1))
        said.append(words)
    iterations, error = np.array(by_force, dtype=np.float64).T
    found = swept("full contact", loads, errors, 1.0, said)
    return {**found, "full contact, iterations": iterations, "full contact, L2": error}


def westergaard(x: FloatArray, load: float) -> FloatArray:
    """The pressure of a wave of unit length and amplitude; full contact from load = 1 on: mean and wave."""
    scene = {"amplitude": 1.0, "wavelength": 1.0, "modulus": 1.0}
    if load < 1:
        return closed_forms.westergaard_pressure(x, mean_pressure=load * math.pi, **scene)
    return np.asarray(math.pi * (load + np.cos(2 * np.pi * x)))


def _by_force(body: bem3d.HalfSpace, gap: FloatArray, x: FloatArray, huge: tuple[float, ...]) -> Outcome:
    errors, said = [], []
    for load in huge:
        press = partial(bem3d.solve, body, gap, force=load * math.pi * body.cell_area * x.size, tolerance=RESIDUAL)
        _, words = call_and_record_warnings(press)
        contact, _ = call_and_record_warnings(partial(press, raise_on_failure=False))
        assert contact is not None
        waves = contact.pressure[:, 0] / math.pi - load - np.cos(2 * np.pi * x)
        errors.append(float(np.sqrt(np.mean(waves**2))))
        said.append(words)
    return swept("huge force", huge, errors, HUGE.tolerance / np.finfo(float).eps, said)
