"""A pressed body whose answer is known, on the charts: the closed form, springs, boundary elements, other solvers."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from validation.benchmarks import peers
from validation.benchmarks.peers import DiscreteProblem, PressureMethod
from validation.benchmarks.timing import Configuration
from validation.benchmarks.work_precision.grids import Grids, GridSeries
from validation.benchmarks.work_precision.problem import CLOSED, POLONSKY_KEER, Quantity, along
from validation.simulation.method import FloatArray, Prepared, Resolution, Result, Solve, Values
from validation.simulation.pressed import PressedGrid, PressedScene, PressedSprings


def logarithm(name: str) -> Callable[[Values], FloatArray]:
    """ln of the mean of a value."""
    return lambda values: np.log(np.mean(values[name], axis=0, keepdims=True))


class ExactProblem(PressedScene, Protocol):
    """grids, springs: on a length; peers: of the cells, those for other solvers."""

    @property
    def grids(self) -> Grids: ...
    @property
    def springs(self) -> tuple[float, ...]: ...
    @property
    def peers(self) -> tuple[int, ...]: ...
    @property
    def quantities(self) -> tuple[Quantity, ...]: ...
    def exact(self) -> Values:
        """By closed forms."""

    def peer_force(self, cells: int) -> float:
        """What other solvers are pressed with."""

    def read_peer(self, cells: int, force: float, approach: float, area: float) -> Values:
        """Values of another solver; where it prescribes the other load, carried over along the closed form."""


def grid_series(problem: ExactProblem) -> GridSeries:
    """Boundary elements of a problem."""
    published = PressedGrid(POLONSKY_KEER, polonsky_keer=True)
    return GridSeries(grids=problem.grids, scene=problem, method=PressedGrid(), published=published)


def exact_configurations(problem: ExactProblem) -> tuple[Configuration, ...]:
    """The closed form, springs, boundary elements, and other solvers where they are installed."""
    per = problem.grids.per
    closed = Configuration(
        method=ClosedForm(), scene=problem, label=CLOSED, parameter="exact", value=1.0, is_reference=True
    )
    return (
        closed,
        *along(PressedSprings(), problem, problem.springs, f"# springs {per}"),
        *grid_series(problem).configurations(),
        *(
            Configuration(
                method=PressureMethod(solver),
                scene=PressedByPeers(problem),
                resolution=Resolution(size=n, residual=problem.grids.tight),
                label=solver.name,
                parameter=f"# cells {per}",
                value=n,
                worker=solver.name,
            )
            for solver in peers.SOLVERS[2:]
            if solver.version
            for n in problem.peers
        ),
    )


@dataclass(frozen=True)
class ClosedForm:
    """What is exact."""

    name: str = CLOSED

    def prepare(self, scene: ExactProblem, resolution: Resolution) -> Prepared:
        """Nothing to do."""
        return lambda _: Solve(scene.exact, lambda found: Result({name: v[0] for name, v in found.items()}, 1.0))


@dataclass(frozen=True)
class PressedByPeers:
    """An exact problem in plain values, as other solvers take it."""

    problem: ExactProblem

    def discrete(self, cells: int) -> DiscreteProblem:
        """By a force, or by the approach of the closed form."""
        problem, exact = self.problem, self.problem.exact()
        approach = float(exact["approach"][0]) if "approach" in exact else 1.0
        return DiscreteProblem(
            height=-problem.gap(cells, 0),
            spacing=1 / cells,
            modulus=1.0,
            periodic=problem.half_space(cells).periodic,
            force=problem.peer_force(cells),
            approach=approach,
        )

    def read_pressure(self, discrete: DiscreteProblem, pressure: FloatArray) -> Values:
        """Force, approach and area of a pressure, carried over to the load of the problem."""
        cells = round(1 / discrete.spacing)
        separation = discrete.gap + discrete.half_space().displacement(pressure)
        area = np.count_nonzero(pressure > 1e-9 * pressure.max()) / cells**2
        approach = float((pressure * separation).sum() / pressure.sum())
        return self.problem.read_peer(cells, float(pressure.sum()) / cells**2, approach, area)
