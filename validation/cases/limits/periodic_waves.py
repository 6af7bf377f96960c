"""Limits of periodic boundary elements: waves of few cells, full contact by approach, a huge force."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import bem3d
from validation.cases.limits.spheres import RESIDUAL, half_space
from validation.cases.limits.sweep import FloatArray, Limit, Point, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator
from validation.simulation.rough_punch import PunchRoughness
from validation.theory import closed_forms

WAVES = Limit(
    name="waves",
    method="BEM",
    title="waves of few cells",
    parameter="cells to the shortest wave",
    error="contact area, rms over surfaces",
    reference="64 cells to the shortest wave",
    condition="4 cells: the edge of the contact is made of cells; its error, 0.4 / cells, is measured",
    failing_side="below",
    tolerance=0.1,
    factor=1.5,
    warned=True,
)
FULL = Limit(
    name="full contact",
    method="BEM, approach",
    title="full contact by approach",
    parameter="mean pressure / p*",
    error="mean pressure at an approach",
    reference="the pressure that has this approach",
    condition="p* = π E* h / λ: in full contact the approach is the mean gap at any pressure",
    failing_side="above",
    tolerance=0.01,
    factor=1.002,
    derived=True,
    warned=True,
)
HUGE = Limit(
    name="huge force",
    method="BEM, force",
    title="huge force, full contact",
    parameter="mean pressure / p*",
    error="waves of the pressure / p*",
    reference="p* cos(2π x / λ)",
    condition="tolerance / ε, the rounding unit: the waves are lost in the digits of the uniform pressure",
    failing_side="above",
    tolerance=1e-5,
    factor=30.0,
    derived=True,
    warned=True,
)


@dataclass(frozen=True, kw_only=True)
class RoughGrids:
    """Periodic rough surfaces on grids of so many cells a side, under one force Fbar = F / (E* h L)."""

    roughness: PunchRoughness
    surfaces: int
    cells: tuple[int, ...] = (12, 18, 24, 32, 48, 64, 96, 128)
    finest: int = 512
    force: float = 1.5

    def sweep(self) -> Outcome:
        """Contact area under one force on each grid against the finest; messages are those of drawing the surface."""
        r, surfaces = self.roughness, range(self.surfaces)
        true = [_area(r, self.finest, i, self.force) for i in surfaces]

        def point(cells: int) -> Point:
            draw = partial(bem3d.rough_surface, r.spectrum.c2d, shape=(cells, cells), spacing=1 / cells, rms=r.height)
            _, message = call_and_record_warnings(partial(draw, rng=random_generator(r.seed)))
            found = [_area(r, cells, i, self.force) for i in surfaces]
            squares = sum((area / one - 1) ** 2 for area, one in zip(found, true, strict=True))
            return math.sqrt(squares / len(true)), message

        return swept(WAVES, np.array(self.cells) / r.waves[1], [point(cells) for cells in self.cells], 4.0)


@dataclass(frozen=True, kw_only=True)
class WaveUnderLoad:
    """A cosine wave in line contact on so many cells: mean pressures over p* about full contact, and far beyond."""

    cells: int = 128
    loads: tuple[float, ...] = (0.5, 0.8, 0.9, 0.98, 0.995, 0.999, 1.0, 1.01, 1.1, 1.5)
    huge: tuple[float, ...] = tuple(2 * 10.0**i for i in range(17))

    def sweep(self) -> Outcome:
        """A wave of unit length and amplitude: by the approach that a mean pressure has; by a huge force.

        iterations, L2: of the solve by force at the same mean pressures, and its error against Westergaard.
        """
        n = self.cells
        body = bem3d.HalfSpace(shape=(n, 1), spacing=1 / n, modulus=1.0, periodic=True)
        x = (np.arange(n) + 0.5) / n - 0.5
        gap = 2 * np.sin(np.pi * x[:, np.newaxis]) ** 2
        return {**_by_approach(body, gap, x, self.loads), **_by_force(body, gap, x, self.huge)}


def _area(roughness: PunchRoughness, cells: int, realisation: int, force: float) -> float:
    """True contact area under the force; infinitely wrong where the grid cannot carry the surface."""
    height, _ = call_and_record_warnings(partial(roughness.surface, cells, realisation))
    if height is None:
        return math.inf
    press = partial(bem3d.solve, half_space(cells, 1 / cells, periodic=True), -height)
    contact, message = call_and_record_warnings(partial(press, force=force * roughness.height, tolerance=1e-5))
    if contact is None:
        raise ArithmeticError(message)
    return contact.area


def distance(found: FloatArray, true: FloatArray) -> float:
    """Relative difference in L2."""
    return float(np.sqrt(np.sum((found - true) ** 2) / np.sum(true**2)))


def _by_approach(body: bem3d.HalfSpace, gap: FloatArray, x: FloatArray, loads: tuple[float, ...]) -> Outcome:
    points: list[Point] = []
    by_force = []
    for load in loads:
        force = load * math.pi * body.cell_area * x.size
        known, _ = call_and_record_warnings(partial(bem3d.solve, body, gap, force=force, tolerance=1e-9))
        assert known is not None
        by_force.append((known.iterations, distance(known.pressure[:, 0], westergaard(x, load))))
        approach = known.approach if load < 1 else float(gap.mean())
        press = partial(bem3d.solve, body, gap, approach=approach, tolerance=RESIDUAL)
        contact, message = call_and_record_warnings(press)
        points.append((math.inf if contact is None else abs(contact.force / force - 1), message))
    iterations, error = np.array(by_force, dtype=np.float64).T
    return {
        **swept(FULL, loads, points, 1.0),
        "full contact, iterations": iterations,
        "full contact, L2": error,
    }


def westergaard(x: FloatArray, load: float) -> FloatArray:
    """The pressure of a wave of unit length and amplitude; full contact from load = 1 on: mean and wave."""
    scene = {"amplitude": 1.0, "wavelength": 1.0, "modulus": 1.0}
    if load < 1:
        return closed_forms.westergaard_pressure(x, mean_pressure=load * math.pi, **scene)
    return np.asarray(math.pi * (load + np.cos(2 * np.pi * x)))


def _by_force(body: bem3d.HalfSpace, gap: FloatArray, x: FloatArray, huge: tuple[float, ...]) -> Outcome:
    def point(load: float) -> Point:
        press = partial(bem3d.solve, body, gap, force=load * math.pi * body.cell_area * x.size, tolerance=RESIDUAL)
        _, message = call_and_record_warnings(press)
        contact, _ = call_and_record_warnings(partial(press, raise_on_failure=False))
        assert contact is not None
        waves = contact.pressure[:, 0] / math.pi - load - np.cos(2 * np.pi * x)
        return float(np.sqrt(np.mean(waves**2))), message

    return swept(HUGE, huge, [point(load) for load in huge], HUGE.tolerance / np.finfo(float).eps)
