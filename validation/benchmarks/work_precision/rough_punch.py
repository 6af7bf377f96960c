"""Speed against accuracy on the rough punch of Fig. 14.1: mean stiffness under a force, and how much it scatters."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.benchmarks.work_precision.exact_problem import FROZEN, MOST_ITERATIONS, logarithm, visited
from validation.benchmarks.work_precision.grids import Refined
from validation.benchmarks.work_precision.measurement import (
    CLOSED,
    MDR,
    PLAIN,
    Answers,
    Configuration,
    Draw,
    FloatArray,
    Quantity,
    SolveResult,
    TimedSolve,
)
from validation.simulation.rough_punch import PunchRoughness
from validation.theory.closed_forms import rough_punch_stiffness


def log_deviation(answers: Answers) -> FloatArray:
    """ln of the relative standard deviation; minus infinity of a single value."""
    k = answers["stiffness"]
    deviation = k.std(ddof=1) / k.mean() if k.size > 1 else 0.0
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.atleast_1d(deviation)))


@dataclass(frozen=True, kw_only=True)
class Fractal(Refined):
    """A square punch of side L = 1, self-affine from q_min = 2 pi / L to q_max, under Fbar = F / (E* h L).

    hurst; waves: on a side, of the shortest; force: Fbar; surfaces: realisations; profiles: of springs, their own;
    springs: of a profile; seed: zero or positive.
    """

    hurst: float = 0.7
    waves: int = 15
    force: float = 0.1
    surfaces: int = 16
    profiles: int = 120
    cells: tuple[int, ...] = (24, 32, 64, 128)
    plain: tuple[int, ...] = (32, 64)
    springs: tuple[int, ...] = (24, 32, 64, 128, 256, 512)
    fixed: int = 64
    seed: int = 150

    @property
    def name(self) -> str:
        """For tables and figures."""
        return "fractal punch"

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """Of all surfaces together."""
        return (
            Quantity(name="mean stiffness", log=logarithm("stiffness"), needs=("stiffness",)),
            Quantity(name="relative deviation", log=log_deviation, needs=("stiffness",)),
        )

    @property
    def roughness(self) -> PunchRoughness:
        """The same on every grid and in both methods."""
        return PunchRoughness(hurst=self.hurst, waves=(1, self.waves), seed=self.seed)

    def attempts(self) -> tuple[Configuration, ...]:
        """The closed form, springs, plain and fast boundary elements."""
        return (
            SeriesPunch(line=CLOSED, knob="flat punch on its rough face", value=1.0, paired=False, scene=self),
            *(self._springs(n) for n in self.springs),
            *self.grids(),
        )

    def _springs(self, springs: int) -> "RoughSprings":
        return RoughSprings(
            line=MDR,
            knob="# springs a side",
            value=springs,
            realisations=self.profiles,
            paired=False,
            scene=self,
        )

    def on_grid(self, **settings: Any) -> "RoughGrid":
        """Boundary elements."""
        return RoughGrid(realisations=self.surfaces, scene=self, **settings)


@dataclass(frozen=True, kw_only=True)
class SeriesPunch(Configuration):
    """A flat punch in series with its rough face: the same for all surfaces, without scatter."""

    scene: Fractal

    def prepare(self) -> Draw:
        """Nothing to do."""
        height = self.scene.roughness.height
        load = {"side": 1.0, "modulus": 1.0, "force": self.scene.force * height, "height": height}
        formula = partial(rough_punch_stiffness, **load)
        return lambda _: TimedSolve(formula, lambda k: SolveResult({"stiffness": np.array(k)}, 1.0))


@dataclass(frozen=True, kw_only=True)
class RoughSprings(Configuration):
    """A profile of Geike's spectrum on springs, L_1D = L: one sort for all forces."""

    scene: Fractal

    def prepare(self) -> Draw:
        """Refuses waves that springs do not resolve."""
        scene, roughness, springs = self.scene, self.scene.roughness, round(self.value)
        roughness.profile(springs, 0)

        def draw(realisation: int) -> TimedSolve:
            height = roughness.profile(springs, realisation)

            def solve() -> mdr.LoadPoint[float]:
                return mdr.load_curve(height, length=1.0, modulus=1.0).at_force(scene.force * roughness.height)

            return TimedSolve(solve, lambda point: SolveResult({"stiffness": np.array(point.stiffness)}, springs))

        return draw


@dataclass(frozen=True, kw_only=True)
class RoughGrid(Configuration):
    """Boundary elements, plain or fast, a cold solve and its stiffness."""

    scene: Fractal
    cells: int
    tolerance: float

    def prepare(self) -> Draw:
        """Plans, coarser grids and windows, by a solve of the first surface."""
        scene, roughness, n = self.scene, self.scene.roughness, self.cells
        half_space = bem3d.HalfSpace(shape=(n, n), spacing=1 / n, modulus=1.0)
        plain = partial(bem3d.solve_polonsky_keer, max_iterations=MOST_ITERATIONS)
        solver: Callable[..., bem3d.Contact] = plain if self.line == PLAIN else bem3d.solve
        force = scene.force * roughness.height

        def draw(realisation: int) -> TimedSolve:
            gap = -roughness.surface(n, realisation)

            def solve() -> tuple[bem3d.Contact, bem3d.FixedContactArea]:
                contact = solver(half_space, gap, force=force, tolerance=self.tolerance)
                return contact, bem3d.solve_fixed_area(half_space, contact.pressure > 0, tolerance=FROZEN)

            return TimedSolve(
                solve, lambda found: SolveResult({"stiffness": np.array(found[1].stiffness)}, visited(*found))
            )

        draw(0).solve()
        return draw
