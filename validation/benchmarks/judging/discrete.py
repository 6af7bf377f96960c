"""Discrete contact problems with their answers, by which a solver is judged.

The answers stand in `discrete.npz` beside this file, readable with numpy alone. `python -m
validation.benchmarks.judging.discrete` makes them anew.
"""

import io
import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.engine.engine import FloatArray
from validation.engine.files import write_whole
from validation.engine.random_numbers import random_generator
from validation.simulation.surface import draw_surface
from validation.theory.half_space import LoveHalfSpace

TABLE = Path(__file__).with_suffix(".npz")
SIDE, MODULUS, CELLS, SEED = 1e-3, 1e11, 48, 35
"""Of the grid [m]; E* [Pa]; cells along the first axis; of rough surfaces."""
LOW = 0.1
"""All heights and forces of `STATED` are so much lower: strains stay small."""
EXACT = 1e-9
"""Residual of an answer by the operator that judges."""
LIMITS = ("approach", "stiffness", "area")
"""What is extrapolated to cells of no size."""


@dataclass(frozen=True, eq=False)
class KnownContact:
    """A discrete problem: a rigid indenter on an elastic half-space, p >= 0, w = gap + u - approach >= 0, p w = 0.

    gap: undeformed separation (n, m) [m]; spacing: (dx, dy) [m]; modulus: E* [Pa]; periodic: half-space; force [N].
    approach [m], pressure (n, m) [Pa], stiffness dF/dd of the fixed contact [N/m], area [m^2]: the discrete answer;
    limits: approach, stiffness and area on cells of no size, and the half-widths that the grids leave, (3, 2).
    """

    name: str
    gap: FloatArray
    spacing: tuple[float, float]
    modulus: float
    periodic: bool
    force: float
    approach: float
    pressure: FloatArray
    stiffness: float
    area: float
    limits: FloatArray

    @property
    def half_space(self) -> LoveHalfSpace:
        n, m = self.gap.shape
        return LoveHalfSpace((n, m), self.spacing, self.modulus, self.periodic)

    @property
    def cell(self) -> float:
        """Area of a cell [m^2]."""
        return self.spacing[0] * self.spacing[1]


def problems() -> tuple[KnownContact, ...]:
    """Discrete contact problems with their answers, by which a solver is judged.

    Returns
    -------
    tuple
        Of problems in SI units. Each has ``name``, ``gap`` (n, m), ``spacing`` (dx, dy), ``modulus``, ``periodic`` and
        ``force``; the answer on its grid ``approach``, ``pressure`` (n, m), ``stiffness``, ``area``; and ``limits``
        (3, 2): approach, stiffness and area on cells of no size, with what the grids leave.

    Examples
    --------
    >>> [problem.name for problem in validation.problems()][:3]
    ['sphere', 'ellipse', 'flat']
    """
    return _stored()


@cache
def _stored() -> tuple[KnownContact, ...]:
    with np.load(TABLE) as stored:
        names = dict.fromkeys(key.split(":")[0] for key in stored)
        return tuple(_read(name, stored) for name in names)


def _read(name: str, stored: Mapping[str, FloatArray]) -> KnownContact:
    values: dict[str, Any] = {}
    for field in fields(KnownContact)[1:]:
        one = stored[f"{name}: {field.name}"]
        values[field.name] = one if one.ndim > 1 else tuple(one.tolist()) if one.ndim else one.item()
    return KnownContact(name=name, **values)


# --- shapes: the gap over L at x, y in (0, 1) ---

Shape = Callable[[FloatArray, FloatArray], FloatArray]


def paraboloid(x: FloatArray, y: FloatArray, along: float = 1.0, across: float = 1.0) -> FloatArray:
    return np.asarray((x - 0.5) ** 2 / (2 * along) + (y - 0.5) ** 2 / (2 * across))


def summits(x: FloatArray, y: FloatArray) -> FloatArray:
    """Two equal ones."""
    return np.minimum(((x - 0.25) ** 2 + (y - 0.5) ** 2) / 0.5, ((x - 0.75) ** 2 + (y - 0.5) ** 2) / 0.5)


def waves(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.asarray(0.01 * (2 - np.cos(2 * np.pi * x) - np.cos(2 * np.pi * y)))


def rough(x: FloatArray, y: FloatArray) -> FloatArray:
    """Self-affine from the side to a quarter of the waves of the coarsest grid; the same on every grid."""
    band = mdr.SelfAffine(hurst=0.8, q_min=2 * np.pi, q_max=2 * np.pi * CELLS / 4, rms=0.01)
    n = len(x)
    return -draw_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=random_generator(SEED))


@dataclass(frozen=True)
class Stated:
    """shape: over L; force: over E* L^2, both before `LOW`; across: dy / dx."""

    shape: Shape
    force: float
    periodic: bool = False
    across: int = 1

    def gap(self, cells: int) -> FloatArray:
        """On so many cells along the first axis [m]."""
        x, y = ((np.arange(n) + 0.5) / n for n in (cells, cells // self.across))
        return LOW * SIDE * np.broadcast_to(self.shape(x[:, np.newaxis], y), (x.size, y.size))


HERTZ = 4 / 3 / 5**3
"""F / (E* L^2) of a sphere with R = L and a = L / 5."""
STATED: Mapping[str, Stated] = {
    "sphere": Stated(paraboloid, HERTZ),
    "ellipse": Stated(lambda x, y: paraboloid(x, y, 1.0, 0.3), HERTZ / 2),
    "flat": Stated(lambda x, y: 0 * x * y, 0.01),
    "tilted": Stated(lambda x, y: 0.02 * x + 0 * y, 0.004),
    "contact up to the edge": Stated(paraboloid, 0.2),
    "cells of two lengths": Stated(paraboloid, HERTZ, across=2),
    "two equal summits": Stated(summits, 0.004),
    "few cells": Stated(paraboloid, HERTZ / 500),
    "rough, light load": Stated(rough, 0.0003),
    "rough, heavy load": Stated(rough, 0.02),
    "sphere, periodic": Stated(paraboloid, HERTZ, periodic=True),
    "waves, periodic": Stated(waves, 0.003, periodic=True),
    "waves of two lengths of cells, periodic": Stated(waves, 0.01, periodic=True, across=2),
    "rough, periodic": Stated(rough, 0.004, periodic=True),
}


def solved(name: str) -> dict[str, FloatArray | float | bool | tuple[float, float]]:
    """The answer of a problem on its grid and, extrapolated from three grids, on cells of no size.

    Raises RuntimeError where the operator that judges finds more than rounding in an answer.
    """
    stated = STATED[name]
    grids = [_on(stated, CELLS * 2**i) for i in range(3)]
    coarse, middle, fine = (np.array([grid[what] for what in LIMITS], dtype=float) for grid in grids)
    limit = 2 * fine - middle
    return {**grids[0], "limits": np.stack([limit, np.abs(limit - (2 * middle - coarse))], axis=1)}


def _on(stated: Stated, cells: int) -> dict[str, FloatArray | float | bool | tuple[float, float]]:
    gap, force = stated.gap(cells), LOW * stated.force * MODULUS * SIDE**2
    (n, m), spacing = gap.shape, (SIDE / cells, SIDE / cells * stated.across)
    half_space = bem3d.HalfSpace(shape=(n, m), spacing=spacing, modulus=MODULUS, periodic=stated.periodic)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)  # few cells are what a problem is about
        contact = bem3d.solve(half_space, gap, force=force, tolerance=1e-11, indenter_ends_at_edge=True)
    left = LoveHalfSpace((n, m), spacing, MODULUS, stated.periodic).residual(gap, contact.pressure)
    if not left.worst <= EXACT or not math.isclose(left.approach, contact.approach, rel_tol=1e-7):
        raise RuntimeError(f"the answer leaves a residual of {left.worst:.2g}, accepted: {EXACT:g}")
    return {
        **{"gap": gap, "spacing": spacing, "modulus": MODULUS, "periodic": stated.periodic, "force": force},
        **{"approach": contact.approach, "pressure": contact.pressure, "stiffness": contact.stiffness()},
        "area": contact.area,
    }


@cache
def problem_on(name: str, cells: int) -> KnownContact:
    """One of them with so many cells along the first axis, without a limit."""
    return KnownContact(name=name, limits=np.full((len(LIMITS), 2), math.nan), **_on(STATED[name], cells))  # type: ignore[arg-type]


def main() -> None:
    answers = {f"{name}: {what}": value for name in STATED for what, value in solved(name).items()}
    whole = io.BytesIO()
    arrays: dict[str, Any] = {key: np.asarray(value) for key, value in answers.items()}
    np.savez_compressed(whole, **arrays)
    write_whole(TABLE, whole.getvalue())


if __name__ == "__main__":
    main()
