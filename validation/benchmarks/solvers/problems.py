"""Problems on which solvers are compared: a surface that is pressed onto a free or a periodic half-space."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

import bem3d
import mdr
from validation.benchmarks.peers import SOLVERS, DiscreteProblem, solvers_on_grids
from validation.benchmarks.timing import Configuration
from validation.engine.random_numbers import random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.roughness import Roughness
from validation.simulation.method import FloatArray, Values
from validation.simulation.rough_punch import PunchRoughness
from validation.simulation.surface import draw_surface

SPHERE, ROUGH, PUNCH = "sphere", "rough", "punch of Fig. 14.1"
SPHERE_LOAD = 4 / 3 / 4**3
"""The force of Hertz for a = L/4 and R = L, over E* L^2."""
ROUGH_HEIGHT = 0.01


@dataclass(frozen=True)
class SurfaceProblem:
    """A surface pressed on an n x n grid of unit side: a sphere with a = n/4 cells, or a self-affine surface.

    Rough: H = 0.7, from 2 pi/L to four cells a wave, rms height 0.01 L; the punch of Fig. 14.1 alike, with its own
    height; load: F / (E* L^2); residual: that each solver reaches, see `bem3d.residual`.
    """

    surface: str
    load: float
    cells: int
    periodic: bool
    seed: int
    residual: float

    @property
    def label(self) -> str:
        load = "" if self.surface == SPHERE else f", F = {self.load:g} E* L²"
        return f"{self.surface}{load}, {self.half_space}, {self.cells}²"

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
            height = ROUGH_HEIGHT if self.surface == ROUGH else punch(self.cells, self.seed).height
            ground = Roughness(rms=height, hurst=0.7, longest=1.0, shortest=4 / self.cells)
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
        if self.surface == PUNCH:
            return punch(n, self.seed).surface(n, 0)
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


def punch(cells: int, seed: int) -> PunchRoughness:
    """One of those of Fig. 14.1, with four cells to its shortest wave."""
    return PunchRoughness(hurst=0.7, waves=(1, cells // 4), seed=seed)
