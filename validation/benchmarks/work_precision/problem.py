"""A problem of the charts: its quantities, its configurations, its reference, and the measurement of all of them."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from validation.analysis.statistics import POWER_DECIBEL
from validation.benchmarks.timing import Configuration, TimedProblem, along, configurations_of, time_in_turns
from validation.engine.engine import FloatArray, Outcome
from validation.simulation import model_names
from validation.simulation.method import Method, Resolution, Values
from validation.simulation.model import Model

CLOSED, FILTER_3D = model_names.CLOSED_FORM, model_names.FILTER_3D
MDR, MDR_ROLLING = model_names.SPRINGS, model_names.SPRINGS_ROLLING
BEM, LOOSE, EXTRAPOLATED = "BEM, finer cells", "BEM, looser residual", "BEM, extrapolated"
SPRINGS, ELEMENTS = (MDR, MDR_ROLLING), (BEM, LOOSE, EXTRAPOLATED)
ROUNDING = 1e-12
"""What a closed form leaves open."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ChartQuantity:
    """A quantity of a problem.

    log: its natural logarithm from values, one number or one a band; needs: names of the values; order: of its error in
    the size of the cells; band: relative uncertainty of a reference that is not computed; decibel: whether errors are
    root mean squares of level differences [dB], of powers, or relative.
    """

    name: str
    log: Callable[[Values], FloatArray]
    needs: tuple[str, ...]
    order: float = 1.0
    band: float = ROUNDING
    decibel: bool = False

    def distance(self, log_ratio: FloatArray) -> float:
        """|ratio - 1|, or the root mean square of 10 lg ratio [dB]."""
        if self.decibel:
            return float(POWER_DECIBEL * np.sqrt(np.mean(log_ratio**2)))
        return float(np.abs(np.expm1(log_ratio)).max())


def mean_of(name: str, value: str = "", **settings: Any) -> ChartQuantity:
    """The mean of a value, by default that of its name."""
    value = value or name

    def log(values: Values) -> FloatArray:
        return np.asarray(np.log(np.mean(values[value], axis=0, keepdims=True)))

    return ChartQuantity(name=name, log=log, needs=(value,), **settings)


@dataclass(frozen=True, kw_only=True)
class Grids:
    """Resolutions of boundary elements.

    cells: on a length of the problem, ascending; tight: residual on all of these; tolerances: residuals on the grid
    `fixed`, descending; per: the length.
    """

    cells: tuple[int, ...]
    fixed: int
    tight: float = 1e-5
    tolerances: tuple[float, ...] = (0.1, 1e-2, 1e-3)
    per: str = "a side"


class ChartProblem(ABC):
    """A frozen dataclass. Its reference is extrapolated from its two finest grids, unless it has a closed form.

    realisations: of boundary elements, none where the same problem is solved again and again; scene: of which models
    are found, None where there is none.
    """

    name: ClassVar[str]
    quantities: ClassVar[tuple[ChartQuantity, ...]]
    realisations: int = 0
    grids: Grids

    @property
    @abstractmethod
    def method(self) -> Method:
        """Boundary elements."""

    @abstractmethod
    def configurations(self) -> tuple[Configuration, ...]:
        """All that are timed, models that are found not among them, in the order of their parameters."""

    @property
    def scene(self) -> Any:
        return None

    @property
    def served(self) -> tuple[str, ...]:
        """Names of the values that a model may have."""
        return tuple(dict.fromkeys(name for quantity in self.quantities for name in quantity.needs))

    def of_model(self, values: Values) -> Values:
        """What a model that is found has, in the values of this problem."""
        return values

    def reference(self) -> Values | tuple[Configuration, Configuration]:
        """What is exact, or the coarse and the fine grid from which it is extrapolated."""
        coarse, fine = (self.on(n) for n in self.grids.cells[-2:])
        return coarse, fine

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Other grids of which one has twice the cells of the other, which are extrapolated like the reference."""
        cells = self.grids.cells
        doubled = tuple((self.on(n), self.on(2 * n)) for n in cells if 2 * n in cells)
        return tuple(pair for pair in doubled if pair != self.reference())

    def on(self, cells: int, residual: float | None = None) -> Configuration:
        """Boundary elements on one grid, to the tight residual or another one."""
        own: dict[str, Any] = {"label": BEM, "residual": self.grids.tight, "realisations": self.realisations}
        (tight,) = along(self.method, self, (cells,), f"# cells {self.grids.per}", **own)
        if residual is None:
            return tight
        parameter, resolution = f"residual #, {cells} cells {self.grids.per}", Resolution(size=cells, residual=residual)
        return replace(tight, resolution=resolution, label=LOOSE, parameter=parameter, value=residual)

    def boundary_elements(self) -> tuple[Configuration, ...]:
        """Along cells, and along the residual on one grid."""
        grids = self.grids
        return (*map(self.on, grids.cells), *(self.on(grids.fixed, residual) for residual in grids.tolerances))


def measure(timed: TimedProblem) -> Outcome:
    """All configurations of a problem in turns.

    status: "finished", or why not; setup: seconds before the clock runs; seconds i: of each run of the i-th, a
    realisation; NAME i: its values, realisations along the first axis.
    """
    timings = time_in_turns(configurations_of(timed.problem), timed)
    outcome: dict[str, Any] = {
        "status": np.array([timing.status for timing in timings]),
        "setup": np.array([timing.setup for timing in timings]),
    }
    for i, timing in enumerate(timings):
        outcome[f"seconds {i}"] = np.array(timing.seconds)
        for name in timing.results[0].values if timing.results else ():
            rows = [np.asarray(result.values[name]) for result in timing.results]
            outcome[f"{name} {i}"] = np.stack(rows) if timing.results[0].count == 1 else np.concatenate(rows)
    return outcome


def values_of(problem: ChartProblem, configuration: Configuration, outcome: Mapping[str, Any], i: int) -> Values:
    """Of the i-th configuration."""
    end = f" {i}"
    names = (name.removesuffix(end) for name in outcome if name.endswith(end) and name != f"seconds{end}")
    values = {name: outcome[name + end] for name in names}
    return problem.of_model(values) if isinstance(configuration.method, Model) else values
