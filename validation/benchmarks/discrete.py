"""Discrete contact problems with their answers, by which a solver is judged.

The answers stand in `discrete.npz` beside this file, readable with numpy alone. `python -m
validation.benchmarks.discrete` makes them anew.
"""

import io
import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.engine.engine import FloatArray
from validation.engine.files import write_whole
from validation.engine.realisations import random_generator
from validation.simulation.surface import draw_surface
from validation.theory.half_space import LoveHalfSpace

TABLE = Path(__file__).with_suffix(".npz")
SIDE, MODULUS, CELLS, SEED = 1e-3, 1e11, 48, 35
"""Of the grid [m]; E* [Pa]; cells along the first axis; of rough surfaces."""
LOW = 0.1
"""All heights and forces of `STATED` are so much lower: strains stay small."""
FULL = 1e-3
"""Of the heights: so near the mean gap a periodic contact is full, or almost, and its force is open."""
EXACT = 1e-9
"""Residual of an answer by the operator that judges."""
LIMITS = ("approach", "stiffness", "area")
"""What is extrapolated to zero cell size."""


@lru_cache(maxsize=8)
def _half_space(shape: tuple[int, int], spacing: tuple[float, float], modulus: float, periodic: bool) -> LoveHalfSpace:
    """Return the half-space with its kernel, which is computed once for problems that take turns."""
    return LoveHalfSpace(shape, spacing, modulus, periodic)


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactProblem:
    """A rigid indenter on an elastic half-space: p >= 0, w = gap + u - approach >= 0, p w = 0, by force or by approach.

    gap: undeformed separation (n, m) [m]; spacing: (dx, dy) [m]; modulus: E* [Pa]; periodic: half-space; force [N];
    approach [m].
    """

    name: str = ""
    gap: FloatArray
    spacing: tuple[float, float]
    modulus: float
    periodic: bool
    force: float
    approach: float = math.nan

    @property
    def half_space(self) -> LoveHalfSpace:
        n, m = self.gap.shape
        return _half_space((n, m), self.spacing, self.modulus, self.periodic)

    @property
    def overlap(self) -> float:
        """The deepest geometric one, by which residuals are scaled [m]."""
        return self.approach - float(self.gap.min())

    def force_of(self, pressure: FloatArray) -> float:
        """F [N]."""
        return float(pressure.sum()) * self.spacing[0] * self.spacing[1]

    def residuals_and_approach(
        self, pressure: FloatArray, by_force: bool, displacement: FloatArray | None = None
    ) -> tuple[dict[str, float], float]:
        """What is left of each condition, and the approach: that of the contact under a force, which is to be held.

        Over the largest pressure, the deepest geometric overlap, or the force; NaN without an overlap. displacement:
        under the pressure (n, m) [m], by default that of the half-space.
        """
        u = self.half_space.displacement(pressure) if displacement is None else displacement
        separation, magnitude = self.gap + u, np.abs(pressure)
        approach = float((pressure * separation).sum() / pressure.sum()) if by_force else self.approach
        w, overlap = separation - approach, approach - float(self.gap.min())
        scale = overlap if overlap > 0 else math.nan
        residuals = {
            "tension": max(-float(pressure.min()), 0.0) / float(magnitude.max()),
            "complementarity": float((magnitude * np.abs(w)).sum() / abs(scale * pressure.sum())),
            "penetration": max(-float(w.min()), 0.0) / scale,
        }
        if by_force:
            residuals["force balance"] = abs(self.force_of(pressure) / self.force - 1)
        return residuals, approach

    def worst(self, pressure: FloatArray, by_force: bool, displacement: FloatArray | None = None) -> float:
        """The most that is left, NaN where one of them is."""
        return float(np.max([*self.residuals_and_approach(pressure, by_force, displacement)[0].values()]))

    @property
    def is_determined_by_approach(self) -> bool:
        """Whether an approach has one pressure: a periodic contact that is full has any."""
        return not (self.periodic and self.approach >= float(self.gap.mean()) - FULL * float(np.ptp(self.gap)))


@dataclass(frozen=True, eq=False, kw_only=True)
class KnownContact(ContactProblem):
    """A problem with its discrete answer. Made by `problems`; arrays are read-only.

    Attributes
    ----------
    name : str
        One line of text.
    gap : ndarray, shape (n, m)
        Gap before the load [m].
    spacing : (float, float)
        Sides of a cell [m].
    modulus : float
        Contact modulus E* [Pa].
    periodic : bool
        Whether the half-space is.
    force, approach : float
        Of the answer [N], [m].
    pressure : ndarray, shape (n, m)
        Of the answer [Pa].
    stiffness, area : float
        dF/dd of the fixed contact area [N/m], infinite of a full periodic one, and the area under pressure [m^2].
    limits : ndarray, shape (3, 2)
        Approach, stiffness and area extrapolated to zero cell size, with the half-widths that the grids leave.

    Examples
    --------
    >>> sphere = validation.problems()[0]
    >>> sphere.name, sphere.pressure.shape == sphere.gap.shape
    ('sphere', True)
    """

    pressure: FloatArray
    stiffness: float
    area: float
    limits: FloatArray

    def __repr__(self) -> str:
        kind = "periodic" if self.periodic else "free"
        return (
            f"KnownContact({self.name!r}, {' x '.join(map(str, self.gap.shape))} cells, {kind}, F = {self.force:.4g} N)"
        )


def problems() -> tuple[KnownContact, ...]:
    """Discrete contact problems with their answers, by which a solver is judged.

    Returns
    -------
    tuple
        Of problems in SI units. Each has ``name``, ``gap`` (n, m), ``spacing`` (dx, dy), ``modulus``, ``periodic`` and
        ``force``; the answer on its grid ``approach``, ``pressure`` (n, m), ``stiffness``, ``area``; and ``limits``
        (3, 2): approach, stiffness and area at zero cell size, with what the grids leave. Arrays are read-only.
        The stiffness of a full periodic contact is infinite.

    Examples
    --------
    >>> [problem.name for problem in validation.problems()][:3]
    ['sphere', 'ellipse', 'flat']
    """
    return _stored_problems()


@cache
def _stored_problems() -> tuple[KnownContact, ...]:
    """Read the table of problems and answers; its arrays become read-only."""
    with np.load(TABLE) as stored:
        of: dict[str, dict[str, Any]] = {}
        for key in stored:
            name, what = key.split(": ")
            value = stored[key]
            of.setdefault(name, {})[what] = (
                read_only(value) if value.ndim > 1 else tuple(value.tolist()) if value.ndim else value.item()
            )
    return tuple(KnownContact(name=name, **values) for name, values in of.items())


def read_only(values: FloatArray) -> FloatArray:
    """The same numbers, which nobody can make writeable: a view of bytes."""
    return np.frombuffer(values.tobytes(), dtype=values.dtype).reshape(values.shape)


# --- shapes: the gap over L at x, y in (0, 1) ---

Shape = Callable[[FloatArray, FloatArray], FloatArray]


def paraboloid(x: FloatArray, y: FloatArray, along: float = 1.0, across: float = 1.0) -> FloatArray:
    return np.asarray((x - 0.5) ** 2 / (2 * along) + (y - 0.5) ** 2 / (2 * across))


def summits(x: FloatArray, y: FloatArray) -> FloatArray:
    """The gap has two equal summits."""
    return np.minimum(((x - 0.25) ** 2 + (y - 0.5) ** 2) / 0.5, ((x - 0.75) ** 2 + (y - 0.5) ** 2) / 0.5)


def waves(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.asarray(0.01 * (2 - np.cos(2 * np.pi * x) - np.cos(2 * np.pi * y)))


def rough(x: FloatArray, y: FloatArray) -> FloatArray:
    """Self-affine from the side to a quarter of the waves of the coarsest grid; the same on every grid."""
    band = mdr.SelfAffine(hurst=0.8, q_min=2 * np.pi, q_max=2 * np.pi * CELLS / 4, rms=0.01)
    n = len(x)
    return -draw_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=random_generator(SEED))


def uneven(x: FloatArray, y: FloatArray) -> FloatArray:
    """Four waves without any symmetry."""
    waves = ((1.0, 1, 0, 0.4), (0.7, 2, -1, 1.1), (0.5, 1, 3, 2.0), (0.3, 4, 2, 3.3))
    return np.asarray(sum(0.01 * a * np.cos(2 * np.pi * (i * x + j * y) + phase) for a, i, j, phase in waves))


@dataclass(frozen=True)
class Stated:
    """shape: over the sides; force: over E* L^2, both before `LOW`; cells: of the coarsest grid; across: dy / dx.

    The first side is L.
    """

    shape: Shape
    force: float
    periodic: bool = False
    cells: tuple[int, int] = (CELLS, CELLS)
    across: float = 1.0

    def on(self, cells: int) -> ContactProblem:
        """With so many cells along the first axis."""
        n, m = self.cells
        x, y = ((np.arange(count) + 0.5) / count for count in (cells, max(round(cells * m / n), 1)))
        gap = LOW * SIDE * np.broadcast_to(self.shape(x[:, np.newaxis], y), (x.size, y.size))
        spacing, force = (SIDE / cells, SIDE / cells * self.across), LOW * self.force * MODULUS * SIDE**2
        return ContactProblem(gap=gap, spacing=spacing, modulus=MODULUS, periodic=self.periodic, force=force)


HERTZ = 4 / 3 / 5**3
"""F / (E* L^2) of a sphere with R = L and a = L / 5."""
STATED: Mapping[str, Stated] = {
    "sphere": Stated(paraboloid, HERTZ),
    "ellipse": Stated(lambda x, y: paraboloid(x, y, 1.0, 0.3), HERTZ / 2),
    "flat": Stated(lambda x, y: 0 * x * y, 0.01),
    "tilted": Stated(lambda x, y: 0.02 * x + 0 * y, 0.004),
    "contact up to the edge": Stated(paraboloid, 0.2),
    "cells of two lengths": Stated(paraboloid, HERTZ, cells=(CELLS, CELLS // 2), across=2),
    "two equal summits": Stated(summits, 0.004),
    "few cells": Stated(paraboloid, HERTZ / 500),
    "rough, light load": Stated(rough, 0.0003),
    "rough, heavy load": Stated(rough, 0.02),
    "sphere, periodic": Stated(paraboloid, HERTZ, periodic=True),
    "waves, periodic": Stated(waves, 0.003, periodic=True),
    "waves of two lengths of cells, periodic": Stated(waves, 0.01, periodic=True, cells=(CELLS, CELLS // 2), across=2),
    "rough, periodic": Stated(rough, 0.004, periodic=True),
    # at most 900 cells each, which a dense matrix holds
    **{
        f"{name}{', periodic' if periodic else ''}": Stated(uneven, force, periodic, cells, across)
        for periodic in (False, True)
        for name, force, cells, across in (
            ("odd grid", 0.012, (27, 27), 1),
            ("odd along axis 0", 0.012, (29, 24), 1),
            ("odd along axis 1", 0.012, (24, 29), 1),
            ("oblong", 0.006, (36, 20), 1),
            ("cells of 1:2", 0.016, (32, 16), 2),
            ("cells of 2:1", 0.016, (16, 32), 0.5),
            ("cells of 1:4", 0.012, (48, 12), 4),
            ("cells of 4:1", 0.012, (12, 48), 0.25),
            ("odd cells of 2:1, light load", 0.0002, (19, 37), 0.5),
            ("full contact", 0.3, (26, 24), 1),
            ("15 cells", 0.01, (3, 5), 0.6),
        )
    },
    "a row of cells": Stated(uneven, 0.0003, cells=(25, 1), across=1),
}


def pressed(
    problem: ContactProblem, tolerance: float, force: float | None = None, approach: float | None = None
) -> bem3d.Contact:
    """By our solver, which few cells do not keep from it."""
    n, m = problem.gap.shape
    half_space = bem3d.HalfSpace(
        shape=(n, m), spacing=problem.spacing, modulus=problem.modulus, periodic=problem.periodic
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        return bem3d.solve(
            half_space, problem.gap, force=force, approach=approach, tolerance=tolerance, indenter_ends_at_edge=True
        )


def answered(problem: ContactProblem) -> dict[str, Any]:
    """Problem and answer by name. Raises RuntimeError where the operator that judges finds more than rounding in it."""
    contact = pressed(problem, 1e-11, force=problem.force)
    _, approach = problem.residuals_and_approach(contact.pressure, by_force=True)
    worst = problem.worst(contact.pressure, by_force=True)
    same = math.isclose(approach, contact.approach, rel_tol=1e-7, abs_tol=1e-9 * np.ptp(problem.gap))
    if not (worst <= EXACT and same):
        raise RuntimeError(f"the answer leaves a residual of {worst:.2g}, accepted: {EXACT:g}")
    solution = {"approach": contact.approach, "pressure": contact.pressure, "stiffness": contact.stiffness()}
    return {**vars(problem), **solution, "area": contact.area}


def extrapolated(stated: Stated) -> dict[str, Any]:
    """The answer on the first of three grids, with its limits at zero cell size."""
    grids = [answered(stated.on(stated.cells[0] * 2**i)) for i in range(3)]
    coarse, middle, fine = (np.array([grid[what] for what in LIMITS]) for grid in grids)
    limit, before = _extrapolated_values(middle, fine), _extrapolated_values(coarse, middle)
    half = np.abs(np.subtract(limit, before, out=np.zeros_like(limit), where=limit != before))
    return {**grids[0], "limits": np.stack([limit, half], axis=1)}


def _extrapolated_values(coarse: FloatArray, fine: FloatArray) -> FloatArray:
    """Extrapolate to first order; a value that is infinite on both grids, as the stiffness of full periodic contact,
    stays so."""
    return fine + np.subtract(fine, coarse, out=np.zeros_like(fine), where=fine != coarse)


def main() -> None:
    answers = {name: extrapolated(stated) for name, stated in STATED.items()}
    arrays = {f"{name}: {what}": v for name, of in answers.items() for what, v in of.items() if what != "name"}
    archive = io.BytesIO()
    np.savez_compressed(archive, **arrays)
    write_whole(TABLE, archive.getvalue())


if __name__ == "__main__":
    main()
