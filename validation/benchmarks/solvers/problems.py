"""Problems on which solvers are compared: a surface that is pressed onto a free or a periodic half-space; the times."""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

import bem3d
import mdr
from validation.benchmarks.peers import OUR_SOLVER, SOLVERS, DiscreteProblem, solvers_on_grids
from validation.benchmarks.timing import (
    FINISHED,
    Configuration,
    TimedProblem,
    Timing,
    configurations_of,
    interval_of_median,
    time_in_turns,
)
from validation.engine.engine import FloatArray, Outcome
from validation.engine.random_numbers import random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.roughness import Roughness
from validation.simulation.method import Values
from validation.simulation.surface import draw_surface

SPHERE, ROUGH = "sphere", "rough"
SPHERE_LOAD = 4 / 3 / 4**3
"""The force of Hertz for a = L/4 and R = L, over E* L^2."""
ROUGH_HEIGHT = 0.01


@dataclass(frozen=True)
class SurfaceProblem:
    """A surface pressed on an n x n grid of unit side: a sphere with a = n/4 cells, or a self-affine surface.

    Rough: H = 0.7, from 2 pi/L to four cells a wave, rms height 0.01 L; load: F / (E* L^2); residual: that each solver
    reaches, see `bem3d.residual`.
    """

    surface: str
    load: float
    cells: int
    periodic: bool
    seed: int
    residual: float

    @property
    def name(self) -> str:
        """Without its grid."""
        load = "" if self.surface == SPHERE else f", F = {self.load:g} E* L²"
        return f"{self.surface}{load}, {self.half_space}"

    @property
    def label(self) -> str:
        return f"{self.name}, {self.cells}²"

    @property
    def half_space(self) -> str:
        return "periodic" if self.periodic else "free"

    @property
    def scene(self) -> IndentationScene | None:
        """The scene of which models are found; None where the half-space is periodic."""
        if self.periodic:
            return None
        ground = None
        if self.surface != SPHERE:
            ground = Roughness(rms=ROUGH_HEIGHT, hurst=0.7, longest=1.0, shortest=4 / self.cells)
        shape: Literal["sphere", "punch"] = "punch" if ground else "sphere"
        return IndentationScene(name=self.label, shape=shape, size=1.0, load=self.load, modulus=1.0, ground=ground)

    @property
    def served(self) -> tuple[str, ...]:
        return "stiffness", "area"

    def height(self) -> FloatArray:
        """Positive towards the half-space [L]."""
        n = self.cells
        if self.surface == SPHERE:
            x = (np.arange(n) + 0.5) / n - 0.5
            return np.asarray(-(x[:, np.newaxis] ** 2 + x**2) / 2)
        band = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * n / 4, rms=ROUGH_HEIGHT)
        rng = random_generator(self.seed)
        return draw_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=rng, rms=ROUGH_HEIGHT)

    def discrete(self, cells: int) -> DiscreteProblem:
        """In plain values, with the approach that belongs to its force."""
        problem = DiscreteProblem(self.height(), 1 / cells, 1.0, self.periodic, self.load, 0.0)
        contact = bem3d.solve(problem.half_space(), problem.gap, force=self.load, tolerance=1e-10)
        return replace(problem, approach=contact.approach)

    def read_pressure(self, discrete: DiscreteProblem, pressure: FloatArray) -> Values:
        """The pressure and the residual that it leaves."""
        return {"pressure": pressure, "residual": np.array(discrete.residual(pressure))}

    def configurations(self) -> tuple[Configuration, ...]:
        """Each solver that is installed, in a process of its own."""
        return solvers_on_grids(SOLVERS, self, (self.cells,), "a side", self.residual)


NOT_INSTALLED = "not installed"
PRESSURE, FORCE, AREA, STIFFNESS = (f"{what} difference to ours" for what in ("pressure", "force", "area", "stiffness"))
"""Relative, of the pressure field in L2."""


def time_problem(given: TimedProblem) -> Outcome:
    """All methods in processes of their own, with one thread, in turns: a row each, solvers first, then models."""
    problem, configurations = given.problem, configurations_of(given.problem)
    timings = time_in_turns(configurations, given)
    rows = {solver.name: Timing(NOT_INSTALLED, math.nan) for solver in SOLVERS}
    rows |= dict(zip((each.label for each in configurations), timings, strict=True))
    ours = rows[OUR_SOLVER].results[0].values["pressure"] if rows[OUR_SOLVER].results else None
    whole = _of_the_contact(problem, ours) if problem.scene and ours is not None else {}
    known = {"problem": problem.label, "surface": problem.surface, "half-space": problem.half_space}
    known |= {"name": problem.name, "cells": problem.cells}
    known |= {"area": math.nan if ours is None else np.count_nonzero(ours) / ours.size}
    found = [
        {**known, "solver": name, "status": row.status, **_row(row, problem.cells, ours, whole)}
        for name, row in rows.items()
    ]
    return {name: np.array([row[name] for row in found]) for name in found[0]}


def _row(row: Timing, cells: int, ours: FloatArray | None, whole: Values) -> dict[str, float]:
    seconds = row.seconds if row.status == FINISHED else [math.nan]
    low, high = interval_of_median(seconds)
    return {
        "median [s]": float(np.median(seconds)),
        "fastest [s]": min(seconds),
        "slowest [s]": max(seconds),
        "runs": len(seconds),
        "low [s]": low,
        "high [s]": high,
        "set-up [s]": min(row.draws, default=math.nan),
        "residual": _value(row, "residual"),
        "operator applications": row.results[0].work / cells**2 if row.results else math.nan,
        **dict.fromkeys((PRESSURE, FORCE, AREA, STIFFNESS), math.nan),
        **(_differences(row, ours, whole) if row.results and ours is not None else {}),
    }


def _value(row: Timing, name: str) -> float:
    return float(np.mean(row.results[0].values.get(name, np.nan))) if row.results else math.nan


def _of_the_contact(problem: SurfaceProblem, pressure: FloatArray) -> Values:
    """What models may have of the contact of our solver."""
    half_space = bem3d.HalfSpace(shape=pressure.shape, spacing=1 / problem.cells, modulus=1.0)
    stiffness = bem3d.solve_fixed_area(half_space, pressure > 0).stiffness
    return {"stiffness": np.array(stiffness), "area": np.array(np.count_nonzero(pressure) / pressure.size)}


def _differences(row: Timing, ours: FloatArray, whole: Values) -> dict[str, float]:
    """To our solver, of a pressure or of what a model has instead."""
    pressure = row.results[0].values.get("pressure")
    if pressure is None:
        named = {AREA: "area", STIFFNESS: "stiffness"}
        return {key: abs(_value(row, name) / float(whole[name]) - 1) for key, name in named.items()}
    cells = np.count_nonzero(pressure > 1e-9 * pressure.max()) / np.count_nonzero(ours > 1e-9 * ours.max())
    return {
        PRESSURE: float(np.sqrt(((pressure - ours) ** 2).sum() / (ours**2).sum())),
        FORCE: abs(float(pressure.sum() / ours.sum()) - 1),
        AREA: abs(cells - 1),
    }
