"""A scene that is pressed and whose answer is known: what every method does with it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.benchmarks.peers import CONTESTANTS, Contestant, Run, Task
from validation.benchmarks.work_precision.grids import OnGrids
from validation.benchmarks.work_precision.measurement import (
    CLOSED,
    MDR,
    PLAIN,
    Answers,
    Configuration,
    Draw,
    FloatArray,
    SolveResult,
    TimedSolve,
)

FROZEN = 1e-4
"""Residual of a frozen contact, whose stiffness is good to some tens of times its square."""
MOST_ITERATIONS = 5000


def logarithm(name: str) -> Callable[[Answers], FloatArray]:
    """ln of the mean of an answer."""
    return lambda answers: np.log(np.mean(answers[name], axis=0, keepdims=True))


@dataclass(frozen=True, kw_only=True)
class ExactScene(OnGrids):
    """A scene whose answer is known.

    peers: of the cells, those for peers; springs: on the length.
    """

    peers: tuple[int, ...]
    springs: tuple[float, ...]
    tight: float = 1e-8
    tolerances: tuple[float, ...] = (0.1, 1e-2, 1e-3, 1e-4)

    def attempts(self) -> tuple[Configuration, ...]:
        """The closed form, springs, plain and fast boundary elements, and peers where they are installed."""
        return (
            Exact(line=CLOSED, knob="exact", value=1.0, referee=True, scene=self),
            *(SmoothSprings(line=MDR, knob=f"# springs {self.per}", value=n, scene=self) for n in self.springs),
            *self.grids(),
            *(self._peer(c, n) for c in CONTESTANTS[2:] if c.version for n in self.peers),
        )

    def on_grid(self, **settings: Any) -> "OnGrid":
        """Boundary elements."""
        return OnGrid(scene=self, **settings)

    def _peer(self, contestant: Contestant, cells: int) -> "Peer":
        return Peer(
            line=contestant.name,
            knob=f"# cells {self.per}",
            value=cells,
            lane=contestant.name,
            scene=self,
            cells=cells,
        )

    def exact(self) -> Answers:
        """By closed forms."""
        raise NotImplementedError

    def reference(self) -> Answers:
        """What is exact."""
        return self.exact()

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        """The grid."""
        raise NotImplementedError

    def gap(self, cells: int) -> FloatArray:
        """Undeformed separation."""
        raise NotImplementedError

    def load(self, cells: int) -> dict[str, float]:
        """The approach, or the force, that is prescribed."""
        return {"approach": 1.0}

    def force(self, cells: int) -> float:
        """What peers are pressed with."""
        raise NotImplementedError

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        """What is solved beside the contact, on the clock."""
        return None

    def read(self, contact: bem3d.Contact, frozen: bem3d.FixedContactArea | None) -> Answers:
        """Answers of boundary elements."""
        raise NotImplementedError

    def read_peer(self, cells: int, force: float, approach: float, area: float) -> Answers:
        """Answers from what a peer has found; if it prescribes the other load, carried over along the closed form."""
        raise NotImplementedError

    def profile(self, springs: float) -> tuple[FloatArray, float]:
        """Heights and length of the foundation. Raises ValueError where the scene has no image in one dimension."""
        raise NotImplementedError

    def read_springs(self, point: mdr.LoadPoint[float]) -> Answers:
        """Answers of the foundation."""
        raise NotImplementedError


@dataclass(frozen=True, kw_only=True)
class Exact(Configuration):
    """The closed form."""

    scene: ExactScene

    def prepare(self) -> Draw:
        """Nothing to do."""
        return lambda _: TimedSolve(
            self.scene.exact, lambda found: SolveResult({k: v[0] for k, v in found.items()}, 1.0)
        )


@dataclass(frozen=True, kw_only=True)
class SmoothSprings(Configuration):
    """The foundation: one sort."""

    scene: ExactScene

    def prepare(self) -> Draw:
        """The profile."""
        height, length = self.scene.profile(self.value)

        def solve() -> mdr.LoadPoint[float]:
            return mdr.load_curve(height, length=length, modulus=1.0).at_approach(1.0)

        return lambda _: TimedSolve(solve, lambda point: SolveResult(self.scene.read_springs(point), height.size))


@dataclass(frozen=True, kw_only=True)
class OnGrid(Configuration):
    """Boundary elements, plain or fast, cold."""

    scene: ExactScene
    cells: int
    tolerance: float

    def prepare(self) -> Draw:
        """Plans, coarser grids and windows, by a first solve."""
        scene = self.scene
        half_space, gap, load = scene.half_space(self.cells), scene.gap(self.cells), scene.load(self.cells)
        plain = partial(bem3d.solve_polonsky_keer, max_iterations=MOST_ITERATIONS)
        solver: Callable[..., bem3d.Contact] = plain if self.line == PLAIN else bem3d.solve

        def solve() -> tuple[bem3d.Contact, bem3d.FixedContactArea | None]:
            contact = solver(half_space, gap, **load, tolerance=self.tolerance)
            return contact, scene.finish(contact)

        def read(found: tuple[bem3d.Contact, bem3d.FixedContactArea | None]) -> SolveResult:
            return SolveResult(scene.read(*found), visited(*found))

        solve()
        return lambda _: TimedSolve(solve, read)


def visited(contact: bem3d.Contact, frozen: bem3d.FixedContactArea | None) -> float:
    """Cells times operator applications, as if each were on the whole of its grid."""
    applications = contact.operator_applications + (frozen.operator_applications if frozen else 0)
    coarse = sum(math.prod(shape) * count for shape, count in contact.coarse_applications)
    return float(contact.pressure.size * applications + coarse)


@dataclass(frozen=True, kw_only=True)
class Peer(Configuration):
    """A package of others, by force or by approach as it prefers, in its documented mode."""

    scene: ExactScene
    cells: int

    def prepare(self) -> Draw:
        """The loosest of its own tolerances that reaches the residual."""
        scene, contestant = self.scene, next(c for c in CONTESTANTS if c.name == self.line)
        half_space, force = scene.half_space(self.cells), scene.force(self.cells)
        approach = float(scene.exact()["approach"][0]) if "approach" in scene.exact() else 1.0
        task = Task(-scene.gap(self.cells), 1 / self.cells, 1.0, half_space.periodic, force, approach)
        tolerance = _loosest(contestant, task, scene.tight)

        def read(run: Run) -> SolveResult:
            pressure, separation = run.pressure, task.gap + half_space.displacement(run.pressure)
            area = np.count_nonzero(pressure > 1e-9 * pressure.max()) / self.cells**2
            found = float((pressure * separation).sum() / pressure.sum())
            total = float(pressure.sum()) / self.cells**2
            return SolveResult(scene.read_peer(self.cells, total, found, area), run.applications * pressure.size)

        # what it has solved once may be where it starts from
        return lambda _: TimedSolve(contestant.prepare(task, tolerance), read, again=False)


def _loosest(contestant: Contestant, task: Task, residual: float) -> float:
    reached: Any = math.nan
    for part in contestant.tolerances:
        reached = task.residual(contestant.prepare(task, part * residual)().pressure)
        if reached <= residual:
            return part * residual
    raise RuntimeError(f"residual {reached:.2g} at its tightest tolerance")
