"""A problem of the charts: its quantities, its configurations, its reference, and the measurement of all of them."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, ClassVar

import numpy as np

import bem3d
from validation.analysis.statistics import POWER_DECIBEL
from validation.benchmarks.timing import (
    Configuration,
    NamedMethod,
    TimedProblem,
    along,
    configurations_of,
    time_in_turns,
)
from validation.engine.engine import FloatArray, Outcome
from validation.simulation import model_names
from validation.simulation.method import Method, Prepared, Resolution, Values
from validation.simulation.model import Model
from validation.simulation.pressed import FIXED_AREA_RESIDUAL, MOST_ITERATIONS, press_on_grid
from validation.theory.rolling import response

CLOSED, FILTER_1D, FILTER_3D = model_names.CLOSED_FORM, model_names.FILTER_1D, model_names.FILTER_3D
MDR, MDR_ROLLING, FILTER_ON_STRIPS = model_names.SPRINGS, model_names.SPRINGS_ROLLING, f"{FILTER_3D}, on strips"
POLONSKY_KEER, BEM, LOOSE = "Polonsky-Keer", "BEM, finer cells", "BEM, looser residual"
EXTRAPOLATED = "BEM, extrapolated"
SPRINGS, ELEMENTS = (MDR, MDR_ROLLING), (BEM, LOOSE, EXTRAPOLATED, POLONSKY_KEER)
ROUNDING = 1e-12
"""What a closed form leaves open."""
Found = tuple[FloatArray, float]
"""Forces or accelerations, and work."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Quantity:
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


def mean_of(name: str, value: str = "", **settings: Any) -> Quantity:
    """The mean of a value, by default that of its name."""
    value = value or name

    def log(values: Values) -> FloatArray:
        return np.asarray(np.log(np.mean(values[value], axis=0, keepdims=True)))

    return Quantity(name=name, log=log, needs=(value,), **settings)


def log_power(values: Values, name: str) -> FloatArray:
    """ln of the mean of a power; on a surface over that of linear theory there, times what this has in the mean."""
    power = values[name].mean(axis=0)
    if f"linear {name}" in values:
        power = power / values[f"linear {name}"].mean(axis=0) * values[f"mean {name}"].mean(axis=0)
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.atleast_1d(power)))


class CountedSpectrum:
    """C_2D that counts the nodes of a quadrature."""

    def __init__(self, c2d: Callable[[FloatArray], FloatArray]):
        self.c2d, self.nodes = c2d, 0

    def __call__(self, q: FloatArray) -> FloatArray:
        self.nodes += q.size
        return self.c2d(q)


PUBLISHED = partial(bem3d.solve_polonsky_keer, max_iterations=MOST_ITERATIONS)
"""One object: methods are known by their options."""


def linear_power(
    surface: FloatArray, spacing: float, *, load: float = 1.0, **contact: float
) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers along the track, and the power of the linear force over a load at each, all waves across added.

    contact: radius and modulus, see `response`.
    """
    qx, qy = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in surface.shape)
    force = response(np.hypot(qx[:, np.newaxis], qy), **contact) * np.fft.fft2(surface, norm="forward")
    return qx.astype(np.float64), np.asarray((np.abs(force / load) ** 2).sum(axis=1))


@dataclass(frozen=True, kw_only=True)
class Grids:
    """Resolutions of boundary elements.

    cells: on a length of the problem, ascending; polonsky_keer: those of them for the published iteration; tight:
    residual on all of these; tolerances: residuals on the grid `fixed`; per: the length.
    """

    cells: tuple[int, ...]
    fixed: int
    polonsky_keer: tuple[int, ...] = ()
    tight: float = 1e-5
    tolerances: tuple[float, ...] = (0.1, 1e-2, 1e-3)
    per: str = "a side"


class ChartProblem(ABC):
    """A frozen dataclass. Its reference is extrapolated from its two finest grids, unless it has a closed form.

    fixed_area: whether the contact area is solved for its stiffness, on the clock; method, published: boundary
    elements, ours and the published iteration; realisations: of theirs, none where the same problem is solved again and
    again; scene: of which models are found, None where there is none.
    """

    name: ClassVar[str]
    quantities: ClassVar[tuple[Quantity, ...]]
    fixed_area: ClassVar[bool] = False
    realisations: int = 0
    grids: Grids

    @property
    def method(self) -> Method:
        return NamedMethod("BEM", press_on_grid)

    @property
    def published(self) -> Method:
        return NamedMethod(POLONSKY_KEER, press_on_grid, (PUBLISHED,))

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

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        if not self.fixed_area:
            return None
        return bem3d.solve_fixed_area(contact.problem.half_space, contact.pressure > 0, tolerance=FIXED_AREA_RESIDUAL)

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
        """Our solver on one grid, to the tight residual or another one."""
        if residual is None:
            return self.on_grids(self.method, BEM, (cells,))[0]
        parameter = f"residual #, {cells} cells {self.grids.per}"
        loose: dict[str, Any] = {"label": LOOSE, "parameter": parameter, "value": residual}
        return replace(self.on(cells), resolution=Resolution(size=cells, residual=residual), **loose)

    def boundary_elements(self) -> tuple[Configuration, ...]:
        """The published iteration and ours along cells, and ours along the residual on one grid."""
        return (
            *self.on_grids(self.published, POLONSKY_KEER, self.grids.polonsky_keer),
            *(self.on(n) for n in self.grids.cells),
            *(self.on(self.grids.fixed, residual) for residual in self.grids.tolerances),
        )

    def on_grids(self, method: Method, label: str, cells: Iterable[int]) -> tuple[Configuration, ...]:
        own: dict[str, Any] = {"residual": self.grids.tight, "realisations": self.realisations}
        return along(method, self, cells, f"# cells {self.grids.per}", label=label, **own)


def along_a_track(
    problem: Any,
    linear: Callable[..., Prepared],
    springs: tuple[Callable[..., Prepared], Any, Any],
    filtered: tuple[Callable[..., Prepared], Any],
    tracks: int = 0,
) -> tuple[Configuration, ...]:
    """Linear theory three times, springs with both input spectra, boundary elements.

    linear: in closed form; springs: the method, its options for the linear filter and for one-sided springs; filtered:
    the method on strips, its option for the linear filter; tracks: of springs, their own, none where they are a batch.
    """
    own: dict[str, Any] = {"realisations": tracks, "paired": False}
    by, without, one_sided = springs
    kinds = (FILTER_1D, "geike", without), (MDR, "geike", one_sided), (MDR_ROLLING, "rolling", one_sided)
    on_springs = [NamedMethod(name, by, tuple(options)) for name, *options in kinds]
    by_filter = NamedMethod(FILTER_ON_STRIPS, filtered[0], filtered[1:])
    return (
        *along(NamedMethod(FILTER_3D, linear), problem, (1.0,), "linear theory", paired=False),
        *(each for m in on_springs for each in along(m, problem, problem.springs, "# springs to a radius", **own)),
        *along(by_filter, problem, problem.filtered, "# cells to a radius", realisations=problem.realisations),
        *problem.boundary_elements(),
    )


def measure(timed: TimedProblem) -> Outcome:
    """All configurations of a problem in turns.

    status: "finished", or why not; setup: seconds before the clock runs; seconds i: of each run of the i-th, a
    realisation; work: median of a realisation; NAME i: its values, realisations along the first axis.
    """
    timings = time_in_turns(configurations_of(timed.problem), timed)
    work = [[result.work / result.count for result in timing.results] or [np.nan] for timing in timings]
    outcome: dict[str, Any] = {
        "status": np.array([timing.status for timing in timings]),
        "setup": np.array([timing.setup for timing in timings]),
        "work": np.array([float(np.median(each)) for each in work]),
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
