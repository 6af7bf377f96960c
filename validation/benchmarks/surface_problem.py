"""The contact problems of the solver comparison: a sphere, or a self-affine surface, on a square grid."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import mdr
from validation.benchmarks.discrete import ContactProblem, pressed
from validation.benchmarks.peers import PeerSolver, by_pressure, solvers_with, with_threads
from validation.benchmarks.timing import Configuration, NamedMethod, along
from validation.engine.engine import FloatArray
from validation.engine.realisations import random_generator
from validation.simulation.surface import draw_surface

SPHERE, ROUGH = "sphere", "rough"
SPHERE_LOAD = 4 / 3 / 4**3
"""The force of Hertz for a = L/4 and R = L, over E* L^2."""
ROUGH_HEIGHT = 0.01


@dataclass(frozen=True)
class SurfaceProblem:
    """A surface pressed on an n x n grid of unit side: a sphere with a = n/4 cells, or a self-affine surface.

    Rough: H = 0.7, from 2 pi/L to four cells a wave, rms height 0.01 L; load: F / (E* L^2); residual: that each solver
    reaches, see `bem3d.residual`; own: a file with other solvers; threads: of those that share their work out, beside
    their one thread; left_out: solvers that would take too long.
    """

    surface: str
    load: float
    cells: int
    periodic: bool
    seed: int
    residual: float
    own: str = ""
    threads: int = 1
    left_out: tuple[str, ...] = ()

    @property
    def solvers(self) -> tuple[PeerSolver, ...]:
        """Those that serve it."""
        solvers = (*solvers_with(self.own), *with_threads(self.threads))
        served = (solver for solver in solvers if self.half_space in solver.serves)
        return tuple(solver for solver in served if self.cells**2 <= solver.cells)

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

    def height(self) -> FloatArray:
        """Positive towards the half-space [L]."""
        n = self.cells
        if self.surface == SPHERE:
            x = (np.arange(n) + 0.5) / n - 0.5
            return np.asarray(-(x[:, np.newaxis] ** 2 + x**2) / 2)
        band = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * n / 4, rms=ROUGH_HEIGHT)
        rng = random_generator(self.seed)
        return draw_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=rng, rms=ROUGH_HEIGHT)

    def discrete(self) -> ContactProblem:
        """In plain values, with the approach that belongs to its force."""
        side = 1 / self.cells
        values: dict[str, Any] = {
            "gap": -self.height(),
            "spacing": (side, side),
            "modulus": 1.0,
            "periodic": self.periodic,
        }
        problem = ContactProblem(name=self.name, force=self.load, **values)
        return replace(problem, approach=pressed(problem, 1e-10, force=self.load).approach)

    def configurations(self) -> tuple[Configuration, ...]:
        """Each solver that is installed, in a process of its own."""
        timed = [solver for solver in self.solvers if solver.version and solver.name not in self.left_out]
        methods = [NamedMethod(solver.name, by_pressure, (solver,)) for solver in timed]
        sizes: dict[str, Any] = {"sizes": (self.cells,), "parameter": "# cells a side", "residual": self.residual}
        return tuple(each for by in methods for each in along(by, self, **sizes, worker=by.name))
